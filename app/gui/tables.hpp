#pragma once

#include <QString>

class QTableView;
class QTableWidgetItem;

namespace terrawalk::gui {

/// How all tables of the window look and obey: rows without a grid, Tab leaves the table and arrow keys move
/// in it. Cells are as they were, to be edited or not.
void dressTable(QTableView& table, int row_px);
/// Numbers end at the right.
[[nodiscard]] QTableWidgetItem* tableCell(const QString& words, bool number = false);

}  // namespace terrawalk::gui
