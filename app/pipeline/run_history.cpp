#include "app/pipeline/run_history.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/pipeline/tune_json.hpp"
#include "io/output_folder.hpp"

namespace terrawalk {

namespace {

using nlohmann::json;
using nlohmann::ordered_json;

constexpr std::string_view kHistoryFormat = "terrawalk-runs 1";

double rounded(double value, int decimals) {
    const double scale = std::pow(10.0, decimals);
    return std::round(value * scale) / scale;
}

int verdict(const FigureKind& kind, double before, double now) {
    if (kind.better == Better::Neither) return 0;
    const double was = std::abs(rounded(before, kind.decimals)), is = std::abs(rounded(now, kind.decimals));
    return was > is ? 1 : was < is ? -1 : 0;
}

const ErrorStatistics* planErrors(const SurveyReport& report) {
    for (const AccuracyGroup& group : report.accuracy) {
        if (group.stage == Stage::Fused && group.quantity == Quantity::ArrayPosition &&
            group.role == MarkRole::Check && group.horizontal)
            return &*group.horizontal;
    }
    return nullptr;
}

ordered_json changedSettings(const PipelineConfig& config) {
    ordered_json settings = ordered_json::object();
    for (const ParameterInfo& info : describeParameters()) {
        std::string text = settingText(config, info.key);
        if (text != info.default_value) settings[info.key] = std::move(text);
    }
    return settings;
}

std::optional<PastRun> runOf(const json& entry) {
    try {
        PastRun run;
        run.finished = entry.at("finished").get<std::string>();
        run.program = entry.at("program").get<std::string>();
        run.figures = entry.at("figures").get<RunFigures>();
        for (const auto& [key, text] : entry.at("settings").items()) {
            if (!applySetting(run.config, key + "=" + text.get<std::string>())) return std::nullopt;
        }
        if (const auto tuning = entry.find("tuning"); tuning != entry.end())
            run.config.tuning = tuningOf(*tuning);
        return run;
    } catch (const json::exception&) {
        return std::nullopt;
    }
}

}  // namespace

RunFigures runFigures(const SurveyReport& report) {
    RunFigures figures;
    if (report.headline && *report.headline < report.accuracy.size()) {
        if (const auto& up = report.accuracy[*report.headline].up) {
            figures["height_rmse_m"] = up->rmse_m;
            figures["height_error95_m"] = up->error95_m;
            figures["height_mean_m"] = up->mean_m;
        }
    }
    if (const ErrorStatistics* plan = planErrors(report)) figures["plan_rmse_m"] = plan->rmse_m;
    if (report.adjustment && report.adjustment->crossovers > 0)
        figures["crossover_misfit_m"] = report.adjustment->misfit_after_m;
    if (report.surface.uncertainty) figures["sigma_median_m"] = report.surface.uncertainty->median_m;
    figures["area_m2"] = report.surface.area_m2;
    figures["ground_points"] = static_cast<double>(report.surface.points);
    figures["cell_m"] = report.surface.cell_m;
    return figures;
}

std::vector<FigureChange> figureChanges(const RunFigures& before, const RunFigures& now) {
    std::vector<FigureChange> changes;
    for (const FigureKind& kind : kFigureKinds) {
        const auto was = before.find(kind.key), is = now.find(kind.key);
        if (was == before.end() || is == now.end()) continue;
        const double change = rounded(is->second, kind.decimals) - rounded(was->second, kind.decimals);
        if (change == 0.0 && kind.better == Better::Neither) continue;
        changes.push_back({kind, was->second, is->second, change, verdict(kind, was->second, is->second)});
    }
    return changes;
}

Result<RunHistory> readRunHistory(const std::filesystem::path& file) {
    std::error_code error;
    if (!std::filesystem::exists(file, error)) return RunHistory();
    std::ifstream stream(file, std::ios::binary);
    const json document = json::parse(stream, nullptr, false);
    const auto entries = document.is_object() ? document.find("runs") : document.end();
    if (!document.is_object() || document.value("format", json()) != kHistoryFormat ||
        entries == document.end() || !entries->is_array()) {
        return badData("this is no list of earlier runs", file, 0, "remove it: a new one is made");
    }
    RunHistory history;
    for (const json& entry : *entries) {
        if (auto run = runOf(entry)) {
            history.runs.push_back(std::move(*run));
        } else {
            ++history.left_out;
        }
    }
    return history;
}

Result<void> writeRunHistory(const std::vector<PastRun>& runs, const std::filesystem::path& file) {
    ordered_json entries = ordered_json::array();
    const std::size_t kept = std::min(runs.size(), kPastRuns);
    for (std::size_t i = runs.size() - kept; i < runs.size(); ++i) {
        const PastRun& run = runs[i];
        ordered_json entry{{"finished", run.finished},
                           {"program", run.program},
                           {"figures", run.figures},
                           {"settings", changedSettings(run.config)}};
        if (run.config.tuning) entry["tuning"] = tuningJson(*run.config.tuning);
        entries.push_back(std::move(entry));
    }
    const ordered_json document{{"format", kHistoryFormat}, {"runs", std::move(entries)}};
    return writeTextFile(document.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n", file);
}

}  // namespace terrawalk
