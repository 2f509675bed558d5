#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include "io/gdal_support.hpp"
#include "io/read_breaklines.hpp"
#include "io/replacing_file.hpp"
#include "io/write_products.hpp"

namespace terrawalk {
namespace {

std::string_view nameOf(BreaklineKind kind) {
    for (const auto& [known, text] : kBreaklineKinds) {
        if (known == kind) return text;
    }
    return {};
}

bool addField(OGRLayer& layer, const char* field_name) {
    OGRFieldDefn field(field_name, OFTString);
    return layer.CreateField(&field) == OGRERR_NONE;
}

bool addLine(OGRLayer& layer, const Breakline& line) {
    OGRLineString geometry;
    for (const Eigen::Vector3d& v : line.vertices_m) geometry.addPoint(v.x(), v.y(), v.z());
    const OGRFeatureUniquePtr feature(OGRFeature::CreateFeature(layer.GetLayerDefn()));
    feature->SetField("name", line.name.c_str());
    feature->SetField("kind", std::string(nameOf(line.kind)).c_str());
    return feature->SetGeometry(&geometry) == OGRERR_NONE &&
           layer.CreateFeature(feature.get()) == OGRERR_NONE;
}

bool writeLayer(GDALDataset& dataset, const std::vector<Breakline>& lines, const std::string& layer_name,
                const std::string& crs_wkt2) {
    OGRSpatialReference crs;
    if (!crs_wkt2.empty() && crs.importFromWkt(crs_wkt2.c_str()) != OGRERR_NONE) return false;
    crs.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    OGRLayer* const layer =
        dataset.CreateLayer(layer_name.c_str(), crs_wkt2.empty() ? nullptr : &crs, wkbLineString25D);
    if (layer == nullptr || !addField(*layer, "name") || !addField(*layer, "kind")) return false;
    for (const Breakline& line : lines) {
        if (!addLine(*layer, line)) return false;
    }
    return true;
}

}  // namespace

Result<void> writeBreaklines(const std::vector<Breakline>& lines, const std::string& layer_name,
                             const std::string& crs_wkt2, const std::filesystem::path& file,
                             std::stop_token stop) {
    auto out = ReplacingFile::create(file);
    if (!out) return tl::unexpected(out.error());
    // SQLite makes the file itself.
    std::error_code error;
    std::filesystem::remove(out->temporary(), error);
    if (error) return systemError(error.message(), file);

    GDALAllRegister();
    const GdalErrors errors;
    // The time of writing would make each file differ from the last.
    const CPLConfigOptionSetter no_date("OGR_CURRENT_DATE", "2000-01-01T00:00:00.000Z", false);
    GDALDriver* const driver = GetGDALDriverManager()->GetDriverByName("GPKG");
    if (driver == nullptr) return systemError("GDAL was built without GeoPackage", file);
    {
        const GdalDataset dataset(driver->Create(out->temporary().c_str(), 0, 0, 0, GDT_Unknown, nullptr));
        if (!dataset || !writeLayer(*dataset, lines, layer_name, crs_wkt2)) {
            return systemError("cannot write the lines: " + errors.text(), file);
        }
    }
    if (errors.any()) return systemError("cannot write the lines: " + errors.text(), file);
    SilentProgress silent;
    const auto read = readBreaklines(out->temporary(), silent, stop);
    if (!read) return tl::unexpected(read.error());
    if (read->lines.size() != lines.size()) return systemError("not all lines can be read again", file);
    return out->commit();
}

}  // namespace terrawalk
