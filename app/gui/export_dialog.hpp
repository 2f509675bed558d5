#pragma once

#include <QDialog>

class QCheckBox;
class QLabel;
class QLineEdit;
class QPushButton;

namespace terrawalk::gui {

class SurveySession;

/// Where the results go and in which formats: the same choices as `process -o` and `export`, with the command
/// that does the same.
class ExportDialog : public QDialog {
    Q_OBJECT
  public:
    explicit ExportDialog(SurveySession& session, QWidget* parent = nullptr);
    void setFolder(const QString& folder);

  private:
    void check();
    void start();
    [[nodiscard]] QString commands() const;
    [[nodiscard]] bool anyPoints() const;
    SurveySession& session_;
    QLineEdit* folder_ = nullptr;
    QList<QCheckBox*> formats_;
    QCheckBox* all_points_ = nullptr;
    QLabel* problem_ = nullptr;
    QLabel* command_ = nullptr;
    QPushButton* export_ = nullptr;
};

}  // namespace terrawalk::gui
