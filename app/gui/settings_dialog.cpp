#include "app/gui/settings_dialog.hpp"

#include <QAction>
#include <QCheckBox>
#include <QDialogButtonBox>
#include <QElapsedTimer>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QPushButton>
#include <QScrollArea>
#include <QScrollBar>
#include <QSignalBlocker>
#include <QTimer>
#include <QVBoxLayout>
#include <algorithm>

#include "app/gui/run_settings.hpp"
#include "app/gui/setting_editor.hpp"
#include "app/gui/setting_words.hpp"
#include "app/gui/survey_session.hpp"
#include "app/gui/theme.hpp"

namespace terrawalk::gui {

namespace {

constexpr int kTurn_ms = 8;

}

/// A setting: name and meaning at the left, its editor at the right.
class SettingRow : public QWidget {
  public:
    SettingRow(SurveySession& session, const QString& key)
        : session_(session), key_(key), searched_(settingSearchText(key)) {
        setObjectName("settingRow");
        setAttribute(Qt::WA_StyledBackground);
        auto* row = new QHBoxLayout(this);
        row->setContentsMargins(0, kGrid_px, 0, kGrid_px);
        row->setSpacing(2 * kGrid_px);
        auto* words = new QVBoxLayout;
        words->setSpacing(2);
        name_ = new QLabel(settingName(key));
        name_->setObjectName("settingName");
        auto* meaning = new QLabel(settingMeaning(key));
        meaning->setObjectName("quiet");
        meaning->setWordWrap(true);
        words->addWidget(name_);
        words->addWidget(meaning);
        row->addLayout(words, 1);
        auto* editor = new SettingEditor(session, key);
        editor->setFixedWidth(232);
        editor->keepRoomForReset();
        name_->setBuddy(editor);
        setToolTip(editor->toolTip());
        row->addWidget(editor, 0, Qt::AlignVCenter);
        showChanged();
    }
    [[nodiscard]] bool changed() const { return session_.settings().changed(key_.toStdString()); }
    [[nodiscard]] bool matches(const QStringList& words) const {
        return std::all_of(words.begin(), words.end(),
                           [this](const QString& word) { return searched_.contains(word); });
    }
    void showChanged() { markChanged(*name_, changed()); }

