#include "fusion/disturbance.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <span>
#include <vector>

#include "fusion/barometer.hpp"
#include "fusion/random_numbers.hpp"
#include "fusion/random_processes.hpp"
#include "survey/frames.hpp"
#include "survey/gnss_channels.hpp"
#include "survey/survey.hpp"

namespace terrawalk {
namespace {

constexpr std::uint64_t kDisturbanceStream = 0x6469737475726221ULL;
constexpr std::uint64_t kWholeSurvey = ~std::uint64_t{0};  // run number of what all runs share
constexpr double kUsualStep_s = 0.2;                       // where a log does not say its own

constexpr std::array kBarometer{Channel::Pressure, Channel::Temperature};
constexpr std::array kFlow{Channel::FlowForward, Channel::FlowLeft, Channel::FlowQuality};
constexpr std::array kHeading{Channel::Heading};
constexpr std::array kAccelerations{Channel::AccelerationX, Channel::AccelerationY, Channel::AccelerationZ};
constexpr std::array kRates{Channel::AngularRateX, Channel::AngularRateY, Channel::AngularRateZ};

/// One run's log on its way to be disturbed.
class DisturbedLog {
  public:
    DisturbedLog(ArrayLog& log, const LocalFrame& frame, Disturbance disturbance, std::uint64_t seed,
                 std::uint64_t run)
        : log_(log),
          frame_(frame),
          key_{seed, kDisturbanceStream, static_cast<std::uint64_t>(disturbance)},
          run_(run),
          step_s_(present(log.sample_interval_s) ? log.sample_interval_s : kUsualStep_s) {}

    [[nodiscard]] std::size_t size() const { return log_.size(); }
    [[nodiscard]] double time_s(std::size_t i) const { return log_.time_s[i] - log_.time_s.front(); }

    /// @param purpose  tells several streams of one disturbance apart
    [[nodiscard]] RandomNumbers random(std::uint64_t purpose = 0) const { return stream(run_, purpose); }
    [[nodiscard]] RandomNumbers surveyRandom() const { return stream(kWholeSurvey, 0); }
    [[nodiscard]] GaussMarkov gaussMarkov(double correlation_s, std::uint64_t purpose) const {
        return {correlation_s, step_s_, random(purpose)};
    }
    [[nodiscard]] Bursts bursts(double per_min, Bursts::Length length, std::uint64_t purpose) const {
        return {per_min, length, step_s_, random(purpose)};
    }

    void add(Channel c, std::size_t i, double amount) {
        if (log_.has(c)) log_.column(c)[i] += amount;  // what is missing stays missing
    }
    void scale(Channel c, std::size_t i, double factor) {
        if (log_.has(c)) log_.column(c)[i] *= factor;
    }
    void replace(Channel c, std::size_t i, double value) {
        if (present(log_.value(c, i))) log_.column(c)[i] = value;
    }
    void silence(std::span<const Channel> channels, std::size_t i) {
        for (const Channel c : channels) replace(c, i, kMissing);
    }
    void silence(std::span<const Channel> channels) {
        for (const Channel c : channels) log_.column(c).clear();
    }

    void movePosition(std::size_t i, const Eigen::Vector3d& by_m) {
        if (!present(log_.value(Channel::Latitude, i))) return;
        Eigen::Vector3d enu_m =
            frame_.toEnu({log_.value(Channel::Latitude, i), log_.value(Channel::Longitude, i),
                          log_.value(Channel::EllipsoidalHeight, i)});
        const GeodeticPosition moved = frame_.toGeodetic(enu_m + by_m);
        log_.column(Channel::Latitude)[i] = moved.lat_deg;
        log_.column(Channel::Longitude)[i] = moved.lon_deg;
        log_.column(Channel::EllipsoidalHeight)[i] = moved.h_ell_m;
    }
    /// What the barometer reads as so much higher.
    void raiseBarometer(std::size_t i, double by_m) {
        const double here_m = frame_.zeroPoint().h_ell_m;
        add(Channel::Pressure, i, isaPressure(here_m + by_m) - isaPressure(here_m));
    }
    void turnHeading(std::size_t i, double by_rad) {
        if (!present(log_.value(Channel::Heading, i))) return;
        const double turned_rad = std::fmod(log_.value(Channel::Heading, i) + by_rad, 2.0 * kPi);
        log_.column(Channel::Heading)[i] = turned_rad < 0.0 ? turned_rad + 2.0 * kPi : turned_rad;
    }
    /// Each epoch gets what was read `by_s` earlier; the first ones nothing.
    void delay(std::span<const Channel> channels, double by_s) {
        for (const Channel c : channels) {
            if (!log_.has(c)) continue;
            std::vector<double>& column = log_.column(c);
            const std::vector<double> read = column;
            for (std::size_t i = 0; i < column.size(); ++i) {
                const auto then = std::upper_bound(log_.time_s.begin(), log_.time_s.end(),
                                                   log_.time_s[i] - by_s + 0.01 * step_s_);
                column[i] = then == log_.time_s.begin()
                                ? (c == Channel::Fix ? static_cast<double>(fix_code::kNone) : kMissing)
                                : read[static_cast<std::size_t>(then - log_.time_s.begin()) - 1];
            }
        }
    }

