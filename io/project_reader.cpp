#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <system_error>

#include "io/json_node.hpp"
#include "io/project_file.hpp"
#include "io/read_breaklines.hpp"
#include "io/read_survey.hpp"
#include "io/survey_format.hpp"
#include "io/text_input.hpp"
#include "survey/parallel.hpp"

namespace terrawalk {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostProjectBytes = std::size_t{8} << 20U;

std::string_view typeName(JsonNode::Type type) {
    switch (type) {
        case JsonNode::Type::Null:
            return "null";
        case JsonNode::Type::Boolean:
            return "true or false";
        case JsonNode::Type::Number:
            return "a number";
        case JsonNode::Type::String:
            return "a text";
        case JsonNode::Type::Array:
            return "a list";
        case JsonNode::Type::Object:
            return "an object";
    }
    return "";
}

// What all parts of one project file share: the first error wins, later ones follow from it.
struct Findings {
    const fs::path& file;
    std::optional<Error> error;
    std::vector<std::string> notes;

    void fail(std::string message, std::size_t line, std::string cure = {}) {
        if (!error) error = badData(std::move(message), file, line, std::move(cure)).value();
    }
};

// Reads the members of one object, knows which ones it was asked for, and names them by their path.
class ObjectReader {
  public:
    ObjectReader(const JsonNode& node, std::string path, Findings& findings)
        : node_(node), path_(std::move(path)), findings_(findings) {
        if (node.type == JsonNode::Type::Object) return;
        findings_.fail(fmt::format("{} must be an object, but is {}", path_.empty() ? "the project" : path_,
                                   typeName(node.type)),
                       node.line);
    }

    std::string pathOf(std::string_view key) const {
        return path_.empty() ? std::string(key) : fmt::format("{}.{}", path_, key);
    }
    std::size_t lineOf(std::string_view key) const {
        const JsonNode* const member = node_.find(key);
        return member != nullptr ? member->line : node_.line;
    }
    void fail(std::string_view key, std::string_view problem, std::string cure = {}) {
        findings_.fail(fmt::format("{} {}", pathOf(key), problem), lineOf(key), std::move(cure));
    }

    const JsonNode* optionalMember(std::string_view key, JsonNode::Type type) {
        known_.insert(key);
        const JsonNode* const member = node_.find(key);
        if (member == nullptr || member->type == type) return member;
        fail(key, fmt::format("must be {}, but is {}", typeName(type), typeName(member->type)));
        return nullptr;
    }
    const JsonNode* member(std::string_view key, JsonNode::Type type) {
        const JsonNode* const found = optionalMember(key, type);
        if (found == nullptr) fail(key, "is missing");
        return found;
    }
    std::optional<std::string> optionalText(std::string_view key) {
        const JsonNode* const found = optionalMember(key, JsonNode::Type::String);
        if (found == nullptr) return std::nullopt;
        if (found->text.empty()) fail(key, "is empty", "give a text, or leave the key out");
        return found->text;
    }
    std::string text(std::string_view key) {
        if (!member(key, JsonNode::Type::String)) return {};
        return *optionalText(key);
    }
    double number(std::string_view key, double least, double greatest) {
        const JsonNode* const found = member(key, JsonNode::Type::Number);
        if (found == nullptr) return 0.0;
        if (!(found->number >= least && found->number <= greatest)) {
            fail(key, fmt::format("is {}, outside {} to {}", found->number, least, greatest));
        }
        return found->number;
    }
    void noteUnknownKeys() {
        for (std::size_t i = 0; i < node_.keys.size(); ++i) {
            if (known_.contains(node_.keys[i])) continue;
            findings_.notes.push_back(noteAt(
                node_.elements[i].line, fmt::format("unknown key {} is not used", pathOf(node_.keys[i]))));
        }
    }

