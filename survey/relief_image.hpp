#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace terrawalk {

/// A picture of the surface, north up, in the local frame. Pixels are red, green, blue, opacity, row by row
/// from the north; where there is no surface they are transparent.
struct ReliefImage {
    double west_m = 0.0;   ///< outer edge of the first column
    double north_m = 0.0;  ///< outer edge of the first row
    double pixel_m = 1.0;
    std::size_t columns = 0;
    std::size_t rows = 0;
    double lowest_m = 0.0;  ///< height of the ramp's first colour
    double highest_m = 0.0;
    std::vector<std::uint8_t> rgba;
};

/// The same, encoded for a page.
struct ReliefPicture {
    double west_m = 0.0;
    double north_m = 0.0;
    double width_m = 0.0;
    double height_m = 0.0;
    double lowest_m = 0.0;
    double highest_m = 0.0;
    std::string png;       ///< file bytes
    std::string ramp_png;  ///< one row of pixels, from the lowest colour to the highest
};

}  // namespace terrawalk
