#include <cpl_conv.h>
#include <fmt/format.h>
#include <gdal_alg.h>
#include <gdal_priv.h>
#include <ogrsf_frmts.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <functional>
#include <map>

#include "io/gdal_support.hpp"
#include "io/replacing_file.hpp"
#include "io/write_exchange.hpp"

namespace terrawalk {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kFeaturesBetweenStops = 4096;

/// Fills a new vector dataset, which then takes the place of `file`.
Result<void> writeVectorFile(const char* driver_name, const fs::path& file,
                             const std::function<Result<void>(GDALDataset&)>& fill) {
    GDALAllRegister();
    const GdalErrors errors;
    // GeoPackage notes when it was changed; the same input is to give the same bytes.
    const CPLConfigOptionSetter fixed_date("OGR_CURRENT_DATE", "1970-01-01T00:00:00Z", false);
    auto out = ReplacingFile::create(file);
    if (!out) return tl::unexpected(out.error());
    ::unlink(out->temporary().c_str());  // the drivers want to make the file themselves
    GDALDriver* const driver = GetGDALDriverManager()->GetDriverByName(driver_name);
    if (driver == nullptr) return systemError(fmt::format("GDAL has no driver {}", driver_name), file);
    GdalDataset dataset(driver->Create(out->temporary().c_str(), 0, 0, 0, GDT_Unknown, nullptr));
    if (!dataset) return systemError("cannot write: " + errors.text(), file);
    auto filled = fill(*dataset);
    dataset.reset();  // the close writes, and tells of its failures to the error handler only
    if (!filled) return filled;
    if (errors.any()) return systemError("cannot write: " + errors.text(), file);
    return out->commit();
}

Result<OGRSpatialReference> crsOf(const std::string& wkt2, const fs::path& file) {
    OGRSpatialReference crs;
    crs.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    if (wkt2.empty() || crs.importFromWkt(wkt2.c_str()) != OGRERR_NONE) {
        return badData("GDAL does not understand the CRS", file);
    }
    return crs;
}

struct Field {
    const char* name;
    OGRFieldType type;
    OGRFieldSubType subtype = OFSTNone;
};

/// Errors of GDAL's calls are kept by the handler; a null layer alone must be seen here.
Result<OGRLayer*> addLayer(GDALDataset& dataset, const char* name, OGRSpatialReference* crs,
                           OGRwkbGeometryType type, const std::vector<Field>& fields, const fs::path& file) {
    OGRLayer* const layer = dataset.CreateLayer(name, crs, type, nullptr);
    if (layer == nullptr) return systemError(fmt::format("cannot make the layer {}", name), file);
    for (const Field& field : fields) {
        OGRFieldDefn definition(field.name, field.type);
        definition.SetSubType(field.subtype);
        if (layer->CreateField(&definition) != OGRERR_NONE) {
            return systemError(fmt::format("cannot make the field {}", field.name), file);
        }
    }
    return layer;
}

Result<void> add(OGRLayer& layer, OGRFeature& feature, const fs::path& file) {
    if (layer.CreateFeature(&feature) == OGRERR_NONE) return {};
    return systemError("cannot write a feature", file);
}

OGRLineString lineOf(const Contour& contour) {
    OGRLineString line;
    line.setNumPoints(static_cast<int>(contour.vertices.size()));
    for (std::size_t i = 0; i < contour.vertices.size(); ++i) {
        line.setPoint(static_cast<int>(i), contour.vertices[i].x(), contour.vertices[i].y(), contour.level);
    }
    return line;
}

Result<void> writeContourTable(const std::vector<Contour>& contours, GDALDataset& dataset,
                               OGRSpatialReference& crs, const fs::path& file, const std::stop_token& stop) {
    const auto layer = addLayer(dataset, "contours", &crs, wkbLineString25D,
                                {{"elevation", OFTReal}, {"index", OFTInteger, OFSTBoolean}}, file);
    if (!layer) return tl::unexpected(layer.error());
    const bool transacted = dataset.StartTransaction() == OGRERR_NONE;
    for (std::size_t i = 0; i < contours.size(); ++i) {
        if (i % kFeaturesBetweenStops == 0 && stop.stop_requested()) return cancelled();
        OGRFeature feature((*layer)->GetLayerDefn());
        feature.SetField(0, contours[i].level);
        feature.SetField(1, contours[i].is_index ? 1 : 0);
        const OGRLineString line = lineOf(contours[i]);
        feature.SetGeometry(&line);
        if (auto added = add(**layer, feature, file); !added) return added;
    }
    if (transacted) dataset.CommitTransaction();
    return {};
}

/// Where a contour's label stands: on the middle vertex, along the line, readable from below.
struct LabelPlace {
    Eigen::Vector2d at;
    double turn_deg = 0.0;
};
LabelPlace labelPlace(const Contour& contour) {
    const std::size_t middle = contour.vertices.size() / 2;
    const Eigen::Vector2d along = contour.vertices[middle] - contour.vertices[middle - 1];
    double turn_deg = std::atan2(along.y(), along.x()) * (180.0 / 3.14159265358979323846);
    if (turn_deg > 90.0) turn_deg -= 180.0;
    if (turn_deg < -90.0) turn_deg += 180.0;
    return {contour.vertices[middle], turn_deg};
}

/// DXF has one table for all, with the drawing's layer as a field.
Result<void> writeContourDrawing(const std::vector<Contour>& contours, double label_height,
                                 GDALDataset& dataset, const fs::path& file, const std::stop_token& stop) {
    const auto layer = addLayer(dataset, "entities", nullptr, wkbUnknown, {}, file);
    if (!layer) return tl::unexpected(layer.error());
    const int layer_field = (*layer)->GetLayerDefn()->GetFieldIndex("Layer");
    for (std::size_t i = 0; i < contours.size(); ++i) {
        if (i % kFeaturesBetweenStops == 0 && stop.stop_requested()) return cancelled();
        const Contour& contour = contours[i];
        OGRFeature feature((*layer)->GetLayerDefn());
        feature.SetField(layer_field, contour.is_index ? "contours_index" : "contours");
        const OGRLineString line = lineOf(contour);
        feature.SetGeometry(&line);
        if (auto added = add(**layer, feature, file); !added) return added;
        if (!contour.is_index) continue;
        const LabelPlace place = labelPlace(contour);
        OGRFeature label((*layer)->GetLayerDefn());
        label.SetField(layer_field, "contours_label");
        const OGRPoint point(place.at.x(), place.at.y(), contour.level);
        label.SetGeometry(&point);
        label.SetStyleString(
            fmt::format("LABEL(t:\"{}\",s:{}g,a:{:.1f},p:5)", contour.level, label_height, place.turn_deg)
                .c_str());
        if (auto added = add(**layer, label, file); !added) return added;
    }
    return {};
}

/// Polygons of each label along the sides of its cells.
Result<std::map<std::int32_t, OGRMultiPolygon>> polygonsOf(const GridGeometry& g,
                                                           const std::vector<std::int32_t>& labels,
                                                           const fs::path& file) {
    const auto columns = static_cast<int>(g.columns);
    const auto rows = static_cast<int>(g.rows);
    GDALDriverManager& drivers = *GetGDALDriverManager();
    const GdalDataset raster(
        drivers.GetDriverByName("MEM")->Create("", columns, rows, 1, GDT_Int32, nullptr));
    const GdalDataset memory(drivers.GetDriverByName("Memory")->Create("", 0, 0, 0, GDT_Unknown, nullptr));
    if (!raster || !memory) return systemError("cannot make polygons", file);
    std::array<double, 6> transform{g.west_m, g.cell_m, 0.0, g.north_m, 0.0, -g.cell_m};
    GDALRasterBand& band = *raster->GetRasterBand(1);
    bool ok = raster->SetGeoTransform(transform.data()) == CE_None &&
              band.RasterIO(GF_Write, 0, 0, columns, rows, const_cast<std::int32_t*>(labels.data()), columns,
                            rows, GDT_Int32, 0, 0, nullptr) == CE_None;
    const auto layer = addLayer(*memory, "polygons", nullptr, wkbPolygon, {{"label", OFTInteger}}, file);
    if (!layer) return tl::unexpected(layer.error());
    // The band is its own mask: label 0 is no ground.
    ok = ok &&
         GDALPolygonize(&band, &band, OGRLayer::ToHandle(*layer), 0, nullptr, nullptr, nullptr) == CE_None;
    if (!ok) return systemError("cannot make polygons", file);
    std::map<std::int32_t, OGRMultiPolygon> found;
    for (const auto& feature : **layer)
        found[feature->GetFieldAsInteger(0)].addGeometry(feature->GetGeometryRef());
    return found;
}

}  // namespace

