#pragma once

#include <CLI/CLI.hpp>

#include "app/pipeline/new_survey_job.hpp"

namespace terrawalk {

void addNewSurveyOptions(CLI::App& command, NewSurveyRequest& request);

}  // namespace terrawalk
