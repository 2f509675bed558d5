#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

#include "io/chinese_page.hpp"
#include "io/markup_text.hpp"
#include "io/output_folder.hpp"
#include "io/report_plots.hpp"
#include "io/report_style.hpp"
#include "io/report_text.hpp"
#include "io/write_products.hpp"

namespace terrawalk {

namespace {

// ---------------------------------------------------------------------------------------------- pieces of a
// page

std::string metres3(double value_m) {
    return fixedDecimals(value_m, 3);
}

/// Names and codes are the same in every language.
constexpr std::string_view kName = " translate=\"no\"";

/// What a table cell holds; numbers stand to the right.
enum class Cell { Text, Short, Number, Name, Key, Hash };

std::string cell(Cell kind, std::string_view words) {
    constexpr std::array<std::string_view, 6> kClasses{"text", "short", "n", "text", "key", "hash"};
    return fmt::format("<td class=\"{}\"{}>{}</td>", kClasses[static_cast<std::size_t>(kind)],
                       kind >= Cell::Name ? kName : "", escapedMarkup(words));
}

std::string number(std::size_t value) {
    return cell(Cell::Number, groupedDigits(value));
}
std::string metresCell(double value_m) {
    return cell(Cell::Number, metres3(value_m));
}

std::string rowHead(std::string_view words) {
    return fmt::format("<th scope=\"row\">{}</th>", escapedMarkup(words));
}

std::string nameHead(std::string_view name) {
    return fmt::format("<th scope=\"row\"{}>{}</th>", kName, escapedMarkup(name));
}

struct Heading {
    std::string words;
    bool is_number = false;
};

std::string tableHead(const std::vector<Heading>& headings) {
    std::string out = "<thead><tr>";
    for (const Heading& h : headings) {
        out += fmt::format("<th scope=\"col\"{}>{}</th>", h.is_number ? " class=\"n\"" : "",
                           escapedMarkup(h.words));
    }
    return out + "</tr></thead>\n";
}

/// @param bodies  one or more <tbody> elements
std::string table(const std::vector<Heading>& headings, const std::string& bodies) {
    return "<div class=\"scroll\"><table>\n" + tableHead(headings) + bodies + "</table></div>\n";
}

std::string tableBody(const std::string& rows) {
    return "<tbody>\n" + rows + "</tbody>\n";
}

std::string row(const std::string& cells) {
    return "<tr>" + cells + "</tr>\n";
}

std::string section(std::string_view id, std::string_view title, const std::string& content) {
    if (content.empty()) return {};
    return fmt::format("<section id=\"{}\">\n<h2>{}</h2>\n{}</section>\n", id, escapedMarkup(title), content);
}

std::string folded(std::string_view summary, const std::string& content) {
    if (content.empty()) return {};
    return fmt::format("<details><summary>{}</summary>\n{}</details>\n", escapedMarkup(summary), content);
}

std::string figure(const std::string& drawing, std::string_view caption) {
    if (drawing.empty()) return {};
    return fmt::format("<figure>\n{}<figcaption>{}</figcaption>\n</figure>\n", drawing,
                       escapedMarkup(caption));
}

std::string note(std::string_view words) {
    return fmt::format("<p class=\"note\">{}</p>\n", escapedMarkup(words));
}

std::string bullets(const std::vector<std::string>& sentences) {
    std::string out;
    for (const std::string& sentence : sentences) out += "<li>" + escapedMarkup(sentence) + "</li>\n";
    return out.empty() ? out : "<ul>\n" + out + "</ul>\n";
}

std::string share(std::size_t part, std::size_t whole) {
    return whole == 0
               ? "\u2013"
               : fixedDecimals(100.0 * static_cast<double>(part) / static_cast<double>(whole), 1) + " %";
}

template <class Reason>
std::string reasonsText(const std::vector<Reason>& reasons) {
    std::vector<std::string> words;
    for (const Reason& r : reasons) {
        if (r.count > 0) words.push_back(fmt::format("{} {}", r.reason, groupedDigits(r.count)));
    }
    return fmt::format("{}", fmt::join(words, ", "));
}

template <class Reason>
std::size_t total(const std::vector<Reason>& reasons) {
    std::size_t sum = 0;
    for (const Reason& r : reasons) sum += r.count;
    return sum;
}

std::string capitalised(std::string_view words) {
    std::string out(words);
    if (!out.empty() && out[0] >= 'a' && out[0] <= 'z') out[0] = static_cast<char>(out[0] - 'a' + 'A');
    return out;
}

// ---------------------------------------------------------------------------------------------- what comes
// first

std::string titleOf(const SurveyReport& report) {
    return report.survey_name.empty() ? "Unnamed survey" : report.survey_name;
}

std::string header(const SurveyReport& report) {
    return fmt::format(
        "<header>\n<h1{}>{}</h1>\n<p class=\"lead\">Terrain survey: what was made and how far to trust it. "
        "Terrawalk {}.</p>\n"
        "<nav><a href=\"#map\">Map</a><a href=\"#errors\">Errors</a><a href=\"#accuracy\">Accuracy</a>"
        "<a href=\"#surface\">Terrain model</a><a href=\"#runs\">Runs</a><a href=\"#sensors\">Sensors</a>"
        "<a href=\"#record\">Record</a></nav>\n</header>\n",
        report.survey_name.empty() ? "" : kName, escapedMarkup(titleOf(report)),
        escapedMarkup(report.program_version));
}

std::string figureCards(const SurveyReport& report) {
    std::string out;
    for (std::size_t i = 0; i < report.figures.size(); ++i) {
        const KeyFigure& f = report.figures[i];
        const bool unknown = i == 0 && !report.headline;
        out += fmt::format(
            "<div class=\"figure{}\"><span>{}</span><b>{}</b><span class=\"detail\">{}</span></div>\n",
            unknown ? " unknown" : "", escapedMarkup(f.label), escapedMarkup(f.value),
            escapedMarkup(f.detail));
    }
    return out.empty() ? out : "<div class=\"figures\">\n" + out + "</div>\n";
}

std::string verdict(const SurveyReport& report) {
    std::string out = bullets(report.statements);
    return out.empty() ? out : "<section id=\"verdict\">\n" + out + "</section>\n";
}

std::string limitations(const SurveyReport& report) {
    if (report.limitations.empty() && report.warnings.empty()) return {};
    std::string out = "<section class=\"limits\" id=\"limits\">\n<h2>What could not be checked</h2>\n";
    out += report.limitations.empty() ? "<p>Nothing that the program knows of.</p>\n"
                                      : bullets(report.limitations);
    if (!report.warnings.empty()) out += "<h3>Warnings</h3>\n" + bullets(report.warnings);
    return out + "</section>\n";
}

// ---------------------------------------------------------------------------------------------- drawings

std::string trackKey(const SurveyReport& report) {
    constexpr std::size_t kMostRuns = 60;
    const std::vector<std::string> classes = trackClasses(report);
    std::string out;
    for (std::size_t i = 0; i < std::min(report.runs.size(), kMostRuns); ++i) {
        out += fmt::format(
            "<li><svg viewBox=\"0 0 28 8\" aria-hidden=\"true\"><line x1=\"0\" y1=\"4\" x2=\"28\" y2=\"4\" "
            "class=\"track {}\"/></svg><span{}>{}</span></li>\n",
            classes[i], kName, escapedMarkup(shortened(report.runs[i].id, 24)));
    }
    return out.empty() ? out : "<ul class=\"runs\">\n" + out + "</ul>\n";
}

/// What a group compares, in words for a caption.
std::string subject(const AccuracyGroup& group) {
    if (group.quantity == Quantity::SurfaceHeight) return "surface";
    const std::string_view what =
        group.quantity == Quantity::NearestSample ? "nearest ground point" : "ground below the array";
    return fmt::format("{}, {}", what, name(group.stage));
}

std::string mapSection(const SurveyReport& report) {
    const std::string drawing = surveyMap(report);
    if (drawing.empty()) return note("Neither a track nor a mark has a position to draw.");
    std::string caption = "Local frame, both axes to one scale.";
    if (const AccuracyGroup* group = shownHeights(report)) {
        caption += fmt::format(" Bars at the marks: height error of the {}.", subject(*group));
    }
    return figure(drawing + trackKey(report), caption);
}

std::string errorSection(const SurveyReport& report) {
    std::string out =
        figure(heightErrorPlot(report),
               plottedHeights(report) == Quantity::SurfaceHeight
                   ? "Height of the surface at each mark less the mark's own: made from the sensors as they "
                     "are, and "
                     "after fusion."
                   : "Height of the nearest ground point less the mark's own, before and after fusion.");
    const std::string plan =
        figure(planErrorPlot(report), "Position below the array less the mark, seen from above.");
    std::string spread;
    if (const AccuracyGroup* group = shownHeights(report)) {
        spread = figure(heightHistogram(report),
                        fmt::format("Height error of the {} at {} marks. The upright line is zero.",
                                    subject(*group), name(group->role)));
        if (spread.empty()) spread = note("Fewer than five comparisons: a histogram would show nothing.");
    }
    out += figure(standErrorPlot(report),
                  "Ground height below the array less the mark's, at each stand on a mark.");
    if (!spread.empty() || !plan.empty()) out += "<div class=\"pair\">\n" + spread + plan + "</div>\n";
    return out.empty() ? note("There is nothing to draw: no mark was compared with the product.") : out;
}

// ---------------------------------------------------------------------------------------------- accuracy

std::string anchorOf(const AccuracyGroup& group, std::string_view axis) {
    std::string id =
        fmt::format("{}-{}-{}-{}", name(group.role), name(group.stage), name(group.quantity), axis);
    std::replace(id.begin(), id.end(), ' ', '-');
    return id;
}

std::string intervalCell(const std::optional<ConfidenceInterval>& interval) {
    if (!interval) return cell(Cell::Number, "\u2013");
    return cell(Cell::Number,
                fmt::format("{} \u2026 {}", metres3(interval->low_m), metres3(interval->high_m)));
}

/// One table of error measures.
struct MeasureTable {
    std::vector<Heading> headings;  ///< of the measures
    std::string (*cells)(const ErrorStatistics&);
    std::string_view anchor_ending;  ///< of its rows' names
};

const MeasureTable kUsualMeasures{
    {{"n", true},
     {"Marks", true},
     {"Mean", true},
     {"SD", true},
     {"RMSE", true},
     {"95 % interval of RMSE", true},
     {"MAE", true},
     {"Largest", true}},
    [](const ErrorStatistics& s) {
        return number(s.n) + number(s.marks) + metresCell(s.mean_m) + metresCell(s.sd_m.value_or(kMissing)) +
               metresCell(s.rmse_m) + intervalCell(s.rmse_95) + metresCell(s.mae_m) + metresCell(s.largest_m);
    },
    ""};

const MeasureTable kRobustMeasures{
    {{"Median", true},
     {"95 % interval", true},
     {"NMAD", true},
     {"95 % interval", true},
     {"68.3 % of |d| below", true},
     {"95 % of |d| below", true},
     {"95 % interval", true}},
    [](const ErrorStatistics& s) {
        return metresCell(s.median_m) + intervalCell(s.median_95) + metresCell(s.nmad_m) +
               intervalCell(s.nmad_95) + metresCell(s.error68_m) + metresCell(s.error95_m) +
               (s.error95_95 ? intervalCell(s.error95_95) : cell(Cell::Text, whyNoError95Interval(s)));
    },
    "-robust"};

std::vector<Heading> withMeasures(std::vector<Heading> headings, const MeasureTable& measures) {
    headings.insert(headings.end(), measures.headings.begin(), measures.headings.end());
    return headings;
}

std::string groupRows(const AccuracyGroup& group, const MeasureTable& measures) {
    const std::array<std::pair<std::string_view, const std::optional<ErrorStatistics>*>, 4> axes{
        {{"east", &group.east},
         {"north", &group.north},
         {"up", &group.up},
         {"horizontal", &group.horizontal}}};
    const auto rows =
        std::count_if(axes.begin(), axes.end(), [](const auto& a) { return a.second->has_value(); });
    std::string out;
    for (const auto& [axis, statistics] : axes) {
        if (!*statistics) continue;
        std::string cells;
        if (out.empty()) {
            cells = fmt::format(
                "<th scope=\"rowgroup\" rowspan=\"{}\">{}<br/><span class=\"note\">{}</span></th>", rows,
                capitalised(name(group.stage)), name(group.quantity));
        }
        out += fmt::format("<tr id=\"{}{}\">{}{}{}</tr>\n", anchorOf(group, axis), measures.anchor_ending,
                           cells, cell(Cell::Short, axis), measures.cells(**statistics));
    }
    return "<tbody class=\"group\">\n" + out + "</tbody>\n";
}

std::string accuracyTable(const SurveyReport& report, MarkRole role, const MeasureTable& measures) {
    std::string bodies;
    for (const AccuracyGroup& group : report.accuracy) {
        if (group.role == role) bodies += groupRows(group, measures);
    }
    if (bodies.empty()) return {};
    return table(withMeasures({{"Compared"}, {"Axis"}}, measures), bodies);
}

std::string strataTables(const SurveyReport& report) {
    if (report.strata.empty()) return {};
    std::string usual, robust;
    for (const AccuracyStratum& stratum : report.strata) {
        usual += row(rowHead(stratum.name) + kUsualMeasures.cells(stratum.up));
        robust += row(rowHead(stratum.name) + kRobustMeasures.cells(stratum.up));
    }
    return "<h3>By the ground at the check marks</h3>\n" +
           note(
               "Height errors of the surface. Slopes are its own, over a metre; 10 % is the limit that the "
               "ASPRS "
               "standard sets for check marks.") +
           table(withMeasures({{"Ground"}}, kUsualMeasures), tableBody(usual)) +
           table(withMeasures({{"Ground"}}, kRobustMeasures), tableBody(robust));
}

std::string nssdaTable(const SurveyReport& report) {
    std::string rows;
    for (const AccuracyGroup& group : report.accuracy) {
        if (group.role != MarkRole::Check) continue;
        rows += row(rowHead(capitalised(name(group.stage))) + cell(Cell::Text, name(group.quantity)) +
                    metresCell(group.nssda_vertical_m.value_or(kMissing)) +
                    metresCell(group.nssda_horizontal_m.value_or(kMissing)));
    }
    if (rows.empty()) return {};
    return "<h3>Accuracy at 95 % confidence (NSSDA)</h3>\n" +
           note(
               "FGDC-STD-007.3-1998, errors taken for normal and unbiased: vertical 1.9600 RMSE; horizontal "
               "1.7308 "
               "times the RMSE of the distance, or 2.4477 times the mean RMSE of both axes where they "
               "differ; "
               "nothing where one is below 0.6 of the other. The standard asks for 20 check marks.") +
           table({{"Stage"}, {"Compared"}, {"Vertical", true}, {"Horizontal", true}}, tableBody(rows));
}

std::string countedInWords(const Residual& r) {
    if (r.used_by_estimator) return "no, used";
    return r.possible_blunder ? "yes, a possible blunder" : "yes";
}

std::string signedSigma(const Residual& r, Eigen::Index axis) {
    const double ratio = r.difference_enu_m[axis] / r.sigma_enu_m[axis];
    return fixedDecimals(ratio, 1);
}

std::string residualTable(const SurveyReport& report) {
    std::string rows;
    for (const Residual& r : report.residuals) {
        rows += fmt::format("<tr{}>", r.used_by_estimator ? " class=\"tied\"" : "") + nameHead(r.mark) +
                cell(Cell::Short, name(r.role)) + cell(Cell::Text, name(r.stage)) +
                cell(Cell::Text, name(r.quantity)) + cell(Cell::Name, r.run) +
                metresCell(r.difference_enu_m.x()) + metresCell(r.difference_enu_m.y()) +
                metresCell(r.difference_enu_m.z()) + metresCell(r.sigma_enu_m.z()) +
                cell(Cell::Number, signedSigma(r, 2)) +
                cell(Cell::Number, fixedDecimals(100.0 * r.slope, 0)) + cell(Cell::Short, name(r.cover)) +
                cell(Cell::Text, countedInWords(r)) + "</tr>\n";
    }
    if (rows.empty()) return {};
    return table({{"Mark"},
                  {"Role"},
                  {"Stage"},
                  {"Compared"},
                  {"Run"},
                  {"East [m]", true},
                  {"North [m]", true},
                  {"Up [m]", true},
                  {"Predicted sigma up [m]", true},
                  {"Up in sigmas", true},
                  {"Slope [%]", true},
                  {"Cover"},
                  {"Counted"}},
                 tableBody(rows));
}

std::string accuracySection(const SurveyReport& report) {
    const std::string check = accuracyTable(report, MarkRole::Check, kUsualMeasures);
    const std::string control = accuracyTable(report, MarkRole::Control, kUsualMeasures);
    std::string out;
    if (check.empty() && control.empty()) {
        out = note("No mark was compared with the product in a way that counts, so there are no figures.");
    } else {
        out = note(
            "All in metres; product less mark. SD divides by n \u2212 1. NMAD is 1.4826 times the median "
            "distance "
            "from the median: what the SD would be without outliers. |d| is the size of a difference. "
            "Intervals "
            "come from redrawing the marks.");
        out += "<h3>Check marks: used for nothing but these figures</h3>\n";
        out += check.empty() ? note("No check mark was compared.")
                             : check + accuracyTable(report, MarkRole::Check, kRobustMeasures);
        out += nssdaTable(report) + strataTables(report);
    }
    if (!control.empty()) {
        out += "<h3>Control marks: open to alignment and tuning, so they prove less</h3>\n" + control +
               accuracyTable(report, MarkRole::Control, kRobustMeasures);
    }
    out += folded(fmt::format("All comparisons, mark by mark: {}", groupedDigits(report.residuals.size())),
                  residualTable(report));
    return out;
}

// ---------------------------------------------------------------------------------------------- terrain
// model

std::string pairRow(std::string_view what, std::string_view value) {
    return row(rowHead(what) + cell(Cell::Text, value));
}

std::string adjustmentSection(const std::optional<AdjustmentSummary>& adjustment) {
    if (!adjustment) return "";
    const AdjustmentSummary& a = *adjustment;
    std::string rows;
    rows += pairRow("Unknowns", groupedDigits(a.unknowns));
    rows += pairRow("Crossovers",
                    fmt::format("{} pairs of passes over the same ground", groupedDigits(a.crossovers)));
    rows += pairRow("Their heights differ by",
                    fmt::format("{} m RMS after the filter, {} m after the adjustment",
                                metres3(a.misfit_before_m), metres3(a.misfit_after_m)));
    rows += pairRow("Rounds", fmt::format("{}, the last of which moved a track by {} m RMS", a.rounds,
                                          metres3(a.last_step_m)));
    if (a.crossover_test.n > 0) {
        rows +=
            pairRow("Their test of the sigmas",
                    fmt::format("{} of {} differences lie within 1.96 predicted sigmas, the mean square of "
                                "difference over sigma is {}; before crossovers were used",
                                groupedDigits(a.crossover_test.within), groupedDigits(a.crossover_test.n),
                                fixedDecimals(a.crossover_test.mean_square, 2)));
    }
    if (a.left_out.n > 0) {
        rows += pairRow("Crossovers left out of the adjustment",
                        fmt::format("{}; their heights differ by {} m RMS after the filter, {} m after the "
                                    "adjustment",
                                    groupedDigits(a.left_out.n), metres3(a.left_out.before_m),
                                    metres3(a.left_out.after_m)));
    }
    rows += pairRow("Variance of heights", a.crossover_test.n == 0
                                               ? "kept: no crossovers to test it"
                                               : fmt::format("multiplied by {}, see the crossovers' test",
                                                             fixedDecimals(a.height_inflation, 2)));
    rows += pairRow("Variance of the plan",
                    a.plan_inflation == 1.0 ? "kept: GNSS drifts as its noise says"
                                            : fmt::format("multiplied by {}: GNSS drifts by more than its "
                                                          "robust noise says",
                                                          fixedDecimals(a.plan_inflation, 2)));
    std::string noise =
        "<tr><th>Source of noise</th><th class=\"number\">Rows</th><th class=\"number\">Sigma "
        "times</th><th class=\"number\">Down-weighted</th></tr>\n";
    for (const NoiseFactor& n : a.noise) {
        noise += fmt::format(
            "<tr><td>{}</td><td class=\"number\">{}</td><td class=\"number\">{}</td><td "
            "class=\"number\">{}</td></tr>\n",
            escapedMarkup(n.source), groupedDigits(n.rows), fixedDecimals(n.factor, 2),
            groupedDigits(n.down_weighted));
    }
    return "<div class=\"scroll\"><table>\n" + tableBody(rows) + "</table></div>\n" +
           note(
               "Sigma times: by what factor the survey's own residuals say that a sigma of the settings is "
               "off. "
               "1 where it was not estimated.") +
           "<div class=\"scroll\"><table>\n" + noise + "</table></div>\n";
}

std::string edgesInWords(const TerraceEdgeSummary& e) {
    if (e.count == 0) return "none";
    return fmt::format("{}, {} m in all, median step {} m, place known to {} m (1 sigma)",
                       groupedDigits(e.count), fixedDecimals(e.length_m, 0),
                       fixedDecimals(e.median_step_m, 2), fixedDecimals(e.median_location_sigma_m, 2));
}

std::string comparisonTable(const InterpolationComparison& comparison) {
    std::vector<Heading> headings{{"Method"}};
    for (const std::string& hold_out : comparison.hold_outs) {
        for (const char* const measure : {"RMSE", "MAE", "95 %"}) {
            headings.push_back({fmt::format("{}, {} (m)", hold_out, measure), true});
        }
    }
    std::string rows;
    for (const std::string& method : comparison.ranking) {
        std::string cells = rowHead(method);
        for (const InterpolationScore& score : comparison.scores) {
            if (score.method != method) continue;
            for (const double value_m : {score.rmse_m, score.mean_absolute_m, score.error95_m}) {
                cells += metresCell(value_m);
            }
        }
        rows += row(cells);
    }
    return note(
               fmt::format("Ways of interpolating, the best first, by how well points that were left out are "
                           "foretold from the others (seed {}). Breaklines and edges take no part.",
                           comparison.seed)) +
           table(headings, tableBody(rows));
}

std::string surfaceSection(const SurveyReport& report) {
    const SurfaceReport& s = report.surface;
    std::string rows;
    rows += pairRow("Method", s.method);
    rows += pairRow("Method asked for, and used", fmt::format("{}, {}", s.method_requested, s.method_used));
    if (s.breaklines > 0) rows += pairRow("Breaklines", groupedDigits(s.breaklines));
    rows += pairRow("Terrace edges found", edgesInWords(s.terrace_edges));
    for (const std::string& text : s.notes) rows += pairRow("Note", text);
    rows += pairRow("Ground points", groupedDigits(s.points));
    rows += pairRow("Triangles", fmt::format("{}, no edge longer than {} m in plan",
                                             groupedDigits(s.triangles), fixedDecimals(s.longest_edge_m, 2)));
    rows += pairRow(
        "Area in plan",
        fmt::format("{} m\u00b2", std::isfinite(s.area_m2) && s.area_m2 >= 0.0 && s.area_m2 < 1e15
                                      ? groupedDigits(static_cast<std::size_t>(std::llround(s.area_m2)))
                                      : fixedDecimals(s.area_m2, 0)));
    rows += pairRow("Grid", fmt::format("{} \u00d7 {} cells of {:g} m", groupedDigits(s.columns),
                                        groupedDigits(s.rows), s.cell_m));
    rows += pairRow(
        "Cells with a height",
        fmt::format("{} ({}); the others are left empty, nothing is invented outside the walk",
                    groupedDigits(s.cells_with_height), share(s.cells_with_height, s.columns * s.rows)));
    if (s.uncertainty) {
        const UncertaintySummary& u = *s.uncertainty;
        rows += pairRow("Standard error of a height",
                        fmt::format("{} m in the middle, below {} m in 95 % of the cells",
                                    metres3(u.median_m), metres3(u.error95_m)));
        rows += pairRow("Cells",
                        fmt::format("{} measured, {} interpolated, {} extrapolated (farther than {} m "
                                    "from a point)",
                                    groupedDigits(u.measured), groupedDigits(u.interpolated),
                                    groupedDigits(u.extrapolated), fixedDecimals(u.greatest_distance_m, 1)));
        rows += pairRow("Interpolation",
                        fmt::format("{}{} heights foretold from the points around them, {} within 1.96 sigma",
                                    u.own_variance ? "the method\u2019s own variance, scaled; " : "",
                                    groupedDigits(u.left_out.n), share(u.left_out.within, u.left_out.n)));
    }
    if (s.variogram) rows += pairRow("Variogram", inWords(*s.variogram, "m"));
    rows += pairRow("Heights", fmt::format("{} m to {} m", metres3(s.lowest_m), metres3(s.highest_m)));
    rows += pairRow("Map frame", s.crs);
    rows += pairRow("Heights refer to", s.vertical_datum);
    return "<div class=\"scroll\"><table>\n" + tableBody(rows) + "</table></div>\n" +
           (s.comparison ? comparisonTable(*s.comparison) : "");
}

constexpr const char* kSpaceNote =
    "What the laser crossed is free, where it ended is occupied; of the rest nothing is known. Files: "
    "occupancy.bt and occupancy.ot for OctoMap, free_height.tif, and obstacle_height.tif where there is any "
    "obstacle.";

std::string occupancySection(const OccupancySummary& summary) {
    std::string rows;
    for (const auto& [word, line] : inWords(summary)) rows += pairRow(word, line);
    rows +=
        pairRow("Ground layer", fmt::format("what lies lower than {:g} m above the terrain model counts as "
                                            "ground; looked up to {:g} m",
                                            summary.ground_layer_m, summary.greatest_height_m));
    return "<div class=\"scroll\"><table>\n" + tableBody(rows) + "</table></div>\n" + note(kSpaceNote);
}

// ---------------------------------------------------------------------------------------------- runs

/// Line numbers with neighbours drawn together: "4, 17-19 and 3 more".
std::string lineList(const std::vector<std::size_t>& lines) {
    constexpr std::size_t kMost = 12;
    std::vector<std::string> parts;
    std::size_t listed = 0;
    for (std::size_t i = 0; i < lines.size() && parts.size() < kMost;) {
        std::size_t last = i;
        while (last + 1 < lines.size() && lines[last + 1] == lines[last] + 1) ++last;
        parts.push_back(last == i ? fmt::format("{}", lines[i])
                                  : fmt::format("{}\u2013{}", lines[i], lines[last]));
        listed += last - i + 1;
        i = last + 1;
    }
    std::string out = fmt::format("{}", fmt::join(parts, ", "));
    if (listed < lines.size()) out += fmt::format(" and {} more", groupedDigits(lines.size() - listed));
    return out;
}

/// Reasons in the order in which the runs name them first.
template <class Reasons>
std::vector<std::string> reasonsOf(const SurveyReport& report, Reasons reasons) {
    std::vector<std::string> names;
    for (const RunReport& run : report.runs) {
        for (const CountedReason& r : reasons(run)) {
            if (r.count > 0 && std::find(names.begin(), names.end(), r.reason) == names.end()) {
                names.push_back(r.reason);
            }
        }
    }
    return names;
}

std::size_t countOf(const std::vector<CountedReason>& reasons, std::string_view reason) {
    std::size_t count = 0;
    for (const CountedReason& r : reasons) {
        if (r.reason == reason) count += r.count;
    }
    return count;
}

std::string logTable(const SurveyReport& report) {
    const auto fixes = reasonsOf(report, [](const RunReport& r) { return r.fixes; });
    std::vector<Heading> headings{{"Run"},
                                  {"Kind"},
                                  {"Rows read", true},
                                  {"Repeated", true},
                                  {"Late", true},
                                  {"Epochs", true},
                                  {"Duration [s]", true},
                                  {"Longest gap [s]", true},
                                  {"Distance [m]", true}};
    for (const std::string& fix : fixes) headings.push_back({"Fix: " + fix, true});
    std::string rows;
    for (const RunReport& run : report.runs) {
        std::string cells = nameHead(run.id) + cell(Cell::Short, name(run.kind)) + number(run.rows_read) +
                            number(run.repeated_lines.size()) + number(run.late_lines.size()) +
                            number(run.epochs) + cell(Cell::Number, fixedDecimals(run.duration_s, 1)) +
                            cell(Cell::Number, fixedDecimals(run.longest_gap_s, 1)) +
                            cell(Cell::Number, fixedDecimals(run.distance_m, 1));
        for (const std::string& fix : fixes) {
            cells += cell(Cell::Number, share(countOf(run.fixes, fix), total(run.fixes)));
        }
        rows += row(cells);
    }
    return rows.empty() ? rows : table(headings, tableBody(rows));
}

std::string groundPointTable(const SurveyReport& report) {
    const auto reasons = reasonsOf(report, [](const RunReport& r) { return r.ground_points_rejected; });
    std::vector<Heading> headings{{"Run"}, {"Epochs", true}, {"Used", true}};
    for (const std::string& reason : reasons) headings.push_back({capitalised(reason), true});
    std::string rows;
    for (const RunReport& run : report.runs) {
        std::string cells = nameHead(run.id) + number(run.epochs) + number(run.ground_points_used);
        for (const std::string& reason : reasons)
            cells += number(countOf(run.ground_points_rejected, reason));
        rows += row(cells);
    }
    return rows.empty() ? rows : table(headings, tableBody(rows));
}

std::string logNotes(const SurveyReport& report) {
    std::vector<std::string> out;
    for (const RunReport& run : report.runs) {
        if (!run.repeated_lines.empty()) {
            out.push_back(fmt::format("{}: rows with a repeated time dropped, lines {}.", run.id,
                                      lineList(run.repeated_lines)));
        }
        if (!run.late_lines.empty()) {
            out.push_back(
                fmt::format("{}: late rows put in order, lines {}.", run.id, lineList(run.late_lines)));
        }
        if (run.cut_off_line > 0) {
            out.push_back(fmt::format("{}: the last row, line {}, is cut off and was dropped.", run.id,
                                      run.cut_off_line));
        }
        for (const std::string& words : run.notes) out.push_back(fmt::format("{}: {}", run.id, words));
    }
    return bullets(out);
}

std::string runSection(const SurveyReport& report) {
    if (report.runs.empty()) return note("The survey has no runs.");
    std::string out = "<h3>Logs</h3>\n" + logTable(report);
    out += folded("What the reader and the estimator met, run by run", logNotes(report));
    return out + "<h3>Ground points</h3>\n" +
           note("Used points make the surface; the others are kept with their reason.") +
           groundPointTable(report);
}

// ---------------------------------------------------------------------------------------------- sensors

std::string sensorCells(const SensorUse& use) {
    return cell(Cell::Text, use.sensor) + number(use.offered) + number(use.used) +
           cell(Cell::Number, share(use.used, use.offered)) + number(use.down_weighted) +
           number(total(use.rejections)) + cell(Cell::Text, reasonsText(use.rejections));
}

/// All runs together, in the order in which sensors and reasons come first.
std::vector<SensorUse> summed(const SurveyReport& report) {
    std::vector<SensorUse> sums;
    for (const RunReport& run : report.runs) {
        for (const SensorUse& use : run.sensors) {
            auto sum = std::find_if(sums.begin(), sums.end(),
                                    [&](const SensorUse& s) { return s.sensor == use.sensor; });
            if (sum == sums.end()) {
                sums.push_back(use);
                continue;
            }
            sum->offered += use.offered;
            sum->used += use.used;
            sum->down_weighted += use.down_weighted;
            for (const SensorUse::Rejection& r : use.rejections) {
                auto known =
                    std::find_if(sum->rejections.begin(), sum->rejections.end(),
                                 [&](const SensorUse::Rejection& k) { return k.reason == r.reason; });
                if (known == sum->rejections.end()) {
                    sum->rejections.push_back(r);
                } else {
                    known->count += r.count;
                }
            }
        }
    }
    return sums;
}

std::string sensorSection(const SurveyReport& report) {
    const std::vector<SensorUse> sums = summed(report);
    if (sums.empty()) return note("No sensor was offered to an estimator.");
    std::vector<Heading> headings{{"Sensor"},
                                  {"Offered", true},
                                  {"Used", true},
                                  {"Used share", true},
                                  {"Of these down-weighted", true},
                                  {"Rejected", true},
                                  {"Reasons"}};
    std::string all;
    for (const SensorUse& use : sums) all += row(sensorCells(use));
    std::string out = note("Measurements of all runs together: offered = used + rejected.") +
                      table(headings, tableBody(all));
    if (report.runs.size() < 2) return out;
    headings.insert(headings.begin(), Heading{"Run"});
    std::string bodies;
    for (const RunReport& run : report.runs) {
        std::string rows;
        for (const SensorUse& use : run.sensors)
            rows += row(nameHead(rows.empty() ? run.id : "") + sensorCells(use));
        if (!rows.empty()) bodies += "<tbody class=\"group\">\n" + rows + "</tbody>\n";
    }
    return out + folded("Run by run", table(headings, bodies));
}

// ---------------------------------------------------------------------------------------------- tuning

std::string tuningSection(const SurveyReport& report) {
    if (!report.tuning) return {};
    const TuningRecord& t = *report.tuning;
    std::string rows =
        pairRow("Tuned values", t.in_use ? "used for this product" : "not used") +
        pairRow("Method", t.method) + pairRow("Tuned on the survey", t.survey) + pairRow("By", t.program) +
        pairRow("Search", fmt::format("{}, population {}, {} iterations, seed {}", t.optimiser, t.population,
                                      t.iterations, t.seed)) +
        pairRow("Evaluations, in all", groupedDigits(t.evaluations)) + pairRow("Loss", t.loss) +
        pairRow("Loss before and after", fmt::format("{:.5g} \u2192 {:.5g}", t.loss_before, t.loss_after));
    if (t.left_out_before && t.left_out_after) {
        rows += pairRow("The same on parts left out of the tuning",
                        fmt::format("{:.5g} \u2192 {:.5g}", *t.left_out_before, *t.left_out_after));
    }
    std::vector<std::string> marks;
    for (const ControlMark& mark : t.marks) marks.push_back(mark.name);
    rows += pairRow("Marks tuned on", fmt::format("{}", fmt::join(marks, ", ")));
    return note(t.decision) + "<div class=\"scroll\"><table>\n" + tableBody(rows) + "</table></div>\n" +
           bullets(t.warnings);
}

// ---------------------------------------------------------------------------------------------- record

std::string settingsTable(const SurveyReport& report) {
    std::string changed, others;
    for (const UsedSetting& s : report.settings) {
        const bool is_default = s.requested == "default";
        (is_default ? others : changed) += fmt::format("<tr{}>", is_default ? "" : " class=\"changed\"") +
                                           cell(Cell::Key, s.key) + cell(Cell::Key, s.requested) +
                                           cell(Cell::Key, s.used) + "</tr>\n";
    }
    if (changed.empty() && others.empty()) return {};
    return table({{"Setting"}, {"Requested"}, {"Used"}}, tableBody(changed + others));
}

std::string inputTable(const SurveyReport& report) {
    std::string rows;
    for (const InputFile& input : report.inputs) {
        rows += row(cell(Cell::Name, input.path) + number(input.bytes) + cell(Cell::Hash, input.sha256));
    }
    return rows.empty() ? rows : table({{"File"}, {"Bytes", true}, {"SHA-256"}}, tableBody(rows));
}

std::string recordSection(const SurveyReport& report) {
    const auto changed = static_cast<std::size_t>(
        std::count_if(report.settings.begin(), report.settings.end(),
                      [](const UsedSetting& s) { return s.requested != "default"; }));
    std::string rows = pairRow("Program", "Terrawalk " + report.program_version) +
                       pairRow("Method of fusion", report.method) +
                       pairRow("Seed of random numbers", fmt::format("{}", report.seed));
    return "<div class=\"scroll\"><table>\n" + tableBody(rows) + "</table></div>\n" +
           folded(fmt::format("Settings: {} in all, {} other than default", report.settings.size(), changed),
                  settingsTable(report)) +
           folded(fmt::format("Input files: {}", report.inputs.size()), inputTable(report));
}

}  // namespace

std::string reportHtml(const SurveyReport& report) {
    std::string out = "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\"/>\n";
    out += "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\"/>\n";
    out += fmt::format("<title>{} \u2013 survey report</title>\n<style>{}</style>\n</head>\n<body>\n",
                       escapedMarkup(titleOf(report)), kReportStyle);
    out += header(report) + figureCards(report);
    out += "<main>\n" + verdict(report) + limitations(report);
    out += section("map", "Map of the walk", mapSection(report));
    out += section("errors", "Errors at the marks", errorSection(report));
    out += section("accuracy", "Accuracy", accuracySection(report));
    if (report.adjustment) {
        out += section("adjustment", "Adjustment of all runs", adjustmentSection(report.adjustment));
    }
    out += section("surface", "Terrain model", surfaceSection(report));
    if (report.occupancy) {
        out += section("occupancy", "Space above the ground", occupancySection(*report.occupancy));
    }
    out += section("runs", "Runs", runSection(report));
    out += section("sensors", "Use of the sensors", sensorSection(report));
    out += section("tuning", "Tuning", tuningSection(report));
    out += section("record", "Record", recordSection(report));
    out +=
        "</main>\n<footer>Made by Terrawalk from the files listed above. The same figures stand in "
        "report.json, the "
        "comparisons in residuals.csv.</footer>\n</body>\n</html>\n";
    return report.language == ReportLanguage::Chinese ? chinesePage(out) : out;
}

Result<void> writeReportHtml(const SurveyReport& report, const std::filesystem::path& file) {
    return writeTextFile(reportHtml(report), file);
}

}  // namespace terrawalk
