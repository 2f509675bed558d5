#include <QApplication>
#include <QCommandLineParser>
#include <QSettings>

#include "app/gui/desktop.hpp"
#include "app/gui/figures.hpp"
#include "app/gui/language.hpp"
#include "app/gui/theme.hpp"
#include "app/pipeline/version.hpp"

namespace {

terrawalk::gui::Theme wantedTheme(const QCommandLineParser& parser) {
    using terrawalk::gui::Theme;
    const QString chosen =
        parser.isSet("theme") ? parser.value("theme") : QSettings().value("theme").toString();
    if (chosen == "dark") return Theme::Dark;
    return chosen == "light" ? Theme::Light : terrawalk::gui::desktopTheme();
}

}  // namespace

int main(int argc, char** argv) {
    using namespace terrawalk::gui;
    QApplication app(argc, argv);
    QApplication::setOrganizationName("Terrawalk");
    QApplication::setApplicationName("terrawalk-gui");
    QApplication::setApplicationDisplayName("Terrawalk");
    QApplication::setApplicationVersion(QString::fromStdString(terrawalk::versionNumber()));
    QApplication::setDesktopFileName("terrawalk-gui");

    QCommandLineParser parser;
    parser.setApplicationDescription(
        "Terrawalk's desktop app: from the logs of a walk to a terrain model that you can sign for.");
    parser.addHelpOption();
    parser.addVersionOption();
    parser.addPositionalArgument("survey", "A survey.json, or the folder that holds one.", "[survey]");
    parser.addOption({"process", "Process the survey once it is open."});
    parser.addOption({"theme", "light or dark; without it the last one, or the desktop's.", "theme"});
    parser.addOption({"language", "en or zh_CN; without it the last one, or the system's.", "language"});
    parser.process(app);

    applyFigureStyle(preferredFigureStyle());
    applyLanguage(parser.isSet("language") ? parser.value("language") : preferredLanguage());
    applyTheme(wantedTheme(parser));
    Desktop desktop;
    desktop.window().show();
    if (!parser.positionalArguments().isEmpty()) {
        desktop.window().open(parser.positionalArguments().front(), parser.isSet("process"));
    }
    return QApplication::exec();
}
