#include "app/gui/accuracy_words.hpp"

#include <QCoreApplication>
#include <optional>

namespace terrawalk::gui {

namespace {

std::optional<double> headlineRmse(const SurveyReport& report) {
    if (!report.headline || *report.headline >= report.accuracy.size()) return std::nullopt;
    const auto& up = report.accuracy[*report.headline].up;
    return up ? std::optional(up->rmse_m) : std::nullopt;
}

}  // namespace

QString signedLength(double metres, int decimals) {
    const QString number = QString::number(std::abs(metres), 'f', decimals);
    return (metres < 0.0 ? QString(QChar(0x2212)) : QStringLiteral("+")) + number + " m";
}

QString changeOfFigures(const SurveyReport& before, const SurveyReport& after) {
    const auto was = headlineRmse(before), is = headlineRmse(after);
    if (!was || !is) return {};
    return QCoreApplication::translate("AccuracyWords", "Height RMSE %1 against the last run (%2 → %3 m).")
        .arg(signedLength(*is - *was), QString::number(*was, 'f', 3), QString::number(*is, 'f', 3));
}

}  // namespace terrawalk::gui
