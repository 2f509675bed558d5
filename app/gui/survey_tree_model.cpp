#include "app/gui/survey_tree_model.hpp"

#include <QBrush>
#include <QFont>
#include <cmath>

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

QStandardItem* checkable(QStandardItem* item) {
    item->setCheckable(true);
    item->setCheckState(Qt::Checked);
    return item;
}

}  // namespace

SurveyTreeModel::SurveyTreeModel(QObject* parent) : QStandardItemModel(parent) {
    connect(this, &QStandardItemModel::itemChanged, this, [this](QStandardItem* changed) {
        if (!changed->isCheckable()) return;
        Q_EMIT visibilityChanged(changed->data(KindRole).toInt(), changed->data(IdRole).toString(),
                                 changed->checkState() == Qt::Checked);
    });
}

void SurveyTreeModel::show(const Survey& survey, const SurveyMap& map, const Products* products) {
    clear();
    setHorizontalHeaderLabels({tr("Survey"), ""});
    setColumnCount(2);
    addRuns(survey, products);
    addMarks(map);
    if (products != nullptr) addResults(*products);
}

QStandardItem* SurveyTreeModel::addGroup(const QString& name, qsizetype count) {
    QStandardItem* group = entry(name, Group, {});
    QFont bold = group->font();
    bold.setBold(true);
    group->setFont(bold);
    appendRow({group, state(count >= 0 ? QString::number(count) : QString())});
    return group;
}

void SurveyTreeModel::addRuns(const Survey& survey, const Products* products) {
    QStandardItem* group = addGroup(tr("Runs"), static_cast<qsizetype>(survey.runs.size()));
    for (std::size_t i = 0; i < survey.runs.size(); ++i) {
        const Run& run = survey.runs[i];
        const bool area = run.kind == RunKind::Area;
        QStandardItem* row = checkable(entry(text(run.id), RunItem, text(run.id)));
        row->setIcon(icon(area ? "area_run" : "fixed_point_run", runColour(i)));
        QString words =
            run.log.size() > 0 ? duration(run.log.time_s.back() - run.log.time_s.front()) : tr("empty");
        QString help =
            area ? tr("Area run %1").arg(text(run.id)) : tr("Fixed-point run %1").arg(text(run.id));
        if (run.start) help += tr(", starts on %1").arg(text(*run.start));
        if (run.target) help += tr(", ends on %1").arg(text(*run.target));
        help += tr("; %1 records").arg(run.log.size());
        if (products != nullptr) {
            const RunReport& report = products->report.runs[i];
            words = tr("%1 m, %2").arg(QString::number(report.distance_m, 'f', 0), words);
            help += tr("; %1 ground points used").arg(report.ground_points_used);
        }
        row->setToolTip(help);
        group->appendRow({row, state(words)});
    }
}

void SurveyTreeModel::addMarks(const SurveyMap& map) {
    QStandardItem* group = addGroup(tr("Marks"), static_cast<qsizetype>(map.marks.size()));
    for (const PlacedMark& placed : map.marks) {
        const ControlMark& mark = placed.mark;
        const bool control = mark.role == MarkRole::Control;
        QStandardItem* row = checkable(entry(text(mark.name), MarkItem, text(mark.name)));
        row->setIcon(icon(control ? "control_mark" : "check_mark"));
        row->setToolTip(control ? tr("Control mark: may hold the track")
                                : tr("Check mark: only ever measures errors"));
        QString words = control ? tr("control") : tr("check");
        if (placed.height_error_m) {
            words = (*placed.height_error_m < 0 ? "−" : "+") +
                    QString::number(std::abs(*placed.height_error_m), 'f', 2) + " m";
            row->setToolTip(row->toolTip() + tr("; surface less mark %1").arg(words));
        }
        group->appendRow({row, state(words)});
    }
}

void SurveyTreeModel::addResults(const Products& products) {
    const SurveyReport& report = products.report;
    QStandardItem* group = addGroup(tr("Results"), -1);
    const auto add = [&](QStandardItem* row, const QString& words) {
        row->setIcon(icon("result"));
        group->appendRow({row, state(words)});
    };
    add(entry(tr("DEM"), ResultItem, "dem"),
        tr("%1 × %2, %3 m").arg(report.surface.columns).arg(report.surface.rows).arg(report.surface.cell_m));
    if (products.uncertainty && report.surface.uncertainty) {
        add(entry(tr("Uncertainty"), ResultItem, "uncertainty"),
            tr("median %1 m").arg(QString::number(report.surface.uncertainty->median_m, 'f', 2)));
    }
    add(entry(tr("Mesh"), ResultItem, "mesh"), tr("%1 triangles").arg(report.surface.triangles));
    if (!products.terrace_edges.empty()) {
        add(checkable(entry(tr("Terrace edges"), EdgesItem, "edges")),
            QString("%1").arg(products.terrace_edges.size()));
    }
}

}  // namespace terrawalk::gui
