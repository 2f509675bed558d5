#include "app/pipeline/contour_job.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>

#include "app/pipeline/raster_input.hpp"
#include "app/pipeline/version.hpp"
#include "io/write_exchange.hpp"

namespace terrawalk {

namespace {

constexpr double kLabelCells = 3.0;  // height of a label in DXF

/// The standard errors that were named, or those that lie beside the DEM.
Result<std::optional<ElevationGrid>> sigmasFor(const ContourRequest& request, const DemFile& dem,
                                               std::filesystem::path& used, std::string& note,
                                               const std::stop_token& stop) {
    used = request.uncertainty;
    if (used.empty()) {
        used = request.dem.parent_path() / (request.dem.stem().string() + "_uncertainty.tif");
        if (std::error_code error; !std::filesystem::is_regular_file(used, error)) used.clear();
    }
    if (request.options.smoothing_cells == 0.0) used.clear();
    if (used.empty()) return std::nullopt;
    auto read = readErrorsAlike(used, dem, stop);
    if (read) {
        if (mayBelongTo(*read, dem.grid)) return std::move(read->grid);
        note = fmt::format("the standard errors of {} say that they are of other heights{}",
                           printable(used.filename().string()),
                           request.uncertainty.empty() ? ", and are not used" : "");
        if (!request.uncertainty.empty()) return std::move(read->grid);
        used.clear();
        return std::nullopt;
    }
    if (!request.uncertainty.empty() || read.error().kind == ErrorKind::Cancelled) {
        return tl::unexpected(read.error());
    }
    used.clear();
    return std::nullopt;
}

std::string counted(std::size_t n, std::string_view thing) {
    return fmt::format("{} {}{}", n, thing, n == 1 ? "" : "s");
}

}  // namespace

Result<ContourOutcome> makeContours(const ContourRequest& request, Progress& progress, std::stop_token stop) {
    progress.report(0.0, "reading");
    const auto dem = readDem(request.dem, stop);
    if (!dem) return tl::unexpected(dem.error());
    ContourOutcome outcome{request, dem->crs.unit.symbol};
    const auto sigmas = sigmasFor(request, *dem, outcome.uncertainty, outcome.note, stop);
    if (!sigmas) return tl::unexpected(sigmas.error());
    ContourOptions options = request.options;
    if (*sigmas) options.sigmas = &**sigmas;
    if (options.interval > 0.0) {
        const auto fits = checkMemoryFor("contours of these cells", contourMemory_bytes(dem->grid, options),
                                         "choose a larger interval, or cut out a part");
        if (!fits) return tl::unexpected(fits.error());
    }
    PartialProgress cutting(progress, 0.1, 0.8);
    const auto set = contourLines(dem->grid, options, cutting, stop);
    if (!set) return tl::unexpected(set.error());
    progress.report(0.8, "writing");
    const ExchangeDescription description{dem->crs.wkt2, dem->crs.name, request.dem.stem().string(),
                                          programVersion()};
    if (auto done = writeContours(set->contours, kLabelCells * dem->grid.geometry.cell_m, description,
                                  request.output, stop);
        !done) {
        return tl::unexpected(done.error());
    }
    outcome.smoothing_rms = set->smoothing_rms;
    outcome.lines = set->contours.size();
    outcome.lowest = set->contours.front().level;
    outcome.highest = set->contours.back().level;
    for (std::size_t i = 0; i < set->contours.size(); ++i) {
        const Contour& contour = set->contours[i];
        outcome.levels += i == 0 || contour.level != set->contours[i - 1].level ? 1 : 0;
        for (std::size_t k = 0; k + 1 < contour.vertices.size(); ++k) {
            outcome.length += (contour.vertices[k + 1] - contour.vertices[k]).norm();
        }
    }
    progress.report(1.0, "done");
    return outcome;
}

std::string toText(const ContourOutcome& o) {
    return fmt::format(
        "Contours    {} at {} from {:g} to {:g} {}, {:.1f} {} long\nSmoothing   {:g} {}{}, moved the "
        "heights "
        "by {:.4f} {} (RMS)\n{}Written to {}\n",
        counted(o.lines, "line"), counted(o.levels, "level"), o.lowest, o.highest, o.unit, o.length, o.unit,
        o.request.options.smoothing_cells, o.request.options.smoothing_cells == 1.0 ? "cell" : "cells",
        o.uncertainty.empty()
            ? ""
            : fmt::format(", and {:g} within the standard errors of {}", kSmoothingInErrors_cells,
                          printable(o.uncertainty.filename().string())),
        o.smoothing_rms, o.unit, o.note.empty() ? "" : fmt::format("Note: {}\n", o.note),
        printable(o.request.output.string()));
}

std::string toJson(const ContourOutcome& o) {
    const nlohmann::ordered_json document{{"format", "terrawalk-contours 1"},
                                          {"dem", o.request.dem.string()},
                                          {"output", o.request.output.string()},
                                          {"unit", o.unit},
                                          {"interval", o.request.options.interval},
                                          {"base", o.request.options.base},
                                          {"smoothing_cells", o.request.options.smoothing_cells},
                                          {"smoothing_rms", o.smoothing_rms},
                                          {"uncertainty", o.uncertainty.string()},
                                          {"note", o.note},
                                          {"lines", o.lines},
                                          {"levels", o.levels},
                                          {"lowest", o.lowest},
                                          {"highest", o.highest},
                                          {"length", o.length}};
    return document.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace terrawalk
