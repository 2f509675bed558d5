#include "app/gui/survey_session.hpp"

#include <QUndoCommand>
#include <utility>

#include "app/pipeline/jobs.hpp"

namespace terrawalk::gui {

namespace fs = std::filesystem;

/// One setting, there and back.
class SettingCommand final : public QUndoCommand {
  public:
    SettingCommand(SurveySession& session, QString key, QString before, QString after)
        : QUndoCommand(key),
          session_(session),
          key_(std::move(key)),
          before_(std::move(before)),
          after_(std::move(after)) {}
    void undo() override { session_.put(key_, before_); }
    void redo() override { session_.put(key_, after_); }

  private:
    SurveySession& session_;
    QString key_, before_, after_;
};

namespace {

QString shellWord(const QString& word) {
    for (const QChar c : word) {
        const bool plain = c.isLetterOrNumber() || QStringLiteral("-_./=:+,@").contains(c);
        if (plain) continue;
        QString quoted = word;
        return "'" + quoted.replace("'", "'\\''") + "'";
    }
    return word.isEmpty() ? QStringLiteral("''") : word;
}

QString text(const std::string& utf8) {
    return QString::fromStdString(utf8);
}

}  // namespace

SurveySession::SurveySession(QObject* parent) : QObject(parent), job_(this) {
    connect(&job_, &BackgroundJob::told, this, [this](Severity severity, const QString& line) {
        Q_EMIT told(severity == Severity::Warning ? MessageKind::Warning : MessageKind::Info, line);
    });
}

void SurveySession::fail(const Error& error) {
    if (error.kind == ErrorKind::Cancelled) {
        Q_EMIT told(MessageKind::Info, tr("Cancelled."));
    } else {
        Q_EMIT told(MessageKind::Error, text(error.text()));
    }
}

void SurveySession::open(const fs::path& path, bool then_process) {
    job_.start([this, path, then_process](Progress& progress, const std::stop_token& stop) {
        auto opened = openSurvey(path, progress, stop);
        Result<SurveyMap> map = opened ? loggedMap(*opened, stop) : tl::unexpected(opened.error());
        return [this, path, then_process, opened = std::move(opened), map = std::move(map)]() mutable {
            if (!map) return fail(map.error());
            path_ = path;
            survey_ = std::make_shared<const Survey>(std::move(*opened));
            map_ = std::make_shared<const SurveyMap>(std::move(*map));
            products_.reset();
            Q_EMIT surveyChanged();
            Q_EMIT productsChanged();
            Q_EMIT told(MessageKind::Done, tr("Opened %1.").arg(text(survey_->name)));
            for (const std::string& note : survey_->notes) Q_EMIT told(MessageKind::Info, text(note));
            if (then_process) process();
        };
    });
}

void SurveySession::process() {
    if (!survey_) return;
    job_.start(
        [this, survey = survey_, settings = settings_](Progress& progress, const std::stop_token& stop) {
            auto made = terrawalk::process(*survey, settings.config(), progress, stop);
            Result<SurveyMap> map = made ? fusedMap(*survey, *made, stop) : tl::unexpected(made.error());
            return [this, settings, made = std::move(made), map = std::move(map)]() mutable {
                if (!map) return fail(map.error());
                products_ = std::make_shared<const Products>(std::move(*made));
                map_ = std::make_shared<const SurveyMap>(std::move(*map));
                processed_with_ = settings;
                Q_EMIT productsChanged();
                for (const std::string& line : products_->report.warnings) {
                    Q_EMIT told(MessageKind::Warning, text(line));
                }
                const SurveyReport& report = products_->report;
                const QString figure = report.figures.empty() ? QString()
                                                              : tr(" %1: %2.")
                                                                    .arg(text(report.figures.front().label),
                                                                         text(report.figures.front().value));
                Q_EMIT told(MessageKind::Done, tr("Processed.") + figure);
            };
        });
}

void SurveySession::exportTo(const fs::path& folder) {
    if (!products_) return;
    Provenance provenance;
    for (const QString& argument : commandArguments()) provenance.command.push_back(argument.toStdString());
    job_.start([this, survey = survey_, products = products_, provenance, folder](
                   Progress& progress, const std::stop_token& stop) {
        auto saved = saveProducts(*survey, *products, provenance, folder, progress, stop);
        return [this, folder, saved = std::move(saved)] {
            if (!saved) return fail(saved.error());
            Q_EMIT exported(text(folder.string()));
            Q_EMIT told(MessageKind::Done, tr("Exported to %1.").arg(text(folder.string())));
        };
    });
}

bool SurveySession::changeSetting(const QString& key, const QString& value) {
    const std::string before = settings_.text(key.toStdString());
    if (before == value.toStdString()) return true;
    RunSettings trial = settings_;
    if (const auto done = trial.set(key.toStdString(), value.toStdString()); !done) {
        fail(done.error());
        return false;
    }
    undo_.push(new SettingCommand(*this, key, text(before), value));
    return true;
}

void SurveySession::put(const QString& key, const QString& value) {
    // Only values that were tried come here.
    if (settings_.set(key.toStdString(), value.toStdString())) Q_EMIT settingChanged(key);
}

const RunSettings& SurveySession::shownSettings() const {
    return products_ ? processed_with_ : settings_;
}

QStringList SurveySession::commandArguments() const {
    QStringList arguments{"terrawalk", "process", text(path_.string())};
    for (const std::string& assignment : shownSettings().assignments()) {
        arguments << "--set" << text(assignment);
    }
    return arguments;
}

QString SurveySession::commandLine(const QString& output) const {
    QStringList words;
    for (const QString& argument : commandArguments() << "-o" << output) words << shellWord(argument);
    return words.join(' ');
}

}  // namespace terrawalk::gui
