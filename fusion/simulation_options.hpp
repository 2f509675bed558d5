#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include "fusion/disturbance.hpp"

namespace terrawalk {

enum class SimulatedTerrain {
    TerracedOrchard,  ///< terraces with drops of about 1 m, as in paper 000, section 2.2.2
    Gully,            ///< a slope with a winding gully 2.5 m deep
    Plain,            ///< nearly level, gently undulating
    Ridge,            ///< a rounded ridge 4 m high
    Ramp,             ///< an exact plane, for tests: 0.10 up to the east, 0.05 up to the north
};

enum class FaultLevel {
    None,    ///< white noise of the size that the sensors' tables state, and the GNSS's own slow error
    Mild,    ///< a good day in an orchard: drift, gusts, hard iron, grass, shade, a few gaps
    Severe,  ///< a bad day: more and larger of all these
};

enum class GnssMode {
    Single,  ///< single point
    Float,   ///< RTK float
    Rtk,     ///< RTK fixed
    Outage,  ///< RTK fixed, but nothing in the middle fifth of each run and float for 15 s after it
};

/// The names that the command line and reports use.
inline constexpr std::array<std::pair<SimulatedTerrain, std::string_view>, 5> kSimulatedTerrainNames{
    {{SimulatedTerrain::TerracedOrchard, "terraced-orchard"},
     {SimulatedTerrain::Gully, "gully"},
     {SimulatedTerrain::Plain, "plain"},
     {SimulatedTerrain::Ridge, "ridge"},
     {SimulatedTerrain::Ramp, "ramp"}}};
inline constexpr std::array<std::pair<FaultLevel, std::string_view>, 3> kFaultLevelNames{
    {{FaultLevel::None, "none"}, {FaultLevel::Mild, "mild"}, {FaultLevel::Severe, "severe"}}};
inline constexpr std::array<std::pair<GnssMode, std::string_view>, 4> kGnssModeNames{
    {{GnssMode::Single, "single"},
     {GnssMode::Float, "float"},
     {GnssMode::Rtk, "rtk"},
     {GnssMode::Outage, "outage"}}};

[[nodiscard]] std::string_view name(SimulatedTerrain terrain);
[[nodiscard]] std::string_view name(FaultLevel level);
[[nodiscard]] std::string_view name(GnssMode mode);

/// What to simulate. The defaults are the survey of paper 000, section 2.2.2. Changing one option leaves the
/// random numbers of everything else as they were.
struct SimulationOptions {
    std::uint64_t seed = 1;
    SimulatedTerrain terrain = SimulatedTerrain::TerracedOrchard;
    FaultLevel faults = FaultLevel::Mild;
    /// Multiplies every error of sensors, marks and of standing on them. With 0, and without faults, sensors
    /// are exact and the range finder does not round.
    double noise_scale = 1.0;

    double area_east_m =
        50.0;  ///< the walked rectangle; ZERO lies at half its width and a sixth of its depth
    double area_north_m = 60.0;
    double line_spacing_m = 3.0;

    double sample_interval_s = 0.2;
    std::size_t fixed_point_runs =
        16;  ///< F01.. from ZERO to P01.., control marks 10 to 45 m away, as far as room and time allow
    std::size_t fixed_point_rounds = 1;    ///< so often each of their targets is walked to
    std::size_t fixed_point_epochs = 259;  ///< rows in each of their logs
    std::size_t area_epochs = 9141;        ///< rows in the log of the area walk S01; 0: no area walk

    std::size_t control_stops = 4;  ///< stops of the area walk on control marks
    std::size_t check_stops = 0;    ///< and on check marks
    bool end_on_zero = true;        ///< the area walk comes back to ZERO and says so
    std::size_t check_points = 60;  ///< C01.., spread over the area
    double mark_sigma_h_m = 0.005;  ///< total station, per horizontal axis
    double mark_sigma_v_m = 0.005;

    GnssMode gnss = GnssMode::Single;
    std::vector<Disturbance> disturbances;  ///< put into the finished logs, in this order
    bool doppler_velocity = false;          ///< whether the receiver gives its velocity as well
    Eigen::Vector3d range_lever_arm_m = Eigen::Vector3d::Zero();  ///< body frame
    Eigen::Vector3d gnss_lever_arm_m = Eigen::Vector3d::Zero();   ///< body frame
};

}  // namespace terrawalk
