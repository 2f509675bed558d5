#include "fusion/run_reference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "fusion/barometer.hpp"
#include "survey/mark_stands.hpp"
#include "survey/upper_median.hpp"

namespace terrawalk {

namespace {

constexpr double kUnknownStart_m = 300.0;    // sigma of a start that only a later mark will tell
constexpr double kStartSigma_m = 0.01;       // sigma of a start that defines the frame
constexpr double kHeldHeightSigma_m = 10.0;  // sigma of a height that nothing measures
constexpr double kRecordGap_s = 5.0;
constexpr double kNotableSilence_s = 60.0;     // of GNSS
constexpr double kContradiction = 7.0;         // sigmas between a mark and what a sensor says of it
constexpr double kLeastContradiction_m = 2.5;  // weather moves a barometer by more than its sigma says

double squared(double x) {
    return x * x;
}

struct Weighted {
    double value = 0.0;
    double weight = 1.0;  // > 0
};

// Half of the weight lies on either side; missing without values.
double median(std::vector<Weighted> values) {
    std::sort(values.begin(), values.end(),
              [](const Weighted& a, const Weighted& b) { return a.value < b.value; });
    double total = 0.0;
    for (const Weighted& v : values) total += v.weight;
    double below = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        below += values[i].weight;
        if (2.0 * below > total || i + 1 == values.size()) return values[i].value;
        if (2.0 * below == total) return 0.5 * (values[i].value + values[i + 1].value);
    }
    return kMissing;
}

// Where a barometer reads zero, and how surely.
struct BarometerZero {
    double height_m = 0.0;
    double time_s = 0.0;
    double variance_m2 = 0.0;
};

class ReferenceFinder {
  public:
    ReferenceFinder(const Survey& survey, const Run& run, const FusionOptions& options,
                    const std::vector<EpochAttitude>& attitudes, RunNotes& notes)
        : survey_(survey),
          run_(run),
          log_(run.log),
          options_(options),
          frame_(survey.frame()),
          attitudes_(attitudes),
          notes_(notes) {}

    Result<RunReference> find() {
        surveySensors();
        tieToMarks();
        if (!reference_.has_horizontal) {
            return badData(fmt::format("run {}: nothing in the log tells a position", run_.id), log_.file, 0,
                           "a log needs GNSS positions or velocities, or optical flow with heading");
        }
        zeroBarometer();
        chooseGnssHeight();
        placeStart();
        noteMissing();
        noteContradictions();
        return std::move(reference_);
    }

  private:
    struct GnssEpoch {
        Eigen::Vector3d enu_m;
        GnssQuality quality;
        double variance_up_m2 = 0.0;
    };

    std::optional<GnssEpoch> gnss(std::size_t i) const {
        const auto position = gnssPosition(log_, i, frame_, attitudes_[i], 0.0);
        if (!position) return std::nullopt;
        const GnssQuality quality = gnssQuality(log_, i, options_.gnss);
        if (!quality.rejection.empty()) return std::nullopt;
        return GnssEpoch{position->enu_m, quality,
                         squared(quality.sigma_up_m) + position->arm_variance_up_m2};
    }

    void surveySensors() {
        double pressure_s = log_.time_s.front();
        double gnss_silence_s = 0.0;
        for (std::size_t i = 0; i < log_.size(); ++i) {
            // Where there are no records at all, that is another matter.
            if (i > 0) gnss_silence_s += std::min(log_.time_s[i] - log_.time_s[i - 1], kRecordGap_s);
            if (const auto epoch = gnss(i)) {
                has_gnss_ = true;
                gnss_silence_s = 0.0;
                if (present(epoch->enu_m.z())) {
                    has_gnss_height_ = true;
                    (epoch->quality.rtk ? has_rtk_height_ : has_other_height_) = true;
                }
                if (!attitudes_[i].heading_known) ++fixes_without_heading_;
            }
            has_doppler_ = has_doppler_ || (present(log_.value(Channel::GnssVelocityEast, i)) &&
                                            present(log_.value(Channel::GnssVelocityNorth, i)));
            has_flow_ =
                has_flow_ || (present(log_.value(Channel::FlowForward, i)) &&
                              present(log_.value(Channel::FlowLeft, i)) && attitudes_[i].heading_known);
            if (std::isfinite(barometricHeight(i))) {
                has_pressure_ = true;
                pressure_s = log_.time_s[i];
            }
            longest_silence_s_ = std::max(longest_silence_s_, log_.time_s[i] - pressure_s);
            longest_gnss_silence_s_ = std::max(longest_gnss_silence_s_, gnss_silence_s);
            has_range_ = has_range_ || present(log_.value(Channel::Range, i));
        }
        const bool raw = options_.method == FusionMethod::Raw;
        reference_.has_horizontal = (has_gnss_ && (raw || options_.gnss.use_position)) ||
                                    (has_doppler_ && options_.gnss.use_velocity) ||
                                    (has_flow_ && options_.flow.use);
    }

