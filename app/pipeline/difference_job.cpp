#include "app/pipeline/difference_job.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "app/pipeline/raster_input.hpp"
#include "io/output_folder.hpp"
#include "mapping/dem_difference.hpp"

namespace terrawalk {

namespace {

namespace fs = std::filesystem;

constexpr double kBytesPerCell = 40.0;  // two DEMs, change, significance, sigmas and what writing takes

Result<void> checkRequest(const DifferenceRequest& r) {
    for (const double value : {r.sigma, r.correlation_range.value_or(0.0), r.common_sigma}) {
        if (!(value >= 0.0) || !std::isfinite(value))
            return usageError("sigmas and ranges may not be below zero");
    }
    const bool has_sigma = r.sigma > 0.0 || r.common_sigma > 0.0 ||
                           (!r.earlier_uncertainty.empty() && !r.later_uncertainty.empty());
    if (!has_sigma) {
        return usageError("without a sigma no change can be told from error",
                          "give --sigma, or --earlier-uncertainty and --later-uncertainty");
    }
    return {};
}

fs::path besideOutput(const DifferenceRequest& r, const std::string& ending) {
    return r.output.parent_path() / (r.output.stem().string() + ending);
}

struct Row {
    const char* cells;
    const char* part;
    double volume;
    double sigma;
    double area;
};
std::vector<Row> rowsOf(const DifferenceOutcome& o) {
    std::vector<Row> rows;
    for (const auto& [cells, v] : {std::pair{"all", &o.all}, std::pair{"significant", &o.significant}}) {
        rows.push_back({cells, "raised", v->above.volume_m3, v->above.sigma_m3, v->above.area_m2});
        rows.push_back({cells, "lowered", v->below.volume_m3, v->below.sigma_m3, v->below.area_m2});
        rows.push_back({cells, "net", v->net_m3, v->net_sigma_m3, v->area_m2});
    }
    return rows;
}

std::string tableOf(const DifferenceOutcome& o) {
    std::string csv =
        fmt::format("cells,part,volume_{}3,standard_error_{}3,area_{}2\n", o.unit, o.unit, o.unit);
    for (const Row& row : rowsOf(o)) {
        csv +=
            fmt::format("{},{},{:.4f},{:.4f},{:.4f}\n", row.cells, row.part, row.volume, row.sigma, row.area);
    }
    return csv;
}

}  // namespace

Result<DifferenceOutcome> compareDems(const DifferenceRequest& request, Progress& progress,
                                      std::stop_token stop) {
    if (auto checked = checkRequest(request); !checked) return tl::unexpected(checked.error());
    progress.report(0.0, "reading");
    const auto later = readDem(request.later, stop);
    if (!later) return tl::unexpected(later.error());
    if (auto fits = checkCellMemory(later->grid.geometry.size(), kBytesPerCell, "comparing"); !fits) {
        return tl::unexpected(fits.error());
    }
    const auto earlier = readAlike(request.earlier, *later, stop);
    if (!earlier) return tl::unexpected(earlier.error());
    ElevationGrid change = later->grid;
    for (std::size_t i = 0; i < change.heights_m.size(); ++i) change.heights_m[i] -= earlier->heights_m[i];
    auto sigmas = combinedSigmas({{request.earlier_uncertainty, request.sigma, &*earlier},
                                  {request.later_uncertainty, request.sigma, &later->grid}},
                                 *later, change, stop);
    if (!sigmas) return tl::unexpected(sigmas.error());
    progress.report(0.4, "comparing");
    const double range = request.correlation_range.value_or(sigmas->correlation_range);
    auto compared =
        demDifference(later->grid, *earlier, {std::move(sigmas->sigmas), range, request.common_sigma}, stop);
    if (!compared) return tl::unexpected(compared.error());
    const DemDifference& d = *compared;
    if (d.all.cells == 0) return badData("no cell has a height in both", request.later);
    if (stop.stop_requested()) return cancelled();
    DifferenceOutcome outcome{request,
                              later->crs.unit.symbol,
                              d.all,
                              d.significant,
                              d.raised,
                              d.lowered,
                              range,
                              {},
                              std::move(sigmas->of_other_heights)};
    outcome.files = {request.output, besideOutput(request, "_significance.tif"),
                     besideOutput(request, "_volumes.csv")};
    progress.report(0.7, "writing");
    const std::string title =
        fmt::format("{} less {}", request.later.stem().string(), request.earlier.stem().string());
    const std::string& unit = outcome.unit;
    if (auto done = writeDem(d.change, describeDerived(*later, title, "Change of height", unit, "difference"),
                             outcome.files[0], stop);
        !done) {
        return tl::unexpected(done.error());
    }
    const DemDescription significance =
        describeDerived(*later, title + ", significance at 95 %", "Raised (1), lowered (-1), unsure (0)", "1",
                        "difference beyond 1.96 sigma");
    if (auto done = writeDem(d.significance, significance, outcome.files[1], stop); !done) {
        return tl::unexpected(done.error());
    }
    if (auto done = writeTextFile(tableOf(outcome), outcome.files[2]); !done) {
        return tl::unexpected(done.error());
    }
    progress.report(1.0, "done");
    return outcome;
}

std::string toText(const DifferenceOutcome& o) {
    const double n = static_cast<double>(o.all.cells);
    std::string text = fmt::format(
        "Cells       {} in both; beyond 1.96 sigma {} raised ({:.1f} %), {} lowered ({:.1f} %)\n"
        "{:<12}{:<9}{:>16}{:>16}{:>14}\n",
        o.all.cells, o.raised, 100.0 * static_cast<double>(o.raised) / n, o.lowered,
        100.0 * static_cast<double>(o.lowered) / n, "cells", "part", "volume " + o.unit + "3",
        "standard error", "area " + o.unit + "2");
    for (const Row& row : rowsOf(o)) {
        text += fmt::format("{:<12}{:<9}{:>16.3f}{:>16.3f}{:>14.2f}\n", row.cells, row.part, row.volume,
                            row.sigma, row.area);
    }
    text += notesOn(o.of_other_heights);
    for (const fs::path& file : o.files) text += "Written to " + printable(file.string()) + "\n";
    return text;
}

std::string toJson(const DifferenceOutcome& o) {
    const DifferenceRequest& r = o.request;
    nlohmann::ordered_json files = nlohmann::ordered_json::array();
    for (const fs::path& file : o.files) files.push_back(file.string());
    nlohmann::ordered_json document{{"format", "terrawalk-difference 1"},
                                    {"earlier", r.earlier.string()},
                                    {"later", r.later.string()},
                                    {"unit", o.unit},
                                    {"sigma", r.sigma},
                                    {"correlation_range", o.correlation_range},
                                    {"common_sigma", r.common_sigma},
                                    {"cells", o.all.cells},
                                    {"cells_raised", o.raised},
                                    {"cells_lowered", o.lowered},
                                    {"volumes", nlohmann::ordered_json::array()},
                                    {"files", files}};
    for (const Row& row : rowsOf(o)) {
        document["volumes"].push_back({{"cells", row.cells},
                                       {"part", row.part},
                                       {"volume", row.volume},
                                       {"standard_error", row.sigma},
                                       {"area", row.area}});
    }
    return document.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace terrawalk
