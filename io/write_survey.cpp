#include "io/write_survey.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <string_view>
#include <system_error>

#include "io/replacing_file.hpp"
#include "io/survey_format.hpp"

namespace terrawalk {

namespace {

namespace fs = std::filesystem;

/// Decimals of each channel in the file, in the order of `Channel`.
constexpr std::array<int, kChannelCount> kDecimals{
    9, 9, 3,  // latitude, longitude, height
    0, 3, 3,  // fix, accuracies
    4, 4, 4,  // GNSS velocity
    2, 2,     // pressure, temperature
    4, 4, 0,  // flow, its quality
    4, 4, 4,  // roll, pitch, heading
    4, 4, 4,  // acceleration
    4, 4, 4,  // angular rate
    3, 0,     // range, strength
};
constexpr int kShortest = -1;  // as many decimals as it takes to read the same value again
constexpr std::string_view kControlFile = "control.csv";
constexpr std::string_view kProjectFileName = "survey.json";

struct WrittenColumn {
    std::string name;
    const std::vector<double>* values;
    double unit_factor;
    int decimals;
};

std::vector<WrittenColumn> columnsOf(const ArrayLog& log) {
    std::vector<WrittenColumn> columns{{std::string(kTimeColumn), &log.time_s, 1.0, 3}};
    for (std::size_t i = 0; i < kChannelCount; ++i) {
        if (log.channels[i].empty()) continue;
        columns.push_back(
            {std::string(kChannels[i].column), &log.channels[i], kChannels[i].unit_factor, kDecimals[i]});
    }
    for (const AuxiliaryColumn& column : log.auxiliary) {
        columns.push_back({column.name, &column.values, 1.0, kShortest});
    }
    return columns;
}

bool isOneLine(std::string_view text) {
    return text.find_first_of(std::string_view("\r\n\0", 3)) == text.npos;
}

std::string csvText(std::string_view text) {
    if (text.find_first_of(",\" \t#") == std::string_view::npos) return std::string(text);
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"') out += '"';
        out += c;
    }
    return out + '"';
}

Result<void> checkLog(const ArrayLog& log, const std::vector<WrittenColumn>& columns, const fs::path& file) {
    if (log.size() == 0) return badData("cannot write a log without rows", file);
    if (!isOneLine(log.device) || !isOneLine(log.start_utc)) {
        return badData("cannot write the log: its device or start time has a line end", file);
    }
    for (const WrittenColumn& column : columns) {
        if (column.name.empty() || !isOneLine(column.name)) {
            return badData("cannot write the log: the name of an auxiliary column is empty or has a line end",
                           file);
        }
        if (column.values->size() != log.size()) {
            return badData(fmt::format("cannot write column {}: {} values for {} epochs", column.name,
                                       column.values->size(), log.size()),
                           file);
        }
        for (std::size_t i = 0; i < log.size(); ++i) {
            if (!std::isinf((*column.values)[i])) continue;
            return badData(fmt::format("cannot write column {}: epoch {} is infinite", column.name, i), file);
        }
    }
    for (std::size_t i = 0; i < log.size(); ++i) {
        const bool later = i == 0 || std::round(1e3 * log.time_s[i]) > std::round(1e3 * log.time_s[i - 1]);
        if (present(log.time_s[i]) && later) continue;
        return badData(
            fmt::format("cannot write the log: epoch {} is not a millisecond after the one before", i), file);
    }
    return {};
}

std::string headOf(const ArrayLog& log, const std::vector<WrittenColumn>& columns) {
    std::string text = fmt::format("# format: {}\n", kArrayLogFormat);
    const auto line = [&text](std::string_view key, std::string_view value) {
        text += fmt::format("# {}: {}\n", key, value);
    };
    const auto vector = [&line](std::string_view key, const Eigen::Vector3d& arm_m) {
        if (!arm_m.isZero(0.0)) line(key, fmt::format("{} {} {}", arm_m.x(), arm_m.y(), arm_m.z()));
    };
    if (!log.device.empty()) line("device", log.device);
    if (!log.start_utc.empty()) line("start_utc", log.start_utc);
    if (present(log.sample_interval_s)) line("sample_interval_s", fmt::format("{}", log.sample_interval_s));
    vector("range_lever_arm_m", log.range_lever_arm_m);
    vector("gnss_lever_arm_m", log.gnss_lever_arm_m);
    for (const WrittenColumn& column : columns) {
        if (&column != &columns.front()) text += ',';
        text += csvText(column.name);
    }
    return text + '\n';
}

void appendRow(const std::vector<WrittenColumn>& columns, std::size_t row, std::string& text) {
    for (const WrittenColumn& column : columns) {
        if (&column != &columns.front()) text += ',';
        const double value = (*column.values)[row] / column.unit_factor;
        if (!present(value)) continue;
        if (column.decimals == kShortest) {
            fmt::format_to(std::back_inserter(text), "{}", value);
        } else {
            fmt::format_to(std::back_inserter(text), "{:.{}f}", value, column.decimals);
        }
    }
    text += '\n';
}

Result<void> writeWhole(const std::string& text, const fs::path& file) {
    auto output = ReplacingFile::create(file);
    if (!output) return tl::unexpected(output.error());
    if (auto written = output->write(text); !written) return written;
    return output->commit();
}

std::string logPath(const Run& run) {
    return fmt::format("logs/{}.csv", run.id);
}

nlohmann::ordered_json jsonOf(const Run& run, const std::string& log) {
    nlohmann::ordered_json json{{"id", run.id}, {"kind", name(run.kind)}, {"log", log}};
    if (run.start) json["start"] = *run.start;
    if (run.target) json["target"] = *run.target;
    for (const Stop& stop : run.stops) {
        json["stops"].push_back({{"point", stop.point}, {"from_s", stop.from_s}, {"to_s", stop.to_s}});
    }
    return json;
}

nlohmann::ordered_json jsonOf(const Survey& survey, const ProjectPaths& paths) {
    nlohmann::ordered_json json{{"format", kProjectFormat},
                                {"name", survey.name},
                                {"zero_point",
                                 {{"lat_deg", survey.zero_point.lat_deg},
                                  {"lon_deg", survey.zero_point.lon_deg},
                                  {"h_ell_m", survey.zero_point.h_ell_m}}}};
    if (!survey.crs.empty()) json["crs"] = survey.crs;
    json["vertical_datum"] = survey.vertical_datum;
    if (!paths.control.empty()) json["control"] = paths.control;
    for (std::size_t i = 0; i < survey.runs.size(); ++i)
        json["runs"].push_back(jsonOf(survey.runs[i], paths.logs[i]));
    return json;
}

Result<std::string> projectText(const Survey& survey, const ProjectPaths& paths, const fs::path& blamed) {
    try {
        return jsonOf(survey, paths).dump(2) + '\n';
    } catch (const nlohmann::json::exception& problem) {
        return badData(fmt::format("cannot write the project: {}", problem.what()), blamed);
    }
}

Result<void> checkRunIds(const Survey& survey, const fs::path& folder) {
    std::set<std::string_view> met;
    for (const Run& run : survey.runs) {
        if (!isSafeRunId(run.id) || !met.insert(run.id).second) {
            return badData(fmt::format("cannot write run \"{}\": its id names no file of its own", run.id),
                           folder);
        }
    }
    return {};
}

}  // namespace

