#pragma once

#include <Eigen/Core>
#include <functional>
#include <map>
#include <optional>
#include <stop_token>
#include <utility>
#include <vector>

#include "mapping/plan_cells.hpp"
#include "mapping/step_model.hpp"
#include "mapping/terrace_edges.hpp"

namespace terrawalk {

// From places where a step is clear to the line of a riser. All pure; safe from any thread.

/// One place on a riser, as far as the points about it tell.
struct RiserPlace {
    StepFrame frame;  ///< origin on the middle of the face
    double bend_pm = 0.0;
    double width_m = 0.0;
    double height_m = 0.0;  ///< of the middle of the face
    double step_m = 0.0;
    double location_sigma_m = 0.0;
    double gain = 0.0;                                 ///< information, of a step against none
    Eigen::Vector2d seen_m = Eigen::Vector2d::Zero();  ///< the place by the points of its window alone
    double seen_sigma_m = 0.0;
    bool doubtful = false;
    bool holds = true;  ///< when looked at again about the smoothed line
};

/// Toe and top of the face in plan, wider where the place is unsure.
[[nodiscard]] std::pair<Eigen::Vector2d, Eigen::Vector2d> faceOf(const RiserPlace& place);

struct RiserSearch {
    const PlanCells& cells;
    StepScale scale;
    double spacing_m;  ///< from place to place
    TerraceEdgeOptions options;
};

/// The clearest step about a place in any direction, if there is one.
[[nodiscard]] std::optional<RiserPlace> clearStepAt(const RiserSearch& search, const Eigen::Vector2d& at_m);

/// Where risers have been: no second one is begun there, and one that comes there ends.
class RiserPlaces {
  public:
    explicit RiserPlaces(double cell_m) : cell_m_(cell_m) {}
    void add(const RiserPlace& place);
    /// The nearest within the radius, which is not above the cell's side.
    [[nodiscard]] std::optional<RiserPlace> nearest(const Eigen::Vector2d& to_m, double radius_m) const;

  private:
    using Cell = std::pair<double, double>;  // row, column
    [[nodiscard]] Cell cellOf(const Eigen::Vector2d& at_m) const;

    double cell_m_;
    std::map<Cell, std::vector<RiserPlace>> places_;
};

/// Both ways from a start, as long as the model holds; then smoothed, and heights taken anew about the
/// smoothed line. Places far from sure take their width from the others. May be a single place.
[[nodiscard]] std::vector<RiserPlace> riserThrough(const RiserSearch& search, const RiserPlace& start,
                                                   const RiserPlaces& covered, const std::stop_token& stop);

/// Whether a place in plan lies on the ground between the points.
using OnGround = std::function<bool(const Eigen::Vector2d& at_m)>;

/// A window must see points ahead, so a line ends a step or so before they do. From there it goes straight on
/// to where the ground ends, if that is near and the last points on both sides bear the step out.
[[nodiscard]] std::vector<RiserPlace> prolonged(const RiserSearch& search, std::vector<RiserPlace> line,
                                                const OnGround& on_ground);

/// How much the whole line speaks for a step, each point counted about once.
[[nodiscard]] double evidenceOf(const std::vector<RiserPlace>& line, const RiserSearch& search);

}  // namespace terrawalk
