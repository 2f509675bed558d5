#include <cpl_conv.h>
#include <cpl_string.h>
#include <fmt/format.h>
#include <gdal_frmts.h>
#include <gdal_priv.h>
#include <ogr_spatialref.h>
#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <system_error>

#include "io/gdal_support.hpp"
#include "io/replacing_file.hpp"
#include "io/write_products.hpp"

namespace terrawalk {

namespace {

constexpr float kNoData = -9999.0F;
constexpr int kRowsAtOnce = 512;

/// Only what writing needs: registering all drivers takes a fifth of a second.
void registerDrivers() {
    GDALRegister_MEM();
    GDALRegister_GTiff();
    GDALRegister_COG();
}

int CPL_STDCALL continueUnlessStopped(double, const char*, void* stop) {
    return static_cast<std::stop_token*>(stop)->stop_requested() ? FALSE : TRUE;
}

/// As many threads as the program allows oneTBB.
int threadCount() {
    const auto allowed = tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
    return std::max(1, std::min(tbb::this_task_arena::max_concurrency(), static_cast<int>(allowed)));
}

std::array<double, 6> geotransform(const GridGeometry& geometry) {
    return {geometry.west_m, geometry.cell_m, 0.0, geometry.north_m, 0.0, -geometry.cell_m};
}

/// One band of a file.
struct Band {
    std::string quantity;
    std::vector<float> cells;  ///< as they stand in the file
};

Result<void> checkGrid(const ElevationGrid& grid, const std::filesystem::path& file) {
    const GridGeometry& geometry = grid.geometry;
    constexpr auto kMost = static_cast<std::size_t>(std::numeric_limits<int>::max());
    if (geometry.columns == 0 || geometry.rows == 0) return badData("the DEM has no cells", file);
    if (geometry.columns > kMost || geometry.rows > kMost || grid.heights_m.size() != geometry.size()) {
        return badData(fmt::format("the DEM holds {} heights for {} x {} cells", grid.heights_m.size(),
                                   geometry.columns, geometry.rows),
                       file);
    }
    const bool placed = std::isfinite(geometry.west_m) && std::isfinite(geometry.north_m) &&
                        std::isfinite(geometry.cell_m) && geometry.cell_m > 0.0;
    if (!placed) return badData("the DEM has no place or no cell size", file);
    return {};
}

/// Heights as they stand in the file.
Result<std::vector<float>> cellsOf(const ElevationGrid& grid, const std::filesystem::path& file) {
    std::vector<float> cells(grid.heights_m.size());
    std::size_t known = 0;
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const float height_m = grid.heights_m[i];
        if (std::isnan(height_m)) {
            cells[i] = kNoData;
        } else if (std::isinf(height_m) || height_m == kNoData) {
            return badData(fmt::format("the DEM cannot hold the height {} m", height_m), file);
        } else {
            cells[i] = height_m;
            ++known;
        }
    }
    if (known == 0) {
        return badData("no cell of the DEM has a height", file, 0,
                       "walk closer lines or choose larger cells");
    }
    return cells;
}

bool addBand(GDALDataset& dataset, Band& band, const std::string& unit) {
    CPLStringList memory;
    memory.SetNameValue("DATAPOINTER", fmt::format("{}", fmt::ptr(band.cells.data())).c_str());
    if (dataset.AddBand(GDT_Float32, memory.List()) != CE_None) return false;
    GDALRasterBand* const raster = dataset.GetRasterBand(dataset.GetRasterCount());
    raster->SetDescription(fmt::format("{} ({})", band.quantity, unit).c_str());
    std::array<double, 4> statistics{};
    return raster->SetUnitType(unit.c_str()) == CE_None &&
           raster->SetNoDataValue(double{kNoData}) == CE_None &&
           raster->ComputeStatistics(FALSE, &statistics[0], &statistics[1], &statistics[2], &statistics[3],
                                     nullptr, nullptr) == CE_None;
}

/// A dataset over the cells of the bands, which must outlive it, with everything that the file is to say.
Result<GdalDataset> describe(const ElevationGrid& grid, std::vector<Band>& bands,
                             const DemDescription& description, const GdalErrors& errors,
                             const std::filesystem::path& file) {
    OGRSpatialReference crs;
    crs.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    if (description.crs_wkt2.empty() || crs.importFromWkt(description.crs_wkt2.c_str()) != OGRERR_NONE) {
        return badData("GDAL does not understand the CRS of the DEM: " + errors.text(), file);
    }
    GdalDataset dataset(GetGDALDriverManager()->GetDriverByName("MEM")->Create(
        "", static_cast<int>(grid.geometry.columns), static_cast<int>(grid.geometry.rows), 0, GDT_Float32,
        nullptr));
    if (!dataset) return systemError("cannot make the DEM: " + errors.text(), file);
    auto transform = geotransform(grid.geometry);
    bool ok =
        dataset->SetSpatialRef(&crs) == CE_None && dataset->SetGeoTransform(transform.data()) == CE_None;
    const auto setItem = [&](const std::string& key, const std::string& value) {
        ok = ok && dataset->SetMetadataItem(key.c_str(), value.c_str()) == CE_None;
    };
    setItem(GDALMD_AREA_OR_POINT, GDALMD_AOP_AREA);
    setItem("VERTICAL_DATUM", description.vertical_datum);
    setItem("TIFFTAG_IMAGEDESCRIPTION", description.title);
    setItem("TIFFTAG_SOFTWARE", description.software);
    for (const auto& [key, value] : description.metadata) setItem(key, value);
    for (Band& band : bands) ok = ok && addBand(*dataset, band, description.unit);
    if (!ok) return systemError("cannot describe the DEM: " + errors.text(), file);
    return dataset;
}

Result<void> writeCog(GDALDataset& source, bool classes, const GdalErrors& errors, std::stop_token stop,
                      const std::filesystem::path& to, const std::filesystem::path& file) {
    CPLStringList options;
    options.SetNameValue("COMPRESS", "DEFLATE");
    options.SetNameValue("PREDICTOR", "YES");
    options.SetNameValue("LEVEL", "6");  // 9 takes three times as long for a file smaller by a hundredth
    options.SetNameValue("BLOCKSIZE", "512");
    options.SetNameValue("OVERVIEWS", "IGNORE_EXISTING");
    // Cubic would ring at terrace edges.
    options.SetNameValue("OVERVIEW_RESAMPLING", classes ? "MODE" : "AVERAGE");
    options.SetNameValue("NUM_THREADS", std::to_string(threadCount()).c_str());
    options.SetNameValue("BIGTIFF", "IF_SAFER");
    GdalDataset written(GetGDALDriverManager()->GetDriverByName("COG")->CreateCopy(
        to.c_str(), &source, FALSE, options.List(), &continueUnlessStopped, &stop));
    const bool created = written != nullptr;
    written.reset();  // the close writes, and tells of its failures to the error handler only
    if (stop.stop_requested()) return cancelled();
    if (!created || errors.any()) return systemError("cannot write the DEM: " + errors.text(), file);
    return {};
}

bool sameCrs(const GDALDataset& one, const GDALDataset& other) {
    const OGRSpatialReference* const a = one.GetSpatialRef();
    const OGRSpatialReference* const b = other.GetSpatialRef();
    if (a == nullptr || b == nullptr) return false;
    // GeoTIFF keeps the name of an engineering CRS, but not that of its datum.
    if (a->IsLocal() != 0) return b->IsLocal() != 0 && std::string_view(a->GetName()) == b->GetName();
    const std::array<const char*, 3> options{"IGNORE_DATA_AXIS_TO_SRS_AXIS_MAPPING=YES",
                                             "CRITERION=EQUIVALENT", nullptr};
    return a->IsSame(b, options.data()) != 0;
}

bool sameCells(GDALDataset& dataset, int band, const std::vector<float>& cells, std::stop_token stop) {
    const int columns = dataset.GetRasterXSize();
    const int rows = dataset.GetRasterYSize();
    std::vector<float> block(static_cast<std::size_t>(columns) *
                             static_cast<std::size_t>(std::min(rows, kRowsAtOnce)));
    auto expected = cells.begin();
    for (int row = 0; row < rows && !stop.stop_requested(); row += kRowsAtOnce) {
        const int count = std::min(kRowsAtOnce, rows - row);
        if (dataset.GetRasterBand(band)->RasterIO(GF_Read, 0, row, columns, count, block.data(), columns,
                                                  count, GDT_Float32, 0, 0, nullptr) != CE_None) {
            return false;
        }
        const auto size = static_cast<std::ptrdiff_t>(columns) * count;
        if (!std::equal(expected, expected + size, block.begin())) return false;
        expected += size;
    }
    return true;
}

/// Reads the file again: a DEM that lies beside its place is worse than none.
Result<void> verify(const GDALDataset& source, const ElevationGrid& grid, const std::vector<Band>& bands,
                    std::stop_token stop, const std::filesystem::path& written,
                    const std::filesystem::path& file) {
    const GdalErrors errors;
    const std::array<const char*, 2> drivers{"GTiff", nullptr};
    const GdalDataset dataset(
        GDALDataset::Open(written.c_str(), GDAL_OF_RASTER, drivers.data(), nullptr, nullptr));
    const auto refused = [&](const std::string& what) {
        return systemError(
            "the DEM just written does not read back: " + what + (errors.any() ? ", " + errors.text() : ""),
            file);
    };
    if (!dataset || dataset->GetRasterCount() != static_cast<int>(bands.size())) {
        return refused("no raster");
    }
    if (dataset->GetRasterXSize() != static_cast<int>(grid.geometry.columns) ||
        dataset->GetRasterYSize() != static_cast<int>(grid.geometry.rows)) {
        return refused("another size");
    }
    std::array<double, 6> transform{};
    if (dataset->GetGeoTransform(transform.data()) != CE_None || transform != geotransform(grid.geometry)) {
        return refused("another place");
    }
    int has_no_data = FALSE;
    if (dataset->GetRasterBand(1)->GetNoDataValue(&has_no_data) != double{kNoData} || has_no_data == FALSE) {
        return refused("another nodata value");
    }
    if (!sameCrs(source, *dataset)) return refused("GeoTIFF cannot hold this CRS");
    for (std::size_t b = 0; b < bands.size(); ++b) {
        if (!sameCells(*dataset, static_cast<int>(b) + 1, bands[b].cells, stop))
            return refused("other heights");
    }
    if (stop.stop_requested()) return cancelled();
    return {};
}

/// GDAL and QGIS believe these files more than the GeoTIFF itself.
Result<void> removeSideFiles(const std::filesystem::path& file) {
    std::filesystem::path world_file = file;
    world_file.replace_extension(".tfw");
    for (const std::filesystem::path& side :
         {std::filesystem::path(file) += ".aux.xml", std::filesystem::path(file) += ".ovr",
          std::filesystem::path(file) += ".msk", world_file}) {
        std::error_code error;
        std::filesystem::remove(side, error);
        if (error)
            return systemError("cannot remove a side file of the earlier DEM: " + error.message(), side);
    }
    return {};
}

Result<void> writeBands(const ElevationGrid& grid, std::vector<Band> bands, const DemDescription& description,
                        const std::filesystem::path& file, std::stop_token stop) {
    auto out = ReplacingFile::create(file);
    if (!out) return tl::unexpected(out.error());
    registerDrivers();
    const GdalErrors errors;
    const CPLConfigOptionSetter no_side_files("GDAL_PAM_ENABLED", "NO", false);
    const auto source = describe(grid, bands, description, errors, file);
    if (!source) return tl::unexpected(source.error());
    if (auto written = writeCog(**source, description.classes, errors, stop, out->temporary(), file);
        !written) {
        return written;
    }
    if (auto read = verify(**source, grid, bands, stop, out->temporary(), file); !read) return read;
    if (auto removed = removeSideFiles(file); !removed) return removed;
    return out->commit();
}

}  // namespace

