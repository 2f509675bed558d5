#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "survey/result.hpp"
#include "survey/survey.hpp"

namespace terrawalk {

// Each file appears whole or not at all. Errors: System when the disk refuses, BadData for a value that the
// file could not hold and the reader would refuse.

/// Writes the array log with the precision of a field logger: time 1 ms, position 1e-9 deg, heights and
/// ranges 1 mm, velocities 0.1 mm/s, angles and angular rates 1e-4 deg, acceleration 1e-4 m/s^2, pressure
/// 0.01 Pa, temperature 0.01 C; fix, flow quality and strength without decimals; auxiliary columns in full.
/// Columns that the log lacks are left out. BadData also for times less than 1 ms apart.
[[nodiscard]] Result<void> writeArrayLog(const ArrayLog& log, const std::filesystem::path& file);
/// Coordinates and sigmas to 0.1 mm.
[[nodiscard]] Result<void> writeControlMarks(const std::vector<ControlMark>& marks,
                                             const std::filesystem::path& file);
/// Where a project's files lie, relative to its folder.
struct ProjectPaths {
    std::string control;            ///< empty: no marks
    std::vector<std::string> logs;  ///< one for each run
};
/// Writes the project file alone, over one that is there. `Run::log` and the marks are not looked at.
[[nodiscard]] Result<void> writeProjectFile(const Survey& survey, const ProjectPaths& paths,
                                            const std::filesystem::path& file);
/// Writes survey.json, control.csv (when there are marks) and logs/<run>.csv into a folder that exists.
/// `readSurvey` reads it back.
[[nodiscard]] Result<void> writeSurvey(const Survey& survey, const std::filesystem::path& folder);

}  // namespace terrawalk
