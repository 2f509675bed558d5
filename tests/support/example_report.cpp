#include "tests/support/example_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace terrawalk::test {

namespace {

class Random {
  public:
    explicit Random(std::uint64_t seed) : state_(seed * 2862933555777941757ULL + 3037000493ULL) {}
    double uniform() {
        state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
        return (static_cast<double>(state_ >> 11U) + 0.5) * 0x1p-53;
    }
    double normal(double sigma) {
        return sigma * std::sqrt(-2.0 * std::log(uniform())) * std::cos(2.0 * kPi * uniform());
    }

  private:
    std::uint64_t state_;
};

constexpr double kWidth_m = 84.0, kDepth_m = 52.0, kSpacing_m = 3.0, kStep_m = 1.0;

double terrain(double e_m, double n_m) {
    return 0.08 * n_m + 0.6 * std::floor(n_m / 8.0) + 0.02 * e_m;
}

std::vector<Eigen::Vector3d> straightTrack(const Eigen::Vector3d& to, Random& random) {
    std::vector<Eigen::Vector3d> track;
    for (int i = 0; i <= 60; ++i) {
        Eigen::Vector3d p = to * (i / 60.0);
        p.x() += random.normal(0.1);
        p.y() += random.normal(0.1) + 1.5 * std::sin(i / 60.0 * kPi);
        track.push_back(p);
    }
    return track;
}

std::vector<Eigen::Vector3d> lawnmowerTrack(std::size_t epochs, Random& random) {
    std::vector<Eigen::Vector3d> track;
    const double lap_m = kWidth_m + kSpacing_m;
    const double length_m = lap_m * std::floor(kDepth_m / kSpacing_m);
    for (std::size_t i = 0; i < epochs; i += 5) {
        const double along = length_m * static_cast<double>(i) / static_cast<double>(epochs);
        const double line = std::floor(along / lap_m), rest = along - line * lap_m;
        const double across = std::min(rest, kWidth_m), up = std::max(rest - kWidth_m, 0.0);
        const bool back = static_cast<int>(line) % 2 == 1;
        const double e = back ? kWidth_m - across : across, n = line * kSpacing_m + up;
        track.emplace_back(e + random.normal(0.15), n + random.normal(0.2), terrain(e, n) + 1.3);
    }
    return track;
}

SensorUse sensor(std::string name, std::size_t offered, std::size_t down_weighted,
                 std::vector<SensorUse::Rejection> why) {
    std::size_t used = offered;
    for (const auto& r : why) used -= r.count;
    return {std::move(name), offered, used, down_weighted, std::move(why)};
}

RunReport runReport(std::string id, RunKind kind, std::size_t epochs, std::vector<Eigen::Vector3d> track) {
    RunReport run;
    run.id = std::move(id);
    run.kind = kind;
    run.repeated_lines = kind == RunKind::Area ? std::vector<std::size_t>{112, 2841, 2842, 2843, 7710}
                                               : std::vector<std::size_t>{};
    run.late_lines =
        kind == RunKind::Area ? std::vector<std::size_t>{4011, 4012} : std::vector<std::size_t>{};
    run.rows_read = epochs + run.repeated_lines.size();
    run.epochs = epochs;
    run.duration_s = 0.2 * static_cast<double>(epochs);
    for (std::size_t i = 1; i < track.size(); ++i) run.distance_m += (track[i] - track[i - 1]).norm();
    run.fixes = {{"single", epochs * 7 / 10},
                 {"RTK float", epochs / 5},
                 {"RTK fixed", epochs - epochs * 7 / 10 - epochs / 5}};
    run.sensors = {sensor("GNSS position", epochs, epochs / 30,
                          {{"innovation beyond the gate", epochs / 90}, {"no fix", epochs / 200}}),
                   sensor("barometer", epochs, epochs / 50, {}),
                   sensor("optical flow", epochs, epochs / 12,
                          {{"no texture", epochs / 15}, {"innovation beyond the gate", epochs / 60}}),
                   sensor("range", epochs, 0, {{"no range", epochs / 40}})};
    run.ground_points_rejected = {{"no range", epochs / 40},
                                  {"weak return", epochs / 70},
                                  {"tilted", epochs / 110},
                                  {"spike", epochs / 45}};
    run.ground_points_used = epochs;
    for (const CountedReason& r : run.ground_points_rejected) run.ground_points_used -= r.count;
    run.track_enu_m = std::move(track);
    return run;
}

void addMarks(SurveyReport& report, const ExampleSurvey& survey, Random& random) {
    const auto add = [&](const std::string& name, MarkRole role) {
        const double e = kWidth_m * (0.03 + 0.94 * random.uniform()),
                     n = kDepth_m * (0.03 + 0.9 * random.uniform());
        report.marks.push_back({name, {e, n, terrain(e, n)}, 0.004, 0.006, role});
    };
    for (std::size_t i = 0; i < survey.control_marks; ++i)
        add(fmt::format("P{:02}", i + 1), MarkRole::Control);
    for (std::size_t i = 0; i < survey.check_marks; ++i) add(fmt::format("K{:03}", i + 1), MarkRole::Check);
}

void addHeightResiduals(SurveyReport& report, const ExampleSurvey& survey, Random& random) {
    const auto add = [&](Stage stage, Quantity quantity, const ControlMark& mark, double d_u,
                         double sigma_u) {
        Residual r;
        r.stage = stage;
        r.quantity = quantity;
        r.mark = mark.name;
        r.role = mark.role;
        r.run = quantity == Quantity::NearestSample && !report.runs.empty() ? report.runs.back().id : "";
        r.mark_enu_m = mark.enu_m;
        r.difference_enu_m.z() = d_u;
        r.sigma_enu_m.z() = sigma_u;
        report.residuals.push_back(r);
    };
    for (const ControlMark& mark : report.marks) {
        const double kept = random.normal(survey.sigma_after_m);
        add(Stage::BeforeFusion, Quantity::SurfaceHeight, mark, 0.2 + random.normal(survey.sigma_before_m),
            kMissing);
        add(Stage::Fused, Quantity::NearestSample, mark, kept, survey.sigma_after_m);
        if (mark.name == "K007") {
            report.missing_residuals.push_back(
                {Stage::Surface, Quantity::SurfaceHeight, mark.name, mark.role, {}});
            continue;
        }
        add(Stage::Surface, Quantity::SurfaceHeight, mark, 0.8 * kept + random.normal(0.05),
            survey.sigma_after_m);
    }
}

void addStands(SurveyReport& report, const ExampleSurvey& survey, Random& random) {
    for (const RunReport& run : report.runs) {
        if (run.kind != RunKind::FixedPoint || survey.control_marks == 0) continue;
        const std::size_t index = static_cast<std::size_t>(&run - report.runs.data()) % survey.control_marks;
        const ControlMark& mark = report.marks[index];
        for (const Stage stage : {Stage::BeforeFusion, Stage::Fused}) {
            const double sigma = stage == Stage::Fused ? survey.sigma_after_m : 2.0 * survey.sigma_before_m;
            Residual r;
            r.stage = stage;
            r.quantity = Quantity::ArrayPosition;
            r.mark = mark.name;
            r.role = mark.role;
            r.run = run.id;
            r.mark_enu_m = mark.enu_m;
            r.difference_enu_m = {random.normal(sigma), random.normal(sigma), random.normal(sigma)};
            r.sigma_enu_m.setConstant(sigma);
            report.residuals.push_back(r);
        }
    }
}

}  // namespace

