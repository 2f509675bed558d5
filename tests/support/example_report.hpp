#pragma once

#include <cstdint>

#include "survey/survey_report.hpp"

namespace terrawalk::test {

/// What a made-up report is about. Its numbers come from the seed alone.
struct ExampleSurvey {
    std::size_t fixed_point_runs = 16;
    std::size_t area_epochs = 9000;  ///< 0: no area run
    std::size_t check_marks = 60;
    std::size_t control_marks = 5;
    double sigma_before_m = 0.6;
    double sigma_after_m = 0.2;
    std::uint64_t seed = 7;
};

/// A report as the pipeline fills it, up to withAccuracy: accuracy, figures and statements are still empty.
[[nodiscard]] SurveyReport exampleReport(const ExampleSurvey& survey);

}  // namespace terrawalk::test
