#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "survey/survey_report.hpp"

namespace terrawalk {

// The one place where the report's claims are worded. The sentences follow the ASPRS Positional Accuracy
// Standards for Digital Geospatial Data, Edition 2, as far as the program can know: it states what was found,
// and claims an accuracy class only where one was asked for (report.vertical_class_m) and 30 check marks that
// are sure enough tell that it is met.

/// The group that speaks for the product: heights at check marks, of the latest stage that was compared.
/// Nothing when no check mark was compared. An index into `groups`.
[[nodiscard]] std::optional<std::size_t> headlineGroup(const std::vector<AccuracyGroup>& groups);

// The three functions below read report.accuracy and report.headline.

/// Three figures: height error, check marks, resolution and area.
[[nodiscard]] std::vector<KeyFigure> keyFigures(const SurveyReport& report);

/// What the marks say about the product: error found, gain over the sensors as they are, bias, possible
/// blunders, honesty of the predicted sigmas.
[[nodiscard]] std::vector<std::string> accuracyStatements(const SurveyReport& report);

/// What could not be checked, as far as it follows from marks and residuals: no marks, no check marks, too
/// few of them, marks that met no surface or no point, residuals that the estimator has seen.
[[nodiscard]] std::vector<std::string> accuracyLimitations(const SurveyReport& report);

/// The report with blunders, accuracy, strata, figures and statements filled in from its marks and residuals,
/// and the limitations above put before those that it has. Call once, when everything else is in. Pure; safe
/// from any thread.
[[nodiscard]] SurveyReport withAccuracy(SurveyReport report);

}  // namespace terrawalk
