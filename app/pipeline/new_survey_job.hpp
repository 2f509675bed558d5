#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "app/pipeline/survey_draft.hpp"
#include "survey/progress.hpp"
#include "survey/result.hpp"

namespace terrawalk {

/// A survey from the files that a walk leaves: array logs, and a table of marks. What is not said is guessed.
struct NewSurveyRequest {
    std::vector<std::filesystem::path> files;  ///< logs, tables of marks, and folders that hold them
    std::filesystem::path marks;               ///< empty: the table among `files`, if there is one
    std::filesystem::path output;              ///< empty: survey.json in the folder that holds all files
    std::string name;                          ///< empty: the folder's name
    std::optional<GeodeticPosition> zero_point;
    std::optional<std::string> crs;              ///< empty text: the local frame is the map
    std::map<std::string, std::string> targets;  ///< these runs are fixed-point runs to these marks
    std::vector<std::string> area_runs;
    bool replace = false;  ///< a survey.json that is there already
};

/// Reads the files and guesses; writes nothing. Files that cannot be used stand in SurveyDraft::bad_files; of
/// a folder, tables that are neither logs nor marks are passed over with a note. Errors: Usage without any
/// file, and for runs that are not there; Cancelled.
[[nodiscard]] Result<SurveyDraft> draftSurvey(const NewSurveyRequest& request, Progress& progress,
                                              std::stop_token stop);

struct NewSurveyOutcome {
    SurveyDraft survey;
};

/// Writes the project file, whole or not at all. Errors: the first of bad_files and problemOf(); Usage for a
/// file that is there already, and for files that lie outside the project's folder; BadData for a CRS that
/// cannot be used; System.
[[nodiscard]] Result<NewSurveyOutcome> writeDraft(const SurveyDraft& draft, bool replace);

/// Both. All that is wrong is told as warnings, and the first as the error.
[[nodiscard]] Result<NewSurveyOutcome> makeNewSurvey(const NewSurveyRequest& request, Progress& progress,
                                                     std::stop_token stop);

[[nodiscard]] std::string toText(const NewSurveyOutcome& outcome);
[[nodiscard]] std::string toJson(const NewSurveyOutcome& outcome);

}  // namespace terrawalk
