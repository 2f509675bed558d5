#pragma once

#include <memory>

#include "app/pipeline/process.hpp"
#include "app/pipeline/survey_map.hpp"
#include "survey/survey.hpp"

namespace terrawalk::test {

/// A shipped survey with all that the pipeline makes of it.
struct ProcessedSample {
    std::shared_ptr<const Survey> survey;
    std::shared_ptr<const SurveyMap> map;
    std::shared_ptr<const Products> products;
};

/// Reads and processes a shipped survey; ends the program where that fails.
/// @param name  of its folder, such as "quick_plot"
[[nodiscard]] ProcessedSample processedSample(const std::string& name);

}  // namespace terrawalk::test
