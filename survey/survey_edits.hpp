#pragma once

#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "survey/breakline.hpp"
#include "survey/result.hpp"
#include "survey/survey.hpp"

namespace terrawalk {

/// Which readings of a stretch are left out.
enum class EditedSensor { All, Gnss, Barometer, Flow, Attitude, Range };
inline constexpr std::array<std::pair<EditedSensor, std::string_view>, 6> kEditedSensors{{
    {EditedSensor::All, "all"},
    {EditedSensor::Gnss, "gnss"},
    {EditedSensor::Barometer, "barometer"},
    {EditedSensor::Flow, "flow"},
    {EditedSensor::Attitude, "attitude"},
    {EditedSensor::Range, "range"},
}};

/// Readings of one run between two times of its log, ends included.
struct ExcludedStretch {
    std::string run;
    double from_s = 0.0;
    double to_s = 0.0;
    EditedSensor sensor = EditedSensor::All;
};

/// What a person changed of a survey, without touching its files.
struct SurveyEdits {
    std::vector<ExcludedStretch> stretches;
    std::vector<std::string> runs;   ///< left out
    std::vector<std::string> marks;  ///< left out: they neither hold the estimator nor count as a check
    std::vector<Breakline> lines;    ///< drawn, in the map frame

    [[nodiscard]] bool empty() const {
        return stretches.empty() && runs.empty() && marks.empty() && lines.empty();
    }
};

/// The survey as edited, with a note for each edit. Epochs keep their place in the log: excluded readings are
/// missing ones. Errors: Usage for a run or mark that the survey lacks, for the zero mark, for a stretch
/// outside its log, and when no run is left.
[[nodiscard]] Result<Survey> withEdits(Survey survey, const SurveyEdits& edits);

}  // namespace terrawalk
