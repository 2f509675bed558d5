#pragma once

#include <cstdint>
#include <stop_token>

#include "app/pipeline/config.hpp"
#include "fusion/simulation.hpp"
#include "survey/progress.hpp"
#include "survey/result.hpp"
#include "survey/trajectory.hpp"

namespace terrawalk {

/// How honest the standard errors of a processed simulated survey are.
struct DemCoverage {
    SigmaCoverage heights;         ///< of the DEM at random cells, against the true ground
    double rms_error_m = 0.0;      ///< of the same cells
    double mean_sigma_m = 0.0;     ///< that was predicted for them
    double volume_error_m3 = 0.0;  ///< above a plane at the DEM's mean height, less the true one
    double volume_sigma_m3 = 0.0;  ///< that was predicted
    double error_range_m = 0.0;    ///< over which errors hang together, as was predicted
    double area_m2 = 0.0;          ///< of the DEM
};

/// Processes the survey as process() does, in the local frame, and compares with the true ground. 500 cells
/// are drawn by the seed. Simulated figures. Errors: as process().
[[nodiscard]] Result<DemCoverage> measureDemCoverage(const SimulatedSurvey& simulated,
                                                     const PipelineConfig& config, std::uint64_t seed,
                                                     Progress& progress, std::stop_token stop);

}  // namespace terrawalk
