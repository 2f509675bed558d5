#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "fusion/fusion_options.hpp"
#include "fusion/run_reference.hpp"
#include "fusion/sensor_ledger.hpp"
#include "fusion/sensor_readings.hpp"
#include "fusion/unscented_kalman_filter.hpp"
#include "survey/survey.hpp"

namespace terrawalk {

// The model of paper 000, section 2.3.2, as every filter of fusion/filter_family.hpp and the batch kernels
// use it: position, velocity and acceleration under constant acceleration, nine measurement rows.

/// The measurement vector of paper 000, eq 3, in its order.
enum class MeasurementRow : std::uint8_t {
    GnssEast,
    GnssNorth,
    BarometerUp,
    FlowEast,
    FlowNorth,
    Yaw,  ///< atan2(v_n, v_e), eq 4; the only row that is not linear
    AccelerationEast,
    AccelerationNorth,
    AccelerationUp,
};
inline constexpr std::size_t kRowCount = 9;

/// Index into the state (order as in StateBlock) of what a row measures; none for the yaw row.
inline constexpr int kNoState = -1;
inline constexpr std::array<int, kRowCount> kStateOfRow{3, 4, 5, 0, 1, kNoState, 6, 7, 8};

/// What gives each row. GNSS height or an assumption may stand in for the barometer.
using RowSensors = std::array<Sensor, kRowCount>;
inline constexpr RowSensors kRowSensors{Sensor::GnssPosition,  Sensor::GnssPosition,  Sensor::Barometer,
                                        Sensor::OpticalFlow,   Sensor::OpticalFlow,   Sensor::Heading,
                                        Sensor::Accelerometer, Sensor::Accelerometer, Sensor::Accelerometer};

/// Rows as bits of a number.
using RowSet = std::uint16_t;
[[nodiscard]] constexpr RowSet rowBit(std::size_t row) {
    return static_cast<RowSet>(1U << row);
}

/// What one epoch of a log measures. No value depends on the state, so a log is read once for all candidates.
struct MeasurementEpoch {
    double dt_s = 0.0;  ///< since the epoch before; 0 in the first one
    RowSet present = 0;
    std::array<double, kRowCount> z{};         ///< SI, local ENU; 0 where not present
    std::array<double, kRowCount> variance{};  ///< R of the row; 1 where not present

    [[nodiscard]] bool has(MeasurementRow row) const {
        return (present & rowBit(static_cast<std::size_t>(row))) != 0;
    }
    void set(MeasurementRow row, double value, double row_variance) {
        const auto i = static_cast<std::size_t>(row);
        present = static_cast<RowSet>(present | rowBit(i));
        z[i] = value;
        variance[i] = row_variance;
    }
};

/// A run as measured.
struct MeasuredRun {
    std::string run_id;
    RowSensors sensors = kRowSensors;
    StateEstimate start;  ///< of the first epoch before its measurements; the covariance is diagonal
    std::vector<MeasurementEpoch> epochs;
};

/// Turns a log into measurements. R is the sensors' own (tables of the paper, the receiver's accuracy),
/// white: GNSS by fix, barometer with gusts, flow growing with speed, acceleration with the tilt's share of
/// gravity. GNSS loses its lever arm, flow is rotated by yaw, specific force by roll, pitch and yaw and loses
/// gravity, pressure becomes height above the zero that `reference` holds. The run begins on its start mark,
/// or where `reference` places it. Where no barometer is in use GNSS height takes its row; where nothing
/// measures height, the height of the start does, with a large variance.
/// Readings that cannot be used are counted in `ledger`. Pure but for that; safe from any thread.
[[nodiscard]] MeasuredRun measuredRun(const Survey& survey, const Run& run, const FusionOptions& options,
                                      const std::vector<EpochAttitude>& attitudes,
                                      const RunReference& reference, SensorLedger& ledger);

/// F of paper 000, eq 5: constant acceleration over dt_s.
[[nodiscard]] Matrix9d constantAccelerationMatrix(double dt_s);

/// Diagonal of Q for a step of dt_s in the order of the state: the step noise of the options times dt_s over
/// their nominal interval, as variances of white noise add up.
[[nodiscard]] Vector9d stepNoiseDiagonal(const AukfOptions& options, double dt_s);

}  // namespace terrawalk