    std::vector<std::size_t> epochsWithin(double from_s, double to_s) const {
        const auto first = std::lower_bound(log_.time_s.begin(), log_.time_s.end(), from_s);
        const auto last = std::upper_bound(log_.time_s.begin(), log_.time_s.end(), to_s);
        std::vector<std::size_t> epochs;
        for (auto it = first; it < last; ++it) {
            epochs.push_back(static_cast<std::size_t>(it - log_.time_s.begin()));
        }
        return epochs;
    }

    double medianHeightAboveGround(const std::vector<std::size_t>& epochs) const {
        std::vector<double> heights;
        for (const std::size_t i : epochs) {
            const double height_m = heightAboveGround(log_, i, attitudes_[i].attitude, options_.ties);
            if (present(height_m)) heights.push_back(height_m);
        }
        if (heights.empty()) return kMissing;
        // Of an even number the upper one: what stands in the way only shortens a range, and the mean of two
        // that differ would be near neither.
        return upperMedian(heights);
    }

    // Of a stand as a whole: the hand moves less than grass shortens single ranges.
    double standHeight(const std::vector<std::size_t>& epochs, double median_m) const {
        std::vector<double> heights;
        for (const std::size_t i : epochs) {
            const double height_m = heightAboveGround(log_, i, attitudes_[i].attitude, options_.ties);
            if (std::abs(height_m - median_m) <= options_.ties.range_tolerance_m) heights.push_back(height_m);
        }
        return heightThroughGrass(heights);
    }

    void tieToMarks() {
        for (const MarkStand& stand : markStands(survey_, run_, options_.stands)) {
            if (!stand.may_tie) continue;
            const std::vector<std::size_t> epochs = epochsWithin(stand.from_s, stand.to_s);
            if (epochs.empty()) {
                notes_.limitations.push_back(
                    fmt::format("no epoch while the array stood on {}", stand.mark.name));
                continue;
            }
            if (stand.place == StandPlace::Start) reference_.starts_on_mark = true;
            tieStand(stand, epochs);
        }
        std::stable_sort(reference_.ties.begin(), reference_.ties.end(),
                         [](const MarkTie& a, const MarkTie& b) { return a.epoch < b.epoch; });
    }

    void tieStand(const MarkStand& stand, const std::vector<std::size_t>& epochs) {
        const TieOptions& ties = options_.ties;
        const double median_m = medianHeightAboveGround(epochs);
        const bool measured = present(median_m);
        if (!measured) {
            notes_.limitations.push_back(
                fmt::format("no range while the array stood on {}: its height above the mark is taken "
                            "to be {} m",
                            stand.mark.name, ties.assumed_height_m));
        }
        const double through_grass_m = standHeight(epochs, median_m);
        // What all epochs of a stand share does not average out: it enters each of them times their number.
        const double n = static_cast<double>(epochs.size());
        const double shared_h = n * squared(stand.mark.sigma_h_m);
        const double shared_v =
            n * (squared(stand.mark.sigma_v_m) + (measured ? 0.0 : squared(ties.assumed_height_sigma_m)));
        double before_s = -std::numeric_limits<double>::infinity();
        for (const std::size_t i : epochs) {
            const double own_m = heightAboveGround(log_, i, attitudes_[i].attitude, options_.ties);
            const double height_m = measured ? through_grass_m : ties.assumed_height_m;
            const double factor = whiteNoiseFactor(ties.correlation_s, log_.time_s[i] - before_s);
            before_s = log_.time_s[i];
            MarkTie tie;
            tie.epoch = i;
            tie.has_height = !measured || std::abs(own_m - median_m) <= ties.range_tolerance_m;
            tie.array_enu_m = stand.mark.enu_m + height_m * Eigen::Vector3d::UnitZ();
            const double h = factor * squared(ties.sigma_m) + shared_h;
            tie.variance_m2 << h, h, factor * squared(ties.range_sigma_m) + shared_v;
            reference_.ties.push_back(tie);
        }
    }

