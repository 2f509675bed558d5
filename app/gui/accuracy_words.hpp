#pragma once

#include <QString>

#include "app/pipeline/run_history.hpp"
#include "survey/survey_report.hpp"

namespace terrawalk::gui {

/// What became of the headline accuracy between two runs, in a sentence; empty where they cannot be compared.
[[nodiscard]] QString changeOfFigures(const SurveyReport& before, const SurveyReport& after);

/// A figure's name, with its unit.
[[nodiscard]] QString figureWords(const FigureKind& kind);
/// Its value at the decimals that are shown, with a true minus.
[[nodiscard]] QString figureText(const FigureKind& kind, double value);

}  // namespace terrawalk::gui
