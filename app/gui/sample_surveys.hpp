#pragma once

#include <QString>
#include <filesystem>
#include <vector>

namespace terrawalk::gui {

/// Surveys that ship with the program, where they are found.
struct SampleSurvey {
    QString title;
    std::filesystem::path path;
};
[[nodiscard]] std::vector<SampleSurvey> sampleSurveys();
/// Whether a project file is one of theirs: nothing is written beside these.
[[nodiscard]] bool isSample(const std::filesystem::path& project_file);

}  // namespace terrawalk::gui
