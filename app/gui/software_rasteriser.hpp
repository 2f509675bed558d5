#pragma once

#include <QImage>
#include <QSize>
#include <vector>

#include "app/gui/terrain_frame.hpp"

namespace terrawalk::gui {

/// Draws a frame into a picture without any graphics hardware: z-buffer, tints shaded by the light, contours,
/// lines and dots. The same frame and blocks give the same pixels, on any number of threads.
/// @param blocks   of the frame's scene
/// @param size_px  of the picture
/// @param samples  along each axis of a pixel, 1 or 2
[[nodiscard]] QImage rasterise(const TerrainFrame& frame, const std::vector<BlockStore::Ready>& blocks,
                               QSize size_px, int samples);

}  // namespace terrawalk::gui
