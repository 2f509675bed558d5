#include "app/gui/new_survey_dialog.hpp"

#include <QCheckBox>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QDir>
#include <QDragEnterEvent>
#include <QFileDialog>
#include <QFileInfo>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QLineEdit>
#include <QMimeData>
#include <QPushButton>
#include <QSignalBlocker>
#include <QTableWidget>
#include <QUrl>
#include <QVBoxLayout>
#include <cmath>

#include "app/gui/recent_surveys.hpp"
#include "app/gui/report_words.hpp"
#include "app/gui/tables.hpp"
#include "app/gui/theme.hpp"

namespace terrawalk::gui {

namespace fs = std::filesystem;

namespace {

constexpr int kReason_px = 240;

QString text(const std::string& utf8) {
    return QString::fromStdString(utf8);
}

std::optional<double> numberIn(const QLineEdit& field, double least, double greatest) {
    bool good = false;
    const double value = QLocale::c().toDouble(field.text().trimmed(), &good);
    if (!good || !(value >= least && value <= greatest)) return std::nullopt;
    return value;
}

QTableWidgetItem* cell(const QString& words, bool editable = false) {
    auto* item = new QTableWidgetItem(words);
    item->setFlags(Qt::ItemIsEnabled | Qt::ItemIsSelectable |
                   (editable ? Qt::ItemIsEditable : Qt::NoItemFlags));
    return item;
}

QString lengthOf(double seconds) {
    const int whole = static_cast<int>(std::lround(seconds));
    return QString("%1:%2").arg(whole / 60).arg(whole % 60, 2, 10, QChar('0'));
}

}  // namespace

bool areLooseFiles(const QStringList& paths) {
    if (paths.isEmpty()) return false;
    for (const QString& path : paths) {
        const QFileInfo info(path);
        const bool tables = info.isDir() && !info.isSymLink() && !QFileInfo::exists(path + "/survey.json");
        if (!tables && info.suffix().compare("csv", Qt::CaseInsensitive) != 0) return false;
    }
    return true;
}

NewSurveyDialog::NewSurveyDialog(QWidget* parent) : QDialog(parent) {
    setObjectName("new_survey_dialog");
    setWindowTitle(tr("New survey from files"));
    setAcceptDrops(true);
    resize(1000, 640);
    questions.files = [this](const QString& title) {
        return QFileDialog::getOpenFileNames(this, title, lastFolder(), tr("Tables (*.csv);;All files (*)"));
    };
    questions.folder = [this](const QString& title) {
        return QFileDialog::getExistingDirectory(this, title, lastFolder());
    };
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(2 * kGrid_px, 2 * kGrid_px, 2 * kGrid_px, 2 * kGrid_px);
    column->setSpacing(kGrid_px);
    auto* intro = new QLabel(
        tr("Add the logs of the array and the table of marks. What they are is guessed: look it over, and "
           "correct it."));
    intro->setWordWrap(true);
    column->addWidget(intro);
    auto* row = new QHBoxLayout;
    const auto button = [&](const char* name, const QString& words, auto run) {
        auto* made = new QPushButton(words);
        made->setObjectName(name);
        made->setAutoDefault(false);
        connect(made, &QPushButton::clicked, this, run);
        row->addWidget(made);
        return made;
    };
    button("add_files", tr("Add files…"), [this] { addFiles(questions.files(tr("Logs and marks"))); });
    button("add_folder", tr("Add a folder…"), [this] {
        const QString folder = questions.folder(tr("Folder with logs and marks"));
        if (!folder.isEmpty()) addFiles({folder});
    });
    remove_ = button("remove_files", tr("Take out"), [this] { removeSelected(); });
    row->addStretch();
    marks_ = new QLabel;
    marks_->setObjectName("marks_found");
    row->addWidget(marks_);
    column->addLayout(row);
    buildTable();
    column->addWidget(table_, 1);
    notes_ = new QLabel;
    notes_->setObjectName("notes");
    notes_->setWordWrap(true);
    notes_->setStyleSheet("color: " + quietColour().name());
    column->addWidget(notes_);
    column->addWidget(buildFields());
    problem_ = new QLabel;
    problem_->setObjectName("problem");
    problem_->setWordWrap(true);
    column->addWidget(problem_);
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel);
    create_ = buttons->addButton(tr("Create and open"), QDialogButtonBox::AcceptRole);
    create_->setObjectName("primary");
    create_->setDefault(true);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    connect(buttons, &QDialogButtonBox::accepted, this, &NewSurveyDialog::create);
    column->addWidget(buttons);
    check();
}

