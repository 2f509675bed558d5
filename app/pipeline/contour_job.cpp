#include "app/pipeline/contour_job.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/pipeline/raster_input.hpp"
#include "app/pipeline/version.hpp"
#include "io/write_exchange.hpp"

namespace terrawalk {

namespace {

constexpr double kLabelCells = 3.0;  // height of a label in DXF

}  // namespace

Result<ContourOutcome> makeContours(const ContourRequest& request, Progress& progress, std::stop_token stop) {
    progress.report(0.0, "reading");
    const auto dem = readDem(request.dem, stop);
    if (!dem) return tl::unexpected(dem.error());
    if (request.options.interval > 0.0) {
        const auto fits =
            checkMemoryFor("contours of these cells", contourMemory_bytes(dem->grid, request.options),
                           "choose a larger interval, or cut out a part");
        if (!fits) return tl::unexpected(fits.error());
    }
    PartialProgress cutting(progress, 0.1, 0.8);
    const auto set = contourLines(dem->grid, request.options, cutting, stop);
    if (!set) return tl::unexpected(set.error());
    progress.report(0.8, "writing");
    const ExchangeDescription description{dem->crs.wkt2, dem->crs.name, request.dem.stem().string(),
                                          programVersion()};
    if (auto done = writeContours(set->contours, kLabelCells * dem->grid.geometry.cell_m, description,
                                  request.output, stop);
        !done) {
        return tl::unexpected(done.error());
    }
    ContourOutcome outcome{request, dem->crs.unit.symbol};
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
        "Contours    {} lines at {} levels from {:g} to {:g} {}, {:.1f} {} long\nSmoothing   {:g} cells, "
        "moved the "
        "heights by {:.4f} {} (RMS)\nWritten to {}\n",
        o.lines, o.levels, o.lowest, o.highest, o.unit, o.length, o.unit, o.request.options.smoothing_cells,
        o.smoothing_rms, o.unit, printable(o.request.output.string()));
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
                                          {"lines", o.lines},
                                          {"levels", o.levels},
                                          {"lowest", o.lowest},
                                          {"highest", o.highest},
                                          {"length", o.length}};
    return document.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace terrawalk
