#include "app/gui/runs_dialog.hpp"

#include <QCheckBox>
#include <QDialogButtonBox>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QLocale>
#include <QMessageBox>
#include <QPushButton>
#include <QSignalBlocker>
#include <QTableWidget>
#include <QVBoxLayout>
#include <algorithm>

#include "app/gui/accuracy_words.hpp"
#include "app/gui/setting_editor.hpp"
#include "app/gui/survey_session.hpp"
#include "app/gui/tables.hpp"
#include "app/gui/theme.hpp"

namespace terrawalk::gui {

namespace {

QString valueIn(const RunSettings& settings, const QString& key) {
    return settingValueWords(key, QString::fromStdString(settings.text(key.toStdString())));
}

QTableWidgetItem* cell(const QString& text, bool number = false) {
    QTableWidgetItem* item = tableCell(text, number);
    item->setToolTip(text);
    return item;
}

QString sizeText(qint64 bytes) {
    return QLocale().formattedDataSize(bytes, 1, QLocale::DataSizeSIFormat);
}

QTableWidget* table(const QString& name, const QString& accessible_name) {
    auto* made = new QTableWidget;
    made->setObjectName(name);
    made->setAccessibleName(accessible_name);
    dressTable(*made, 28);
    made->setEditTriggers(QAbstractItemView::NoEditTriggers);
    made->setSelectionMode(QAbstractItemView::SingleSelection);
    return made;
}

void setHeads(QTableWidget& table, const QStringList& heads, int first_number, int numbers) {
    table.setColumnCount(static_cast<int>(heads.size()));
    table.setHorizontalHeaderLabels(heads);
    for (int column = 0; column < table.columnCount(); ++column) {
        const bool number = column >= first_number && column < first_number + numbers;
        table.horizontalHeaderItem(column)->setTextAlignment((number ? Qt::AlignRight : Qt::AlignLeft) |
                                                             Qt::AlignVCenter);
    }
}

}  // namespace

RunsDialog::RunsDialog(SurveySession& session, QWidget* parent) : QDialog(parent), session_(session) {
    setObjectName("runs_dialog");
    setWindowTitle(tr("Earlier runs"));
    resize(960, 560);
    sure = [this](const QString& question) {
        return QMessageBox::question(this, windowTitle(), question, QMessageBox::Yes | QMessageBox::Cancel,
                                     QMessageBox::Cancel) == QMessageBox::Yes;
    };
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(2 * kGrid_px, 2 * kGrid_px, 2 * kGrid_px, 2 * kGrid_px);
    column->setSpacing(kGrid_px);
    column->addWidget(buildRuns(), 3);
    results_ = new QLabel;
    results_->setObjectName("results_of_run");
    results_->setWordWrap(true);
    column->addWidget(results_);
    column->addLayout(buildKeeping());
    what_ = new QLabel;
    what_->setObjectName("cardTitle");
    column->addWidget(what_);
    column->addWidget(buildDifferences(), 2);
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Close);
    compare_ = buttons->addButton(tr("Compare heights"), QDialogButtonBox::ActionRole);
    compare_->setObjectName("compare_run");
    again_ = buttons->addButton(tr("Process it again"), QDialogButtonBox::ActionRole);
    again_->setObjectName("process_run_again");
    go_back_ = buttons->addButton(tr("Go back to this run"), QDialogButtonBox::ActionRole);
    go_back_->setObjectName("primary");
    column->addWidget(buttons);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    connect(go_back_, &QPushButton::clicked, this, [this] {
        session_.goBackToRun(chosen());
        accept();
    });
    connect(compare_, &QPushButton::clicked, this, [this] {
        session_.compareWithRun(chosen());
        accept();
    });
    connect(again_, &QPushButton::clicked, this, [this] {
        session_.showRunAgain(chosen());
        accept();
    });
    connect(keep_, &QCheckBox::toggled, this, [this](bool keep) {
        session_.keepSurfaces(keep);
        const QSignalBlocker quiet(keep_);
        keep_->setChecked(session_.keptSurfaces().wanted());  // which a disk may refuse
        showKeeping();
        showChosen();
    });
    connect(&session_.job(), &BackgroundJob::runningChanged, this, [this] {
        showKeeping();
        showChosen();
    });
    connect(runs_, &QTableWidget::itemSelectionChanged, this, &RunsDialog::showChosen);
    runs_->selectRow(runs_->rowCount() > 1 ? 1 : 0);  // the one before the last
}

