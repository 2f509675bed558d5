#pragma once

#include <filesystem>
#include <stop_token>
#include <string>
#include <vector>

#include "mapping/terrain_derivatives.hpp"
#include "survey/progress.hpp"
#include "survey/result.hpp"

namespace terrawalk {

/// Rasters that follow from a DEM.
struct DeriveRequest {
    std::filesystem::path dem;
    std::filesystem::path output;  ///< folder; empty: the DEM's
    std::vector<Derivative> derivatives;
    bool flow_accumulation = false;       ///< by D8
    bool flow_accumulation_dinf = false;  ///< by D-infinity
    bool wet_spots = false;
    DerivativeOptions options;
};

struct DeriveOutcome {
    DeriveRequest request;
    std::vector<std::filesystem::path> files;
};

/// Writes DEM's stem + "_slope.tif" and so on. Errors: Usage when nothing was asked for; as readDem() and
/// writeDem(); System when the memory does not suffice; Cancelled.
[[nodiscard]] Result<DeriveOutcome> deriveRasters(const DeriveRequest& request, Progress& progress,
                                                  std::stop_token stop);

[[nodiscard]] std::string toText(const DeriveOutcome& outcome);
[[nodiscard]] std::string toJson(const DeriveOutcome& outcome);

}  // namespace terrawalk
