#include "app/gui/tables.hpp"

#include <QHeaderView>
#include <QTableView>
#include <QTableWidgetItem>

namespace terrawalk::gui {

void dressTable(QTableView& table, int row_px) {
    table.verticalHeader()->hide();
    table.verticalHeader()->setDefaultSectionSize(row_px);
    table.setShowGrid(false);
    table.setSelectionBehavior(QAbstractItemView::SelectRows);
    table.setWordWrap(false);
    table.setTabKeyNavigation(false);
    table.horizontalHeader()->setHighlightSections(false);
}

QTableWidgetItem* tableCell(const QString& words, bool number) {
    auto* item = new QTableWidgetItem(words);
    item->setTextAlignment((number ? Qt::AlignRight : Qt::AlignLeft) | Qt::AlignVCenter);
    return item;
}

}  // namespace terrawalk::gui
