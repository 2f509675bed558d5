#include "fusion/simulated_walk.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "fusion/smooth_step.hpp"

namespace terrawalk {
namespace {

constexpr double kRounding_m = 0.7;       // half width of the kernel that rounds corners
constexpr double kGroundReach_m = 0.5;    // the body rises and sinks over this much way, not with each pebble
constexpr double kLookAhead_m = 1.0;      // the person faces where the next metre leads
constexpr double kStrideUp_s = 1.5;       // from rest to full stride
constexpr double kDifference_s = 0.002;   // for the derivatives of the motion; errors below 1e-4 m/s^2
constexpr double kStepSideways_m = 0.02;  // body sways at half the step rate
constexpr double kStepUp_m = 0.012;

// Nobody turns back on the spot: a sharp corner becomes two, in a bow.
std::vector<Eigen::Vector2d> withBows(const std::vector<Eigen::Vector2d>& points) {
    constexpr double kHalfBow_m = 0.6;
    constexpr double kSharp = -0.4;  // cosine of the turn: about 114 degrees
    std::vector<Eigen::Vector2d> opened{points.front()};
    for (std::size_t i = 1; i + 1 < points.size(); ++i) {
        const Eigen::Vector2d in = (points[i] - points[i - 1]).normalized();
        const Eigen::Vector2d out = (points[i + 1] - points[i]).normalized();
        if (in.dot(out) >= kSharp) {
            opened.push_back(points[i]);
            continue;
        }
        const double side = in.x() * out.y() - in.y() * out.x() < 0.0 ? -1.0 : 1.0;
        const Eigen::Vector2d bow = side * kHalfBow_m * Eigen::Vector2d(-in.y(), in.x());
        opened.push_back(points[i] - bow);
        opened.push_back(points[i] + bow);
    }
    opened.push_back(points.back());
    return opened;
}

}  // namespace

SmoothPath::SmoothPath(const std::vector<Eigen::Vector2d>& points) {
    for (const Eigen::Vector2d& point : withBows(points)) {
        if (!points_.empty() && (point - points_.back()).norm() < 1e-9) continue;
        s_m_.push_back(points_.empty() ? 0.0 : s_m_.back() + (point - points_.back()).norm());
        points_.push_back(point);
    }
    assert(points_.size() >= 2);
}

double SmoothPath::length_m() const {
    return s_m_.back() + 2.0 * kRounding_m;
}

Eigen::Vector2d SmoothPath::onCorners(double s_m) const {
    if (s_m <= 0.0) return points_.front();
    if (s_m >= s_m_.back()) return points_.back();
    const auto after =
        static_cast<std::size_t>(std::upper_bound(s_m_.begin(), s_m_.end(), s_m) - s_m_.begin());
    const double share = (s_m - s_m_[after - 1]) / (s_m_[after] - s_m_[after - 1]);
    return points_[after - 1] + share * (points_[after] - points_[after - 1]);
}

// Mean of the cornered line under a triangular kernel. Between corners the product is quadratic: Simpson is
// exact.
Eigen::Vector2d SmoothPath::at(double s_m) const {
    const double centre = s_m - kRounding_m;
    const double end = centre + kRounding_m;
    const auto weight = [&](double s) {
        return (1.0 - std::abs(s - centre) / kRounding_m) / kRounding_m;
    };
    double from = centre - kRounding_m;
    Eigen::Vector2d point_from = onCorners(from);
    Eigen::Vector2d mean = Eigen::Vector2d::Zero();
    while (from < end) {
        const auto corner = std::upper_bound(s_m_.begin(), s_m_.end(), from);
        double to = from < centre ? centre : end;
        if (corner != s_m_.end()) to = std::min(to, *corner);
        const Eigen::Vector2d point_to = onCorners(to);
        const Eigen::Vector2d point_middle = 0.5 * (point_from + point_to);
        mean += (to - from) / 6.0 *
                (std::max(weight(from), 0.0) * point_from + 4.0 * weight(0.5 * (from + to)) * point_middle +
                 std::max(weight(to), 0.0) * point_to);
        from = to;
        point_from = point_to;
    }
    return mean;
}

double walkedLength_m(const WalkPlan& plan) {
    double length_m = 0.0;
    for (std::size_t i = 0; i < plan.corners.size(); ++i) {
        std::vector<Eigen::Vector2d> points{plan.stands[i].en_m};
        points.insert(points.end(), plan.corners[i].begin(), plan.corners[i].end());
        points.push_back(plan.stands[i + 1].en_m);
        length_m += SmoothPath(points).length_m();
    }
    return length_m;
}

Walk::Sway::Sway(double size, double shortest_period_s, double longest_period_s, RandomNumbers& random) {
    for (std::size_t i = 0; i < kWaves; ++i) {
        amplitude[i] = size / static_cast<double>(kWaves) * random.uniform(0.7, 1.3);
        rate_radps[i] = 2.0 * kPi / random.uniform(shortest_period_s, longest_period_s);
        phase_rad[i] = random.uniform(0.0, 2.0 * kPi);
    }
}

double Walk::Sway::at(double time_s) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < kWaves; ++i)
        sum += amplitude[i] * std::sin(rate_radps[i] * time_s + phase_rad[i]);
    return sum;
}