SurveyReport exampleReport(const ExampleSurvey& survey) {
    Random random(survey.seed);
    SurveyReport report;
    report.survey_name = "Terraced mango orchard";
    report.program_version = "0.1.0";
    report.method = "unscented Kalman filter with Rauch-Tung-Striebel pass";
    report.seed = survey.seed;
    addMarks(report, survey, random);
    for (std::size_t i = 0; i < survey.fixed_point_runs; ++i) {
        const Eigen::Vector3d target = survey.control_marks > 0 ? report.marks[i % survey.control_marks].enu_m
                                                                : Eigen::Vector3d{40, 25, 3};
        report.runs.push_back(
            runReport(fmt::format("F{:02}", i + 1), RunKind::FixedPoint, 259, straightTrack(target, random)));
    }
    if (survey.area_epochs > 0) {
        report.runs.push_back(
            runReport("S01", RunKind::Area, survey.area_epochs, lawnmowerTrack(survey.area_epochs, random)));
        report.runs.back().notes = {"the log has no GNSS height; the barometer stands in for it"};
    }
    addStands(report, survey, random);
    addHeightResiduals(report, survey, random);
    SurfaceReport& surface = report.surface;
    surface.method = "Delaunay triangulation, linear interpolation";
    surface.method_requested = "auto";
    surface.method_used = "linear";
    surface.comparison = InterpolationComparison{{"linear", "nearest"},
                                                 {"random-folds"},
                                                 {{"linear", "random-folds", 80, 0.073, 0.051, 0.144},
                                                  {"nearest", "random-folds", 80, 0.122, 0.09, 0.25}},
                                                 1};
    surface.terrace_edges = {3, 84.5, 0.92, 0.11};
    surface.points = 8542;
    surface.triangles = 16980;
    surface.longest_edge_m = 4.5;
    surface.area_m2 = 4310.4;
    surface.cell_m = 0.5;
    surface.columns = 172;
    surface.rows = 108;
    surface.cells_with_height = 16811;
    surface.lowest_m = -0.412;
    surface.highest_m = 12.906;
    surface.crs = "WGS 84 / UTM zone 49N (EPSG:32649)";
    surface.vertical_datum = "local: metres above the zero point";
    report.settings = {{"fusion.method", "default", "ukf"},
                       {"dem.cell_m", "0.5", "0.5"},
                       {"tin.longest_edge_m", "default", "4.5"},
                       {"fusion.smooth", "default", "true"},
                       {"seed", "7", "7"}};
    report.inputs = {{"survey.json", 1893, std::string(64, 'a')},
                     {"control.csv", 3120, std::string(64, 'b')}};
    for (const RunReport& run : report.runs) {
        report.inputs.push_back({"logs/" + run.id + ".csv", run.epochs * 96, std::string(64, 'c')});
    }
    report.limitations = {"The GNSS base is not named in the logs, so its coordinates were not checked."};
    return report;
}

}  // namespace terrawalk::test
