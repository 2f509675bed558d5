#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <stop_token>
#include <vector>

#include "mapping/height_interpolator.hpp"
#include "survey/elevation_grid.hpp"
#include "survey/progress.hpp"
#include "survey/result.hpp"
#include "survey/trajectory.hpp"

namespace terrawalk {

/// By how much heights foretold from the points around are off, learnt from points that were left out:
///
///     variance(d, s) = c0 + c1 d + c2 d^2 + (c3 d + c4 d^2) s^2      d: distance to the nearest point, s:
///     slope
///
/// c0 holds the noise of a point twice, in what was foretold and in what it was held against. No coefficient
/// is below zero. Lengths in the unit of the points.
struct InterpolationErrorModel {
    std::array<double, 5> coefficients{};
    double greatest_distance_m = 0.0;  ///< of a point left out: beyond it the model is a guess
    SigmaCoverage left_out;            ///< points that were foretold, against the model that they taught

    /// Of a height on the surface itself, not of one more noisy point.
    [[nodiscard]] double variance_m2(double distance_m, double slope) const;
};

/// Leaves points out in parts drawn by lot and in blocks of two sizes, foretells them by the method from
/// the rest, and fits the model to the squared errors by least squares on their relative scale, coefficients
/// not below zero. At most 20 000 points are foretold of each. The same for any order of the points and
/// number of threads. Errors: BadData for fewer than 30 points; as fitInterpolator(); Cancelled.
[[nodiscard]] Result<InterpolationErrorModel> learnInterpolationError(
    InterpolationMethod method, const std::vector<Eigen::Vector3d>& points_m,
    const std::vector<double>& sigmas_m, const InterpolationOptions& options, std::uint64_t seed,
    Progress& progress, std::stop_token stop);

/// What the track says of a point: errors that it shares with its neighbours, one sigma.
struct TrackSigma {
    double height_m = 0.0;
    double plan_m = 0.0;  ///< per axis
};

/// Where the sigma of one cell comes from.
struct CellSigma {
    double track_m = 0.0;          ///< height of the track
    double lean_m = 0.0;           ///< error in plan times the slope
    double interpolation_m = 0.0;  ///< with the noise of ranges and the roughness of the ground
    double distance_m = 0.0;       ///< to the nearest point
    double slope = 0.0;
    [[nodiscard]] double total_m() const;
};

/// One of the points next to a cell's centre.
struct CarryingPoint {
    double squared_distance_m2 = 0.0;
    TrackSigma track;
};
inline constexpr std::size_t kCarryingPoints = 4;  ///< as many carry a cell, where there are so many

/// @param near  the nearest `kCarryingPoints` points, the nearest first; not empty
[[nodiscard]] CellSigma cellSigma(const ElevationGrid& heights, std::size_t row, std::size_t column,
                                  std::span<const CarryingPoint> near, const InterpolationErrorModel& model);

/// What interpolation itself adds to a height.
struct InterpolationError {
    InterpolationErrorModel model;
    /// Of each cell, of a method that tells its own variance, which then counts instead of the model; empty
    /// of the others. Of the model remains how far points left out have tested.
    std::vector<float> variances_m2;
};

/// How a cell came to its height.
enum class CellSource : std::uint8_t {
    None = 0,
    Measured = 1,      ///< a point lies in it
    Interpolated = 2,  ///< between points, no farther from one than points left out have tested
    Extrapolated = 3,  ///< farther: its sigma is a guess
};

struct SurfaceUncertainty {
    std::vector<float> sigmas_m;        ///< one standard error of each height; NaN where there is none
    std::vector<float> density_per_m2;  ///< points per square unit, in a square of about 2 by 2
    std::vector<std::uint8_t> sources;  ///< CellSource
};

/// Sigma of each height of a grid:
///
///     sigma^2 = sigma_track^2 + (slope sigma_plan)^2 + interpolation(distance, slope)
///
/// The points that carry a cell lie within seconds of one another on the track, or on passes that crossovers
/// bind together: they share the track's error, so their mean has the mean of their sigmas. To take them for
/// independent would be over-confident. The noise of the range finder and the roughness of the ground are in
/// the interpolation error. On all of TBB's threads; the same bytes with any number.
/// @param points_m  that carry the surface; `track` one for each
/// @param interpolation  with no variances, or one for each cell
/// Errors: Usage when the sizes differ; System when there is not enough memory; Cancelled.
[[nodiscard]] Result<SurfaceUncertainty> surfaceUncertainty(const ElevationGrid& heights,
                                                            const std::vector<Eigen::Vector3d>& points_m,
                                                            const std::vector<TrackSigma>& track,
                                                            const InterpolationError& interpolation,
                                                            Progress& progress, std::stop_token stop);

}  // namespace terrawalk