  private:
    const JsonNode& node_;
    std::string path_;
    Findings& findings_;
    std::set<std::string_view> known_;
};

GeodeticPosition readZeroPoint(const JsonNode& node, Findings& findings) {
    ObjectReader object(node, "zero_point", findings);
    const GeodeticPosition position{object.number("lat_deg", -90.0, 90.0),
                                    object.number("lon_deg", -180.0, 180.0),
                                    object.number("h_ell_m", -1000.0, 10000.0)};
    object.noteUnknownKeys();
    return position;
}

Stop readStop(const JsonNode& node, const std::string& path, Findings& findings) {
    ObjectReader object(node, path, findings);
    Stop stop{object.text("point"), object.number("from_s", -1e9, 1e9), object.number("to_s", -1e9, 1e9)};
    if (stop.from_s >= stop.to_s) object.fail("to_s", "must be later than from_s");
    object.noteUnknownKeys();
    return stop;
}

RunKind readKind(ObjectReader& object) {
    const std::string text = object.text("kind");
    for (const RunKind kind : {RunKind::FixedPoint, RunKind::Area}) {
        if (text == name(kind)) return kind;
    }
    object.fail("kind", fmt::format("is {}", inQuotes(text)), "write \"fixed-point\" or \"area\"");
    return RunKind::Area;
}

void readRun(const JsonNode& node, const std::string& path, ProjectFile& project, Findings& findings) {
    ObjectReader object(node, path, findings);
    Run run;
    RunSource source;
    run.id = object.text("id");
    if (!isSafeRunId(run.id)) {
        object.fail("id", fmt::format("is {}, which cannot name files", inQuotes(run.id)),
                    "use at most 64 letters, digits, '-', '_' and '.', the first one no '.'");
    }
    run.kind = readKind(object);
    source.log = object.text("log");
    source.log_line = object.lineOf("log");
    run.start = object.optionalText("start");
    source.start_line = object.lineOf("start");
    run.target = object.optionalText("target");
    source.target_line = object.lineOf("target");
    if (run.kind == RunKind::FixedPoint) {
        if (!run.start) object.fail("start", "is missing", "a fixed-point run starts on a known mark");
        if (!run.target) object.fail("target", "is missing", "a fixed-point run ends on a known mark");
    }
    if (const JsonNode* const stops = object.optionalMember("stops", JsonNode::Type::Array)) {
        for (std::size_t i = 0; i < stops->elements.size(); ++i) {
            const JsonNode& stop = stops->elements[i];
            run.stops.push_back(readStop(stop, fmt::format("{}.stops[{}]", path, i), findings));
            source.stop_lines.push_back(stop.line);
        }
    }
    object.noteUnknownKeys();
    project.survey.runs.push_back(std::move(run));
    project.sources.push_back(std::move(source));
}

// Ids and logs name files, and each run has its own.
void checkRunsAreApart(const ProjectFile& project, const JsonNode& runs, Findings& findings) {
    std::map<std::string_view, std::size_t> ids;
    std::map<std::string_view, std::size_t> logs;
    for (std::size_t i = 0; i < project.survey.runs.size(); ++i) {
        const auto [same_id, new_id] = ids.emplace(project.survey.runs[i].id, i);
        if (!new_id) {
            findings.fail(fmt::format("runs[{}].id: {} is already the id of runs[{}] (line {})", i,
                                      inQuotes(project.survey.runs[i].id), same_id->second,
                                      runs.elements[same_id->second].line),
                          runs.elements[i].line, "give each run its own id");
        }
        const auto [same_log, new_log] = logs.emplace(project.sources[i].log, i);
        if (!new_log) {
            findings.notes.push_back(
                noteAt(project.sources[i].log_line,
                       fmt::format("runs[{}] reads the same log as runs[{}]", i, same_log->second)));
        }
    }
}

// A path of the project file, taken from its folder, which it may not leave.
Result<fs::path> pathInFolder(const fs::path& project_file, const std::string& text, const std::string& key,
                              std::size_t line) {
    const auto refuse = [&](std::string_view problem) {
        return badData(fmt::format("{}: {} {}", key, inQuotes(text), problem), project_file, line,
                       "name a file in the project's folder, relative to it");
    };
    const fs::path relative(text);
    const auto climbsOut = [](const fs::path& path) {
        return path.empty() || *path.begin() == "..";
    };
    if (std::any_of(text.begin(), text.end(), [](char c) { return c >= 0 && c < ' '; })) {
        return refuse("holds a control character");
    }
    if (relative.has_root_path()) return refuse("is an absolute path");
    if (climbsOut(relative.lexically_normal())) return refuse("leaves the project's folder");

    const fs::path folder = project_file.parent_path();
    std::error_code error;
    const fs::path root = fs::canonical(folder.empty() ? fs::path(".") : folder, error);
    if (error) return refuse("cannot be looked up: " + error.message());
    const fs::path resolved = fs::weakly_canonical(root / relative, error);
    if (error) return refuse("cannot be looked up: " + error.message());
    if (climbsOut(resolved.lexically_relative(root)))
        return refuse("leads out of the project's folder by a link");
    return folder / relative;
}

Result<void> readMarks(ProjectFile& project) {
    if (project.control.empty()) return {};
    Survey& survey = project.survey;
    const auto file = pathInFolder(survey.project_file, project.control, "control", project.control_line);
    if (!file) return tl::unexpected(file.error());
    auto table = readControlMarks(*file);
    if (!table) return tl::unexpected(table.error());
    survey.control_file = *file;
    survey.marks = std::move(table->marks);
    for (const std::string& note : table->notes) survey.notes.push_back("control marks, " + note);
    return {};
}

Result<void> readProjectBreaklines(ProjectFile& project, const std::stop_token& stop) {
    if (project.breaklines.empty()) return {};
    Survey& survey = project.survey;
    const auto file =
        pathInFolder(survey.project_file, project.breaklines, "breaklines", project.breaklines_line);
    if (!file) return tl::unexpected(file.error());
    SilentProgress silent;
    auto lines = readBreaklines(*file, silent, stop);
    if (!lines) return tl::unexpected(lines.error());
    survey.breakline_file = *file;
    survey.breaklines = std::move(lines->lines);
    survey.breakline_crs = std::move(lines->crs);
    return {};
}

Result<void> checkMarksExist(const ProjectFile& project) {
    const Survey& survey = project.survey;
    std::set<std::string_view> known{kZeroMark};
    for (const ControlMark& mark : survey.marks) known.insert(mark.name);
    const auto check = [&](const std::string& mark, const std::string& key,
                           std::size_t line) -> Result<void> {
        if (known.contains(mark)) return {};
        return badData(fmt::format("{}: there is no mark {}", key, inQuotes(mark)), survey.project_file, line,
                       project.control.empty() ? "name the file with the marks under \"control\""
                                               : "add it to the control file, or correct the name");
    };
    for (std::size_t i = 0; i < survey.runs.size(); ++i) {
        const Run& run = survey.runs[i];
        const RunSource& source = project.sources[i];
        Result<void> found;
        if (run.start) found = check(*run.start, fmt::format("runs[{}].start", i), source.start_line);
        if (found && run.target)
            found = check(*run.target, fmt::format("runs[{}].target", i), source.target_line);
        for (std::size_t k = 0; found && k < run.stops.size(); ++k) {
            found = check(run.stops[k].point, fmt::format("runs[{}].stops[{}].point", i, k),
                          source.stop_lines[k]);
        }
        if (!found) return found;
    }
    return {};
}

// Adds up what the logs, read side by side, tell of themselves. Fractions are kept in millionths.
class SharedProgress {
  public:
    SharedProgress(Progress& parent, std::size_t parts)
        : parent_(parent), parts_(static_cast<double>(parts)) {}
    void add(long millionths, std::string_view step) {
        const long sum = sum_.fetch_add(millionths) + millionths;
        parent_.report(static_cast<double>(sum) / (1e6 * parts_), step);
    }
    Progress& parent() { return parent_; }

