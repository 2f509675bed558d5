#include "app/gui/desktop.hpp"

#include <QSettings>
#include <QTimer>

#include "app/gui/language.hpp"

namespace terrawalk::gui {

Desktop::Desktop(QObject* parent) : QObject(parent) {
    makeWindow();
}

Desktop::~Desktop() = default;

void Desktop::makeWindow() {
    window_ = std::make_unique<MainWindow>(session_, messages_);
    // Later: the window is in the middle of telling.
    connect(
        window_.get(), &MainWindow::languageAsked, this,
        [this](const QString& language) { setLanguage(language); }, Qt::QueuedConnection);
    connect(
        window_.get(), &MainWindow::figureStyleAsked, this,
        [this](FigureStyle style) { setFigureStyle(style); }, Qt::QueuedConnection);
}

void Desktop::setLanguage(const QString& language) {
    QSettings().setValue("language", language);
    applyLanguage(language);
    replaceWindow();
}

void Desktop::setFigureStyle(FigureStyle style) {
    keepFigureStyle(style);
    applyFigureStyle(style);
    replaceWindow();
}

void Desktop::replaceWindow() {
    window_->keepLayout();
    const QRect place = window_->geometry();
    const bool visible = window_->isVisible();
    makeWindow();
    window_->setGeometry(place);
    window_->setVisible(visible);
}

}  // namespace terrawalk::gui
