#include "fusion/gnss_jumps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "survey/upper_median.hpp"

namespace terrawalk {
namespace {

constexpr double kLongestStep_s = 1.0;  // a walker may be anywhere after a longer gap
constexpr std::size_t kSide = 3;        // steps on either side that say how the walker goes
constexpr double kGait_m = 0.12;        // by which gait alone makes a step differ
constexpr double kNoiseSigmas = 5.0;
constexpr double kUsualSteps = 5.0;  // over the median of such differences, where noise is worse than stated
// A jump that comes back does so in the opposite direction, up to a share of its size. The way back may be
// half as odd as a jump has to be; a jump without it has to be twice as odd, or it was the gait.
constexpr double kOpposite = 0.5;
constexpr double kWayBack_s = 30.0;
constexpr double kLongestDoubt_s = 60.0;
constexpr double kUsualOff = 4.0;      // times the median distance from where others have the walker: a spike
constexpr double kLeastSpike_m = 0.6;  // who turns on the spot is off by less from where others say he is

bool follows(const GnssReading& before, const GnssReading& after) {
    return before.fix_class == after.fix_class && after.time_s - before.time_s <= kLongestStep_s;
}

// How the walker goes, by the steps that lead to readings [first, last], but for one; none where fewer than
// kSide are known.
std::optional<Eigen::Vector2d> usualVelocity(std::span<const GnssReading> readings, std::size_t first,
                                             std::size_t last, std::optional<std::size_t> but_for = {}) {
    std::vector<double> east, north;
    for (std::size_t j = first; j <= last; ++j) {
        const double dt = readings[j].time_s - readings[j - 1].time_s;
        if (j == but_for || dt <= 0.0 || !follows(readings[j - 1], readings[j])) continue;
        const Eigen::Vector2d velocity = (readings[j].en_m - readings[j - 1].en_m) / dt;
        east.push_back(velocity.x());
        north.push_back(velocity.y());
    }
    if (east.size() < kSide) return std::nullopt;
    return Eigen::Vector2d(upperMedian(east), upperMedian(north));
}

// By how much each step differs from how the walker goes; step i leads to reading i. Zero where none is
// known.
std::vector<Eigen::Vector2d> oddSteps(std::span<const GnssReading> readings) {
    std::vector<Eigen::Vector2d> odd_m(readings.size(), Eigen::Vector2d::Zero());
    for (std::size_t i = 1; i < readings.size(); ++i) {
        if (!follows(readings[i - 1], readings[i])) continue;
        const std::size_t from = i > kSide ? i - kSide : 1;
        const auto usual = usualVelocity(readings, from, std::min(i + kSide, readings.size() - 1), i);
        if (!usual) continue;
        const double dt = readings[i].time_s - readings[i - 1].time_s;
        odd_m[i] = readings[i].en_m - readings[i - 1].en_m - *usual * dt;
    }
    return odd_m;
}

// Of the readings whose kind of fix is the same.
double usualOddStep(std::span<const GnssReading> readings, const std::vector<Eigen::Vector2d>& odd_m,
                    GnssFixClass fix_class) {
    std::vector<double> values;
    for (std::size_t i = 0; i < readings.size(); ++i) {
        if (readings[i].fix_class == fix_class && !odd_m[i].isZero(0.0)) values.push_back(odd_m[i].norm());
    }
    return values.empty() ? 0.0 : upperMedian(values);
}

// How far a reading lies off from where those about it have the walker; zero without three on either side.
double offFromOthers(std::span<const GnssReading> readings, std::size_t i) {
    if (i < kSide || i + kSide >= readings.size()) return 0.0;
    const std::size_t from = i - kSide;
    const std::size_t to = i + kSide;
    if (!follows(readings[from], readings[i]) || !follows(readings[i], readings[to])) return 0.0;
    const auto usual = usualVelocity(readings, from + 1, to);
    if (!usual) return 0.0;
    std::vector<double> east, north;
    for (std::size_t j = from; j <= to; ++j) {
        const Eigen::Vector2d here = readings[j].en_m + *usual * (readings[i].time_s - readings[j].time_s);
        east.push_back(here.x());
        north.push_back(here.y());
    }
    return (readings[i].en_m - Eigen::Vector2d(upperMedian(east), upperMedian(north))).norm();
}

// Readings that stand alone. Their steps would hide the jumps, or look like some; robust rows deal with them.
std::vector<bool> spikes(std::span<const GnssReading> readings) {
    std::vector<double> off_m(readings.size());
    std::array<std::vector<double>, kFixClassCount> of_class;
    for (std::size_t i = 0; i < readings.size(); ++i) {
        off_m[i] = offFromOthers(readings, i);
        if (off_m[i] > 0.0) of_class[readings[i].fix_class].push_back(off_m[i]);
    }
    std::array<double, kFixClassCount> least_m;
    least_m.fill(kLeastSpike_m);
    for (std::size_t c = 0; c < kFixClassCount; ++c) {
        if (!of_class[c].empty()) least_m[c] = std::max(kLeastSpike_m, kUsualOff * upperMedian(of_class[c]));
    }
    std::vector<bool> spike(readings.size());
    for (std::size_t i = 0; i < readings.size(); ++i) {
        spike[i] = off_m[i] > least_m[readings[i].fix_class];
    }
    return spike;
}

// How odd a step of each reading must be for a jump.
std::vector<double> jumpSizes(std::span<const GnssReading> readings,
                              const std::vector<Eigen::Vector2d>& odd_m) {
    std::array<double, kFixClassCount> usual_m{};
    for (const GnssFixClass fix_class : {kSingleClass, kFloatClass, kFixedClass}) {
        usual_m[fix_class] = usualOddStep(readings, odd_m, fix_class);
    }
    std::vector<double> least_m;
    for (std::size_t i = 0; i < readings.size(); ++i) {
        const double noise_m = std::hypot(readings[i].white_m, i > 0 ? readings[i - 1].white_m : 0.0);
        least_m.push_back(
            std::max({kGait_m, kNoiseSigmas * noise_m, kUsualSteps * usual_m[readings[i].fix_class]}));
    }
    return least_m;
}

// The step near a jump that undoes it best, if any does.
std::optional<std::size_t> wayBack(std::span<const GnssReading> readings,
                                   const std::vector<Eigen::Vector2d>& odd_m, double least_m,
                                   std::size_t jump) {
    std::optional<std::size_t> best;
    double left_m = kOpposite * odd_m[jump].norm();
    const auto look = [&](std::size_t i) {
        const double rest_m = (odd_m[i] + odd_m[jump]).norm();
        const bool same_fix = readings[i].fix_class == readings[jump].fix_class;
        if (!same_fix || odd_m[i].norm() <= 0.5 * least_m || rest_m > left_m) return;
        left_m = rest_m;
        best = i;
    };
    const auto near = [&](std::size_t i) {
        return std::abs(readings[i].time_s - readings[jump].time_s) <= kWayBack_s;
    };
    for (std::size_t i = jump + 1; i < readings.size() && near(i); ++i) look(i);
    for (std::size_t i = jump; i-- > 0 && near(i);) look(i);
    return best;
}

// The jump that leads to each reading; zero where none does.
std::vector<Eigen::Vector2d> jumpsBefore(std::span<const GnssReading> readings) {
    const std::vector<Eigen::Vector2d> odd_m = oddSteps(readings);
    const std::vector<double> least_m = jumpSizes(readings, odd_m);
    std::vector<Eigen::Vector2d> jump_m(readings.size(), Eigen::Vector2d::Zero());
    for (std::size_t i = 0; i < readings.size(); ++i) {
        const double size_m = odd_m[i].norm();
        if (size_m <= least_m[i]) continue;
        const auto back = wayBack(readings, odd_m, least_m[i], i);
        if (!back && size_m <= 2.0 * least_m[i]) continue;
        jump_m[i] = odd_m[i];
        if (back) jump_m[*back] = odd_m[*back];
    }
    return jump_m;
}

// Where readings lie that no jump parts: by so much off from those before the first jump.
struct Level {
    Eigen::Vector2d off_m = Eigen::Vector2d::Zero();
    std::size_t readings = 0;
};

// Readings [from, end) have one kind of fix. The level that most of them are on is right; but where positions
// drift by as much as they jump, the way to a level far off in time is not known, and a stretch that lasts is
// believed.
void doubtStretches(std::span<const GnssReading> readings, std::span<const Eigen::Vector2d> jump_m,
                    std::size_t from, std::size_t end, std::vector<double>& doubted_m) {
    std::vector<Level> levels{{}};
    std::vector<std::size_t> level_of;
    std::size_t level = 0;
    for (std::size_t i = from; i < end; ++i) {
        if (i > from && !jump_m[i].isZero(0.0)) {
            const Eigen::Vector2d off_m = levels[level].off_m + jump_m[i];
            const auto away = [&](const Level& other) {
                return (other.off_m - off_m).norm();
            };
            // One that was there before, if it is near: so errors of single jumps do not sum up.
            const auto nearest =
                std::min_element(levels.begin(), levels.end(),
                                 [&](const Level& a, const Level& b) { return away(a) < away(b); });
            const double left_m = std::max(jump_m[i].norm(), (nearest->off_m - levels[level].off_m).norm());
            if (away(*nearest) <= kOpposite * left_m) {
                level = static_cast<std::size_t>(nearest - levels.begin());
            } else {
                level = levels.size();
                levels.push_back({off_m, 0});
            }
        }
        ++levels[level].readings;
        level_of.push_back(level);
    }
    const auto right = std::max_element(
        levels.begin(), levels.end(), [](const Level& a, const Level& b) { return a.readings < b.readings; });
    for (std::size_t i = from; i < end; ++i) {
        doubted_m[i] = (levels[level_of[i - from]].off_m - right->off_m).norm();
    }
    if (readings[from].fix_class == kFixedClass) return;
    for (std::size_t i = from; i < end;) {
        std::size_t after = i + 1;
        while (after < end && (doubted_m[after] > 0.0) == (doubted_m[i] > 0.0)) ++after;
        if (readings[after - 1].time_s - readings[i].time_s > kLongestDoubt_s) {
            std::fill(doubted_m.begin() + static_cast<std::ptrdiff_t>(i),
                      doubted_m.begin() + static_cast<std::ptrdiff_t>(after), 0.0);
        }
        i = after;
    }
}

}  // namespace

std::vector<double> gnssJumps(std::span<const GnssReading> readings) {
    const std::vector<bool> spike = spikes(readings);
    std::vector<GnssReading> sound;
    std::vector<std::size_t> last_sound;  // among them, up to each reading; the first before there is any
    for (std::size_t i = 0; i < readings.size(); ++i) {
        if (!spike[i]) sound.push_back(readings[i]);
        last_sound.push_back(std::max<std::size_t>(sound.size(), 1) - 1);
    }
    const std::vector<Eigen::Vector2d> jump_m = jumpsBefore(sound);
    std::vector<double> stretch_m(sound.size(), 0.0);
    for (std::size_t from = 0; from < sound.size();) {
        std::size_t end = from + 1;
        while (end < sound.size() && sound[end].fix_class == sound[from].fix_class) ++end;
        doubtStretches(sound, jump_m, from, end, stretch_m);
        from = end;
    }
    std::vector<double> doubted_m(readings.size(), 0.0);
    for (std::size_t i = 0; i < readings.size() && !sound.empty(); ++i) {
        doubted_m[i] = stretch_m[last_sound[i]];
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
