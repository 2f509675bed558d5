#include "app/pipeline/tune_trace.hpp"

#include <fstream>
#include <nlohmann/json.hpp>

#include "app/pipeline/tune_json.hpp"

namespace terrawalk {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using nlohmann::ordered_json;

std::string lossText(const TuneOutcome& outcome) {
    return outcome.loss_meaning + (outcome.loss_unit.empty() ? "" : ", " + outcome.loss_unit);
}

}  // namespace

TuneTrace traceOf(const TuneOutcome& outcome) {
    return {outcome.method, std::string(name(outcome.options.optimiser)), outcome.options.seed,
            lossText(outcome), outcome.convergence};
}

OptimiserTable endLosses(const std::vector<TuneTrace>& traces) {
    OptimiserTable table;
    if (traces.empty()) return table;
    table.quantity = traces.back().loss;
    for (const TuneTrace& trace : traces) {
        if (trace.loss != table.quantity || trace.convergence.empty()) continue;
        table.of(trace.optimiser).losses.push_back(trace.convergence.back().best_loss);
    }
    return table;
}

Result<TuneTrace> readTuneTrace(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    if (!stream.is_open()) return badData("the file cannot be opened", file);
    const json document = json::parse(stream, nullptr, false);
    const std::string cure =
        "choose a file that `terrawalk tune` wrote, or settings that were saved after tuning";
    if (!document.is_object()) return badData("this is no JSON", file, 0, cure);
    try {
        const json& section = document.at("tuning");
        const TuningRecord record = tuningOf(section);
        TuneTrace trace{record.method, record.optimiser, record.seed, record.loss, {}};
        for (const json& point : section.at("convergence")) {
            if (point.at(1).is_null()) continue;  // infinite
            trace.convergence.push_back({point.at(0).get<std::size_t>(), point.at(1).get<double>()});
        }
        if (trace.convergence.empty()) return badData("the search has no points", file, 0, cure);
        return trace;
    } catch (const json::exception&) {
        return badData("it tells of no search for parameters", file, 0, cure);
    }
}

std::string withTrace(const std::string& config_json, const TuneTrace& trace) {
    ordered_json document = ordered_json::parse(config_json);
    const auto section = document.find("tuning");
    if (section == document.end() || !section->is_object()) return config_json;
    ordered_json points = ordered_json::array();
    for (const ConvergencePoint& point : trace.convergence)
        points.push_back({point.evaluations, point.best_loss});
    (*section)["convergence"] = std::move(points);
    return document.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace terrawalk
