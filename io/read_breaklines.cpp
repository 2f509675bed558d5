#include "io/read_breaklines.hpp"

#include <fmt/format.h>
#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <limits>
#include <optional>

#include "io/gdal_support.hpp"
#include "io/text_input.hpp"

namespace terrawalk {
namespace {

class BreaklineLayer {
  public:
    BreaklineLayer(OGRLayer& layer, const std::filesystem::path& file, std::vector<Breakline>& lines)
        : layer_(layer),
          file_(file),
          lines_(lines),
          kind_field_(layer.GetLayerDefn()->GetFieldIndex("kind")) {}

    Result<void> read(const std::stop_token& stop) {
        layer_.ResetReading();
        for (;;) {
            if (stop.stop_requested()) return cancelled();
            const OGRFeatureUniquePtr feature(layer_.GetNextFeature());
            if (!feature) return {};
            name_ = fmt::format("{} feature {}", layer_.GetName(), feature->GetFID());
            const auto kind = kindOf(*feature);
            if (!kind) return tl::unexpected(kind.error());
            if (feature->GetGeometryRef() != nullptr) take(*feature->GetGeometryRef(), *kind);
        }
    }

  private:
    Result<std::optional<BreaklineKind>> kindOf(const OGRFeature& feature) const {
        if (kind_field_ < 0 || feature.IsFieldSetAndNotNull(kind_field_) == FALSE) return std::nullopt;
        const std::string text = feature.GetFieldAsString(kind_field_);
        for (const auto& [kind, known] : kBreaklineKinds) {
            if (text == known) return kind;
        }
        return badData(fmt::format("{} is of kind {}", name_, inQuotes(text)), file_, 0,
                       "hard, soft, boundary or hole");
    }

    void take(const OGRGeometry& geometry, std::optional<BreaklineKind> kind) {
        const OGRwkbGeometryType type = wkbFlatten(geometry.getGeometryType());
        if (type == wkbLineString) {
            add(*geometry.toLineString(), kind.value_or(BreaklineKind::Hard));
        } else if (type == wkbPolygon) {
            bool outer = true;
            for (const OGRLinearRing* const ring : *geometry.toPolygon()) {
                add(*ring, outer ? kind.value_or(BreaklineKind::Boundary) : BreaklineKind::Hole);
                outer = false;
            }
        } else if (OGR_GT_IsSubClassOf(type, wkbGeometryCollection) != FALSE) {
            for (const OGRGeometry* const part : *geometry.toGeometryCollection()) take(*part, kind);
        }
    }

    void add(const OGRSimpleCurve& curve, BreaklineKind kind) {
        Breakline line{{}, kind, name_};
        const bool flat = curve.Is3D() == FALSE;
        for (int i = 0; i < curve.getNumPoints(); ++i) {
            line.vertices_m.emplace_back(curve.getX(i), curve.getY(i),
                                         flat ? std::numeric_limits<double>::quiet_NaN() : curve.getZ(i));
        }
        if (!line.vertices_m.empty()) lines_.push_back(std::move(line));
    }

    OGRLayer& layer_;
    std::filesystem::path file_;
    std::vector<Breakline>& lines_;
    int kind_field_;
    std::string name_;
};

}  // namespace

Result<BreaklineFile> readBreaklines(const std::filesystem::path& file, Progress& progress,
                                     std::stop_token stop) {
    GDALAllRegister();
    const GdalErrors errors;
    const GdalDataset dataset(GDALDataset::Open(file.c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY));
    if (!dataset) {
        return badData("GDAL reads no lines from this file: " + errors.text(), file, 0,
                       "give .gpkg, .shp, .geojson, .dxf or another vector format");
    }
    BreaklineFile found;
    const OGRSpatialReference* crs = nullptr;
    for (int i = 0; i < dataset->GetLayerCount(); ++i) {
        progress.report(static_cast<double>(i) / dataset->GetLayerCount(), "reading breaklines");
        OGRLayer* const layer = dataset->GetLayer(i);
        const std::size_t before = found.lines.size();
        if (auto done = BreaklineLayer(*layer, file, found.lines).read(stop); !done) {
            return tl::unexpected(done.error());
        }
        if (found.lines.size() == before) continue;
        const OGRSpatialReference* const own = layer->GetSpatialRef();
        if (crs != nullptr && own != nullptr && own->IsSame(crs) == FALSE) {
            return badData("the layers have different CRS", file, 0, "bring them to one");
        }
        if (own != nullptr) crs = own;
    }
    if (errors.any()) return badData("the file cannot be read to its end: " + errors.text(), file);
    if (found.lines.empty()) return badData("there is no line or polygon in the file", file);
    found.crs = wktOf(crs);
    return found;
}

}  // namespace terrawalk
