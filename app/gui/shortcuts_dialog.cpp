#include "app/gui/shortcuts_dialog.hpp"

#include <QDialogButtonBox>
#include <QGridLayout>
#include <QLabel>
#include <QRegularExpression>
#include <QVBoxLayout>

#include "app/gui/theme.hpp"

namespace terrawalk::gui {

namespace {

struct Row {
    QString keys;
    QString meaning;
};

QLabel* keyLabel(const QString& keys) {
    auto* label = new QLabel(keys);
    label->setObjectName("key");
    return label;
}

QGridLayout* table(const QString& title, const QList<Row>& rows) {
    auto* grid = new QGridLayout;
    grid->setHorizontalSpacing(2 * kGrid_px);
    grid->setVerticalSpacing(4);
    auto* head = new QLabel(title);
    head->setObjectName("cardTitle");
    grid->addWidget(head, 0, 0, 1, 2);
    for (const Row& row : rows) {
        const int at = grid->rowCount();
        grid->addWidget(keyLabel(row.keys), at, 0, Qt::AlignLeft);
        grid->addWidget(new QLabel(row.meaning), at, 1);
    }
    grid->setColumnStretch(1, 1);
    return grid;
}

Row rowOf(const QAction& action) {
    const QVariant plain = action.property(kPlainMeaning);
    QString meaning = plain.isValid() ? plain.toString() : action.text();
    // Chinese menus keep the letter of a mnemonic in brackets.
    static const QRegularExpression kMnemonic(R"(\s*\(&\w\))");
    meaning.remove(kMnemonic).remove('&').remove("…");
    return {action.shortcut().toString(QKeySequence::NativeText), meaning};
}

}  // namespace

ShortcutsDialog::ShortcutsDialog(const std::map<QString, QAction*>& actions, const QList<QAction*>& tools,
                                 QWidget* parent)
    : QDialog(parent) {
    setObjectName("shortcuts_dialog");
    setWindowTitle(tr("Keys"));
    QList<Row> window, map_tools;
    for (const auto& [name, action] : actions) {
        if (!action->shortcut().isEmpty()) window << rowOf(*action);
    }
    for (const QAction* tool : tools) map_tools << rowOf(*tool);
    const QList<Row> terrain{{tr("Arrows"), tr("Turn the view")},
                             {tr("Shift+Arrows"), tr("Move the view")},
                             {"+  −", tr("Nearer and farther")},
                             {"Home", tr("The first view again")},
                             {"Esc", tr("Ask for no place any more")}};
    const QList<Row> plots{{"←  →", tr("Earlier and later")},
                           {"+  −", tr("Zoom the time axis")},
                           {"Shift+←  →", tr("Move the end of a stretch")},
                           {"Ctrl+←  →", tr("Move its start")},
                           {"Home", tr("Show all")}};
    const QList<Row> moves{{tr("Arrows"), tr("Move the map")},
                           {"+  −", tr("Zoom in and out")},
                           {"Home", tr("Show all")},
                           {tr("Space"), tr("Show a cross, then click there")},
                           {tr("Arrows"), tr("Move the cross, by a pixel with Shift")},
                           {"Enter", tr("End a line")},
                           {"Backspace", tr("Take the last vertex back")},
                           {"Esc", tr("Leave the tool, select nothing")}};
    auto* columns = new QHBoxLayout;
    columns->setSpacing(5 * kGrid_px);
    auto* left = new QVBoxLayout;
    left->addLayout(table(tr("Window"), window));
    left->addStretch(1);
    columns->addLayout(left);
    auto* right = new QVBoxLayout;
    right->addLayout(table(tr("Tools"), map_tools));
    right->addSpacing(2 * kGrid_px);
    right->addLayout(table(tr("On the map"), moves));
    right->addStretch(1);
    columns->addLayout(right);
    auto* views = new QVBoxLayout;
    views->addLayout(table(tr("In three dimensions"), terrain));
    views->addSpacing(2 * kGrid_px);
    views->addLayout(table(tr("On the plots"), plots));
    views->addStretch(1);
    columns->addLayout(views);
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(3 * kGrid_px, 3 * kGrid_px, 3 * kGrid_px, 2 * kGrid_px);
    column->setSpacing(2 * kGrid_px);
    column->addLayout(columns);
    column->addWidget(buttons);
}

}  // namespace terrawalk::gui
