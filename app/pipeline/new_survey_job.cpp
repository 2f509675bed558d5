#include "app/pipeline/new_survey_job.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <system_error>

#include "io/map_projection.hpp"
#include "io/read_survey.hpp"
#include "io/survey_format.hpp"
#include "io/text_input.hpp"
#include "io/write_survey.hpp"

namespace terrawalk {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kHeadBytes = std::size_t{64} << 10U;
constexpr int kDeepestFolder = 3;
constexpr const char* kProjectName = "survey.json";

struct LooseFile {
    fs::path file;
    bool named = true;  ///< by the request itself, not found in a folder
};

/// The files of the request, folders replaced by the tables in them, in the order of their names.
std::vector<LooseFile> looseFiles(const NewSurveyRequest& request) {
    std::vector<LooseFile> files;
    for (const fs::path& path : request.files) {
        std::error_code error;
        if (!fs::is_directory(path, error)) {
            files.push_back({path, true});
            continue;
        }
        std::vector<fs::path> found;
        fs::recursive_directory_iterator it(path, fs::directory_options::skip_permission_denied, error);
        for (const fs::recursive_directory_iterator end; !error && it != end; it.increment(error)) {
            if (it.depth() >= kDeepestFolder) it.disable_recursion_pending();
            std::string ending = it->path().extension().string();
            std::transform(ending.begin(), ending.end(), ending.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
            if (ending == ".csv" && it->is_regular_file(error)) found.push_back(it->path());
        }
        std::sort(found.begin(), found.end());
        for (fs::path& file : found) files.push_back({std::move(file), false});
    }
    std::set<fs::path> met;
    std::erase_if(files, [&](const LooseFile& f) {
        std::error_code error;
        return !met.insert(fs::weakly_canonical(f.file, error)).second;
    });
    return files;
}

Result<LooseKind> kindOf(const fs::path& file) {
    auto input = ReadableFile::open(file);
    if (!input) return tl::unexpected(input.error());
    if (input->size() == 0) return badData("the file is empty", file);
    std::string head(kHeadBytes, '\0');
    const auto length = input->read(head.data(), head.size());
    if (!length) return tl::unexpected(length.error());
    head.resize(*length);
    return looseKind(head);
}

/// Sorts the files, and reads them.
class Reader {
  public:
    Reader(const NewSurveyRequest& request, SurveyDraft& draft) : request_(request), draft_(draft) {}
    Result<void> read(Progress& progress, const std::stop_token& stop) {
        draft_.marks_file = request_.marks;
        const std::vector<LooseFile> files = looseFiles(request_);
        std::vector<fs::path> logs;
        for (const LooseFile& file : files) sort(file, logs);
        readMarks();
        for (std::size_t i = 0; i < logs.size(); ++i) {
            PartialProgress part(progress, static_cast<double>(i) / static_cast<double>(logs.size()),
                                 static_cast<double>(i + 1) / static_cast<double>(logs.size()));
            const auto log = readArrayLog(logs[i], part, stop);
            if (stop.stop_requested()) return cancelled();
            if (!log) {
                draft_.bad_files.push_back(log.error());
                continue;
            }
            outlines_.push_back(outlineOf(*log));
        }
        return {};
    }
    [[nodiscard]] const std::vector<LogOutline>& outlines() const { return outlines_; }

  private:
    void sort(const LooseFile& file, std::vector<fs::path>& logs) {
        std::error_code error;
        if (!request_.marks.empty() && fs::equivalent(file.file, request_.marks, error)) return;
        const auto kind = kindOf(file.file);
        if (!kind) {
            draft_.bad_files.push_back(kind.error());
        } else if (*kind == LooseKind::Log) {
            logs.push_back(file.file);
        } else if (*kind == LooseKind::Marks && draft_.marks_file.empty()) {
            draft_.marks_file = file.file;
        } else if (!file.named) {
            draft_.notes.push_back(
                fmt::format("{} is passed over: {}", printable(file.file.string()), whyNot(*kind)));
        } else {
            draft_.bad_files.push_back(
                badData(whyNot(*kind), file.file, 0,
                        *kind == LooseKind::Marks
                            ? "name one table of marks"
                            : fmt::format("a log's header names {} and sensors, one of marks {}", kTimeColumn,
                                          fmt::join(kControlColumns, ",")))
                    .value());
        }
    }
    static std::string whyNot(LooseKind kind) {
        return kind == LooseKind::Marks        ? "it is a second table of marks"
               : kind == LooseKind::Trajectory ? "it is a trajectory, no log of the array"
                                               : "it is neither a log of the array nor a table of marks";
    }
    void readMarks() {
        if (draft_.marks_file.empty()) return;
        auto table = readControlMarks(draft_.marks_file);
        if (!table) {
            draft_.bad_files.push_back(table.error());
            draft_.marks_file.clear();
            return;
        }
        draft_.marks = std::move(table->marks);
        for (const std::string& note : table->notes) draft_.notes.push_back("marks, " + note);
    }

    const NewSurveyRequest& request_;
    SurveyDraft& draft_;
    std::vector<LogOutline> outlines_;
};

void placeZeroPoint(const NewSurveyRequest& request, const std::vector<LogOutline>& outlines,
                    SurveyDraft& draft) {
    draft.has_zero_point = true;
    if (request.zero_point) {
        draft.zero_point = *request.zero_point;
        return;
    }
    const auto guess = guessZeroPoint(outlines);
    if (!guess) {
        draft.has_zero_point = false;
        draft.notes.emplace_back("no log has positions: say where the zero point is");
        return;
    }
    draft.zero_point = guess->position;
    draft.notes.push_back(fmt::format(
        "zero point: mean GNSS position of the ground where {} of {} walks start, {:.1f} m apart at most; "
        "say where it is if you know it better",
        guess->walks, outlines.size(), guess->spread_m));
}

void makeIdsUnique(std::vector<DraftRun>& runs) {
    std::set<std::string> met;
    for (DraftRun& run : runs) {
        const std::string base = run.id.substr(0, 60);
        for (int n = 2; !met.insert(run.id).second; ++n) run.id = fmt::format("{}-{}", base, n);
    }
}

Result<void> correctRuns(const NewSurveyRequest& request, SurveyDraft& draft) {
    const auto find = [&](const std::string& id) -> Result<DraftRun*> {
        for (DraftRun& run : draft.runs) {
            if (run.id == id) return &run;
        }
        return usageError(fmt::format("there is no run {}", inQuotes(id)),
                          "runs are named as their logs are");
    };
    for (const auto& [id, mark] : request.targets) {
        const auto run = find(id);
        if (!run) return tl::unexpected(run.error());
        (*run)->kind = RunKind::FixedPoint;
        if (!(*run)->start) (*run)->start = std::string(kZeroMark);
        (*run)->target = mark;
        (*run)->reason = "as told";
    }
    for (const std::string& id : request.area_runs) {
        const auto run = find(id);
        if (!run) return tl::unexpected(run.error());
        **run = {(*run)->id, RunKind::Area, (*run)->log, {}, {}, (*run)->duration_s, "as told"};
    }
    return {};
}

fs::path outputOf(const NewSurveyRequest& request, const SurveyDraft& draft) {
    std::error_code error;
    if (!request.output.empty())
        return fs::is_directory(request.output, error) ? request.output / kProjectName : request.output;
    std::vector<fs::path> files;
    for (const DraftRun& run : draft.runs) files.push_back(run.log);
    if (!draft.marks_file.empty()) files.push_back(draft.marks_file);
    return commonFolder(files) / kProjectName;
}

std::string nameOf(const NewSurveyRequest& request, const fs::path& project_file) {
    if (!request.name.empty()) return request.name;
    std::error_code error;
    const fs::path folder = fs::weakly_canonical(fs::absolute(project_file, error).parent_path(), error);
    return folder.filename().empty() ? "survey" : folder.filename().string();
}

Result<std::string> inFolder(const fs::path& file, const fs::path& folder) {
    std::error_code error;
    const fs::path relative = fs::weakly_canonical(file, error).lexically_relative(folder);
    if (error || relative.empty() || *relative.begin() == "..") {
        return tl::unexpected(
            Error{ErrorKind::Usage, fmt::format("it lies outside the survey's folder {}", folder.string()),
                  file, 0, "write survey.json into a folder above it, or put the file beside it"});
    }
    return relative.generic_string();
}

Result<void> checkDraft(const SurveyDraft& draft) {
    if (!draft.bad_files.empty()) return tl::unexpected(draft.bad_files.front());
    if (draft.runs.empty())
        return usageError("no log was given", "name the logs of the array, or their folder");
    for (std::size_t i = 0; i < draft.runs.size(); ++i) {
        if (auto problem = problemOf(draft, i)) return tl::unexpected(std::move(*problem));
    }
    if (!draft.has_zero_point) {
        return usageError("no log has positions, so the zero point is not known",
                          "say where it is: latitude, longitude and ellipsoidal height");
    }
    const auto projection =
        MapProjection::create(LocalFrame(draft.zero_point), draft.crs, draft.vertical_datum);
    if (!projection) return tl::unexpected(projection.error());
    return {};
}

}  // namespace

Result<SurveyDraft> draftSurvey(const NewSurveyRequest& request, Progress& progress, std::stop_token stop) {
    if (request.files.empty())
        return usageError("no file was given", "name the logs of the array, or their folder");
    SurveyDraft draft;
    Reader reader(request, draft);
    if (auto done = reader.read(progress, stop); !done) return tl::unexpected(done.error());
    placeZeroPoint(request, reader.outlines(), draft);
    draft.crs = request.crs.value_or(draft.has_zero_point ? utmZone(draft.zero_point) : "");
    const LocalFrame frame(draft.zero_point);
    for (const LogOutline& outline : reader.outlines()) {
        draft.runs.push_back(guessRun(outline, draft.marks, frame));
    }
    makeIdsUnique(draft.runs);
    if (auto done = correctRuns(request, draft); !done) return tl::unexpected(done.error());
    draft.project_file = outputOf(request, draft);
    draft.name = nameOf(request, draft.project_file);
    progress.report(1.0, "done");
    return draft;
}

Result<NewSurveyOutcome> writeDraft(const SurveyDraft& draft, bool replace) {
    if (auto good = checkDraft(draft); !good) return tl::unexpected(good.error());
    std::error_code error;
    if (!replace && fs::exists(draft.project_file, error)) {
        return tl::unexpected(Error{ErrorKind::Usage, "there is a survey already", draft.project_file, 0,
                                    "name another file, or say that it may be replaced"});
    }
    const fs::path folder =
        fs::weakly_canonical(fs::absolute(draft.project_file, error).parent_path(), error);
    Survey survey;
    survey.name = draft.name;
    survey.zero_point = draft.zero_point;
    survey.crs = draft.crs;
    survey.vertical_datum = draft.vertical_datum;
    ProjectPaths paths;
    if (!draft.marks_file.empty()) {
        auto control = inFolder(draft.marks_file, folder);
        if (!control) return tl::unexpected(control.error());
        paths.control = std::move(*control);
    }
    for (const DraftRun& run : draft.runs) {
        auto log = inFolder(run.log, folder);
        if (!log) return tl::unexpected(log.error());
        survey.runs.push_back({run.id, run.kind, run.start, run.target, {}, {}});
        paths.logs.push_back(std::move(*log));
    }
    if (auto done = writeProjectFile(survey, paths, draft.project_file); !done)
        return tl::unexpected(done.error());
    return NewSurveyOutcome{draft};
}

Result<NewSurveyOutcome> makeNewSurvey(const NewSurveyRequest& request, Progress& progress,
                                       std::stop_token stop) {
    const auto draft = draftSurvey(request, progress, stop);
    if (!draft) return tl::unexpected(draft.error());
    // The first of them is the error itself.
    std::vector<Error> problems = draft->bad_files;
    for (std::size_t i = 0; i < draft->runs.size(); ++i) {
        if (auto problem = problemOf(*draft, i)) problems.push_back(std::move(*problem));
    }
    for (std::size_t i = 1; i < problems.size(); ++i) progress.message(Severity::Warning, problems[i].text());
    return writeDraft(*draft, request.replace);
}

std::string toText(const NewSurveyOutcome& outcome) {
    const SurveyDraft& s = outcome.survey;
    std::string text =
        fmt::format("{:<16}{}\n{:<16}{:.7f} {:.7f} {:.2f} m\n{:<16}{}\n", "Survey", printable(s.name),
                    "Zero point", s.zero_point.lat_deg, s.zero_point.lon_deg, s.zero_point.h_ell_m,
                    "Map frame", s.crs.empty() ? "local" : printable(s.crs));
    if (!s.marks_file.empty())
        text += fmt::format("{:<16}{} in {}\n", "Marks", s.marks.size(), printable(s.marks_file.string()));
    for (const DraftRun& run : s.runs) {
        const std::string way = fmt::format("{} to {}", run.start.value_or("-"), run.target.value_or("-"));
        text += fmt::format("{:<16}{:<12}{:<16}{:>7.0f} s  {}\n", run.id, name(run.kind), printable(way),
                            run.duration_s, run.reason);
    }
    for (const std::string& note : s.notes) text += fmt::format("Note: {}\n", note);
    const std::string file = printable(s.project_file.string());
    return text + fmt::format("Written to {}\nProcess it with: terrawalk process {} -o out\n", file, file);
}

std::string toJson(const NewSurveyOutcome& outcome) {
    using nlohmann::ordered_json;
    const SurveyDraft& s = outcome.survey;
    ordered_json runs = ordered_json::array();
    for (const DraftRun& run : s.runs) {
        ordered_json one{{"id", run.id}, {"kind", name(run.kind)}, {"log", run.log.string()}};
        if (run.start) one["start"] = *run.start;
        if (run.target) one["target"] = *run.target;
        one["duration_s"] = run.duration_s;
        one["reason"] = run.reason;
        runs.push_back(std::move(one));
    }
    return ordered_json{{"format", "terrawalk-new-survey 1"},
                        {"survey", s.project_file.string()},
                        {"name", s.name},
                        {"zero_point",
                         {{"lat_deg", s.zero_point.lat_deg},
                          {"lon_deg", s.zero_point.lon_deg},
                          {"h_ell_m", s.zero_point.h_ell_m}}},
                        {"crs", s.crs},
                        {"marks", s.marks.size()},
                        {"runs", std::move(runs)},
                        {"notes", s.notes}}
               .dump(2, ' ', false, ordered_json::error_handler_t::replace) +
           "\n";
}

}  // namespace terrawalk
