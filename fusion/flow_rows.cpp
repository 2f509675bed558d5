#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "fusion/adjustment_groups.hpp"
#include "fusion/knot_intervals.hpp"
#include "fusion/sensor_rows.hpp"
#include "fusion/squared.hpp"

namespace terrawalk {

namespace {

constexpr double kLeastSigma_m = 0.005;
constexpr double kWalking_m = 0.3;  // between two knots
constexpr double kStretch_s = 30.0;
constexpr double kOutlier = 3.0;  // sigmas

/// What a knot value does to a way; an interval between two knots of the track touches up to three of another
/// chain.
class ByKnot {
  public:
    void add(const KnotChain::Place& place, const Eigen::Vector2d& change_m) {
        if (empty_) first_ = place.knot;
        empty_ = false;
        const std::size_t k = std::min<std::size_t>(place.knot - first_, 1);
        by_[k] += (1.0 - place.fraction) * change_m;
        by_[k + 1] += place.fraction * change_m;
    }
    void addTo(RowTerms& row, const KnotChain& chain, Eigen::Index axis) const {
        for (std::size_t j = 0; j < by_.size(); ++j) {
            if (by_[j][axis] != 0.0) row.add(chain.unknown(first_ + j), -by_[j][axis]);
        }
    }

  private:
    std::size_t first_ = 0;
    std::array<Eigen::Vector2d, 3> by_{Eigen::Vector2d::Zero(), Eigen::Vector2d::Zero(),
                                       Eigen::Vector2d::Zero()};
    bool empty_ = true;
};

/// The way between two knots of the track by the flow, less that of the track, and what errors do to it.
struct FlowWay {
    Eigen::Vector2d residual_m = Eigen::Vector2d::Zero();
    Eigen::Vector2d walked_m = Eigen::Vector2d::Zero();
    Eigen::Vector2d by_sin_m = Eigen::Vector2d::Zero();
    Eigen::Vector2d by_cos_m = Eigen::Vector2d::Zero();
    Eigen::Vector2d by_scale_m = Eigen::Vector2d::Zero();
    Eigen::Vector2d by_axes_m = Eigen::Vector2d::Zero();
    ByKnot by_turning, by_wander;
    double covered_s = 0.0;
    double bridged_s = 0.0;
    double bridged_m = 0.0;
    double variance_m2 = 0.0;

    [[nodiscard]] bool bridged() const { return bridged_s > 0.2 * covered_s; }
    [[nodiscard]] double sigma_m() const {
        return std::max(std::sqrt(variance_m2 + squared(bridged_m)), kLeastSigma_m);
    }
    /// Error along the way in sigmas; outliers are others' business.
    [[nodiscard]] double along() const {
        return std::clamp(residual_m.dot(walked_m) / (walked_m.norm() * sigma_m()), -kOutlier, kOutlier);
    }
};

/// Ways by the flow of half a minute, one behind the other.
struct FlowStretch {
    double errors = 0.0;  // along the way, in sigmas
    double rows = 0.0;
    double variance_m2 = 0.0;
    double begin_s = 0.0;
};

/// Variance of the way over a stretch of time as GNSS alone tells it; infinite where it tells nothing.
class GnssWay {
  public:
    GnssWay(const RunModel& run, const FusionOptions& options) : run_(run), options_(options) {}
    double variance_m2(double from_s, double to_s) {
        double weight = 0.0;
        while (next_ < run_.gnss.size() && run_.time(run_.gnss[next_].epoch) < from_s) ++next_;
        double sigma_m = 0.0;
        for (; next_ < run_.gnss.size() && run_.time(run_.gnss[next_].epoch) <= to_s; ++next_) {
            const double here_m = run_.segments[run_.gnss[next_].segment].sigma_m;
            sigma_m = sigma_m == 0.0 ? here_m : std::min(sigma_m, here_m);
        }
        if (sigma_m > 0.0) {
            const double changed = -std::expm1(-(to_s - from_s) / options_.lasting.gnss_correlation_s);
            weight += 1.0 / (2.0 * squared(sigma_m) * changed);
        }
        if (options_.gnss.use_velocity && run_.log->has(Channel::GnssVelocityEast)) {
            weight += 1.0 / (2.0 * options_.gnss.velocity_correlation_s * (to_s - from_s) *
                             squared(options_.gnss.velocity_sigma_mps));
        }
        return weight > 0.0 ? 1.0 / weight : std::numeric_limits<double>::infinity();
    }

