#pragma once

#include <cstddef>
#include <cstdint>
#include <stop_token>

#include "app/pipeline/config.hpp"
#include "fusion/simulation.hpp"
#include "survey/progress.hpp"
#include "survey/result.hpp"

namespace terrawalk {

/// Errors of one simulated survey against its truth. Heights and distances in metres. All but the last two
/// groups are of the area walk.
struct AccuracyMeasures {
    // The array, over all epochs.
    double mean_horizontal_error_m = 0.0;
    double rms_horizontal_error_m = 0.0;
    double mean_height_error_m = 0.0;  ///< of the absolute height error
    double rms_height_error_m = 0.0;
    double height_bias_m = 0.0;  ///< mean of estimate less truth

    /// Mean of squared error over predicted variance, 1 for an honest sigma; vertical, and the mean of east
    /// and north. NaN where a variance is not above zero.
    double normalized_height_error = 0.0;
    double normalized_horizontal_error = 0.0;
    double height_coverage = 0.0;      ///< share of height errors within 1.96 sigma; 0.95 is honest
    double horizontal_coverage = 0.0;  ///< the same over both horizontal axes

    /// Mean absolute height error at random check points, by the nearest used ground sample of the area walk
    /// (paper 000, section 2.2.2), and by the triangulated surface. The floors are the same with the true
    /// trajectory: what ranges, spacing of the lines and plants leave even then.
    double check_point_error_m = 0.0;
    double check_point_floor_m = 0.0;
    double surface_error_m = 0.0;
    double surface_floor_m = 0.0;
    double check_point_ratio = 0.0;  ///< error over floor
    double surface_ratio = 0.0;
    std::size_t check_points = 0;
    std::size_t surface_check_points = 0;  ///< those that lie on both surfaces, the fused and the true one

    // The nearest samples' own sigma against their height error at the check points.
    double normalized_sample_error = 0.0;
    double sample_coverage = 0.0;

    // Fixed-point runs: mean position over the last still seconds against the truth, RMS over the runs.
    double rms_end_horizontal_m = 0.0;
    double rms_end_height_m = 0.0;
    std::size_t fixed_point_runs = 0;

    double fusion_s = 0.0;  ///< wall time of fusion alone
};

/// Fuses a simulated survey by the configuration's rules and compares with its truth. The check points come
/// from the seed alone: uniform in the rectangle around the true track of the area walk, as far as they lie
/// within 2 m of it. Surfaces are made as process() makes them, but in local ENU. Simulated figures; expect
/// larger ones in a field.
/// Errors: Usage for a survey without area walk; as fuseSurvey() and DelaunayTin::build(); Cancelled.
/// Pure but for `fusion_s`.
[[nodiscard]] Result<AccuracyMeasures> measureAccuracy(const SimulatedSurvey& simulated,
                                                       const PipelineConfig& config, std::uint64_t seed,
                                                       Progress& progress, std::stop_token stop);

/// The survey that accuracy is measured on: the default one, or without its ties to known marks after the
/// start (no control stops, no end on ZERO).
[[nodiscard]] SimulationOptions accuracySimulation(std::uint64_t seed, FaultLevel faults, GnssMode gnss,
                                                   bool ties);

}  // namespace terrawalk
