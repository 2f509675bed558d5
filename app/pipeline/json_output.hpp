#pragma once

#include <filesystem>
#include <string>

#include "app/pipeline/process.hpp"
#include "fusion/simulation.hpp"
#include "survey/result.hpp"

namespace terrawalk {

// What the commands print with --json; each a JSON document that ends with a line end.

[[nodiscard]] std::string errorJson(const Error& error);
[[nodiscard]] std::string summaryJson(const Products& products, const std::filesystem::path& output);
[[nodiscard]] std::string simulationJson(const SimulationOptions& options,
                                         const std::filesystem::path& output);
[[nodiscard]] std::string parametersJson();
[[nodiscard]] std::string validationJson(const std::filesystem::path& file);

}  // namespace terrawalk
