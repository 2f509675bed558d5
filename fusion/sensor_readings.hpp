#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "fusion/fusion_options.hpp"
#include "fusion/unscented_kalman_filter.hpp"
#include "survey/survey.hpp"
#include "survey/trajectory.hpp"

namespace terrawalk {

/// What gives the filter its rows, in the order in which an epoch's readings are applied.
enum class Sensor : std::uint8_t {
    Heading,
    MarkTie,
    GnssPosition,
    GnssHeight,
    GnssVelocity,
    Barometer,
    OpticalFlow,
    MeanFlow,  ///< recent mean of the flow, in place of a reading that dropped out
    Accelerometer,
    HeightAssumption,
};
inline constexpr std::size_t kSensorCount = 10;
[[nodiscard]] std::string_view name(Sensor sensor);

/// Attitude of one epoch, and whether a sensor stands behind it.
struct EpochAttitude {
    Attitude attitude;
    double sigma_tilt_rad = 0.0;
    double sigma_heading_rad = 0.0;
    bool tilt_known = false;
    bool heading_known = false;
};

/// Attitude for each epoch. What is missing is held from the last epoch that had it; before the first one the
/// array is taken to be level and its heading to be unknown (sigma of a uniform angle). Held values carry
/// their own, larger sigma. Adds a note for each of these.
[[nodiscard]] std::vector<EpochAttitude> epochAttitudes(const ArrayLog& log, const AttitudeOptions& options,
                                                        RunNotes& notes);

/// What a GNSS epoch is worth. `rejection` is empty when it may be used.
struct GnssQuality {
    std::string_view rejection;
    double sigma_m = 0.0;  ///< per horizontal axis
    double sigma_up_m = 0.0;
    bool rtk = false;
    double correlation_s = 0.0;
};
[[nodiscard]] GnssQuality gnssQuality(const ArrayLog& log, std::size_t epoch, const GnssOptions& options);

/// Kinds of fix whose positions err in different ways; numbers from 0, to count with.
enum GnssFixClass : std::size_t {
    kSingleClass,  ///< all others too, and where the log does not say
    kFloatClass,   ///< RTK float
    kFixedClass,   ///< RTK fixed
    kFixClassCount,
};
[[nodiscard]] GnssFixClass gnssFixClass(const ArrayLog& log, std::size_t epoch);
/// White noise of a position as a share of its sigma.
[[nodiscard]] double gnssWhiteShare(const ArrayLog& log, std::size_t epoch,
                                    const LastingErrorOptions& lasting);

/// Origin of the array in local ENU as GNSS has it.
struct GnssPosition {
    Eigen::Vector3d enu_m = Eigen::Vector3d::Zero();  ///< up is missing without an ellipsoidal height
    double arm_variance_m2 = 0.0;  ///< that the attitude leaves in the lever arm, per horizontal axis
    double arm_variance_up_m2 = 0.0;
};

/// Nothing without latitude and longitude. Without an ellipsoidal height, e and n are computed at
/// `assumed_up_m` above the zero point. The lever arm of the antenna is rotated and removed; while the
/// heading is unknown only its vertical part is, and the rest is variance.
[[nodiscard]] std::optional<GnssPosition> gnssPosition(const ArrayLog& log, std::size_t epoch,
                                                       const LocalFrame& frame, const EpochAttitude& attitude,
                                                       double assumed_up_m);

/// Of each epoch of a log what keeps its optical flow from being used, see flowRejections().
using FlowRejections = std::vector<std::optional<std::string_view>>;

/// What keeps a reading from being used, by any method: nothing when the log has no reading in this epoch,
/// empty when the reading may be used.
[[nodiscard]] std::optional<std::string_view> dopplerRejection(const ArrayLog& log, std::size_t epoch);
[[nodiscard]] std::optional<std::string_view> barometerRejection(const ArrayLog& log, std::size_t epoch);

/// By how much a level surface through the origin has sunk below the tangent plane: (e^2 + n^2) / (2 R), R =
/// 6371 km. Barometric heights follow the level surface. 0.08 m at 1 km; right to 0.5 %.
[[nodiscard]] double levelDrop(const Eigen::Vector3d& enu_m);

/// Variance of one barometric height: white, and what lasts over a gust or grows since the zero.
struct BarometerVariance {
    double white_m2 = 0.0;
    double lasting_m2 = 0.0;
};
[[nodiscard]] BarometerVariance barometerVariance(const BarometerOptions& options, double since_zero_s);

/// Usual time between two records of a log, the median; 1 s for a log of fewer than two.
[[nodiscard]] double usualStep_s(const ArrayLog& log);

/// Variance of white noise of the flow at a speed [m/s], each component.
[[nodiscard]] double flowVariance(const FlowOptions& options, double speed_mps);

/// Height of the array's origin above the ground it measures, from range, tilt and lever arm; missing without
/// a range between the limits of `options` (finders report a far range where nothing came back).
[[nodiscard]] double heightAboveGround(const ArrayLog& log, std::size_t epoch, const Attitude& attitude,
                                       const TieOptions& options);

/// Height above the ground that these heights above whatever was hit tell: blades of grass and leaves only
/// shorten a range, so it is the mean of those that reach nearly as far as the farthest tenth. Missing for
/// none; the order is lost.
[[nodiscard]] double heightThroughGrass(std::vector<double>& heights_m);

/// One row of a reading. `variance` is what the filter may believe, errors of long memory counted as such;
/// `gate_variance` is the sensor's own, by which outliers are judged.
struct ReadingRow {
    LinearRow row;
    double gate_variance = 0.0;
};

/// What one sensor says in one epoch: up to three rows, or why none can be made.
struct Reading {
    Sensor sensor;
    std::array<ReadingRow, 3> rows;
    std::size_t row_count = 0;
    std::string_view rejection;  ///< empty when there are rows