  private:
    const RunModel& run_;
    const FusionOptions& options_;
    std::size_t next_ = 0;
};

}  // namespace

void SensorRows::addFlow(const RunModel& run) {
    if (!run.has_heading) return;
    const LastingErrorOptions& lasting = options_.lasting;
    const double iron = radians(lasting.hard_iron_run_sigma_deg);
    system_.addRow(kPrior, {{run.iron.sin.unknown, 1.0}}, -run.iron.sin.value, iron);
    system_.addRow(kPrior, {{run.iron.cos.unknown, 1.0}}, -run.iron.cos.value, iron);
    system_.addRow(kPrior, {{run.scale.unknown, 1.0}}, -run.scale.value, lasting.flow_scale_sigma);
    system_.addRow(kPrior, {{run.axes.unknown, 1.0}}, -run.axes.value, lasting.flow_axes_sigma);
    if (!run.has_flow) return;
    addFlowScale(run);
    const FlowOptions& o = options_.flow;
    const KnotChain& turning = run.has_gyro ? run.turn : run.psi;
    FlowWay way;
    FlowStretch stretch{.begin_s = run.time(0)};
    GnssWay by_gnss(run, options_);
    overIntervals(
        run, [&](std::size_t i) { return run.flow_mps[i].allFinite(); },
        [&](std::size_t i, double from_s, double to_s) {
            const double dt = to_s - from_s;
            const double yaw = trueYaw(run, shared_.iron, i);
            const double c = std::cos(yaw);
            const double s = std::sin(yaw);
            const KnotChain::Place wander = run.scale_wander.locate(run.time(i));
            const double scale = 1.0 + run.scale.value + run.scale_wander.value(wander);
            const double forward_scale = scale + run.axes.value;
            const double left_scale = scale - run.axes.value;
            const double f = run.flow_mps[i].x() / forward_scale;
            const double l = run.flow_mps[i].y() / left_scale;
            const Eigen::Vector2d v(c * f - s * l, s * f + c * l);
            // What errors do is reckoned from the way of the track, once that is near: the noise of a
            // reading in its own coefficients would make the flow's scale come out too large.
            const Eigen::Vector2d tracked = (trackAt(run, to_s) - trackAt(run, from_s)).head<2>();
            way.residual_m += dt * v - tracked;
            way.walked_m += tracked;
            const Eigen::Vector2d step = settled_ ? tracked : dt * v;
            const Eigen::Vector2d turned(step.y(), -step.x());  // d step / d psi
            way.by_turning.add(run.has_gyro ? run.turn_at[i] : run.psi_at[i], turned);
            way.by_sin_m += std::sin(run.yaw_rad[i]) * turned;
            way.by_cos_m += std::cos(run.yaw_rad[i]) * turned;
            const Eigen::Vector2d ahead(c, s);
            const Eigen::Vector2d forward = ahead.dot(step) * ahead;
            const Eigen::Vector2d left = step - forward;
            const Eigen::Vector2d scaled = forward / forward_scale + left / left_scale;
            way.by_scale_m -= scaled;
            way.by_axes_m -= forward / forward_scale - left / left_scale;
            if (shared_.flow_scale_wanders) way.by_wander.add(wander, -scaled);
            way.covered_s += dt;
            if (run.bridge_sigma_mps[i] > 0.0) {
                way.bridged_s += dt;
                way.bridged_m += dt * run.bridge_sigma_mps[i];
                return;
            }
            way.variance_m2 += squared(dt) * flowVariance(o, std::hypot(f, l));
        },
        [&](std::size_t k, double interval_s) {
            if (way.covered_s > 0.0) {
                const double share = way.covered_s / interval_s;
                for (std::size_t axis = 0; axis < 2; ++axis) {
                    const auto a = static_cast<Eigen::Index>(axis);
                    row_.clear();
                    row_.add(run.correction.unknown(k + 1, axis), share);
                    row_.add(run.correction.unknown(k, axis), -share);
                    way.by_turning.addTo(row_, turning, a);
                    if (!run.has_gyro) {
                        row_.add(run.iron.sin.unknown, -way.by_sin_m[a]);
                        row_.add(run.iron.cos.unknown, -way.by_cos_m[a]);
                        row_.add(shared_.iron.sin.unknown, -way.by_sin_m[a]);
                        row_.add(shared_.iron.cos.unknown, -way.by_cos_m[a]);
                    }
                    row_.add(run.scale.unknown, -way.by_scale_m[a]);
                    row_.add(run.axes.unknown, -way.by_axes_m[a]);
                    way.by_wander.addTo(row_, run.scale_wander, a);
                    system_.addRow(way.bridged() ? kBridge : kFlow, row_.all(), way.residual_m[a],
                                   way.sigma_m());
                }
                if (!way.bridged() && way.walked_m.norm() > kWalking_m) {
                    stretch.errors += way.along();
                    stretch.rows += 1.0;
                    stretch.variance_m2 += squared(way.sigma_m());
                }
            }
            const double end_s = run.correction.time(k + 1);
            if (end_s >= stretch.begin_s + kStretch_s) {
                if (stretch.rows > 0.5 * kStretch_s / interval_s) {
                    flow_test_.add(squared(stretch.errors) / stretch.rows,
                                   stretch.variance_m2 / by_gnss.variance_m2(stretch.begin_s, end_s));
                }
                stretch = {.begin_s = end_s};
            }
            way = {};
        });
}

// What makes a scale wander, such as grass within the range that the sensor reckons with, comes and goes.
void SensorRows::addFlowScale(const RunModel& run) {
    if (shared_.flow_scale_wanders) {
        addGaussMarkov(run.scale_wander, 0, options_.lasting.flow_scale_wander_sigma,
                       options_.lasting.flow_scale_correlation_s, kFlowScale);
        return;
    }
    for (std::size_t k = 0; k < run.scale_wander.knots(); ++k) {
        system_.addRow(kPrior, {{run.scale_wander.unknown(k), 1.0}}, 0.0, 1.0);
    }
}

}  // namespace terrawalk
