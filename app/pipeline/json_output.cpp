#include "app/pipeline/json_output.hpp"

#include <nlohmann/json.hpp>

namespace terrawalk {

namespace {

using nlohmann::ordered_json;

std::string text(const ordered_json& document) {
    return document.dump(2, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

std::string_view kindName(ErrorKind kind) {
    switch (kind) {
        case ErrorKind::Usage:
            return "usage";
        case ErrorKind::BadData:
            return "bad data";
        case ErrorKind::Cancelled:
            return "cancelled";
        case ErrorKind::System:
            return "system";
    }
    return "";
}

}  // namespace

std::string errorJson(const Error& error) {
    return text({{"error",
                  {{"kind", kindName(error.kind)},
                   {"message", error.message},
                   {"file", error.file.string()},
                   {"line", error.line},
                   {"cure", error.cure}}}});
}

std::string summaryJson(const Products& products, const std::filesystem::path& output) {
    ordered_json figures = ordered_json::array();
    for (const KeyFigure& figure : products.report.figures) {
        figures.push_back({{"label", figure.label}, {"value", figure.value}, {"detail", figure.detail}});
    }
    return text({{"format", "terrawalk-summary 1"},
                 {"survey", products.report.survey_name},
                 {"dem", (output / "dem.tif").string()},
                 {"mesh", (output / "surface.ply").string()},
                 {"report", (output / "report.html").string()},
                 {"report_json", (output / "report.json").string()},
                 {"figures", std::move(figures)},
                 {"limitations", products.report.limitations}});
}

std::string simulationJson(const SimulationOptions& options, const std::filesystem::path& output) {
    return text({{"format", "terrawalk-simulation 1"},
                 {"survey", (output / "survey.json").string()},
                 {"truth", (output / "truth").string()},
                 {"seed", options.seed}});
}

std::string parametersJson() {
    ordered_json parameters = ordered_json::array();
    for (const ParameterInfo& p : describeParameters()) {
        parameters.push_back(
            {{"key", p.key}, {"default", p.default_value}, {"permitted", p.range}, {"meaning", p.meaning}});
    }
    return text({{"parameters", std::move(parameters)}});
}

std::string validationJson(const std::filesystem::path& file) {
    return text({{"file", file.string()}, {"valid", true}});
}

}  // namespace terrawalk
