#include "app/gui/start_page.hpp"

#include <QCoreApplication>
#include <QDir>
#include <QFileInfo>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>

#include "app/gui/recent_surveys.hpp"
#include "app/gui/sample_surveys.hpp"
#include "app/gui/theme.hpp"

namespace terrawalk::gui {

namespace {

constexpr int kColumn_px = 480;

QLabel* label(const QString& text, const char* name) {
    auto* made = new QLabel(text);
    made->setObjectName(name);
    made->setWordWrap(true);
    return made;
}

QString shortPath(const QString& path) {
    const QString home = QDir::homePath();
    return path.startsWith(home + "/") ? "~" + path.mid(home.size()) : path;
}

/// A row that opens something: what it is, and where it lies.
QPushButton* link(const QString& title, const QString& path) {
    auto* button = new QPushButton(icon("result", accentColour()), title);
    button->setToolTip(path);
    button->setStyleSheet("text-align: left; padding: 8px 12px;");
    return button;
}

}  // namespace

StartPage::StartPage(QWidget* parent) : QWidget(parent) {
    auto* column = new QVBoxLayout;
    column->setSpacing(kGrid_px);
    auto* head = new QHBoxLayout;
    head->setSpacing(2 * kGrid_px);
    auto* picture = new QLabel;
    picture->setPixmap(icon("terrawalk").pixmap(64, 64));
    head->addWidget(picture);
    auto* words = new QVBoxLayout;
    words->addWidget(label("Terrawalk", "title"));
    auto* slogan = label(tr("From a walk to a terrain model that you can sign for."), "quiet");
    slogan->setWordWrap(false);
    words->addWidget(slogan);
    head->addLayout(words, 1);
    column->addLayout(head);
    column->addSpacing(3 * kGrid_px);

    auto* open =
        new QPushButton(icon("open", QPalette().color(QPalette::HighlightedText)), tr("Open a survey…"));
    open->setObjectName("primary");
    open->setToolTip(tr("A survey.json, or a folder that holds one. Or drop it onto this window."));
    connect(open, &QPushButton::clicked, this, &StartPage::openAsked);
    auto* fresh = new QPushButton(icon("new"), tr("New survey from files…"));
    fresh->setObjectName("start_new");
    fresh->setToolTip(tr("From array logs and a table of marks. Or drop them onto this window."));
    connect(fresh, &QPushButton::clicked, this, &StartPage::newAsked);
    auto* row = new QHBoxLayout;
    row->setSpacing(kGrid_px);
    row->addWidget(open);
    row->addWidget(fresh);
    row->addStretch();
    column->addLayout(row);
    column->addWidget(
        label(tr("or drop a survey.json, its folder, or logs and marks onto this window"), "quiet"));
    column->addSpacing(3 * kGrid_px);

    const auto samples = sampleSurveys();
    if (!samples.empty()) column->addWidget(label(tr("Samples: one click to a finished DEM"), "heading"));
    for (const SampleSurvey& sample : samples) {
        const QString path = QString::fromStdString(sample.path.string());
        auto* button = link(sample.title, path);
        button->setObjectName("sample_" + QFileInfo(path).fileName());
        connect(button, &QPushButton::clicked, this, [this, path] { Q_EMIT sampleAsked(path); });
        column->addWidget(button);
    }
    column->addSpacing(3 * kGrid_px);
    column->addWidget(label(tr("Recent surveys"), "heading"));
    recent_ = new QVBoxLayout;
    recent_->setSpacing(kGrid_px);
    column->addLayout(recent_);

    auto* middle = new QWidget;
    middle->setLayout(column);
    middle->setMaximumWidth(kColumn_px);
    middle->setMinimumWidth(kColumn_px);
    auto* page = new QVBoxLayout(this);
    page->addStretch(2);
    page->addWidget(middle, 0, Qt::AlignHCenter);
    page->addStretch(3);
    refresh();
}

void StartPage::refresh() {
    while (QLayoutItem* item = recent_->takeAt(0)) {
        delete item->widget();
        delete item;
    }
    const QStringList paths = recentSurveys();
    for (const QString& path : paths) {
        auto* button = link(shortPath(path), path);
        connect(button, &QPushButton::clicked, this, [this, path] { Q_EMIT surveyAsked(path); });
        recent_->addWidget(button);
    }
    if (paths.isEmpty())
        recent_->addWidget(label(tr("None yet: the surveys that you open will stand here."), "quiet"));
}

}  // namespace terrawalk::gui