    double barometricHeight(std::size_t i) const {
        return options_.barometer.scale * isaHeight(log_.value(Channel::Pressure, i));
    }

    void zeroBarometer() {
        if (!has_pressure_ || !(options_.barometer.use || options_.method == FusionMethod::Raw)) return;
        const BarometerZero zero = barometerZero();
        reference_.barometer_zero_m = zero.height_m;
        reference_.barometer_zero_time_s = zero.time_s;
        reference_.height_reference_variance_m2 = zero.variance_m2;
    }

    BarometerZero barometerZero() {
        if (const auto on_mark = zeroOnMark()) return *on_mark;
        const auto near_mark = zeroNearMark();
        const auto by_gnss = zeroByGnss();
        if (near_mark && !(by_gnss && by_gnss->variance_m2 < near_mark->variance_m2)) {
            notes_.limitations.push_back(
                fmt::format("the barometer was silent on the marks: it is zeroed {:.1f} s away from one",
                            near_mark_apart_s_));
            return *near_mark;
        }
        if (by_gnss) {
            notes_.limitations.push_back(
                "no known mark to zero the barometer on: it is tied to the median GNSS height of the run");
            return *by_gnss;
        }
        return zeroOnGround();
    }

    // Of a mean over readings that follow one another for so long: gusts average out slowly.
    double meanVariance(double n, double lasting_s) const {
        const BarometerOptions& barometer = options_.barometer;
        return squared(barometer.sigma_m) / n +
               squared(barometer.gust_sigma_m) /
                   std::max(1.0, 0.5 * lasting_s / std::max(barometer.gust_correlation_s, 1e-9));
    }

    std::optional<BarometerZero> zeroOnMark() const {
        double sum_m = 0.0;
        double tie_variance_m2 = 0.0;
        double n = 0.0;
        double first_s = 0.0;
        double last_s = 0.0;
        for (const MarkTie& tie : reference_.ties) {
            const double time_s = log_.time_s[tie.epoch];
            // Ties that follow within a second belong to the same stand.
            if (n > 0.0 && time_s - last_s > 1.0) break;
            const double height_m = barometricHeight(tie.epoch);
            if (!tie.has_height || !std::isfinite(height_m)) continue;
            if (n == 0.0) first_s = time_s;
            last_s = time_s;
            sum_m += height_m - levelHeight(tie.array_enu_m);
            tie_variance_m2 += tie.variance_m2.z();
            n += 1.0;
        }
        if (n == 0.0) return std::nullopt;
        return BarometerZero{sum_m / n, 0.5 * (first_s + last_s),
                             tie_variance_m2 / squared(n) + meanVariance(n, last_s - first_s)};
    }

    // The barometer was silent on every mark: its reading nearest in time to one of them.
    std::optional<BarometerZero> zeroNearMark() {
        std::vector<std::size_t> readings;
        for (std::size_t i = 0; i < log_.size(); ++i) {
            if (std::isfinite(barometricHeight(i))) readings.push_back(i);
        }
        std::optional<BarometerZero> nearest;
        near_mark_apart_s_ = std::numeric_limits<double>::infinity();
        for (const MarkTie& tie : reference_.ties) {
            if (!tie.has_height) continue;
            const auto after = std::lower_bound(readings.begin(), readings.end(), tie.epoch);
            for (auto it = after == readings.begin() ? after : after - 1; it != readings.end() && it <= after;
                 ++it) {
                const double apart_s = std::abs(log_.time_s[*it] - log_.time_s[tie.epoch]);
                if (apart_s >= near_mark_apart_s_) continue;
                near_mark_apart_s_ = apart_s;
                nearest =
                    BarometerZero{barometricHeight(*it) - levelHeight(tie.array_enu_m), log_.time_s[*it],
                                  tie.variance_m2.z() + meanVariance(1.0, 0.0) +
                                      squared(0.5 * options_.initial.walking_speed_mps * apart_s)};
            }
        }
        return nearest;
    }

