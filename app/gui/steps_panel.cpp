#include "app/gui/steps_panel.hpp"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QProgressBar>
#include <QPushButton>
#include <QScrollArea>
#include <QSpinBox>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "app/gui/figure_table.hpp"
#include "app/gui/report_words.hpp"
#include "app/gui/setting_words.hpp"
#include "app/gui/step_card.hpp"
#include "app/gui/survey_session.hpp"
#include "app/gui/theme.hpp"

namespace terrawalk::gui {

namespace {

QString text(const std::string& utf8) {
    return QString::fromStdString(utf8);
}

/// Whether settings of a step differ from those of the shown results.
bool stepChanged(const Step& step, const SurveySession& session) {
    const auto& run = session.history()[session.shownRun()];
    const auto keys = session.settings().differences(run.settings);
    return std::any_of(keys.begin(), keys.end(),
                       [&](const std::string& key) { return belongsTo(step, text(key)); });
}

}  // namespace

StepsPanel::StepsPanel(SurveySession& session, QWidget* parent) : QWidget(parent), session_(session) {
    auto* list = new QWidget;
    auto* column = new QVBoxLayout(list);
    column->setContentsMargins(kGrid_px, kGrid_px, kGrid_px, kGrid_px);
    column->setSpacing(kGrid_px);
    for (const Step& step : steps()) {
        auto* card = new StepCard(session, step);
        cards_[step.kind] = card;
        column->addWidget(card);
        connect(card, &StepCard::furtherAsked, this,
                [this, kind = step.kind] { Q_EMIT settingsAsked(kind); });
    }
    column->addStretch();
    auto* scroll = new QScrollArea;
    scroll->setWidget(list);
    scroll->setWidgetResizable(true);
    scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    scroll->setFocusPolicy(Qt::NoFocus);
    scroll->setObjectName("steps_scroll");
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addWidget(scroll, 1);
    layout->addWidget(buildFooter());
    fillCards();
    int names_px = 0;
    for (const auto& [kind, card] : cards_) names_px = std::max(names_px, card->namesWidth_px());
    for (const auto& [kind, card] : cards_) card->setNamesWidth(names_px);
    connect(&session_, &SurveySession::surveyChanged, this, &StepsPanel::showState);
    connect(&session_, &SurveySession::productsChanged, this, [this] {
        showHistory();
        showState();
    });
    connect(&session_, &SurveySession::settingsChanged, this, &StepsPanel::showState);
    connect(&session_.job(), &BackgroundJob::runningChanged, this, &StepsPanel::showState);
    connect(&session_.job(), &BackgroundJob::progressed, this, &StepsPanel::showProgress);
    showHistory();
    showState();
}

QPushButton* StepsPanel::addButton(StepCard& card, const QString& name, const QString& label,
                                   const QString& tip) {
    auto* button = new QPushButton(label);
    button->setObjectName(name);
    button->setToolTip(tip);
    button->setStatusTip(tip);
    card.addBody(button);
    return button;
}

void StepsPanel::tune() {
    const auto chosen = [](const QSpinBox& box) {
        return box.value() == box.minimum() ? 0 : static_cast<std::size_t>(box.value());
    };
    TuneOptions options;
    options.optimiser = static_cast<OptimiserKind>(optimiser_->currentData().toInt());
    options.population = chosen(*population_);
    options.iterations = chosen(*iterations_);
    options.restarts = static_cast<std::size_t>(restarts_->value());
    session_.tune(options, static_cast<std::size_t>(repeats_->value()));
}

void StepsPanel::fillCards() {
    auto* open = addButton(*cards_[StepKind::Import], "step_open", tr("Open a survey…"),
                           tr("A survey.json, or the folder that holds one"));
    connect(open, &QPushButton::clicked, this, &StepsPanel::openAsked);
    tune_ = addButton(
        *cards_[StepKind::Tune], "step_tune", tr("Tune on the marks"),
        tr("Searches noise parameters of the method that make errors at control marks small, and takes "
           "them only where they hold out better on marks left out"));
    buildSearch(*cards_[StepKind::Tune]);
    buildBudget(*cards_[StepKind::Tune]);
    connect(tune_, &QPushButton::clicked, this, &StepsPanel::tune);
    buildCheck(*cards_[StepKind::Check]);
    export_ = addButton(*cards_[StepKind::Export], "step_export", tr("Export…"),
                        tr("Writes DEM, mesh, tracks and report into a folder"));
    connect(export_, &QPushButton::clicked, this, &StepsPanel::exportAsked);
    command_ = addButton(*cards_[StepKind::Export], "step_command", tr("Copy as command"),
                         tr("The terrawalk command line that makes the same files"));
    connect(command_, &QPushButton::clicked, this, &StepsPanel::commandAsked);
}

void StepsPanel::buildSearch(StepCard& card) {
    auto* row = new QWidget;
    auto* layout = new QHBoxLayout(row);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(kGrid_px);
    optimiser_ = new QComboBox;
    optimiser_->setObjectName("optimiser");
    optimiser_->setAccessibleName(tr("Who searches"));
    optimiser_->setToolTip(
        tr("The optimiser that searches; Plots > Optimisers compared shows them side by side"));
    keepFromWheel(*optimiser_);
    for (const auto& [kind, name] : kOptimiserNames) {
        const QString word = QString::fromUtf8(name.data(), static_cast<qsizetype>(name.size()));
        optimiser_->addItem(choiceWords(word), static_cast<int>(kind));
        optimiser_->setItemData(optimiser_->count() - 1, word, Qt::ToolTipRole);
    }
    repeats_ = new QSpinBox;
    repeats_->setObjectName("repeats");
    repeats_->setAccessibleName(tr("Searches"));
    repeats_->setToolTip(tr("Searches with seeds one after the other; the best of them is taken"));
    repeats_->setRange(1, 20);
    repeats_->setPrefix(tr("× "));
    keepFromWheel(*repeats_);
    layout->addWidget(optimiser_, 1);
    layout->addWidget(repeats_);
    card.addBody(row);
}

void StepsPanel::buildBudget(StepCard& card) {
    card.beginFold("search_budget", tr("Effort of the search"));
    const auto add = [&](const QString& object_name, const QString& name, int least, int greatest,
                         const QString& tip) {
        auto* box = new QSpinBox;
        box->setObjectName(object_name);
        box->setAccessibleName(name);
        box->setToolTip(tip);
        box->setRange(least, greatest);
        box->setAlignment(Qt::AlignRight);
        keepFromWheel(*box);
        card.addField(name, box);
        return box;
    };
    // As on the command line; one step below the least stands for what is usual.
    population_ = add("population", tr("Population"), 7, 100000,
                      tr("Candidates that the search keeps; auto: 100 for aukf, 8 for other methods"));
    iterations_ = add("iterations", tr("Iterations"), 0, 10000000,
                      tr("How often each of them is tried anew; auto: 1000 for aukf, 6 for other methods"));
    for (QSpinBox* box : {population_, iterations_}) box->setSpecialValueText(tr("auto"));
    restarts_ = add("restarts", tr("Restarts"), 1, 64,
                    tr("Independent searches within one, each of that effort; the best is taken"));
}

void StepsPanel::buildCheck(StepCard& card) {
    figure_ = new QLabel;
    figure_->setObjectName("figure");
    card.addBody(figure_);
    figure_detail_ = new QLabel;
    figure_detail_->setObjectName("quiet");
    figure_detail_->setWordWrap(true);
    card.addBody(figure_detail_);
    figures_ = new FigureTable;
    card.addBody(figures_);
    history_ = addButton(card, "step_history", QString(),
                         tr("The last runs of this survey: their figures, what was set, and the way back"));
    connect(history_, &QPushButton::clicked, this, &StepsPanel::runsAsked);
    accuracy_ =
        addButton(card, "step_accuracy", tr("Show the accuracy"), tr("Errors at marks, group by group"));
    connect(accuracy_, &QPushButton::clicked, this, &StepsPanel::accuracyAsked);
}

QWidget* StepsPanel::buildFooter() {
    auto* footer = new QWidget;
    footer->setObjectName("footer");
    auto* column = new QVBoxLayout(footer);
    column->setContentsMargins(2 * kGrid_px, kGrid_px, 2 * kGrid_px, 2 * kGrid_px);
    column->setSpacing(kGrid_px);
    doing_ = new QLabel;
    doing_->setObjectName("doing");
    doing_->setMinimumWidth(0);
    doing_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
    column->addWidget(doing_);
    bar_ = new QProgressBar;
    bar_->setObjectName("progress");
    bar_->setRange(0, 1000);
    bar_->setTextVisible(false);
    column->addWidget(bar_);
    auto* row = new QHBoxLayout;
    row->setSpacing(kGrid_px);
    process_ = new QPushButton(tr("Process"));
    process_->setObjectName("primary");
    process_->setToolTip(tr("Fuse, clean, make the surface and check it (F5)"));
    connect(process_, &QPushButton::clicked, &session_, &SurveySession::process);
    cancel_ = new QPushButton(tr("Cancel"));
    cancel_->setObjectName("cancel");
    cancel_->setToolTip(tr("Stop what is running; nothing is lost (Ctrl+.)"));
    connect(cancel_, &QPushButton::clicked, &session_, &SurveySession::cancel);
    row->addWidget(process_, 1);
    row->addWidget(cancel_);
    column->addLayout(row);
    return footer;
}

void StepsPanel::themeChanged() {
    for (const auto& [kind, card] : cards_) card->themeChanged();
    showState();
}

void StepsPanel::showProgress(double fraction, const QString& step, double seconds_left) {
    if (!session_.busy()) return;
    bar_->setValue(static_cast<int>(std::lround(1000.0 * fraction)));
    const QString left = timeLeft(seconds_left), words = reportWords(step.toStdString());
    doing_->setText(left.isEmpty() ? words : tr("%1 · %2 left").arg(words, left));
    doing_->setToolTip(doing_->text());
}

void StepsPanel::showHistory() {
    history_->setText(tr("Earlier runs (%1)…").arg(session_.runs().size()));
    history_->setVisible(!session_.runs().empty());
    const auto& history = session_.history();
    const auto* shown = history.empty() ? nullptr : &history[session_.shownRun()];
    if (shown == nullptr || !shown->before) return figures_->show({}, {});
    figures_->show(figureChanges(shown->before->figures, runFigures(shown->products->report)),
                   timeOfRun(shown->before->when));
}

void StepsPanel::showState() {
    const auto survey = session_.survey();
    const auto products = session_.products();
    const bool busy = session_.busy();
    for (const Step& step : steps()) {
        StepCard& card = *cards_.at(step.kind);
        const bool made = products != nullptr && step.kind != StepKind::Tune && step.kind != StepKind::Export;
        if (step.kind == StepKind::Import) {
            card.setState(
                survey ? tr("%n run(s)", nullptr, static_cast<int>(survey->runs.size())) : tr("nothing open"),
                survey ? accentColour() : quietColour());
        } else if (step.kind == StepKind::Tune) {
            card.setState(session_.settings().tuned() ? tr("tuned") : tr("defaults"),
                          session_.settings().tuned() ? accentColour() : quietColour());
        } else if (made && stepChanged(step, session_)) {
            card.setState(tr("changed"), warningColour());
        } else {
            card.setState(made ? tr("done") : QString(), accentColour());
        }
    }
    const auto* figure =
        products && !products->report.figures.empty() ? &products->report.figures.front() : nullptr;
    figure_->setText(figure != nullptr ? text(figure->value) : tr("not checked yet"));
    figure_detail_->setText(figure != nullptr
                                ? tr("%1, %2").arg(reportWords(figure->label), reportWords(figure->detail))
                                : tr("Process the survey to see its errors at the marks."));
    const bool marks = survey && !survey->marks.empty();
    tune_->setEnabled(!busy && marks);
    export_->setEnabled(!busy && products);
    command_->setEnabled(survey != nullptr);
    accuracy_->setEnabled(products != nullptr);
    history_->setEnabled(!busy);
    process_->setEnabled(!busy && survey);
    process_->setText(session_.outdated() ? tr("Process again") : tr("Process"));
    cancel_->setVisible(busy);
    bar_->setVisible(busy);
    doing_->setVisible(busy);
    if (!busy) {
        bar_->setValue(0);
        doing_->clear();
    }
}

QString timeLeft(double seconds) {
    if (seconds < 0.0) return {};
    if (seconds < 1.5) return StepsPanel::tr("about 1 s");
    if (seconds < 90.0) return StepsPanel::tr("about %1 s").arg(std::lround(seconds));
    if (seconds < 5400.0) return StepsPanel::tr("about %1 min").arg(std::lround(seconds / 60.0));
    return StepsPanel::tr("about %1 h").arg(QString::number(seconds / 3600.0, 'f', 1));
}

}  // namespace terrawalk::gui
