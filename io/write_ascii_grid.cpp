#include <fmt/compile.h>
#include <fmt/format.h>
#include <ogr_spatialref.h>

#include <array>
#include <cmath>

#include "io/gdal_support.hpp"
#include "io/replacing_file.hpp"
#include "io/write_exchange.hpp"

namespace terrawalk {

namespace {

/// What programs of ESRI read beside a grid; empty where the CRS has no such form.
std::string projectionText(const std::string& wkt2) {
    const GdalErrors errors;
    OGRSpatialReference crs;
    if (wkt2.empty() || crs.importFromWkt(wkt2.c_str()) != OGRERR_NONE) return {};
    char* text = nullptr;
    const std::array<const char*, 2> options{"FORMAT=WKT1_ESRI", nullptr};
    const bool ok = crs.exportToWkt(&text, options.data()) == OGRERR_NONE && text != nullptr;
    std::string wkt = ok ? text : "";
    CPLFree(text);
    return wkt;
}

Result<void> writeProjection(const std::string& wkt2, std::filesystem::path file) {
    file.replace_extension(".prj");
    const std::string text = projectionText(wkt2);
    if (text.empty()) {
        std::error_code ignored;
        std::filesystem::remove(file, ignored);  // that of an earlier grid would lie
        return {};
    }
    auto out = ReplacingFile::create(file);
    if (!out) return tl::unexpected(out.error());
    if (auto written = out->write(text + "\n"); !written) return written;
    return out->commit();
}

}  // namespace

Result<void> writeAsciiGrid(const ElevationGrid& grid, const std::string& crs_wkt2,
                            const std::filesystem::path& file, std::stop_token stop) {
    const GridGeometry& g = grid.geometry;
    if (g.size() == 0) return badData("the DEM has no cells", file);
    auto out = ReplacingFile::create(file);
    if (!out) return tl::unexpected(out.error());
    auto written = out->write(fmt::format(
        "ncols {}\nnrows {}\nxllcorner {}\nyllcorner {}\ncellsize {}\nNODATA_value -9999\n", g.columns,
        g.rows, g.west_m, g.north_m - static_cast<double>(g.rows) * g.cell_m, g.cell_m));
    std::string line;
    for (std::size_t row = 0; written && row < g.rows; ++row) {
        if (stop.stop_requested()) return cancelled();
        line.clear();
        for (std::size_t column = 0; column < g.columns; ++column) {
            if (column > 0) line.push_back(' ');
            const float height = grid.at(row, column);
            if (std::isnan(height)) {
                line += "-9999";
            } else {
                fmt::format_to(std::back_inserter(line), FMT_COMPILE("{}"), height);
            }
        }
        line.push_back('\n');
        written = out->write(line);
    }
    if (!written) return written;
    if (auto done = writeProjection(crs_wkt2, file); !done) return done;
    return out->commit();
}

}  // namespace terrawalk