    // The median forgives what the mean does not: fixes that are wrong and do not know it.
    std::optional<BarometerZero> zeroByGnss() const {
        if (!has_gnss_height_ || options_.gnss.use_height == GnssHeightUse::Never) return std::nullopt;
        std::vector<Weighted> zeros;
        double weighted_time = 0.0;
        double weights = 0.0;
        double information = 0.0;
        double before_s = -std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < log_.size(); ++i) {
            const double height_m = barometricHeight(i);
            const auto epoch = gnss(i);
            if (!epoch || !present(epoch->enu_m.z()) || !std::isfinite(height_m)) continue;
            const double factor = whiteNoiseFactor(epoch->quality.correlation_s, log_.time_s[i] - before_s);
            before_s = log_.time_s[i];
            const double weight = 1.0 / epoch->variance_up_m2;
            zeros.push_back({height_m - levelHeight(epoch->enu_m), weight});
            weighted_time += weight * log_.time_s[i];
            weights += weight;
            information += weight / factor;
        }
        if (zeros.empty()) return std::nullopt;
        return BarometerZero{median(std::move(zeros)), weighted_time / weights, 1.0 / information};
    }

    BarometerZero zeroOnGround() {
        std::size_t first = 0;
        while (!std::isfinite(barometricHeight(first))) ++first;
        const double first_s = log_.time_s[first];
        double sum_m = 0.0;
        double n = 0.0;
        double last_s = first_s;
        for (const std::size_t i : epochsWithin(first_s, first_s + options_.stands.start_s)) {
            const double height_m = barometricHeight(i);
            if (!std::isfinite(height_m)) continue;
            sum_m += height_m;
            n += 1.0;
            last_s = log_.time_s[i];
        }
        const double array_m = startHeightAboveGround();
        const double array_sigma_m =
            start_range_known_ ? options_.ties.range_sigma_m : options_.ties.assumed_height_sigma_m;
        return {sum_m / n - array_m, first_s, squared(array_sigma_m) + meanVariance(n, last_s - first_s)};
    }

    static double levelHeight(const Eigen::Vector3d& enu_m) { return enu_m.z() + levelDrop(enu_m); }

    // Height of the array in the first seconds when the ground below it is height 0; says so once.
    double startHeightAboveGround() {
        if (!start_height_m_) {
            const double from_s = log_.time_s.front();
            const double measured_m =
                medianHeightAboveGround(epochsWithin(from_s, from_s + options_.stands.start_s));
            start_range_known_ = present(measured_m);
            start_height_m_ = start_range_known_ ? measured_m : options_.ties.assumed_height_m;
            notes_.limitations.push_back(
                start_range_known_
                    ? "no known mark and no GNSS height: the ground below the start of the run is height 0"
                    : fmt::format("no known mark, GNSS height or range at the start: the array is taken to "
                                  "start {} m "
                                  "above height 0",
                                  options_.ties.assumed_height_m));
        }
        return *start_height_m_;
    }

    void chooseGnssHeight() {
        reference_.gnss_height = options_.gnss.use_height;
        if (!reference_.barometer_zero_m && reference_.gnss_height == GnssHeightUse::Rtk &&
            has_other_height_) {
            reference_.gnss_height = GnssHeightUse::Always;
            notes_.limitations.push_back("no barometer in use: GNSS height is used whatever the fix");
        }
        const bool gnss_height = (reference_.gnss_height == GnssHeightUse::Always && has_gnss_height_) ||
                                 (reference_.gnss_height == GnssHeightUse::Rtk && has_rtk_height_);
        reference_.has_height = reference_.barometer_zero_m.has_value() || gnss_height;
        if (reference_.barometer_zero_m && longest_silence_s_ > options_.barometer.longest_silence_s) {
            notes_.limitations.push_back(
                fmt::format("the barometer was silent for up to {:.0f} s: {}", longest_silence_s_,
                            has_gnss_height_ && reference_.gnss_height != GnssHeightUse::Never
                                ? "GNSS height of any fix stands in there"
                                : "nothing measures height there, the walk is taken to climb little"));
        }
        if (!reference_.has_height) {
            reference_.height_reference_variance_m2 = squared(kHeldHeightSigma_m);
            notes_.limitations.push_back(
                "nothing in the log measures height: it is held near that of the start");
        }
    }

    double horizontalSpeed(std::size_t i) const {
        const double flow = std::hypot(log_.value(Channel::FlowForward, i), log_.value(Channel::FlowLeft, i));
        if (present(flow)) return flow;
        return std::hypot(log_.value(Channel::GnssVelocityEast, i),
                          log_.value(Channel::GnssVelocityNorth, i));
    }

