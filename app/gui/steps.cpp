#include "app/gui/steps.hpp"

#include <QCoreApplication>
#include <algorithm>

#include "app/gui/run_settings.hpp"
#include "app/gui/setting_words.hpp"

namespace terrawalk::gui {

std::vector<Step> steps() {
    return {
        {StepKind::Import, QCoreApplication::translate("Steps", "Import"), "import", {}, {}},
        {StepKind::Tune, QCoreApplication::translate("Steps", "Tune"), "tune", {}, {}},
        {StepKind::Fuse,
         QCoreApplication::translate("Steps", "Fuse"),
         "fuse",
         {{"fusion.method", QCoreApplication::translate("Steps", "Method")},
          {"fusion.gnss.use_height", QCoreApplication::translate("Steps", "GNSS heights")},
          {"fusion.barometer.use", QCoreApplication::translate("Steps", "Barometer")},
          {"fusion.flow.use", QCoreApplication::translate("Steps", "Optical flow")},
          {"fusion.joint.preview", QCoreApplication::translate("Steps", "Quick preview")}},
         {"fusion."}},
        {StepKind::Clean,
         QCoreApplication::translate("Steps", "Clean"),
         "clean",
         {{"ground.greatest_range_m", QCoreApplication::translate("Steps", "Longest range")},
          {"surface.clean.statistical.use", QCoreApplication::translate("Steps", "Drop outliers")},
          {"surface.clean.above_ground.use", QCoreApplication::translate("Steps", "Drop plants")}},
         {"ground.", "surface.clean."}},
        {StepKind::Surface,
         QCoreApplication::translate("Steps", "Surface"),
         "surface",
         {{"surface.method", QCoreApplication::translate("Steps", "Method")},
          {"surface.cell_m", QCoreApplication::translate("Steps", "Cell size")},
          {"surface.terrace_edges", QCoreApplication::translate("Steps", "Terrace edges")}},
         {"surface."}},
        {StepKind::Check, QCoreApplication::translate("Steps", "Check"), "check", {}, {"report.", "seed"}},
        {StepKind::Export, QCoreApplication::translate("Steps", "Export"), "export", {}, {}},
    };
}

bool belongsTo(const Step& step, const QString& key) {
    // Cleaning is a step of its own.
    if (step.kind == StepKind::Surface && key.startsWith("surface.clean.")) return false;
    return std::any_of(step.prefixes.begin(), step.prefixes.end(),
                       [&](const QString& prefix) { return key.startsWith(prefix); });
}

QStringList settingGroups(const Step& step) {
    QStringList groups;
    for (const QString& prefix : settingPrefixes()) {
        if (belongsTo(step, prefix + ".")) groups << prefix;
    }
    return groups;
}

QStringList furtherSettings(const Step& step) {
    QStringList keys;
    for (const ParameterInfo& info : knownParameters()) {
        const QString key = QString::fromStdString(info.key);
        const bool shown = std::any_of(step.important.begin(), step.important.end(),
                                       [&](const auto& setting) { return setting.first == key; });
        if (belongsTo(step, key) && !shown) keys << key;
    }
    return keys;
}

}  // namespace terrawalk::gui
