#pragma once

#include <QString>
#include <QStringList>
#include <utility>
#include <vector>

namespace terrawalk::gui {

enum class StepKind { Import, Tune, Fuse, Clean, Surface, Check, Export };

/// A step of the way from logs to a DEM, with the settings that belong to it.
struct Step {
    StepKind kind = StepKind::Import;
    QString title;
    QString icon;
    std::vector<std::pair<QString, QString>> important;  ///< key and label
    QStringList prefixes;                                ///< of all its settings
};

/// In the order of the work.
[[nodiscard]] std::vector<Step> steps();
[[nodiscard]] bool belongsTo(const Step& step, const QString& key);
/// Prefixes of the groups that the settings of a step stand in, as settingPrefix().
[[nodiscard]] QStringList settingGroups(const Step& step);
/// Keys of a step that are not important, in the order of `terrawalk config describe`.
[[nodiscard]] QStringList furtherSettings(const Step& step);

}  // namespace terrawalk::gui
