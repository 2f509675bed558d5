#pragma once

#include <string>
#include <vector>

#include "survey/result.hpp"
#include "survey/survey_report.hpp"

namespace terrawalk {

// The report's files as text. Pure: the same values give the same bytes. The functions that write them to
// disk stand in io/write_products.hpp.

/// One row for each residual: stage, quantity, mark, role, run, mark_{e,n,u}_m, d_{e,n,u}_m, sigma_{e,n,u}_m,
/// used_by_estimator, slope, cover (open, vegetated or empty), possible_blunder. Differences are product -
/// mark; what is missing is empty. Micrometres, RFC 4180 quoting, newline at each line's end.
[[nodiscard]] std::string residualsCsv(const std::vector<Residual>& residuals);

/// Every value of the report. Keys stand in this order; numbers are shortest decimals that read back to the
/// same bits; what is missing is null. Lengths are metres; angles do not occur.
///
///     format              "terrawalk-report 1"
///     survey, program_version, method, seed
///     figures             [{label, value, detail}]           the three figures, as text
///     statements, limitations, warnings                      [sentence]
///     headline            {stage, quantity, role} or null    the group that the first figure quotes
///     accuracy            [{stage, quantity, role, east, north, up, horizontal, up_coverage,
///     nssda_vertical_m,
///                         nssda_horizontal_m}]
///         east ...        null or {n, marks, mean_m, sd_m, rmse_m, rmse_95_m: [low, high] or null, mae_m,
///         median_m,
///                         nmad_m, error68_m, error95_m, largest_m, and with 95 % intervals [low, high] or
///                         null median_95_m, nmad_95_m, error95_95_m; error95_95_note says why there is none}
///         up_coverage     null or {n, within_1_96_sigma, mean_square}: of error over sigma
///     strata              [{name, up}]                       of the headline group
///     slope_leakage       null or {plan_rmse_m, rmse_m, share, n}
///     slope_leakage_unknown  why it is null, part of a sentence; else null
///     vertical_class      null without a class asked for; {class_m, check_marks, rmse_v_m, marks_own_error_m
///                         (or null), met, vegetated: null or {check_marks, rmse_v_m}}
///     residuals           [{stage, quantity, mark, role, run, mark_enu_m, difference_enu_m, sigma_enu_m,
///                         used_by_estimator, slope, cover, possible_blunder}]  vectors are [e, n, u]
///     missing_residuals   [{stage, quantity, mark, role, run}]
///     marks               [{name, role, enu_m, sigma_h_m, sigma_v_m}]
///     surface             {method, method_requested, method_used, cross_validation: null or {seed, ranking,
///                         scores: [{method, hold_out, points_compared, rmse_m, mean_absolute_m,
///                         error95_m}]}, breaklines, terrace_edges: {count, length_m, median_step_m,
///                         median_location_sigma_m}, notes, points, triangles, longest_edge_m, area_m2,
///                         cell_m, columns, rows, cells_with_height, lowest_m, highest_m, crs,
///                         vertical_datum}
///     occupancy           null or as occupancyJson()
///     runs                [{id, kind, rows_read, epochs, repeated_lines, late_lines, cut_off_line (or null),
///                         duration_s, distance_m, fixes: [{reason, count}], sensors: [{sensor, offered,
///                         used, down_weighted, rejections: [{reason, count}]}], ground_points_used,
///                         ground_points_rejected: [{reason, count}], notes, track_enu_m}]
///     tuning              null or {in_use, holds_out_better, decision, survey, program, method, optimiser,
///     seed,
///                         population, iterations, evaluations, loss, loss_before, loss_after,
///                         left_out_before, left_out_after (or null), warnings, marks: [name]}
///     settings            [{key, requested, used}]
///     inputs              [{path, bytes, sha256}]
[[nodiscard]] std::string reportJson(const SurveyReport& report);

/// What every report says in the place of an interval of the 95 % quantile that so few marks do not tell;
/// empty where they do.
[[nodiscard]] std::string whyNoError95Interval(const ErrorStatistics& statistics);

/// The numbers of a map of the space as a JSON object, the same in report.json and in what `terrawalk
/// occupancy` writes.
[[nodiscard]] std::string occupancyJson(const OccupancySummary& summary);

/// The report as one page of HTML that is well-formed XML too: styles and drawings inside, no script, nothing
/// fetched.
[[nodiscard]] std::string reportHtml(const SurveyReport& report);

/// That page on paper: A4, all that it folds opened, drawings as vectors, fonts of the machine embedded. The
/// same values on one machine give the same bytes. Errors: System.
[[nodiscard]] Result<std::string> reportPdf(const SurveyReport& report);

}  // namespace terrawalk
