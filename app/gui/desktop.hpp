#pragma once

#include <QObject>
#include <memory>

#include "app/gui/main_window.hpp"
#include "app/gui/survey_session.hpp"

namespace terrawalk::gui {

/// What is open, and the window that shows it: the one outlives the other, so that a window in another
/// language takes its place without losing anything.
class Desktop : public QObject {
    Q_OBJECT
  public:
    explicit Desktop(QObject* parent = nullptr);
    ~Desktop() override;
    [[nodiscard]] SurveySession& session() { return session_; }
    [[nodiscard]] MainWindow& window() { return *window_; }

  private:
    void makeWindow();
    void setLanguage(const QString& language);
    void setFigureStyle(FigureStyle style);
    void replaceWindow();
    SurveySession session_;
    MessageModel messages_;
    std::unique_ptr<MainWindow> window_;
};

}  // namespace terrawalk::gui