Result<void> writeRegions(const GridGeometry& geometry, const std::vector<std::int32_t>& labels,
                          const std::vector<MapRegion>& regions, const ExchangeDescription& description,
                          const fs::path& file, std::stop_token stop) {
    auto crs = crsOf(description.crs_wkt2, file);
    if (!crs) return tl::unexpected(crs.error());
    return writeVectorFile("GPKG", file, [&](GDALDataset& dataset) -> Result<void> {
        const auto polygons = polygonsOf(geometry, labels, file);
        if (!polygons) return tl::unexpected(polygons.error());
        if (stop.stop_requested()) return cancelled();
        std::vector<Field> fields{{"rank", OFTInteger}};
        if (!regions.empty()) {
            for (const auto& [name, value] : regions.front().values)
                fields.push_back({name.c_str(), OFTReal});
        }
        const auto layer = addLayer(dataset, "regions", &*crs, wkbMultiPolygon, fields, file);
        if (!layer) return tl::unexpected(layer.error());
        for (const MapRegion& region : regions) {
            OGRFeature feature((*layer)->GetLayerDefn());
            feature.SetField(0, region.label);
            for (std::size_t i = 0; i < region.values.size(); ++i) {
                feature.SetField(static_cast<int>(i) + 1, region.values[i].second);
            }
            const auto found = polygons->find(region.label);
            if (found == polygons->end()) return badData("a region without a cell", file);
            feature.SetGeometry(&found->second);
            if (auto added = add(**layer, feature, file); !added) return added;
        }
        return {};
    });
}

