#include "app/gui/export_dialog.hpp"

#include <QCheckBox>
#include <QClipboard>
#include <QDialogButtonBox>
#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QGridLayout>
#include <QGuiApplication>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QSettings>
#include <QStandardPaths>
#include <QVBoxLayout>

#include "app/gui/survey_session.hpp"
#include "app/gui/theme.hpp"

namespace terrawalk::gui {

namespace {

struct Format {
    const char* option;
    const char* value;
    const char* label;
};
constexpr Format kFormats[] = {
    {"points", "las", QT_TRANSLATE_NOOP("terrawalk::gui::ExportDialog", "Points, LAS 1.4")},
    {"points", "ply", QT_TRANSLATE_NOOP("terrawalk::gui::ExportDialog", "Points, PLY")},
    {"points", "pcd", QT_TRANSLATE_NOOP("terrawalk::gui::ExportDialog", "Points, PCD")},
    {"points", "csv", QT_TRANSLATE_NOOP("terrawalk::gui::ExportDialog", "Points, CSV")},
    {"points", "gpkg", QT_TRANSLATE_NOOP("terrawalk::gui::ExportDialog", "Points, GeoPackage")},
    {"mesh", "stl", QT_TRANSLATE_NOOP("terrawalk::gui::ExportDialog", "Mesh, STL")},
    {"mesh", "landxml", QT_TRANSLATE_NOOP("terrawalk::gui::ExportDialog", "Mesh, LandXML")},
    {"mesh", "dxf", QT_TRANSLATE_NOOP("terrawalk::gui::ExportDialog", "Mesh, DXF")},
    {"dem", "asc", QT_TRANSLATE_NOOP("terrawalk::gui::ExportDialog", "DEM, ESRI ASCII")},
};

template <class Format, std::size_t n>
void addNamed(const std::array<std::pair<Format, std::string_view>, n>& names, std::string_view name,
              std::vector<Format>& wanted) {
    for (const auto& [format, own] : names) {
        if (own == name) wanted.push_back(format);
    }
}

void addFormat(ExportRequest& request, const Format& format) {
    const std::string_view option = format.option;
    if (option == "points") addNamed(kPointFormats, format.value, request.points);
    if (option == "mesh") addNamed(kMeshFormats, format.value, request.meshes);
    if (option == "dem") addNamed(kGridFormats, format.value, request.grids);
}

QString suggestedFolder(const SurveySession& session) {
    const QFileInfo project(QString::fromStdString(session.survey()->project_file.string()));
    const QDir folder = project.absoluteDir();
    const QString base = QSettings().value("export/parent").toString();
    QString parent = base.isEmpty() ? QFileInfo(folder.absolutePath()).absolutePath() : base;
    // A sample may lie where the system keeps programs, and a stick may be gone.
    if (!QFileInfo(parent).isWritable())
        parent = QStandardPaths::writableLocation(QStandardPaths::DocumentsLocation);
    if (!QFileInfo(parent).isWritable()) parent = QDir::homePath();
    return QDir(parent).filePath(folder.dirName() + "-out");
}

}  // namespace

ExportDialog::ExportDialog(SurveySession& session, QWidget* parent) : QDialog(parent), session_(session) {
    setObjectName("export_dialog");
    setWindowTitle(tr("Export the results"));
    setMinimumWidth(560);
    auto* column = new QVBoxLayout(this);
    column->setContentsMargins(2 * kGrid_px, 2 * kGrid_px, 2 * kGrid_px, 2 * kGrid_px);
    column->setSpacing(kGrid_px);
    column->addWidget(new QLabel(tr("Folder for DEM, uncertainty, mesh, tracks, points and report")));
    auto* row = new QHBoxLayout;
    folder_ = new QLineEdit(suggestedFolder(session));
    folder_->setObjectName("export_folder");
    folder_->setAccessibleName(tr("Folder"));
    auto* browse = new QPushButton(tr("Browse…"));
    connect(browse, &QPushButton::clicked, this, [this] {
        const QString chosen = QFileDialog::getExistingDirectory(this, tr("Folder for the results"),
                                                                 QFileInfo(folder_->text()).absolutePath());
        if (!chosen.isEmpty()) folder_->setText(chosen);
    });
    row->addWidget(folder_, 1);
    row->addWidget(browse);
    column->addLayout(row);
    problem_ = new QLabel;
    problem_->setObjectName("problem");
    problem_->setWordWrap(true);
    column->addWidget(problem_);
    column->addSpacing(kGrid_px);
    column->addWidget(new QLabel(tr("Further formats, into a folder beside it")));
    auto* grid = new QGridLayout;
    grid->setVerticalSpacing(4);
    int index = 0;
    for (const Format& format : kFormats) {
        auto* box = new QCheckBox(tr(format.label));
        box->setObjectName(QString("format_") + format.value +
                           (QString(format.option) == "points" ? "_points" : ""));
        formats_ << box;
        grid->addWidget(box, index % 3, index / 3);
        connect(box, &QCheckBox::toggled, this, &ExportDialog::check);
        ++index;
    }
    column->addLayout(grid);
    all_points_ = new QCheckBox(tr("Also points that were not used, with their reasons"));
    all_points_->setObjectName("all_points");
    all_points_->setToolTip(
        tr("For the formats of points; without it, only those that the surface was made of"));
    connect(all_points_, &QCheckBox::toggled, this, &ExportDialog::check);
    column->addWidget(all_points_);
    column->addSpacing(kGrid_px);
    column->addWidget(new QLabel(tr("The same on the command line")));
    command_ = new QLabel;
    command_->setObjectName("command");
    command_->setWordWrap(true);
    command_->setTextInteractionFlags(Qt::TextSelectableByMouse | Qt::TextSelectableByKeyboard);
    column->addWidget(command_);
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel);
    auto* copy = buttons->addButton(tr("Copy command"), QDialogButtonBox::ActionRole);
    connect(copy, &QPushButton::clicked, this, [this] { QGuiApplication::clipboard()->setText(commands()); });
    export_ = buttons->addButton(tr("Export"), QDialogButtonBox::AcceptRole);
    export_->setObjectName("primary");
    export_->setDefault(true);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    connect(buttons, &QDialogButtonBox::accepted, this, &ExportDialog::start);
    column->addWidget(buttons);
    connect(folder_, &QLineEdit::textChanged, this, &ExportDialog::check);
    check();
}

