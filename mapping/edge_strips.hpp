#pragma once

#include <Eigen/Core>
#include <map>
#include <utility>
#include <vector>

#include "mapping/delaunay_tin.hpp"
#include "mapping/riser_line.hpp"
#include "mapping/terrace_edges.hpp"

namespace terrawalk {

/// Turns lines of risers into pairs of toe and top edge that cross neither each other nor themselves and keep
/// to the ground of a triangulation: a line is cut where it would. The first line has the right of way.
class EdgeStrips {
  public:
    /// @param tin  the ground, kept by reference
    /// @param cell_m  side of the cells that segments are looked up by, about their length
    EdgeStrips(const DelaunayTin& tin, const TerraceEdgeOptions& options, double cell_m)
        : tin_(tin), options_(options), cell_m_(cell_m) {}

    /// @param origin_m  of the line's frame in that of the triangulation
    void add(const std::vector<RiserPlace>& line, const Eigen::Vector2d& origin_m);
    [[nodiscard]] const std::vector<TerraceEdge>& edges() const { return edges_; }

  private:
    using Segment = std::pair<Eigen::Vector2d, Eigen::Vector2d>;
    [[nodiscard]] bool isFree(const Segment& segment) const;
    void occupy(const Segment& segment);
    template <class See>
    bool visitCells(const Segment& segment, See see) const;

    const DelaunayTin& tin_;
    TerraceEdgeOptions options_;
    double cell_m_;
    std::map<std::pair<double, double>, std::vector<Segment>> occupied_;
    std::vector<TerraceEdge> edges_;
};

}  // namespace terrawalk