NewSurveyDialog::~NewSurveyDialog() {
    stop_.request_stop();
}

void NewSurveyDialog::buildTable() {
    table_ = new QTableWidget(0, ReasonColumn + 1);
    table_->setObjectName("runs");
    table_->setAccessibleName(tr("Runs"));
    table_->setHorizontalHeaderLabels(
        {tr("Run"), tr("Log"), tr("Kind"), tr("Starts on"), tr("Ends on"), tr("min:s"), tr("Why")});
    for (int c = 0; c <= ReasonColumn; ++c) {
        table_->horizontalHeaderItem(c)->setTextAlignment(
            (c == LengthColumn ? Qt::AlignRight : Qt::AlignLeft) | Qt::AlignVCenter);
    }
    dressTable(*table_, 4 * kGrid_px);
    table_->setAlternatingRowColors(true);
    table_->horizontalHeader()->setStretchLastSection(true);
    connect(table_, &QTableWidget::itemChanged, this, [this](QTableWidgetItem* item) {
        if (filling_ || item->column() != RunColumn) return;
        const auto run = static_cast<std::size_t>(item->row());
        if (run < draft_.runs.size())
            changeRun(run, [&](DraftRun& r) { r.id = item->text().trimmed().toStdString(); });
    });
    connect(table_, &QTableWidget::itemSelectionChanged, this,
            [this] { remove_->setEnabled(!table_->selectionModel()->selectedRows().isEmpty()); });
}

QWidget* NewSurveyDialog::buildFields() {
    auto* fields = new QWidget;
    auto* form = new QFormLayout(fields);
    form->setContentsMargins(0, kGrid_px, 0, 0);
    form->setVerticalSpacing(kGrid_px);
    const auto field = [&](const char* name, const QString& label) {
        auto* made = new QLineEdit;
        made->setObjectName(name);
        made->setAccessibleName(label);
        connect(made, &QLineEdit::textChanged, this, &NewSurveyDialog::check);
        return made;
    };
    name_ = field("survey_name", tr("Name"));
    form->addRow(tr("Name"), name_);
    auto* zero = new QHBoxLayout;
    zero->setSpacing(kGrid_px);
    latitude_ = field("latitude", tr("Latitude of the zero point"));
    longitude_ = field("longitude", tr("Longitude of the zero point"));
    height_ = field("height", tr("Ellipsoidal height of the zero point"));
    const std::pair<QLineEdit*, QString> parts[] = {
        {latitude_, tr("° N")}, {longitude_, tr("° E")}, {height_, tr("m above the ellipsoid")}};
    for (const auto& [edit, unit] : parts) {
        edit->setAlignment(Qt::AlignRight);
        zero->addWidget(edit, 1);
        auto* label = new QLabel(unit);
        label->setObjectName("quiet");
        zero->addWidget(label);
    }
    form->addRow(tr("Zero point"), zero);
    frame_ = new QComboBox;
    frame_->setObjectName("frame");
    frame_->setAccessibleName(tr("Map frame"));
    frame_->setEditable(true);
    frame_->setToolTip(tr("An EPSG code such as EPSG:32649; empty: metres east and north of the zero point"));
    connect(frame_, &QComboBox::editTextChanged, this, &NewSurveyDialog::check);
    form->addRow(tr("Map frame"), frame_);
    file_ = field("survey_file", tr("Survey file"));
    form->addRow(tr("Survey file"), file_);
    replace_ = new QCheckBox(tr("There is a survey already: replace it"));
    replace_->setObjectName("replace");
    replace_->hide();
    connect(replace_, &QCheckBox::toggled, this, &NewSurveyDialog::check);
    form->addRow(QString(), replace_);
    return fields;
}

