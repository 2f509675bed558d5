#pragma once

#include <QColor>
#include <QIcon>
#include <QString>

class QWidget;

namespace terrawalk::gui {

enum class Theme { Light, Dark };

/// Colours, sizes and style of the whole program: one accent colour, spaces in steps of eight pixels.
void applyTheme(Theme theme);
[[nodiscard]] Theme currentTheme();
/// What the desktop seems to like, by its own colours; to be asked before the first applyTheme().
[[nodiscard]] Theme desktopTheme();
[[nodiscard]] QColor accentColour();
/// Of text that says less, and readable all the same.
[[nodiscard]] QColor quietColour();
[[nodiscard]] QColor warningColour();
[[nodiscard]] QColor errorColour();

/// Makes icons and translations found; the functions here do so themselves.
void registerResources();

/// One of the program's own icons, in the colour of text unless another is given.
[[nodiscard]] QIcon icon(const QString& name, const QColor& colour = {});
/// The same for a button that stands on the accent colour while it is checked.
[[nodiscard]] QIcon toolIcon(const QString& name);

/// The wheel is for the panel that scrolls: it must not change a value that it only passes over. The editor
/// takes it once it has the focus.
void keepFromWheel(QWidget& editor);

inline constexpr int kGrid_px = 8;

}  // namespace terrawalk::gui
