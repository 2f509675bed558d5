#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

#include "io/output_folder.hpp"
#include "io/report_text.hpp"
#include "io/write_products.hpp"

namespace terrawalk {

namespace {

using Json = nlohmann::ordered_json;

/// A list of values, each taken to JSON; an array also when there is none.
template <class T, class ToJson>
Json listOf(const std::vector<T>& values, ToJson to_json) {
    Json list = Json::array();
    for (const T& value : values) list.push_back(to_json(value));
    return list;
}

Json jsonNumber(double value) {
    return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json jsonVector(const Eigen::Vector3d& v) {
    return Json::array({jsonNumber(v.x()), jsonNumber(v.y()), jsonNumber(v.z())});
}

Json intervalJson(const std::optional<ConfidenceInterval>& interval) {
    if (!interval) return nullptr;
    return Json::array({jsonNumber(interval->low_m), jsonNumber(interval->high_m)});
}

Json optionalJson(const std::optional<double>& value) {
    return value ? jsonNumber(*value) : Json(nullptr);
}

Json statisticsJson(const std::optional<ErrorStatistics>& s) {
    if (!s) return nullptr;
    return {{"n", s->n},
            {"marks", s->marks},
            {"mean_m", jsonNumber(s->mean_m)},
            {"sd_m", s->sd_m ? jsonNumber(*s->sd_m) : Json(nullptr)},
            {"rmse_m", jsonNumber(s->rmse_m)},
            {"rmse_95_m", intervalJson(s->rmse_95)},
            {"mae_m", jsonNumber(s->mae_m)},
            {"median_m", jsonNumber(s->median_m)},
            {"median_95_m", intervalJson(s->median_95)},
            {"nmad_m", jsonNumber(s->nmad_m)},
            {"nmad_95_m", intervalJson(s->nmad_95)},
            {"error68_m", jsonNumber(s->error68_m)},
            {"error95_m", jsonNumber(s->error95_m)},
            {"error95_95_m", intervalJson(s->error95_95)},
            {"error95_95_note", s->error95_95 ? Json(nullptr) : Json(whyNoError95Interval(*s))},
            {"largest_m", jsonNumber(s->largest_m)}};
}

Json coverageJson(const SigmaCoverage& coverage) {
    return {{"n", coverage.n},
            {"within_1_96_sigma", coverage.within},
            {"mean_square", jsonNumber(coverage.mean_square)}};
}

Json groupNameJson(const AccuracyGroup& group) {
    return {{"stage", name(group.stage)}, {"quantity", name(group.quantity)}, {"role", name(group.role)}};
}

Json groupJson(const AccuracyGroup& group) {
    Json json = groupNameJson(group);
    json["east"] = statisticsJson(group.east);
    json["north"] = statisticsJson(group.north);
    json["up"] = statisticsJson(group.up);
    json["horizontal"] = statisticsJson(group.horizontal);
    json["up_coverage"] = nullptr;
    if (group.up_coverage) json["up_coverage"] = coverageJson(*group.up_coverage);
    json["nssda_vertical_m"] = optionalJson(group.nssda_vertical_m);
    json["nssda_horizontal_m"] = optionalJson(group.nssda_horizontal_m);
    return json;
}

Json headlineJson(const SurveyReport& report) {
    return report.headline ? groupNameJson(report.accuracy.at(*report.headline)) : Json(nullptr);
}

Json stratumJson(const AccuracyStratum& stratum) {
    return {{"name", stratum.name}, {"up", statisticsJson(stratum.up)}};
}

Json leakageJson(const std::optional<SlopeLeakage>& leakage) {
    if (!leakage) return nullptr;
    return {{"plan_rmse_m", leakage->plan_rmse_m},
            {"rmse_m", leakage->rmse_m},
            {"share", leakage->share},
            {"n", leakage->n}};
}

Json textJson(const std::string& text) {
    return text.empty() ? Json(nullptr) : Json(text);
}

Json classTestJson(const std::optional<VerticalClassTest>& test) {
    if (!test) return nullptr;
    Json json{{"class_m", test->class_m},
              {"check_marks", test->marks},
              {"rmse_v_m", test->rmse_v_m},
              {"marks_own_error_m", test->mark_sigma_m > 0.0 ? Json(test->mark_sigma_m) : Json(nullptr)},
              {"met", test->met()},
              {"vegetated", nullptr}};
    if (test->vegetated_marks > 0) {
        json["vegetated"] = {{"check_marks", test->vegetated_marks}, {"rmse_v_m", test->vegetated_rmse_v_m}};
    }
    return json;
}

Json residualJson(const Residual& r) {
    return {{"stage", name(r.stage)},
            {"quantity", name(r.quantity)},
            {"mark", r.mark},
            {"role", name(r.role)},
            {"run", r.run},
            {"mark_enu_m", jsonVector(r.mark_enu_m)},
            {"difference_enu_m", jsonVector(r.difference_enu_m)},
            {"sigma_enu_m", jsonVector(r.sigma_enu_m)},
            {"used_by_estimator", r.used_by_estimator},
            {"slope", jsonNumber(r.slope)},
            {"cover", name(r.cover)},
            {"possible_blunder", r.possible_blunder}};
}

Json missingJson(const MissingResidual& m) {
    return {{"stage", name(m.stage)},
            {"quantity", name(m.quantity)},
            {"mark", m.mark},
            {"role", name(m.role)},
            {"run", m.run}};
}

Json markJson(const ControlMark& mark) {
    return {{"name", mark.name},
            {"role", name(mark.role)},
            {"enu_m", jsonVector(mark.enu_m)},
            {"sigma_h_m", jsonNumber(mark.sigma_h_m)},
            {"sigma_v_m", jsonNumber(mark.sigma_v_m)}};
}

Json comparisonJson(const std::optional<InterpolationComparison>& comparison) {
    if (!comparison) return nullptr;
    return {{"seed", comparison->seed},
            {"ranking", comparison->ranking},
            {"scores", listOf(comparison->scores, [](const InterpolationScore& s) {
                 return Json{{"method", s.method},
                             {"hold_out", s.hold_out},
                             {"points_compared", s.compared},
                             {"rmse_m", jsonNumber(s.rmse_m)},
                             {"mean_absolute_m", jsonNumber(s.mean_absolute_m)},
                             {"error95_m", jsonNumber(s.error95_m)}};
             })}};
}

Json edgesJson(const TerraceEdgeSummary& e) {
    return {{"count", e.count},
            {"length_m", jsonNumber(e.length_m)},
            {"median_step_m", jsonNumber(e.median_step_m)},
            {"median_location_sigma_m", jsonNumber(e.median_location_sigma_m)}};
}

Json uncertaintyJson(const std::optional<UncertaintySummary>& u) {
    if (!u) return nullptr;
    return {{"median_m", u->median_m},
            {"error95_m", u->error95_m},
            {"cells_measured", u->measured},
            {"cells_interpolated", u->interpolated},
            {"cells_extrapolated", u->extrapolated},
            {"interpolation_coefficients", u->coefficients},
            {"own_variance", u->own_variance},
            {"at_point_m", u->at_point_m},
            {"greatest_distance_m", u->greatest_distance_m},
            {"correlation_range_m", u->correlation_range_m},
            {"left_out", coverageJson(u->left_out)}};
}

Json variogramJson(const std::optional<VariogramSummary>& v) {
    if (!v) return nullptr;
    return {{"model", v->model},
            {"nugget_m2", jsonNumber(v->nugget_m2)},
            {"sill_m2", jsonNumber(v->sill_m2)},
            {"range_m", jsonNumber(v->range_m)},
            {"exponent", v->exponent ? Json(*v->exponent) : Json(nullptr)},
            {"pairs", v->pairs}};
}

Json surfaceJson(const SurfaceReport& s) {
    return {{"method", s.method},
            {"method_requested", s.method_requested},
            {"method_used", s.method_used},
            {"cross_validation", comparisonJson(s.comparison)},
            {"breaklines", s.breaklines},
            {"terrace_edges", edgesJson(s.terrace_edges)},
            {"uncertainty", uncertaintyJson(s.uncertainty)},
            {"variogram", variogramJson(s.variogram)},
            {"notes", s.notes},
            {"points", s.points},
            {"triangles", s.triangles},
            {"longest_edge_m", jsonNumber(s.longest_edge_m)},
            {"area_m2", jsonNumber(s.area_m2)},
            {"cell_m", jsonNumber(s.cell_m)},
            {"columns", s.columns},
            {"rows", s.rows},
            {"cells_with_height", s.cells_with_height},
            {"lowest_m", jsonNumber(s.lowest_m)},
            {"highest_m", jsonNumber(s.highest_m)},
            {"crs", s.crs},
            {"vertical_datum", s.vertical_datum}};
}

Json spaceJson(const OccupancySummary& o) {
    return {{"octree_origin_m", jsonVector(o.origin_m)},
            {"voxel_m", o.voxel_m},
            {"greatest_range_m", o.greatest_range_m},
            {"ground_layer_m", o.ground_layer_m},
            {"greatest_height_m", o.greatest_height_m},
            {"rays", o.rays},
            {"ground_points_left_out", o.left_out},
            {"hits_below_ground", o.below_ground},
            {"free_m3", o.free_m3},
            {"occupied_m3", o.occupied_m3},
            {"ground_cells", o.ground_cells},
            {"cells_known_free", o.cells_known_free},
            {"median_free_height_m", o.median_free_height_m},
            {"cells_with_obstacle", o.cells_with_obstacle}};
}

template <class Reason>
Json reasonsJson(const std::vector<Reason>& reasons) {
    return listOf(reasons, [](const Reason& r) { return Json{{"reason", r.reason}, {"count", r.count}}; });
}

Json sensorJson(const SensorUse& s) {
    return {{"sensor", s.sensor},
            {"offered", s.offered},
            {"used", s.used},
            {"down_weighted", s.down_weighted},
            {"rejections", reasonsJson(s.rejections)}};
}

Json runJson(const RunReport& run) {
    return {{"id", run.id},
            {"kind", name(run.kind)},
            {"rows_read", run.rows_read},
            {"epochs", run.epochs},
            {"repeated_lines", run.repeated_lines},
            {"late_lines", run.late_lines},
            {"cut_off_line", run.cut_off_line > 0 ? Json(run.cut_off_line) : Json(nullptr)},
            {"duration_s", jsonNumber(run.duration_s)},
            {"gaps", run.gaps},
            {"longest_gap_s", run.longest_gap_s},
            {"distance_m", jsonNumber(run.distance_m)},
            {"fixes", reasonsJson(run.fixes)},
            {"sensors", listOf(run.sensors, sensorJson)},
            {"ground_points_used", run.ground_points_used},
            {"ground_points_rejected", reasonsJson(run.ground_points_rejected)},
            {"notes", run.notes},
            {"track_enu_m", listOf(run.track_enu_m, jsonVector)}};
}

Json figureJson(const KeyFigure& f) {
    return {{"label", f.label}, {"value", f.value}, {"detail", f.detail}};
}

Json settingJson(const UsedSetting& s) {
    return {{"key", s.key}, {"requested", s.requested}, {"used", s.used}};
}

Json tuningJson(const std::optional<TuningRecord>& tuning) {
    if (!tuning) return nullptr;
    const TuningRecord& t = *tuning;
    return {{"in_use", t.in_use},
            {"holds_out_better", t.holds_out_better},
            {"decision", t.decision},
            {"survey", t.survey},
            {"program", t.program},
            {"method", t.method},
            {"optimiser", t.optimiser},
            {"seed", t.seed},
            {"population", t.population},
            {"iterations", t.iterations},
            {"evaluations", t.evaluations},
            {"loss", t.loss},
            {"loss_before", jsonNumber(t.loss_before)},
            {"loss_after", jsonNumber(t.loss_after)},
            {"left_out_before", optionalJson(t.left_out_before)},
            {"left_out_after", optionalJson(t.left_out_after)},
            {"warnings", t.warnings},
            {"marks", listOf(t.marks, [](const ControlMark& mark) { return mark.name; })}};
}

Json noiseJson(const NoiseFactor& n) {
    return {{"source", n.source},
            {"rows", n.rows},
            {"redundancy", n.redundancy},
            {"factor", n.factor},
            {"down_weighted", n.down_weighted}};
}

Json adjustmentJson(const std::optional<AdjustmentSummary>& adjustment) {
    if (!adjustment) return nullptr;
    const AdjustmentSummary& a = *adjustment;
    return {{"unknowns", a.unknowns},
            {"crossovers", a.crossovers},
            {"misfit_before_m", a.misfit_before_m},
            {"misfit_after_m", a.misfit_after_m},
            {"left_out_crossovers", a.left_out.n},
            {"left_out_misfit_before_m", a.left_out.before_m},
            {"left_out_misfit_after_m", a.left_out.after_m},
            {"crossover_test", coverageJson(a.crossover_test)},
            {"height_variance_factor", a.height_inflation},
            {"plan_variance_factor", a.plan_inflation},
            {"rounds", a.rounds},
            {"last_step_m", a.last_step_m},
            {"flow_scale_wanders", a.flow_scale_wanders},
            {"settled", a.settled},
            {"noise", listOf(a.noise, noiseJson)}};
}

Json inputJson(const InputFile& i) {
    return {{"path", i.path}, {"bytes", i.bytes}, {"sha256", i.sha256}};
}

}  // namespace

std::string reportJson(const SurveyReport& report) {
    const Json json{{"format", "terrawalk-report 1"},
                    {"survey", report.survey_name},
                    {"program_version", report.program_version},
                    {"method", report.method},
                    {"seed", report.seed},
                    {"figures", listOf(report.figures, figureJson)},
                    {"statements", report.statements},
                    {"limitations", report.limitations},
                    {"warnings", report.warnings},
                    {"headline", headlineJson(report)},
                    {"accuracy", listOf(report.accuracy, groupJson)},
                    {"strata", listOf(report.strata, stratumJson)},
                    {"slope_leakage", leakageJson(report.slope_leakage)},
                    {"slope_leakage_unknown", textJson(report.slope_leakage_unknown)},
                    {"vertical_class", classTestJson(report.class_test)},
                    {"residuals", listOf(report.residuals, residualJson)},
                    {"missing_residuals", listOf(report.missing_residuals, missingJson)},
                    {"marks", listOf(report.marks, markJson)},
                    {"adjustment", adjustmentJson(report.adjustment)},
                    {"surface", surfaceJson(report.surface)},
                    {"occupancy", report.occupancy ? spaceJson(*report.occupancy) : Json(nullptr)},
                    {"runs", listOf(report.runs, runJson)},
                    {"tuning", tuningJson(report.tuning)},
                    {"settings", listOf(report.settings, settingJson)},
                    {"inputs", listOf(report.inputs, inputJson)}};
    // Names come from files of anybody: what is no UTF-8 becomes U+FFFD instead of an exception.
    return json.dump(1, '\t', false, Json::error_handler_t::replace) + "\n";
}

std::string whyNoError95Interval(const ErrorStatistics& statistics) {
    if (statistics.error95_95) return {};
    return fmt::format("not determined with {} {}", statistics.marks,
                       statistics.marks == 1 ? "mark" : "marks");
}

std::string occupancyJson(const OccupancySummary& summary) {
    return spaceJson(summary).dump();
}

Result<void> writeReportJson(const SurveyReport& report, const std::filesystem::path& file) {
    return writeTextFile(reportJson(report), file);
}

}  // namespace terrawalk
