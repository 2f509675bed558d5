#include "app/gui/report_words.hpp"

#include <QCoreApplication>
#include <string>

namespace terrawalk::gui {

namespace {

// Only for the tool that collects texts: what the reports say.
[[maybe_unused]] constexpr const char* kKnown[] = {
    QT_TRANSLATE_NOOP("Report", "before fusion"),
    QT_TRANSLATE_NOOP("Report", "fused"),
    QT_TRANSLATE_NOOP("Report", "surface"),
    QT_TRANSLATE_NOOP("Report", "position on mark"),
    QT_TRANSLATE_NOOP("Report", "nearest ground point"),
    QT_TRANSLATE_NOOP("Report", "surface height"),
    QT_TRANSLATE_NOOP("Report", "control"),
    QT_TRANSLATE_NOOP("Report", "check"),
    QT_TRANSLATE_NOOP("Report", "Height error (RMSE)"),
    QT_TRANSLATE_NOOP("Report", "Height error of the surface (RMSE)"),
    QT_TRANSLATE_NOOP("Report", "Height error of the track (RMSE)"),
    QT_TRANSLATE_NOOP("Report", "Check marks compared"),
    QT_TRANSLATE_NOOP("Report", "Terrain model"),
    QT_TRANSLATE_NOOP("Report", "not known"),
    QT_TRANSLATE_NOOP("Report", "used"),
    QT_TRANSLATE_NOOP("Report", "no range"),
    QT_TRANSLATE_NOOP("Report", "range too short"),
    QT_TRANSLATE_NOOP("Report", "range too long"),
    QT_TRANSLATE_NOOP("Report", "weak return"),
    QT_TRANSLATE_NOOP("Report", "saturated"),
    QT_TRANSLATE_NOOP("Report", "tilted"),
    QT_TRANSLATE_NOOP("Report", "position unsure"),
    QT_TRANSLATE_NOOP("Report", "spike"),
    QT_TRANSLATE_NOOP("Report", "thinned"),
    QT_TRANSLATE_NOOP("Report", "run left out"),
    QT_TRANSLATE_NOOP("Report", "statistical outlier"),
    QT_TRANSLATE_NOOP("Report", "isolated"),
    QT_TRANSLATE_NOOP("Report", "above ground"),
};

}  // namespace

QString reportWords(std::string_view words) {
    return QCoreApplication::translate("Report", std::string(words).c_str());
}

}  // namespace terrawalk::gui
