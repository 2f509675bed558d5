#pragma once

#include <QDialog>
#include <QTimer>
#include <functional>
#include <utility>
#include <vector>

#include "app/gui/steps.hpp"

class QAction;
class QCheckBox;
class QLabel;
class QLineEdit;
class QListWidget;
class QPushButton;
class QScrollArea;

namespace terrawalk::gui {

class SettingRow;
class SurveySession;

/// All settings but edits, group by group, with a search and a mark on what has not its default. Stays open
/// beside the window. It has so many parts that they are made in short turns of the event loop: openAt()
/// shows it when all are there, so that the window is never deaf for long.
class SettingsDialog : public QDialog {
    Q_OBJECT
  public:
    explicit SettingsDialog(SurveySession& session, QWidget* parent = nullptr);
    /// Shows it, scrolled to the settings of a step, as soon as it is complete.
    void openAt(StepKind step);
    void themeChanged();

  private:
    /// A group below its heading.
    struct Group {
        QString prefix;
        QString title;
        StepKind step = StepKind::Fuse;
        QWidget* heading = nullptr;
        std::vector<SettingRow*> rows;
        int list_row = 0;
        int step_row = 0;  ///< of the step above it
    };
    /// What is to be made, in order.
    void plan();
    void makeSomeParts();
    void present();
    QWidget* buildList();
    QWidget* buildSearch();
    QWidget* buildFooter();
    void addStep(const Step& step);
    void addGroup(const Step& step, const QString& prefix, int step_row);
    void addRow(const QString& key);
    void scrollToStep();
    void filter();
    void showChanged();
    void scrollTo(int list_row);
    void followScroll();
    SurveySession& session_;
    std::vector<Group> groups_;
    QLineEdit* search_ = nullptr;
    QAction* search_icon_ = nullptr;
    std::vector<std::pair<int, QString>> step_icons_;  ///< row of the list and name
    QCheckBox* only_changed_ = nullptr;
    QListWidget* list_ = nullptr;
    QScrollArea* scroll_ = nullptr;
    QLabel* nothing_ = nullptr;
    QPushButton* reset_ = nullptr;
    std::vector<std::function<void()>> parts_;  ///< the planned ones
    std::size_t parts_made_ = 0;
    QTimer next_parts_;
    StepKind wanted_step_ = StepKind::Fuse;
    bool jumping_ = false;  ///< to a group that was chosen: the list need not follow
};

}  // namespace terrawalk::gui
