#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <stop_token>
#include <string>
#include <vector>

#include "app/pipeline/marks_on_map.hpp"
#include "mapping/profile.hpp"
#include "survey/progress.hpp"
#include "survey/result.hpp"

namespace terrawalk {

/// Heights along a line, lengths in the unit of the DEM.
struct ProfileRequest {
    std::filesystem::path dem;
    std::filesystem::path line;         ///< vector file with one line; or
    std::vector<Eigen::Vector2d> path;  ///< its vertices, at least two
    std::filesystem::path output = "profile.csv";
    std::filesystem::path uncertainty;  ///< raster of one sigma; empty: none
    double step = 0.0;                  ///< 0: half a cell
    MarkSource marks;                   ///< shown where they stand near the line
    double mark_distance = 0.0;         ///< farthest from the line; 0: two cells
};

struct ProfileMark {
    std::string name;
    LineOffset place;
    double height = 0.0;
    double sigma = 0.0;
};

struct ProfileOutcome {
    ProfileRequest request;
    std::string unit;
    double length = 0.0;
    std::size_t points = 0;
    std::size_t without_height = 0;
    double lowest = 0.0;
    double highest = 0.0;
    double rise = 0.0;  ///< from the first height to the last
    std::vector<ProfileMark> marks;
    std::vector<std::filesystem::path> files;
};

/// Writes OUTPUT (CSV) and the same name with .svg: the line of heights, a ribbon of 1.96 sigma where there
/// is an uncertainty, and marks. Errors: Usage for a line that is none; BadData; System; Cancelled.
[[nodiscard]] Result<ProfileOutcome> makeProfile(const ProfileRequest& request, Progress& progress,
                                                 std::stop_token stop);

[[nodiscard]] std::string toText(const ProfileOutcome& outcome);
[[nodiscard]] std::string toJson(const ProfileOutcome& outcome);

}  // namespace terrawalk
