#pragma once

#include <filesystem>
#include <stop_token>
#include <string>

#include "mapping/contours.hpp"
#include "survey/progress.hpp"
#include "survey/result.hpp"

namespace terrawalk {

/// Contours of a DEM, lengths in its unit.
struct ContourRequest {
    std::filesystem::path dem;
    std::filesystem::path output;  ///< .gpkg, .geojson or .dxf
    /// Raster of standard errors that heights are smoothed within; empty: DEM_uncertainty.tif beside the DEM,
    /// where there is one on the same cells that does not say that it belongs to other heights.
    std::filesystem::path uncertainty;
    ContourOptions options;
};

struct ContourOutcome {
    ContourRequest request;
    std::string unit;
    std::size_t lines = 0;
    std::size_t levels = 0;
    double lowest = 0.0;  ///< level
    double highest = 0.0;
    double length = 0.0;  ///< of all lines
    double smoothing_rms = 0.0;
    std::filesystem::path uncertainty;  ///< that was used; empty: none
    std::string note;                   ///< why one that lies beside the DEM was not used, or what is odd
};

/// Errors: as readDem(), contourLines() and writeContours().
[[nodiscard]] Result<ContourOutcome> makeContours(const ContourRequest& request, Progress& progress,
                                                  std::stop_token stop);

[[nodiscard]] std::string toText(const ContourOutcome& outcome);
[[nodiscard]] std::string toJson(const ContourOutcome& outcome);

}  // namespace terrawalk
