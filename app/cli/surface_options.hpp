#pragma once

#include <CLI/CLI.hpp>

#include "app/pipeline/surface.hpp"

namespace terrawalk {

void addSurfaceOptions(CLI::App& command, SurfaceRequest& request);

}  // namespace terrawalk
