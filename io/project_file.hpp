#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "survey/result.hpp"
#include "survey/survey.hpp"

namespace terrawalk {

/// Where the project file names what a run needs, for errors about it.
struct RunSource {
    std::string log;  ///< relative to the project's folder, as written
    std::size_t log_line = 0;
    std::size_t start_line = 0;
    std::size_t target_line = 0;
    std::vector<std::size_t> stop_lines;
};

/// What a project file says, before anything that it names is looked at.
struct ProjectFile {
    Survey survey;        ///< without marks and logs
    std::string control;  ///< relative to the project's folder, as written; empty when there is none
    std::size_t control_line = 0;
    std::string breaklines;  ///< the same for breaklines
    std::size_t breaklines_line = 0;
    std::vector<RunSource> sources;  ///< of survey.runs, in the same order
};

/// Errors: BadData with the line and the path of the key, e.g. "runs[3].log".
[[nodiscard]] Result<ProjectFile> parseProjectFile(std::string_view text, const std::filesystem::path& file);

}  // namespace terrawalk
