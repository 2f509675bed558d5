#include "app/gui/figures.hpp"

#include <QSettings>
#include <algorithm>
#include <atomic>
#include <cmath>

#include "app/gui/round_numbers.hpp"

namespace terrawalk::gui {

namespace {

std::atomic<FigureStyle>& chosen() {
    static std::atomic<FigureStyle> style{FigureStyle{}};
    return style;
}

double metresPerUnit() {
    switch (figureStyle().unit) {
        case LengthUnit::Foot:
            return 0.3048;
        case LengthUnit::UsSurveyFoot:
            return 1200.0 / 3937.0;
        case LengthUnit::Metre:
            break;
    }
    return 1.0;
}

void groupDigits(QString& digits) {
    const auto point = digits.indexOf('.');
    const qsizetype first = digits.startsWith(QChar(0x2212)) ? 1 : 0;
    for (qsizetype at = (point < 0 ? digits.size() : point) - 3; at > first; at -= 3) {
        digits.insert(at, QChar(0x2009));
    }
}

}  // namespace

FigureStyle figureStyle() {
    return chosen();
}

void applyFigureStyle(FigureStyle style) {
    chosen() = style;
}

FigureStyle preferredFigureStyle() {
    const QSettings kept;
    const auto choice = [&](const char* key) {
        return std::clamp(kept.value(key).toInt(), 0, 2);
    };
    return {static_cast<LengthUnit>(choice("length_unit")), static_cast<NumberStyle>(choice("number_style"))};
}

void keepFigureStyle(FigureStyle style) {
    QSettings kept;
    kept.setValue("length_unit", static_cast<int>(style.unit));
    kept.setValue("number_style", static_cast<int>(style.numbers));
}

QString number(double value, int decimals) {
    QString digits = QString::number(value, 'f', decimals);
    if (std::none_of(digits.begin(), digits.end(), [](QChar c) { return c >= '1' && c <= '9'; }))
        digits.remove('-');
    digits.replace('-', QChar(0x2212));
    const NumberStyle style = figureStyle().numbers;
    if (style != NumberStyle::Plain && std::isfinite(value)) groupDigits(digits);
    if (style == NumberStyle::Comma) digits.replace('.', ',');
    return digits;
}

double inUnit(double metres) {
    return metres / metresPerUnit();
}

double metresOf(double in_unit) {
    return in_unit * metresPerUnit();
}

QString lengthUnit() {
    switch (figureStyle().unit) {
        case LengthUnit::Foot:
            return "ft";
        case LengthUnit::UsSurveyFoot:
            return "US ft";
        case LengthUnit::Metre:
            break;
    }
    return "m";
}

QString speedUnit() {
    return lengthUnit() + "/s";
}

QString lengthText(double metres, int decimals) {
    return number(inUnit(metres), decimals) + ' ' + lengthUnit();
}

QString signedLength(double metres, int decimals) {
    const QString length = lengthText(metres, decimals);
    return length.startsWith(QChar(0x2212)) ? length : '+' + length;
}

QString areaText(double square_metres, int decimals) {
    return number(inUnit(inUnit(square_metres)), decimals) + ' ' + lengthUnit() + QChar(0x00B2);
}

QString shortLength(double metres) {
    if (figureStyle().unit != LengthUnit::Metre)
        return QString::number(inUnit(metres), 'g', 4) + ' ' + lengthUnit();
    if (metres >= 1000.0) return QString::number(metres / 1000.0, 'g', 4) + " km";
    if (metres >= 1.0) return QString::number(metres, 'g', 4) + " m";
    return QString::number(metres * 100.0, 'g', 3) + " cm";
}

double roundLengthBelow(double metres) {
    return metresOf(roundBelow(inUnit(metres)));
}

}  // namespace terrawalk::gui
