#pragma once

#include <QImage>
#include <QWidget>
#include <functional>
#include <memory>

#include "app/gui/terrain_frame.hpp"

namespace terrawalk::gui {

/// Draws frames of the terrain into a widget, by one means or another.
class TerrainCanvas {
  public:
    virtual ~TerrainCanvas() = default;
    [[nodiscard]] virtual QWidget* widget() = 0;
    /// What is drawn from now on; the picture follows soon.
    virtual void setFrame(const TerrainFrame& frame) = 0;
    /// The picture as it is now.
    [[nodiscard]] virtual QImage picture() = 0;
    /// How it draws, for a person to read.
    [[nodiscard]] virtual QString about() const = 0;

    /// Told after each picture: how many triangles, how long it took, and whether all that the frame asked
    /// for was there. Where not, the next picture shows more.
    std::function<void(std::size_t triangles, double ms, bool complete)> drawn;
};

/// What OpenGL 3.3 there is: none, one that a processor imitates, or one on graphics hardware.
enum class OpenGlKind { None, Software, Hardware };
/// Asks once, which takes a while. On platforms without windows Qt's own widget for it crashes, so there
/// nobody tries.
[[nodiscard]] OpenGlKind openGl();
[[nodiscard]] std::unique_ptr<TerrainCanvas> makeOpenGlCanvas(QWidget* parent);
[[nodiscard]] std::unique_ptr<TerrainCanvas> makeSoftwareCanvas(QWidget* parent);

}  // namespace terrawalk::gui
