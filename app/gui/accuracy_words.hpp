#pragma once

#include <QString>

#include "survey/survey_report.hpp"

namespace terrawalk::gui {

/// What became of the headline accuracy between two runs, in a sentence; empty where they cannot be compared.
[[nodiscard]] QString changeOfFigures(const SurveyReport& before, const SurveyReport& after);

}  // namespace terrawalk::gui
