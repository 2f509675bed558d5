#pragma once

#include <filesystem>

#include "survey/result.hpp"
#include "survey/survey.hpp"

namespace terrawalk {

/// Writes the array log with the precision of a field logger: time 1 ms, position 1e-9 deg, heights 1 mm. What the
/// log lacks is left out.
[[nodiscard]] Result<void> writeArrayLog(const ArrayLog& log, const std::filesystem::path& file);
[[nodiscard]] Result<void> writeControlMarks(const std::vector<ControlMark>& marks,
                                             const std::filesystem::path& file);
/// Writes survey.json, control.csv and logs/<run>.csv into a folder that exists. `readSurvey` reads it back.
[[nodiscard]] Result<void> writeSurvey(const Survey& survey, const std::filesystem::path& folder);

}  // namespace terrawalk
