#pragma once

#include <string>
#include <vector>

#include "survey/survey_report.hpp"

namespace terrawalk {

// The drawings of the report, each an <svg> element; empty where there is nothing to draw. Pure.

/// Heights that the map and the histogram show: those of the headline group, or of the last group with
/// heights where no check mark was compared. Nothing when there is none.
[[nodiscard]] const AccuracyGroup* shownHeights(const SurveyReport& report);

/// Tracks and marks to scale in the local frame, with the height error at each mark as a bar.
[[nodiscard]] std::string surveyMap(const SurveyReport& report);

/// What the next plot compares: surfaces where there are any, nearest ground points otherwise.
[[nodiscard]] Quantity plottedHeights(const SurveyReport& report);

/// Height error at each mark, before and after fusion, by one measure; check marks first.
[[nodiscard]] std::string heightErrorPlot(const SurveyReport& report);

/// Height error below the array at each stand on a mark.
[[nodiscard]] std::string standErrorPlot(const SurveyReport& report);

/// Error in plan at each stand on a mark, as on a target.
[[nodiscard]] std::string planErrorPlot(const SurveyReport& report);

/// Distribution of the shown heights with the normal curve of the same mean and SD; needs five of them.
[[nodiscard]] std::string heightHistogram(const SurveyReport& report);

/// CSS class of the track of each run, the same on the map and in its key. Area runs come first and so get
/// whole lines.
[[nodiscard]] std::vector<std::string> trackClasses(const SurveyReport& report);

}  // namespace terrawalk
