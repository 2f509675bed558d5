#include "app/gui/step_card.hpp"

#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QToolButton>
#include <QVBoxLayout>

#include "app/gui/setting_editor.hpp"
#include "app/gui/theme.hpp"

namespace terrawalk::gui {

namespace {

QFormLayout* settingsForm() {
    auto* form = new QFormLayout;
    form->setContentsMargins(0, 0, 0, 0);
    form->setHorizontalSpacing(kGrid_px);
    form->setVerticalSpacing(kGrid_px / 2);
    form->setFieldGrowthPolicy(QFormLayout::AllNonFixedFieldsGrow);
    form->setLabelAlignment(Qt::AlignLeft | Qt::AlignVCenter);
    return form;
}

void addSetting(QFormLayout& form, SurveySession& session, const QString& key, const QString& label,
                bool wrapped) {
    auto* editor = new SettingEditor(session, key);
    auto* name = new QLabel(label);
    name->setToolTip(editor->toolTip());
    name->setBuddy(editor);
    name->setWordWrap(wrapped);
    form.addRow(name, editor);
}

}  // namespace

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
    if (!step.important.empty()) {
        auto* form = settingsForm();
        for (const auto& [key, label] : step.important) addSetting(*form, session, key, label, false);
        body_->addLayout(form);
    }
    themeChanged();
    if (further_keys_.isEmpty()) return;
    fold_ = new QToolButton;
    fold_->setObjectName("fold");
    fold_->setCheckable(true);
    fold_->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
    fold_->setIconSize({12, 12});
    fold_->setText(tr("%n more setting(s)", nullptr, static_cast<int>(further_keys_.size())));
    connect(fold_, &QToolButton::toggled, this, &StepCard::setUnfolded);
    body_->addWidget(fold_);
    themeChanged();
}

void StepCard::themeChanged() {
    picture_->setPixmap(icon(icon_name_, accentColour()).pixmap(16, 16));
    if (fold_ != nullptr) fold_->setIcon(icon(fold_->isChecked() ? "opened" : "closed", quietColour()));
}

void StepCard::setState(const QString& state, const QColor& colour) {
    state_->setText(state);
    state_->setStyleSheet("color: " + colour.name());
}

void StepCard::addBody(QWidget* widget) {
    body_->addWidget(widget);
}

void StepCard::setUnfolded(bool unfolded) {
    if (fold_ == nullptr) return;
    fold_->setChecked(unfolded);
    fold_->setIcon(icon(unfolded ? "opened" : "closed", quietColour()));
    if (unfolded && further_ == nullptr) buildFurther();
    if (further_ != nullptr) further_->setVisible(unfolded);
}

void StepCard::buildFurther() {
    further_ = new QWidget;
    auto* form = settingsForm();
    form->setRowWrapPolicy(QFormLayout::WrapAllRows);
    further_->setLayout(form);
    for (const QString& key : further_keys_) addSetting(*form, session_, key, settingLabel(key), true);
    body_->addWidget(further_);
}

}  // namespace terrawalk::gui
