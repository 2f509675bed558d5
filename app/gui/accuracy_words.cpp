#include "app/gui/accuracy_words.hpp"

#include <QCoreApplication>
#include <optional>

#include "app/gui/figures.hpp"

namespace terrawalk::gui {

namespace {

// For the tool that collects texts.
[[maybe_unused]] constexpr const char* kFigures[] = {
    QT_TRANSLATE_NOOP("RunFigure", "Height RMSE"), QT_TRANSLATE_NOOP("RunFigure", "Height, 95 %"),
    QT_TRANSLATE_NOOP("RunFigure", "Height bias"), QT_TRANSLATE_NOOP("RunFigure", "Plan RMSE"),
    QT_TRANSLATE_NOOP("RunFigure", "Crossovers"),  QT_TRANSLATE_NOOP("RunFigure", "Median σ"),
    QT_TRANSLATE_NOOP("RunFigure", "Area"),        QT_TRANSLATE_NOOP("RunFigure", "Points"),
    QT_TRANSLATE_NOOP("RunFigure", "Cell size")};

std::optional<double> headlineRmse(const SurveyReport& report) {
    if (!report.headline || *report.headline >= report.accuracy.size()) return std::nullopt;
    const auto& up = report.accuracy[*report.headline].up;
    return up ? std::optional(up->rmse_m) : std::nullopt;
}

}  // namespace

QString figureWords(const FigureKind& kind) {
    const QString name = QCoreApplication::translate("RunFigure", std::string(kind.label).c_str());
    const QString unit = kind.unit == "m"
                             ? lengthUnit()
                             : QString::fromUtf8(kind.unit.data(), static_cast<qsizetype>(kind.unit.size()));
    return unit.isEmpty() ? name : QString("%1 (%2)").arg(name, unit);
}

QString figureText(const FigureKind& kind, double value) {
    return number(kind.unit == "m" ? inUnit(value) : value, kind.decimals);
}

QString changeOfFigures(const SurveyReport& before, const SurveyReport& after) {
    const auto was = headlineRmse(before), is = headlineRmse(after);
    if (!was || !is) return {};
    return QCoreApplication::translate("AccuracyWords", "Height RMSE %1 against the last run (%2 → %3).")
        .arg(signedLength(*is - *was), number(inUnit(*was), 3), lengthText(*is, 3));
}

}  // namespace terrawalk::gui
