#pragma once

#include <Eigen/Core>
#include <array>
#include <stop_token>
#include <string_view>
#include <utility>
#include <vector>

#include "survey/breakline.hpp"
#include "survey/progress.hpp"
#include "survey/result.hpp"

namespace terrawalk {

/// What counts as a riser, in metres whatever the unit of the points.
struct TerraceEdgeOptions {
    double least_step_m = 0.5;      ///< a riser is at least that high
    double greatest_width_m = 1.5;  ///< in plan, from the toe to the top edge
    double least_slope = 0.5;       ///< of the face, rise over run
    double least_length_m = 6.0;    ///< of an edge; shorter ones are left out
    double greatest_reach_m = 3.0;  ///< of the look to either side: no more than half a tread, or so
    double metres_per_unit = 1.0;   ///< of points, lines and edges
};

/// One riser, in the unit of the points: its toe and its top edge, vertex by vertex opposite each other;
/// uphill is to the left.
struct TerraceEdge {
    std::vector<Eigen::Vector3d> toe_m;
    std::vector<Eigen::Vector3d> top_m;
    double length_m = 0.0;          ///< in plan, along the middle of the face
    double step_m = 0.0;            ///< median height from toe to top
    double location_sigma_m = 0.0;  ///< median standard error of the face's place, across it
};

struct TerraceEdges {
    std::vector<TerraceEdge> edges;  ///< the clearest first
    double longest_edge_m = 0.0;     ///< limit of the points' own triangles, see edge_limit.hpp
};

/// Whether a surface looks for terrace edges by itself.
enum class TerraceEdgeUse { Auto, Off };
inline constexpr std::array<std::pair<TerraceEdgeUse, std::string_view>, 2> kTerraceEdgeUses{{
    {TerraceEdgeUse::Auto, "auto"},
    {TerraceEdgeUse::Off, "off"},
}};
[[nodiscard]] std::string_view name(TerraceEdgeUse use);

/// Finds the risers of terraces in scattered heights, with noise and unevenly spread.
///
/// Points in a window that is longer along the riser than across it carry a model of nine parameters by
/// weighted least squares: two treads that each slope on their own, a face of one width between them, and its
/// middle line, a parabola in plan. Linear parameters are solved for; place, direction, bend and width are
/// searched on grids, so that a face without a point on it is found as well; place and width are means over
/// the likelihood. The model must beat a quadratic surface by the Bayesian information criterion. From the
/// clearest places an edge is followed both ways, step by step, while the model holds. Where the place is
/// unsure the face becomes as much wider as the expected height would be, and a place as unsure as the
/// points are apart ends the edge. Where the ground ends within a step and a half of an edge, the edge goes
/// on to there if the last points on both sides bear the riser out. Edges never cross one another or the
/// lines given, and keep to the ground between the points.
///
/// Any order of the points gives the same edges, with any number of threads. Fewer than 30 points: no edges.
/// @param lines  known already; finite places in plan
/// Errors: as DelaunayTin::build(); Usage for options not above zero; Cancelled.
[[nodiscard]] Result<TerraceEdges> findTerraceEdges(const std::vector<Eigen::Vector3d>& points_m,
                                                    const std::vector<Breakline>& lines,
                                                    const TerraceEdgeOptions& options, Progress& progress,
                                                    std::stop_token stop);

/// Toes and top edges as soft breaklines, two for each edge, "edge 1 toe", "edge 1 top", ...
[[nodiscard]] std::vector<Breakline> softBreaklines(const std::vector<TerraceEdge>& edges);

}  // namespace terrawalk
