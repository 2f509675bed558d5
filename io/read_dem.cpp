#include "io/read_dem.hpp"

#include <fmt/format.h>
#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <new>

#include "io/gdal_support.hpp"
#include "io/write_products.hpp"

namespace terrawalk {
namespace {

constexpr int kRowsAtOnce = 256;
constexpr double kSquare = 1e-6;  // share by which the sides of a cell may differ

Result<CoordinateSystem> crsOf(const GDALDataset& dataset) {
    const OGRSpatialReference* const crs = dataset.GetSpatialRef();
    if (crs == nullptr) return localCoordinateSystem({"m", 1.0});
    char* text = nullptr;
    const bool ok = crs->exportToWkt(&text) == OGRERR_NONE && text != nullptr;
    const std::string wkt = ok ? text : "";
    CPLFree(text);
    return describeCrs(wkt);
}

Result<GridGeometry> geometryOf(GDALDataset& dataset, const std::filesystem::path& file) {
    std::array<double, 6> transform{};
    if (dataset.GetGeoTransform(transform.data()) != CE_None) return badData("the raster has no place", file);
    const auto& [west, width, turn_x, north, turn_y, height] = transform;
    if (turn_x != 0.0 || turn_y != 0.0 || !(width > 0.0) || !(height < 0.0)) {
        return badData("the raster is not north-up", file, 0, "warp it, e.g. with gdalwarp");
    }
    if (std::abs(width + height) > kSquare * width) {
        return badData(fmt::format("the cells are not square: {} x {}", width, -height), file, 0,
                       "warp it, e.g. with gdalwarp -tr");
    }
    return GridGeometry{west, north, width, static_cast<std::size_t>(dataset.GetRasterXSize()),
                        static_cast<std::size_t>(dataset.GetRasterYSize())};
}

Result<void> readBand(GDALRasterBand& band, ElevationGrid& grid, const GdalErrors& errors,
                      const std::filesystem::path& file, const std::stop_token& stop) {
    int has_no_data = FALSE;
    const auto no_data = static_cast<float>(band.GetNoDataValue(&has_no_data));
    const auto columns = static_cast<int>(grid.geometry.columns);
    const auto rows = static_cast<int>(grid.geometry.rows);
    for (int row = 0; row < rows; row += kRowsAtOnce) {
        if (stop.stop_requested()) return cancelled();
        const int count = std::min(kRowsAtOnce, rows - row);
        float* const to = grid.heights_m.data() + static_cast<std::size_t>(row) * grid.geometry.columns;
        if (band.RasterIO(GF_Read, 0, row, columns, count, to, columns, count, GDT_Float32, 0, 0, nullptr) !=
            CE_None) {
            return badData("the raster cannot be read: " + errors.text(), file);
        }
    }
    for (float& height : grid.heights_m) {
        if ((has_no_data != FALSE && height == no_data) || !std::isfinite(height)) height = kNoHeight;
    }
    return {};
}

}  // namespace

bool mayBelongTo(const DemFile& errors, const ElevationGrid& heights) {
    return errors.heights_sha256.empty() || errors.heights_sha256 == sha256OfHeights(heights);
}

Result<DemFile> readDem(const std::filesystem::path& file, std::stop_token stop) {
    GDALAllRegister();
    const GdalErrors errors;
    const GdalDataset dataset(GDALDataset::Open(file.c_str(), GDAL_OF_RASTER | GDAL_OF_READONLY));
    if (!dataset || dataset->GetRasterCount() < 1) {
        return badData("GDAL reads no raster from this file: " + errors.text(), file);
    }
    auto crs = crsOf(*dataset);
    if (!crs) return tl::unexpected(crs.error());
    const auto geometry = geometryOf(*dataset, file);
    if (!geometry) return tl::unexpected(geometry.error());
    try {
        DemFile dem{{*geometry, std::vector<float>(geometry->size())}, std::move(*crs), {}};
        if (const char* made_of = dataset->GetMetadataItem(kPointsSha256); made_of != nullptr)
            dem.points_sha256 = made_of;
        if (const char* range = dataset->GetMetadataItem(kCorrelationRange); range != nullptr) {
            const double value = CPLAtof(range);
            if (std::isfinite(value) && value > 0.0) dem.correlation_range = value;
        }
        if (const char* of = dataset->GetMetadataItem(kHeightsSha256); of != nullptr) dem.heights_sha256 = of;
        if (auto done = readBand(*dataset->GetRasterBand(1), dem.grid, errors, file, stop); !done) {
            return tl::unexpected(done.error());
        }
        return dem;
    } catch (const std::bad_alloc&) {
        return systemError(
            fmt::format("not enough memory for {} x {} cells", geometry->columns, geometry->rows), file,
            "cut out the part that is needed, e.g. with gdal_translate -projwin");
    }
}

}  // namespace terrawalk
