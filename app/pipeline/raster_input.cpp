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

/// `sum.sigmas` are variances yet.
Result<void> addVariance(const SigmaSource& source, const DemFile& dem, const ElevationGrid& difference,
                         CombinedSigmas& sum, const std::stop_token& stop) {
    if (source.raster.empty()) {
        for (std::size_t cell = 0; cell < sum.sigmas.size(); ++cell) {
            if (cell % kCellsBetweenStops == 0 && stop.stop_requested()) return cancelled();
            sum.sigmas[cell] += static_cast<float>(source.value * source.value);
        }
        return {};
    }
    const auto file = readErrorsAlike(source.raster, dem, stop);
    if (!file) return tl::unexpected(file.error());
    if (source.heights != nullptr && !mayBelongTo(*file, *source.heights)) {
        sum.of_other_heights.push_back(source.raster);
    }
    sum.correlation_range = std::max(sum.correlation_range, file->correlation_range);
    for (std::size_t cell = 0; cell < sum.sigmas.size(); ++cell) {
        if (cell % kCellsBetweenStops == 0 && stop.stop_requested()) return cancelled();
        if (std::isnan(difference.heights_m[cell])) continue;
        const float own = file->grid.heights_m[cell];
        if (!(own >= 0.0F)) return badData("a cell with a height has no sigma", source.raster);
        sum.sigmas[cell] += own * own;
    }
    return {};
}

}  // namespace

Result<DemFile> readErrorsAlike(const fs::path& file, const DemFile& dem, const std::stop_token& stop) {
    auto other = readDem(file, stop);
    if (!other) return tl::unexpected(other.error());
    if (!(other->grid.geometry == dem.grid.geometry)) {
        return badData("the cells are not those of the DEM", file, 0,
                       "grid both with the same --resolution and --extent, or warp one to the other");
    }
    if (other->crs.name != dem.crs.name) {
        return badData(fmt::format("the CRS is {}, that of the DEM {}", other->crs.name, dem.crs.name), file);
    }
    return other;
}

Result<ElevationGrid> readAlike(const fs::path& file, const DemFile& dem, const std::stop_token& stop) {
    auto other = readErrorsAlike(file, dem, stop);
    if (!other) return tl::unexpected(other.error());
    return std::move(other->grid);
}

Result<CombinedSigmas> combinedSigmas(const std::vector<SigmaSource>& sources, const DemFile& dem,
                                      const ElevationGrid& difference, const std::stop_token& stop) {
    CombinedSigmas combined;
    const bool one_for_all = std::none_of(sources.begin(), sources.end(),
                                          [](const SigmaSource& source) { return !source.raster.empty(); });
    combined.sigmas.assign(one_for_all ? 1 : difference.heights_m.size(), 0.0F);
    for (const SigmaSource& source : sources) {
        if (auto done = addVariance(source, dem, difference, combined, stop); !done) {
            return tl::unexpected(done.error());
        }
    }
    for (std::size_t cell = 0; cell < combined.sigmas.size(); ++cell) {
        if (cell % kCellsBetweenStops == 0 && stop.stop_requested()) return cancelled();
        combined.sigmas[cell] = std::sqrt(combined.sigmas[cell]);
    }
    return combined;
}

std::string notesOn(const std::vector<fs::path>& of_other_heights) {
    std::string text;
    for (const fs::path& file : of_other_heights) {
        text += fmt::format("Note: the standard errors of {} say that they are of other heights\n",
                            printable(file.filename().string()));
    }
    return text;
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
