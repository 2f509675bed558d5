#include "app/gui/steps.hpp"

#include <QCoreApplication>
#include <algorithm>

#include "app/gui/run_settings.hpp"

namespace terrawalk::gui {

namespace {
QString translated(const char* text) {
    return QCoreApplication::translate("Steps", text);
}
}  // namespace

std::vector<Step> steps() {
    return {
        {StepKind::Import, translated("Import"), "import", {}, {}},
        {StepKind::Tune, translated("Tune"), "tune", {}, {}},
        {StepKind::Fuse,
         translated("Fuse"),
         "fuse",
         {{"fusion.method", translated("Method")},
          {"fusion.gnss.use_height", translated("GNSS heights")},
          {"fusion.barometer.use", translated("Barometer")},
          {"fusion.flow.use", translated("Optical flow")}},
         {"fusion."}},
        {StepKind::Clean,
         translated("Clean"),
         "clean",
         {{"ground.greatest_range_m", translated("Longest range")},
          {"surface.clean.statistical.use", translated("Drop outliers")},
          {"surface.clean.above_ground.use", translated("Drop plants")}},
         {"ground.", "surface.clean."}},
        {StepKind::Surface,
         translated("Surface"),
         "surface",
         {{"surface.method", translated("Method")},
          {"surface.cell_m", translated("Cell size")},
          {"surface.terrace_edges", translated("Terrace edges")}},
         {"surface."}},
        {StepKind::Check, translated("Check"), "check", {}, {"report.", "seed"}},
        {StepKind::Export, translated("Export"), "export", {}, {}},
    };
}

QStringList furtherSettings(const Step& step) {
    QStringList keys;
    for (const ParameterInfo& info : knownParameters()) {
        const QString key = QString::fromStdString(info.key);
        const bool own = std::any_of(step.prefixes.begin(), step.prefixes.end(),
                                     [&](const QString& prefix) { return key.startsWith(prefix); });
        const bool shown = std::any_of(step.important.begin(), step.important.end(),
                                       [&](const auto& setting) { return setting.first == key; });
        // Cleaning is a step of its own.
        const bool elsewhere = step.kind == StepKind::Surface && key.startsWith("surface.clean.");
        if (own && !shown && !elsewhere) keys << key;
    }
    return keys;
}

}  // namespace terrawalk::gui
