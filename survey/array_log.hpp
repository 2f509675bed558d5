#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "survey/frames.hpp"

namespace terrawalk {

/// What the array measures, one column of the log each. The unit of a channel in memory stands in
/// `kChannels`.
enum class Channel : std::uint8_t {
    Latitude,
    Longitude,
    EllipsoidalHeight,
    Fix,
    GnssHorizontalAccuracy,
    GnssVerticalAccuracy,
    GnssVelocityEast,
    GnssVelocityNorth,
    GnssVelocityUp,
    Pressure,
    Temperature,
    FlowForward,
    FlowLeft,
    FlowQuality,
    Roll,
    Pitch,
    Heading,
    AccelerationX,
    AccelerationY,
    AccelerationZ,
    AngularRateX,
    AngularRateY,
    AngularRateZ,
    Range,
    RangeStrength,
};
inline constexpr std::size_t kChannelCount = 25;

/// Name in the file, and the factor from the file's unit to the unit in memory (degrees become radians, but
/// for latitude and longitude).
struct ChannelInfo {
    std::string_view column;
    double unit_factor;
};
inline constexpr std::array<ChannelInfo, kChannelCount> kChannels{{
    {"lat_deg", 1.0},
    {"lon_deg", 1.0},
    {"h_ell_m", 1.0},
    {"fix", 1.0},
    {"gnss_h_acc_m", 1.0},
    {"gnss_v_acc_m", 1.0},
    {"gnss_ve_mps", 1.0},
    {"gnss_vn_mps", 1.0},
    {"gnss_vu_mps", 1.0},
    {"pressure_pa", 1.0},
    {"temperature_c", 1.0},
    {"flow_vx_mps", 1.0},
    {"flow_vy_mps", 1.0},
    {"flow_quality", 1.0},
    {"roll_deg", kPi / 180.0},
    {"pitch_deg", kPi / 180.0},
    {"heading_deg", kPi / 180.0},
    {"acc_x_mps2", 1.0},
    {"acc_y_mps2", 1.0},
    {"acc_z_mps2", 1.0},
    {"gyr_x_dps", kPi / 180.0},
    {"gyr_y_dps", kPi / 180.0},
    {"gyr_z_dps", kPi / 180.0},
    {"range_m", 1.0},
    {"range_strength", 1.0},
}};

/// The value of a channel in an epoch in which the sensor gave none.
inline constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();
[[nodiscard]] inline bool present(double value) {
    return !std::isnan(value);
}

/// NMEA GGA quality codes, the ones that the program tells apart.
namespace fix_code {
inline constexpr int kNone = 0;
inline constexpr int kSingle = 1;
inline constexpr int kDifferential = 2;
inline constexpr int kRtkFixed = 4;
inline constexpr int kRtkFloat = 5;
}  // namespace fix_code

/// A column that the program does not know. Text that is no number is kept as missing and counted.
struct AuxiliaryColumn {
    std::string name;
    std::vector<double> values;
    std::size_t not_numeric = 0;
};

/// What the reader did with the rows of one log.
struct LogReadReport {
    std::size_t rows_read = 0;                ///< data rows in the file
    std::vector<std::size_t> repeated_lines;  ///< line numbers of rows dropped for a repeated time
    std::vector<std::size_t> late_lines;      ///< line numbers of rows that were put in order
    std::size_t cut_off_line = 0;    ///< a last row cut in the middle and dropped; 0 when there is none
    std::vector<std::string> notes;  ///< e.g. unknown columns and metadata keys, once each
};

/// One log of the array, column by column: channel(c)[i] belongs to time_s[i].
/// Times are strictly increasing. A channel that the file lacks is empty, a value that an epoch lacks is
/// missing.
struct ArrayLog {
    std::filesystem::path file;
    std::string device;
    std::string start_utc;                ///< ISO 8601; empty when not known
    double sample_interval_s = kMissing;  ///< as the header says; missing when it does not
    Eigen::Vector3d range_lever_arm_m = Eigen::Vector3d::Zero();  ///< range finder in the body frame
    Eigen::Vector3d gnss_lever_arm_m = Eigen::Vector3d::Zero();   ///< GNSS antenna in the body frame
    std::vector<double> time_s;
    std::array<std::vector<double>, kChannelCount> channels;
    std::vector<AuxiliaryColumn> auxiliary;
    LogReadReport read_report;

    [[nodiscard]] std::size_t size() const { return time_s.size(); }
    [[nodiscard]] bool has(Channel c) const { return !channels[static_cast<std::size_t>(c)].empty(); }
    /// Value in epoch i; missing when the sensor gave none or the log lacks the column.
    [[nodiscard]] double value(Channel c, std::size_t i) const {
        const auto& column = channels[static_cast<std::size_t>(c)];
        return column.empty() ? kMissing : column[i];
    }
    [[nodiscard]] std::vector<double>& column(Channel c) { return channels[static_cast<std::size_t>(c)]; }
    [[nodiscard]] const std::vector<double>& column(Channel c) const {
        return channels[static_cast<std::size_t>(c)];
    }
};

}  // namespace terrawalk
