#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "mapping/constrained_tin.hpp"
#include "mapping/cross_validation.hpp"
#include "mapping/terrace_edges.hpp"
#include "mapping/triangle_locator.hpp"
#include "survey/breakline.hpp"
#include "survey/elevation_grid.hpp"
#include "survey/progress.hpp"
#include "survey/result.hpp"
#include "survey/survey_report.hpp"

namespace terrawalk {

// From points to a surface: what `terrawalk surface` and `terrawalk process` share. Any map frame with one
// linear unit; `_m` stands for that unit.

struct SurfaceModelOptions {
    std::optional<InterpolationMethod> method;  ///< nothing: the best by cross-validation
    bool cross_validate = true;                 ///< a method that was named as well
    TerraceEdgeUse terrace_edges = TerraceEdgeUse::Auto;
    double longest_edge_m = 0.0;  ///< as in TinOptions
    InterpolationOptions interpolation;
    std::uint64_t seed = 1;
    double metres_per_unit = 1.0;  ///< of the points
};

/// Error Usage for a named method that cannot follow breaklines that were given.
[[nodiscard]] Result<void> checkMethod(const SurfaceModelOptions& options, bool breaklines_given);

/// Error BadData for lines in another CRS than the points'.
/// @param lines_crs  of their file; empty where it has none, which is taken for the points'
/// @param points_crs  as CoordinateSystem::name
[[nodiscard]] Result<void> checkBreaklineCrs(const std::vector<Breakline>& lines,
                                             const std::string& lines_crs, const std::string& points_crs,
                                             const std::filesystem::path& file);

/// What describeCrs() says of the CRS of a file, with the file, what its coordinates look like, and the cure.
/// @param what  the file holds, e.g. "points"
[[nodiscard]] Error noPlaneCrs(const Error& of_crs, std::string_view what, const Eigen::AlignedBox2d& extent,
                               const std::filesystem::path& file);

/// Points and lines that carry a surface.
struct SurfaceInput {
    std::vector<Eigen::Vector3d> points_m;
    std::vector<double> sigmas_m;  ///< empty, or of each height
    std::vector<Breakline> breaklines;
};

/// The triangles that count as ground, and with breaklines what the methods need of them.
struct GroundTriangles {
    TriangleMesh mesh;
    double longest_edge_m = 0.0;
    double area_m2 = 0.0;
    std::shared_ptr<const ConstrainedTin> constrained;  ///< null without lines
    std::vector<TerraceEdge> terrace_edges;             ///< found, and kept to
    std::vector<std::string> notes;
};
/// Triangulates, with the breaklines and with the terrace edges that are found where they are asked for.
/// Edges that cross a breakline are left out. Errors: as findTerraceEdges() and buildConstrainedTin().
[[nodiscard]] Result<GroundTriangles> triangulateGround(const SurfaceInput& input,
                                                        const SurfaceModelOptions& options,
                                                        Progress& progress, std::stop_token stop);

/// The named method, or the first of the ranking. Where breaklines were given, only methods that follow them
/// compete. Where terrace edges were found, all do: those that follow them are judged with the edges, as they
/// were found in all points and not anew for each part left out, which would take too long; the others
/// without.
struct MethodChoice {
    InterpolationMethod method = InterpolationMethod::Linear;
    std::optional<CrossValidation> validation;
    std::string note;  ///< why no method could be judged; else empty
};
[[nodiscard]] Result<MethodChoice> chooseMethod(const SurfaceInput& input, const GroundTriangles& ground,
                                                const SurfaceModelOptions& options, Progress& progress,
                                                std::stop_token stop);

/// The ground as the method can take it: without the terrace edges where it cannot follow them, and with a
/// note that says so. Errors: as triangulateGround().
[[nodiscard]] Result<GroundTriangles> groundFor(InterpolationMethod method, GroundTriangles ground,
                                                const SurfaceInput& input, const SurfaceModelOptions& options,
                                                Progress& progress, std::stop_token stop);

/// A surface that can be asked for heights. Immutable; safe from any thread.
class SurfaceModel {
  public:
    /// Errors: as fitInterpolator().
    [[nodiscard]] static Result<SurfaceModel> fit(const SurfaceInput& input, GroundTriangles ground,
                                                  InterpolationMethod method,
                                                  const SurfaceModelOptions& options, Progress& progress,
                                                  std::stop_token stop);

    [[nodiscard]] const GroundTriangles& ground() const { return ground_; }
    [[nodiscard]] InterpolationMethod method() const { return method_; }
    /// Nothing outside the ground's triangles, whatever the method.
    [[nodiscard]] std::optional<double> heightAt(double x_m, double y_m) const;
    /// Of a method with a variance, which is scaled so.
    [[nodiscard]] const std::optional<VarianceScale>& varianceScale() const { return variance_scale_; }
    /// Of kriging.
    [[nodiscard]] std::optional<FittedVariogram> variogram() const;
    /// Of kriging: over which distance the errors of a grid of it hang together.
    [[nodiscard]] std::optional<double> errorRange(const ElevationGrid& heights) const;
    /// Cells outside the ground's triangles stay empty.
    [[nodiscard]] Result<InterpolatedGrid> grid(const GridGeometry& geometry, Progress& progress,
                                                std::stop_token stop) const;

  private:
    SurfaceModel(GroundTriangles ground, InterpolationMethod method,
                 std::unique_ptr<const HeightInterpolator> heights);

    GroundTriangles ground_;
    InterpolationMethod method_;
    std::unique_ptr<const HeightInterpolator> heights_;  ///< null for linear: the triangles tell
    std::unique_ptr<const LocatorOnDemand> locator_;
    std::optional<VarianceScale> variance_scale_;
};

/// What the reports say of it.
[[nodiscard]] std::string inWords(const VarianceScale& scale);
[[nodiscard]] std::optional<VariogramSummary> summaryOf(const std::optional<FittedVariogram>& fitted);
[[nodiscard]] TerraceEdgeSummary summaryOf(const std::vector<TerraceEdge>& edges);
[[nodiscard]] std::optional<InterpolationComparison> comparisonOf(
    const std::optional<CrossValidation>& validation);

}  // namespace terrawalk
