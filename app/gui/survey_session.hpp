#pragma once

#include <QDateTime>
#include <QObject>
#include <QString>
#include <QStringList>
#include <QTimer>
#include <QUndoStack>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "app/gui/background_job.hpp"
#include "app/gui/kept_surfaces.hpp"
#include "app/gui/run_settings.hpp"
#include "app/gui/selection.hpp"
#include "app/gui/view_state.hpp"
#include "app/pipeline/export_job.hpp"
#include "app/pipeline/process.hpp"
#include "app/pipeline/run_history.hpp"
#include "app/pipeline/survey_map.hpp"
#include "app/pipeline/tune.hpp"
#include "app/pipeline/tune_trace.hpp"
#include "survey/result.hpp"
#include "survey/survey.hpp"

namespace terrawalk::gui {

enum class MessageKind { Info, Done, Warning, Error };

/// What is kept of a finished run beyond the end of the program.
struct RunSummary {
    QDateTime when;
    QString program;  ///< name and version
    RunSettings settings;
    RunFigures figures;
};

/// A finished run of the pipeline, kept so that a person can compare and go back.
struct FinishedRun {
    QDateTime when;
    RunSettings settings;
    std::shared_ptr<const Survey> survey;  ///< with the edits made
    std::shared_ptr<const Products> products;
    std::shared_ptr<const SurveyMap> map;
    std::optional<RunSummary> before =
        std::nullopt;  ///< what was shown when it was made, or the last run before
};

/// What is open: a survey, its settings, and the last results. Knows no widgets; all work runs in its job.
/// Values that it hands out are never changed afterwards.
class SurveySession : public QObject {
    Q_OBJECT
  public:
    explicit SurveySession(QObject* parent = nullptr);

    /// Writes changes that are not saved where open() finds them, at once. It happens by itself a moment
    /// after each change.
    void keepChanges();

    /// Reads the survey of a project file, or of the survey.json in a folder, with the settings that were
    /// saved beside it; what was open stays open where that fails. Changes that were not saved when the
    /// program ended come back, undoably.
    void open(const std::filesystem::path& project_file_or_folder, bool then_process = false);
    void process();
    /// Tunes the method on the survey's marks and takes the values over where they hold out better; undoable.
    /// @param options  but for the seed, which is that of the settings
    /// @param repeats  searches with seeds one after the other, of which the best is taken
    void tune(const TuneOptions& options = {}, std::size_t repeats = 1);
    /// The searches of this survey, and of files that were opened.
    [[nodiscard]] std::shared_ptr<const TuningData> tuning() const { return tuning_; }
    /// Adds the search of a tuned file, or shows the table of an experiment.
    void openSearches(const std::filesystem::path& file);
    /// Writes the results that are shown, just as the command line would.
    /// @param further  formats for a folder beside it, if any
    void exportTo(const std::filesystem::path& folder, const ExportRequest& further = {});
    void cancel() { job_.cancel(); }

    /// Sets one setting, undoably. Refused values become a message, and the setting stays.
    bool changeSetting(const QString& key, const QString& text);
    /// All of them back to their defaults, undoably; edits stay.
    void resetSettings();
    /// @param what  for the undo menu, e.g. "exclude a stretch"
    void changeEdits(const SurveyEdits& edits, const QString& what);
    void changeSettings(const RunSettings& settings, const QString& what);
    [[nodiscard]] SurveyEdits edits() const { return settings_.config().edits; }
    /// Reads a configuration file of `terrawalk`, undoably.
    void loadSettings(const std::filesystem::path& file);
    /// Writes the settings beside the survey, for this program and for `terrawalk process --config`.
    bool save();
    /// The same into any other file; what counts as saved stays.
    bool saveSettingsAs(const std::filesystem::path& file);
    [[nodiscard]] bool modified() const { return survey_ && !(settings_ == saved_); }
    [[nodiscard]] std::filesystem::path settingsFile() const;

    [[nodiscard]] bool busy() const { return job_.running(); }
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }
    /// As in its files, without edits.
    [[nodiscard]] std::shared_ptr<const Survey> survey() const { return survey_; }
    /// As the shown results were made from, with its edits.
    [[nodiscard]] std::shared_ptr<const Survey> shownSurvey() const;
    [[nodiscard]] std::shared_ptr<const Products> products() const;
    [[nodiscard]] std::shared_ptr<const SurveyMap> map() const;
    [[nodiscard]] const RunSettings& settings() const { return settings_; }
    /// Whether the results come from other settings than those that stand now.
    [[nodiscard]] bool outdated() const;
    [[nodiscard]] BackgroundJob& job() { return job_; }
    [[nodiscard]] QUndoStack& undoStack() { return undo_; }
    [[nodiscard]] Selection& selection() { return selection_; }
    [[nodiscard]] ViewState& viewState() { return view_state_; }

