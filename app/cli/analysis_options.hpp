#pragma once

#include <CLI/CLI.hpp>

#include "app/pipeline/contour_job.hpp"
#include "app/pipeline/derive_job.hpp"
#include "app/pipeline/difference_job.hpp"
#include "app/pipeline/profile_job.hpp"
#include "app/pipeline/validate_job.hpp"
#include "app/pipeline/walk_advice_job.hpp"

namespace terrawalk {

// Commands that look at a DEM.

void addContourOptions(CLI::App& command, ContourRequest& request);
void addDifferenceOptions(CLI::App& command, DifferenceRequest& request);
void addProfileOptions(CLI::App& command, ProfileRequest& request);
void addDeriveOptions(CLI::App& command, DeriveRequest& request);
void addValidateOptions(CLI::App& command, ValidateRequest& request);
void addWalkAdviceOptions(CLI::App& command, WalkAdviceRequest& request);

}  // namespace terrawalk