    void placeStart() {
        if (reference_.starts_on_mark) {
            const MarkTie& tie = reference_.ties.front();
            reference_.start_enu_m = tie.array_enu_m;
            reference_.start_sigma_m.setConstant(options_.initial.position_sigma_m);
            return;
        }
        const bool gnss_used = options_.gnss.use_position || options_.method == FusionMethod::Raw;
        if (!(has_gnss_ && gnss_used && placeStartByGnss())) {
            const bool told_later = !reference_.ties.empty();
            reference_.start_sigma_m.setConstant(told_later ? kUnknownStart_m : kStartSigma_m);
            notes_.limitations.push_back(
                told_later ? "no GNSS position and no start mark: the way to the first mark is placed "
                             "backwards from it"
                           : "no GNSS position and no known mark: the run starts at the origin, its "
                             "place on the ground is unknown");
        }
        placeStartHeight();
    }

    bool placeStartByGnss() {
        std::size_t first = 0;
        while (first < log_.size() && !gnss(first)) ++first;
        if (first == log_.size()) return false;
        Eigen::Vector2d sum = Eigen::Vector2d::Zero();
        double n = 0.0;
        // The mean of the first seconds, as long as nothing says that the array moved.
        for (const std::size_t i :
             epochsWithin(log_.time_s[first], log_.time_s[first] + options_.stands.start_s)) {
            if (i > first && !(horizontalSpeed(i) < options_.initial.still_speed_mps)) break;
            if (const auto epoch = gnss(i)) {
                sum += epoch->enu_m.head<2>();
                n += 1.0;
            }
        }
        reference_.start_enu_m.head<2>() = sum / n;
        // A fix that comes late says less about where the run began.
        const double age_s = log_.time_s[first] - log_.time_s.front();
        // Wide, because the filter reads the same fixes again.
        reference_.start_sigma_m.setConstant(
            std::hypot(options_.initial.position_sigma_m, options_.initial.walking_speed_mps * age_s));
        if (age_s > options_.stands.start_s) {
            notes_.limitations.push_back(
                fmt::format("no GNSS position in the first {:.1f} s, so the start is less sure", age_s));
        }
        return true;
    }

    void placeStartHeight() {
        double& up_m = reference_.start_enu_m.z();
        reference_.start_sigma_m.z() = options_.initial.position_sigma_m;
        if (reference_.barometer_zero_m) {
            for (std::size_t i = 0; i < log_.size(); ++i) {
                if (!std::isfinite(barometricHeight(i))) continue;
                up_m = reference_.barometricUp(log_.value(Channel::Pressure, i), options_.barometer.scale,
                                               reference_.start_enu_m);
                return;
            }
        }
        if (reference_.has_height) {
            for (std::size_t i = 0; i < log_.size(); ++i) {
                const auto epoch = gnss(i);
                if (!epoch || !present(epoch->enu_m.z())) continue;
                if (reference_.gnss_height == GnssHeightUse::Rtk && !epoch->quality.rtk) continue;
                up_m = epoch->enu_m.z();
                return;
            }
        }
        up_m = startHeightAboveGround();
    }

    void noteMissing() {
        if (!has_gnss_) {
            notes_.limitations.push_back("no GNSS position");
        } else if (longest_gnss_silence_s_ > kNotableSilence_s) {
            notes_.limitations.push_back(
                fmt::format("no GNSS position for {:.0f} s", longest_gnss_silence_s_));
        }
        if (!has_flow_) notes_.limitations.push_back("no optical flow that could be rotated to the ground");
        if (!has_pressure_) notes_.limitations.push_back("no barometer");
        if (!has_range_) notes_.limitations.push_back("no range finder: this run gives no ground points");
        if (!log_.has(Channel::AccelerationX)) notes_.limitations.push_back("no accelerometer");
        if (fixes_without_heading_ > 0 && !log_.gnss_lever_arm_m.head<2>().isZero()) {
            notes_.limitations.push_back(
                fmt::format("no heading in {} GNSS epochs: the horizontal lever arm of the antenna is not "
                            "removed there but counted as variance",
                            fixes_without_heading_));
        }
        if (has_gnss_ && !log_.has(Channel::Fix)) {
            notes_.limitations.push_back("the log names no fix: every GNSS position counts as single");
        }
    }

