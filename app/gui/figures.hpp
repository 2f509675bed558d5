#pragma once

#include <QString>

namespace terrawalk::gui {

/// What the window writes lengths in. Coordinates stay in the units of their coordinate system, and settings,
/// files and reports in metres.
enum class LengthUnit { Metre, Foot, UsSurveyFoot };
enum class NumberStyle {
    Plain,    ///< 1234.56
    Grouped,  ///< 1 234.56, with a thin space
    Comma,    ///< 1 234,56
};
struct FigureStyle {
    LengthUnit unit = LengthUnit::Metre;
    NumberStyle numbers = NumberStyle::Plain;
    bool operator==(const FigureStyle&) const = default;
};

/// One for the program. May be asked in any thread.
[[nodiscard]] FigureStyle figureStyle();
void applyFigureStyle(FigureStyle style);
/// As a person chose it last, kept with the program's other preferences.
[[nodiscard]] FigureStyle preferredFigureStyle();
void keepFigureStyle(FigureStyle style);

/// With a true minus, and none before a zero.
[[nodiscard]] QString number(double value, int decimals);
/// A length in the chosen unit, and back.
[[nodiscard]] double inUnit(double metres);
[[nodiscard]] double metresOf(double in_unit);
[[nodiscard]] QString lengthUnit();  ///< e.g. "m"
[[nodiscard]] QString speedUnit();
/// With its unit, e.g. "−0.12 m".
[[nodiscard]] QString lengthText(double metres, int decimals = 2);
/// The same with a sign before every number.
[[nodiscard]] QString signedLength(double metres, int decimals = 3);
[[nodiscard]] QString areaText(double square_metres, int decimals = 1);
/// A round length as a person writes it, without zeros that say nothing, e.g. "20 m", "5 cm".
[[nodiscard]] QString shortLength(double metres);
/// The greatest of 1, 2, 5 times a power of ten units that is no longer than this [m].
[[nodiscard]] double roundLengthBelow(double metres);

}  // namespace terrawalk::gui
