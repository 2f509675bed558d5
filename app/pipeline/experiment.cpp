#include "app/pipeline/experiment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/pipeline/experiments/experiments.hpp"
#include "io/markup_text.hpp"
#include "io/output_folder.hpp"

namespace terrawalk {

namespace {

constexpr std::array kExperiments{
    Experiment{"fig7", "Paper 000, Fig 7: convergence of optimisers on classical functions", runFig7},
    Experiment{"fig8", "Paper 000, Fig 8: evenness of initial populations", runFig8},
    Experiment{"fig10", "Paper 000, Fig 10: loss by tuner, nine process noises", runFig10},
    Experiment{"fig11", "Paper 000, Fig 11: loss by tuner, alpha, beta and kappa as well", runFig11},
    Experiment{"fig12", "Paper 000, Fig 12: loss by population and iterations", runFig12},
    Experiment{"fig13", "Paper 000, Fig 13: time and evaluations by tuner", runFig13},
    Experiment{"fig14", "Paper 000, Fig 14: height error of raw, untuned and tuned surfaces", runFig14},
    Experiment{"fig15", "Paper 000, Fig 15: five points, each walked to ten times", runFig15},
    Experiment{"accuracy", "Simulated surveys against their truth, by level of faults", runAccuracy},
    Experiment{"robustness", "Simulated surveys with errors that no level of faults has", runRobustness},
    Experiment{"coverage", "Standard errors of DEM and volume on simulated surveys", runCoverage},
    Experiment{"outage", "GNSS masked for 10, 30 and 60 s in a survey's logs, or in a simulated walk's",
               runOutage, true},
};

std::string printed(const Cell& cell) {
    if (const auto* number = std::get_if<double>(&cell)) return fmt::format("{:.4g}", *number);
    if (const auto* text = std::get_if<std::string>(&cell)) return *text;
    return "";
}

std::string csvCell(const Cell& cell) {
    const auto* number = std::get_if<double>(&cell);
    if (number == nullptr) return csvField(printed(cell));
    return std::isfinite(*number) ? fmt::format("{}", *number) : "";
}

nlohmann::ordered_json jsonCell(const Cell& cell) {
    if (const auto* number = std::get_if<double>(&cell)) return *number;
    if (const auto* text = std::get_if<std::string>(&cell)) return *text;
    return nullptr;
}

/// Numbers stand at the right of their column, text at the left.
bool isNumeric(const ExperimentTable& table, std::size_t column) {
    return std::none_of(table.rows.begin(), table.rows.end(), [&](const std::vector<Cell>& row) {
        return column < row.size() && std::holds_alternative<std::string>(row[column]);
    });
}

nlohmann::ordered_json rowsOf(const ExperimentTable& table) {
    nlohmann::ordered_json rows = nlohmann::ordered_json::array();
    for (const auto& row : table.rows) {
        nlohmann::ordered_json object = nlohmann::ordered_json::object();
        for (std::size_t c = 0; c < row.size(); ++c) object[table.columns[c]] = jsonCell(row[c]);
        rows.push_back(std::move(object));
    }
    return rows;
}

Result<void> makeFolder(const std::filesystem::path& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error) return systemError("cannot make the folder: " + error.message(), folder);
    return {};
}

}  // namespace

std::span<const Experiment> experiments() {
    return kExperiments;
}

ExperimentFiles experimentFiles(std::string_view name, const std::filesystem::path& output) {
    return {output / (std::string(name) + ".csv"), output / (std::string(name) + ".svg")};
}