    explicit Reading(Sensor s, std::string_view why_rejected = {}) : sensor(s), rejection(why_rejected) {}
    void add(StateBlock block, const Eigen::Vector3d& direction, double value, double variance,
             double gate_variance) {
        rows[row_count++] = {{block, direction, value, variance}, gate_variance};
    }
};

/// A tie of one epoch to a mark: where the array's origin must have been.
struct MarkTie {
    std::size_t epoch = 0;
    Eigen::Vector3d array_enu_m = Eigen::Vector3d::Zero();
    Eigen::Vector3d variance_m2 = Eigen::Vector3d::Ones();
    bool has_height = true;
};

/// What a run is measured against; made once for each run by runReference().
struct RunReference {
    Eigen::Vector3d start_enu_m = Eigen::Vector3d::Zero();
    Eigen::Vector3d start_sigma_m = Eigen::Vector3d::Ones();
    bool starts_on_mark = false;
    std::vector<MarkTie> ties;  ///< in order of epochs
    /// Barometric height at which the level surface through the zero point lies; nothing without a barometer.
    std::optional<double> barometer_zero_m;
    double barometer_zero_time_s = 0.0;
    /// Lasting variance of what heights are measured from: the zero of the barometer, or the assumption that
    /// stands in where nothing measures height.
    double height_reference_variance_m2 = 0.0;
    GnssHeightUse gnss_height = GnssHeightUse::Rtk;  ///< what is done, which may be more than was asked for
    bool has_horizontal = false;                     ///< anything but ties that tells e and n
    bool has_height = false;                         ///< barometer or GNSS height

    /// Height of the array at `near_enu_m` that a pressure [Pa] tells; there must be a barometer.
    [[nodiscard]] double barometricUp(double pressure_pa, double scale,
                                      const Eigen::Vector3d& near_enu_m) const;
};

/// What the filter remembers between epochs to weigh the next readings.
struct SensorMemory {
    std::array<double, kSensorCount> last_used_s = [] {
        std::array<double, kSensorCount> never{};
        never.fill(-std::numeric_limits<double>::infinity());
        return never;
    }();
    Eigen::Vector2d mean_flow_mps = Eigen::Vector2d::Zero();  ///< forward, left

    [[nodiscard]] double lastUsed(Sensor sensor) const {
        return last_used_s[static_cast<std::size_t>(sensor)];
    }
    double& lastUsed(Sensor sensor) { return last_used_s[static_cast<std::size_t>(sensor)]; }
    /// When flow, or its mean in its place, last told the velocity.
    [[nodiscard]] double lastFlow() const {
        return std::max(lastUsed(Sensor::OpticalFlow), lastUsed(Sensor::MeanFlow));
    }
};

/// Multiplies the variance of an error with correlation time tau that is read every dt, so that a filter
/// which takes it for white noise gains no more from it than there is: the spectral density at zero of the
/// correlated error, 2 sigma^2 tau, spread over samples dt apart. At least 1. Source: Gelb, Applied Optimal
/// Estimation, section 4.5.
[[nodiscard]] double whiteNoiseFactor(double correlation_s, double interval_s);

/// Everything that is needed to read an epoch; refers, does not own.
struct ReadingContext {
    const ArrayLog& log;
    const FusionOptions& options;
    const LocalFrame& frame;
    const std::vector<EpochAttitude>& attitudes;
    const RunReference& reference;
    const FlowRejections& flow_rejections;
};

/// Replaces `readings` by those of one epoch, ties excepted, given the predicted state (for the yaw row's
/// linearisation and the height at which bare latitudes are converted).
void readEpoch(const ReadingContext& context, std::size_t epoch, const StateEstimate& prediction,
               const SensorMemory& memory, std::vector<Reading>& readings);

}  // namespace terrawalk