    // A mark with the wrong name or coordinates pulls the track along: what the other sensors say of it must
    // be seen.
    void noteContradictions() {
        for (const MarkStand& stand : markStands(survey_, run_, options_.stands)) {
            if (!stand.may_tie) continue;
            const std::vector<std::size_t> epochs = epochsWithin(stand.from_s, stand.to_s);
            noteGnssAgainst(stand, epochs);
            noteBarometerAgainst(stand);
        }
    }

    void noteGnssAgainst(const MarkStand& stand, const std::vector<std::size_t>& epochs) {
        std::vector<Weighted> east, north;
        double sigma_m = 0.0;
        for (const std::size_t i : epochs) {
            const auto epoch = gnss(i);
            if (!epoch) continue;
            east.push_back({epoch->enu_m.x()});
            north.push_back({epoch->enu_m.y()});
            sigma_m = std::max(sigma_m, epoch->quality.sigma_m);
        }
        if (east.empty()) return;
        const Eigen::Vector2d gnss_m(median(std::move(east)), median(std::move(north)));
        const double apart_m = (gnss_m - stand.mark.enu_m.head<2>()).norm();
        if (apart_m <= kContradiction * std::hypot(sigma_m, options_.ties.sigma_m, stand.mark.sigma_h_m)) {
            return;
        }
        notes_.limitations.push_back(
            fmt::format("GNSS is {:.1f} m away from mark {} on which the array stands at {:.0f} s: check "
                        "the name and the coordinates of the mark",
                        apart_m, stand.mark.name, stand.from_s));
    }

    void noteBarometerAgainst(const MarkStand& stand) {
        if (!reference_.barometer_zero_m) return;
        std::vector<Weighted> off_m;
        double variance_m2 = reference_.height_reference_variance_m2 + squared(options_.barometer.sigma_m) +
                             squared(options_.barometer.gust_sigma_m);
        for (const MarkTie& tie : reference_.ties) {
            const double time_s = log_.time_s[tie.epoch];
            if (time_s < stand.from_s || time_s > stand.to_s) continue;
            if (!tie.has_height || !std::isfinite(barometricHeight(tie.epoch))) continue;
            const double up_m = reference_.barometricUp(log_.value(Channel::Pressure, tie.epoch),
                                                        options_.barometer.scale, tie.array_enu_m);
            off_m.push_back({up_m - tie.array_enu_m.z()});
        }
        if (off_m.empty()) return;
        variance_m2 += squared(stand.mark.sigma_v_m) + squared(options_.ties.range_sigma_m) +
                       squared(options_.barometer.drift_m_per_sqrt_min) *
                           std::abs(stand.from_s - reference_.barometer_zero_time_s) / 60.0;
        const double median_m = median(std::move(off_m));
        if (std::abs(median_m) <= std::max(kContradiction * std::sqrt(variance_m2), kLeastContradiction_m)) {
            return;
        }
        notes_.limitations.push_back(fmt::format(
            "the barometer puts mark {} {:.1f} m {} its height at {:.0f} s: check the name "
            "and the coordinates of the mark",
            stand.mark.name, std::abs(median_m), median_m > 0.0 ? "above" : "below", stand.from_s));
    }

    const Survey& survey_;
    const Run& run_;
    const ArrayLog& log_;
    const FusionOptions& options_;
    const LocalFrame frame_;
    const std::vector<EpochAttitude>& attitudes_;
    RunNotes& notes_;
    RunReference reference_;
    std::optional<double> start_height_m_;
    bool has_gnss_ = false;
    bool has_gnss_height_ = false;
    bool has_rtk_height_ = false;
    bool has_other_height_ = false;  // from fixes that are not RTK
    bool start_range_known_ = false;
    std::size_t fixes_without_heading_ = 0;
    double near_mark_apart_s_ = 0.0;
    double longest_silence_s_ = 0.0;  // of the barometer
    double longest_gnss_silence_s_ = 0.0;
    bool has_doppler_ = false;
    bool has_flow_ = false;
    bool has_pressure_ = false;
    bool has_range_ = false;
};

}  // namespace

Result<RunReference> runReference(const Survey& survey, const Run& run, const FusionOptions& options,
                                  const std::vector<EpochAttitude>& attitudes, RunNotes& notes) {
    return ReferenceFinder(survey, run, options, attitudes, notes).find();
}

}  // namespace terrawalk
