#include "app/pipeline/volume_job.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "app/pipeline/raster_input.hpp"

namespace terrawalk {
namespace {

constexpr std::size_t kCellsBetweenStops = std::size_t{1} << 20U;

Result<void> checkRequest(const VolumeRequest& r) {
    if (r.plane.has_value() == !r.against.empty()) {
        return usageError("a volume lies between the DEM and a plane or another DEM",
                          "give --plane or --against");
    }
    if (r.against.empty() && !r.against_uncertainty.empty()) {
        return usageError("a plane has no uncertainty", "leave out --against-uncertainty");
    }
    for (const double value : {r.sigma, r.correlation_range.value_or(0.0), r.common_sigma}) {
        if (!(value >= 0.0) || !std::isfinite(value))
            return usageError("sigmas and ranges may not be below zero");
    }
    if (r.plane && !std::isfinite(*r.plane)) return usageError("the plane has no height");
    return {};
}

}  // namespace

Result<VolumeOutcome> measureVolume(const VolumeRequest& request, Progress& progress, std::stop_token stop) {
    if (auto checked = checkRequest(request); !checked) return tl::unexpected(checked.error());
    progress.report(0.0, "reading");
    const auto dem = readDem(request.dem, stop);
    if (!dem) return tl::unexpected(dem.error());
    ElevationGrid difference = dem->grid;
    std::size_t cells_in_one = 0;
    ElevationGrid against;
    if (request.plane) {
        for (std::size_t cell = 0; cell < difference.heights_m.size(); ++cell) {
            if (cell % kCellsBetweenStops == 0 && stop.stop_requested()) return cancelled();
            float& height = difference.heights_m[cell];
            height = static_cast<float>(static_cast<double>(height) - *request.plane);
        }
    } else {
        auto other = readAlike(request.against, *dem, stop);
        if (!other) return tl::unexpected(other.error());
        for (std::size_t cell = 0; cell < difference.heights_m.size(); ++cell) {
            if (cell % kCellsBetweenStops == 0 && stop.stop_requested()) return cancelled();
            cells_in_one += std::isnan(difference.heights_m[cell]) != std::isnan(other->heights_m[cell]);
            difference.heights_m[cell] -= other->heights_m[cell];
        }
        if (!request.against_uncertainty.empty()) against = std::move(*other);
    }
    VolumeErrorModel errors;
    std::vector<SigmaSource> sources{{request.uncertainty, request.sigma, &dem->grid}};
    if (!request.plane) sources.push_back({request.against_uncertainty, request.sigma, &against});
    auto sigmas = combinedSigmas(sources, *dem, difference, stop);
    if (!sigmas) return tl::unexpected(sigmas.error());
    errors.sigmas_m = std::move(sigmas->sigmas);
    errors.correlation_range_m = request.correlation_range.value_or(sigmas->correlation_range);
    errors.common_sigma_m = request.common_sigma;
    progress.report(0.6, "summing");
    const auto volume = volumeOf(difference, errors, stop);
    if (!volume) return tl::unexpected(volume.error());
    VolumeOutcome outcome{request,      dem->crs.unit.symbol,
                          *volume,      errors.correlation_range_m,
                          cells_in_one, std::move(sigmas->of_other_heights)};
    if (outcome.volume.cells == 0) {
        return badData(request.plane ? "no cell has a height" : "no cell has a height in both", request.dem);
    }
    if (stop.stop_requested()) return cancelled();
    progress.report(1.0, "done");
    return outcome;
}

std::string toText(const VolumeOutcome& outcome) {
    const VolumeResult& v = outcome.volume;
    const std::string& u = outcome.unit;
    const auto part = [&](const char* what, const VolumePart& p) {
        return fmt::format("{:<8}{:.3f} {}3, standard error {:.3f}, over {:.2f} {}2\n", what, p.volume_m3, u,
                           p.sigma_m3, p.area_m2, u);
    };
    std::string text = part("Cut", v.above) + part("Fill", v.below) +
                       fmt::format("{:<8}{:.3f} {}3, standard error {:.3f}, over {:.2f} {}2\n", "Net",
                                   v.net_m3, u, v.net_sigma_m3, v.area_m2, u);
    if (outcome.cells_in_one > 0) {
        text +=
            fmt::format("Note: {} cells with a height in one DEM only are left out\n", outcome.cells_in_one);
    }
    text += notesOn(outcome.of_other_heights);
    if (outcome.correlation_range > 0.0) {
        text += fmt::format("Errors  of heights hang together over {:.3g} {}{}\n", outcome.correlation_range,
                            u, outcome.request.correlation_range ? "" : ", as the uncertainty says");
    } else if (v.net_sigma_m3 > 0.0) {
        text +=
            "Note: each cell counts as independent; --correlation-range says over which distance errors "
            "hang together\n";
    }
    if (v.net_sigma_m3 == 0.0) {
        text +=
            "Note: no uncertainty was given; --uncertainty or --sigma makes the standard errors mean "
            "something\n";
    }
    return text;
}

std::string toJson(const VolumeOutcome& outcome) {
    const VolumeRequest& r = outcome.request;
    const VolumeResult& v = outcome.volume;
    const auto part = [](const VolumePart& p) {
        return nlohmann::ordered_json{
            {"volume", p.volume_m3}, {"standard_error", p.sigma_m3}, {"area", p.area_m2}};
    };
    nlohmann::ordered_json document{{"format", "terrawalk-volume 1"},
                                    {"dem", r.dem.string()},
                                    {"unit", outcome.unit},
                                    {"sigma", r.sigma},
                                    {"correlation_range", outcome.correlation_range},
                                    {"common_sigma", r.common_sigma},
                                    {"above", part(v.above)},
                                    {"below", part(v.below)},
                                    {"net", {{"volume", v.net_m3}, {"standard_error", v.net_sigma_m3}}},
                                    {"area", v.area_m2},
                                    {"cells", v.cells},
                                    {"cells_in_one", outcome.cells_in_one}};
    if (r.plane) document["plane"] = *r.plane;
    if (!r.against.empty()) document["against"] = r.against.string();
    return document.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace terrawalk
