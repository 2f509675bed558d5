#include <cpl_conv.h>
#include <cpl_string.h>
#include <fmt/format.h>
#include <gdal_frmts.h>
#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <system_error>
#include <type_traits>

#include "io/gdal_support.hpp"
#include "io/replacing_file.hpp"
#include "io/write_products.hpp"
#include "survey/parallel.hpp"

namespace terrawalk {

namespace {

constexpr float kNoData = -9999.0F;
constexpr std::uint8_t kNoClass = 0;
/// Tiles of 512 would hold twice as many cells beyond the rim, which are packed and read like all others.
constexpr std::size_t kTileSide = 256;

/// Only what writing needs: registering all drivers takes a fifth of a second.
void registerDrivers() {
    GDALRegister_MEM();
    GDALRegister_GTiff();
    GDALRegister_COG();
}

int CPL_STDCALL continueUnlessStopped(double, const char*, void* stop) {
    return static_cast<std::stop_token*>(stop)->stop_requested() ? FALSE : TRUE;
}

std::array<double, 6> geotransform(const GridGeometry& geometry) {
    return {geometry.west_m, geometry.cell_m, 0.0, geometry.north_m, 0.0, -geometry.cell_m};
}

/// One band of a file.
struct Band {
    std::string quantity;
    std::vector<float> cells;         ///< as they stand in the file; or
    std::vector<std::uint8_t> codes;  ///< of classes
    std::size_t known = 0;            ///< cells with a value; the rest is about these
    double least = 0.0, greatest = 0.0, mean = 0.0, sd = 0.0;
};

/// GDAL keeps what it writes in memory, a twentieth of the machine's, until the file is closed. This much
/// holds the tiles of a few rows and is enough; the earlier limit comes back at the end.
class SmallBlockCache {
  public:
    explicit SmallBlockCache(const GridGeometry& geometry) : before_(GDALGetCacheMax64()) {
        constexpr GIntBig kLeast = GIntBig{32} << 20U;
        constexpr std::size_t kRowsOfTiles = 4;
        const auto tiles =
            static_cast<GIntBig>(kRowsOfTiles * kTileSide * (geometry.columns + kTileSide) * sizeof(float));
        GDALSetCacheMax64(std::min(before_, std::max(kLeast, tiles)));
    }
    SmallBlockCache(const SmallBlockCache&) = delete;
    SmallBlockCache& operator=(const SmallBlockCache&) = delete;
    ~SmallBlockCache() { GDALSetCacheMax64(before_); }

