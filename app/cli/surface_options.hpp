#pragma once

#include <CLI/CLI.hpp>

#include "app/pipeline/surface.hpp"
#include "app/pipeline/volume_job.hpp"

namespace terrawalk {

void addSurfaceOptions(CLI::App& command, SurfaceRequest& request);
void addVolumeOptions(CLI::App& command, VolumeRequest& request);

}  // namespace terrawalk
