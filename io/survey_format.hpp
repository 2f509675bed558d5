#pragma once

#include <algorithm>
#include <array>
#include <string_view>

namespace terrawalk {

/// What the reader and the writer of surveys agree on.
inline constexpr std::string_view kArrayLogFormat = "array-log 1";
inline constexpr std::string_view kProjectFormat = "terrawalk-survey 1";
inline constexpr std::string_view kTimeColumn = "time_s";
inline constexpr std::array<std::string_view, 7> kControlColumns{"point",     "e_m",       "n_m", "u_m",
                                                                 "sigma_h_m", "sigma_v_m", "role"};
/// Columns of a trajectory file.
inline constexpr std::array<std::string_view, 15> kTrajectoryColumns{
    "time_s",           "e_m",       "n_m",       "u_m",      "ve_mps",    "vn_mps",      "vu_mps",
    "sigma_e_m",        "sigma_n_m", "sigma_u_m", "roll_deg", "pitch_deg", "heading_deg", "sigma_tilt_deg",
    "sigma_heading_deg"};

/// Output files are named by the run: letters, digits, '.', '_' and '-', at most 64, no dot in front.
[[nodiscard]] inline bool isSafeRunId(std::string_view id) {
    const auto safe = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' ||
               c == '_' || c == '-';
    };
    return !id.empty() && id.size() <= 64 && id.front() != '.' && std::all_of(id.begin(), id.end(), safe);
}

}  // namespace terrawalk
