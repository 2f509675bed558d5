#pragma once

#include <Eigen/Core>
#include <map>
#include <utility>
#include <vector>

#include "mapping/delaunay_tin.hpp"
#include "mapping/riser_line.hpp"
#include "mapping/terrace_edges.hpp"
#include "survey/breakline.hpp"

namespace terrawalk {

/// Turns lines of risers into pairs of toe and top edge that cross neither each other nor themselves and keep
/// to the ground of a triangulation: a line is cut where it would. The first line has the right of way.
class EdgeStrips {
  public:
    /// @param tin  the ground, kept by reference
    /// @param origin_m  of the risers' frame in that of the triangulation
    /// @param cell_m  side of the cells that segments are looked up by, about their length
    EdgeStrips(const DelaunayTin& tin, const Eigen::Vector2d& origin_m, const TerraceEdgeOptions& options,
               double cell_m)
        : tin_(tin), origin_m_(origin_m), options_(options), cell_m_(cell_m) {}

    /// A line in the frame of the triangulation that no edge may cross.
    void keepClearOf(const Breakline& line);
    /// Whether the triangulation covers a place, in the risers' frame.
    [[nodiscard]] bool onGround(const Eigen::Vector2d& at_m) const;
    void add(const std::vector<RiserPlace>& line);
    [[nodiscard]] const std::vector<TerraceEdge>& edges() const { return edges_; }

  private:
    using Segment = std::pair<Eigen::Vector2d, Eigen::Vector2d>;
    [[nodiscard]] bool isFree(const Segment& segment) const;
    void occupy(const Segment& segment);
    template <class See>
    bool visitCells(const Segment& segment, See see) const;

    const DelaunayTin& tin_;
    Eigen::Vector2d origin_m_;
    TerraceEdgeOptions options_;
    double cell_m_;
    std::map<std::pair<double, double>, std::vector<Segment>> occupied_;
    std::vector<TerraceEdge> edges_;
};

}  // namespace terrawalk