QTableWidget* RunsDialog::buildRuns() {
    const auto& runs = session_.runs();
    for (const FigureKind& kind : kFigureKinds) {
        if (kind.better == Better::Neither) continue;
        if (std::any_of(runs.begin(), runs.end(),
                        [&](const RunSummary& run) { return run.figures.contains(kind.key); }))
            kinds_.push_back(kind);
    }
    runs_ = table("runs_table", tr("Earlier runs"));
    QStringList heads{tr("Run")};
    for (const FigureKind& kind : kinds_) heads << figureWords(kind);
    heads << tr("Set otherwise than in the run before");
    setHeads(*runs_, heads, 1, static_cast<int>(kinds_.size()));
    runs_->setRowCount(static_cast<int>(runs.size()));
    for (std::size_t run = 0; run < runs.size(); ++run) addRun(run);
    runs_->horizontalHeader()->setSectionResizeMode(QHeaderView::ResizeToContents);
    runs_->horizontalHeader()->setSectionResizeMode(runs_->columnCount() - 1, QHeaderView::Stretch);
    return runs_;
}

QTableWidget* RunsDialog::buildDifferences() {
    differences_ = table("differences_table", tr("Settings that differ from those of now"));
    differences_->setSelectionMode(QAbstractItemView::NoSelection);
    setHeads(*differences_, {tr("Setting"), tr("In that run"), tr("Now")}, 1, 2);
    differences_->horizontalHeader()->setSectionResizeMode(QHeaderView::ResizeToContents);
    differences_->horizontalHeader()->setSectionResizeMode(0, QHeaderView::Stretch);
    return differences_;
}

QLayout* RunsDialog::buildKeeping() {
    keep_ = new QCheckBox(tr("Keep surfaces on disk, to compare heights after a restart"));
    keep_->setObjectName("keep_surfaces");
    keep_->setToolTip(
        tr("Of the runs whose results are here and of those to come, until they leave this "
           "list. Unticked, no more are kept; those on disk stay until they are removed."));
    keep_->setChecked(session_.keptSurfaces().wanted());
    kept_ = new QLabel;
    kept_->setObjectName("quiet");
    remove_ = new QPushButton(tr("Remove from disk…"));
    remove_->setObjectName("remove_kept");
    remove_->setToolTip(tr("Removes the kept surfaces; settings and figures of the runs stay"));
    remove_->setAutoDefault(false);
    connect(remove_, &QPushButton::clicked, this, &RunsDialog::removeKept);
    auto* row = new QHBoxLayout;
    row->addWidget(keep_);
    row->addStretch();
    row->addWidget(kept_);
    row->addWidget(remove_);
    showKeeping();
    return row;
}

void RunsDialog::showKeeping() {
    const qint64 bytes = keptBytes();
    QStringList words;
    if (bytes > 0) words << tr("%1 on disk").arg(sizeText(bytes));
    if (const auto products = session_.products())
        words << tr("at most %1 for each run").arg(sizeText(KeptSurfaces::mostBytes(*products)));
    kept_->setText(words.join(tr("; ")));
    keep_->setEnabled(!session_.busy());
    remove_->setVisible(bytes > 0);
    remove_->setEnabled(!session_.busy());
}

qint64 RunsDialog::keptBytes() const {
    const KeptSurfaces kept = session_.keptSurfaces();
    qint64 bytes = 0;
    for (const RunSummary& run : session_.runs()) bytes += kept.bytes(run.when);
    return bytes;
}

void RunsDialog::removeKept() {
    const QString question =
        tr("Remove the kept surfaces (%1) from disk? This cannot be undone; a run that is processed again "
           "gives its surface back.")
            .arg(sizeText(keptBytes()));
    if (!sure(question)) return;
    session_.removeKeptSurfaces();
    showKeeping();
    showChosen();
}

