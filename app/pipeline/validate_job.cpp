#include "app/pipeline/validate_job.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/pipeline/raster_input.hpp"
#include "app/pipeline/version.hpp"
#include "io/output_folder.hpp"
#include "mapping/accuracy_statements.hpp"
#include "mapping/mark_residuals.hpp"
#include "mapping/profile.hpp"

namespace terrawalk {

namespace {

namespace fs = std::filesystem;

/// Marks in metres, named apart, with the height of the DEM at each.
struct Comparison {
    std::vector<ControlMark> marks;
    MarkResiduals found;
};

Comparison compareWith(const std::vector<MapMark>& marks, const DemFile& dem,
                       const std::optional<ElevationGrid>& sigmas) {
    const double metres = dem.crs.unit.metres;
    Comparison c;
    for (const MapMark& m : marks) {
        ControlMark mark = m.mark;
        mark.enu_m = metres * m.map;
        c.marks.push_back(std::move(mark));
    }
    const auto surface = [&](const Eigen::Vector3d& place_m) -> std::optional<SurfaceHeight> {
        const Eigen::Vector2d at = place_m.head<2>() / metres;
        const auto height = bilinearAt(dem.grid, at);
        if (!height) return std::nullopt;
        const auto sigma = sigmas ? bilinearAt(*sigmas, at) : std::nullopt;
        return SurfaceHeight{*height * metres, sigma ? *sigma * metres : kMissing};
    };
    c.found = surfaceResiduals(c.marks, surface, Stage::Surface, {});
    return c;
}

/// Whether the DEM was made from the file that the marks come from.
Result<bool> isMadeOf(const DemFile& dem, const MarkSource& marks) {
    if (dem.points_sha256.empty()) return false;
    const auto hash = sha256OfFile(marks.check_points.empty() ? marks.marks : marks.check_points);
    if (!hash) return tl::unexpected(hash.error());
    return *hash == dem.points_sha256;
}

nlohmann::ordered_json statisticsJson(const ErrorStatistics& s) {
    nlohmann::ordered_json json{{"n", s.n},           {"marks", s.marks},        {"mean_m", s.mean_m},
                                {"rmse_m", s.rmse_m}, {"mae_m", s.mae_m},        {"median_m", s.median_m},
                                {"nmad_m", s.nmad_m}, {"largest_m", s.largest_m}};
    if (s.sd_m) json["sd_m"] = *s.sd_m;
    if (s.rmse_95) json["rmse_95_m"] = {s.rmse_95->low_m, s.rmse_95->high_m};
    return json;
}

}  // namespace

Result<ValidateOutcome> validateDem(const ValidateRequest& request, Progress& progress,
                                    std::stop_token stop) {
    progress.report(0.0, "reading");
    const auto dem = readDem(request.dem, stop);
    if (!dem) return tl::unexpected(dem.error());
    PartialProgress reading(progress, 0.4, 0.7);
    const auto marks = marksOnMap(request.marks, request.dem, dem->crs, reading, stop);
    if (!marks) return tl::unexpected(marks.error());
    std::optional<ElevationGrid> sigmas;
    if (!request.uncertainty.empty()) {
        auto read = readAlike(request.uncertainty, *dem, stop);
        if (!read) return tl::unexpected(read.error());
        sigmas = std::move(*read);
    }
    Comparison compared = compareWith(*marks, *dem, sigmas);
    const auto made_of_these = isMadeOf(*dem, request.marks);
    if (!made_of_these) return tl::unexpected(made_of_these.error());
    if (*made_of_these) {
        for (Residual& residual : compared.found.residuals) residual.used_by_estimator = true;
    }
    if (compared.found.residuals.empty()) {
        return badData("no mark meets a height of the DEM", request.dem, 0,
                       "see whether marks and DEM are in one CRS");
    }
    ValidateOutcome outcome{request, dem->crs.unit.symbol, {}, {}};
    SurveyReport report;
    report.survey_name = request.dem.filename().string();
    report.program_version = programVersion();
    report.seed = request.seed;
    report.vertical_class_m = request.vertical_class_m;
    report.marks = std::move(compared.marks);
    report.residuals = std::move(compared.found.residuals);
    report.missing_residuals = std::move(compared.found.missing);
    outcome.report = withAccuracy(std::move(report));
    if (std::any_of(outcome.report.residuals.begin(), outcome.report.residuals.end(),
                    [](const Residual& r) { return r.role == MarkRole::Control; })) {
        outcome.report.limitations.emplace_back(
            "A DEM may have been tied to the control marks; the check marks alone speak for it.");
    }
    if (*made_of_these) {
        outcome.report.limitations.insert(
            outcome.report.limitations.begin(),
            "The DEM was made from this very file: the differences say how it follows its own points, not "
            "how "
            "accurate it is.");
    }
    if (stop.stop_requested()) return cancelled();
    if (!request.output.empty()) {
        fs::path json = request.output;
        json.replace_extension(".json");
        outcome.files = {request.output, json};
        if (auto done = writeResidualsCsv(outcome.report.residuals, request.output); !done) {
            return tl::unexpected(done.error());
        }
        if (auto done = writeTextFile(toJson(outcome), json); !done) return tl::unexpected(done.error());
    }
    progress.report(1.0, "done");
    return outcome;
}

std::string toText(const ValidateOutcome& o) {
    const SurveyReport& r = o.report;
    std::string text = fmt::format("{:<10}{:>6}{:>11}{:>11}{:>11}{:>11}{:>11}{:>11}\n", "marks", "n",
                                   "mean m", "sd m", "RMSE m", "MAE m", "NMAD m", "largest m");
    for (const AccuracyGroup& group : r.accuracy) {
        if (!group.up) continue;
        const ErrorStatistics& s = *group.up;
        text += fmt::format("{:<10}{:>6}{:>11.4f}{:>11}{:>11.4f}{:>11.4f}{:>11.4f}{:>11.4f}\n",
                            name(group.role), s.n, s.mean_m, s.sd_m ? fmt::format("{:.4f}", *s.sd_m) : "-",
                            s.rmse_m, s.mae_m, s.nmad_m, s.largest_m);
    }
    for (const std::string& statement : r.statements) text += printable(statement) + "\n";
    for (const std::string& limitation : r.limitations) text += "Note: " + printable(limitation) + "\n";
    for (const fs::path& file : o.files) text += "Written to " + printable(file.string()) + "\n";
    return text;
}

std::string toJson(const ValidateOutcome& o) {
    const SurveyReport& r = o.report;
    nlohmann::ordered_json document{{"format", "terrawalk-validation 1"},
                                    {"program", r.program_version},
                                    {"dem", o.request.dem.string()},
                                    {"dem_unit", o.unit},
                                    {"seed", r.seed},
                                    {"marks", r.marks.size()},
                                    {"marks_without_height", nlohmann::ordered_json::array()},
                                    {"accuracy", nlohmann::ordered_json::array()},
                                    {"statements", r.statements},
                                    {"limitations", r.limitations},
                                    {"differences", nlohmann::ordered_json::array()}};
    if (r.class_test) {
        document["vertical_class"] = {{"class_m", r.class_test->class_m},
                                      {"check_marks", r.class_test->marks},
                                      {"rmse_v_m", r.class_test->rmse_v_m},
                                      {"met", r.class_test->met()}};
    }
    for (const MissingResidual& missing : r.missing_residuals)
        document["marks_without_height"].push_back(missing.mark);
    for (const AccuracyGroup& group : r.accuracy) {
        if (!group.up) continue;
        nlohmann::ordered_json json{{"role", name(group.role)}, {"height", statisticsJson(*group.up)}};
        if (group.up_coverage) {
            json["within_95"] = {{"n", group.up_coverage->n}, {"within", group.up_coverage->within}};
        }
        document["accuracy"].push_back(std::move(json));
    }
    for (const Residual& residual : r.residuals) {
        nlohmann::ordered_json json{
            {"mark", residual.mark}, {"role", name(residual.role)}, {"d_u_m", residual.difference_enu_m.z()}};
        if (std::isfinite(residual.sigma_enu_m.z())) json["sigma_u_m"] = residual.sigma_enu_m.z();
        document["differences"].push_back(std::move(json));
    }
    return document.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace terrawalk
