#pragma once

#include <CLI/CLI.hpp>

#include "app/pipeline/export_job.hpp"
#include "app/pipeline/occupancy_job.hpp"

namespace terrawalk {

// Commands that work on the folder of a processed survey.

void addExportOptions(CLI::App& command, ExportRequest& request);
void addOccupancyOptions(CLI::App& command, OccupancyRequest& request);

}  // namespace terrawalk
