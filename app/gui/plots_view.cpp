#include "app/gui/plots_view.hpp"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QListWidget>
#include <QPushButton>
#include <QSignalBlocker>
#include <QVBoxLayout>
#include <utility>

#include "app/gui/figures.hpp"
#include "app/gui/plot_canvas.hpp"
#include "app/gui/theme.hpp"
#include "survey/survey_edits.hpp"

namespace terrawalk::gui {

namespace {

constexpr int kListWidth_px = 22 * kGrid_px;
constexpr int kKindRole = Qt::UserRole;

QString sensorName(EditedSensor sensor) {
    switch (sensor) {
        case EditedSensor::All:
            return PlotsView::tr("All readings");
        case EditedSensor::Gnss:
            return PlotsView::tr("GNSS");
        case EditedSensor::Barometer:
            return PlotsView::tr("Barometer");
        case EditedSensor::Flow:
            return PlotsView::tr("Optical flow");
        case EditedSensor::Attitude:
            return PlotsView::tr("Attitude");
        case EditedSensor::Range:
            return PlotsView::tr("Range finder");
    }
    return {};
}

}  // namespace

PlotsView::PlotsView(Selection& selection, QWidget* parent) : QWidget(parent), selection_(selection) {
    setObjectName("plotsView");
    setAccessibleName(tr("Plots"));
    list_ = new QListWidget;
    list_->setObjectName("plotList");
    list_->setAccessibleName(tr("List of plots"));
    list_->setFixedWidth(kListWidth_px);
    list_->setFrameShape(QFrame::NoFrame);
    list_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    list_->setStyleSheet(
        "QListWidget { border: 0; border-right: 1px solid palette(mid); padding-top: 4px; }"
        "QListWidget::item { border: 0; padding-left: 12px; }"
        "QListWidget::item:selected { background: palette(highlight); color: palette(highlighted-text); }");
    fillList();
    connect(list_, &QListWidget::currentItemChanged, this, [this](QListWidgetItem* now) {
        if (now == nullptr || !now->data(kKindRole).isValid()) return;
        setPlot(static_cast<PlotKind>(now->data(kKindRole).toInt()));
    });

    title_ = new QLabel;
    title_->setObjectName("heading");
    title_->setMinimumHeight(4 * kGrid_px);
    // A long title gives way: it must not make the window wider than the screen.
    title_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
    runs_ = new QComboBox;
    runs_->setObjectName("plotRun");
    runs_->setAccessibleName(tr("Run"));
    runs_->setToolTip(tr("The run that is plotted"));
    runs_->setSizeAdjustPolicy(QComboBox::AdjustToContents);
    connect(runs_, &QComboBox::currentIndexChanged, this, &PlotsView::renew);
    sensors_ = new QComboBox;
    sensors_->setObjectName("excludedSensor");
    sensors_->setAccessibleName(tr("Readings to exclude"));
    sensors_->setToolTip(tr("Which readings of the stretch are left out"));
    for (const auto& [sensor, key] : kEditedSensors) {
        sensors_->addItem(sensorName(sensor),
                          QString::fromUtf8(key.data(), static_cast<qsizetype>(key.size())));
    }
    exclude_ = new QPushButton(tr("Exclude this stretch"));
    exclude_->setObjectName("excludeStretch");
    connect(exclude_, &QPushButton::clicked, this, [this] {
        if (ofMarks()) return Q_EMIT excludeMarkAsked(selection_.item());
        const auto shown = shownStretches();
        if (!shown.empty()) Q_EMIT excludeAsked(shown, sensors_->currentData().toString());
    });
    open_ = new QPushButton(tr("Open a tuning or an experiment…"));
    open_->setObjectName("openSearches");
    open_->setToolTip(
        tr("A file that terrawalk tune wrote, or the CSV of terrawalk experiment fig10 and its like"));
    connect(open_, &QPushButton::clicked, this, &PlotsView::searchesAsked);
    canvas_ = new PlotCanvas;
    connect(canvas_, &PlotCanvas::stretchDragged, this, [this](double from_s, double to_s) {
        selection_.select({run(), from_s, to_s});
    });
    connect(canvas_, &PlotCanvas::nameClicked, &selection_, &Selection::selectItem);
    readout_ = new QLabel;
    readout_->setObjectName("plotReadout");
    readout_->setAccessibleName(tr("Values under the cursor"));
    connect(canvas_, &PlotCanvas::readout, readout_, &QLabel::setText);
    note_ = new QLabel;
    note_->setObjectName("quiet");
    note_->setWordWrap(true);

    auto* choices = new QHBoxLayout;
    choices->setSpacing(kGrid_px);
    choices->addWidget(runs_);
    choices->addWidget(sensors_);
    choices->addWidget(exclude_);
    choices->addWidget(open_);
    choices->addStretch();
    // One below the other: side by side they would make the window wider than a small screen.
    auto* head = new QVBoxLayout;
    head->setContentsMargins(2 * kGrid_px, kGrid_px, 2 * kGrid_px, kGrid_px);
    head->setSpacing(kGrid_px);
    head->addWidget(title_);
    head->addLayout(choices);
    auto* foot = new QVBoxLayout;
    foot->setContentsMargins(2 * kGrid_px, 0, 2 * kGrid_px, kGrid_px);
    foot->setSpacing(kGrid_px / 2);
    foot->addWidget(readout_);
    foot->addWidget(note_);
    auto* right = new QVBoxLayout;
    right->setSpacing(0);
    right->addLayout(head);
    right->addWidget(canvas_, 1);
    right->addLayout(foot);
    auto* all = new QHBoxLayout(this);
    all->setContentsMargins(0, 0, 0, 0);
    all->setSpacing(0);
    all->addWidget(list_);
    all->addLayout(right, 1);
    connect(&selection_, &Selection::changed, this, [this] {
        setRun(selection_.item());
        shadeSelection();
    });
    setPlot(kind_);
}

void PlotsView::fillList() {
    QString group;
    for (const PlotKind kind : allPlots()) {
        if (plotGroup(kind) != group) {
            group = plotGroup(kind);
            auto* heading = new QListWidgetItem(group, list_);
            heading->setFlags(Qt::NoItemFlags);
            QFont bold = font();
            bold.setBold(true);
            heading->setFont(bold);
            heading->setForeground(quietColour());
            heading->setSizeHint({0, 4 * kGrid_px});
        }
        auto* item = new QListWidgetItem(plotName(kind), list_);
        item->setData(kKindRole, static_cast<int>(kind));
        item->setSizeHint({0, 3 * kGrid_px});
    }
}

void PlotsView::show(std::shared_ptr<const Survey> survey, std::shared_ptr<const SurveyMap>,
                     std::shared_ptr<const Products> products) {
    const QString before = run();
    survey_ = std::move(survey);
    products_ = std::move(products);
    {
        const QSignalBlocker silent(runs_);
        runs_->clear();
        for (std::size_t i = 0; survey_ && i < survey_->runs.size(); ++i) {
            runs_->addItem(tr("Run %1").arg(QString::fromStdString(survey_->runs[i].id)),
                           QString::fromStdString(survey_->runs[i].id));
        }
        const int kept = runs_->findData(before);
        // Otherwise the walk over the field, which is mostly the last.
        runs_->setCurrentIndex(kept >= 0 ? kept : runs_->count() - 1);
    }
    renew();
}

void PlotsView::setTuning(std::shared_ptr<const TuningData> tuning) {
    tuning_ = std::move(tuning);
    if (plotsSearches(kind_)) renew();
}

QString PlotsView::run() const {
    return runs_->currentData().toString();
}

std::size_t PlotsView::runNumber() const {
    return static_cast<std::size_t>(std::max(0, runs_->currentIndex()));
}

void PlotsView::setRun(const QString& run) {
    const int at = runs_->findData(run);
    if (at >= 0) runs_->setCurrentIndex(at);
}

void PlotsView::setPlot(PlotKind kind) {
    kind_ = kind;
    {
        const QSignalBlocker silent(list_);
        for (int row = 0; row < list_->count(); ++row) {
            const QVariant own = list_->item(row)->data(kKindRole);
            if (own.isValid() && own.toInt() == static_cast<int>(kind)) list_->setCurrentRow(row);
        }
    }
    sensors_->setCurrentIndex(sensors_->findData(likelySensor(kind)));
    renew();
}

void PlotsView::renew() {
    Plot plot;
    if (survey_) {
        plot = plotOf(kind_, runNumber(), *survey_, products_.get(), tuning_.get());
    } else {
        plot.title = plotName(kind_);
        plot.reason = tr("Open a survey to see its plots here.");
    }
    title_->setText(plot.title);
    note_->setText(plot.note);
    note_->setVisible(!plot.note.isEmpty());
    const bool of_run = plotsOneRun(kind_) && survey_;
    for (QWidget* widget : {static_cast<QWidget*>(runs_), static_cast<QWidget*>(sensors_)}) {
        widget->setVisible(of_run);
    }
    exclude_->setVisible(of_run || plot.of_marks);
    exclude_->setText(plot.of_marks ? tr("Leave this mark out") : tr("Exclude this stretch"));
    open_->setVisible(plotsSearches(kind_) && survey_);
    readout_->setText({});
    canvas_->show(std::move(plot));
    shadeSelection();
}

bool PlotsView::ofMarks() const {
    return canvas_->plot().of_marks;
}

bool PlotsView::markSelected() const {
    if (!survey_ || !selection_.stretches().empty()) return false;
    return std::any_of(survey_->marks.begin(), survey_->marks.end(), [&](const ControlMark& mark) {
        return QString::fromStdString(mark.name) == selection_.item();
    });
}

std::vector<TrackStretch> PlotsView::shownStretches() const {
    std::vector<TrackStretch> shown;
    if (!plotsOneRun(kind_)) return shown;
    std::copy_if(selection_.stretches().begin(), selection_.stretches().end(), std::back_inserter(shown),
                 [this](const TrackStretch& stretch) { return stretch.run == run(); });
    return shown;
}

void PlotsView::shadeSelection() {
    const auto shown = shownStretches();
    std::vector<std::pair<double, double>> times_s;
    for (const TrackStretch& stretch : shown) times_s.emplace_back(stretch.from_s, stretch.to_s);
    canvas_->setStretches(std::move(times_s));
    canvas_->setNamed(selection_.item());
    if (ofMarks()) {
        const bool known = markSelected();
        exclude_->setEnabled(known);
        exclude_->setToolTip(known ? tr("Leaves %1 out of the next run").arg(selection_.item())
                                   : tr("Click a mark first"));
        return;
    }
    exclude_->setEnabled(!shown.empty());
    exclude_->setToolTip(shown.empty() ? tr("Drag along the time axis to select a stretch first")
                                       : tr("Leaves these readings of %1, %2 s to %3 s, out of the next run")
                                             .arg(shown.front().run, number(shown.front().from_s, 1),
                                                  number(shown.back().to_s, 1)));
}

void PlotsView::themeChanged() {
    for (int row = 0; row < list_->count(); ++row) {
        if (!list_->item(row)->data(kKindRole).isValid()) list_->item(row)->setForeground(quietColour());
    }
    canvas_->themeChanged();
}

}  // namespace terrawalk::gui
