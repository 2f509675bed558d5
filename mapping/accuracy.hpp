#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "survey/survey_report.hpp"

namespace terrawalk {

/// One difference and the mark that it belongs to.
struct MarkDifference {
    std::string mark;
    double difference_m = 0.0;
};

/// Error measures of differences, each on a mark of its own. Needs at least one; all finite.
/// The 95 % interval of the RMSE is a percentile bootstrap that draws marks, so that ten runs over one mark
/// count as one mark. The same differences in the same order with the same seed give the same bits on every
/// machine. Pure; safe from any thread.
[[nodiscard]] ErrorStatistics errorStatistics(const std::vector<double>& differences_m, std::uint64_t seed);
/// The same where several differences may belong to one mark.
[[nodiscard]] ErrorStatistics errorStatistics(const std::vector<MarkDifference>& differences,
                                              std::uint64_t seed);

/// One group for each stage, quantity and role that has something to count: stages in their order, within
/// them quantities, within them check before control. Residuals that the estimator was tied to are never
/// counted, axes that are missing (not finite) neither. Pure; safe from any thread.
[[nodiscard]] std::vector<AccuracyGroup> accuracyGroups(const std::vector<Residual>& residuals,
                                                        std::uint64_t seed);

/// RMSE of a product whose marks are not perfect: the root of the sum of both squares.
/// Source: ASPRS Positional Accuracy Standards, Edition 2, section 7.11.
[[nodiscard]] double rmseWithMarkError_m(double rmse_fit_m, double sigma_marks_m);

}  // namespace terrawalk
