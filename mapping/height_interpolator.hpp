#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <stop_token>
#include <string_view>
#include <utility>
#include <vector>

#include "mapping/variogram.hpp"
#include "survey/elevation_grid.hpp"
#include "survey/progress.hpp"
#include "survey/result.hpp"
#include "survey/trajectory.hpp"

namespace terrawalk {

/// Ways from scattered heights to a surface.
enum class InterpolationMethod {
    Linear,            ///< plane over each Delaunay triangle
    NaturalNeighbour,  ///< Sibson (1981): shares of the Voronoi cells that a place would take
    SibsonC1,          ///< the same with gradients, smooth but for the points themselves
    CloughTocher,      ///< cubic over each Delaunay triangle, smooth everywhere
    InverseDistance,   ///< weighted mean of the nearest points (Shepard 1968, local)
    Nearest,           ///< height of the nearest point
    Kriging,           ///< ordinary kriging of the nearest points, with its variance
    BSpline,           ///< multilevel B-spline (Lee, Wolberg and Shin 1997)
};
inline constexpr std::array<std::pair<InterpolationMethod, std::string_view>, 8> kInterpolationMethods{{
    {InterpolationMethod::Linear, "linear"},
    {InterpolationMethod::NaturalNeighbour, "natural-neighbour"},
    {InterpolationMethod::SibsonC1, "sibson-c1"},
    {InterpolationMethod::CloughTocher, "clough-tocher"},
    {InterpolationMethod::InverseDistance, "inverse-distance"},
    {InterpolationMethod::Nearest, "nearest"},
    {InterpolationMethod::Kriging, "kriging"},
    {InterpolationMethod::BSpline, "b-spline"},
}};
[[nodiscard]] std::string_view name(InterpolationMethod method);

struct InterpolationOptions {
    std::size_t idw_neighbours = 12;
    double idw_power = 2.0;
    std::size_t kriging_neighbours = 16;
    /// Whether kriging's variance is brought to the errors at points left out; heights stay as they are.
    bool learn_variance = false;
    /// Control lattices are refined until their spacing is not above this share of the mean point spacing.
    double b_spline_spacing = 0.5;
};

/// What a surface says of one place. Not finite where it knows nothing.
struct HeightEstimate {
    double height_m = std::numeric_limits<double>::quiet_NaN();
    double variance_m2 = std::numeric_limits<double>::quiet_NaN();  ///< only of methods that have one
};

/// What a method's variance was multiplied with, part by part, so that it is what was seen at points that
/// were foretold from the others.
struct VarianceScale {
    double noise = 1.0;                ///< of the part that comes from the noise of heights
    double structure = 1.0;            ///< of the part that comes from the ground between them
    double greatest_distance_m = 0.0;  ///< from the nearest of the others, of those points
    SigmaCoverage left_out;            ///< those points, against the variance that they taught
};

/// A surface over scattered points: one interface for all methods. Immutable; safe from any thread. Frames:
/// any local or map frame with one linear unit for all three axes; `_m` stands for that unit.
class HeightInterpolator {
  public:
    virtual ~HeightInterpolator() = default;
    HeightInterpolator(const HeightInterpolator&) = delete;
    HeightInterpolator& operator=(const HeightInterpolator&) = delete;

    /// Fills one estimate for each place. Methods over triangles know nothing outside the convex hull of the
    /// points; the others answer everywhere. Fast where each place lies near the one before. Depends on the
    /// places before only where one lies on an edge of triangles, and there but by rounding.
    virtual void estimate(std::span<const Eigen::Vector2d> places_m,
                          std::span<HeightEstimate> estimates) const = 0;
    [[nodiscard]] virtual bool hasVariance() const { return false; }
    /// Of a method with a variance that was to be learnt; nothing from fewer than 30 points.
    [[nodiscard]] virtual std::optional<VarianceScale> varianceScale() const { return std::nullopt; }
    /// Of kriging: what it takes the ground for, with the nugget and the sill that foretell points left out
    /// best. Nothing of the other methods.
    [[nodiscard]] virtual std::optional<FittedVariogram> variogram() const { return std::nullopt; }
    /// Over which distance the errors of the heights of a grid hang together: range of the spherical
    /// correlogram that has the integral over the plane of the errors' own. From pairs of up to 48 cells,
    /// spread evenly, with places around them. Nothing of a method without a variance, 0 where nothing is
    /// shared.
    [[nodiscard]] virtual std::optional<double> errorRange(const ElevationGrid&) const {
        return std::nullopt;
    }

  protected:
    HeightInterpolator() = default;
};

/// Fits a method to points. Points at the same place in plan become one at their mean height. Any order of
/// the points gives the same surface, byte for byte, with any number of threads.
/// @param points_m  finite, within 1e9 of the origin; at least one, and for the methods over triangles three
///                  that are not on one line
/// @param sigmas_m  of the heights, empty or one for each point, >= 0; kriging alone takes notice of them
/// Errors: BadData for points that cannot carry the method; Usage for options out of range; System when
/// there is not enough memory; Cancelled.
[[nodiscard]] Result<std::unique_ptr<const HeightInterpolator>> fitInterpolator(
    InterpolationMethod method, const std::vector<Eigen::Vector3d>& points_m,
    const std::vector<double>& sigmas_m, const InterpolationOptions& options, Progress& progress,
    std::stop_token stop);

/// Heights at cell centres and, of a method that has one, their variances [m^2], in the order of the cells.
struct InterpolatedGrid {
    ElevationGrid heights;
    std::vector<float> variances_m2;  ///< empty where the method has none
};

/// Estimates at all cell centres, on all of TBB's threads; the same bytes with any number of them.
/// @param wanted  empty, or one for each cell: only cells that are not NaN here are estimated
/// Errors: System when there is not enough memory; Cancelled.
[[nodiscard]] Result<InterpolatedGrid> interpolateGrid(const HeightInterpolator& surface,
                                                       const GridGeometry& geometry,
                                                       const std::vector<float>& wanted, Progress& progress,
                                                       std::stop_token stop);

}  // namespace terrawalk