  private:
    Progress& parent_;
    double parts_;
    std::atomic<long> sum_ = 0;
};

class OneOfMany final : public Progress {
  public:
    explicit OneOfMany(SharedProgress& all) : all_(all) {}
    void report(double fraction, std::string_view step) override {
        const long now = std::lround(fraction * 1e6);
        all_.add(now - last_, step);
        last_ = now;
    }
    void message(Severity severity, std::string_view text) override { all_.parent().message(severity, text); }

  private:
    SharedProgress& all_;
    long last_ = 0;  // one log is read by one thread
};

Result<void> readLogs(ProjectFile& project, Progress& progress, const std::stop_token& stop) {
    std::vector<Run>& runs = project.survey.runs;
    std::vector<fs::path> files;
    for (std::size_t i = 0; i < runs.size(); ++i) {
        auto file = pathInFolder(project.survey.project_file, project.sources[i].log,
                                 fmt::format("runs[{}].log", i), project.sources[i].log_line);
        if (!file) return tl::unexpected(file.error());
        files.push_back(std::move(*file));
    }
    SharedProgress shared(progress, runs.size());
    std::vector<std::optional<Error>> errors(runs.size());
    // Runs after the first bad one need not be read: their errors would not be reported.
    std::atomic<std::size_t> first_bad = runs.size();
    parallelRanges(runs.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            if (i > first_bad.load()) return;
            OneOfMany part(shared);
            auto log = readArrayLog(files[i], part, stop);
            if (log) {
                runs[i].log = std::move(*log);
                continue;
            }
            errors[i] = std::move(log.error());
            for (std::size_t known = first_bad.load();
                 i < known && !first_bad.compare_exchange_weak(known, i);) {
            }
        }
    });
    if (stop.stop_requested()) return cancelled();
    if (first_bad.load() < runs.size()) return tl::unexpected(std::move(*errors[first_bad.load()]));
    return {};
}