  private:
    [[nodiscard]] RandomNumbers stream(std::uint64_t run, std::uint64_t purpose) const {
        return RandomNumbers({key_[0], key_[1], key_[2], run, purpose});
    }

    ArrayLog& log_;
    const LocalFrame& frame_;
    std::array<std::uint64_t, 3> key_;
    std::uint64_t run_;
    double step_s_;
};

void gnssOutliers(DisturbedLog& log) {
    RandomNumbers random = log.random();
    for (std::size_t i = 0; i < log.size(); ++i) {
        if (random.chance(0.1)) log.movePosition(i, 6.0 * normals(random));
    }
}

void gnssOffset(DisturbedLog& log) {
    RandomNumbers random = log.surveyRandom();
    const double direction_rad = random.uniform(0.0, 2.0 * kPi);
    const Eigen::Vector3d offset_m(3.0 * std::cos(direction_rad), 3.0 * std::sin(direction_rad), 4.0);
    for (std::size_t i = 0; i < log.size(); ++i) log.movePosition(i, offset_m);
}

void gnssOffsetOfRun(DisturbedLog& log) {
    RandomNumbers random = log.random();
    const Eigen::Vector3d offset_m = 2.0 * normals(random);
    for (std::size_t i = 0; i < log.size(); ++i) log.movePosition(i, offset_m);
}

void gnssDrift(DisturbedLog& log) {
    GaussMarkov east = log.gaussMarkov(600.0, 0);
    GaussMarkov north = log.gaussMarkov(600.0, 1);
    GaussMarkov up = log.gaussMarkov(600.0, 2);
    for (std::size_t i = 0; i < log.size(); ++i) {
        const double e = east.next();
        const double n = north.next();
        log.movePosition(i, 2.0 * Eigen::Vector3d(e, n, up.next()));
    }
}

void barometerRamp(DisturbedLog& log) {
    RandomNumbers random = log.random();
    const double slope_mps = (random.chance(0.5) ? 3.0 : -3.0) / 3600.0;
    for (std::size_t i = 0; i < log.size(); ++i) log.raiseBarometer(i, slope_mps * log.time_s(i));
}

/// Calls `apply(epoch, value)` with a value that is zero at first and from then on drawn anew every
/// `period_s`.
template <class Apply>
void inSteps(DisturbedLog& log, double period_s, double size, Apply&& apply) {
    RandomNumbers random = log.random();
    double next_s = random.uniform(0.0, period_s);
    double value = 0.0;
    for (std::size_t i = 0; i < log.size(); ++i) {
        while (log.time_s(i) >= next_s) {
            value = size * random.normal();
            next_s += period_s;
        }
        apply(i, value);
    }
}

void barometerGusts(DisturbedLog& log) {
    Bursts bursts = log.bursts(0.4, {25.0, 35.0}, 0);
    RandomNumbers random = log.random(1);
    double gust_m = 0.0;
    for (std::size_t i = 0; i < log.size(); ++i) {
        const Bursts::State state = bursts.next();
        if (state.begins) gust_m = 0.6 * random.normal();
        if (state.active) log.raiseBarometer(i, gust_m);
    }
}

void flowZeros(DisturbedLog& log) {
    constexpr double kLength_s = 30.0;
    constexpr double kShare = 0.1;
    Bursts bursts = log.bursts(60.0 / kLength_s * kShare / (1.0 - kShare), {kLength_s, kLength_s}, 0);
    for (std::size_t i = 0; i < log.size(); ++i) {
        if (!bursts.next().active) continue;
        log.replace(Channel::FlowForward, i, 0.0);
        log.replace(Channel::FlowLeft, i, 0.0);
        log.replace(Channel::FlowQuality, i, 255.0);
    }
}

void flowScaleWander(DisturbedLog& log) {
    GaussMarkov wander = log.gaussMarkov(120.0, 0);
    for (std::size_t i = 0; i < log.size(); ++i) {
        const double factor = 1.0 + 0.1 * wander.next();
        log.scale(Channel::FlowForward, i, factor);
        log.scale(Channel::FlowLeft, i, factor);
    }
}

void flowSpikes(DisturbedLog& log) {
    RandomNumbers random = log.random();
    for (std::size_t i = 0; i < log.size(); ++i) {
        if (!random.chance(0.02)) continue;
        log.add(Channel::FlowForward, i, 3.0 * random.normal());
        log.add(Channel::FlowLeft, i, 3.0 * random.normal());
    }
}

void headingOffset(DisturbedLog& log) {
    const double offset_rad = radians(10.0) * log.random().normal();
    for (std::size_t i = 0; i < log.size(); ++i) log.turnHeading(i, offset_rad);
}

void rangeShort(DisturbedLog& log) {
    RandomNumbers random = log.random();
    for (std::size_t i = 0; i < log.size(); ++i) {
        if (random.chance(0.05)) log.add(Channel::Range, i, -random.uniform(0.2, 1.0));
    }
}

void scatteredSilence(DisturbedLog& log) {
    std::uint64_t purpose = 0;
    const auto silence = [&](std::initializer_list<std::span<const Channel>> sensor) {
        Bursts bursts = log.bursts(60.0, {0.4, 1.6}, purpose++);
        for (std::size_t i = 0; i < log.size(); ++i) {
            if (!bursts.next().active) continue;
            for (const auto& channels : sensor) log.silence(channels, i);
        }
    };
    silence({kGnssChannels});
    silence({kBarometer});
    silence({kFlow});
    silence({kHeading});
    silence({kAccelerations, kRates});
}

void heavyTails(DisturbedLog& log) {
    const double range_m = 0.03;
    const double barometer_m = 0.05;
    constexpr double kChance = 0.05;
    constexpr double kTimes = 5.0;
    RandomNumbers random = log.random();
    const auto extra = [&](double white) {
        return random.chance(kChance) ? kTimes * white * random.normal() : 0.0;
    };
    for (std::size_t i = 0; i < log.size(); ++i) {
        log.raiseBarometer(i, extra(barometer_m));
        log.turnHeading(i, extra(radians(0.5)));
        log.add(Channel::FlowForward, i, extra(0.1));
        log.add(Channel::FlowLeft, i, extra(0.1));
        for (const Channel c : kAccelerations) log.add(c, i, extra(0.03));
        for (const Channel c : kRates) log.add(c, i, extra(radians(0.1)));
        log.add(Channel::Range, i, extra(range_m));
    }
}

void disturb(DisturbedLog& log, Disturbance disturbance) {
    switch (disturbance) {
        case Disturbance::GnssOutliers:
            return gnssOutliers(log);
        case Disturbance::GnssOffset:
            return gnssOffset(log);
        case Disturbance::GnssOffsetOfRun:
            return gnssOffsetOfRun(log);
        case Disturbance::GnssDrift:
            return gnssDrift(log);
        case Disturbance::GnssLate:
            return log.delay(kGnssChannels, 0.4);
        case Disturbance::BarometerRamp:
            return barometerRamp(log);
        case Disturbance::BarometerSteps:
            return inSteps(log, 240.0, 0.5, [&](std::size_t i, double m) { log.raiseBarometer(i, m); });
        case Disturbance::BarometerGusts:
            return barometerGusts(log);
        case Disturbance::NoBarometer:
            return log.silence(kBarometer);
        case Disturbance::FlowZeros:
            return flowZeros(log);
        case Disturbance::FlowScaleWander:
            return flowScaleWander(log);
        case Disturbance::FlowSpikes:
            return flowSpikes(log);
        case Disturbance::NoFlow:
            return log.silence(kFlow);
        case Disturbance::HeadingOffset:
            return headingOffset(log);
        case Disturbance::HeadingSteps:
            return inSteps(log, 120.0, radians(12.0),
                           [&](std::size_t i, double rad) { log.turnHeading(i, rad); });
        case Disturbance::RangeShort:
            return rangeShort(log);
        case Disturbance::ScatteredSilence:
            return scatteredSilence(log);
        case Disturbance::HeavyTails:
            return heavyTails(log);
    }
}

}  // namespace

std::string_view name(Disturbance disturbance) {
    for (const auto& [known, text] : kDisturbanceNames) {
        if (known == disturbance) return text;
    }
    return {};
}

void disturb(Survey& survey, Disturbance disturbance, std::uint64_t seed) {
    const LocalFrame frame = survey.frame();
    for (std::size_t run = 0; run < survey.runs.size(); ++run) {
        if (survey.runs[run].log.size() == 0) continue;
        DisturbedLog log(survey.runs[run].log, frame, disturbance, seed, run);
        disturb(log, disturbance);
    }
}

}  // namespace terrawalk
