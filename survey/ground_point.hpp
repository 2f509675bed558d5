#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace terrawalk {

/// Why a ground point is used or not.
enum class GroundPointState : std::uint8_t {
    Used,
    NoRange,             ///< the range finder gave nothing in this epoch
    RangeTooShort,       ///< below the finder's least range: a hand or a leaf in front of it
    RangeTooLong,        ///< above the finder's greatest range
    WeakReturn,          ///< strength below the finder's trusted band
    Saturated,           ///< strength above the finder's trusted band
    Tilted,              ///< the array was tilted too far
    PositionUnsure,      ///< sigma of the position above the limit
    Spike,               ///< stands off from its neighbours along the track
    Thinned,             ///< another point stands for this cell
    RunLeftOut,          ///< its run was not asked for
    StatisticalOutlier,  ///< farther from its neighbours than others are
    Isolated,            ///< next to nobody around it
    AboveGround,         ///< on something narrow that stands on the ground: a plant, a hand
};
inline constexpr std::size_t kGroundPointStateCount = 14;

/// Short stable text for files: "used", "no range", ...
[[nodiscard]] std::string_view name(GroundPointState state);

/// One hit of the range finder on the ground. Frame: local ENU.
struct GroundPoint {
    std::uint32_t run = 0;    ///< index of the run in the survey
    std::uint32_t epoch = 0;  ///< index of the epoch in the run's log
    double time_s = 0.0;
    Eigen::Vector3d enu_m = Eigen::Vector3d::Zero();  ///< not finite where there was no range
    double sigma_e_m = 0.0;
    double sigma_n_m = 0.0;
    double sigma_u_m = 0.0;
    GroundPointState state = GroundPointState::Used;
};

}  // namespace terrawalk