// The pace comes and goes, but the leg ends in time: the sway fades out at both ends of the leg.
double Walk::Leg::way_m(double time_s) const {
    const double duration_s = to_s - from_s;
    const double share = std::clamp((time_s - from_s) / duration_s, 0.0, 1.0);
    const double speed_mps = path.length_m() / duration_s;
    const double whole = std::min(1.0, duration_s / 60.0);  // short legs have no time for it
    const double fade = whole * smoothStep(4.0 * share) * smoothStep(4.0 * (1.0 - share));
    return path.length_m() * share + fade * speed_mps * pace.at(time_s);
}

double Walk::Leg::course_rad(double s_m) const {
    const Eigen::Vector2d way = path.at(s_m + kLookAhead_m) - path.at(s_m - kLookAhead_m);
    return std::atan2(way.y(), way.x());
}

Walk::Walk(const WalkPlan& plan, const TerrainModel& terrain, RandomNumbers random)
    : terrain_(&terrain),
      carry_height_m_(random.uniform(1.15, 1.35)),
      step_rate_radps_(2.0 * kPi * random.uniform(1.6, 1.9)),
      step_phase_rad_(random.uniform(0.0, 2.0 * kPi)),
      height_(0.10, 8.0, 40.0, random),
      roll_(radians(7.0), 5.0, 30.0, random),
      pitch_(radians(7.0), 5.0, 30.0, random),
      yaw_(radians(8.0), 4.0, 30.0, random),
      tremor_e_(0.004, 1.0, 4.0, random),
      tremor_n_(0.004, 1.0, 4.0, random) {
    double standing_s = 0.0;
    for (const WalkPlan::Stand& stand : plan.stands) standing_s += stand.duration_s;
    const double seconds_per_metre = (plan.duration_s - standing_s) / walkedLength_m(plan);
    double now_s = 0.0;
    for (std::size_t i = 0; i < plan.stands.size(); ++i) {
        stands_.push_back(plan.stands[i].en_m);
        stand_times_.push_back({now_s, now_s + plan.stands[i].duration_s});
        now_s = stand_times_.back().to_s;
        if (i == plan.corners.size()) break;
        std::vector<Eigen::Vector2d> points{plan.stands[i].en_m};
        points.insert(points.end(), plan.corners[i].begin(), plan.corners[i].end());
        points.push_back(plan.stands[i + 1].en_m);
        const SmoothPath path(points);
        const double duration_s = path.length_m() * seconds_per_metre;
        // A sway of a in the time shift at rate w changes the pace by the share a w: about a quarter at most.
        legs_.push_back({path, now_s, now_s + duration_s, Sway(0.6, 15.0, 40.0, random)});
        now_s += duration_s;
    }
}

Walk::Track Walk::track(double time_s) const {
    for (std::size_t i = 0; i < legs_.size(); ++i) {
        if (time_s < legs_[i].from_s) return trackOnStand(i, time_s);
        if (time_s < legs_[i].to_s) return trackOnLeg(legs_[i], time_s);
    }
    return trackOnStand(legs_.size(), time_s);
}

Walk::Track Walk::trackOnStand(std::size_t stand, double time_s) const {
    const bool first = stand == 0;
    const bool last = stand == legs_.size();
    const double arrived_rad = first ? 0.0 : legs_[stand - 1].course_rad(legs_[stand - 1].path.length_m());
    const double leaves_rad = last ? arrived_rad : legs_[stand].course_rad(0.0);
    const Interval& times = stand_times_[stand];
    const double turned = first ? 1.0 : smoothStep((time_s - times.from_s) / (times.to_s - times.from_s));
    Track track;
    track.en_m = stands_[stand];
    track.ground_m = terrain_->height_m(track.en_m.x(), track.en_m.y());
    track.course_rad = arrived_rad + turned * wrapAngle(leaves_rad - arrived_rad);
    return track;
}