Result<void> checkStopsLieInLogs(const ProjectFile& project) {
    for (std::size_t i = 0; i < project.survey.runs.size(); ++i) {
        const Run& run = project.survey.runs[i];
        const double first_s = run.log.time_s.front();
        const double last_s = run.log.time_s.back();
        for (std::size_t k = 0; k < run.stops.size(); ++k) {
            const Stop& stop = run.stops[k];
            if (stop.from_s >= first_s && stop.to_s <= last_s) continue;
            return badData(fmt::format("runs[{}].stops[{}]: {} to {} s is not within the log, {} to {} s", i,
                                       k, stop.from_s, stop.to_s, first_s, last_s),
                           project.survey.project_file, project.sources[i].stop_lines[k],
                           "times count like time_s of the log");
        }
    }
    return {};
}

}  // namespace

Result<ProjectFile> parseProjectFile(std::string_view text, const fs::path& file) {
    const auto root = parseJson(text, file);
    if (!root) return tl::unexpected(root.error());
    Findings findings{file, {}, {}};
    ObjectReader object(*root, "", findings);
    ProjectFile project;
    Survey& survey = project.survey;
    survey.project_file = file;

    if (const std::string format = object.text("format"); format != kProjectFormat) {
        object.fail("format", fmt::format("is {}", inQuotes(format)),
                    fmt::format("write \"{}\"", kProjectFormat));
    }
    if (auto name = object.optionalText("name")) {
        survey.name = std::move(*name);
    } else {
        survey.name = "unnamed survey";
        findings.notes.push_back(noteAt(root->line, "the survey has no name"));
    }
    if (const JsonNode* const node = object.member("zero_point", JsonNode::Type::Object)) {
        survey.zero_point = readZeroPoint(*node, findings);
    }
    survey.crs = object.optionalText("crs").value_or("");
    survey.vertical_datum = object.optionalText("vertical_datum").value_or(survey.vertical_datum);
    project.control = object.optionalText("control").value_or("");
    project.control_line = object.lineOf("control");
    project.breaklines = object.optionalText("breaklines").value_or("");
    project.breaklines_line = object.lineOf("breaklines");
    if (const JsonNode* const runs = object.member("runs", JsonNode::Type::Array)) {
        if (runs->elements.empty()) object.fail("runs", "is empty", "name at least one run with its log");
        for (std::size_t i = 0; i < runs->elements.size(); ++i) {
            readRun(runs->elements[i], fmt::format("runs[{}]", i), project, findings);
        }
        checkRunsAreApart(project, *runs, findings);
    }
    object.noteUnknownKeys();

    if (findings.error) return tl::unexpected(std::move(*findings.error));
    survey.notes = std::move(findings.notes);
    return project;
}

Result<Survey> readSurvey(const fs::path& project_file, Progress& progress, std::stop_token stop) {
    const auto text = readWholeFile(project_file, kMostProjectBytes);
    if (!text) return tl::unexpected(text.error());
    auto project = parseProjectFile(*text, project_file);
    if (!project) return tl::unexpected(project.error());
    if (auto read = readMarks(*project); !read) return tl::unexpected(read.error());
    if (auto read = readProjectBreaklines(*project, stop); !read) return tl::unexpected(read.error());
    if (auto found = checkMarksExist(*project); !found) return tl::unexpected(found.error());
    if (auto read = readLogs(*project, progress, stop); !read) return tl::unexpected(read.error());
    if (auto inside = checkStopsLieInLogs(*project); !inside) return tl::unexpected(inside.error());
    return std::move(project->survey);
}

}  // namespace terrawalk
