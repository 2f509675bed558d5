#pragma once

#include <CLI/CLI.hpp>

#include "app/pipeline/export_job.hpp"

namespace terrawalk {

void addExportOptions(CLI::App& command, ExportRequest& request);

}  // namespace terrawalk
