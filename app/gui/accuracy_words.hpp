#pragma once

#include <QString>

#include "app/pipeline/run_history.hpp"

namespace terrawalk::gui {

/// The height error of the run before, in a short sentence; empty where it is not known.
[[nodiscard]] QString figureBefore(const RunFigures& before);

/// A figure's name, with its unit.
[[nodiscard]] QString figureWords(const FigureKind& kind);
/// Its value at the decimals that are shown, with a true minus.
[[nodiscard]] QString figureText(const FigureKind& kind, double value);

}  // namespace terrawalk::gui
