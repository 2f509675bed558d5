#include "app/pipeline/walk_advice_job.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/pipeline/raster_input.hpp"
#include "app/pipeline/version.hpp"
#include "io/write_exchange.hpp"
#include "mapping/order_statistics.hpp"

namespace terrawalk {

namespace {

constexpr double kDefaultMultiple = 2.0;  // of the median sigma
constexpr double kLeastArea_m2 = 25.0;    // of a piece that is worth a walk in a large field
constexpr double kLeastShare = 0.01;      // of the field
constexpr double kBytesPerCell = 28.0;
constexpr std::size_t kRegionsInText = 10;

}  // namespace

Result<WalkAdviceOutcome> adviseWalk(const WalkAdviceRequest& request, Progress& progress,
                                     std::stop_token stop) {
    if (!(request.target_sigma >= 0.0) || !(request.least_area.value_or(0.0) >= 0.0)) {
        return usageError("the target and the area may not be below zero");
    }
    progress.report(0.0, "reading");
    const auto raster = readDem(request.uncertainty, stop);
    if (!raster) return tl::unexpected(raster.error());
    const GridGeometry& g = raster->grid.geometry;
    if (auto fits = checkCellMemory(g.size(), kBytesPerCell, "looking for weak ground in"); !fits) {
        return tl::unexpected(fits.error());
    }
    std::vector<double> known;
    for (const float sigma : raster->grid.heights_m) {
        if (std::isnan(sigma)) continue;
        if (sigma < 0.0F)
            return badData("a sigma below zero: this is no raster of uncertainty", request.uncertainty);
        known.push_back(sigma);
    }
    if (known.empty()) return badData("no cell has a sigma", request.uncertainty);
    WalkAdviceOutcome outcome{request, raster->crs.unit.symbol};
    outcome.median_sigma = median(known);
    outcome.target_sigma =
        request.target_sigma > 0.0 ? request.target_sigma : kDefaultMultiple * outcome.median_sigma;
    const double cell_area = g.cell_m * g.cell_m;
    outcome.area_known = cell_area * static_cast<double>(known.size());
    outcome.least_area = request.least_area.value_or(
        std::min(kLeastArea_m2 / std::pow(raster->crs.unit.metres, 2.0), kLeastShare * outcome.area_known));
    outcome.area_above =
        cell_area * static_cast<double>(std::count_if(known.begin(), known.end(), [&](double sigma) {
            return sigma > outcome.target_sigma;
        }));
    progress.report(0.5, "looking for weak ground");
    const WeakRegions found = weakRegions(raster->grid, {outcome.target_sigma, outcome.least_area});
    std::vector<MapRegion> regions;
    for (const WeakRegion& region : found.regions) {
        regions.push_back({region.label,
                           {{"area", region.area},
                            {"mean_sigma", region.mean_sigma},
                            {"greatest_sigma", region.greatest_sigma},
                            {"gain", region.gain}}});
    }
    progress.report(0.8, "writing");
    const ExchangeDescription description{raster->crs.wkt2, raster->crs.name, "", programVersion()};
    if (auto done = writeRegions(g, found.labels, regions, description, request.output, stop); !done) {
        return tl::unexpected(done.error());
    }
    outcome.regions = found.regions;
    progress.report(1.0, "done");
    return outcome;
}

std::string toText(const WalkAdviceOutcome& o) {
    std::string text =
        fmt::format("Target      sigma {:.4f} {}; the median is {:.4f}\nAbove it    {:.1f} of {:.1f} {}2\n",
                    o.target_sigma, o.unit, o.median_sigma, o.area_above, o.area_known, o.unit);
    if (o.regions.empty()) {
        text += fmt::format("No piece of {:.4g} {}2 or more is known worse{}\n", o.least_area, o.unit,
                            o.area_above > 0.0 ? "; --least-area takes smaller ones" : "");
    } else {
        text += fmt::format("{:>4}{:>12}{:>12}{:>14}\n", "rank", "area", "mean sigma", "share of gain");
        double all = 0.0;
        for (const WeakRegion& region : o.regions) all += region.gain;
        for (std::size_t i = 0; i < std::min(o.regions.size(), kRegionsInText); ++i) {
            const WeakRegion& region = o.regions[i];
            text += fmt::format("{:>4}{:>12.1f}{:>12.4f}{:>13.1f}%\n", region.label, region.area,
                                region.mean_sigma, 100.0 * region.gain / all);
        }
        if (o.regions.size() > kRegionsInText) {
            text += fmt::format("and {} more in the file\n", o.regions.size() - kRegionsInText);
        }
    }
    return text + "Written to " + printable(o.request.output.string()) + "\n";
}

std::string toJson(const WalkAdviceOutcome& o) {
    nlohmann::ordered_json document{
        {"format", "terrawalk-walk-again 1"},  {"uncertainty", o.request.uncertainty.string()},
        {"output", o.request.output.string()}, {"unit", o.unit},
        {"target_sigma", o.target_sigma},      {"median_sigma", o.median_sigma},
        {"least_area", o.least_area},          {"area_above_target", o.area_above},
        {"area_known", o.area_known},          {"regions", nlohmann::ordered_json::array()}};
    for (const WeakRegion& region : o.regions) {
        document["regions"].push_back({{"rank", region.label},
                                       {"area", region.area},
                                       {"mean_sigma", region.mean_sigma},
                                       {"greatest_sigma", region.greatest_sigma},
                                       {"gain", region.gain}});
    }
    return document.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace terrawalk
