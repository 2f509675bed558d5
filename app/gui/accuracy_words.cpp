#include "app/gui/accuracy_words.hpp"

#include <QCoreApplication>
#include <optional>

#include "app/gui/figures.hpp"

namespace terrawalk::gui {

namespace {

std::optional<double> headlineRmse(const SurveyReport& report) {
    if (!report.headline || *report.headline >= report.accuracy.size()) return std::nullopt;
    const auto& up = report.accuracy[*report.headline].up;
    return up ? std::optional(up->rmse_m) : std::nullopt;
}

}  // namespace

QString changeOfFigures(const SurveyReport& before, const SurveyReport& after) {
    const auto was = headlineRmse(before), is = headlineRmse(after);
    if (!was || !is) return {};
    return QCoreApplication::translate("AccuracyWords", "Height RMSE %1 against the last run (%2 → %3).")
        .arg(signedLength(*is - *was), number(inUnit(*was), 3), lengthText(*is, 3));
}

}  // namespace terrawalk::gui