Walk::Track Walk::trackOnLeg(const Leg& leg, double time_s) const {
    const double s_m = leg.way_m(time_s);
    Track track;
    track.en_m = leg.path.at(s_m);
    track.course_rad = leg.course_rad(s_m);
    track.activity =
        smoothStep((time_s - leg.from_s) / kStrideUp_s) * smoothStep((leg.to_s - time_s) / kStrideUp_s);
    const double reach_m = kGroundReach_m * smoothStep(s_m) * smoothStep(leg.path.length_m() - s_m);
    constexpr int kSide = 3;
    double weights = 0.0;
    for (int i = -kSide; i <= kSide; ++i) {
        const double weight = kSide + 1 - std::abs(i);
        const Eigen::Vector2d en_m = i == 0 ? track.en_m : leg.path.at(s_m + reach_m * i / kSide);
        track.ground_m += weight * terrain_->height_m(en_m.x(), en_m.y());
        weights += weight;
    }
    track.ground_m /= weights;
    return track;
}

Walk::Pose Walk::pose(double time_s) const {
    const Track feet = track(time_s);
    const double step = step_rate_radps_ * time_s + step_phase_rad_;
    const double sideways_m = kStepSideways_m * feet.activity * std::sin(0.5 * step);
    Pose pose;
    pose.attitude.yaw_rad = feet.course_rad + (0.3 + 0.7 * feet.activity) * yaw_.at(time_s) +
                            radians(2.0) * feet.activity * std::sin(0.5 * step);
    pose.attitude.pitch_rad =
        radians(-4.0) + pitch_.at(time_s) + radians(1.0) * feet.activity * std::sin(step + 1.0);
    pose.attitude.roll_rad = roll_.at(time_s) + radians(1.0) * feet.activity * std::sin(0.5 * step + 1.0);
    pose.position_m = {
        feet.en_m.x() - sideways_m * std::sin(feet.course_rad) + tremor_e_.at(time_s),
        feet.en_m.y() + sideways_m * std::cos(feet.course_rad) + tremor_n_.at(time_s),
        feet.ground_m + carry_height_m_ + height_.at(time_s) + kStepUp_m * feet.activity * std::sin(step)};
    return pose;
}

WalkSample Walk::sample(double time_s) const {
    const Pose before = pose(time_s - kDifference_s);
    const Pose now = pose(time_s);
    const Pose after = pose(time_s + kDifference_s);
    WalkSample sample;
    sample.time_s = time_s;
    sample.position_m = now.position_m;
    sample.velocity_mps = (after.position_m - before.position_m) / (2.0 * kDifference_s);
    sample.acceleration_mps2 =
        (after.position_m - 2.0 * now.position_m + before.position_m) / (kDifference_s * kDifference_s);
    sample.attitude = now.attitude;
    sample.attitude.yaw_rad = wrapAngle(sample.attitude.yaw_rad);
    sample.enu_from_body = rotationEnuFromBody(now.attitude);
    const Eigen::Matrix3d turn =
        sample.enu_from_body.transpose() *
        (rotationEnuFromBody(after.attitude) - rotationEnuFromBody(before.attitude)) / (2.0 * kDifference_s);
    sample.angular_rate_body_radps =
        0.5 * Eigen::Vector3d(turn(2, 1) - turn(1, 2), turn(0, 2) - turn(2, 0), turn(1, 0) - turn(0, 1));
    return sample;
}

double distanceToGround_m(const TerrainModel& terrain, const Eigen::Vector3d& origin_m,
                          const Eigen::Vector3d& direction, double reach_m) {
    const auto clearance_m = [&](double distance_m) {
        const Eigen::Vector3d point_m = origin_m + distance_m * direction;
        return point_m.z() - terrain.height_m(point_m.x(), point_m.y());
    };
    // Steps of half the clearance cannot jump over ground that is less steep than the ray.
    double above = 0.0;
    double below = 0.0;
    for (double gap_m = clearance_m(0.0); gap_m > 0.0; gap_m = clearance_m(below)) {
        if (below > reach_m) return std::numeric_limits<double>::infinity();
        above = below;
        below += 0.5 * gap_m + 0.002;
    }
    while (below - above > 1e-11) {
        const double middle = 0.5 * (above + below);
        (clearance_m(middle) > 0.0 ? above : below) = middle;
    }
    return 0.5 * (above + below);
}

}  // namespace terrawalk
