#include "fusion/gnss_jumps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace terrawalk {
namespace {

constexpr double kLongestStep_s = 1.0;  // a walker may be anywhere after a longer gap
constexpr std::size_t kSide = 3;        // steps on either side that say how the walker goes
constexpr double kGait_m = 0.15;        // by which gait alone makes a step differ
constexpr double kNoiseSigmas = 5.0;
constexpr double kUsualSteps = 5.0;  // over the median of such differences, where noise is worse than stated

double medianOf(std::vector<double>& values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

bool follows(const GnssReading& before, const GnssReading& after) {
    return before.fix_class == after.fix_class && after.time_s - before.time_s <= kLongestStep_s;
}

// By how much each step differs from how the walker goes; step i leads to reading i. Zero where none is
// known.
std::vector<double> oddSteps(std::span<const GnssReading> readings) {
    std::vector<double> odd_m(readings.size(), 0.0);
    std::vector<double> east, north;
    for (std::size_t i = 1; i < readings.size(); ++i) {
        if (!follows(readings[i - 1], readings[i])) continue;
        east.clear();
        north.clear();
        const std::size_t from = i > kSide ? i - kSide : 1;
        for (std::size_t j = from; j <= std::min(i + kSide, readings.size() - 1); ++j) {
            const double dt = readings[j].time_s - readings[j - 1].time_s;
            if (j == i || dt <= 0.0 || !follows(readings[j - 1], readings[j])) continue;
            const Eigen::Vector2d velocity = (readings[j].en_m - readings[j - 1].en_m) / dt;
            east.push_back(velocity.x());
            north.push_back(velocity.y());
        }
        if (east.size() < kSide) continue;
        const Eigen::Vector2d usual(medianOf(east), medianOf(north));
        const double dt = readings[i].time_s - readings[i - 1].time_s;
        odd_m[i] = (readings[i].en_m - readings[i - 1].en_m - usual * dt).norm();
    }
    return odd_m;
}

// Of the readings whose kind of fix is the same.
double usualOddStep(std::span<const GnssReading> readings, const std::vector<double>& odd_m,
                    std::size_t fix_class) {
    std::vector<double> values;
    for (std::size_t i = 0; i < readings.size(); ++i) {
        if (readings[i].fix_class == fix_class && odd_m[i] > 0.0) values.push_back(odd_m[i]);
    }
    return values.empty() ? 0.0 : medianOf(values);
}

struct Piece {
    std::size_t from = 0;
    std::size_t end = 0;
    double jump_before_m = 0.0;  // zero where the piece begins without one
};

}  // namespace

std::vector<double> gnssJumps(std::span<const GnssReading> readings) {
    const std::vector<double> odd_m = oddSteps(readings);
    std::vector<double> usual_m;
    std::vector<Piece> pieces;
    for (std::size_t i = 0; i < readings.size(); ++i) {
        const std::size_t fix_class = readings[i].fix_class;
        while (usual_m.size() <= fix_class) {
            usual_m.push_back(usualOddStep(readings, odd_m, usual_m.size()));
        }
        const double noise_m = std::hypot(readings[i].white_m, i > 0 ? readings[i - 1].white_m : 0.0);
        const bool jump =
            odd_m[i] > std::max({kGait_m, kNoiseSigmas * noise_m, kUsualSteps * usual_m[fix_class]});
        const bool begins = i == 0 || readings[i - 1].fix_class != fix_class;
        if (begins || jump) pieces.push_back({i, i, jump ? odd_m[i] : 0.0});
        pieces.back().end = i + 1;
    }
    const auto length = [](const Piece& p) {
        return p.end - p.from;
    };
    std::vector<double> doubted_m(readings.size(), 0.0);
    for (std::size_t p = 1; p < pieces.size(); ++p) {
        if (pieces[p].jump_before_m == 0.0) continue;
        const Piece& shorter = length(pieces[p]) <= length(pieces[p - 1]) ? pieces[p] : pieces[p - 1];
        for (std::size_t i = shorter.from; i < shorter.end; ++i) {
            doubted_m[i] = std::max(doubted_m[i], pieces[p].jump_before_m);
        }
    }
    return doubted_m;
}

std::vector<double> gnssJumps(const ReadingContext& context) {
    const ArrayLog& log = context.log;
    std::vector<double> jump_m(log.size(), 0.0);
    if (!context.options.gnss.use_position) return jump_m;
    std::vector<GnssReading> readings;
    std::vector<std::size_t> epochs;
    for (std::size_t i = 0; i < log.size(); ++i) {
        const GnssQuality quality = gnssQuality(log, i, context.options.gnss);
        if (!quality.rejection.empty()) continue;
        // A wrong height of some metres moves a position in plan by micrometres.
        const auto position = gnssPosition(log, i, context.frame, context.attitudes[i], 0.0);
        if (!position) continue;
        const double white_m = gnssWhiteShare(log, i, context.options.lasting) * quality.sigma_m;
        readings.push_back({log.time_s[i], position->enu_m.head<2>(),
                            std::sqrt(white_m * white_m + position->arm_variance_m2), gnssFixClass(log, i)});
        epochs.push_back(i);
    }
    const std::vector<double> found_m = gnssJumps(readings);
    for (std::size_t k = 0; k < epochs.size(); ++k) jump_m[epochs[k]] = found_m[k];
    return jump_m;
}

std::string gnssJumpsNote(const ArrayLog& log, std::span<const double> jump_m) {
    std::size_t stretches = 0;
    double lasted_s = 0.0;
    double largest_m = 0.0;
    double before_m = 0.0;
    for (std::size_t i = 0; i < jump_m.size(); ++i) {
        if (jump_m[i] > 0.0) {
            if (jump_m[i] != before_m) ++stretches;
            if (i + 1 < jump_m.size()) lasted_s += log.time_s[i + 1] - log.time_s[i];
            largest_m = std::max(largest_m, jump_m[i]);
        }
        before_m = jump_m[i];
    }
    if (stretches == 0) return {};
    return fmt::format(
        "GNSS stands off by up to {:.2f} m from the positions around it, {} times, for {:.0f} s in all: "
        "wrong fixes or reflected signals, which count by the size of their jump",
        largest_m, stretches, lasted_s);
}

}  // namespace terrawalk