Result<void> writeArrayLog(const ArrayLog& log, const fs::path& file) {
    const std::vector<WrittenColumn> columns = columnsOf(log);
    if (auto checked = checkLog(log, columns, file); !checked) return checked;
    auto output = ReplacingFile::create(file);
    if (!output) return tl::unexpected(output.error());
    std::string text = headOf(log, columns);
    for (std::size_t row = 0; row < log.size(); ++row) {
        appendRow(columns, row, text);
        if (auto written = output->write(text); !written) return written;
        text.clear();
    }
    return output->commit();
}

Result<void> writeControlMarks(const std::vector<ControlMark>& marks, const fs::path& file) {
    std::string text = fmt::format("{}\n", fmt::join(kControlColumns, ","));
    for (const ControlMark& mark : marks) {
        if (mark.name.empty() || !isOneLine(mark.name)) {
            return badData("cannot write a mark without a name, or with a line end in it", file);
        }
        if (!mark.enu_m.allFinite() || !(mark.sigma_h_m >= 0.0) || !(mark.sigma_v_m >= 0.0)) {
            return badData(fmt::format("cannot write mark {}: a number is not finite", mark.name), file);
        }
        text += fmt::format("{},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{}\n", csvText(mark.name), mark.enu_m.x(),
                            mark.enu_m.y(), mark.enu_m.z(), mark.sigma_h_m, mark.sigma_v_m, name(mark.role));
    }
    return writeWhole(text, file);
}

Result<void> writeProjectFile(const Survey& survey, const ProjectPaths& paths, const fs::path& file) {
    if (auto checked = checkRunIds(survey, file); !checked) return checked;
    const auto text = projectText(survey, paths, file);
    return text ? writeWhole(*text, file) : tl::unexpected(text.error());
}

Result<void> writeSurvey(const Survey& survey, const fs::path& folder) {
    if (auto checked = checkRunIds(survey, folder); !checked) return checked;
    ProjectPaths paths{survey.marks.empty() ? std::string() : std::string(kControlFile), {}};
    for (const Run& run : survey.runs) paths.logs.push_back(logPath(run));
    // Before anything is written: a name that is no text would leave half a survey.
    const auto project = projectText(survey, paths, folder);
    if (!project) return tl::unexpected(project.error());
    std::error_code error;
    fs::create_directory(folder / "logs", error);
    if (error) return systemError("cannot make the folder: " + error.message(), folder / "logs");
    for (const Run& run : survey.runs) {
        if (auto written = writeArrayLog(run.log, folder / logPath(run)); !written) return written;
    }
    if (!survey.marks.empty()) {
        if (auto written = writeControlMarks(survey.marks, folder / kControlFile); !written) return written;
    }
    // Last, so that a project file never names what is not there yet.
    return writeWhole(*project, folder / kProjectFileName);
}

}  // namespace terrawalk
