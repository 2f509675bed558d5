#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "survey/survey_report.hpp"

namespace terrawalk {

/// One difference and the mark that it belongs to.
struct MarkDifference {
    std::string mark;
    double difference_m = 0.0;
};

/// Error measures of differences, each on a mark of its own. Needs at least one; all finite.
/// The 95 % intervals are percentile bootstraps that draw marks, so that ten runs over one mark
/// count as one mark. For normal errors they hold the truth in 90 to 98 % of cases. That of the 95 % quantile
/// is of order statistics, see quantilePlaces95(), and holds it in at least 95 %; it needs 72 marks. The same
/// differences in the same order with the same seed give the same bits on every machine. Pure; safe from any
/// thread.
[[nodiscard]] ErrorStatistics errorStatistics(const std::vector<double>& differences_m, std::uint64_t seed);
/// The same where several differences may belong to one mark.
[[nodiscard]] ErrorStatistics errorStatistics(const std::vector<MarkDifference>& differences,
                                              std::uint64_t seed);

/// One group for each stage, quantity and role that has something to count: stages in their order, within
/// them quantities, within them check before control. Residuals that the estimator was tied to are never
/// counted, axes that are missing (not finite) neither. Pure; safe from any thread.
[[nodiscard]] std::vector<AccuracyGroup> accuracyGroups(const std::vector<Residual>& residuals,
                                                        std::uint64_t seed);

/// Accuracy at 95 % confidence of the National Standard for Spatial Data Accuracy (FGDC-STD-007.3-1998),
/// errors taken for normal and unbiased: 1.9600 RMSE_z in height; in plan 1.7308 RMSE_r where both axes have
/// one RMSE, 2.4477 times their mean where the smaller is at least 0.6 of the greater, nothing beyond. Pure.
[[nodiscard]] double nssdaVertical_m(double rmse_z_m);
[[nodiscard]] std::optional<double> nssdaHorizontal_m(double rmse_x_m, double rmse_y_m);

/// The heights of a group by the slope of the surface at the marks - tread, slope, riser - and by what grows
/// there, where it is known. None that is empty. The limit of the treads is the slope up to which the ASPRS
/// standard wants check marks. Pure.
[[nodiscard]] std::vector<AccuracyStratum> accuracyStrata(const std::vector<Residual>& residuals,
                                                          const AccuracyGroup& group, std::uint64_t seed);

/// Without slopes at the group's marks, or without stands on marks, check marks before control, that tell the
/// error in plan, there is none: why, as part of a sentence. Pure.
[[nodiscard]] tl::expected<SlopeLeakage, std::string> slopeLeakage(const std::vector<Residual>& residuals,
                                                                   const std::vector<AccuracyGroup>& groups,
                                                                   const AccuracyGroup& group);

/// The residuals with those flagged whose height difference is more than kBlunderMultiple times
/// `vertical_class_m`, for heights of the surface; without a class (0), and for what is no product, times the
/// RMSE of the others of its group (stage, quantity, role), where groups of fewer than five flag none. Pure.
/// Source: ASPRS Positional Accuracy Standards, Edition 2, section 7.2.
[[nodiscard]] std::vector<Residual> withBlundersFlagged(std::vector<Residual> residuals,
                                                        double vertical_class_m = 0.0);
inline constexpr double kBlunderMultiple = 3.0;

/// The heights of the surface at check marks against a class; nothing for another group, without a class (0),
/// and where all marks stand among plants. Pure.
[[nodiscard]] std::optional<VerticalClassTest> verticalClassTest(const std::vector<Residual>& residuals,
                                                                 const std::vector<ControlMark>& marks,
                                                                 const AccuracyGroup& group,
                                                                 double vertical_class_m);
inline constexpr std::size_t kAsprsCheckMarks = 30;  ///< that Edition 2 asks for at least

/// Whether a residual counts in the heights of a group.
[[nodiscard]] bool countsIn(const Residual& residual, const AccuracyGroup& group);

/// RMSE of a product whose marks are not perfect: the root of the sum of both squares.
/// Source: ASPRS Positional Accuracy Standards, Edition 2, section 7.11.
[[nodiscard]] double rmseWithMarkError_m(double rmse_fit_m, double sigma_marks_m);

}  // namespace terrawalk