void NewSurveyDialog::addFiles(const QStringList& paths) {
    if (paths.isEmpty()) return;
    rememberFolder(paths.front());
    for (const QString& path : paths) files_.emplace_back(path.toStdString());
    readFiles();
}

void NewSurveyDialog::readFiles() {
    stop_.request_stop();
    stop_ = std::stop_source();
    reading_ = true;
    NewSurveyRequest request;
    request.files = files_;
    draft_beside_.start([request, stop = stop_.get_token()] {
        SilentProgress silent;
        return draftSurvey(request, silent, stop);
    });
    check();
}

void NewSurveyDialog::takeRead(Result<SurveyDraft> read) {
    reading_ = false;
    if (read) takeDraft(std::move(*read));
    check();
    if (!read) problem_->setText(errorWords(read.error()));
}

void NewSurveyDialog::takeDraft(SurveyDraft draft) {
    for (DraftRun& run : draft.runs) {
        if (!corrected_.contains(run.log)) continue;
        for (const DraftRun& before : draft_.runs) {
            if (before.log == run.log) run = before;
        }
    }
    const bool first = draft_.runs.empty();
    // What a person typed into the fields stays.
    if (!first) {
        draft.name = draft_.name;
        draft.has_zero_point = draft_.has_zero_point;
        draft.zero_point = draft_.zero_point;
        draft.crs = draft_.crs;
    }
    draft_ = std::move(draft);
    // Files that were found, so that one of them can be taken out of a folder.
    files_.clear();
    for (const DraftRun& run : draft_.runs) files_.push_back(run.log);
    for (const Error& bad : draft_.bad_files) files_.push_back(bad.file);
    if (!draft_.marks_file.empty()) files_.push_back(draft_.marks_file);
    fillTable();
    fillFields();
}

void NewSurveyDialog::fillTable() {
    filling_ = true;
    const auto runs = static_cast<int>(draft_.runs.size());
    table_->clearSpans();
    table_->setRowCount(0);
    table_->setRowCount(runs + static_cast<int>(draft_.bad_files.size()));
    for (int row = 0; row < runs; ++row) fillRow(row, static_cast<std::size_t>(row));
    for (std::size_t i = 0; i < draft_.bad_files.size(); ++i)
        fillBadRow(runs + static_cast<int>(i), draft_.bad_files[i]);
    table_->resizeColumnsToContents();
    table_->setColumnWidth(ReasonColumn, std::max(table_->columnWidth(ReasonColumn), kReason_px));
    filling_ = false;
}

