#pragma once

#include <filesystem>
#include <stop_token>
#include <string_view>
#include <vector>

#include "survey/progress.hpp"
#include "survey/result.hpp"
#include "survey/survey.hpp"

namespace terrawalk {

/// Reads a project file (survey.json) with all logs and marks that it names, and checks that they fit together.
/// Errors: BadData with file and line; Cancelled. Logs are read by several threads; the result does not depend on
/// their number.
[[nodiscard]] Result<Survey> readSurvey(const std::filesystem::path& project_file, Progress& progress,
                                        std::stop_token stop);

/// Reads one array log, version 1. Late rows are put in order and repeated times dropped, both counted with the
/// lines they came from. Refused: no header row, a field that is no number, a row with another number of fields
/// than the header, more than 5 % of rows out of order, a clock that jumps back by more than 60 s.
[[nodiscard]] Result<ArrayLog> readArrayLog(const std::filesystem::path& file, Progress& progress,
                                            std::stop_token stop);
/// The same from memory; `file` only names the source in errors.
[[nodiscard]] Result<ArrayLog> parseArrayLog(std::string_view bytes, const std::filesystem::path& file,
                                             Progress& progress, std::stop_token stop);

/// Reads `point,e_m,n_m,u_m,sigma_h_m,sigma_v_m,role`, columns in any order.
[[nodiscard]] Result<std::vector<ControlMark>> readControlMarks(const std::filesystem::path& file);
[[nodiscard]] Result<std::vector<ControlMark>> parseControlMarks(std::string_view bytes,
                                                                 const std::filesystem::path& file);

}  // namespace terrawalk
