#include "app/gui/language.hpp"

#include <QCoreApplication>
#include <QLibraryInfo>
#include <QLocale>
#include <QSettings>
#include <QTranslator>

#include "app/gui/theme.hpp"

namespace terrawalk::gui {

namespace {

QTranslator& ownTexts() {
    static QTranslator translator;
    return translator;
}

QTranslator& qtTexts() {
    static QTranslator translator;
    return translator;
}

ReportLanguage& appliedLanguage() {
    static ReportLanguage language = ReportLanguage::English;
    return language;
}

}  // namespace

ReportLanguage reportLanguage() {
    return appliedLanguage();
}

QString chineseOf(const char* context, const QString& english) {
    static QTranslator chinese;
    static const bool loaded = (registerResources(), chinese.load(":/i18n/terrawalk_zh_CN.qm"));
    return loaded ? chinese.translate(context, english.toUtf8().constData()) : QString();
}

void applyLanguage(const QString& language) {
    registerResources();
    const QString name = language.startsWith("zh") ? "zh_CN" : "en";
    appliedLanguage() = name == "en" ? ReportLanguage::English : ReportLanguage::Chinese;
    QCoreApplication::removeTranslator(&ownTexts());
    QCoreApplication::removeTranslator(&qtTexts());
    // English has a file too: of plurals.
    if (ownTexts().load(":/i18n/terrawalk_" + name + ".qm")) QCoreApplication::installTranslator(&ownTexts());
    if (name != "en" &&
        qtTexts().load("qtbase_" + name, QLibraryInfo::path(QLibraryInfo::TranslationsPath))) {
        QCoreApplication::installTranslator(&qtTexts());
    }
}

QString joinSentences(const QStringList& sentences) {
    QString all;
    for (const QString& sentence : sentences) {
        if (sentence.isEmpty()) continue;
        all = all.isEmpty() ? sentence : QCoreApplication::translate("Language", "%1 %2").arg(all, sentence);
    }
    return all;
}

QString preferredLanguage() {
    const QString chosen = QSettings().value("language").toString();
    return chosen.isEmpty() ? QLocale::system().name() : chosen;
}

}  // namespace terrawalk::gui
