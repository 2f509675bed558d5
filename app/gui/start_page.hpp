#pragma once

#include <QWidget>

class QVBoxLayout;

namespace terrawalk::gui {

/// What the window shows before a survey is open.
class StartPage : public QWidget {
    Q_OBJECT
  public:
    explicit StartPage(QWidget* parent = nullptr);
    /// Lists the recent surveys anew.
    void refresh();

  Q_SIGNALS:
    void openAsked();
    void newAsked();
    void surveyAsked(const QString& path);
    void sampleAsked(const QString& path);

  private:
    QVBoxLayout* recent_ = nullptr;
};

}  // namespace terrawalk::gui
