#include "fusion/flow_screen.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "survey/upper_median.hpp"

namespace terrawalk {

namespace {

constexpr double kWalking_mps = 0.3;
constexpr double kSide_s = 1.0;  // that tells of an epoch, before and after it

Eigen::Vector2d flowAt(const ArrayLog& log, std::size_t epoch) {
    return {log.value(Channel::FlowForward, epoch), log.value(Channel::FlowLeft, epoch)};
}

bool readsNothing(const ArrayLog& log, std::size_t epoch) {
    return flowAt(log, epoch).isZero(0.0);
}

struct Epochs {
    std::size_t first = 0;
    std::size_t end = 0;
};

// Those from `before_s` before the epoch to `after_s` after it.
Epochs epochsAround(const ArrayLog& log, std::size_t epoch, double before_s, double after_s) {
    Epochs around{epoch, epoch + 1};
    while (around.first > 0 && log.time_s[epoch] - log.time_s[around.first - 1] <= before_s) --around.first;
    while (around.end < log.size() && log.time_s[around.end] - log.time_s[epoch] <= after_s) ++around.end;
    return around;
}

// RMS [m/s2] by which the specific force changes over these epochs; missing without an accelerometer.
double shaking(const ArrayLog& log, const Epochs& epochs) {
    double sum = 0.0;
    double squares = 0.0;
    double n = 0.0;
    for (std::size_t i = epochs.first; i < epochs.end; ++i) {
        const double force_mps2 =
            Eigen::Vector3d(log.value(Channel::AccelerationX, i), log.value(Channel::AccelerationY, i),
                            log.value(Channel::AccelerationZ, i))
                .norm();
        if (!present(force_mps2)) continue;
        sum += force_mps2;
        squares += force_mps2 * force_mps2;
        n += 1.0;
    }
    constexpr double kFewest = 4.0;
    return n < kFewest ? kMissing : std::sqrt(std::max(0.0, squares / n - (sum / n) * (sum / n)));
}

// Nobody who walks stands still, to the last digit, from one record to the next.
class SilentFlow {
  public:
    explicit SilentFlow(const ArrayLog& log) : log_(log), silent_(log.size(), false) {
        for (std::size_t i = 0; i < log.size();) {
            const std::size_t end = endOfStretch(i);
            if (end > i) judge({i, end});
            i = std::max(end, i + 1);
        }
    }

    bool operator[](std::size_t epoch) const { return silent_[epoch]; }

  private:
    // Of epochs from `i` on that have no reading, or one of nothing.
    std::size_t endOfStretch(std::size_t i) const {
        while (i < log_.size() && !(flowAt(log_, i).squaredNorm() > 0.0)) ++i;
        return i;
    }

    void judge(const Epochs& stretch) {
        constexpr double kWalk_s = 3.0;
        constexpr double kLongest_s = 10.0;    // that is no stand for sure
        constexpr double kShaking_mps2 = 0.3;  // of a walk at least
        constexpr double kShareOfWalk = 0.3;   // a hand that stands shakes less
        const bool before = stretch.first > 0 && flowAt(log_, stretch.first - 1).norm() > kWalking_mps;
        const bool after = stretch.end < log_.size() && flowAt(log_, stretch.end).norm() > kWalking_mps;
        double walk_mps2 = 0.0;
        const auto takeWalk = [&](const Epochs& side) {
            walk_mps2 = std::max(walk_mps2, shaking(log_, side));  // what is missing changes nothing
        };
        if (before) takeWalk(epochsAround(log_, stretch.first - 1, kWalk_s, 0.0));
        if (after) takeWalk(epochsAround(log_, stretch.end, 0.0, kWalk_s));
        const double lasts_s = log_.time_s[stretch.end - 1] - log_.time_s[stretch.first];
        for (std::size_t i = stretch.first; i < stretch.end; ++i) {
            if (!readsNothing(log_, i)) continue;
            const double here_mps2 = shaking(log_, epochsAround(log_, i, kSide_s, kSide_s));
            silent_[i] = walk_mps2 > kShaking_mps2 && present(here_mps2)
                             ? here_mps2 > kShareOfWalk * walk_mps2
                             : before && after && lasts_s <= kLongest_s;
        }
    }

    const ArrayLog& log_;
    std::vector<bool> silent_;
};

bool flowStandsOut(const ArrayLog& log, std::size_t epoch) {
    constexpr std::size_t kFewest = 6;
    constexpr double kFarthest_sigma = 5.0;
    constexpr double kNear_mps = 0.5;
    constexpr double kSigmaOfMad = 1.4826;
    const Epochs around = epochsAround(log, epoch, kSide_s, kSide_s);
    std::vector<double> values;
    values.reserve(around.end - around.first);
    for (const Channel channel : {Channel::FlowForward, Channel::FlowLeft}) {
        values.clear();
        for (std::size_t i = around.first; i < around.end; ++i) {
            const double value = log.value(channel, i);
            if (present(value) && !readsNothing(log, i)) values.push_back(value);
        }
        if (values.size() < kFewest) return false;
        const double median = upperMedian(values);
        const double off = std::abs(log.value(channel, epoch) - median);
        if (off <= kNear_mps) continue;
        for (double& value : values) value = std::abs(value - median);
        if (off > kFarthest_sigma * kSigmaOfMad * upperMedian(values)) return true;
    }
    return false;
}

std::optional<std::string_view> rejectionOf(const ArrayLog& log, std::size_t epoch, bool heading_known,
                                            const FlowOptions& options, const SilentFlow& silent) {
    const bool forward = present(log.value(Channel::FlowForward, epoch));
    const bool left = present(log.value(Channel::FlowLeft, epoch));
    if (!forward && !left) return std::nullopt;
    if (log.value(Channel::FlowQuality, epoch) < options.smallest_quality) return "no texture";
    if (!forward || !left) return "one component missing";
    if (!heading_known) return "no attitude";
    if (!options.screen) return "";
    if (silent[epoch]) return "zero amid motion";
    if (flowStandsOut(log, epoch)) return "far from its neighbours";
    return "";
}

}  // namespace

FlowRejections flowRejections(const ArrayLog& log, const std::vector<EpochAttitude>& attitudes,
                              const FlowOptions& options) {
    FlowRejections rejections(log.size());
    if (!log.has(Channel::FlowForward) && !log.has(Channel::FlowLeft)) return rejections;
    const SilentFlow silent(log);
    for (std::size_t i = 0; i < log.size(); ++i) {
        rejections[i] = rejectionOf(log, i, attitudes[i].heading_known, options, silent);
    }
    return rejections;
}

}  // namespace terrawalk
