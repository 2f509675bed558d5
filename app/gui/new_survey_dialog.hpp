#pragma once

#include <QDialog>
#include <QStringList>
#include <filesystem>
#include <functional>
#include <set>
#include <stop_token>

#include "app/gui/background.hpp"
#include "app/pipeline/new_survey_job.hpp"

class QCheckBox;
class QComboBox;
class QLabel;
class QLineEdit;
class QPushButton;
class QTableWidget;

namespace terrawalk::gui {

/// A survey from loose files: what was guessed of them stands in a table that a person corrects, and becomes
/// a survey.json. Files are read beside the window.
class NewSurveyDialog : public QDialog {
    Q_OBJECT
  public:
    explicit NewSurveyDialog(QWidget* parent = nullptr);
    ~NewSurveyDialog() override;

    /// Logs, tables of marks, and folders; what was corrected already stays.
    void addFiles(const QStringList& paths);
    [[nodiscard]] bool reading() const { return reading_; }
    /// As the fields stand now.
    [[nodiscard]] const SurveyDraft& draft() const { return draft_; }

    /// How a person is asked for files; a test answers in its place.
    struct Questions {
        std::function<QStringList(const QString& title)> files;
        std::function<QString(const QString& title)> folder;
    };
    Questions questions;

    /// What its table shows.
    enum Column { RunColumn, LogColumn, KindColumn, StartColumn, TargetColumn, LengthColumn, ReasonColumn };

  Q_SIGNALS:
    void created(const QString& survey);

  protected:
    void dragEnterEvent(QDragEnterEvent* event) override;
    void dropEvent(QDropEvent* event) override;

  private:
    void buildTable();
    QWidget* buildFields();
    void readFiles();
    void takeRead(Result<SurveyDraft> read);
    void takeDraft(SurveyDraft draft);
    void fillTable();
    void fillRow(int row, std::size_t run);
    void fillBadRow(int row, const Error& error);
    void fillFields();
    void removeSelected();
    void changeRun(std::size_t run, const std::function<void(DraftRun&)>& change);
    /// Takes the fields over; the first that cannot be read, in words.
    QString takeFields();
    void check();
    void create();
    [[nodiscard]] QString problem();

    Background<Result<SurveyDraft>> draft_beside_{[this](Result<SurveyDraft> read) {
        takeRead(std::move(read));
    }};
    std::stop_source stop_;
    std::vector<std::filesystem::path> files_;
    SurveyDraft draft_;
    std::set<std::filesystem::path> corrected_;  ///< logs of runs that a person changed
    bool filling_ = false;
    bool reading_ = false;  ///< until what was read stands in the table
    QTableWidget* table_ = nullptr;
    QLineEdit* name_ = nullptr;
    QLineEdit* latitude_ = nullptr;
    QLineEdit* longitude_ = nullptr;
    QLineEdit* height_ = nullptr;
    QComboBox* frame_ = nullptr;
    QLineEdit* file_ = nullptr;
    QCheckBox* replace_ = nullptr;
    QLabel* marks_ = nullptr;
    QLabel* notes_ = nullptr;
    QLabel* problem_ = nullptr;
    QPushButton* remove_ = nullptr;
    QPushButton* create_ = nullptr;
};

/// Whether files that were dropped are the parts of a survey, not a survey itself.
[[nodiscard]] bool areLooseFiles(const QStringList& paths);

}  // namespace terrawalk::gui
