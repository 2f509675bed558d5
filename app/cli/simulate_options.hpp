#pragma once

#include <CLI/CLI.hpp>

#include "app/pipeline/jobs.hpp"

namespace terrawalk {

void addSimulationOptions(CLI::App& command, SimulationOptions& options);

}  // namespace terrawalk
