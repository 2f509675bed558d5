#pragma once

#include <QThreadPool>

namespace terrawalk::gui {

/// Where pictures are made beside the window. Not Qt's own pool: its painter fills large areas there and
/// waits for them, behind whatever else stands in the line. From the window's thread.
[[nodiscard]] QThreadPool* backgroundPool();

}  // namespace terrawalk::gui