void NewSurveyDialog::fillRow(int row, std::size_t index) {
    const DraftRun& run = draft_.runs[index];
    table_->setItem(row, RunColumn, cell(text(run.id), true));
    auto* log = cell(text(run.log.filename().string()));
    log->setToolTip(text(run.log.string()));
    table_->setItem(row, LogColumn, log);
    auto* length = cell(lengthOf(run.duration_s));
    length->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
    table_->setItem(row, LengthColumn, length);
    auto* reason = cell(reportWords(run.reason));
    reason->setToolTip(reason->text());
    table_->setItem(row, ReasonColumn, reason);
    auto* kind = new QComboBox;
    kind->setAccessibleName(tr("Kind of %1").arg(text(run.id)));
    kind->addItem(tr("area walk"), static_cast<int>(RunKind::Area));
    kind->addItem(tr("fixed-point run"), static_cast<int>(RunKind::FixedPoint));
    kind->setCurrentIndex(run.kind == RunKind::Area ? 0 : 1);
    connect(kind, &QComboBox::currentIndexChanged, this, [this, index, kind] {
        changeRun(index, [&](DraftRun& r) { r.kind = static_cast<RunKind>(kind->currentData().toInt()); });
    });
    table_->setCellWidget(row, KindColumn, kind);
    const auto marks = [&](Column column, std::optional<std::string> DraftRun::*end, const QString& meaning) {
        auto* choice = new QComboBox;
        choice->setAccessibleName(meaning.arg(text(run.id)));
        choice->addItem(tr("–"), QString());
        choice->addItem("ZERO", "ZERO");
        for (const ControlMark& mark : draft_.marks) choice->addItem(text(mark.name), text(mark.name));
        choice->setCurrentIndex(std::max(0, choice->findData(text((run.*end).value_or("")))));
        connect(choice, &QComboBox::currentIndexChanged, this, [this, index, choice, end] {
            const std::string mark = choice->currentData().toString().toStdString();
            changeRun(index,
                      [&](DraftRun& r) { r.*end = mark.empty() ? std::nullopt : std::optional(mark); });
        });
        table_->setCellWidget(row, column, choice);
    };
    marks(StartColumn, &DraftRun::start, tr("Start of %1"));
    marks(TargetColumn, &DraftRun::target, tr("End of %1"));
}

void NewSurveyDialog::fillBadRow(int row, const Error& error) {
    auto* file = cell(text(error.file.filename().string()));
    file->setIcon(icon("error", errorColour()));
    file->setToolTip(text(error.file.string()));
    table_->setItem(row, RunColumn, file);
    Error plain = error;
    plain.file = error.file.filename();
    auto* what = cell(errorWords(plain));
    what->setForeground(errorColour());
    what->setToolTip(errorWords(error));
    table_->setItem(row, LogColumn, what);
    table_->setSpan(row, LogColumn, 1, ReasonColumn - LogColumn + 1);
}

void NewSurveyDialog::fillFields() {
    const QSignalBlocker quiet[] = {QSignalBlocker(name_),      QSignalBlocker(latitude_),
                                    QSignalBlocker(longitude_), QSignalBlocker(height_),
                                    QSignalBlocker(frame_),     QSignalBlocker(file_)};
    name_->setText(text(draft_.name));
    const auto number = [this](double value, int decimals) {
        return draft_.has_zero_point ? QString::number(value, 'f', decimals) : QString();
    };
    latitude_->setText(number(draft_.zero_point.lat_deg, 9));
    longitude_->setText(number(draft_.zero_point.lon_deg, 9));
    height_->setText(number(draft_.zero_point.h_ell_m, 3));
    frame_->clear();
    const QString zone = draft_.has_zero_point ? text(utmZone(draft_.zero_point)) : QString();
    if (!zone.isEmpty()) frame_->addItem(zone);
    frame_->addItem(QString());
    frame_->setEditText(text(draft_.crs));
    file_->setText(text(draft_.project_file.string()));
    file_->setCursorPosition(0);
    marks_->setText(draft_.marks_file.empty()
                        ? tr("no table of marks")
                        : tr("%n mark(s) in %1", nullptr, static_cast<int>(draft_.marks.size()))
                              .arg(text(draft_.marks_file.filename().string())));
    QStringList notes;
    for (const std::string& note : draft_.notes) notes << reportWords(note);
    notes_->setText(notes.join("\n"));
    notes_->setVisible(!notes.isEmpty());
}

