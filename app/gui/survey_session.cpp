#include "app/gui/survey_session.hpp"

#include <QCryptographicHash>
#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QSaveFile>
#include <QStandardPaths>
#include <QUndoCommand>
#include <utility>

#include "app/gui/accuracy_words.hpp"
#include "app/gui/figures.hpp"
#include "app/gui/language.hpp"
#include "app/gui/report_words.hpp"
#include "app/gui/sample_surveys.hpp"
#include "app/gui/setting_editor.hpp"
#include "app/pipeline/jobs.hpp"
#include "app/pipeline/tune_jobs.hpp"
#include "app/pipeline/version.hpp"

namespace terrawalk::gui {

namespace fs = std::filesystem;

/// All settings, there and back.
class SettingsCommand final : public QUndoCommand {
  public:
    SettingsCommand(SurveySession& session, const QString& what, RunSettings before, RunSettings after)
        : QUndoCommand(what), session_(session), before_(std::move(before)), after_(std::move(after)) {}
    void undo() override { session_.put(before_); }
    void redo() override { session_.put(after_); }

  private:
    SurveySession& session_;
    RunSettings before_, after_;
};

namespace {

/// Older runs go: each holds a surface.
constexpr std::size_t kKeptRuns = 4;
constexpr int kAutosaveDelay_ms = 800;

QString text(const std::string& utf8) {
    return QString::fromStdString(utf8);
}

/// Whole or not at all.
bool writeWhole(const fs::path& path, const std::string& content, QString& problem) {
    QSaveFile file(text(path.string()));
    if (file.open(QIODevice::WriteOnly) &&
        file.write(content.data(), static_cast<qint64>(content.size())) >= 0 && file.commit()) {
        return true;
    }
    problem = file.errorString();
    return false;
}

}  // namespace

QString shellWord(const QString& word) {
    for (const QChar c : word) {
        const bool plain = c.isLetterOrNumber() || QStringLiteral("-_./=:+,@").contains(c);
        if (plain) continue;
        QString quoted = word;
        return "'" + quoted.replace("'", "'\\''") + "'";
    }
    return word.isEmpty() ? QStringLiteral("''") : word;
}

QString timeOfRun(const QDateTime& when) {
    const bool today = when.date() == QDate::currentDate();
    return when.toString(today ? "HH:mm:ss" : "yyyy-MM-dd HH:mm");
}

SurveySession::SurveySession(QObject* parent) : QObject(parent), job_(this) {
    connect(&job_, &BackgroundJob::told, this, [this](Severity severity, const QString& line) {
        Q_EMIT told(severity == Severity::Warning ? MessageKind::Warning : MessageKind::Info, line);
    });
    autosave_.setSingleShot(true);
    autosave_.setInterval(kAutosaveDelay_ms);
    connect(&autosave_, &QTimer::timeout, this, &SurveySession::autosave);
}

void SurveySession::fail(const Error& error) {
    if (error.kind == ErrorKind::Cancelled) {
        Q_EMIT told(MessageKind::Info, tr("Cancelled; what was there before is still there."));
    } else {
        Q_EMIT told(MessageKind::Error, errorWords(error));
    }
}

void SurveySession::open(const fs::path& path, bool then_process) {
    job_.start([this, path, then_process](Progress& progress, const std::stop_token& stop) {
        auto opened = openSurvey(path, progress, stop);
        Result<SurveyMap> map = opened ? loggedMap(*opened, stop) : tl::unexpected(opened.error());
        return [this, path, then_process, opened = std::move(opened), map = std::move(map)]() mutable {
            if (!map) return fail(map.error());
            finishOpening(path, std::move(*opened), std::move(*map));
            if (then_process) process();
        };
    });
}

void SurveySession::finishOpening(const fs::path& path, Survey survey, SurveyMap map) {
    keepChanges();
    path_ = path;
    survey_ = std::make_shared<const Survey>(std::move(survey));
    logged_map_ = std::make_shared<const SurveyMap>(std::move(map));
    history_.clear();
    view_state_.setChange(nullptr);
    tuning_ = std::make_shared<const TuningData>();
    undo_.clear();
    selection_.clear();
    settings_ = RunSettings();
    readSaved();
    readRuns();
    Q_EMIT surveyChanged();
    Q_EMIT productsChanged();
    Q_EMIT settingsChanged();
    Q_EMIT tuningChanged();
    Q_EMIT told(MessageKind::Done, tr("Opened %1.").arg(text(survey_->name)));
    for (const std::string& note : survey_->notes) Q_EMIT told(MessageKind::Info, reportWords(note));
    recover();
    Q_EMIT savedChanged();
}

void SurveySession::process() {
    if (!survey_) return;
    job_.start([this, survey = survey_, settings = settings_, kept = keptSurfaces()](
                   Progress& progress, const std::stop_token& stop) {
        const PipelineConfig config = settings.config();
        auto edited = withEdits(*survey, config.edits);
        Result<Products> made =
            edited ? terrawalk::process(*edited, config, progress, stop) : tl::unexpected(edited.error());
        Result<SurveyMap> map = made ? fusedMap(*edited, *made, stop) : tl::unexpected(made.error());
        const QDateTime when = QDateTime::currentDateTime();
        const auto written =
            map && kept.wanted() ? writeSurface(*edited, *made, kept.file(when), stop) : Result<void>();
        return [this, when, settings, written, edited = std::move(edited), made = std::move(made),
                map = std::move(map)]() mutable {
            if (!map) return fail(map.error());
            if (!written) Q_EMIT told(MessageKind::Warning, errorWords(written.error()));
            finishRun({when, settings, std::make_shared<const Survey>(std::move(*edited)),
                       std::make_shared<const Products>(std::move(*made)),
                       std::make_shared<const SurveyMap>(std::move(*map))});
        };
    });
}

void SurveySession::finishRun(FinishedRun run) {
    if (!history_.empty()) {
        const FinishedRun& shown = history_[shown_];
        run.before = RunSummary{shown.when, {}, shown.settings, runFigures(shown.products->report)};
    } else if (!runs_.empty()) {
        run.before = runs_.back();
    }
    const QString before = run.before ? figureBefore(run.before->figures) : QString();
    keepRun(run);
    if (history_.size() == kKeptRuns) history_.erase(history_.begin());
    history_.push_back(std::move(run));
    shown_ = history_.size() - 1;
    view_state_.setChange(nullptr);
    Q_EMIT productsChanged();
    const SurveyReport& report = products()->report;
    for (const std::string& line : report.warnings) Q_EMIT told(MessageKind::Warning, reportWords(line));
    const QString figure = report.figures.empty()
                               ? QString()
                               : tr("%1: %2.").arg(reportWords(report.figures.front().label),
                                                   text(report.figures.front().value));
    Q_EMIT told(MessageKind::Done, joinSentences({tr("Processed."), figure, before}));
}

void SurveySession::tune(const TuneOptions& options, std::size_t repeats) {
    if (!survey_) return;
    job_.start([this, survey = survey_, config = settings_.config(), options, repeats](
                   Progress& progress, const std::stop_token& stop) {
        auto edited = withEdits(*survey, config.edits);
        std::vector<TuneTrace> traces;
        Result<TunedConfig> best = tl::unexpected(edited ? Error() : edited.error());
        for (std::size_t r = 0; edited && r < repeats; ++r) {
            const auto n = static_cast<double>(repeats), done = static_cast<double>(r);
            PartialProgress part(progress, done / n, (done + 1.0) / n);
            TuneOptions search = options;
            search.seed = config.seed + r;
            auto tuned = tunedWithTrace(*edited, config, search, part, stop);
            if (tuned) traces.push_back(tuned->trace);
            if (!tuned || !best || tuned->loss < best->loss) best = std::move(tuned);
            if (!best) break;
        }
        return [this, best = std::move(best), traces = std::move(traces)] {
            addTraces(traces);
            if (!best) return fail(best.error());
            changeSettings(RunSettings(best->config), tr("tune"));
            if (best->config.tuning)
                Q_EMIT told(MessageKind::Done, reportWords(best->config.tuning->decision));
        };
    });
}

void SurveySession::addTraces(const std::vector<TuneTrace>& traces) {
    if (traces.empty()) return;
    TuningData all = *tuning_;
    all.traces.insert(all.traces.end(), traces.begin(), traces.end());
    tuning_ = std::make_shared<const TuningData>(std::move(all));
    Q_EMIT tuningChanged();
}

const TuneTrace* SurveySession::traceInUse() const {
    const auto record = settings_.config().tuning;
    if (!record) return nullptr;
    for (auto trace = tuning_->traces.rbegin(); trace != tuning_->traces.rend(); ++trace) {
        if (trace->optimiser == record->optimiser && trace->seed == record->seed &&
            trace->loss == record->loss)
            return &*trace;
    }
    return nullptr;
}

void SurveySession::openSearches(const fs::path& file) {
    if (QFileInfo(text(file.string())).suffix().compare("csv", Qt::CaseInsensitive) == 0) {
        auto table = readOptimiserTable(file);
        if (!table) return fail(table.error());
        TuningData all = *tuning_;
        all.table = std::move(*table);
        tuning_ = std::make_shared<const TuningData>(std::move(all));
        return Q_EMIT tuningChanged();
    }
    const auto trace = readTuneTrace(file);
    if (!trace) return fail(trace.error());
    addTraces({*trace});
}

void SurveySession::compareWith(std::size_t run) {
    if (run >= history_.size() || run == shown_) return;
    const FinishedRun& earlier = history_[run];
    const std::string name = tr("the run of %1").arg(timeOfRun(earlier.when)).toStdString();
    job_.start([this, later = products(), earlier = earlier.products, name](Progress& progress,
                                                                            const std::stop_token& stop) {
        progress.report(0.0, "comparing");
        return [this, change = changeSince(*later, *earlier, name, stop)]() mutable {
            takeChange(std::move(change));
        };
    });
}

void SurveySession::compareWith(const fs::path& dem) {
    compareWith(dem, {});
}

void SurveySession::compareWith(const fs::path& dem, const QString& name) {
    if (history_.empty()) return;
    job_.start([this, later = products(), dem, name](Progress& progress, const std::stop_token& stop) {
        progress.report(0.0, "comparing");
        auto change = changeSince(*later, dem, stop);
        if (change && !name.isEmpty()) change->earlier = name.toStdString();
        return [this, change = std::move(change)]() mutable {
            takeChange(std::move(change));
        };
    });
}

void SurveySession::compareWithRun(std::size_t run) {
    if (!canCompareWith(run)) return;
    if (const auto results = resultsOf(run)) return compareWith(*results);
    const QDateTime when = runs_[run].when;
    compareWith(keptSurfaces().file(when), tr("the run of %1").arg(timeOfRun(when)));
}

bool SurveySession::canCompareWith(std::size_t run) const {
    if (run >= runs_.size() || history_.empty()) return false;
    const auto results = resultsOf(run);
    return results ? *results != shown_ : keptSurfaces().has(runs_[run].when);
}

KeptSurfaces SurveySession::keptSurfaces() const {
    return KeptSurfaces(runsFile().replace_extension());
}

void SurveySession::keepSurfaces(bool keep) {
    const KeptSurfaces kept = keptSurfaces();
    if (!(keep ? kept.start() : kept.pause())) {
        Q_EMIT told(MessageKind::Error, tr("%1: cannot be written; check that you may write there")
                                            .arg(text(kept.file(QDateTime()).parent_path().string())));
        return;
    }
    if (!keep) return;
    job_.start([this, kept, runs = history_](Progress& progress, const std::stop_token& stop) {
        progress.report(0.0, "writing");
        Result<void> written;
        for (const FinishedRun& run : runs) {
            if (written && !kept.has(run.when))
                written = writeSurface(*run.survey, *run.products, kept.file(run.when), stop);
        }
        return [this, written] {
            if (!written) fail(written.error());
        };
    });
}

void SurveySession::removeKeptSurfaces() {
    if (busy()) return;
    keptSurfaces().removeAll();
    Q_EMIT told(MessageKind::Done, tr("The kept surfaces are removed from disk."));
}

void SurveySession::takeChange(Result<HeightChange> change) {
    if (!change) return fail(change.error());
    const HeightChange& c = *change;
    const auto cells = static_cast<double>(c.difference.all.cells);
    QString words = tr("Less %1: median %2, RMS %3.")
                        .arg(text(c.earlier), signedLength(c.median_m), lengthText(c.rms_m, 3));
    if (c.has_sigma) {
        const auto sure = static_cast<double>(c.difference.raised + c.difference.lowered);
        words = joinSentences(
            {words,
             tr("%1 % of the cells beyond 1.96 σ.").arg(QString::number(100.0 * sure / cells, 'f', 1))});
    }
    view_state_.setChange(std::make_shared<const HeightChange>(std::move(*change)));
    Q_EMIT told(MessageKind::Done, words);
}

void SurveySession::exportTo(const fs::path& folder, const ExportRequest& further) {
    if (history_.empty()) return;
    Provenance provenance;
    provenance.language = reportLanguage();
    for (const QString& argument : commandArguments()) provenance.command.push_back(argument.toStdString());
    job_.start([this, run = history_[shown_], provenance, folder, further](Progress& progress,
                                                                           const std::stop_token& stop) {
        const bool more = !further.points.empty() || !further.meshes.empty() || !further.grids.empty();
        PartialProgress saving(progress, 0.0, more ? 0.6 : 1.0), exporting(progress, 0.6, 1.0);
        auto saved = saveProducts(*run.survey, *run.products, provenance, folder, saving, stop);
        if (saved && more) {
            ExportRequest request = further;
            request.input = folder;
            const auto outcome = exportResults(request, exporting, stop);
            if (!outcome) saved = tl::unexpected(outcome.error());
        }
        return [this, folder, saved = std::move(saved)] {
            if (!saved) return fail(saved.error());
            Q_EMIT told(MessageKind::Done, tr("Exported to %1.").arg(text(folder.string())));
            Q_EMIT exported(text(folder.string()));
        };
    });
}

bool SurveySession::changeSetting(const QString& key, const QString& value) {
    const std::string name = key.toStdString();
    if (settings_.text(name) == value.toStdString()) return true;
    RunSettings changed = settings_;
    if (const auto done = changed.set(name, value.toStdString()); !done) {
        fail(done.error());
        return false;
    }
    changeSettings(changed, tr("%1 = %2").arg(settingLabel(key), settingValueWords(key, value)));
    return true;
}

void SurveySession::resetSettings() {
    RunSettings defaults;
    defaults.setEdits(edits());
    changeSettings(defaults, tr("all settings back to their defaults"));
}

void SurveySession::changeEdits(const SurveyEdits& edits, const QString& what) {
    RunSettings changed = settings_;
    changed.setEdits(edits);
    changeSettings(changed, what);
}

void SurveySession::changeSettings(const RunSettings& settings, const QString& what) {
    if (settings == settings_) return;
    undo_.push(new SettingsCommand(*this, what, settings_, settings));
}

void SurveySession::put(const RunSettings& settings) {
    const std::vector<std::string> changed = settings_.differences(settings);
    settings_ = settings;
    for (const std::string& key : changed) Q_EMIT settingChanged(text(key));
    Q_EMIT settingsChanged();
    Q_EMIT savedChanged();
    autosave_.start();
}

void SurveySession::loadSettings(const fs::path& file) {
    PipelineConfig config;
    if (const auto read = applyConfigFile(config, file); !read) return fail(read.error());
    changeSettings(RunSettings(config), tr("load settings"));
    if (config.tuning) {
        if (const auto trace = readTuneTrace(file)) addTraces({*trace});
    }
    Q_EMIT told(MessageKind::Done, tr("Settings read from %1.").arg(text(file.string())));
}

fs::path SurveySession::settingsFile() const {
    if (!survey_) return {};
    fs::path file = survey_->project_file;
    return file.replace_extension(".settings.json");
}

bool SurveySession::writeSettings(const fs::path& file) {
    QString problem;
    PipelineConfig config = settings_.config();
    config.report.language = reportLanguage();
    std::string content = toJson(config);
    if (const TuneTrace* trace = traceInUse()) content = withTrace(content, *trace);
    if (writeWhole(file, content, problem)) return true;
    Q_EMIT told(
        MessageKind::Error,
        tr("%1: cannot be written (%2); check that you may write there").arg(text(file.string()), problem));
    return false;
}

bool SurveySession::saveSettingsAs(const fs::path& file) {
    if (!survey_ || !writeSettings(file)) return false;
    Q_EMIT told(MessageKind::Done, tr("Saved to %1.").arg(text(file.string())));
    return true;
}

bool SurveySession::save() {
    if (!survey_ || !writeSettings(settingsFile())) return false;
    saved_ = settings_;
    saved_language_ = reportLanguage();
    autosave_.stop();
    QFile::remove(text(autosaveFile().string()));
    Q_EMIT savedChanged();
    Q_EMIT told(MessageKind::Done, tr("Saved to %1.").arg(text(settingsFile().string())));
    return true;
}

void SurveySession::readSaved() {
    saved_ = RunSettings();
    saved_language_ = ReportLanguage::English;
    std::error_code error;
    if (!fs::exists(settingsFile(), error)) return;
    PipelineConfig config;
    if (const auto read = applyConfigFile(config, settingsFile()); !read) {
        fail(read.error());
        Q_EMIT told(MessageKind::Warning,
                    tr("The saved settings cannot be read: the defaults stand instead."));
        return;
    }
    saved_ = RunSettings(config);
    saved_language_ = config.report.language;
    settings_ = saved_;
    if (!config.tuning) return;
    if (const auto trace = readTuneTrace(settingsFile())) addTraces({*trace});
}

void SurveySession::readRuns() {
    runs_.clear();
    const auto read = readRunHistory(runsFile());
    if (!read) return fail(read.error());
    if (read->left_out > 0) {
        Q_EMIT told(MessageKind::Warning,
                    tr("%n earlier run(s) cannot be read by this version and are left out.", nullptr,
                       static_cast<int>(read->left_out)));
    }
    for (const PastRun& run : read->runs) {
        const QDateTime when = QDateTime::fromString(text(run.finished), Qt::ISODateWithMs);
        if (when.isValid())
            runs_.push_back({when.toLocalTime(), text(run.program), RunSettings(run.config), run.figures});
    }
}

void SurveySession::keepRun(const FinishedRun& run) {
    runs_.push_back({run.when, text(programVersion()), run.settings, runFigures(run.products->report)});
    if (runs_.size() > kPastRuns) runs_.erase(runs_.begin());
    std::vector<QDateTime> times;
    for (const RunSummary& one : runs_) times.push_back(one.when);
    keptSurfaces().keepOnly(times);
    std::vector<PastRun> kept;
    for (const RunSummary& one : runs_) {
        kept.push_back({one.when.toUTC().toString(Qt::ISODateWithMs).toStdString(), one.program.toStdString(),
                        one.settings.config(), one.figures});
    }
    QDir().mkpath(text(runsFile().parent_path().string()));
    if (const auto written = writeRunHistory(kept, runsFile()); !written)
        Q_EMIT told(MessageKind::Warning, errorWords(written.error()));
}

fs::path SurveySession::runsFile() const {
    fs::path beside = survey_->project_file;
    beside.replace_extension(".runs.json");
    const bool writable = QFileInfo(text(beside.parent_path().string())).isWritable();
    return writable && !isSample(survey_->project_file) ? beside : ownFile("runs");
}

std::optional<std::size_t> SurveySession::resultsOf(std::size_t run) const {
    for (std::size_t i = 0; i < history_.size(); ++i) {
        if (history_[i].when == runs_[run].when) return i;
    }
    return std::nullopt;
}

void SurveySession::goBackToRun(std::size_t run) {
    if (run >= runs_.size()) return;
    if (const auto results = resultsOf(run)) return goBackTo(*results);
    changeSettings(runs_[run].settings, tr("go back to an earlier run"));
    Q_EMIT told(MessageKind::Info,
                tr("The settings of the run of %1 are back: process again to see its results.")
                    .arg(timeOfRun(runs_[run].when)));
}

void SurveySession::showRunAgain(std::size_t run) {
    if (run >= runs_.size()) return;
    if (const auto results = resultsOf(run)) return goBackTo(*results);
    changeSettings(runs_[run].settings, tr("go back to an earlier run"));
    process();
}

fs::path SurveySession::autosaveFile() const {
    return ownFile("autosave");
}

fs::path SurveySession::ownFile(const QString& kind) const {
    const QString folder =
        QStandardPaths::writableLocation(QStandardPaths::AppLocalDataLocation) + "/" + kind;
    const QString project = QFileInfo(text(survey_->project_file.string())).canonicalFilePath();
    const QByteArray name =
        QCryptographicHash::hash(project.toUtf8(), QCryptographicHash::Sha256).toHex().left(24);
    return (folder + "/" + QString::fromLatin1(name) + ".json").toStdString();
}

void SurveySession::keepChanges() {
    if (autosave_.isActive()) autosave();
}

void SurveySession::autosave() {
    if (!survey_) return;
    autosave_.stop();
    const fs::path file = autosaveFile();
    if (settings_ == saved_) {
        QFile::remove(text(file.string()));
        return;
    }
    QDir().mkpath(text(file.parent_path().string()));
    QString problem;
    if (!writeWhole(file, toJson(settings_.config()), problem)) {
        Q_EMIT told(MessageKind::Warning, tr("Changes cannot be kept against a crash: %1").arg(problem));
    }
}

void SurveySession::recover() {
    const fs::path file = autosaveFile();
    std::error_code error;
    if (!fs::exists(file, error)) return;
    PipelineConfig config;
    if (!applyConfigFile(config, file)) {
        QFile::remove(text(file.string()));
        return;
    }
    changeSettings(RunSettings(config), tr("unsaved changes"));
    Q_EMIT told(MessageKind::Warning, tr("Unsaved changes of the last time are back; undo takes them away."));
}

std::shared_ptr<const Products> SurveySession::products() const {
    return history_.empty() ? nullptr : history_[shown_].products;
}

std::shared_ptr<const Survey> SurveySession::shownSurvey() const {
    return history_.empty() ? survey_ : history_[shown_].survey;
}

std::shared_ptr<const SurveyMap> SurveySession::map() const {
    return history_.empty() ? logged_map_ : history_[shown_].map;
}

bool SurveySession::outdated() const {
    return !history_.empty() && !(settings_ == history_[shown_].settings);
}

void SurveySession::goBackTo(std::size_t run) {
    if (run >= history_.size()) return;
    shown_ = run;
    view_state_.setChange(nullptr);
    changeSettings(history_[run].settings, tr("go back to an earlier run"));
    Q_EMIT productsChanged();
}

const RunSettings& SurveySession::shownSettings() const {
    return history_.empty() ? settings_ : history_[shown_].settings;
}

QStringList SurveySession::commandArguments() const {
    QStringList arguments{"terrawalk", "process", text(path_.string())};
    const RunSettings& settings = shownSettings();
    const bool changed = !settings.assignments().empty() || settings.tuned();
    // A file says it shorter, and alone can say how values were tuned.
    const bool by_file = changed && settings == saved_;
    if (by_file) {
        arguments << "--config" << text(settingsFile().string());
    } else {
        for (const std::string& assignment : settings.assignments()) arguments << "--set" << text(assignment);
    }
    const ReportLanguage language = reportLanguage();
    if (language != (by_file ? saved_language_ : ReportLanguage::English))
        arguments << "--set"
                  << (language == ReportLanguage::Chinese ? "report.language=zh" : "report.language=en");
    return arguments;
}

QString SurveySession::commandLine(const QString& output) const {
    QStringList arguments = commandArguments();
    arguments << "-o" << output;
    QStringList words;
    for (const QString& argument : arguments) words << shellWord(argument);
    return words.join(' ');
}

}  // namespace terrawalk::gui
