#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "survey/array_log.hpp"
#include "survey/breakline.hpp"
#include "survey/frames.hpp"

namespace terrawalk {

enum class MarkRole {
    Control,  ///< may be used for alignment and tuning
    Check,    ///< may only ever be used to report errors
};

/// A mark on the ground measured by total station; `enu_m` is the mark itself, not the array above it.
struct ControlMark {
    std::string name;
    Eigen::Vector3d enu_m = Eigen::Vector3d::Zero();
    double sigma_h_m = 0.0;  ///< per horizontal axis, 1 sigma
    double sigma_v_m = 0.0;
    MarkRole role = MarkRole::Control;
};

/// The zero point, always known: (0, 0, 0) in the local frame, role control.
inline constexpr std::string_view kZeroMark = "ZERO";

enum class RunKind {
    FixedPoint,  ///< from a known start mark to a known target mark, standing still on both
    Area,        ///< the walk that covers the field
};

/// A stretch of time during which the array stood still over a mark.
struct Stop {
    std::string point;
    double from_s = 0.0;
    double to_s = 0.0;
};

struct Run {
    std::string id;
    RunKind kind = RunKind::Area;
    std::optional<std::string> start;   ///< mark on which the run begins
    std::optional<std::string> target;  ///< mark on which it ends
    std::vector<Stop> stops;
    ArrayLog log;
};

/// A survey as read, checked and complete: every mark that a run names exists.
struct Survey {
    std::filesystem::path project_file;
    std::string name;
    GeodeticPosition zero_point;
    std::string crs;  ///< as the project says, e.g. "EPSG:32649"; empty: the local frame is the map frame
    std::string vertical_datum = "local";
    std::filesystem::path control_file;    ///< empty when the survey has no marks
    std::vector<ControlMark> marks;        ///< without ZERO
    std::filesystem::path breakline_file;  ///< empty when the survey has none
    std::vector<Breakline> breaklines;     ///< in the map frame
    std::string breakline_crs;             ///< of their file, as WKT; empty where it has none
    std::vector<Run> runs;
    std::vector<std::string> notes;  ///< odd but harmless things that the reader met

    [[nodiscard]] LocalFrame frame() const { return LocalFrame(zero_point); }
    /// The mark of that name, ZERO included; nothing when there is none.
    [[nodiscard]] std::optional<ControlMark> findMark(std::string_view mark_name) const;
};

[[nodiscard]] std::string_view name(MarkRole role);
[[nodiscard]] std::string_view name(RunKind kind);

}  // namespace terrawalk