void NewSurveyDialog::removeSelected() {
    std::set<fs::path> out;
    for (const QModelIndex& index : table_->selectionModel()->selectedRows()) {
        const auto row = static_cast<std::size_t>(index.row());
        const std::size_t runs = draft_.runs.size();
        out.insert(row < runs ? draft_.runs[row].log : draft_.bad_files[row - runs].file);
    }
    const auto isOut = [&](const fs::path& file) {
        return out.contains(file);
    };
    std::erase_if(files_, isOut);
    std::erase_if(draft_.runs, [&](const DraftRun& run) { return isOut(run.log); });
    std::erase_if(draft_.bad_files, [&](const Error& bad) { return isOut(bad.file); });
    fillTable();
    check();
}

void NewSurveyDialog::changeRun(std::size_t run, const std::function<void(DraftRun&)>& change) {
    if (filling_ || run >= draft_.runs.size()) return;
    change(draft_.runs[run]);
    corrected_.insert(draft_.runs[run].log);
    check();
}

QString NewSurveyDialog::takeFields() {
    draft_.name = name_->text().trimmed().toStdString();
    draft_.crs = frame_->currentText().trimmed().toStdString();
    draft_.project_file = file_->text().trimmed().toStdString();
    const auto lat = numberIn(*latitude_, -90, 90), lon = numberIn(*longitude_, -180, 180),
               height = numberIn(*height_, -1000, 10000);
    if (draft_.name.empty()) return tr("Give the survey a name.");
    if (!lat) return tr("The latitude is a number from −90 to 90, with a dot.");
    if (!lon) return tr("The longitude is a number from −180 to 180, with a dot.");
    if (!height) return tr("The height is a number of metres from −1000 to 10000, with a dot.");
    draft_.zero_point = {*lat, *lon, *height};
    draft_.has_zero_point = true;
    return {};
}

QString NewSurveyDialog::problem() {
    if (reading()) return tr("The files are being read…");
    if (draft_.runs.empty() && draft_.bad_files.empty())
        return tr("Add at least one log of the array, or drop files onto this window.");
    if (!draft_.bad_files.empty())
        return tr("%n file(s) cannot be used: mend them and add them again, or take them out.", nullptr,
                  static_cast<int>(draft_.bad_files.size()));
    for (std::size_t i = 0; i < draft_.runs.size(); ++i) {
        if (auto bad = problemOf(draft_, i)) {
            bad->file.clear();
            return errorWords(*bad);
        }
    }
    if (const QString field = takeFields(); !field.isEmpty()) return field;
    const QFileInfo file(file_->text().trimmed());
    if (file.fileName().isEmpty() || file.isDir())
        return tr("Name a file for the survey, such as survey.json.");
    if (!file.absoluteDir().exists())
        return tr("%1 does not exist: make it first, or choose another place.").arg(file.absolutePath());
    replace_->setVisible(file.exists());
    if (file.exists() && !replace_->isChecked())
        return tr("%1 is there already: choose another name, or let it be replaced.").arg(file.fileName());
    return {};
}

void NewSurveyDialog::check() {
    const QString words = problem();
    problem_->setText(words);
    problem_->setStyleSheet("color: " +
                            (reading() || draft_.runs.empty() ? quietColour() : errorColour()).name());
    create_->setEnabled(words.isEmpty());
    remove_->setEnabled(!table_->selectionModel()->selectedRows().isEmpty());
}

void NewSurveyDialog::create() {
    if (!problem().isEmpty()) return check();
    const auto written = writeDraft(draft_, replace_->isChecked());
    if (!written) {
        problem_->setText(errorWords(written.error()));
        problem_->setStyleSheet("color: " + errorColour().name());
        return;
    }
    accept();
    Q_EMIT created(text(draft_.project_file.string()));
}

void NewSurveyDialog::dragEnterEvent(QDragEnterEvent* event) {
    if (event->mimeData()->hasUrls()) event->acceptProposedAction();
}

void NewSurveyDialog::dropEvent(QDropEvent* event) {
    QStringList paths;
    for (const QUrl& url : event->mimeData()->urls()) {
        if (url.isLocalFile()) paths << url.toLocalFile();
    }
    addFiles(paths);
}

}  // namespace terrawalk::gui
