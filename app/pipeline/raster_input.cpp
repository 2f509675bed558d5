#include "app/pipeline/raster_input.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/pipeline/memory_need.hpp"
#include "app/pipeline/version.hpp"

namespace terrawalk {

namespace {

namespace fs = std::filesystem;

constexpr double kShareOfMemory = 0.9;
constexpr std::size_t kCellsBetweenStops = std::size_t{1} << 20U;

Result<void> addVariance(const SigmaSource& source, const DemFile& dem, const ElevationGrid& difference,
                         std::vector<float>& variances, const std::stop_token& stop) {
    if (source.raster.empty()) {
        for (std::size_t cell = 0; cell < variances.size(); ++cell) {
            if (cell % kCellsBetweenStops == 0 && stop.stop_requested()) return cancelled();
            variances[cell] += static_cast<float>(source.value * source.value);
        }
        return {};
    }
    const auto sigmas = readAlike(source.raster, dem, stop);
    if (!sigmas) return tl::unexpected(sigmas.error());
    for (std::size_t cell = 0; cell < variances.size(); ++cell) {
        if (cell % kCellsBetweenStops == 0 && stop.stop_requested()) return cancelled();
        if (std::isnan(difference.heights_m[cell])) continue;
        const float own = sigmas->heights_m[cell];
        if (!(own >= 0.0F)) return badData("a cell with a height has no sigma", source.raster);
        variances[cell] += own * own;
    }
    return {};
}

}  // namespace

Result<ElevationGrid> readAlike(const fs::path& file, const DemFile& dem, const std::stop_token& stop) {
    auto other = readDem(file, stop);
    if (!other) return tl::unexpected(other.error());
    if (!(other->grid.geometry == dem.grid.geometry)) {
        return badData("the cells are not those of the DEM", file, 0,
                       "grid both with the same --resolution and --extent, or warp one to the other");
    }
    if (other->crs.name != dem.crs.name) {
        return badData(fmt::format("the CRS is {}, that of the DEM {}", other->crs.name, dem.crs.name), file);
    }
    return std::move(other->grid);
}

Result<std::vector<float>> combinedSigmas(const std::vector<SigmaSource>& sources, const DemFile& dem,
                                          const ElevationGrid& difference, const std::stop_token& stop) {
    const bool one_for_all = std::none_of(sources.begin(), sources.end(),
                                          [](const SigmaSource& source) { return !source.raster.empty(); });
    std::vector<float> variances(one_for_all ? 1 : difference.heights_m.size(), 0.0F);
    for (const SigmaSource& source : sources) {
        if (auto done = addVariance(source, dem, difference, variances, stop); !done) {
            return tl::unexpected(done.error());
        }
    }
    for (std::size_t cell = 0; cell < variances.size(); ++cell) {
        if (cell % kCellsBetweenStops == 0 && stop.stop_requested()) return cancelled();
        variances[cell] = std::sqrt(variances[cell]);
    }
    return variances;
}

DemDescription describeDerived(const DemFile& dem, const std::string& title, const std::string& quantity,
                               const std::string& unit, const std::string& method) {
    return {.crs_wkt2 = dem.crs.wkt2,
            .vertical_datum = dem.crs.vertical_datum,
            .title = title,
            .software = programVersion(),
            .metadata = {{"METHOD", method}},
            .quantity = quantity,
            .unit = unit};
}

Result<void> checkMemoryFor(std::string_view work, double need_bytes, std::string_view cure) {
    const auto available = availableMemory_bytes();
    if (!available || need_bytes <= kShareOfMemory * *available) return {};
    return systemError(fmt::format("{}: about {} of memory are needed, and {} can be had", work,
                                   memoryText(need_bytes), memoryText(*available)),
                       {}, std::string(cure));
}

Result<void> checkCellMemory(std::size_t cells, double bytes_per_cell, std::string_view work) {
    return checkMemoryFor(fmt::format("{} {} cells", work, cells),
                          bytes_per_cell * static_cast<double>(cells),
                          "cut out a part, e.g. with gdal_translate -projwin, or take larger cells");
}

}  // namespace terrawalk
