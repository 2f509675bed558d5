#include "app/gui/setting_editor.hpp"

#include <QCheckBox>
#include <QComboBox>
#include <QHBoxLayout>
#include <QJsonArray>
#include <QJsonDocument>
#include <QLabel>
#include <QLineEdit>
#include <QSignalBlocker>
#include <QStyle>
#include <QToolButton>
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
constexpr std::array<std::pair<const char*, const char*>, 23> kUnits{{
    {"_m_per_sqrt_min", "m/√min"},
    {"_mps_per_sqrt_s", "m/s/√s"},
    {"_deg_per_sqrt_s", "°/√s"},
    {"_m_per_sqrt_m", "m/√m"},
    {"_m_per_sqrt_s", "m/√s"},
    {"_per_m", "1/m"},
    {"_m2ps5", "m²/s⁵"},
    {"_m2ps4", "m²/s⁴"},
    {"_m2ps3", "m²/s³"},
    {"_m2ps2", "m²/s²"},
    {"_m2ps", "m²/s"},
    {"_m2", "m²"},
    {"_mps2", "m/s²"},
    {"_mps", "m/s"},
    {"_per_v2", "per v²"},
    {"_dps", "°/s"},
    {"_deg", "°"},
    {"_m", "m"},
    {"_s", "s"},
    {"_scale_sigma", ""},  // shares
    {"_axes_sigma", ""},
    {"_sigma", "σ"},
    {"_sigmas", "σ"},
}};

/// The last part of a key without its unit, as words.
QString lastWords(const QString& key) {
    QString name = key.mid(key.lastIndexOf('.') + 1);
    for (const auto& [ending, unit] : kUnits) {
        if (name.endsWith(ending) && !QString(ending).contains("sigma")) {
            name.chop(static_cast<qsizetype>(std::char_traits<char>::length(ending)));
            break;
        }
    }
    return name.replace('_', ' ');
}

// A zero that leaves the choice to the program reads better as a word.
bool zeroMeansAuto(const QString& key) {
    return text(parameterInfo(key.toStdString()).meaning).contains("0: from ");
}

QString defaultOf(const QString& key) {
    return text(parameterInfo(key.toStdString()).default_value);
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
    buildReset();
}

void SettingEditor::buildReset() {
    reset_ = new QToolButton(this);
    reset_->setObjectName("reset");
    reset_->setIconSize({16, 16});
    reset_->setAccessibleName(tr("Back to the default of %1").arg(settingLabel(key_)));
    reset_->setToolTip(tr("Back to the default: %1").arg(settingValueWords(key_, defaultOf(key_))));
    layout()->addWidget(reset_);
    connect(reset_, &QToolButton::clicked, this, [this] { session_.changeSetting(key_, defaultOf(key_)); });
    const auto follow = [this](const QString& key) {
        if (key == key_) reset_->setVisible(session_.settings().changed(key_.toStdString()));
    };
    follow(key_);
    connect(&session_, &SurveySession::settingChanged, reset_, follow);
    themeChanged();
}

void SettingEditor::keepRoomForReset() {
    QSizePolicy policy = reset_->sizePolicy();
    policy.setRetainSizeWhenHidden(true);
    reset_->setSizePolicy(policy);
}

void SettingEditor::themeChanged() {
    reset_->setIcon(icon("reset"));
}

void SettingEditor::changeEvent(QEvent* event) {
    QWidget::changeEvent(event);
    if (event->type() == QEvent::PaletteChange && reset_ != nullptr) themeChanged();
}

void SettingEditor::buildFlag() {
    auto* box = new QCheckBox(this);
    box->setAccessibleName(settingLabel(key_));
    layout()->addWidget(box);
    qobject_cast<QHBoxLayout*>(layout())->addStretch();
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
    for (const QString& name : names) {
        choice->addItem(choiceWords(name), name);
        choice->setItemData(choice->count() - 1, name, Qt::ToolTipRole);
    }
    choice->setAccessibleName(settingLabel(key_));
    choice->setMinimumContentsLength(8);
    choice->setSizeAdjustPolicy(QComboBox::AdjustToMinimumContentsLengthWithIcon);
    keepFromWheel(*choice);
    qobject_cast<QHBoxLayout*>(layout())->addWidget(choice, 1);
    const auto follow = [this, choice](const QString& key) {
        if (key != key_) return;
        const QSignalBlocker quiet(choice);
        choice->setCurrentIndex(choice->findData(text(session_.settings().text(key_.toStdString()))));
    };
    follow(key_);
    connect(&session_, &SurveySession::settingChanged, choice, follow);
    connect(choice, &QComboBox::currentIndexChanged, this,
            [this, choice] { session_.changeSetting(key_, choice->currentData().toString()); });
    setFocusProxy(choice);
}

