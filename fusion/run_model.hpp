#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "fusion/fusion_options.hpp"
#include "fusion/knot_chain.hpp"
#include "fusion/position_bends.hpp"
#include "fusion/run_start.hpp"
#include "survey/frames.hpp"

namespace terrawalk {

/// GNSS positions of one kind of fix, one after the other.
struct GnssSegment {
    GnssFixClass fix_class = kSingleClass;
    double sigma_m = 0.0;  // of the lasting error
    double sigma_up_m = 0.0;
    KnotChain error;  // e, n, u
};

struct GnssEpoch {
    std::size_t epoch = 0;
    GnssFixClass fix_class = kSingleClass;
    std::size_t segment = 0;
    Eigen::Vector3d enu_m;
    double white_m = 0.0;
    double white_up_m = 0.0;
};

/// A number that there is once.
struct SingleUnknown {
    std::size_t unknown = 0;
    double value = 0.0;
};

/// What iron near the compass does: A sin yaw + B cos yaw.
struct HardIron {
    SingleUnknown sin, cos;
};

/// Errors that all runs of a day share.
struct SharedErrors {
    HardIron iron;                           ///< of the array
    std::array<SingleUnknown, 2> gnss_bias;  ///< of positions without RTK: east, north
    bool flow_scale_wanders = false;         ///< in all runs, beside what is constant in each
};

/// A run as the adjustment sees it: what its sensors offer, and what is not known of it.
struct RunModel {
    const RunStart* start = nullptr;
    const ArrayLog* log = nullptr;
    std::vector<Eigen::Vector3d> track_m;  // as corrected so far
    std::vector<double> yaw_rad;           // as measured, unwrapped nowhere
    KnotChain correction;                  // e, n, u of the track
    KnotChain level;  // of the ground along the track, as far as it is even; knots as in `correction`
    KnotChain psi;    // compass error that wanders
    KnotChain turn;   // error of the turn summed up from the gyro
    std::vector<double> base_yaw_rad;     // what `turn` corrects: summed gyro, continuous
    std::vector<double> gyro_turn_rad;    // since the epoch before, 0 where the gyro did not tell
    std::vector<double> base_doubt_rad2;  // variance of the turn before this epoch where the gyro was silent
    KnotChain drift, gust;                // barometer
    KnotChain scale_wander;               // of the flow, beside `scale`
    KnotChain force_bias;                 // accelerometer, body axes
    std::optional<LevelAcceleration> acceleration;
    std::vector<GnssSegment> segments;
    std::vector<GnssEpoch> gnss;
    HardIron iron;  // of this run, beside that of the array
    SingleUnknown scale, axes, gyro_bias, gyro_scale;
    std::array<SingleUnknown, 2> gnss_bias;  // of positions without RTK, with what all runs share
    bool has_single = false;                 // such positions
    bool has_flow = false, has_heading = false, has_gyro = false, has_barometer = false;
    // Optical flow of each epoch, forward and left; where there was none, the mean of those around it.
    std::vector<Eigen::Vector2d> flow_mps;
    std::vector<double> bridge_sigma_mps;  // zero where the flow was measured
    std::vector<bool> level_known;         // whether a range was measured about the knot
    std::vector<bool> barometer_known;     // whether a pressure was measured about the knot of `correction`
    // Of each knot, as of the last solution without crossovers; of the plan per axis.
    std::vector<double> plan_variance_m2;
    std::vector<double> height_variance_m2;
    std::vector<double> above_ground_m;  // height of the array above the ground below it, spikes left out
    std::vector<KnotChain::Place> at;    // of each epoch in `correction`
    std::vector<KnotChain::Place> psi_at;
    std::vector<KnotChain::Place> turn_at;

    double time(std::size_t i) const { return log->time_s[i]; }
    std::size_t size() const { return log->size(); }
};

/// Takes from a run what the adjustment uses. Its unknowns have no numbers yet. Pure.
/// @param start  must outlive the model
[[nodiscard]] RunModel makeRunModel(const RunStart& start, const LocalFrame& frame,
                                    const FusionOptions& options);

/// Gives the unknowns of a run their numbers, from `next` on, which is moved behind them: the corrections of
/// the track alone, or all.
void numberTrack(RunModel& run, std::size_t& next);
void numberUnknowns(RunModel& run, std::size_t& next);

/// Adds a solution to the run, to its track alone or to all. Returns the RMS by which its track moved in
/// plan [m].
double moveTrack(RunModel& run, const Eigen::VectorXd& solution);
double takeSolution(RunModel& run, const Eigen::VectorXd& solution);

/// Track at a time, linear between epochs. Local ENU [m].
[[nodiscard]] Eigen::Vector3d trackAt(const RunModel& run, double time_s);

/// Yaw of an epoch less what the compass or the summed gyro is off [rad], unwrapped nowhere.
/// @param array_iron  what the array has of its own, the same in all runs
[[nodiscard]] double trueYaw(const RunModel& run, const HardIron& array_iron, std::size_t epoch);

/// The time that an epoch stands for: to halfway to its neighbours, but no longer than a usual step.
[[nodiscard]] double epochBegin(const std::vector<double>& times_s, std::size_t epoch);
[[nodiscard]] double epochEnd(const std::vector<double>& times_s, std::size_t epoch);

/// White noise of the compass [rad], a sixth of what it may be off at any time (paper 000, table 1: 0.5
/// degrees).
[[nodiscard]] double compassNoise_rad(const AttitudeOptions& options);

}  // namespace terrawalk
