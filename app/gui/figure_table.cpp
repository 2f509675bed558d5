#include "app/gui/figure_table.hpp"

#include <QGridLayout>
#include <QLabel>

#include "app/gui/accuracy_words.hpp"
#include "app/gui/theme.hpp"

namespace terrawalk::gui {

namespace {

constexpr QChar kBetter(0x2713), kWorse(0x2717);

QString verdictWords(int verdict) {
    return verdict > 0 ? FigureTable::tr("better") : verdict < 0 ? FigureTable::tr("worse") : QString();
}

}  // namespace

FigureTable::FigureTable(QWidget* parent) : QWidget(parent), grid_(new QGridLayout(this)) {
    setObjectName("figure_table");
    grid_->setContentsMargins(0, 0, 0, 0);
    grid_->setHorizontalSpacing(kGrid_px);
    grid_->setVerticalSpacing(2);
    grid_->setColumnStretch(0, 1);
}

void FigureTable::addCell(const QString& text, int row, int column, const char* name) {
    auto* label = new QLabel(text);
    label->setObjectName(name);
    grid_->addWidget(label, row, column, (column == 0 ? Qt::AlignLeft : Qt::AlignRight) | Qt::AlignVCenter);
}

void FigureTable::show(const std::vector<FigureChange>& changes, const QString& before) {
    for (QLabel* old : findChildren<QLabel*>(QString(), Qt::FindDirectChildrenOnly)) delete old;
    setVisible(!changes.empty());
    if (changes.empty()) return;
    const QString heads[] = {QString(), tr("Before"), tr("Now"), tr("Change")};
    for (int column = 1; column < 4; ++column) addCell(heads[column], 0, column, "quiet");
    int row = 0;
    for (const FigureChange& change : changes) addRow(change, ++row);
    auto* legend =
        new QLabel(tr("%1 better, %2 worse than the run of %3").arg(kBetter).arg(kWorse).arg(before));
    legend->setObjectName("quiet");
    legend->setWordWrap(true);
    grid_->addWidget(legend, row + 1, 0, 1, 5);
}

void FigureTable::addRow(const FigureChange& change, int row) {
    addCell(figureWords(change.kind), row, 0);
    addCell(figureText(change.kind, change.before), row, 1, "quiet");
    addCell(figureText(change.kind, change.now), row, 2);
    const QString shown = figureText(change.kind, change.change);
    addCell(change.change > 0.0 ? "+" + shown : shown, row, 3);
    const QString words = verdictWords(change.verdict);
    auto* sign = new QLabel(change.verdict > 0 ? kBetter : change.verdict < 0 ? kWorse : QChar(' '));
    sign->setObjectName("verdict");
    sign->setToolTip(words);
    sign->setAccessibleName(words);
    sign->setProperty("verdict", change.verdict);
    sign->setFixedWidth(12);
    grid_->addWidget(sign, row, 4);
}

}  // namespace terrawalk::gui
