#include "app/pipeline/height_change.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "io/read_dem.hpp"
#include "mapping/profile.hpp"
#include "survey/parallel.hpp"

namespace terrawalk {

namespace {

namespace fs = std::filesystem;

/// Values of one grid at the cell centres of another.
ElevationGrid onCells(const ElevationGrid& from, const GridGeometry& cells) {
    if (from.geometry == cells) return from;
    ElevationGrid grid{cells, std::vector<float>(cells.size(), kNoHeight)};
    parallelFor(cells.rows, [&](std::size_t row) {
        for (std::size_t column = 0; column < cells.columns; ++column) {
            const auto value = bilinearAt(from, {cells.centreX(column), cells.centreY(row)});
            if (value) grid.heights_m[row * cells.columns + column] = static_cast<float>(*value);
        }
    });
    return grid;
}

/// Sigmas of the change; where one of the two is not known there, that of the other.
std::vector<float> bothSigmas(const SurfaceUncertainty* later, const std::vector<float>* earlier,
                              std::size_t cells) {
    const auto square = [](const std::vector<float>* sigmas, std::size_t cell) {
        if (sigmas == nullptr || !std::isfinite((*sigmas)[cell])) return 0.0F;
        return (*sigmas)[cell] * (*sigmas)[cell];
    };
    std::vector<float> sigmas(cells);
    const std::vector<float>* own = later != nullptr ? &later->sigmas_m : nullptr;
    for (std::size_t i = 0; i < cells; ++i) sigmas[i] = std::sqrt(square(own, i) + square(earlier, i));
    return sigmas;
}

void measure(HeightChange& change) {
    std::vector<float> known;
    double squares = 0.0;
    for (const float c : change.difference.change.heights_m) {
        if (std::isnan(c)) continue;
        known.push_back(c);
        squares += static_cast<double>(c) * static_cast<double>(c);
    }
    const auto middle = known.begin() + static_cast<std::ptrdiff_t>(known.size() / 2);
    std::nth_element(known.begin(), middle, known.end());
    change.median_m = static_cast<double>(*middle);
    change.rms_m = std::sqrt(squares / static_cast<double>(known.size()));
}

Result<HeightChange> compare(const Products& later, const ElevationGrid& earlier,
                             const ElevationGrid* earlier_sigmas, std::string name,
                             const std::stop_token& stop) {
    const GridGeometry& cells = later.dem.geometry;
    const ElevationGrid before = onCells(earlier, cells);
    if (stop.stop_requested()) return cancelled();
    std::vector<float> before_sigmas;
    if (earlier_sigmas != nullptr) before_sigmas = onCells(*earlier_sigmas, cells).heights_m;
    HeightChange change;
    change.has_sigma = later.uncertainty.has_value();
    change.earlier_has_sigma = earlier_sigmas != nullptr;
    VolumeErrorModel errors;
    errors.sigmas_m = bothSigmas(later.uncertainty ? &*later.uncertainty : nullptr,
                                 earlier_sigmas != nullptr ? &before_sigmas : nullptr, cells.size());
    auto difference = demDifference(later.dem, before, errors, stop);
    if (!difference) return tl::unexpected(difference.error());
    if (difference->all.cells == 0) {
        return badData(fmt::format("{} and this surface have no place in common", name), {}, 0,
                       "choose heights of the same ground, in the same map frame");
    }
    change.earlier = std::move(name);
    change.difference = std::move(*difference);
    measure(change);
    return change;
}

}  // namespace

Result<HeightChange> changeSince(const Products& later, const Products& earlier, std::string name,
                                 const std::stop_token& stop) {
    ElevationGrid sigmas;
    if (earlier.uncertainty) sigmas = {earlier.dem.geometry, earlier.uncertainty->sigmas_m};
    return compare(later, earlier.dem, earlier.uncertainty ? &sigmas : nullptr, std::move(name), stop);
}

Result<HeightChange> changeSince(const Products& later, const fs::path& earlier,
                                 const std::stop_token& stop) {
    const auto dem = readDem(earlier, stop);
    if (!dem) return tl::unexpected(dem.error());
    const auto own = describeCrs(later.crs_wkt2);
    if (!own) return tl::unexpected(own.error());
    if (own->name != dem->crs.name) {
        return badData(fmt::format("the CRS is {}, that of the survey {}", dem->crs.name, own->name), earlier,
                       0, "warp it to the survey's map frame, e.g. with gdalwarp -t_srs");
    }
    if (!(own->unit == dem->crs.unit)) {
        return badData(fmt::format("heights are in {}, those of the survey in {}", dem->crs.unit.symbol,
                                   own->unit.symbol),
                       earlier);
    }
    const fs::path beside =
        earlier.parent_path() / (earlier.stem().string() + "_uncertainty" + earlier.extension().string());
    std::error_code error;
    if (!fs::exists(beside, error))
        return compare(later, dem->grid, nullptr, earlier.filename().string(), stop);
    const auto sigmas = readDem(beside, stop);
    if (!sigmas) return tl::unexpected(sigmas.error());
    // A DEM made anew beside the standard errors of an earlier one.
    const bool of_these = mayBelongTo(*sigmas, dem->grid);
    return compare(later, dem->grid, of_these ? &sigmas->grid : nullptr, earlier.filename().string(), stop);
}

}  // namespace terrawalk
