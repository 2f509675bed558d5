#include "app/gui/theme.hpp"

#include <QApplication>
#include <QFile>
#include <QHash>
#include <QPainter>
#include <QPalette>
#include <QPixmap>
#include <QProxyStyle>
#include <QSvgRenderer>

/// Resources of a static library are found only once somebody asked for them; outside any namespace, as Qt
/// wants.
static void initResources() {
    Q_INIT_RESOURCE(gui);
    Q_INIT_RESOURCE(translations);
}

namespace terrawalk::gui {

namespace {

struct Colours {
    QColor window, base, raised, text, quiet, line, accent, on_accent, warning, error;
};

const Colours kLight{QColor("#f3f4f2"), QColor("#ffffff"), QColor("#fafbf9"), QColor("#1d2421"),
                     QColor("#5b6660"), QColor("#d3d8d4"), QColor("#12695c"), QColor("#ffffff"),
                     QColor("#8a5a00"), QColor("#b3261e")};
const Colours kDark{QColor("#1e2322"), QColor("#171b1a"), QColor("#262c2a"), QColor("#e6ebe8"),
                    QColor("#9caaa4"), QColor("#3a423f"), QColor("#4fb3a2"), QColor("#0d1a17"),
                    QColor("#e5b454"), QColor("#f2877f")};

Theme current = Theme::Light;

const Colours& colours() {
    return current == Theme::Light ? kLight : kDark;
}

QPalette paletteOf(const Colours& c) {
    QPalette p;
    p.setColor(QPalette::Window, c.window);
    p.setColor(QPalette::WindowText, c.text);
    p.setColor(QPalette::Base, c.base);
    p.setColor(QPalette::AlternateBase, c.raised);
    p.setColor(QPalette::Text, c.text);
    p.setColor(QPalette::Button, c.raised);
    p.setColor(QPalette::ButtonText, c.text);
    p.setColor(QPalette::BrightText, c.error);
    p.setColor(QPalette::ToolTipBase, c.raised);
    p.setColor(QPalette::ToolTipText, c.text);
    p.setColor(QPalette::PlaceholderText, c.quiet);
    p.setColor(QPalette::Highlight, c.accent);
    p.setColor(QPalette::HighlightedText, c.on_accent);
    p.setColor(QPalette::Link, c.accent);
    p.setColor(QPalette::LinkVisited, c.accent);
    p.setColor(QPalette::Mid, c.line);
    p.setColor(QPalette::Midlight, c.line);
    p.setColor(QPalette::Light, c.raised);
    p.setColor(QPalette::Dark, c.line.darker(115));
    p.setColor(QPalette::Shadow, c.line.darker(140));
    for (const auto role : {QPalette::WindowText, QPalette::Text, QPalette::ButtonText}) {
        QColor faint = c.quiet;
        faint.setAlpha(150);
        p.setColor(QPalette::Disabled, role, faint);
    }
    return p;
}

// Sizes in steps of eight pixels, or half of that.
constexpr const char* kStyle = R"(
QMainWindow::separator { background: %line; width: 1px; height: 1px; }
QToolBar { border: 0; border-bottom: 1px solid %line; padding: 4px 8px; spacing: 4px; background: %window; }
QToolBar QToolButton { padding: 5px; border-radius: 4px; border: 0; }
QToolBar QToolButton:hover { background: %line; }
QToolBar QToolButton:checked { background: %accent; }
QStatusBar { border-top: 1px solid %line; }
QStatusBar::item { border: 0; }
QDockWidget { font-weight: 700; titlebar-close-icon: url(:/icons/dock_close.svg); titlebar-normal-icon: url(:/icons/dock_float.svg); }
QDockWidget::close-button, QDockWidget::float-button { border: 0; border-radius: 4px; padding: 0; icon-size: 14px; subcontrol-origin: margin; subcontrol-position: right; position: absolute; top: 0; bottom: 0; width: 18px; }
QDockWidget::close-button { right: 8px; }
QDockWidget::float-button { right: 32px; }
QDockWidget::close-button:hover, QDockWidget::float-button:hover { background: %line; }
QDockWidget::title { padding: 8px; background: %window; border-bottom: 1px solid %line; }
QTreeView, QTableView, QScrollArea, QPlainTextEdit { border: 0; background: %base; }
QTreeView::item { padding: 3px 0; }
QTreeView::item:selected, QTableView::item:selected { background: %accent; color: %onaccent; }
QTableView#runs_table, QTableView#differences_table { outline: 0; }
QTableView#runs_table::item, QTableView#differences_table::item { border: 0; padding: 0 5px; }
QHeaderView::section { background: %raised; border: 0; border-bottom: 1px solid %line; padding: 4px 8px; font-weight: 700; }
QTabWidget::pane { border: 0; }
QTabBar::tab { padding: 8px 16px; border: 0; border-bottom: 2px solid transparent; color: %quiet; }
QTabBar::tab:selected { color: %text; border-bottom: 2px solid %accent; }
QLineEdit, QComboBox, QAbstractSpinBox { padding: 3px 8px; border: 1px solid %line; border-radius: 4px; background: %base; min-height: 18px; selection-background-color: %accent; selection-color: %onaccent; }
QLineEdit:hover, QComboBox:hover, QAbstractSpinBox:hover { border-color: %quiet; }
QLineEdit:focus, QComboBox:focus, QAbstractSpinBox:focus { border-color: %accent; }
QLineEdit:disabled, QComboBox:disabled, QAbstractSpinBox:disabled { background: %window; color: %quiet; }
QAbstractSpinBox { padding-right: 20px; }
QAbstractSpinBox::up-button, QAbstractSpinBox::down-button { subcontrol-origin: border; width: 20px; height: 12px; border: 0; background: transparent; }
QAbstractSpinBox::up-button { subcontrol-position: top right; margin: 1px 1px 0 0; border-top-right-radius: 3px; }
QAbstractSpinBox::down-button { subcontrol-position: bottom right; margin: 0 1px 1px 0; border-bottom-right-radius: 3px; }
QAbstractSpinBox::up-button:hover, QAbstractSpinBox::down-button:hover { background: %line; }
QAbstractSpinBox::up-arrow { image: url(:/icons/chevron_up.svg); width: 10px; height: 10px; }
QAbstractSpinBox::down-arrow { image: url(:/icons/chevron.svg); width: 10px; height: 10px; }
QSlider { min-height: 20px; }
QSlider::groove:horizontal { height: 4px; border-radius: 2px; background: %line; }
QSlider::sub-page:horizontal { height: 4px; border-radius: 2px; background: %accent; }
QSlider::handle:horizontal { width: 14px; height: 14px; margin: -6px 0; border-radius: 8px; border: 1px solid %accent; background: %base; }
QSlider::handle:horizontal:hover, QSlider::handle:horizontal:focus { background: %accent; }
QSlider::sub-page:horizontal:disabled { background: %line; }
QSlider::handle:horizontal:disabled { border-color: %line; }
QLineEdit[refused="true"] { border-color: %error; }
QComboBox::drop-down { border: 0; width: 20px; }
QComboBox::down-arrow { image: url(:/icons/chevron.svg); width: 12px; height: 12px; }
QComboBox QAbstractItemView { background: %base; border: 1px solid %line; selection-background-color: %accent; selection-color: %onaccent; }
QPushButton { padding: 6px 16px; border: 1px solid %line; border-radius: 4px; background: %raised; }
QPushButton:hover, QPushButton:focus { border-color: %accent; }
QPushButton:disabled { color: %quiet; }
QPushButton#primary { background: %accent; color: %onaccent; border-color: %accent; font-weight: 700; }
QPushButton#primary:disabled { background: %line; color: %quiet; border-color: %line; }
QPushButton#primary:focus { border-color: %text; }
QFrame#card { background: %base; border: 1px solid %line; border-radius: 6px; }
QLabel#quiet { color: %quiet; }
QLabel#title { font-size: 22px; font-weight: 700; }
QLabel#heading { font-size: 15px; font-weight: 700; }
QLabel#figure { font-size: 19px; font-weight: 700; }
QLabel#cardTitle { font-weight: 700; }
QLabel#verdict { color: %accent; font-weight: 700; }
QLabel#verdict[verdict="-1"] { color: %warning; }
QLabel#settingName[changed="true"] { color: %accent; font-weight: 700; }
QToolButton#further { border: 0; color: %quiet; padding: 4px 0; }
QToolButton#further:hover, QToolButton#further:focus { color: %accent; text-decoration: underline; }
QToolButton#reset { border: 0; border-radius: 4px; padding: 3px; }
QToolButton#reset:hover, QToolButton#reset:focus { background: %line; }
QListWidget#settingGroups { border: 0; border-right: 1px solid %line; background: %window; padding: 8px 0; outline: 0; }
QListWidget#settingGroups::item { border: 0; padding: 4px 12px; }
QListWidget#settingGroups::item:selected { background: %accent; color: %onaccent; }
QWidget#settingRow { border-bottom: 1px solid %line; }
QCheckBox { spacing: 8px; }
QCheckBox::indicator, QTreeView::indicator { width: 14px; height: 14px; border: 1px solid %quiet; border-radius: 3px; background: %base; }
QCheckBox::indicator:checked, QTreeView::indicator:checked { background: %accent; border-color: %accent; image: url(:/icons/%tick.svg); }
QCheckBox::indicator:disabled { border-color: %line; }
QCheckBox::indicator:focus { border: 2px solid %accent; }
QDialogButtonBox { dialogbuttonbox-buttons-have-icons: 0; }
QLabel#key { border: 1px solid %line; border-radius: 4px; padding: 1px 6px; background: %raised; }
QLabel#command { background: %base; border: 1px solid %line; border-radius: 4px; padding: 8px; font-family: monospace; }
QWidget#footer { border-top: 1px solid %line; }
QMenu { background: %base; border: 1px solid %line; padding: 4px; }
QMenu::item { padding: 5px 24px 5px 8px; border-radius: 4px; }
QMenu::item:selected { background: %accent; color: %onaccent; }
QMenu::item:disabled { color: %quiet; }
QMenu::separator { height: 1px; background: %line; margin: 4px 8px; }
QMenu::icon { padding-left: 8px; }
QMenu::icon:checked { background: %accent; border-radius: 4px; }
QProgressBar { border: 0; border-radius: 3px; background: %line; max-height: 6px; min-height: 6px; }
QProgressBar::chunk { border-radius: 3px; background: %accent; }
QToolTip { background: %raised; color: %text; border: 1px solid %line; padding: 4px; }
QScrollBar:vertical { width: 10px; background: transparent; margin: 0; }
QScrollBar:horizontal { height: 10px; background: transparent; margin: 0; }
QScrollBar::handle { background: %line; border-radius: 4px; min-height: 24px; min-width: 24px; margin: 1px; }
QScrollBar::handle:hover { background: %quiet; }
QScrollBar::add-line, QScrollBar::sub-line { width: 0; height: 0; }
QScrollBar::add-page, QScrollBar::sub-page { background: transparent; }
)";

QString styleSheet(const Colours& c) {
    QString style = kStyle;
    const std::pair<const char*, QColor> names[] = {
        {"%window", c.window}, {"%base", c.base},       {"%raised", c.raised},      {"%text", c.text},
        {"%quiet", c.quiet},   {"%line", c.line},       {"%onaccent", c.on_accent}, {"%accent", c.accent},
        {"%error", c.error},   {"%warning", c.warning},
    };
    style.replace("%tick", current == Theme::Light ? "tick_light" : "tick_dark");
    for (const auto& [name, colour] : names) style.replace(name, colour.name());
    return style;
}

/// Fusion, with a button for what a tool bar has no room for that can be seen as one.
class Style final : public QProxyStyle {
  public:
    Style() : QProxyStyle("Fusion") {}
    [[nodiscard]] int pixelMetric(PixelMetric metric, const QStyleOption* option,
                                  const QWidget* widget) const override {
        return metric == PM_ToolBarExtensionExtent ? 28 : QProxyStyle::pixelMetric(metric, option, widget);
    }
    [[nodiscard]] QIcon standardIcon(StandardPixmap name, const QStyleOption* option,
                                     const QWidget* widget) const override {
        if (name == SP_ToolBarHorizontalExtensionButton) return icon("more");
        return QProxyStyle::standardIcon(name, option, widget);
    }
};

class WheelGuard final : public QObject {
  protected:
    bool eventFilter(QObject* watched, QEvent* event) override {
        if (event->type() != QEvent::Wheel || static_cast<QWidget*>(watched)->hasFocus()) return false;
        event->ignore();
        return true;
    }
};

}  // namespace

