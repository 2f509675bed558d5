#pragma once

#include <filesystem>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "survey/progress.hpp"
#include "survey/result.hpp"
#include "survey/survey.hpp"

namespace terrawalk {

// All functions are pure but for the files they read, and safe from any thread.

/// Reads a project file (survey.json) with all logs and marks that it names, and checks that they fit
/// together. Keys that mean nothing to the program stand in Survey::notes. Errors: BadData with file and
/// line, System when the machine refuses to read a file, Cancelled. Logs are read by several threads; neither
/// the result nor the error depends on their number: of several bad logs the first run's is reported.
[[nodiscard]] Result<Survey> readSurvey(const std::filesystem::path& project_file, Progress& progress,
                                        std::stop_token stop);

/// Reads one array log, version 1. Holds the columns and one block of text in memory, not the file.
///
/// - Rows whose time is below that of an earlier row are late: they are put in order. Of rows with the same
/// time the
///   first in the file stays. Both are counted with their lines in the report.
/// - A last row without a line end may have been cut in the middle. It is kept (with a note) only when its
/// last
///   number has as many decimals as the same number in the rows before it, at least one; else it is dropped
///   and stands in LogReadReport::cut_off_line.
/// - A position with only one of latitude and longitude is missing, with a note.
/// - A log without a `format` line is read as version 1, with a note.
///
/// Errors: BadData with file, line and column, for: no header row, a field of a known column that is no
/// finite number or outside its range, a row with another number of fields than the header, no rows, more
/// than 5 % of the rows late, a clock that jumps back by more than 60 s, NUL bytes, a line of more than 64
/// KiB. System; Cancelled.
[[nodiscard]] Result<ArrayLog> readArrayLog(const std::filesystem::path& file, Progress& progress,
                                            std::stop_token stop);
/// The same from memory; `file` only names the source in errors.
[[nodiscard]] Result<ArrayLog> parseArrayLog(std::string_view bytes, const std::filesystem::path& file,
                                             Progress& progress, std::stop_token stop);

struct ControlMarkTable {
    std::vector<ControlMark> marks;  ///< without ZERO, in the order of the file
    std::vector<std::string> notes;  ///< e.g. columns that mean nothing to the program
};

/// Reads `point,e_m,n_m,u_m,sigma_h_m,sigma_v_m,role`, columns in any order. Errors: BadData with file and
/// line, System when the machine refuses to read the file.
[[nodiscard]] Result<ControlMarkTable> readControlMarks(const std::filesystem::path& file);
[[nodiscard]] Result<ControlMarkTable> parseControlMarks(std::string_view bytes,
                                                         const std::filesystem::path& file);

}  // namespace terrawalk