    /// Takes the shown results and an earlier run, or any DEM, apart: their difference becomes a layer. What
    /// was compared goes when other results are shown.
    void compareWith(std::size_t run);
    void compareWith(const std::filesystem::path& dem);
    void compareWithNothing() { view_state_.setChange(nullptr); }

    /// The last runs, the oldest first; the shown one is among them.
    [[nodiscard]] const std::vector<FinishedRun>& history() const { return history_; }
    [[nodiscard]] std::size_t shownRun() const { return shown_; }
    /// Shows the results of an earlier run, and takes its settings over, undoably.
    void goBackTo(std::size_t run);

    /// The last runs of this survey, the oldest first, those of earlier days among them; kept beside the
    /// survey where that can be written, and is no sample, and with the program's own data elsewhere.
    [[nodiscard]] const std::vector<RunSummary>& runs() const { return runs_; }
    [[nodiscard]] std::filesystem::path runsFile() const;
    /// Which of the history has the results of one of runs(), if they are still there.
    [[nodiscard]] std::optional<std::size_t> resultsOf(std::size_t run) const;
    /// Takes over the settings of one of runs(), undoably, and shows its results where they are still there.
    void goBackToRun(std::size_t run);
    /// The same, and processes where they are not.
    void showRunAgain(std::size_t run);
    /// Surfaces of runs() on disk, beside the file that lists them.
    [[nodiscard]] KeptSurfaces keptSurfaces() const;
    /// Keeps the surfaces of runs whose results are here, and of those to come; or of no more.
    void keepSurfaces(bool keep);
    void removeKeptSurfaces();
    /// Compares the shown results with one of runs(), whose results are here or whose surface is kept.
    void compareWithRun(std::size_t run);
    [[nodiscard]] bool canCompareWith(std::size_t run) const;

    /// Arguments of the command that makes the results that are shown, or would be made now.
    [[nodiscard]] QStringList commandArguments() const;
    /// The same for a shell, with the folder for the output.
    [[nodiscard]] QString commandLine(const QString& output) const;

  Q_SIGNALS:
    void surveyChanged();
    void productsChanged();
    void settingChanged(const QString& key);
    /// Once after any number of settings.
    void settingsChanged();
    void savedChanged();
    void tuningChanged();
    void exported(const QString& folder);
    void told(terrawalk::gui::MessageKind kind, const QString& text);

  private:
    friend class SettingsCommand;
    void put(const RunSettings& settings);
    bool writeSettings(const std::filesystem::path& file);
    void addTraces(const std::vector<TuneTrace>& traces);
    [[nodiscard]] const TuneTrace* traceInUse() const;
    /// @param name  of the DEM in words; empty: its file's
    void compareWith(const std::filesystem::path& dem, const QString& name);
    void takeChange(Result<HeightChange> change);
    void fail(const Error& error);
    void finishOpening(const std::filesystem::path& path, Survey survey, SurveyMap map);
    void finishRun(FinishedRun run);
    void readSaved();
    void readRuns();
    void keepRun(const FinishedRun& run);
    void recover();
    void autosave();
    [[nodiscard]] std::filesystem::path autosaveFile() const;
    /// Of the program's own data on this survey.
    [[nodiscard]] std::filesystem::path ownFile(const QString& kind) const;
    [[nodiscard]] const RunSettings& shownSettings() const;

    BackgroundJob job_;
    QUndoStack undo_;
    Selection selection_;
    ViewState view_state_;
    QTimer autosave_;
    std::filesystem::path path_;
    RunSettings settings_;
    RunSettings saved_;
    ReportLanguage saved_language_ = ReportLanguage::English;  ///< in the file of what is saved
    std::shared_ptr<const Survey> survey_;
    std::shared_ptr<const SurveyMap> logged_map_;
    std::shared_ptr<const TuningData> tuning_ = std::make_shared<const TuningData>();
    std::vector<FinishedRun> history_;
    std::vector<RunSummary> runs_;
    std::size_t shown_ = 0;
};

/// The time of a run: the hour today, the date as well on other days.
[[nodiscard]] QString timeOfRun(const QDateTime& when);
/// A word as a shell takes it, in quotes where it must be.
[[nodiscard]] QString shellWord(const QString& word);

}  // namespace terrawalk::gui
