#include "app/gui/setting_editor.hpp"

#include <QCheckBox>
#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QSignalBlocker>
#include <QStyle>
#include <array>
#include <utility>

#include "app/gui/setting_words.hpp"
#include "app/gui/survey_session.hpp"
#include "app/gui/theme.hpp"

namespace terrawalk::gui {

namespace {

QString text(const std::string& utf8) {
    return QString::fromStdString(utf8);
}

// Longer endings first.
constexpr std::array<std::pair<const char*, const char*>, 15> kUnits{{
    {"_m_per_sqrt_min", "m/√min"},
    {"_m2ps5", "m²/s⁵"},
    {"_m2ps4", "m²/s⁴"},
    {"_m2ps3", "m²/s³"},
    {"_m2ps2", "m²/s²"},
    {"_m2ps", "m²/s"},
    {"_m2", "m²"},
    {"_mps2", "m/s²"},
    {"_mps", "m/s"},
    {"_per_v2", "per v²"},
    {"_deg", "°"},
    {"_m", "m"},
    {"_s", "s"},
    {"_sigma", "σ"},
    {"_sigmas", "σ"},
}};

// A zero that leaves the choice to the program reads better as a word.
bool zeroMeansAuto(const QString& key) {
    return text(parameterInfo(key.toStdString()).meaning).contains("0: from ");
}

}  // namespace

SettingEditor::SettingEditor(SurveySession& session, const QString& key, QWidget* parent)
    : QWidget(parent), session_(session), key_(key) {
    auto* layout = new QHBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(kGrid_px / 2);
    setToolTip(settingHelp(key));
    setWhatsThis(toolTip());
    const QString range = text(parameterInfo(key.toStdString()).range);
    if (range == "true, false") {
        buildFlag();
    } else if (range.contains(", ")) {
        buildChoice(range.split(", "));
    } else {
        buildNumber();
    }
}

void SettingEditor::buildFlag() {
    auto* box = new QCheckBox(this);
    box->setAccessibleName(settingLabel(key_));
    layout()->addWidget(box);
    const auto follow = [this, box](const QString& key) {
        if (key != key_) return;
        const QSignalBlocker quiet(box);
        box->setChecked(session_.settings().text(key_.toStdString()) == "true");
    };
    follow(key_);
    connect(&session_, &SurveySession::settingChanged, box, follow);
    connect(box, &QCheckBox::toggled, this,
            [this](bool on) { session_.changeSetting(key_, on ? "true" : "false"); });
    setFocusProxy(box);
}

void SettingEditor::buildChoice(const QStringList& names) {
    auto* choice = new QComboBox(this);
    choice->addItems(names);
    choice->setAccessibleName(settingLabel(key_));
    choice->setMinimumContentsLength(8);
    choice->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    // The wheel is for the panel: it must not change what it only passes over.
    choice->setFocusPolicy(Qt::StrongFocus);
    choice->installEventFilter(this);
    layout()->addWidget(choice);
    const auto follow = [this, choice](const QString& key) {
        if (key != key_) return;
        const QSignalBlocker quiet(choice);
        choice->setCurrentText(text(session_.settings().text(key_.toStdString())));
    };
    follow(key_);
    connect(&session_, &SurveySession::settingChanged, choice, follow);
    connect(choice, &QComboBox::currentTextChanged, this,
            [this](const QString& name) { session_.changeSetting(key_, name); });
    setFocusProxy(choice);
}

void SettingEditor::buildNumber() {
    auto* field = new QLineEdit(this);
    field->setAlignment(Qt::AlignRight);
    field->setAccessibleName(settingLabel(key_));
    layout()->addWidget(field);
    auto* unit = new QLabel(settingUnit(key_), this);
    unit->setObjectName("quiet");
    unit->setFixedWidth(4 * kGrid_px);
    field->setMinimumWidth(7 * kGrid_px);
    layout()->addWidget(unit);
    const bool empty_is_auto = zeroMeansAuto(key_);
    if (empty_is_auto) field->setPlaceholderText(tr("auto"));
    const auto follow = [this, field, empty_is_auto](const QString& key) {
        if (key != key_) return;
        const QString value = text(session_.settings().text(key_.toStdString()));
        field->setText(empty_is_auto && value.toDouble() == 0.0 ? QString() : value);
        showRefused(*field, false);
    };
    follow(key_);
    connect(&session_, &SurveySession::settingChanged, field, follow);
    connect(field, &QLineEdit::editingFinished, this, [this, field, empty_is_auto] {
        if (!field->isModified()) return;
        field->setModified(false);
        const QString entered = field->text().trimmed();
        const bool automatic = empty_is_auto && entered.isEmpty();
        showRefused(*field, !session_.changeSetting(key_, automatic ? "0" : entered));
    });
    setFocusProxy(field);
}

void SettingEditor::showRefused(QWidget& field, bool refused) {
    field.setProperty("refused", refused);
    field.style()->unpolish(&field);
    field.style()->polish(&field);
}

QString settingHelp(const QString& key) {
    const ParameterInfo& info = parameterInfo(key.toStdString());
    return SettingEditor::tr("<p>%1</p><p>Permitted: %2<br>Default: %3<br><tt>%4</tt></p>")
        .arg(text(info.meaning).toHtmlEscaped(), text(info.range).toHtmlEscaped(),
             text(info.default_value).toHtmlEscaped(), key.toHtmlEscaped());
}

QString settingUnit(const QString& key) {
    for (const auto& [ending, unit] : kUnits) {
        if (key.endsWith(ending)) return QString::fromUtf8(unit);
    }
    return {};
}

QString settingLabel(const QString& key) {
    QStringList parts = key.split('.');
    QString name = parts.takeLast();
    for (const auto& [ending, unit] : kUnits) {
        if (name.endsWith(ending) && !QString(ending).contains("sigma")) {
            name.chop(static_cast<qsizetype>(std::char_traits<char>::length(ending)));
            break;
        }
    }
    // The group's name says more than the first word of the key, which is the step itself.
    if (parts.size() > 1) name = parts.mid(1).join(' ') + " " + name;
    return settingWords(name.replace('_', ' '));
}

}  // namespace terrawalk::gui
