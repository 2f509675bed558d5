#include "app/pipeline/tune_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "app/pipeline/tune_json.hpp"
#include "app/pipeline/version.hpp"

namespace terrawalk {

namespace {

using nlohmann::json;
using nlohmann::ordered_json;

ordered_json optionalNumber(const std::optional<double>& value) {
    return value ? ordered_json(*value) : ordered_json(nullptr);
}

// What is infinite is written as null.
double numberOf(const json& value) {
    return value.is_null() ? std::numeric_limits<double>::infinity() : value.get<double>();
}

std::optional<double> optionalOf(const json& value) {
    if (value.is_null()) return std::nullopt;
    return value.get<double>();
}

ordered_json lossJson(const TuneOutcome& outcome, const std::vector<double>& loss) {
    ordered_json object;
    for (std::size_t i = 0; i < loss.size(); ++i) object[outcome.components[i]] = loss[i];
    object["sum"] = totalLoss(loss);
    if (!outcome.squared_metres) return object;
    object["rmse_m"] = rootMean(totalLoss(loss), outcome.parts.size());
    for (std::size_t i = 0; i < loss.size(); ++i) {
        object["rmse_" + outcome.components[i] + "_m"] = rootMean(loss[i], outcome.parts.size());
    }
    return object;
}

ordered_json parameterJson(const TunedParameter& p) {
    ordered_json settings = ordered_json::array();
    for (const UsedSetting& setting : p.settings) {
        settings.push_back({{"key", setting.key}, {"before", setting.requested}, {"after", setting.used}});
    }
    ordered_json on_bound = nullptr;
    if (p.on_bound != Bound::None) on_bound = p.on_bound == Bound::Lower ? "lower" : "upper";
    return {{"name", p.name},
            {"settings", std::move(settings)},
            {"lower", p.lower},
            {"upper", p.upper},
            {"on_bound", std::move(on_bound)},
            {"flat_from", p.flat_from},
            {"flat_to", p.flat_to},
            {"flat_share", kFlatShare},
            {"identified", p.identified},
            {"left_out_least", optionalNumber(p.left_out_least)},
            {"left_out_greatest", optionalNumber(p.left_out_greatest)}};
}

ordered_json partJson(const TuneOutcome& outcome, const PartOutcome& part) {
    const auto loss = [&](const std::vector<double>& components) -> ordered_json {
        if (components.empty()) return nullptr;
        ordered_json object;
        for (std::size_t i = 0; i < components.size(); ++i) object[outcome.components[i]] = components[i];
        object["sum"] = totalLoss(components);
        if (outcome.squared_metres) object["error_m"] = rootMean(totalLoss(components), 1);
        return object;
    };
    return {{"name", part.part.name},
            {"mark", part.part.mark},
            {"before", loss(part.before)},
            {"after", loss(part.after)},
            {"left_out", loss(part.left_out)}};
}

/// Parameters that are tuned, or were set to something else than their default before.
ordered_json overlay(const TuneOutcome& outcome) {
    const json defaults = json::parse(toJson(PipelineConfig{})).flatten();
    const ordered_json tuned = ordered_json::parse(toJson(outcome.tuned));
    const auto isTuned = [&](const std::string& pointer) {
        std::string key = pointer.substr(1);
        std::replace(key.begin(), key.end(), '/', '.');
        if (key == "fusion.method") return true;
        return std::any_of(outcome.parameters.begin(), outcome.parameters.end(), [&](const auto& p) {
            return std::any_of(p.settings.begin(), p.settings.end(),
                               [&](const UsedSetting& setting) { return setting.key == key; });
        });
    };
    ordered_json document{{"format", "terrawalk-config 1"}};
    const ordered_json flat = tuned.flatten();
    for (const auto& [pointer, value] : flat.items()) {
        // The seed of a report is no part of a method.
        if (pointer == "/seed" || pointer.starts_with("/tuning")) continue;
        if (!isTuned(pointer) && defaults.contains(pointer) && defaults.at(pointer) == value) continue;
        document[ordered_json::json_pointer(pointer)] = value;
    }
    return document;
}

std::string counted(std::size_t n, const std::string& what) {
    return fmt::format("{} {}{}", n, what, n == 1 ? "" : "s");
}

std::string lossLine(const TuneOutcome& outcome, const char* label, double loss, std::size_t parts) {
    std::string line = fmt::format("  {:<26}{:>12.5g} {}", label, loss, outcome.loss_unit);
    if (outcome.squared_metres) line += fmt::format(", RMSE {:.4f} m", rootMean(loss, parts));
    return line;
}

}  // namespace

TuningRecord tuningRecord(const TuneOutcome& outcome, const std::string& survey_name) {
    TuningRecord record;
    record.survey = survey_name;
    record.program = programVersion();
    record.method = outcome.method;
    record.optimiser = name(outcome.options.optimiser);
    record.seed = outcome.options.seed;
    record.population = outcome.options.population;
    record.iterations = outcome.options.iterations;
    record.evaluations = outcome.evaluations();
    record.loss = outcome.loss_meaning + (outcome.loss_unit.empty() ? "" : ", " + outcome.loss_unit);
    record.loss_before = totalLoss(outcome.before);
    record.loss_after = totalLoss(outcome.after);
    if (outcome.held_out) {
        record.left_out_before = outcome.held_out->before;
        record.left_out_after = outcome.held_out->after;
    }
    record.holds_out_better = outcome.holds_out_better;
    record.decision = outcome.decision;
    record.warnings = outcome.warnings;
    record.marks = outcome.marks;
    return record;
}

ordered_json tuningJson(const TuningRecord& record) {
    ordered_json marks = ordered_json::array();
    for (const ControlMark& mark : record.marks) {
        marks.push_back({{"name", mark.name}, {"enu_m", {mark.enu_m.x(), mark.enu_m.y(), mark.enu_m.z()}}});
    }
    return {{"program", record.program},
            {"survey", record.survey},
            {"method", record.method},
            {"optimiser", record.optimiser},
            {"seed", record.seed},
            {"population", record.population},
            {"iterations", record.iterations},
            {"evaluations", record.evaluations},
            {"loss", record.loss},
            {"loss_before", record.loss_before},
            {"loss_after", record.loss_after},
            {"left_out_before", optionalNumber(record.left_out_before)},
            {"left_out_after", optionalNumber(record.left_out_after)},
            {"holds_out_better", record.holds_out_better},
            {"in_use", record.in_use},
            {"decision", record.decision},
            {"warnings", record.warnings},
            {"marks", std::move(marks)}};
}

TuningRecord tuningOf(const json& section) {
    TuningRecord record;
    section.at("program").get_to(record.program);
    section.at("survey").get_to(record.survey);
    section.at("method").get_to(record.method);
    section.at("optimiser").get_to(record.optimiser);
    section.at("seed").get_to(record.seed);
    section.at("population").get_to(record.population);
    section.at("iterations").get_to(record.iterations);
    section.at("evaluations").get_to(record.evaluations);
    section.at("loss").get_to(record.loss);
    record.loss_before = numberOf(section.at("loss_before"));
    record.loss_after = numberOf(section.at("loss_after"));
    record.left_out_before = optionalOf(section.at("left_out_before"));
    record.left_out_after = optionalOf(section.at("left_out_after"));
    section.at("holds_out_better").get_to(record.holds_out_better);
    section.at("in_use").get_to(record.in_use);
    section.at("decision").get_to(record.decision);
    section.at("warnings").get_to(record.warnings);
    for (const json& mark : section.at("marks")) {
        ControlMark& one = record.marks.emplace_back();
        mark.at("name").get_to(one.name);
        const auto enu_m = mark.at("enu_m").get<std::array<double, 3>>();
        one.enu_m = {enu_m[0], enu_m[1], enu_m[2]};
    }
    return record;
}

std::string tuneFileText(const TuneOutcome& outcome, const std::string& survey_name) {
    ordered_json section = tuningJson(tuningRecord(outcome, survey_name));
    section["optimiser_requested"] = name(outcome.options.optimiser);
    section["restarts"] = outcome.options.restarts;
    section["search_notes"] = outcome.search_notes;
    section["evaluations_spent"] = {{"search", outcome.search_evaluations},
                                    {"left_out", outcome.held_out_evaluations},
                                    {"profile", outcome.profile_evaluations}};
    section["before"] = lossJson(outcome, outcome.before);
    section["after"] = lossJson(outcome, outcome.after);
    section["left_out"] = nullptr;
    if (outcome.held_out) {
        section["left_out"] = {{"groups", outcome.held_out->groups},
                               {"evaluations_each", outcome.held_out->evaluations_each},
                               {"population", outcome.held_out->population},
                               {"before", outcome.held_out->before},
                               {"after", outcome.held_out->after},
                               {"gain", outcome.held_out->before - outcome.held_out->after},
                               {"gain_standard_error", outcome.held_out->gain_standard_error}};
    }
    section["parameters"] = ordered_json::array();
    for (const TunedParameter& p : outcome.parameters) section["parameters"].push_back(parameterJson(p));
    section["parts"] = ordered_json::array();
    for (const PartOutcome& part : outcome.parts) section["parts"].push_back(partJson(outcome, part));
    section["convergence"] = ordered_json::array();
    for (const ConvergencePoint& point : outcome.convergence) {
        section["convergence"].push_back({point.evaluations, point.best_loss});
    }
    ordered_json document = overlay(outcome);
    document["tuning"] = std::move(section);
    return document.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

std::string toJson(const TuneOutcome& outcome, const std::string& survey_name,
                   const std::filesystem::path& file) {
    const ordered_json document{{"format", "terrawalk-tuning 1"},
                                {"parameters", file.string()},
                                {"tuning", tuningJson(tuningRecord(outcome, survey_name))}};
    return document.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

std::string toText(const TuneOutcome& outcome) {
    const std::size_t n = outcome.parts.size();
    std::string text = fmt::format(
        "Method {}, optimiser {}, population {}, {}, {}, seed {}: {} evaluations, {} in all\n",
        outcome.method, name(outcome.options.optimiser), outcome.options.population,
        counted(outcome.options.iterations, "iteration"), counted(outcome.options.restarts, "start"),
        outcome.options.seed, outcome.search_evaluations, outcome.evaluations());
    text += lossLine(outcome, "loss before", totalLoss(outcome.before), n) + "\n";
    text += lossLine(outcome, "loss after", totalLoss(outcome.after), n) + "\n";
    if (outcome.held_out) {
        text += lossLine(outcome, "on parts left out, before", outcome.held_out->before, n) + "\n";
        text += lossLine(outcome, "on parts left out, after", outcome.held_out->after, n) + "\n";
    }
    std::size_t width = 0;
    for (const TunedParameter& p : outcome.parameters) width = std::max(width, p.name.size());
    for (const TunedParameter& p : outcome.parameters) {
        text += fmt::format("  {:<{}}  {:>9.3g} -> {:<9.3g}\n", p.name, width, p.before, p.after);
    }
    for (const std::string& warning : outcome.warnings) text += "warning: " + warning + "\n";
    return text + outcome.decision + "\n";
}

}  // namespace terrawalk
