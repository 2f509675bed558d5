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
};

/// Errors: as readDem(), contourLines() and writeContours().
[[nodiscard]] Result<ContourOutcome> makeContours(const ContourRequest& request, Progress& progress,
                                                  std::stop_token stop);

[[nodiscard]] std::string toText(const ContourOutcome& outcome);
[[nodiscard]] std::string toJson(const ContourOutcome& outcome);

}  // namespace terrawalk