Result<ExperimentReport> runExperiment(std::string_view name, const ExperimentOptions& options,
                                       const std::filesystem::path& output, Progress& progress,
                                       std::stop_token stop) {
    const auto* const experiment = std::find_if(kExperiments.begin(), kExperiments.end(),
                                                [&](const Experiment& e) { return e.name == name; });
    if (experiment == kExperiments.end()) {
        return usageError(
            name.empty() ? "no experiment is named" : fmt::format("no experiment is called \"{}\"", name),
            "terrawalk experiment --list shows them");
    }
    if (!options.survey.empty() && !experiment->takes_survey) {
        return usageError(fmt::format("the experiment {} takes no survey", name), "leave it out");
    }
    // A folder that cannot be written is said at once, not after the work.
    if (auto done = makeFolder(output); !done) return tl::unexpected(done.error());
    auto report = experiment->run(options, progress, stop);
    if (!report) return report;
    if (stop.stop_requested()) return cancelled();
    if (report->data.columns.empty()) report->data = report->summary;
    report->plot.title = report->title;
    report->plot.note = conditions(*report, options);
    const ExperimentFiles files = experimentFiles(name, output);
    if (auto done = writeTextFile(toCsv(report->data), files.csv); !done) return tl::unexpected(done.error());
    if (auto done = writeTextFile(plotSvg(report->plot), files.svg); !done) {
        return tl::unexpected(done.error());
    }
    progress.report(1.0, "done");
    return report;
}

std::string conditions(const ExperimentReport& report, const ExperimentOptions& options) {
    return fmt::format("{}seed {}{}", report.simulated ? "simulated, " : "", options.seed,
                       options.quick ? ", quick form" : "");
}

std::string toText(const ExperimentTable& table) {
    std::vector<std::size_t> widths;
    for (std::size_t c = 0; c < table.columns.size(); ++c) {
        std::size_t width = characterCount(table.columns[c]);
        for (const auto& row : table.rows) {
            if (c < row.size()) width = std::max(width, characterCount(printed(row[c])));
        }
        widths.push_back(width);
    }
    std::string text;
    const auto addRow = [&](const auto& cellText) {
        std::string line;
        for (std::size_t c = 0; c < widths.size(); ++c) {
            const std::string words = cellText(c);
            const std::string room(widths[c] - characterCount(words), ' ');
            if (c > 0) line += "  ";
            line += isNumeric(table, c) ? room + words : words + room;
        }
        line.erase(line.find_last_not_of(' ') + 1);
        text += line + "\n";
    };
    addRow([&](std::size_t c) { return table.columns[c]; });
    for (const auto& row : table.rows) {
        addRow([&](std::size_t c) { return c < row.size() ? printed(row[c]) : std::string(); });
    }
    return text;
}

std::string toText(const ExperimentReport& report, const ExperimentOptions& options) {
    std::string text =
        fmt::format("{} ({})\n\n{}", report.title, conditions(report, options), toText(report.summary));
    if (!report.notes.empty()) text += "\n";
    for (const std::string& note : report.notes) text += "- " + note + "\n";
    return text;
}

std::string toCsv(const ExperimentTable& table) {
    std::string text;
    const auto addRow = [&](std::size_t cells, const auto& cellText) {
        for (std::size_t c = 0; c < cells; ++c) {
            if (c > 0) text += ',';
            text += cellText(c);
        }
        text += '\n';
    };
    addRow(table.columns.size(), [&](std::size_t c) { return csvField(table.columns[c]); });
    for (const auto& row : table.rows) {
        addRow(row.size(), [&](std::size_t c) { return csvCell(row[c]); });
    }
    return text;
}

std::string toJson(const ExperimentTable& table) {
    return rowsOf(table).dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

std::string toJson(const ExperimentReport& report, const ExperimentOptions& options,
                   const ExperimentFiles& files) {
    const nlohmann::ordered_json document{{"format", "terrawalk-experiment 1"},
                                          {"title", report.title},
                                          {"simulated", report.simulated},
                                          {"seed", options.seed},
                                          {"quick", options.quick},
                                          {"rows", rowsOf(report.summary)},
                                          {"notes", report.notes},
                                          {"csv", files.csv.string()},
                                          {"svg", files.svg.string()}};
    return document.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace terrawalk
