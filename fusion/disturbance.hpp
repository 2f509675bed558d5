#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <utility>

namespace terrawalk {

struct Survey;

/// An error of the kind that real sensors make and that the simulator's levels of faults lack: they
/// show what an estimator bears beside what it was tuned on. 1 sigma unless named.
enum class Disturbance : std::uint8_t {
    GnssOutliers,      ///< one position in ten, alone, off by 6 m per axis
    GnssOffset,        ///< all positions of the survey off by 3 m in plan, by 4 m up
    GnssOffsetOfRun,   ///< each run's positions off by 2 m per axis
    GnssDrift,         ///< wanders by 2 m per axis, Gauss-Markov of 600 s
    GnssLate,          ///< positions and velocities come 0.4 s late
    BarometerRamp,     ///< 3 m an hour, of either sign
    BarometerSteps,    ///< a step of 0.5 m every four minutes, as of a door or a closed case
    BarometerGusts,    ///< half a minute of 0.6 m, four times in ten minutes
    NoBarometer,       ///< no reading at all
    FlowZeros,         ///< a tenth of the time exactly zero at full quality, half a minute each
    FlowScaleWander,   ///< the scale wanders by a tenth, Gauss-Markov of 120 s
    FlowSpikes,        ///< one reading in fifty off by 3 m/s per axis
    NoFlow,            ///< no reading at all
    HeadingOffset,     ///< each run's heading off by 10 degrees
    HeadingSteps,      ///< off by 12 degrees, anew every two minutes, as beside iron
    RangeShort,        ///< one hit in twenty 0.2 to 1 m short, as of leaves
    ScatteredSilence,  ///< GNSS, barometer, flow, heading and accelerations with rates: each silent for half
                       ///< of the time, in stretches of a second or so
    HeavyTails,        ///< one reading in twenty of every sensor but GNSS off by five times its white noise
};

inline constexpr std::array<std::pair<Disturbance, std::string_view>, 18> kDisturbanceNames{
    {{Disturbance::GnssOutliers, "gnss-outliers"},
     {Disturbance::GnssOffset, "gnss-offset"},
     {Disturbance::GnssOffsetOfRun, "gnss-offset-of-run"},
     {Disturbance::GnssDrift, "gnss-drift"},
     {Disturbance::GnssLate, "gnss-late"},
     {Disturbance::BarometerRamp, "barometer-ramp"},
     {Disturbance::BarometerSteps, "barometer-steps"},
     {Disturbance::BarometerGusts, "barometer-gusts"},
     {Disturbance::NoBarometer, "no-barometer"},
     {Disturbance::FlowZeros, "flow-zeros"},
     {Disturbance::FlowScaleWander, "flow-scale-wander"},
     {Disturbance::FlowSpikes, "flow-spikes"},
     {Disturbance::NoFlow, "no-flow"},
     {Disturbance::HeadingOffset, "heading-offset"},
     {Disturbance::HeadingSteps, "heading-steps"},
     {Disturbance::RangeShort, "range-short"},
     {Disturbance::ScatteredSilence, "scattered-silence"},
     {Disturbance::HeavyTails, "heavy-tails"}}};

[[nodiscard]] std::string_view name(Disturbance disturbance);

/// Puts the error into the logs of a survey, as simulateSurvey() makes them. Its random numbers come from
/// the seed, the disturbance and the run, so several do not depend on their order where they touch different
/// channels. Channels that a log lacks stay away. Pure; safe from any thread.
void disturb(Survey& survey, Disturbance disturbance, std::uint64_t seed);

}  // namespace terrawalk