Result<void> writePointsGeoPackage(const MapPoints& points, const ExchangeDescription& description,
                                   const fs::path& file, std::stop_token stop) {
    if (points.points.empty()) return badData("there is no ground point to write", file);
    auto crs = crsOf(description.crs_wkt2, file);
    if (!crs) return tl::unexpected(crs.error());
    return writeVectorFile("GPKG", file, [&](GDALDataset& dataset) -> Result<void> {
        const auto layer = addLayer(dataset, "ground_points", &*crs, wkbPoint25D,
                                    {{"sigma_z_m", OFTReal},
                                     {"run", OFTString},
                                     {"time_s", OFTReal},
                                     {"used", OFTInteger, OFSTBoolean},
                                     {"reason", OFTString}},
                                    file);
        if (!layer) return tl::unexpected(layer.error());
        if (dataset.StartTransaction() != OGRERR_NONE) return systemError("no transaction", file);
        for (std::size_t i = 0; i < points.points.size(); ++i) {
            if (i % kFeaturesBetweenStops == 0 && stop.stop_requested()) return cancelled();
            const MapPoint& p = points.points[i];
            const bool used = p.state == GroundPointState::Used;
            OGRFeature feature((*layer)->GetLayerDefn());
            if (std::isfinite(p.sigma_u_m)) feature.SetField(0, p.sigma_u_m);
            feature.SetField(1, points.run_ids.at(p.run).c_str());
            feature.SetField(2, p.time_s);
            feature.SetField(3, used ? 1 : 0);
            if (!used) feature.SetField(4, std::string(name(p.state)).c_str());
            const OGRPoint place(p.map_m.x(), p.map_m.y(), p.map_m.z());
            feature.SetGeometry(&place);
            if (auto added = add(**layer, feature, file); !added) return added;
        }
        if (dataset.CommitTransaction() != OGRERR_NONE) return systemError("cannot write the points", file);
        return {};
    });
}

Result<void> writeContours(const std::vector<Contour>& contours, double label_height,
                           const ExchangeDescription& description, const fs::path& file,
                           std::stop_token stop) {
    if (contours.empty())
        return badData("there is no contour to write", file, 0, "choose a smaller interval");
    std::string extension = file.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (extension == ".dxf") {
        return writeVectorFile("DXF", file, [&](GDALDataset& dataset) {
            return writeContourDrawing(contours, label_height, dataset, file, stop);
        });
    }
    if (extension != ".gpkg" && extension != ".geojson") {
        return usageError(fmt::format("contours cannot be written as {}", extension),
                          "name a file .gpkg, .geojson or .dxf");
    }
    auto crs = crsOf(description.crs_wkt2, file);
    if (!crs) return tl::unexpected(crs.error());
    return writeVectorFile(extension == ".gpkg" ? "GPKG" : "GeoJSON", file, [&](GDALDataset& dataset) {
        return writeContourTable(contours, dataset, *crs, file, stop);
    });
}

}  // namespace terrawalk
