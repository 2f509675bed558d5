// Evenness of initial populations in two dimensions: good points, random points, a Levy flight.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "app/pipeline/experiments/experiments.hpp"
#include "fusion/good_points.hpp"
#include "fusion/random_numbers.hpp"

namespace terrawalk {

namespace {

constexpr std::size_t kDimensions = 2;
constexpr std::size_t kPopulation = 100;  // paper 000, section 3

std::vector<double> randomPoints(RandomNumbers& random) {
    std::vector<double> points(kPopulation * kDimensions);
    for (double& value : points) value = random.uniform();
    return points;
}

/// One step of a Levy-stable law of index 1.5. Source: Mantegna 1994.
double levyStep(RandomNumbers& random) {
    constexpr double beta = 1.5;
    static const double sigma =
        std::pow(std::tgamma(1.0 + beta) * std::sin(std::numbers::pi * beta / 2.0) /
                     (std::tgamma((1.0 + beta) / 2.0) * beta * std::pow(2.0, (beta - 1.0) / 2.0)),
                 1.0 / beta);
    return sigma * random.normal() / std::pow(std::abs(random.normal()), 1.0 / beta);
}

/// Folds a coordinate back into the unit interval at its ends, as a mirror would.
double mirrored(double value) {
    const double twice = value - 2.0 * std::floor(0.5 * value);
    return twice <= 1.0 ? twice : 2.0 - twice;
}

std::vector<double> levyFlight(RandomNumbers& random) {
    constexpr double kStep = 0.1;
    std::vector<double> points(kPopulation * kDimensions);
    std::array<double, kDimensions> at{};
    for (double& value : at) value = random.uniform();
    for (std::size_t k = 0; k < kPopulation; ++k) {
        for (std::size_t j = 0; j < kDimensions; ++j) {
            points[k * kDimensions + j] = at[j];
            at[j] = mirrored(at[j] + kStep * levyStep(random));
        }
    }
    return points;
}

struct Method {
    std::string name;
    std::string paper;
    std::function<std::vector<double>(RandomNumbers&)> draw;
};

PlotPanel scatter(const std::string& title, const std::vector<double>& points, int colour) {
    PlotSeries series{.look = SeriesLook::Points, .colour = colour};
    for (std::size_t k = 0; k + 1 < points.size(); k += kDimensions) {
        series.points.emplace_back(points[k], points[k + 1]);
    }
    return {.title = title,
            .x = {.label = "first coordinate", .range = std::pair{0.0, 1.0}},
            .y = {.label = "second coordinate", .range = std::pair{0.0, 1.0}},
            .series = {series},
            .equal_scales = true};
}

}  // namespace

Result<ExperimentReport> runFig8(const ExperimentOptions& options, Progress& progress, std::stop_token stop) {
    const int draws = options.quick ? 10 : 50;
    const std::vector<Method> methods{
        {"good points", "most even, the same in each draw",
         [](RandomNumbers&) {
             return goodPoints(kPopulation, kDimensions);
         }},
        {"random", "uneven, differs from draw to draw", randomPoints},
        {"Levy flight", "least even, leaves blank areas", levyFlight},
    };
    ExperimentReport report{.title = "Fig 8: evenness of initial populations", .simulated = false};
    report.summary.columns = {"population", "mean discrepancy", "least", "greatest", "SD", "paper 000"};
    report.data.columns = {"population", "draw", "centred L2 discrepancy"};
    PlotPanel boxes{.title = "Discrepancy of each draw",
                    .y = {.label = "centred L2 discrepancy", .logarithmic = true}};
    for (std::size_t m = 0; m < methods.size(); ++m) {
        const Method& method = methods[m];
        std::vector<double> values;
        for (int draw = 0; draw < draws; ++draw) {
            if (stop.stop_requested()) return cancelled();
            RandomNumbers random({options.seed, m, static_cast<std::uint64_t>(draw)});
            const std::vector<double> points = method.draw(random);
            values.push_back(centredDiscrepancy(points, kDimensions));
            report.data.rows.push_back({method.name, static_cast<double>(draw + 1), values.back()});
            if (draw == 0) {
                report.plot.panels.push_back(scatter(method.name + ", draw 1", points, static_cast<int>(m)));
            }
            progress.report(static_cast<double>(m) / static_cast<double>(methods.size()), method.name);
        }
        // From the first value on, so that equal values have no spread at all.
        double mean = values.front();
        double squares = 0.0;
        for (const double v : values) mean += (v - values.front()) / draws;
        for (const double v : values) squares += (v - mean) * (v - mean);
        const auto [least, greatest] = std::minmax_element(values.begin(), values.end());
        report.summary.rows.push_back(
            {method.name, mean, *least, *greatest, std::sqrt(squares / (draws - 1)), method.paper});
        boxes.samples.push_back({.name = method.name, .values = values, .colour = static_cast<int>(m)});
    }
    report.plot.panels.push_back(boxes);
    report.plot.columns = 2;
    report.notes = {
        fmt::format("{} draws of {} points in {} dimensions; the discrepancy is 0 for a perfectly even set",
                    draws, kPopulation, kDimensions),
        "the paper gives no figures, only pictures; its wording stands in the last column",
        "the good point set has no random part, so every draw is the same set",
        "Levy flight: index 1.5 (Mantegna), steps of a tenth of the box, mirrored at its borders; the paper "
        "does not say which it used",
    };
    return report;
}

}  // namespace terrawalk