void SettingEditor::buildNumber() {
    auto* field = new QLineEdit(this);
    field->setAlignment(Qt::AlignRight);
    field->setAccessibleName(settingLabel(key_));
    qobject_cast<QHBoxLayout*>(layout())->addWidget(field, 1);
    field->setMinimumWidth(7 * kGrid_px);
    showUnit(*field);
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

// Inside the field, so that fields with and without a unit end in one line.
void SettingEditor::showUnit(QLineEdit& field) const {
    const QString words = settingUnit(key_);
    if (words.isEmpty()) return;
    auto* unit = new QLabel(words, &field);
    unit->setObjectName("quiet");
    unit->setAttribute(Qt::WA_TransparentForMouseEvents);
    auto* inside = new QHBoxLayout(&field);
    inside->setContentsMargins(0, 0, kGrid_px, 0);
    inside->addStretch();
    inside->addWidget(unit);
    field.setTextMargins(0, 0, unit->sizeHint().width() + kGrid_px / 2, 0);
}

void SettingEditor::showRefused(QWidget& field, bool refused) {
    field.setProperty("refused", refused);
    field.style()->unpolish(&field);
    field.style()->polish(&field);
}

void markChanged(QLabel& name, bool changed) {
    if (name.property("changed").toBool() == changed) return;
    name.setProperty("changed", changed);
    name.style()->unpolish(&name);
    name.style()->polish(&name);
}

// Numbers from one to another; names of choices are words of the file and stay.
static QString rangeWords(const QString& range) {
    const QStringList ends = range.split(" to ");
    return ends.size() == 2 ? SettingEditor::tr("%1 to %2").arg(ends[0], ends[1]) : range;
}

QString settingHelp(const QString& key) {
    const ParameterInfo& info = parameterInfo(key.toStdString());
    return SettingEditor::tr("<p>%1</p><p>Permitted: %2<br>Default: %3<br><tt>%4</tt></p>")
        .arg(settingMeaning(key).toHtmlEscaped(), rangeWords(text(info.range)).toHtmlEscaped(),
             text(info.default_value).toHtmlEscaped(), key.toHtmlEscaped());
}

QString settingUnit(const QString& key) {
    for (const auto& [ending, unit] : kUnits) {
        if (key.endsWith(ending)) return QString::fromUtf8(unit);
    }
    return {};
}

QString settingLabelInEnglish(const QString& key) {
    const QStringList parts = key.split('.');
    QString name = lastWords(key);
    // The group's name says more than the first word of the key, which is the step itself.
    if (parts.size() > 2) name = parts.mid(1, parts.size() - 2).join(' ').replace('_', ' ') + " " + name;
    return name;
}

QString settingLabel(const QString& key) {
    return settingWords(settingLabelInEnglish(key));
}

QString settingName(const QString& key) {
    const QString english = settingLabelInEnglish(key), translated = settingWords(english);
    if (translated != english) return translated;
    QString name = lastWords(key);
    name.replace("gnss", "GNSS").replace("huber", "Huber");
    for (const auto& [axis, direction] : {std::pair(" e", " east"), {" n", " north"}, {" u", " up"}}) {
        if (!name.endsWith(axis)) continue;
        name.chop(2);
        name += direction;
        break;
    }
    return name.left(1).toUpper() + name.mid(1);
}

QString settingTitle(const QString& key) {
    if (key.startsWith("edits.")) return settingMeaning(key);
    return QString::fromUtf8("%1 › %2").arg(settingGroupWords(settingPrefix(key)), settingName(key));
}

QString settingValueWords(const QString& key, const QString& value) {
    if (key.startsWith("edits."))
        return QString::number(QJsonDocument::fromJson(value.toUtf8()).array().size());
    if (value == "true") return SettingEditor::tr("on");
    if (value == "false") return SettingEditor::tr("off");
    if (zeroMeansAuto(key) && value.toDouble() == 0.0) return SettingEditor::tr("auto");
    const QString unit = settingUnit(key);
    return unit.isEmpty() ? choiceWords(value) : value + " " + unit;
}

}  // namespace terrawalk::gui