void ExportDialog::setFolder(const QString& folder) {
    folder_->setText(folder);
}

void ExportDialog::check() {
    const QString folder = folder_->text().trimmed();
    const QFileInfo info(folder), parent(QFileInfo(folder).absolutePath());
    QString problem;
    if (folder.isEmpty()) {
        problem = tr("Name a folder.");
    } else if (info.exists() && !info.isDir()) {
        problem = tr("This is a file: name a folder.");
    } else if (!info.exists() && !parent.exists()) {
        problem = tr("%1 does not exist: make it first, or choose another place.").arg(parent.filePath());
    } else if (!QFileInfo(info.exists() ? folder : parent.filePath()).isWritable()) {
        problem = tr("You may not write there: choose another place.");
    }
    problem_->setText(problem.isEmpty() ? tr("An earlier export there is replaced in one step.") : problem);
    problem_->setStyleSheet("color: " + (problem.isEmpty() ? quietColour() : errorColour()).name());
    all_points_->setEnabled(anyPoints());
    export_->setEnabled(problem.isEmpty() && !session_.busy());
    command_->setText(commands());
}

bool ExportDialog::anyPoints() const {
    for (qsizetype i = 0; i < formats_.size(); ++i) {
        if (formats_[i]->isChecked() && QString(kFormats[i].option) == "points") return true;
    }
    return false;
}

QString ExportDialog::commands() const {
    const QString folder = folder_->text().trimmed();
    QString lines = session_.commandLine(folder.isEmpty() ? "out" : folder);
    QString formats;
    for (qsizetype i = 0; i < formats_.size(); ++i) {
        const Format& format = kFormats[i];
        if (formats_[i]->isChecked()) formats += QString(" --%1 %2").arg(format.option, format.value);
    }
    if (anyPoints() && all_points_->isChecked()) formats += " --all-points";
    if (!formats.isEmpty()) lines += "\n" + QString("terrawalk export %1%2").arg(shellWord(folder), formats);
    return lines;
}

void ExportDialog::start() {
    const QString folder = QFileInfo(folder_->text().trimmed()).absoluteFilePath();
    QSettings().setValue("export/parent", QFileInfo(folder).absolutePath());
    ExportRequest request;
    for (qsizetype i = 0; i < formats_.size(); ++i) {
        if (formats_[i]->isChecked()) addFormat(request, kFormats[i]);
    }
    request.all_points = anyPoints() && all_points_->isChecked();
    session_.exportTo(folder.toStdString(), request);
    accept();
}

}  // namespace terrawalk::gui