namespace {

QByteArray svgOf(const QString& name) {
    initResources();
    QFile file(":/icons/" + name + ".svg");
    return file.open(QIODevice::ReadOnly) ? file.readAll() : QByteArray();
}

/// Drawn once: a tree of a hundred marks asks for the same one a hundred times.
QHash<QString, QIcon>& drawnIcons() {
    static QHash<QString, QIcon> drawn;
    // Pictures must go before the application does.
    static const bool registered = (qAddPostRoutine([] { drawnIcons().clear(); }), true);
    static_cast<void>(registered);
    return drawn;
}

void addPixmaps(QIcon& icon, QByteArray svg, const QColor& ink, QIcon::Mode mode, QIcon::State state) {
    svg.replace("currentColor", ink.name().toUtf8());
    QSvgRenderer renderer(svg);
    for (const int size_px : {16, 24, 32, 48, 64, 128}) {
        QPixmap pixmap(size_px, size_px);
        pixmap.fill(Qt::transparent);
        QPainter painter(&pixmap);
        renderer.render(&painter);
        painter.end();
        icon.addPixmap(pixmap, mode, state);
    }
}

}  // namespace

void registerResources() {
    initResources();
}

void applyTheme(Theme theme) {
    initResources();
    current = theme;
    QApplication::setStyle(new Style);
    QApplication::setPalette(paletteOf(colours()));
    qApp->setStyleSheet(styleSheet(colours()));
}

