#pragma once

#include <array>
#include <cstddef>
#include <string_view>
#include <utility>

#include "fusion/crossovers.hpp"
#include "survey/mark_stands.hpp"

namespace terrawalk {

enum class FusionMethod {
    Raw,        ///< sensors as they are: latest GNSS position, barometric height
    Ukf,        ///< 9-state unscented Kalman filter with a Rauch-Tung-Striebel pass
    Aukf,       ///< the method of paper 000 as it is: no gate, no smoother; `AukfOptions` name the filter
    Terrawalk,  ///< filter with error states, then one adjustment of all runs with their crossovers
};

/// The names that the command line and reports use.
inline constexpr std::array<std::pair<FusionMethod, std::string_view>, 4> kFusionMethodNames{
    {{FusionMethod::Raw, "raw"},
     {FusionMethod::Ukf, "ukf"},
     {FusionMethod::Aukf, "aukf"},
     {FusionMethod::Terrawalk, "terrawalk"}}};

[[nodiscard]] constexpr std::string_view name(FusionMethod method) {
    return kFusionMethodNames[static_cast<std::size_t>(method)].second;
}

/// Whether a method ties the track to the control marks that a run stands on after its start.
[[nodiscard]] constexpr bool tiesToMarks(FusionMethod method) {
    return method != FusionMethod::Raw && method != FusionMethod::Aukf;
}

/// In which epochs the GNSS height enters the filter. Without a barometer in use, and while it is silent for
/// long, `Rtk` gives way to `Always`, with a note.
enum class GnssHeightUse {
    Never,
    Rtk,  ///< only when the fix is RTK fixed or RTK float
    Always,
};

/// Spread of the sigma points: lambda = alpha^2 (n + kappa) - n. Source: paper 000, eq 13; Wan and van der
/// Merwe 2000.
struct UnscentedOptions {
    double alpha = 0.1;
    double beta = 2.0;
    double kappa = 0.0;
};

/// White noise that drives the nine states, as spectral densities: variance that a second adds.
/// Paper 000 tunes the diagonal of Q, one number for each state; these nine are that, free of the step
/// length.
struct ProcessNoiseOptions {
    double position_e_m2ps = 1.0e-4;  ///< m^2/s
    double position_n_m2ps = 1.0e-4;
    double position_u_m2ps = 1.0e-4;
    double velocity_e_m2ps3 = 0.2;  ///< m^2/s^3
    double velocity_n_m2ps3 = 0.2;
    double velocity_u_m2ps3 = 0.02;
    double acceleration_e_m2ps5 = 0.5;  ///< m^2/s^5
    double acceleration_n_m2ps5 = 0.5;
    double acceleration_u_m2ps5 = 0.2;
};

struct ProcessOptions {
    ProcessNoiseOptions noise;
    /// Time in which an acceleration dies away [s] (Singer 1970). 0: it never does, the form of paper 000.
    double acceleration_time_constant_s = 1.0;
    double longest_step_s = 0.5;  ///< longer gaps between epochs are cut into steps no longer than this [s]
};

/// Where the run begins.
struct InitialOptions {
    double velocity_sigma_mps = 1.0;
    double acceleration_sigma_mps2 = 1.0;
    double walking_speed_mps = 1.5;  ///< by which a position ages while nothing measures it
    double position_sigma_m = 10.0;  ///< of the start, before the ties or fixes that tell it are applied
    double still_speed_mps = 0.3;    ///< below this the array counts as standing still
};

struct GnssOptions {
    bool use_position = true;
    bool use_velocity = true;
    GnssHeightUse use_height = GnssHeightUse::Rtk;
    double sigma_single_m = 1.29;  ///< per horizontal axis; paper 000, table 3: 1.5 m CEP
    double sigma_differential_m = 0.7;
    double sigma_float_m = 0.31;
    double sigma_fixed_m = 0.02;
    double sigma_single_up_m = 1.95;
    double sigma_differential_up_m = 1.1;
    double sigma_float_up_m = 0.46;
    double sigma_fixed_up_m = 0.035;
    /// A receiver's own accuracy is used where it gives one, but never below this share of the sigma above.
    double accuracy_floor_share = 0.5;
    /// Correlation time of the position error [s] without an RTK fix. A white-noise filter must not believe
    /// that it sees a new error in each epoch: the variance is multiplied by max(1, 2 tau / dt).
    double correlation_s = 30.0;
    double correlation_fixed_s = 5.0;  ///< the same for RTK fixed [s]
    double velocity_sigma_mps = 0.15;  ///< Doppler, per horizontal axis
    double velocity_sigma_up_mps = 0.3;
    double velocity_correlation_s = 0.5;  ///< as `correlation_s`, for the Doppler velocity [s]
};

struct BarometerOptions {
    bool use = true;
    double scale = 1.0;          ///< height per height of the standard atmosphere, from a fit at known marks
    double sigma_m = 0.06;       ///< white noise
    double gust_sigma_m = 0.12;  ///< pressure of wind
    double gust_correlation_s = 4.0;
    double drift_m_per_sqrt_min = 0.08;  ///< random walk since the barometer was zeroed
    double longest_silence_s = 30.0;     ///< after it GNSS heights of any fix stand in, unless `Never` [s]
};

struct FlowOptions {
    bool use = true;
    double variance_m2ps2 = 0.003;    ///< at rest
    double variance_per_v2 = 0.0045;  ///< grows with the square of the speed
    double scale_sigma = 0.04;        ///< lasting error of scale, as a share of the speed
    double correlation_s =
        15.0;  ///< for how long errors of scale and heading keep their direction over ground [s]
    double smallest_quality = 1.0;  ///< flow_quality below this is rejected: no texture
    bool screen = true;  ///< reject readings of nothing amid motion, and those far from their neighbours
    /// Stand in with the recent mean flow while neither flow nor Doppler velocity is used.
    bool bridge_dropouts = true;
    double bridge_after_s = 0.6;     ///< without a used reading [s]
    double bridge_longest_s = 10.0;  ///< since the last used reading; then the walk may be any other [s]
    double bridge_sigma_mps = 0.3;   ///< of the stand-in, which errs in the same way for `bridge_memory_s`
    double bridge_memory_s = 5.0;    ///< over which the mean is taken [s]
};

struct AccelerometerOptions {
    bool use = true;
    /// Steps of the walk, noise, and a bias that this filter has no state for: a sigma well below 0.5 lets
    /// the bias of the vertical axis carry the height away from the barometer.
    double sigma_mps2 = 1.0;
};

/// The yaw row atan2(v_n, v_e) of paper 000, eq 4. Off: the heading of a carried array is not its course, and
/// the flow is already rotated by it.
struct YawRowOptions {
    bool use = false;
    double sigma_deg = 10.0;
    double slowest_mps = 0.3;       ///< below this the course has no meaning and the row is left out
    double mount_offset_deg = 0.0;  ///< yaw of the array less course of the walk, counter-clockwise
};

struct AttitudeOptions {
    double sigma_tilt_deg = 0.1;       ///< roll and pitch; paper 000, table 1, moving
    double sigma_heading_deg = 3.0;    ///< paper 000, table 1 says 0.5, without the iron that a field holds
    double heading_lag_s = 0.2;        ///< by which the compass may come behind in turns
    double sigma_tilt_held_deg = 5.0;  ///< while the last known attitude stands in
    double sigma_heading_held_deg = 20.0;
    double longest_hold_s = 1.0;           ///< a held heading still rotates the flow for so long [s]
    double sigma_tilt_unknown_deg = 10.0;  ///< level is assumed
};

/// Known marks over which the array stood.
struct TieOptions {
    double sigma_m = 0.16;          ///< per horizontal axis: how well an array in the hand stands over a mark
    double range_sigma_m = 0.06;    ///< paper 000, table 2
    double shortest_range_m = 0.1;  ///< a range outside these says nothing of the height above a mark
    double longest_range_m = 12.0;
    double correlation_s = 0.1;  ///< of both [s], so that a faster log does not tie harder
    double range_tolerance_m =
        0.3;  ///< a range that stands off by more from the median of the stand is left out
    double assumed_height_m = 1.2;  ///< of the array above the mark where no range was measured
    double assumed_height_sigma_m = 0.3;
};

struct RobustOptions {
    bool use = true;
    double huber_sigma = 2.0;       ///< from here on the weight falls
    double gate_sigma = 5.0;        ///< beyond this a reading is rejected
    double readmit_after_s = 30.0;  ///< a sensor rejected for so long is believed, the filter is not
    /// Silence of a sensor that ends what its readings told together (how long it is rejected, how long GNSS
    /// is far from the track) [s].
    double longest_gap_s = 10.0;
};

/// When a run is given up with an error instead of drawn.
struct DivergenceOptions {
    double largest_sigma_m = 1000.0;
    double largest_gnss_distance_m = 300.0;
    double patience_s = 60.0;     ///< for how long the track may be that far from GNSS [s]
    double rejected_share = 0.8;  ///< of GNSS positions, averaged over `rejected_window_s`
    double rejected_window_s = 300.0;
    int fewest_rejected = 20;  ///< GNSS positions of the run beyond the gate before their share counts
};

/// Errors that last: the states of the filter and the unknowns of the adjustment that follow them.
struct LastingErrorOptions {
    double gnss_correlation_s = 100.0;    ///< of the position error; its sigma is that of the fix
    double gnss_white_share = 0.25;       ///< white noise as a share of the sigma of the fix
    double gnss_white_share_fixed = 0.5;  ///< the same for RTK fixed
    double gnss_bias_sigma_m = 1.0;       ///< per axis, without RTK, the same in all runs of a day
    double gnss_bias_run_sigma_m = 0.4;   ///< by which a run differs from that
    double heading_sigma_deg = 3.0;       ///< compass error that wanders
    double heading_correlation_s = 400.0;
    double hard_iron_sigma_deg = 2.5;      ///< A sin yaw + B cos yaw, the same in all runs
    double hard_iron_run_sigma_deg = 0.7;  ///< by which a run differs from that
    double flow_scale_sigma = 0.1;         ///< constant in a run
    /// By which the scale wanders beside, where residuals of the flow go together; 0: never.
    double flow_scale_wander_sigma = 0.08;
    double flow_scale_correlation_s = 120.0;       ///< time in which it does
    double flow_axes_sigma = 0.05;                 ///< half the difference of the scales of forward and left
    double gyro_bias_sigma_dps = 2.0;              ///< constant in a run
    double gyro_scale_sigma = 0.03;                ///< constant in a run
    double gyro_walk_deg_per_sqrt_s = 0.05;        ///< by which a turn summed up from the gyro errs
    double acceleration_bias_sigma_mps2 = 0.15;    ///< each axis of the accelerometer, in the level axes with
                                                   ///< what a wrong tilt lets in of gravity
    double acceleration_bias_correlation_s = 1e5;  ///< of the vertical axis
    double tilt_correlation_s = 300.0;             ///< of the level axes: the error of the tilt wanders
};

/// The filter with error states, first stage of `Terrawalk`. Its random walk of the horizontal velocity is
/// that of the joint adjustment.
struct DriftFilterOptions {
    double climb_sigma_mps = 0.3;  ///< vertical velocity of the array
    double climb_correlation_s = 1.5;
    bool adapt = true;             ///< noise of each sensor follows its innovations
    double adapt_memory_s = 60.0;  ///< in which older innovations fade
    double least_factor = 0.5;     ///< limits of the factor on the variance
    double greatest_factor = 4.0;
};

/// The joint adjustment of all runs.
struct JointOptions {
    double knot_s = 1.0;  ///< between the knots of the track's correction
    double heading_knot_s = 1.0;
    double gnss_knot_s = 1.0;
    double barometer_knot_s = 10.0;
    double acceleration_knot_s = 30.0;  ///< between the knots of the accelerometer's bias
    int rounds = 5;                     ///< Gauss-Newton rounds with crossovers
    bool use_crossovers = true;
    bool adapt_noise = true;  ///< noise factors by variance components
    bool preview = false;     ///< crossovers in a quick second stage instead; see correctByCrossovers()
    CrossoverOptions crossovers;
    /// Sigma of a misfit: pair_sigma_m + g / (g + pair_even_slope) (pair_uneven_m + pair_apart_per_m d^2),
    /// with slope g and distance of the passes d, errors of the tracks counted in.
    double pair_sigma_m = 0.025;
    double pair_even_slope = 0.2;
    double pair_uneven_m = 0.07;
    double pair_apart_per_m = 0.35;
    double pair_plan_share = 0.7;  ///< of the slope that turns errors of the plan into height
    double pair_weight = 0.2;      ///< neighbouring pairs share their points
    /// Share of the ground, in cells of 10 m, whose crossovers only test the result.
    double left_out_crossovers = 0.0;
    double walk_mps_per_sqrt_s = 0.6;         ///< random walk of the horizontal velocity
    double ground_roughness_m = 0.03;         ///< of the ground below the walk about its level
    double ground_climb_m_per_sqrt_m = 0.06;  ///< by which that level wanders
    double acceleration_noise_mps2 = 0.03;    ///< white noise of the accelerometer; 0: it is not used
    double blind_climb_m_per_sqrt_s = 0.27;   ///< the same of the array where no range was measured
};

/// The filters that stand beside one another on the model of paper 000.
enum class FilterKind {
    Ekf,            ///< first-order, Jacobian of the yaw row
    Ckf,            ///< cubature points (Arasaratnam and Haykin 2009)
    Ukf,            ///< 19 sigma points, paper 000
    SquareRootUkf,  ///< the same in square-root form (van der Merwe and Wan 2001)
    AdaptiveUkf,    ///< measurement noise adapts by a bounded, sequential Sage-Husa rule, paper 004
};

/// The names that the command line and reports use.
inline constexpr std::array<std::pair<FilterKind, std::string_view>, 5> kFilterNames{
    {{FilterKind::Ekf, "ekf"},
     {FilterKind::Ckf, "ckf"},
     {FilterKind::Ukf, "ukf"},
     {FilterKind::SquareRootUkf, "square-root-ukf"},
     {FilterKind::AdaptiveUkf, "adaptive-ukf"}}};

/// Diagonal of Q of paper 000, eq 12: variance that a step of `AukfOptions::nominal_interval_s` adds.
struct StepNoiseOptions {
    double position_e_m2 = 0.01;
    double position_n_m2 = 0.01;
    double position_u_m2 = 0.01;
    double velocity_e_m2ps2 = 0.01;
    double velocity_n_m2ps2 = 0.01;
    double velocity_u_m2ps2 = 0.01;
    double acceleration_e_m2ps4 = 0.01;
    double acceleration_n_m2ps4 = 0.01;
    double acceleration_u_m2ps4 = 0.01;
};

/// Adaptation of the measurement noise; source: paper 004, eqs 27-29. The variance of a row is that of its
/// sensor times a factor which follows the innovations between two bounds.
struct SageHusaOptions {
    double forgetting = 0.995;       ///< b; the memory is 1 / (1 - b) readings of a row
    double least_factor = 0.1;       ///< R_min over the sensor's own variance
    double greatest_factor = 100.0;  ///< R_max; a reading that asks for more is left out
};

/// Parameters of paper 000's method. The defaults are its untuned filter; a tuner sets the rest.
struct AukfOptions {
    FilterKind filter = FilterKind::Ukf;
    StepNoiseOptions noise;
    /// To which the step noise belongs; a step of another length adds its share of it. The paper logs at 5
    /// Hz.
    double nominal_interval_s = 0.2;
    UnscentedOptions unscented{.alpha = 1.0, .beta = 2.0, .kappa = 0.0};
    YawRowOptions yaw_row{.use = true};
    SageHusaOptions adaptive;
};

/// Every parameter of fusion. All sigmas are 1 sigma. Defaults were chosen on simulated surveys (seeds 1 to 8
/// at three levels of faults) for small errors and for sigmas that own up to them.
struct FusionOptions {
    FusionMethod method = FusionMethod::Terrawalk;
    bool smooth = true;  ///< Rauch-Tung-Striebel pass after the filter
    StandOptions stands;
    UnscentedOptions unscented;
    ProcessOptions process;
    InitialOptions initial;
    GnssOptions gnss;
    BarometerOptions barometer;
    FlowOptions flow;
    AccelerometerOptions accelerometer;
    YawRowOptions yaw_row;
    AttitudeOptions attitude;
    TieOptions ties;
    RobustOptions robust;
    LastingErrorOptions lasting;
    DriftFilterOptions drift;
    JointOptions joint;
    DivergenceOptions divergence;
    AukfOptions aukf;
};

}  // namespace terrawalk