  private:
    SurveySession& session_;
    QString key_;
    QString searched_;
    QLabel* name_ = nullptr;
};

SettingsDialog::SettingsDialog(SurveySession& session, QWidget* parent) : QDialog(parent), session_(session) {
    setObjectName("settings_dialog");
    setWindowTitle(tr("All settings"));
    resize(880, 640);
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(0, 0, 0, 0);
    column->setSpacing(0);
    column->addWidget(buildSearch());
    auto* middle = new QHBoxLayout;
    middle->setSpacing(0);
    middle->addWidget(buildList());
    scroll_ = new QScrollArea;
    scroll_->setWidgetResizable(true);
    scroll_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    scroll_->setFocusPolicy(Qt::NoFocus);
    middle->addWidget(scroll_, 1);
    column->addLayout(middle, 1);
    column->addWidget(buildFooter());
    plan();
    connect(&next_parts_, &QTimer::timeout, this, &SettingsDialog::makeSomeParts);
    connect(scroll_->verticalScrollBar(), &QScrollBar::valueChanged, this, &SettingsDialog::followScroll);
    connect(&session_, &SurveySession::settingsChanged, this, &SettingsDialog::showChanged);
    auto* find = new QAction(this);
    find->setShortcut(QKeySequence::Find);
    addAction(find);
    connect(find, &QAction::triggered, this, [this] {
        search_->setFocus();
        search_->selectAll();
    });
}

QWidget* SettingsDialog::buildSearch() {
    auto* bar = new QWidget;
    auto* row = new QHBoxLayout(bar);
    row->setContentsMargins(2 * kGrid_px, 2 * kGrid_px, 2 * kGrid_px, 2 * kGrid_px);
    row->setSpacing(2 * kGrid_px);
    search_ = new QLineEdit;
    search_->setObjectName("setting_search");
    search_->setPlaceholderText(tr("Search by name, key or meaning, in English or Chinese"));
    search_->setAccessibleName(tr("Search"));
    search_->setClearButtonEnabled(true);
    search_icon_ = search_->addAction(QIcon(), QLineEdit::LeadingPosition);
    only_changed_ = new QCheckBox;
    only_changed_->setObjectName("only_changed");
    row->addWidget(search_, 1);
    row->addWidget(only_changed_);
    connect(search_, &QLineEdit::textChanged, this, &SettingsDialog::filter);
    connect(only_changed_, &QCheckBox::toggled, this, &SettingsDialog::filter);
    return bar;
}

QWidget* SettingsDialog::buildList() {
    list_ = new QListWidget;
    list_->setObjectName("settingGroups");
    list_->setAccessibleName(tr("Groups of settings"));
    list_->setFixedWidth(232);
    list_->setIconSize({16, 16});
    list_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    connect(list_, &QListWidget::currentRowChanged, this, &SettingsDialog::scrollTo);
    return list_;
}

QWidget* SettingsDialog::buildFooter() {
    auto* footer = new QWidget;
    footer->setObjectName("footer");
    auto* row = new QHBoxLayout(footer);
    row->setContentsMargins(2 * kGrid_px, kGrid_px, 2 * kGrid_px, kGrid_px);
    reset_ = new QPushButton(tr("Reset all"));
    reset_->setObjectName("reset_all");
    reset_->setToolTip(
        tr("All settings back to their defaults; edits of the survey stay, and undo brings them back"));
    reset_->setAutoDefault(false);
    connect(reset_, &QPushButton::clicked, &session_, &SurveySession::resetSettings);
    auto* close = new QPushButton(tr("Close"));
    close->setAutoDefault(false);
    connect(close, &QPushButton::clicked, this, &QDialog::close);
    row->addWidget(reset_);
    row->addStretch();
    row->addWidget(close);
    return footer;
}

void SettingsDialog::plan() {
    auto* page = new QWidget;
    auto* column = new QVBoxLayout(page);
    column->setContentsMargins(3 * kGrid_px, 0, 2 * kGrid_px, 2 * kGrid_px);
    column->setSpacing(0);
    nothing_ = new QLabel(tr("No setting is like that."));
    nothing_->setObjectName("quiet");
    nothing_->setContentsMargins(0, 3 * kGrid_px, 0, 0);
    column->addWidget(nothing_);
    scroll_->setWidget(page);
    for (const Step& step : steps()) {
        const QStringList prefixes = settingGroups(step);
        if (prefixes.isEmpty()) continue;
        parts_.emplace_back([this, step] { addStep(step); });
        for (const QString& prefix : prefixes) {
            parts_.emplace_back([this, step, prefix] { addGroup(step, prefix, step_icons_.back().first); });
            for (const ParameterInfo& info : knownParameters()) {
                const QString key = QString::fromStdString(info.key);
                if (settingPrefix(key) == prefix) parts_.emplace_back([this, key] { addRow(key); });
            }
        }
    }
    parts_.emplace_back([this, column] {
        column->addStretch();
        themeChanged();
        showChanged();
        filter();
    });
}

void SettingsDialog::makeSomeParts() {
    QElapsedTimer turn;
    turn.start();
    while (parts_made_ < parts_.size() && turn.elapsed() < kTurn_ms) parts_[parts_made_++]();
    if (parts_made_ < parts_.size()) return;
    next_parts_.stop();
    present();
}

void SettingsDialog::openAt(StepKind step) {
    wanted_step_ = step;
    if (parts_made_ < parts_.size()) {
        next_parts_.start();
    } else {
        present();
    }
}

void SettingsDialog::present() {
    show();
    raise();
    activateWindow();
    search_->setFocus();
    scrollToStep();
}

void SettingsDialog::addStep(const Step& step) {
    step_icons_.emplace_back(list_->count(), step.icon);
    auto* head = new QListWidgetItem(step.title, list_);
    head->setFlags(Qt::ItemIsEnabled);
    QFont bold = head->font();
    bold.setBold(true);
    head->setFont(bold);
}

void SettingsDialog::addGroup(const Step& step, const QString& prefix, int step_row) {
    Group group{prefix, settingGroupWords(prefix), step.kind, nullptr, {}, list_->count(), step_row};
    auto* heading = new QLabel(group.title);
    heading->setObjectName("heading");
    heading->setContentsMargins(0, 3 * kGrid_px, 0, kGrid_px / 2);
    heading->setToolTip(prefix);
    group.heading = heading;
    scroll_->widget()->layout()->addWidget(heading);
    // Without a picture, and below those that have one.
    QPixmap none(16, 16);
    none.fill(Qt::transparent);
    new QListWidgetItem(none, group.title, list_);
    groups_.push_back(std::move(group));
}

void SettingsDialog::addRow(const QString& key) {
    auto* row = new SettingRow(session_, key);
    scroll_->widget()->layout()->addWidget(row);
    row->sizeHint();  // finds the looks of its parts now, not of all rows in one turn
    groups_.back().rows.push_back(row);
}

void SettingsDialog::themeChanged() {
    search_icon_->setIcon(icon("search", quietColour()));
    for (const auto& [row, name] : step_icons_) list_->item(row)->setIcon(icon(name, accentColour()));
}

void SettingsDialog::scrollToStep() {
    search_->clear();
    only_changed_->setChecked(false);
    const auto first = std::find_if(groups_.begin(), groups_.end(),
                                    [&](const Group& group) { return group.step == wanted_step_; });
    if (first != groups_.end()) list_->setCurrentRow(first->list_row);
}

void SettingsDialog::filter() {
    const QStringList words = search_->text().toLower().split(' ', Qt::SkipEmptyParts);
    const bool only_changed = only_changed_->isChecked();
    QSet<int> steps_shown;
    scroll_->widget()->setUpdatesEnabled(false);
    for (const Group& group : groups_) {
        bool some = false;
        for (SettingRow* row : group.rows) {
            const bool shown = row->matches(words) && (!only_changed || row->changed());
            row->setVisible(shown);
            some = some || shown;
        }
        group.heading->setVisible(some);
        list_->item(group.list_row)->setHidden(!some);
        if (some) steps_shown << group.step_row;
    }
    for (const Group& group : groups_)
        list_->item(group.step_row)->setHidden(!steps_shown.contains(group.step_row));
    nothing_->setVisible(steps_shown.isEmpty());
    scroll_->widget()->setUpdatesEnabled(true);
    scroll_->verticalScrollBar()->setValue(0);
}

// A row that is set back while only changed ones are shown stays until the next look: it may be wanted.
void SettingsDialog::showChanged() {
    std::ptrdiff_t all = 0;
    for (const Group& group : groups_) {
        for (SettingRow* row : group.rows) row->showChanged();
        const auto changed = std::count_if(group.rows.begin(), group.rows.end(),
                                           [](const SettingRow* row) { return row->changed(); });
        list_->item(group.list_row)
            ->setText(changed == 0 ? group.title : tr("%1 · %2").arg(group.title).arg(changed));
        all += changed;
    }
    only_changed_->setText(tr("Only changed (%1)").arg(all));
    reset_->setEnabled(all > 0);
}

void SettingsDialog::scrollTo(int list_row) {
    const auto group =
        std::find_if(groups_.begin(), groups_.end(), [&](const Group& g) { return g.list_row == list_row; });
    if (group == groups_.end()) return;
    // Rows find their heights only once they are shown.
    QTimer::singleShot(0, this, [this, heading = group->heading] {
        jumping_ = true;
        scroll_->verticalScrollBar()->setValue(heading->y());
        jumping_ = false;
    });
}

void SettingsDialog::followScroll() {
    if (jumping_) return;
    const int top_px = scroll_->verticalScrollBar()->value() + 4 * kGrid_px;
    const Group* now = nullptr;
    for (const Group& group : groups_) {
        if (group.heading->isVisibleTo(scroll_->widget()) && group.heading->y() <= top_px) now = &group;
    }
    const QSignalBlocker quiet(list_);
    if (now != nullptr) list_->setCurrentRow(now->list_row);
}

}  // namespace terrawalk::gui