Theme currentTheme() {
    return current;
}

Theme desktopTheme() {
    const QPalette palette = QApplication::palette();
    const bool dark =
        palette.color(QPalette::Window).lightness() < palette.color(QPalette::WindowText).lightness();
    return dark ? Theme::Dark : Theme::Light;
}

QColor accentColour() {
    return colours().accent;
}

QColor quietColour() {
    return colours().quiet;
}

QColor warningColour() {
    return colours().warning;
}

QColor errorColour() {
    return colours().error;
}

QIcon icon(const QString& name, const QColor& colour) {
    QHash<QString, QIcon>& drawn = drawnIcons();
    const QColor ink = colour.isValid() ? colour : colours().text;
    const QColor faint = colours().line.darker(current == Theme::Light ? 120 : 80);
    const QString key = name + ink.name(QColor::HexArgb) + faint.name();
    const auto found = drawn.constFind(key);
    if (found != drawn.constEnd()) return *found;
    const QByteArray svg = svgOf(name);
    QIcon made;
    if (svg.isEmpty()) return made;
    addPixmaps(made, svg, ink, QIcon::Normal, QIcon::Off);
    addPixmaps(made, svg, faint, QIcon::Disabled, QIcon::Off);
    // In a list, on the accent: the colour of a run could be as dark as that, or as light.
    addPixmaps(made, svg, colours().on_accent, QIcon::Selected, QIcon::Off);
    drawn.insert(key, made);
    return made;
}

QIcon toolIcon(const QString& name) {
    QIcon made = icon(name);
    addPixmaps(made, svgOf(name), colours().on_accent, QIcon::Normal, QIcon::On);
    return made;
}

void keepFromWheel(QWidget& editor) {
    static WheelGuard guard;
    editor.setFocusPolicy(Qt::StrongFocus);
    editor.installEventFilter(&guard);
}

}  // namespace terrawalk::gui