  private:
    GIntBig before_;
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

/// Heights as they stand in the file, with their statistics.
Result<Band> bandOf(std::string quantity, std::vector<float> heights_m, const std::filesystem::path& file) {
    Band band{std::move(quantity), std::move(heights_m)};
    double base = 0.0, sum = 0.0, squares = 0.0;  // of differences from the first height
    band.least = std::numeric_limits<double>::infinity();
    band.greatest = -band.least;
    for (float& cell : band.cells) {
        if (std::isnan(cell)) {
            cell = kNoData;
            continue;
        }
        if (std::isinf(cell) || cell == kNoData) {
            return badData(fmt::format("the DEM cannot hold the height {} m", cell), file);
        }
        const double height = cell;
        if (band.known++ == 0) base = height;
        band.least = std::min(band.least, height);
        band.greatest = std::max(band.greatest, height);
        sum += height - base;
        squares += (height - base) * (height - base);
    }
    if (band.known == 0) {
        return badData("no cell of the DEM has a height", file, 0,
                       "walk closer lines or choose larger cells");
    }
    const double mean_difference = sum / static_cast<double>(band.known);
    band.mean = base + mean_difference;
    band.sd = std::sqrt(
        std::max(0.0, squares / static_cast<double>(band.known) - mean_difference * mean_difference));
    return band;
}

/// The same of classes.
Result<void> asCodes(Band& band, const std::filesystem::path& file) {
    band.codes.reserve(band.cells.size());
    for (const float cell : band.cells) {
        const bool none = cell == kNoData;
        if (!none && !(cell >= 1.0F && cell <= 255.0F && cell == std::round(cell))) {
            return badData(fmt::format("{} names no class", cell), file);
        }
        band.codes.push_back(none ? kNoClass : static_cast<std::uint8_t>(cell));
    }
    band.cells = {};
    return {};
}

bool addBand(GDALDataset& dataset, Band& band, const std::string& unit) {
    const bool classes = !band.codes.empty();
    const void* const data = classes ? static_cast<const void*>(band.codes.data()) : band.cells.data();
    CPLStringList memory;
    memory.SetNameValue("DATAPOINTER", fmt::format("{}", fmt::ptr(data)).c_str());
    if (dataset.AddBand(classes ? GDT_Byte : GDT_Float32, memory.List()) != CE_None) return false;
    GDALRasterBand* const raster = dataset.GetRasterBand(dataset.GetRasterCount());
    if (classes) {
        raster->SetDescription(band.quantity.c_str());
        return raster->SetNoDataValue(double{kNoClass}) == CE_None;
    }
    raster->SetDescription(fmt::format("{} ({})", band.quantity, unit).c_str());
    const double percent = 100.0 * static_cast<double>(band.known) / static_cast<double>(band.cells.size());
    return raster->SetUnitType(unit.c_str()) == CE_None &&
           raster->SetNoDataValue(double{kNoData}) == CE_None &&
           raster->SetStatistics(band.least, band.greatest, band.mean, band.sd) == CE_None &&
           raster->SetMetadataItem("STATISTICS_VALID_PERCENT", fmt::format("{:.4g}", percent).c_str()) ==
               CE_None;
}

/// The cells of a row or column that one of an overview covers, with the share of each.
struct Covered {
    std::size_t first = 0, count = 0;
    std::array<double, 3> shares{};
};

std::vector<Covered> coverage(std::size_t fine, std::size_t coarse) {
    std::vector<Covered> covered(coarse);
    const double step = static_cast<double>(fine) / static_cast<double>(coarse);  // 2, or less when odd
    for (std::size_t i = 0; i < coarse; ++i) {
        const double begin = static_cast<double>(i) * step, end = static_cast<double>(i + 1) * step;
        Covered& c = covered[i];
        c.first = static_cast<std::size_t>(begin);
        for (std::size_t cell = c.first; cell < fine && c.count < c.shares.size(); ++cell) {
            const auto at = static_cast<double>(cell);
            const double share = std::min(end, at + 1.0) - std::max(begin, at);
            if (!(share > 1e-9)) break;
            c.shares[c.count++] = share;
        }
    }
    return covered;
}

/// A raster of half the size: means of the cells that have a value. GDAL's own way takes longer.
std::vector<float> halved(const float* fine, std::size_t fine_columns, std::size_t fine_rows,
                          std::size_t columns, std::size_t rows) {
    const std::vector<Covered> across = coverage(fine_columns, columns), down = coverage(fine_rows, rows);
    std::vector<float> coarse(columns * rows);
    parallelFor(rows, [&](std::size_t row) {
        const Covered& d = down[row];
        for (std::size_t column = 0; column < columns; ++column) {
            const Covered& a = across[column];
            double sum = 0.0, weight = 0.0;
            for (std::size_t r = 0; r < d.count; ++r) {
                const float* const from = fine + (d.first + r) * fine_columns + a.first;
                for (std::size_t c = 0; c < a.count; ++c) {
                    const double counts = from[c] == kNoData ? 0.0 : d.shares[r] * a.shares[c];
                    sum += counts * static_cast<double>(from[c]);
                    weight += counts;
                }
            }
            coarse[row * columns + column] = weight > 0.0 ? static_cast<float>(sum / weight) : kNoData;
        }
    });
    return coarse;
}

/// Smaller rasters in memory, each with half the columns and rows, down to one tile. COG's own way would
/// write them to a temporary file first.
bool addOverviews(GDALDataset& dataset, const std::vector<Band>& bands, std::stop_token& stop) {
    std::vector<int> factors;
    const int longest = std::max(dataset.GetRasterXSize(), dataset.GetRasterYSize());
    for (int factor = 2; longest > static_cast<int>(kTileSide) * factor / 2; factor *= 2) {
        factors.push_back(factor);
    }
    if (factors.empty()) return true;
    const bool classes = !bands.front().codes.empty();
    // Cubic would ring at terrace edges.
    if (dataset.BuildOverviews(classes ? "MODE" : "NONE", static_cast<int>(factors.size()), factors.data(), 0,
                               nullptr, &continueUnlessStopped, &stop) != CE_None) {
        return false;
    }
    if (classes) return true;
    for (std::size_t b = 0; b < bands.size(); ++b) {
        GDALRasterBand& band = *dataset.GetRasterBand(static_cast<int>(b) + 1);
        auto columns = static_cast<std::size_t>(band.GetXSize()),
             rows = static_cast<std::size_t>(band.GetYSize());
        std::vector<float> last;
        for (int i = 0; i < band.GetOverviewCount(); ++i) {
            if (stop.stop_requested()) return false;
            GDALRasterBand& overview = *band.GetOverview(i);
            const int width = overview.GetXSize(), height = overview.GetYSize();
            const auto to_columns = static_cast<std::size_t>(width),
                       to_rows = static_cast<std::size_t>(height);
            last = halved(i == 0 ? bands[b].cells.data() : last.data(), columns, rows, to_columns, to_rows);
            columns = to_columns;
            rows = to_rows;
            if (overview.RasterIO(GF_Write, 0, 0, width, height, last.data(), width, height, GDT_Float32, 0,
                                  0, nullptr) != CE_None) {
                return false;
            }
        }
    }
    return true;
}

/// A dataset over the cells of the bands, which must outlive it, with everything that the file is to say.
Result<GdalDataset> describe(const GridGeometry& geometry, std::vector<Band>& bands,
                             const DemDescription& description, const GdalErrors& errors,
                             const std::filesystem::path& file) {
    OGRSpatialReference crs;
    crs.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    if (description.crs_wkt2.empty() || crs.importFromWkt(description.crs_wkt2.c_str()) != OGRERR_NONE) {
        return badData("GDAL does not understand the CRS of the DEM: " + errors.text(), file);
    }
    GdalDataset dataset(GetGDALDriverManager()->GetDriverByName("MEM")->Create(
        "", static_cast<int>(geometry.columns), static_cast<int>(geometry.rows), 0, GDT_Float32, nullptr));
    if (!dataset) return systemError("cannot make the DEM: " + errors.text(), file);
    auto transform = geotransform(geometry);
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

Result<void> writeCog(GDALDataset& source, const RasterStorage& storage, const GdalErrors& errors,
                      std::stop_token stop, const std::filesystem::path& to,
                      const std::filesystem::path& file) {
    CPLStringList options;
    const bool heights = source.GetRasterBand(1)->GetRasterDataType() == GDT_Float32;
    switch (storage.compression) {
        case RasterCompression::Deflate:
            options.SetNameValue("COMPRESS", "DEFLATE");
            options.SetNameValue("LEVEL", "1");  // 6 takes twice as long for a file smaller by a fifteenth
            if (heights) options.SetNameValue("PREDICTOR", "YES");
            break;
        case RasterCompression::Zstd:
            options.SetNameValue("COMPRESS", "ZSTD");
            options.SetNameValue("LEVEL", "1");
            // That of floats takes longer than ZSTD itself, for a file smaller by a fifteenth.
            if (heights) options.SetNameValue("PREDICTOR", "STANDARD");
            break;
        case RasterCompression::None:
            options.SetNameValue("COMPRESS", "NONE");
            break;
    }
    options.SetNameValue("BLOCKSIZE", std::to_string(kTileSide).c_str());
    options.SetNameValue("OVERVIEWS", storage.overviews ? "AUTO" : "NONE");  // those of the source
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

/// Tile by tile, past GDAL's cache.
template <class T>
bool sameCells(GDALDataset& dataset, int band, const std::vector<T>& cells, const std::stop_token& stop) {
    const auto columns = static_cast<std::size_t>(dataset.GetRasterXSize());
    const auto rows = static_cast<std::size_t>(dataset.GetRasterYSize());
    GDALRasterBand& raster = *dataset.GetRasterBand(band);
    int width = 0, height = 0;
    raster.GetBlockSize(&width, &height);
    constexpr GDALDataType kType = std::is_same_v<T, float> ? GDT_Float32 : GDT_Byte;
    if (raster.GetRasterDataType() != kType || width <= 0 || height <= 0) return false;
    const auto tile_columns = static_cast<std::size_t>(width), tile_rows = static_cast<std::size_t>(height);
    std::vector<T> tile(tile_columns * tile_rows);
    for (std::size_t top = 0; top < rows; top += tile_rows) {
        for (std::size_t left = 0; left < columns; left += tile_columns) {
            if (stop.stop_requested()) return true;  // who asks looks at the token next
            if (raster.ReadBlock(static_cast<int>(left / tile_columns), static_cast<int>(top / tile_rows),
                                 tile.data()) != CE_None) {
                return false;
            }
            const auto used = static_cast<std::ptrdiff_t>(std::min(tile_columns, columns - left));
            for (std::size_t row = 0; row < std::min(tile_rows, rows - top); ++row) {
                const auto got = tile.begin() + static_cast<std::ptrdiff_t>(row * tile_columns);
                const auto expected =
                    cells.begin() + static_cast<std::ptrdiff_t>((top + row) * columns + left);
                if (!std::equal(got, got + used, expected)) return false;
            }
        }
    }
    return true;
}

/// Reads the file again: a DEM that lies beside its place is worse than none.
Result<void> verify(const GDALDataset& source, const GridGeometry& geometry, const std::vector<Band>& bands,
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
    if (dataset->GetRasterXSize() != static_cast<int>(geometry.columns) ||
        dataset->GetRasterYSize() != static_cast<int>(geometry.rows)) {
        return refused("another size");
    }
    std::array<double, 6> transform{};
    if (dataset->GetGeoTransform(transform.data()) != CE_None || transform != geotransform(geometry)) {
        return refused("another place");
    }
    int has_no_data = FALSE;
    const double no_data = bands.front().codes.empty() ? double{kNoData} : double{kNoClass};
    if (dataset->GetRasterBand(1)->GetNoDataValue(&has_no_data) != no_data || has_no_data == FALSE) {
        return refused("another nodata value");
    }
    if (!sameCrs(source, *dataset)) return refused("GeoTIFF cannot hold this CRS");
    for (std::size_t b = 0; b < bands.size(); ++b) {
        const int at = static_cast<int>(b) + 1;
        const bool same = bands[b].codes.empty() ? sameCells(*dataset, at, bands[b].cells, stop)
                                                 : sameCells(*dataset, at, bands[b].codes, stop);
        if (!same) return refused("other heights");
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

Result<void> writeBands(const GridGeometry& geometry, std::vector<Band> bands,
                        const DemDescription& description, const std::filesystem::path& file,
                        std::stop_token stop) {
    auto out = ReplacingFile::create(file);
    if (!out) return tl::unexpected(out.error());
    registerDrivers();
    const GdalErrors errors;
    const SmallBlockCache cache(geometry);
    const CPLConfigOptionSetter no_side_files("GDAL_PAM_ENABLED", "NO", false);
    const auto source = describe(geometry, bands, description, errors, file);
    if (!source) return tl::unexpected(source.error());
    if (description.storage.overviews && !addOverviews(**source, bands, stop)) {
        if (stop.stop_requested()) return cancelled();
        return systemError("cannot make the DEM's overviews: " + errors.text(), file);
    }
    if (auto written = writeCog(**source, description.storage, errors, stop, out->temporary(), file);
        !written) {
        return written;
    }
    if (auto read = verify(**source, geometry, bands, stop, out->temporary(), file); !read) return read;
    if (auto removed = removeSideFiles(file); !removed) return removed;
    return out->commit();
}

}  // namespace

Result<void> writeDem(ElevationGrid grid, const DemDescription& description,
                      const std::filesystem::path& file, std::stop_token stop) {
    if (auto checked = checkGrid(grid, file); !checked) return checked;
    auto band = bandOf(description.quantity, std::move(grid.heights_m), file);
    if (!band) return tl::unexpected(band.error());
    if (description.classes) {
        if (auto done = asCodes(*band, file); !done) return done;
    }
    std::vector<Band> bands;
    bands.push_back(std::move(*band));
    return writeBands(grid.geometry, std::move(bands), description, file, std::move(stop));
}

Result<void> writeDemWithUncertainty(ElevationGrid grid, std::vector<float> sigmas,
                                     const DemDescription& description, const std::filesystem::path& file,
                                     std::stop_token stop) {
    std::vector<Band> bands;
    std::vector<std::pair<std::string, std::vector<float>>> values;
    values.emplace_back(description.quantity, std::move(grid.heights_m));
    values.emplace_back("Uncertainty, 1 sigma", std::move(sigmas));
    for (auto& [quantity, cells] : values) {
        grid.heights_m = std::move(cells);
        if (auto checked = checkGrid(grid, file); !checked) return checked;
        auto band = bandOf(quantity, std::move(grid.heights_m), file);
        if (!band) return tl::unexpected(band.error());
        bands.push_back(std::move(*band));
    }
    return writeBands(grid.geometry, std::move(bands), description, file, std::move(stop));
}

}  // namespace terrawalk
