#include "app/gui/recent_surveys.hpp"

#include <QFileInfo>
#include <QSettings>

namespace terrawalk::gui {

namespace {
constexpr const char* kKey = "recent_surveys";
constexpr qsizetype kMost = 8;
}  // namespace

QStringList recentSurveys() {
    QStringList paths = QSettings().value(kKey).toStringList();
    paths.removeIf([](const QString& path) { return !QFileInfo::exists(path); });
    return paths;
}

QString lastFolder() {
    return QSettings().value("last_folder").toString();
}

void rememberFolder(const QString& path) {
    QSettings().setValue("last_folder", QFileInfo(path).absolutePath());
}

void rememberSurvey(const QString& path) {
    const QString whole = QFileInfo(path).absoluteFilePath();
    QStringList paths = recentSurveys();
    paths.removeAll(whole);
    paths.prepend(whole);
    QSettings().setValue(kKey, QStringList(paths.mid(0, kMost)));
}

}  // namespace terrawalk::gui
