#pragma once

#include <Eigen/Core>
#include <vector>

namespace terrawalk {

/// A line of one height in the map frame; higher ground lies to its left.
struct Contour {
    double level = 0.0;
    bool is_index = false;                  ///< every fifth level, drawn bolder and labelled
    bool closed = false;                    ///< the last vertex is the first
    std::vector<Eigen::Vector2d> vertices;  ///< at least two
};

}  // namespace terrawalk
