#include "app/gui/accuracy_words.hpp"

#include <QCoreApplication>
#include <cmath>

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

QString figureBefore(const RunFigures& before) {
    const auto rmse = before.find("height_rmse_m");
    if (rmse == before.end()) return {};
    return QCoreApplication::translate("AccuracyWords", "Before: %1 m.")
        .arg(QString::number(rmse->second, 'f', 3));
}

}  // namespace terrawalk::gui
