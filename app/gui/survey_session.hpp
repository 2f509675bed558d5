#pragma once

#include <QObject>
#include <QString>
#include <QStringList>
#include <QUndoStack>
#include <filesystem>
#include <memory>
#include <optional>

#include "app/gui/background_job.hpp"
#include "app/gui/run_settings.hpp"
#include "app/pipeline/process.hpp"
#include "app/pipeline/survey_map.hpp"
#include "survey/result.hpp"
#include "survey/survey.hpp"

namespace terrawalk::gui {

enum class MessageKind { Info, Done, Warning, Error };

/// What is open: a survey, its settings, and the last results. Knows no widgets; all work runs in its job.
/// Values that it hands out are never changed afterwards.
class SurveySession : public QObject {
    Q_OBJECT
  public:
    explicit SurveySession(QObject* parent = nullptr);

    /// Reads the survey of a project file, or of the survey.json in a folder; what was open stays open where
    /// that fails.
    void open(const std::filesystem::path& project_file_or_folder, bool then_process = false);
    void process();
    /// Writes the last results, just as the command line would.
    void exportTo(const std::filesystem::path& folder);
    void cancel() { job_.cancel(); }

    /// Sets one setting, undoably. Refused values become a message, and the setting stays.
    bool changeSetting(const QString& key, const QString& text);

    [[nodiscard]] bool busy() const { return job_.running(); }
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    [[nodiscard]] std::shared_ptr<const Survey> survey() const { return survey_; }
    [[nodiscard]] std::shared_ptr<const Products> products() const { return products_; }
    [[nodiscard]] std::shared_ptr<const SurveyMap> map() const { return map_; }
    [[nodiscard]] const RunSettings& settings() const { return settings_; }
    /// Whether the results come from other settings than those that stand now.
    [[nodiscard]] bool outdated() const { return products_ && !(settings_ == processed_with_); }
    [[nodiscard]] BackgroundJob& job() { return job_; }
    [[nodiscard]] QUndoStack& undoStack() { return undo_; }

    /// Arguments of the command that makes the results that are shown, or would be made now.
    [[nodiscard]] QStringList commandArguments() const;
    /// The same for a shell, with the folder for the output.
    [[nodiscard]] QString commandLine(const QString& output) const;

  Q_SIGNALS:
    void surveyChanged();
    void productsChanged();
    void settingChanged(const QString& key);
    void exported(const QString& folder);
    void told(terrawalk::gui::MessageKind kind, const QString& text);

  private:
    friend class SettingCommand;
    void put(const QString& key, const QString& text);
    void fail(const Error& error);
    [[nodiscard]] const RunSettings& shownSettings() const;

    BackgroundJob job_;
    QUndoStack undo_;
    std::filesystem::path path_;
    RunSettings settings_;
    RunSettings processed_with_;
    std::shared_ptr<const Survey> survey_;
    std::shared_ptr<const Products> products_;
    std::shared_ptr<const SurveyMap> map_;
};

}  // namespace terrawalk::gui
