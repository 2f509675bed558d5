#include "mapping/accuracy_statements.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string_view>
#include <utility>

#include "mapping/accuracy.hpp"

namespace terrawalk {

namespace {

constexpr double kNotableShareOfClass = 0.25;  // section 7.2 of the ASPRS standards
constexpr std::string_view kStandards =
    "ASPRS Positional Accuracy Standards for Digital Geospatial Data, Edition 2, Version 2 (2024)";
constexpr std::size_t kNamesInASentence = 12;
constexpr double kNotableBiasShare = 0.5;  // of the RMSE
constexpr std::size_t kMostNamed = 10;     // a list that nobody reads to its end helps nobody
constexpr std::size_t kNssdaCheckMarks = 20;
constexpr std::size_t kFewForCoverage = 20;

std::string metres(double value_m) {
    const std::string text = fmt::format("{:.3f} m", value_m);
    return text == "-0.000 m" ? "0.000 m" : text;
}

std::string signedMetres(double value_m) {
    return fmt::format("{}{}", value_m >= 0.0005 ? "+" : "", metres(value_m));
}

std::string counted(std::size_t n, std::string_view thing) {
    return fmt::format("{} {}{}", n, thing, n == 1 ? "" : "s");
}

std::string listed(const std::vector<std::string>& names) {
    const std::size_t shown = std::min(names.size(), kNamesInASentence);
    std::string text =
        fmt::format("{}", fmt::join(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(shown), ", "));
    if (shown < names.size()) text += fmt::format(" and {} more", names.size() - shown);
    return text;
}

std::string productOf(const AccuracyGroup& group) {
    switch (group.quantity) {
        case Quantity::SurfaceHeight:
            return "the surface";
        case Quantity::NearestSample:
            return "the ground points";
        case Quantity::ArrayPosition:
            return "the ground below the array";
    }
    return "";
}

const AccuracyGroup* findGroup(const std::vector<AccuracyGroup>& groups, Stage stage, Quantity quantity,
                               MarkRole role) {
    const auto found = std::find_if(groups.begin(), groups.end(), [&](const AccuracyGroup& g) {
        return g.stage == stage && g.quantity == quantity && g.role == role && g.up;
    });
    return found == groups.end() ? nullptr : &*found;
}

const AccuracyGroup* headlineOf(const SurveyReport& report) {
    return report.headline ? &report.accuracy.at(*report.headline) : nullptr;
}

/// The same marks before fusion, by the same measure.
const AccuracyGroup* beforeFusion(const std::vector<AccuracyGroup>& groups, const AccuracyGroup& after) {
    if (after.stage == Stage::BeforeFusion) return nullptr;
    return findGroup(groups, Stage::BeforeFusion, after.quantity, after.role);
}

std::size_t markCount(const SurveyReport& report, MarkRole role) {
    return static_cast<std::size_t>(std::count_if(report.marks.begin(), report.marks.end(),
                                                  [&](const ControlMark& m) { return m.role == role; }));
}

/// Root mean square of the sigma that the total station gives for the marks of a group.
double markSigma_m(const SurveyReport& report, const AccuracyGroup& group) {
    double squares = 0.0;
    std::size_t n = 0;
    for (const Residual& residual : report.residuals) {
        if (!countsIn(residual, group)) continue;
        const auto mark = std::find_if(report.marks.begin(), report.marks.end(),
                                       [&](const ControlMark& m) { return m.name == residual.mark; });
        if (mark == report.marks.end()) continue;
        squares += mark->sigma_v_m * mark->sigma_v_m;
        ++n;
    }
    return n == 0 ? 0.0 : std::sqrt(squares / static_cast<double>(n));
}

/// Sum and number of squared height differences of each mark.
using SquaresOfMarks = std::map<std::string, std::pair<double, double>>;

SquaresOfMarks squaresOfMarks(const SurveyReport& report, const AccuracyGroup& group) {
    SquaresOfMarks squares;
    for (const Residual& residual : report.residuals) {
        if (!countsIn(residual, group)) continue;
        auto& [sum, count] = squares[residual.mark];
        sum += residual.difference_enu_m.z() * residual.difference_enu_m.z();
        count += 1.0;
    }
    return squares;
}

/// RMSE before and after fusion at the marks that both reach: a fair comparison needs the same marks.
struct Gain {
    double before_m = 0.0, after_m = 0.0;
    std::size_t marks = 0;
};

std::optional<Gain> gain(const SurveyReport& report, const AccuracyGroup& after) {
    const AccuracyGroup* before = beforeFusion(report.accuracy, after);
    if (before == nullptr) return std::nullopt;
    const SquaresOfMarks squares_after = squaresOfMarks(report, after);
    std::pair<double, double> sum_before, sum_after;
    Gain gain;
    for (const auto& [mark, squares] : squaresOfMarks(report, *before)) {
        const auto same = squares_after.find(mark);
        if (same == squares_after.end()) continue;
        ++gain.marks;
        sum_before.first += squares.first;
        sum_before.second += squares.second;
        sum_after.first += same->second.first;
        sum_after.second += same->second.second;
    }
    if (gain.marks == 0) return std::nullopt;
    gain.before_m = std::sqrt(sum_before.first / sum_before.second);
    gain.after_m = std::sqrt(sum_after.first / sum_after.second);
    return gain;
}

KeyFigure heightFigure(const SurveyReport& report) {
    const AccuracyGroup* group = headlineOf(report);
    if (group == nullptr) {
        return {"Height error (RMSE)", "not known",
                report.marks.empty() ? "no mark was measured" : "no check mark was compared"};
    }
    std::string detail = "at " + counted(group->up->marks, "check mark");
    if (const auto change = gain(report, *group)) {
        detail += change->marks == group->up->marks
                      ? fmt::format("; {} before fusion", metres(change->before_m))
                      : fmt::format("; {} before fusion and {} now at the {} that both reach",
                                    metres(change->before_m), metres(change->after_m), change->marks);
    } else if (group->stage == Stage::BeforeFusion) {
        detail += "; sensors as they are";
    }
    return {fmt::format("Height error of {} (RMSE)", productOf(*group)), metres(group->up->rmse_m), detail};
}

KeyFigure checkMarkFigure(const SurveyReport& report) {
    const AccuracyGroup* group = headlineOf(report);
    const std::size_t compared = group == nullptr ? 0 : group->up->marks;
    const std::size_t measured = markCount(report, MarkRole::Check);
    std::string detail = measured == 0 ? "none was measured" : fmt::format("of {} measured", measured);
    const std::size_t control = markCount(report, MarkRole::Control);
    if (control > 0) detail += "; " + counted(control, "control mark") + " beside them";
    return {"Check marks compared", fmt::format("{}", compared), detail};
}

std::string area(double area_m2) {
    if (!std::isfinite(area_m2)) return "an unknown area";
    return area_m2 < 1e5 ? fmt::format("{:.0f} m\u00b2", area_m2) : fmt::format("{:.1f} ha", area_m2 * 1e-4);
}

KeyFigure surfaceFigure(const SurveyReport& report) {
    const SurfaceReport& s = report.surface;
    if (s.cell_m <= 0.0) return {"Terrain model", "none", "no surface was made"};
    return {"Terrain model", fmt::format("{:g} m cells", s.cell_m),
            fmt::format("{} triangulated; {} ground points", area(s.area_m2), s.points)};
}

std::string foundStatement(const SurveyReport& report, const AccuracyGroup& group) {
    const ErrorStatistics& up = *group.up;
    std::string text = fmt::format("Heights of {} differ from {} by {} (vertical RMSE", productOf(group),
                                   counted(up.marks, "check mark"), metres(up.rmse_m));
    if (up.rmse_95) {
        text +=
            fmt::format("; 95 % interval {} to {}", metres(up.rmse_95->low_m), metres(up.rmse_95->high_m));
    }
    text += ").";
    if (const double sigma_m = markSigma_m(report, group); sigma_m > 0.0) {
        text += fmt::format(" With the marks' own error of {} it is {}.", metres(sigma_m),
                            metres(rmseWithMarkError_m(up.rmse_m, sigma_m)));
    }
    return text;
}

std::string standardStatement(const ErrorStatistics& up) {
    if (up.marks >= kAsprsCheckMarks) {
        return fmt::format(
            "Tested with {} check marks, at least the {} that the ASPRS Positional Accuracy Standards, "
            "Edition 2, "
            "ask for. No accuracy class is claimed: that takes a class to test against and check marks on "
            "open "
            "ground.",
            up.marks, kAsprsCheckMarks);
    }
    return fmt::format(
        "Tested using the reduced number of {}. The ASPRS Positional Accuracy Standards, Edition 2, ask for "
        "{}; "
        "with fewer, no accuracy class can be claimed.",
        counted(up.marks, "check mark"), kAsprsCheckMarks);
}

std::string centimetres(double value_m) {
    return fmt::format("{:.2f} cm", 100.0 * value_m);
}

/// The sentences of the standards, as far as the program can vouch for them.
std::string classStatement(const VerticalClassTest& test) {
    const std::string asked =
        fmt::format("{:g} cm RMSE_V Vertical Accuracy Class", std::round(1e5 * test.class_m) / 1e3);
    const std::string found = fmt::format(
        "The Non-Vegetated Vertical Accuracy (NVA) was found to be RMSE_V = {}", centimetres(test.rmse_v_m));
    if (!test.enough_marks) {
        return fmt::format(
            "This data set was tested as required by {}. Although the Standards call for a minimum of thirty "
            "(30) checkpoints, this test was performed using ONLY {} checkpoints. {} using the reduced "
            "number "
            "of checkpoints, {} the {} asked for.",
            kStandards, test.marks, found, test.within ? "within" : "beyond", asked);
    }
    if (!test.marks_sure) {
        return fmt::format(
            "This data set was not tested as required by {}: the check marks' own error of {} is more than "
            "half of the {} asked for. {}.",
            kStandards, centimetres(test.mark_sigma_m), asked, found);
    }
    if (!test.within) {
        return fmt::format(
            "This data set was tested as required by {} and does not meet the {} asked for. {}.", kStandards,
            asked, found);
    }
    return fmt::format("This data set was tested to meet {} for a {}. {}.", kStandards, asked, found);
}

std::string nssdaStatement(const AccuracyGroup& group) {
    const std::string found =
        fmt::format("{} vertical accuracy at 95 % confidence level", metres(*group.nssda_vertical_m));
    const std::string how =
        fmt::format("1.9600 times the RMSE of {}", counted(group.up->marks, "check mark"));
    if (group.up->marks >= kNssdaCheckMarks) {
        return fmt::format("Tested {} (NSSDA, FGDC-STD-007.3-1998: {}).", found, how);
    }
    return fmt::format(
        "By the formula of the NSSDA (FGDC-STD-007.3-1998) it would be {} ({}), but the NSSDA asks "
        "for {} and more.",
        found, how, kNssdaCheckMarks);
}

std::string leakageStatement(const SlopeLeakage& leakage) {
    return fmt::format(
        "Errors in plan turn into errors of height on slopes: the {} along an axis seen at the stands, times "
        "the "
        "slope at {}, is {} (RMSE), {:.0f} % of the mean square height error.",
        metres(leakage.plan_rmse_m), counted(leakage.n, "check mark"), metres(leakage.rmse_m),
        100.0 * leakage.share);
}

std::string gainStatement(const SurveyReport& report, const AccuracyGroup& after, const Gain& gain) {
    const std::string_view measure = name(beforeFusion(report.accuracy, after)->quantity);
    std::string text =
        fmt::format("Before fusion the height RMSE was {} ({}); at the same {} it is {} now",
                    metres(gain.before_m), measure, counted(gain.marks, "mark"), metres(gain.after_m));
    if (gain.before_m <= 0.0) return text + ".";
    const double change = 100.0 * (1.0 - gain.after_m / gain.before_m);
    return text + fmt::format(", {:.0f} % {}.", std::abs(change), change >= 0.0 ? "less" : "more");
}

std::string coverageStatement(const SigmaCoverage& coverage) {
    std::string text = fmt::format(
        "{} of {} heights ({:.0f} %) lie within 1.96 predicted sigmas; 95 % would be right. The mean square "
        "of "
        "error over sigma is {:.2f}; 1 would be right",
        coverage.within, coverage.n,
        100.0 * static_cast<double>(coverage.within) / static_cast<double>(coverage.n), coverage.mean_square);
    text += coverage.n < kFewForCoverage ? ", but so few decide little." : ".";
    return text;
}

/// Biases and outliers, each with a hint.
std::vector<std::string> suspicions(const SurveyReport& report, const AccuracyGroup& group) {
    std::vector<std::string> out;
    const ErrorStatistics& up = *group.up;
    if (up.n >= 3 && std::abs(up.mean_m) > kNotableBiasShare * up.rmse_m && up.sd_m &&
        std::abs(up.mean_m) > 2.0 * *up.sd_m / std::sqrt(static_cast<double>(up.n))) {
        out.push_back(
            fmt::format("The heights lie {} on average ({}): more than chance explains. Look for a wrong "
                        "array height, a wrong "
                        "start mark or a shifted datum.",
                        up.mean_m > 0.0 ? "too high" : "too low", signedMetres(up.mean_m)));
    }
    if (report.class_test && std::abs(up.mean_m) > kNotableShareOfClass * report.class_test->class_m) {
        out.push_back(
            fmt::format("The mean error of {} is more than a quarter of the RMSE_V asked for: the ASPRS "
                        "standards want its cause found.",
                        signedMetres(up.mean_m)));
    }
    std::size_t blunders = 0;
    for (const Residual& residual : report.residuals) {
        if (!countsIn(residual, group) || !residual.possible_blunder) continue;
        if (++blunders > kMostNamed) continue;
        out.push_back(
            fmt::format("{} is off by {}, more than {:g} times the {}: a possible blunder. It is counted.",
                        residual.mark, signedMetres(residual.difference_enu_m.z()), kBlunderMultiple,
                        report.class_test ? "RMSE_V asked for" : "RMSE of the others"));
    }
    if (blunders > kMostNamed) {
        out.push_back(fmt::format("{} more marks are off as far; the table of differences names them.",
                                  blunders - kMostNamed));
    }
    return out;
}

/// "4 of 60 check marks lie outside the surface: ..."; one sentence for each measure and role.
std::vector<std::string> missingSentences(const SurveyReport& report) {
    struct Case {
        Quantity quantity;
        std::string_view singular, plural;
    };
    constexpr std::array kCases{
        Case{Quantity::SurfaceHeight, "lies outside the surface", "lie outside the surface"},
        Case{Quantity::NearestSample, "has no ground point near enough", "have no ground point near enough"},
        Case{Quantity::ArrayPosition, "was stood on without a sound range",
             "were stood on without a sound range"}};
    std::vector<std::string> out;
    for (const Case& c : kCases) {
        for (const MarkRole role : {MarkRole::Check, MarkRole::Control}) {
            std::vector<std::string> names;
            for (const MissingResidual& missing : report.missing_residuals) {
                if (missing.quantity != c.quantity || missing.role != role) continue;
                const std::string shown = missing.run.empty()
                                              ? missing.mark
                                              : fmt::format("{} (run {})", missing.mark, missing.run);
                if (std::find(names.begin(), names.end(), shown) == names.end()) names.push_back(shown);
            }
            if (names.empty()) continue;
            out.push_back(fmt::format("{} {} and could not be compared: {}.",
                                      counted(names.size(), fmt::format("{} mark", name(role))),
                                      names.size() == 1 ? c.singular : c.plural, listed(names)));
        }
    }
    return out;
}

std::string controlSentence(const SurveyReport& report) {
    const bool compared = std::any_of(report.accuracy.begin(), report.accuracy.end(),
                                      [](const AccuracyGroup& g) { return g.role == MarkRole::Control; });
    const std::string marks = counted(markCount(report, MarkRole::Control), "control mark");
    return compared
               ? fmt::format(
                     "No check mark was compared. {} stand in the report apart; errors at marks that may "
                     "have served alignment or tuning do not certify the product.",
                     marks)
               : fmt::format(
                     "No check mark was compared, and none of the {} tells an error that the estimator "
                     "has not seen.",
                     marks);
}

bool hasSlopes(const SurveyReport& report, const AccuracyGroup& group) {
    return std::any_of(report.residuals.begin(), report.residuals.end(),
                       [&](const Residual& r) { return countsIn(r, group) && std::isfinite(r.slope); });
}

bool coverUnknown(const SurveyReport& report, const AccuracyGroup& group) {
    return std::none_of(report.residuals.begin(), report.residuals.end(), [&](const Residual& r) {
        return countsIn(r, group) && r.cover != GroundCover::Unknown;
    });
}

}  // namespace

std::optional<std::size_t> headlineGroup(const std::vector<AccuracyGroup>& groups) {
    constexpr std::array kBest{std::pair{Stage::Surface, Quantity::SurfaceHeight},
                               std::pair{Stage::Fused, Quantity::NearestSample},
                               std::pair{Stage::Fused, Quantity::ArrayPosition},
                               std::pair{Stage::BeforeFusion, Quantity::NearestSample},
                               std::pair{Stage::BeforeFusion, Quantity::ArrayPosition}};
    for (const auto& [stage, quantity] : kBest) {
        if (const AccuracyGroup* group = findGroup(groups, stage, quantity, MarkRole::Check)) {
            return static_cast<std::size_t>(group - groups.data());
        }
    }
    return std::nullopt;
}

std::vector<KeyFigure> keyFigures(const SurveyReport& report) {
    return {heightFigure(report), checkMarkFigure(report), surfaceFigure(report)};
}

std::vector<std::string> accuracyStatements(const SurveyReport& report) {
    const AccuracyGroup* group = headlineOf(report);
    if (group == nullptr) {
        return {report.marks.empty()
                    ? "No accuracy can be stated: the survey has no marks to compare with."
                    : "No accuracy can be stated: no check mark could be compared with the product."};
    }
    std::vector<std::string> out{foundStatement(report, *group), report.class_test
                                                                     ? classStatement(*report.class_test)
                                                                     : standardStatement(*group->up)};
    if (report.class_test && report.class_test->vegetated_marks > 0) {
        out.push_back(fmt::format("The Vegetated Vertical Accuracy (VVA) was found to be RMSE_V = {} at {}.",
                                  centimetres(report.class_test->vegetated_rmse_v_m),
                                  counted(report.class_test->vegetated_marks, "check mark")));
    }
    out.push_back(nssdaStatement(*group));
    if (const auto change = gain(report, *group)) out.push_back(gainStatement(report, *group, *change));
    if (const AccuracyGroup* fused =
            findGroup(report.accuracy, Stage::Fused, Quantity::ArrayPosition, MarkRole::Check);
        fused != nullptr && fused->horizontal) {
        out.push_back(fmt::format("Standing on {}, the fused position was off by {} in plan (RMSE).",
                                  counted(fused->horizontal->marks, "check mark"),
                                  metres(fused->horizontal->rmse_m)));
        if (fused->nssda_horizontal_m) {
            out.back() += fmt::format(" By the NSSDA that is {} at 95 % confidence.",
                                      metres(*fused->nssda_horizontal_m));
        }
    }
    if (report.slope_leakage) out.push_back(leakageStatement(*report.slope_leakage));
    if (group->up_coverage) out.push_back(coverageStatement(*group->up_coverage));
    for (std::string& sentence : suspicions(report, *group)) out.push_back(std::move(sentence));
    return out;
}

std::vector<std::string> accuracyLimitations(const SurveyReport& report) {
    std::vector<std::string> out;
    const AccuracyGroup* group = headlineOf(report);
    if (report.marks.empty()) {
        out.emplace_back(
            "The survey has no marks measured by total station. Nothing independent says how far the terrain "
            "model "
            "is from the ground.");
    } else if (group == nullptr) {
        out.push_back(markCount(report, MarkRole::Control) > 0
                          ? controlSentence(report)
                          : std::string("No check mark could be compared with the product."));
    } else if (group->up->marks < kAsprsCheckMarks) {
        const std::size_t marks = group->up->marks;
        out.push_back(
            fmt::format("{} {} a small sample: the true error may differ a good deal from the figure found.",
                        counted(marks, "check mark"), marks == 1 ? "is" : "are"));
    }
    if (group != nullptr && group->stage == Stage::Surface && coverUnknown(report, *group)) {
        out.emplace_back(
            "Whether the check marks stand among plants or in the open is not known: the points were not "
            "looked "
            "through for what stands on the ground, or too few lie near the marks.");
    }
    if (report.class_test && report.class_test->mark_sigma_m == 0.0) {
        out.emplace_back("The check marks' own error is not known: the RMSE_V found leaves it out.");
    }
    if (group != nullptr && hasSlopes(report, *group) && !report.slope_leakage_unknown.empty()) {
        out.push_back(fmt::format("What errors in plan add to errors of height on slopes is not known: {}.",
                                  report.slope_leakage_unknown));
    }
    for (std::string& sentence : missingSentences(report)) out.push_back(std::move(sentence));
    const auto tied = std::count_if(report.residuals.begin(), report.residuals.end(),
                                    [](const Residual& r) { return r.used_by_estimator; });
    if (tied > 0) {
        out.push_back(fmt::format(
            "The estimator was tied to the mark or tuned on it in {}; these are listed and never counted.",
            counted(static_cast<std::size_t>(tied), "comparison")));
    }
    return out;
}

SurveyReport withAccuracy(SurveyReport report) {
    report.residuals = withBlundersFlagged(std::move(report.residuals), report.vertical_class_m);
    report.accuracy = accuracyGroups(report.residuals, report.seed);
    report.headline = headlineGroup(report.accuracy);
    if (const AccuracyGroup* const group = headlineOf(report)) {
        report.strata = accuracyStrata(report.residuals, *group, report.seed);
        if (auto leakage = slopeLeakage(report.residuals, report.accuracy, *group)) {
            report.slope_leakage = *leakage;
        } else {
            report.slope_leakage_unknown = std::move(leakage.error());
        }
        report.class_test =
            verticalClassTest(report.residuals, report.marks, *group, report.vertical_class_m);
    }
    report.figures = keyFigures(report);
    report.statements = accuracyStatements(report);
    std::vector<std::string> limitations = accuracyLimitations(report);
    limitations.insert(limitations.end(), report.limitations.begin(), report.limitations.end());
    report.limitations = std::move(limitations);
    return report;
}

}  // namespace terrawalk
