#include "app/gui/step_card.hpp"

#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QToolButton>
#include <QVBoxLayout>
#include <algorithm>

#include "app/gui/setting_editor.hpp"
#include "app/gui/survey_session.hpp"
#include "app/gui/theme.hpp"

namespace terrawalk::gui {

StepCard::StepCard(SurveySession& session, const Step& step, QWidget* parent)
    : QFrame(parent), session_(session), further_keys_(furtherSettings(step)), icon_name_(step.icon) {
    setObjectName("card");
    body_ = new QVBoxLayout(this);
    body_->setContentsMargins(12, kGrid_px, 12, kGrid_px);
    body_->setSpacing(kGrid_px);
    auto* head = new QHBoxLayout;
    head->setSpacing(kGrid_px);
    picture_ = new QLabel;
    picture_->setFixedWidth(16);
    head->addWidget(picture_);
    auto* title = new QLabel(step.title);
    title->setObjectName("cardTitle");
    head->addWidget(title);
    head->addStretch();
    state_ = new QLabel;
    head->addWidget(state_);
    body_->addLayout(head);
    if (!step.important.empty()) addImportant(step);
    if (!further_keys_.isEmpty()) {
        further_ = new QToolButton;
        further_->setObjectName("further");
        connect(further_, &QToolButton::clicked, this, &StepCard::furtherAsked);
        body_->addWidget(further_);
    }
    connect(&session_, &SurveySession::settingsChanged, this, &StepCard::showChanged);
    themeChanged();
    showChanged();
}

QFormLayout& StepCard::form() {
    if (form_ != nullptr) return *form_;
    form_ = new QFormLayout;
    form_->setContentsMargins(0, 0, 0, 0);
    form_->setHorizontalSpacing(kGrid_px);
    form_->setVerticalSpacing(kGrid_px / 2);
    form_->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
    form_->setLabelAlignment(Qt::AlignLeft | Qt::AlignVCenter);
    if (folded_ != nullptr) {
        folded_->setLayout(form_);
    } else {
        body_->addLayout(form_);
    }
    return *form_;
}

QLabel* StepCard::addName(const QString& key, const QString& words) {
    auto* name = new QLabel(words);
    name->setObjectName("settingName");
    names_[key] = name;
    return name;
}

void StepCard::addImportant(const Step& step) {
    for (const auto& [key, label] : step.important) {
        auto* editor = new SettingEditor(session_, key);
        QLabel* name = addName(key, label);
        name->setToolTip(editor->toolTip());
        name->setBuddy(editor);
        form().addRow(name, editor);
    }
}

void StepCard::addField(const QString& words, QWidget* field) {
    QLabel* name = addName(words, words);
    name->setToolTip(field->toolTip());
    name->setBuddy(field);
    form().addRow(name, field);
}

void StepCard::beginFold(const QString& object_name, const QString& words) {
    fold_ = new QToolButton;
    fold_->setObjectName("further");
    fold_->setAccessibleName(words);
    fold_->setText(words);
    fold_->setCheckable(true);
    fold_->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
    fold_->setIconSize({12, 12});
    folded_ = new QWidget;
    folded_->setObjectName(object_name);
    form_ = nullptr;
    body_->addWidget(fold_);
    body_->addWidget(folded_);
    connect(fold_, &QToolButton::toggled, this, &StepCard::unfold);
    unfold(false);
}

void StepCard::unfold(bool unfolded) {
    folded_->setVisible(unfolded);
    fold_->setIcon(icon(unfolded ? "opened" : "closed", quietColour()));
}

int StepCard::namesWidth_px() const {
    int width_px = 0;
    for (const auto& [key, name] : names_) {
        QFont bold = name->font();
        bold.setBold(true);
        width_px = std::max(width_px, QFontMetrics(bold).horizontalAdvance(name->text()) + 2);
    }
    return width_px;
}

void StepCard::setNamesWidth(int width_px) {
    for (const auto& [key, name] : names_) name->setFixedWidth(width_px);
}

void StepCard::showChanged() {
    const RunSettings& settings = session_.settings();
    for (const auto& [key, name] : names_) markChanged(*name, settings.changed(key.toStdString()));
    if (further_ == nullptr) return;
    const auto changed = std::count_if(further_keys_.begin(), further_keys_.end(), [&](const QString& key) {
        return settings.changed(key.toStdString());
    });
    const QString all = tr("%n more setting(s)…", nullptr, static_cast<int>(further_keys_.size()));
    further_->setText(changed == 0 ? all : tr("%1 %2 changed").arg(all).arg(changed));
}

void StepCard::themeChanged() {
    picture_->setPixmap(icon(icon_name_, accentColour()).pixmap(16, 16));
    if (fold_ != nullptr) unfold(fold_->isChecked());
}

void StepCard::setState(const QString& state, const QColor& colour) {
    state_->setText(state);
    state_->setStyleSheet("color: " + colour.name());
}

void StepCard::addBody(QWidget* widget) {
    body_->addWidget(widget);
}

}  // namespace terrawalk::gui