QString RunsDialog::resultsWords(std::size_t run) const {
    if (isShown(run)) return tr("Its results are shown.");
    if (session_.resultsOf(run)) return tr("Its results are still here.");
    const KeptSurfaces kept = session_.keptSurfaces();
    const QDateTime when = session_.runs()[run].when;
    if (kept.has(when))
        return tr("Its surface is kept on disk (%1), so that heights can be compared. For the other views it "
                  "has to be processed again.")
            .arg(sizeText(kept.bytes(when)));
    return tr(
        "Only its settings and figures were kept. Processing it again gives its results back: the same "
        "logs, settings and version of the program give the same bytes.");
}

QString RunsDialog::compareWords(std::size_t run) const {
    if (session_.products() == nullptr)
        return tr("Process the survey first: its heights are compared with those of this run");
    if (isShown(run)) return tr("These are the heights that are shown");
    if (!session_.canCompareWith(run)) return tr("The surface of this run was not kept");
    return tr("How the heights changed since, as a layer");
}

void RunsDialog::addRun(std::size_t run) {
    const RunSummary& one = session_.runs()[run];
    const int row = static_cast<int>(session_.runs().size() - 1 - run);
    auto* when = cell(isShown(run) ? tr("%1, shown").arg(timeOfRun(one.when)) : timeOfRun(one.when));
    when->setToolTip(tr("%1, by %2").arg(one.when.toString("yyyy-MM-dd HH:mm:ss"), one.program));
    runs_->setItem(row, 0, when);
    for (std::size_t i = 0; i < kinds_.size(); ++i) {
        const auto value = one.figures.find(kinds_[i].key);
        const QString words = value == one.figures.end() ? "–" : figureText(kinds_[i], value->second);
        runs_->setItem(row, static_cast<int>(i) + 1, cell(words, true));
    }
    runs_->setItem(row, runs_->columnCount() - 1, cell(changesSinceTheRunBefore(run)));
}

QString RunsDialog::changesSinceTheRunBefore(std::size_t run) const {
    const auto& runs = session_.runs();
    if (run == 0) return {};
    QStringList words;
    for (const std::string& name : runs[run].settings.differences(runs[run - 1].settings)) {
        const QString key = QString::fromStdString(name);
        words << tr("%1: %2").arg(settingTitle(key), valueIn(runs[run].settings, key));
    }
    return words.isEmpty() ? tr("nothing") : words.join(tr("; "));
}

std::size_t RunsDialog::chosen() const {
    const int row = std::max(0, runs_->currentRow());
    return session_.runs().size() - 1 - static_cast<std::size_t>(row);
}

bool RunsDialog::isShown(std::size_t run) const {
    const auto results = session_.resultsOf(run);
    return results && *results == session_.shownRun();
}

void RunsDialog::showChosen() {
    const std::size_t run = chosen();
    const RunSettings& then = session_.runs()[run].settings;
    const auto keys = session_.settings().differences(then);
    what_->setText(keys.empty() ? tr("Its settings are those of now.")
                                : tr("Settings that differ from those of now"));
    differences_->setRowCount(static_cast<int>(keys.size()));
    for (std::size_t i = 0; i < keys.size(); ++i) {
        const QString key = QString::fromStdString(keys[i]);
        const int row = static_cast<int>(i);
        auto* name = cell(settingTitle(key));
        name->setToolTip(key);
        differences_->setItem(row, 0, name);
        differences_->setItem(row, 1, cell(valueIn(then, key), true));
        differences_->setItem(row, 2, cell(valueIn(session_.settings(), key), true));
    }
    go_back_->setEnabled(!session_.busy() && (!keys.empty() || !isShown(run)));
    go_back_->setToolTip(
        session_.resultsOf(run)
            ? tr("Shows its results and takes its settings over; undo brings yours back")
            : tr("Takes its settings over, undo brings yours back; process again to see its results"));
    results_->setText(resultsWords(run));
    again_->setEnabled(!session_.busy() && !session_.resultsOf(run));
    again_->setToolTip(tr("Takes its settings over, undo brings yours back, and processes"));
    compare_->setEnabled(!session_.busy() && session_.canCompareWith(run));
    compare_->setToolTip(compareWords(run));
}

}  // namespace terrawalk::gui
