#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace terrawalk {

/// A hit of the range finder on the ground, as the track has it now. Local ENU.
struct GroundSample {
    std::uint32_t run = 0;
    std::uint32_t epoch = 0;
    double time_s = 0.0;
    Eigen::Vector3d enu_m = Eigen::Vector3d::Zero();
};

struct CrossoverOptions {
    double spacing_m = 0.7;         ///< between the places along a pass at which others are looked for
    double gate_m = 1.0;            ///< farthest apart in plan
    double radius_m = 1.0;          ///< of the ground about a place that is fitted
    double apart_s = 20.0;          ///< within a run, passes are at least so far apart in time
    double bandwidth_m = 0.5;       ///< of the weights that fall with the distance from the place
    double ridge_m2 = 0.1;          ///< holds the slope back where the points do not tell it
    std::size_t fewest_points = 3;  ///< of each pass
};

/// Two passes over the same ground. Both see it as one plane, `slope` [m/m], at their own heights:
/// `misfit_m` is the height of pass A less that of pass B. If the tracks were right it would be zero.
struct Crossover {
    std::uint32_t run_a = 0, epoch_a = 0;
    std::uint32_t run_b = 0, epoch_b = 0;
    Eigen::Vector2d place_m = Eigen::Vector2d::Zero();
    Eigen::Vector2d slope = Eigen::Vector2d::Zero();
    double misfit_m = 0.0;
    double apart_m = 0.0;      ///< of the two passes in plan
    double roughness_m = 0.0;  ///< RMS of the points about their planes
    double points = 0.0;       ///< harmonic mean of the two numbers of points
};

/// Finds where passes meet. `samples` are ordered by run and time. Order and result do not depend on
/// anything else. Pure.
[[nodiscard]] std::vector<Crossover> findCrossovers(std::span<const GroundSample> samples,
                                                    const CrossoverOptions& options);

/// A pass over a mark of known height: the height of the pass less that of the mark.
struct MarkPass {
    std::uint32_t run = 0, epoch = 0;
    Eigen::Vector2d slope = Eigen::Vector2d::Zero();
    double misfit_m = 0.0;
    double apart_m = 0.0;
    double roughness_m = 0.0;
    double points = 0.0;
};
[[nodiscard]] std::vector<MarkPass> findMarkPasses(std::span<const GroundSample> samples,
                                                   const Eigen::Vector3d& mark_enu_m,
                                                   const CrossoverOptions& options);

}  // namespace terrawalk
