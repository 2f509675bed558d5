#include "app/gui/survey_tree_model.hpp"

#include <QBrush>
#include <QFont>
#include <algorithm>
#include <cmath>

#include "app/gui/accuracy_words.hpp"
#include "app/gui/figures.hpp"
#include "app/gui/map_scene.hpp"
#include "app/gui/theme.hpp"

namespace terrawalk::gui {

namespace {

QString text(const std::string& utf8) {
    return QString::fromStdString(utf8);
}

QString duration(double seconds) {
    const auto s = static_cast<long>(std::lround(seconds));
    return s < 60 ? QString("%1 s").arg(s)
                  : QString("%1:%2 min").arg(s / 60).arg(s % 60, 2, 10, QLatin1Char('0'));
}

QStandardItem* entry(const QString& name, SurveyTreeModel::Kind kind, const QString& id) {
    auto* made = new QStandardItem(name);
    made->setEditable(false);
    made->setData(kind, SurveyTreeModel::KindRole);
    made->setData(id, SurveyTreeModel::IdRole);
    return made;
}

QStandardItem* state(const QString& words) {
    auto* made = new QStandardItem(words);
    made->setEditable(false);
    made->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
    made->setForeground(QBrush(quietColour()));
    return made;
}

void check(QStandardItem& item, bool shown) {
    item.setCheckable(true);
    item.setCheckState(shown ? Qt::Checked : Qt::Unchecked);
}

void leaveOut(QStandardItem& item) {
    QFont struck = item.font();
    struck.setStrikeOut(true);
    item.setFont(struck);
    item.setForeground(QBrush(quietColour()));
}

bool isIn(const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

const RunReport* reportOf(const Products& products, const std::string& run) {
    const auto& runs = products.report.runs;
    const auto found =
        std::find_if(runs.begin(), runs.end(), [&](const RunReport& r) { return r.id == run; });
    return found == runs.end() ? nullptr : &*found;
}

QString sensorWords(EditedSensor sensor) {
    switch (sensor) {
        case EditedSensor::Gnss:
            return SurveyTreeModel::tr("GNSS");
        case EditedSensor::Barometer:
            return SurveyTreeModel::tr("barometer");
        case EditedSensor::Flow:
            return SurveyTreeModel::tr("optical flow");
        case EditedSensor::Attitude:
            return SurveyTreeModel::tr("attitude");
        case EditedSensor::Range:
            return SurveyTreeModel::tr("range");
        case EditedSensor::All:
            break;
    }
    return {};
}

}  // namespace

SurveyTreeModel::SurveyTreeModel(QObject* parent) : QStandardItemModel(parent) {
    connect(this, &QStandardItemModel::itemChanged, this, [this](QStandardItem* changed) {
        if (!changed->isCheckable()) return;
        Q_EMIT visibilityChanged(changed->data(KindRole).toInt(), changed->data(IdRole).toString(),
                                 changed->checkState() == Qt::Checked);
    });
}

void SurveyTreeModel::show(const Survey& survey, const SurveyMap& map, const Products* products,
                           const SurveyEdits& edits, const ViewChoice& shown) {
    clear();
    setHorizontalHeaderLabels({tr("Survey"), ""});
    setColumnCount(2);
    addRuns(survey, products, edits, shown);
    addMarks(survey, map, edits, shown);
    addEdits(edits);
    if (products != nullptr) addResults(*products, shown);
}

QStandardItem* SurveyTreeModel::addGroup(const QString& name, qsizetype count) {
    QStandardItem* group = entry(name, Group, {});
    QFont bold = group->font();
    bold.setBold(true);
    group->setFont(bold);
    appendRow({group, state(count >= 0 ? QString::number(count) : QString())});
    return group;
}

void SurveyTreeModel::addRuns(const Survey& survey, const Products* products, const SurveyEdits& edits,
                              const ViewChoice& shown) {
    QStandardItem* group = addGroup(tr("Runs"), static_cast<qsizetype>(survey.runs.size()));
    for (std::size_t i = 0; i < survey.runs.size(); ++i) {
        const Run& run = survey.runs[i];
        const bool area = run.kind == RunKind::Area;
        QStandardItem* made = entry(text(run.id), RunItem, text(run.id));
        made->setIcon(icon(area ? "area_run" : "fixed_point_run",
                           currentTheme() == Theme::Dark ? runColour(i).lighter(170) : runColour(i)));
        if (isIn(edits.runs, run.id)) {
            leaveOut(*made);
            group->appendRow({made, state(tr("left out"))});
            continue;
        }
        check(*made, !shown.hidden_runs.contains(text(run.id)));
        QString words =
            run.log.size() > 0 ? duration(run.log.time_s.back() - run.log.time_s.front()) : tr("empty");
        QString help =
            area ? tr("Area run %1").arg(text(run.id)) : tr("Fixed-point run %1").arg(text(run.id));
        if (run.start) help += tr(", starts on %1").arg(text(*run.start));
        if (run.target) help += tr(", ends on %1").arg(text(*run.target));
        help += tr("; %1 records").arg(run.log.size());
        if (const RunReport* report = products != nullptr ? reportOf(*products, run.id) : nullptr) {
            words = tr("%1, %2").arg(lengthText(report->distance_m, 0), words);
            help += tr("; %1 ground points used").arg(report->ground_points_used);
        }
        made->setToolTip(help);
        group->appendRow({made, state(words)});
    }
}

void SurveyTreeModel::addMarks(const Survey& survey, const SurveyMap& map, const SurveyEdits& edits,
                               const ViewChoice& shown) {
    QStandardItem* group = addGroup(tr("Marks"), static_cast<qsizetype>(survey.marks.size()));
    for (const ControlMark& mark : survey.marks) {
        const bool control = mark.role == MarkRole::Control;
        QStandardItem* made = entry(text(mark.name), MarkItem, text(mark.name));
        made->setIcon(icon(control ? "control_mark" : "check_mark"));
        if (isIn(edits.marks, mark.name)) {
            leaveOut(*made);
            group->appendRow({made, state(tr("left out"))});
            continue;
        }
        check(*made, !shown.hidden_marks.contains(text(mark.name)));
        made->setToolTip(control ? tr("Control mark: may hold the track")
                                 : tr("Check mark: only ever measures errors"));
        QString words = control ? tr("control") : tr("check");
        const auto placed = std::find_if(map.marks.begin(), map.marks.end(),
                                         [&](const PlacedMark& m) { return m.mark.name == mark.name; });
        if (placed != map.marks.end() && placed->height_error_m) {
            words = signedLength(*placed->height_error_m, 2);
            made->setToolTip(made->toolTip() + tr("; surface less mark %1").arg(words));
        }
        group->appendRow({made, state(words)});
    }
}

void SurveyTreeModel::addEdits(const SurveyEdits& edits) {
    if (edits.stretches.empty() && edits.lines.empty()) return;
    QStandardItem* group =
        addGroup(tr("Edits"), static_cast<qsizetype>(edits.stretches.size() + edits.lines.size()));
    for (std::size_t i = 0; i < edits.stretches.size(); ++i) {
        const ExcludedStretch& out = edits.stretches[i];
        const QString words = out.sensor == EditedSensor::All
                                  ? tr("%1 left out").arg(text(out.run))
                                  : tr("%1 without %2").arg(text(out.run), sensorWords(out.sensor));
        QStandardItem* made = entry(words, StretchItem, QString::number(i));
        made->setIcon(icon("exclude"));
        group->appendRow({made, state(QString("%1–%2 s").arg(QString::number(out.from_s, 'f', 0),
                                                             QString::number(out.to_s, 'f', 0)))});
    }
    for (std::size_t i = 0; i < edits.lines.size(); ++i) {
        const Breakline& line = edits.lines[i];
        const auto kind = static_cast<std::size_t>(line.kind);
        const QString names[] = {tr("Breakline"), tr("Soft breakline"), tr("Boundary"), tr("Hole")};
        const char* icons[] = {"hard_line", "soft_line", "boundary", "hole"};
        QStandardItem* made = entry(names[kind], LineItem, QString::number(i));
        made->setIcon(icon(icons[kind]));
        group->appendRow({made, state(tr("%n point(s)", nullptr, static_cast<int>(line.vertices_m.size())))});
    }
}

void SurveyTreeModel::addResults(const Products& products, const ViewChoice& shown) {
    const SurveyReport& report = products.report;
    QStandardItem* group = addGroup(tr("Results"), -1);
    const auto add = [&](QStandardItem* made, const char* icon_name, const QString& words) {
        made->setIcon(icon(icon_name));
        if (made->toolTip().isEmpty()) made->setToolTip(tr("A click shows it"));
        group->appendRow({made, state(words)});
    };
    add(entry(tr("DEM"), ResultItem, "dem"), "map",
        QString("%1 × %2, %3 m")
            .arg(report.surface.columns)
            .arg(report.surface.rows)
            .arg(report.surface.cell_m));
    if (products.uncertainty && report.surface.uncertainty) {
        const UncertaintySummary& sigma = *report.surface.uncertainty;
        add(entry(tr("Uncertainty"), ResultItem, "uncertainty"), "result",
            tr("median %1").arg(lengthText(sigma.median_m)));
        add(entry(tr("Point density"), ResultItem, "density"), "result",
            tr("%n point(s)", nullptr, static_cast<int>(report.surface.points)));
        const auto cells = static_cast<double>(sigma.measured + sigma.interpolated + sigma.extrapolated);
        if (cells > 0.0) {
            const double share = 100.0 * static_cast<double>(sigma.measured) / cells;
            add(entry(tr("Sources"), ResultItem, "source"), "result",
                tr("%1 % measured").arg(std::lround(share)));
        }
    }
    add(entry(tr("Mesh"), ResultItem, "mesh"), "terrain_3d",
        tr("%1 triangles").arg(report.surface.triangles));
    const bool known = !report.figures.empty();
    add(entry(tr("Accuracy"), ResultItem, "accuracy"), "accuracy",
        known ? text(report.figures.front().value) : QString());
    add(entry(tr("Report"), ResultItem, "report"), "report", QString());
    if (products.terrace_edges.empty()) return;
    QStandardItem* edges = entry(tr("Terraces"), EdgesItem, "edges");
    check(*edges, shown.edges);
    edges->setToolTip(tr("The box shows or hides them"));
    add(edges, "result", QString::number(products.terrace_edges.size()));
}

}  // namespace terrawalk::gui
