#pragma once

#include <filesystem>
#include <stop_token>
#include <string>
#include <vector>

#include "app/pipeline/marks_on_map.hpp"
#include "survey/progress.hpp"
#include "survey/result.hpp"
#include "survey/survey_report.hpp"

namespace terrawalk {

/// Errors of a DEM against marks.
struct ValidateRequest {
    std::filesystem::path dem;
    MarkSource marks;
    std::filesystem::path uncertainty;  ///< raster of one sigma, to be tested too; empty: none
    std::filesystem::path output;   ///< table of the differences (.csv); empty: none. JSON goes beside it.
    std::uint64_t seed = 1;         ///< of the bootstrap
    double vertical_class_m = 0.0;  ///< RMSE_V that the DEM is to be tested for; 0: none
};

struct ValidateOutcome {
    ValidateRequest request;
    std::string unit;
    SurveyReport report;  ///< marks, residuals, accuracy, statements and limitations; lengths in metres
    std::vector<std::filesystem::path> files;
};

/// Compares the DEM, bilinear between cell centres, with each mark. Marks certify only a DEM that was not
/// made from them, which the program cannot see; control marks are therefore counted apart. A DEM in feet is
/// taken to metres. Errors: as marksOnMap(); BadData when no mark meets a height; System; Cancelled.
[[nodiscard]] Result<ValidateOutcome> validateDem(const ValidateRequest& request, Progress& progress,
                                                  std::stop_token stop);

[[nodiscard]] std::string toText(const ValidateOutcome& outcome);
[[nodiscard]] std::string toJson(const ValidateOutcome& outcome);

}  // namespace terrawalk