Result<void> writeDem(const ElevationGrid& grid, const DemDescription& description,
                      const std::filesystem::path& file, std::stop_token stop) {
    if (auto checked = checkGrid(grid, file); !checked) return checked;
    auto cells = cellsOf(grid, file);
    if (!cells) return tl::unexpected(cells.error());
    std::vector<Band> bands;
    bands.push_back({description.quantity, std::move(*cells)});
    return writeBands(grid, std::move(bands), description, file, std::move(stop));
}

Result<void> writeDemWithUncertainty(const ElevationGrid& grid, const std::vector<float>& sigmas,
                                     const DemDescription& description, const std::filesystem::path& file,
                                     std::stop_token stop) {
    if (auto checked = checkGrid(grid, file); !checked) return checked;
    const ElevationGrid uncertainty{grid.geometry, sigmas};
    if (auto checked = checkGrid(uncertainty, file); !checked) return checked;
    auto heights = cellsOf(grid, file);
    if (!heights) return tl::unexpected(heights.error());
    auto errors = cellsOf(uncertainty, file);
    if (!errors) return tl::unexpected(errors.error());
    std::vector<Band> bands;
    bands.push_back({description.quantity, std::move(*heights)});
    bands.push_back({"Uncertainty, 1 sigma", std::move(*errors)});
    return writeBands(grid, std::move(bands), description, file, std::move(stop));
}

}  // namespace terrawalk
