#pragma once

#include <cstdint>
#include <stop_token>
#include <vector>

#include "fusion/simulated_terrain.hpp"
#include "fusion/simulated_walk.hpp"
#include "fusion/simulation_options.hpp"
#include "survey/array_log.hpp"
#include "survey/frames.hpp"

namespace terrawalk {

/// What the receiver's position is worth. First-order Gauss-Markov error plus white noise, 1 sigma per axis.
struct GnssErrors {
    double slow_h_m = 0.0;
    double slow_v_m = 0.0;
    double white_h_m = 0.0;
    double white_v_m = 0.0;
    double doppler_h_mps = 0.0;
    double doppler_v_mps = 0.0;
    double jump_m = 0.0;  ///< typical size of a multipath jump or of a wrong fix
};
/// Time in which the slow GNSS error forgets itself.
inline constexpr double kGnssCorrelation_s = 100.0;

/// By GGA quality code: single, RTK float and RTK fixed. Single: 1.5 m CEP (paper 000, Table 3), which
/// is 1.27 m per horizontal axis; its table gives the same figure for height, where receivers do worse,
/// so 1.9 m is taken.
[[nodiscard]] GnssErrors gnssErrors(int fix);

/// Sizes of all other errors, 1 sigma unless named. `share`s and `chance`s are probabilities per epoch,
/// `per_min` are rates of bursts.
struct SensorErrors {
    double barometer_white_m = 0.05;
    double barometer_drift_m_per_sqrt_min = 0.0;  ///< random walk
    double barometer_gust_m = 0.0;                ///< Gauss-Markov, 5 s
    double weather_pa = 0.0;                      ///< constant for a survey

    double flow_white_mps = 0.05;
    double flow_white_per_speed = 0.05;
    double flow_scale = 0.0;   ///< constant for a run
    double shade_level = 2.0;  ///< flow fails where the canopy (-1..1) is above
    double flow_drops_per_min = 0.0;

    double tilt_moving_rad = radians(0.1);  ///< white; paper 000, Table 1
    double tilt_still_rad = radians(0.05);
    double tilt_drift_rad = 0.0;              ///< Gauss-Markov, 300 s
    double heading_white_rad = radians(0.5);  ///< Table 1
    double heading_drift_rad = 0.0;           ///< Gauss-Markov, 400 s
    double hard_iron_rad = 0.0;               ///< A and B of A sin(heading) + B cos(heading), for a survey

    double accelerometer_white_mps2 = 0.03;
    double accelerometer_bias_mps2 = 0.0;  ///< constant for a run
    double gyro_white_radps = radians(0.1);
    double gyro_bias_radps = 0.0;  ///< constant for a run

    double range_bias_m = 0.0;  ///< constant for a survey
    double grass_level = 2.0;   ///< grass stands where its field (-1..1) is above
    double grass_tallest_m = 0.0;
    double range_lost_chance = 0.0;
    double hands_per_min = 0.0;  ///< a hand in front of the range finder

    double gnss_jumps_per_min = 0.0;
    double gnss_dips_per_min = 0.0;  ///< the fix falls to the next poorer kind for some seconds

    double missing_chance = 0.0;  ///< each sensor, each epoch
    double lost_row_chance = 0.0;
};
[[nodiscard]] SensorErrors sensorErrors(FaultLevel level);

/// The range finder's own reading where nothing came back.
inline constexpr double kNoReturnRange_m = 65.535;
inline constexpr double kRangeLeast_m = 0.3;  ///< paper 000, Table 2
inline constexpr double kRangeGreatest_m = 12.0;

/// Of white noise in the range [m]. Table 2 states +-6 cm below 6 m and 1 % beyond; they are taken as 2
/// sigma.
[[nodiscard]] double rangeSigma_m(double range_m);

/// The rows of a log by number of the sampling tick: 0 and `rows` - 1 further ones, with the gaps of lost
/// rows.
[[nodiscard]] std::vector<std::uint64_t> keptTicks(std::size_t rows, double lost_row_chance,
                                                   std::uint64_t seed, std::uint64_t run);

/// What the array writes down on a walk.
/// @param walked      one sample for each tick from 0 on, none left out
/// @param duration_s  planned length of the run; an outage of the GNSS lies in its middle
/// @param stop        once asked to stop, the log is left unfinished and is of no use
/// Every error has a random stream of its own, by seed, run and sensor. Pure.
[[nodiscard]] ArrayLog senseWalk(const std::vector<WalkSample>& walked, const TerrainModel& terrain,
                                 const LocalFrame& frame, const SimulationOptions& options, std::uint64_t run,
                                 double duration_s, std::stop_token stop);

/// The log and only these rows of it.
[[nodiscard]] ArrayLog keepRows(const ArrayLog& log, const std::vector<std::uint64_t>& rows);

}  // namespace terrawalk
