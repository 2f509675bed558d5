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
#include "survey/ground_point.hpp"
#include "survey/progress.hpp"
#include "survey/result.hpp"
#include "survey/trajectory.hpp"

namespace terrawalk {

/// What the track says of a point, one sigma, and where on which track the point lies: neighbours share these
/// errors, see trackCorrelation().
struct TrackSigma {
    double height_m = 0.0;
    double plan_m = 0.0;  ///< per axis
    std::uint32_t run = 0;
    double time_s = 0.0;
};

/// The point's track height, and its place in plan, where the attitude counts too.
[[nodiscard]] TrackSigma trackSigmaOf(const GroundPoint& point, const Trajectory& trajectory);

inline constexpr double kOtherPassCorrelation = 0.6;
inline constexpr double kEverywhereCorrelation = 0.05;

/// Correlation of the track's errors at two points. Along one pass it falls to 1/e in 8 m; another pass,
/// which crossovers bind to it, shares 0.6 of that; and a twentieth of the variance, from the marks and the
/// range finder, is common to all of the survey. Measured on simulated surveys: the first two from errors of
/// points (seeds 201 to 204, three levels of faults), the last from volumes (seeds 301 to 304 and 901 to 908,
/// too).
[[nodiscard]] double trackCorrelation(const TrackSigma& a, const TrackSigma& b, double apart_m);

/// By how much heights foretold from the points around are off, learnt from points that were left out:
///
///     variance(d, r) = c0 + c1 d + c2 d^2 + c3 r^2      d: distance to the nearest point, r: root mean
///     square of the height differences to the places at that distance around
///
/// c0 holds the noise of a point twice, in what was foretold and in what it was held against. No coefficient
/// is below zero. Lengths in the unit of the points.
struct InterpolationErrorModel {
    std::array<double, 4> coefficients{};
    double greatest_distance_m = 0.0;  ///< of a point left out: beyond it the model is a guess
    SigmaCoverage left_out;            ///< points that were foretold, against the model that they taught

    /// Of a height on the surface itself, not of one more noisy point.
    [[nodiscard]] double variance_m2(double distance_m, double relief_m) const;
};

/// Leaves points out in parts drawn by lot and in blocks of two sizes, foretells them by the method from
/// the rest, and takes the coefficients that make their errors likeliest, none below zero. By how much the
/// tracks of the point left out and of those around may differ, in height and in plan times the slope, is no
/// error of interpolation and is taken off. At most 20 000 points are foretold of each. The same for any
/// order of the points and number of threads.
/// @param track  empty for points that no track carried, or one for each point
/// Errors: Usage when the sizes differ; BadData for fewer than 30 points; as fitInterpolator(); Cancelled.
[[nodiscard]] Result<InterpolationErrorModel> learnInterpolationError(
    InterpolationMethod method, const std::vector<Eigen::Vector3d>& points_m,
    const std::vector<double>& sigmas_m, const std::vector<TrackSigma>& track,
    const InterpolationOptions& options, std::uint64_t seed, Progress& progress, std::stop_token stop);

/// Where the sigma of one cell comes from.
struct CellSigma {
    double track_m = 0.0;          ///< height of the track
    double lean_m = 0.0;           ///< error in plan times the slope over the reach of that error
    double interpolation_m = 0.0;  ///< with the noise of ranges and the roughness of the ground
    double distance_m = 0.0;       ///< to the nearest point
    double slope = 0.0;
    Eigen::Vector2d gradient = Eigen::Vector2d::Zero();
    [[nodiscard]] double total_m() const;
};

/// One of the points next to a cell's centre.
struct CarryingPoint {
    Eigen::Vector2d place_m;
    double squared_distance_m2 = 0.0;  ///< from the centre
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
    /// Over which errors of cells hang together: range of a spherical correlogram that gives sums of heights,
    /// volumes, the standard error that track, slope and interpolation give them together.
    double correlation_range_m = 0.0;
};

/// Sigma of each height of a grid:
///
///     sigma^2 = sigma_track^2 + (slope sigma_plan)^2 + interpolation(distance, relief)
///
/// sigma_track and sigma_plan are those of the weighted mean of the points that carry the cell, with
/// trackCorrelation() between them: to take them for independent would be over-confident, to take all of them
/// for one would doubt what lies between two passes too much. The slope is that over the reach of the error
/// in plan, so that the foot of a riser counts and the noise of single points does not. The noise of the
/// range finder and the roughness of the ground are in the interpolation error. On all of TBB's threads; the
/// same bytes with any number.
/// @param points_m  that carry the surface; `track` one for each
/// @param interpolation  with no variances, or one for each cell
/// Errors: Usage when the sizes differ; System when there is not enough memory; Cancelled.
[[nodiscard]] Result<SurfaceUncertainty> surfaceUncertainty(const ElevationGrid& heights,
                                                            const std::vector<Eigen::Vector3d>& points_m,
                                                            const std::vector<TrackSigma>& track,
                                                            const InterpolationError& interpolation,
                                                            Progress& progress, std::stop_token stop);

}  // namespace terrawalk
