#include "fusion/run_reference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "fusion/barometer.hpp"
#include "survey/mark_stands.hpp"

namespace terrawalk {

namespace {

constexpr double kUnknownStart_m = 300.0;  // sigma of a start that only a later mark will tell
constexpr double kStartSigma_m = 0.01;     // sigma of a start that defines the frame

double squared(double x) {
    return x * x;
}

double median(std::vector<double> values) {
    if (values.empty()) return kMissing;
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    if (values.size() % 2 == 1) return *middle;
    return 0.5 * (*middle + *std::max_element(values.begin(), middle));
}

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
        return std::move(reference_);
    }

  private:
    struct GnssEpoch {
        Eigen::Vector3d enu_m;
        GnssQuality quality;
    };

    std::optional<GnssEpoch> gnss(std::size_t i) const {
        const auto position = gnssPosition(log_, i, frame_, attitudes_[i].attitude, 0.0);
        if (!position) return std::nullopt;
        const GnssQuality quality = gnssQuality(log_, i, options_.gnss);
        if (!quality.rejection.empty()) return std::nullopt;
        return GnssEpoch{*position, quality};
    }

    void surveySensors() {
        for (std::size_t i = 0; i < log_.size(); ++i) {
            if (const auto epoch = gnss(i)) {
                has_gnss_ = true;
                has_gnss_height_ = has_gnss_height_ || present(epoch->enu_m.z());
                has_rtk_height_ = has_rtk_height_ || (epoch->quality.rtk && present(epoch->enu_m.z()));
            }
            has_doppler_ = has_doppler_ || (present(log_.value(Channel::GnssVelocityEast, i)) &&
                                            present(log_.value(Channel::GnssVelocityNorth, i)));
            has_flow_ =
                has_flow_ || (present(log_.value(Channel::FlowForward, i)) &&
                              present(log_.value(Channel::FlowLeft, i)) && attitudes_[i].heading_known);
            has_pressure_ = has_pressure_ || std::isfinite(isaHeight(log_.value(Channel::Pressure, i)));
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
        return median(std::move(heights));
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
        // What all epochs of a stand share does not average out: it enters each of them times their number.
        const double n = static_cast<double>(epochs.size());
        const double shared_h = n * squared(stand.mark.sigma_h_m);
        const double shared_v =
            n * (squared(stand.mark.sigma_v_m) + (measured ? 0.0 : squared(ties.assumed_height_sigma_m)));
        double before_s = -std::numeric_limits<double>::infinity();
        for (const std::size_t i : epochs) {
            const double own_m = heightAboveGround(log_, i, attitudes_[i].attitude, options_.ties);
            const double height_m = measured ? own_m : ties.assumed_height_m;
            const double factor = whiteNoiseFactor(ties.correlation_s, log_.time_s[i] - before_s);
            before_s = log_.time_s[i];
            MarkTie tie;
            tie.epoch = i;
            tie.has_height = !measured || std::abs(own_m - median_m) <= ties.range_tolerance_m;
            tie.array_enu_m = stand.mark.enu_m + (tie.has_height ? height_m : 0.0) * Eigen::Vector3d::UnitZ();
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
        if (zeroBarometerOnMark()) return;
        if (zeroBarometerByGnss()) return;
        zeroBarometerOnGround();
    }

    bool zeroBarometerOnMark() {
        double sum_m = 0.0;
        std::size_t n = 0;
        double first_s = 0.0;
        double last_s = 0.0;
        for (const MarkTie& tie : reference_.ties) {
            const double time_s = log_.time_s[tie.epoch];
            // Ties that follow within a second belong to the same stand.
            if (n > 0 && time_s - last_s > 1.0) break;
            const double height_m = barometricHeight(tie.epoch);
            if (!tie.has_height || !std::isfinite(height_m)) continue;
            if (n == 0) first_s = time_s;
            last_s = time_s;
            sum_m += height_m - tie.array_enu_m.z();
            ++n;
        }
        if (n == 0) return zeroBarometerNearMark();
        reference_.barometer_zero_m = sum_m / static_cast<double>(n);
        reference_.barometer_zero_time_s = 0.5 * (first_s + last_s);
        return true;
    }

    // The barometer was silent on every mark: its reading nearest in time to the first one must do.
    bool zeroBarometerNearMark() {
        const auto tie = std::find_if(reference_.ties.begin(), reference_.ties.end(),
                                      [](const MarkTie& t) { return t.has_height; });
        if (tie == reference_.ties.end()) return false;
        const double tie_s = log_.time_s[tie->epoch];
        double nearest_s = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < log_.size(); ++i) {
            const double height_m = barometricHeight(i);
            const double apart_s = std::abs(log_.time_s[i] - tie_s);
            if (!std::isfinite(height_m) || apart_s >= nearest_s) continue;
            nearest_s = apart_s;
            reference_.barometer_zero_m = height_m - tie->array_enu_m.z();
            reference_.barometer_zero_time_s = log_.time_s[i];
        }
        notes_.limitations.push_back(fmt::format(
            "the barometer was silent on the marks: it is zeroed {:.1f} s away from one", nearest_s));
        return true;
    }

    bool zeroBarometerByGnss() {
        if (!has_gnss_height_ || options_.gnss.use_height == GnssHeightUse::Never) return false;
        double sum_m = 0.0;
        double sum_time = 0.0;
        double weights = 0.0;
        for (std::size_t i = 0; i < log_.size(); ++i) {
            const double height_m = barometricHeight(i);
            const auto epoch = gnss(i);
            if (!epoch || !present(epoch->enu_m.z()) || !std::isfinite(height_m)) continue;
            const double weight = 1.0 / squared(epoch->quality.sigma_up_m);
            sum_m += weight * (height_m - epoch->enu_m.z());
            sum_time += weight * log_.time_s[i];
            weights += weight;
        }
        if (weights == 0.0) return false;
        reference_.barometer_zero_m = sum_m / weights;
        reference_.barometer_zero_time_s = sum_time / weights;
        notes_.limitations.push_back(
            "no known mark to zero the barometer on: it is tied to the mean GNSS height of the run");
        return true;
    }

    void zeroBarometerOnGround() {
        const auto first = std::find_if(
            log_.time_s.begin(), log_.time_s.end(),
            [&, i = std::size_t{0}](double) mutable { return std::isfinite(barometricHeight(i++)); });
        const std::vector<std::size_t> epochs = epochsWithin(*first, *first + options_.stands.start_s);
        double sum_m = 0.0;
        std::size_t n = 0;
        for (const std::size_t i : epochs) {
            const double height_m = barometricHeight(i);
            if (!std::isfinite(height_m)) continue;
            sum_m += height_m;
            ++n;
        }
        reference_.barometer_zero_m = sum_m / static_cast<double>(n) - startHeightAboveGround();
        reference_.barometer_zero_time_s = *first;
    }

    // Height of the array in the first seconds when the ground below it is height 0; says so once.
    double startHeightAboveGround() {
        if (!start_height_m_) {
            const double from_s = log_.time_s.front();
            const double measured_m =
                medianHeightAboveGround(epochsWithin(from_s, from_s + options_.stands.start_s));
            start_height_m_ = present(measured_m) ? measured_m : options_.ties.assumed_height_m;
            notes_.limitations.push_back(
                present(measured_m)
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
            has_gnss_height_ && !has_rtk_height_) {
            reference_.gnss_height = GnssHeightUse::Always;
            notes_.limitations.push_back("no barometer and no RTK fix: GNSS height is used whatever the fix");
        }
        const bool gnss_height = (reference_.gnss_height == GnssHeightUse::Always && has_gnss_height_) ||
                                 (reference_.gnss_height == GnssHeightUse::Rtk && has_rtk_height_);
        reference_.has_height = reference_.barometer_zero_m.has_value() || gnss_height;
        if (!reference_.has_height) {
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
        const GnssEpoch first_fix = *gnss(first);
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
        const double sigma_m =
            std::hypot(first_fix.quality.sigma_m, options_.initial.walking_speed_mps * age_s);
        reference_.start_sigma_m.setConstant(sigma_m);
        if (age_s > 0.0) {
            notes_.limitations.push_back(
                fmt::format("first GNSS position {:.1f} s after the start of the log", age_s));
        }
        return true;
    }

    void placeStartHeight() {
        double& up_m = reference_.start_enu_m.z();
        reference_.start_sigma_m.z() = options_.initial.position_sigma_m;
        if (reference_.barometer_zero_m) {
            for (std::size_t i = 0; i < log_.size(); ++i) {
                const double height_m = barometricHeight(i) - *reference_.barometer_zero_m;
                if (!std::isfinite(height_m)) continue;
                up_m = height_m;
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
        if (!has_gnss_) notes_.limitations.push_back("no GNSS position");
        if (!has_flow_) notes_.limitations.push_back("no optical flow that could be rotated to the ground");
        if (!has_pressure_) notes_.limitations.push_back("no barometer");
        if (!has_range_) notes_.limitations.push_back("no range finder: this run gives no ground points");
        if (!log_.has(Channel::AccelerationX)) notes_.limitations.push_back("no accelerometer");
        if (has_gnss_ && !log_.has(Channel::Fix)) {
            notes_.limitations.push_back("the log names no fix: every GNSS position counts as single");
        }
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
