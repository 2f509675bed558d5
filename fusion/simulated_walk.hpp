#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "fusion/random_numbers.hpp"
#include "fusion/simulated_terrain.hpp"
#include "survey/frames.hpp"

namespace terrawalk {

/// A line through points with its corners rounded over 0.7 m of way, twice continuously differentiable. It
/// starts at rest on the first point and ends at rest on the last one.
class SmoothPath {
  public:
    /// @param points  at least two, not all the same [m]
    explicit SmoothPath(const std::vector<Eigen::Vector2d>& points);
    /// Parameters run from 0 (on the first point) to length_m() (on the last); beyond them the ends go on.
    [[nodiscard]] Eigen::Vector2d at(double s_m) const;
    [[nodiscard]] double length_m() const;

  private:
    [[nodiscard]] Eigen::Vector2d onCorners(double s_m) const;

    std::vector<Eigen::Vector2d> points_;
    std::vector<double> s_m_;  ///< way to each point
};

/// Where a walk leads: it stands on stands[0], follows legs[0] to stands[1], ... and ends on the last stand.
struct WalkPlan {
    struct Stand {
        Eigen::Vector2d en_m;
        double duration_s = 0.0;
    };
    std::vector<Stand> stands;
    std::vector<std::vector<Eigen::Vector2d>> corners;  ///< of each leg, between its two stands; may be empty
    double duration_s = 0.0;                            ///< of the whole walk, stands included
};

/// Way of all legs together [m].
[[nodiscard]] double walkedLength_m(const WalkPlan& plan);

/// The array at one time, all in local ENU but for the rates, which are in the body frame.
struct WalkSample {
    double time_s = 0.0;
    Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
    Eigen::Vector3d velocity_mps = Eigen::Vector3d::Zero();
    Eigen::Vector3d acceleration_mps2 = Eigen::Vector3d::Zero();
    Attitude attitude;
    Eigen::Matrix3d enu_from_body = Eigen::Matrix3d::Identity();
    Eigen::Vector3d angular_rate_body_radps = Eigen::Vector3d::Zero();
};

/// A person who carries the array along a plan: gait, turns, tilt of the hand, height of the array above the
/// ground. Defined at all times; before and after the plan it stands. Immutable; safe from any thread.
class Walk {
  public:
    /// @param random  decides how this person holds the array on this walk
    Walk(const WalkPlan& plan, const TerrainModel& terrain, RandomNumbers random);
    [[nodiscard]] WalkSample sample(double time_s) const;

    struct Interval {
        double from_s = 0.0;
        double to_s = 0.0;
    };
    /// When the walk stands on each stand of its plan.
    [[nodiscard]] const std::vector<Interval>& standTimes() const { return stand_times_; }

  private:
    /// A slow random motion of the hand: a few sines.
    struct Sway {
        static constexpr std::size_t kWaves = 3;
        std::array<double, kWaves> amplitude{};
        std::array<double, kWaves> rate_radps{};
        std::array<double, kWaves> phase_rad{};
        Sway(double size, double shortest_period_s, double longest_period_s, RandomNumbers& random);
        [[nodiscard]] double at(double time_s) const;
    };
    struct Leg {
        SmoothPath path;
        double from_s = 0.0;
        double to_s = 0.0;
        Sway pace;
        [[nodiscard]] double way_m(double time_s) const;
        [[nodiscard]] double course_rad(double s_m) const;
    };
    /// Where the feet are, before gait and hand are added.
    struct Track {
        Eigen::Vector2d en_m = Eigen::Vector2d::Zero();
        double ground_m = 0.0;
        double course_rad = 0.0;
        double activity = 0.0;  ///< 0 at rest .. 1 in full stride
    };
    struct Pose {
        Eigen::Vector3d position_m = Eigen::Vector3d::Zero();
        Attitude attitude;
    };
    [[nodiscard]] Track track(double time_s) const;
    [[nodiscard]] Track trackOnStand(std::size_t stand, double time_s) const;
    [[nodiscard]] Track trackOnLeg(const Leg& leg, double time_s) const;
    [[nodiscard]] Pose pose(double time_s) const;

    const TerrainModel* terrain_;
    std::vector<Eigen::Vector2d> stands_;
    std::vector<Interval> stand_times_;
    std::vector<Leg> legs_;
    double carry_height_m_;
    double step_rate_radps_;
    double step_phase_rad_;
    Sway height_;
    Sway roll_;
    Sway pitch_;
    Sway yaw_;
    Sway tremor_e_;
    Sway tremor_n_;
};

/// Where the ray of the range finder first meets the ground.
/// @param origin_m      range finder, local ENU, above the ground
/// @param direction     unit vector that points downwards
/// @return distance [m], right to 1e-10 m; infinite beyond `reach_m`
[[nodiscard]] double distanceToGround_m(const TerrainModel& terrain, const Eigen::Vector3d& origin_m,
                                        const Eigen::Vector3d& direction, double reach_m);

}  // namespace terrawalk
