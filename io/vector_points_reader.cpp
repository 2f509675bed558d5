#include <fmt/format.h>
#include <gdal_priv.h>
#include <ogrsf_frmts.h>

#include <cmath>
#include <string>
#include <utility>

#include "io/gdal_support.hpp"
#include "io/point_readers.hpp"

namespace terrawalk {
namespace {

constexpr std::size_t kFeaturesBetweenReports = 4096;

bool holdsPoints(OGRLayer& layer) {
    const OGRwkbGeometryType type = wkbFlatten(layer.GetGeomType());
    return type == wkbPoint || type == wkbMultiPoint || type == wkbUnknown;
}

/// The one layer with points.
Result<OGRLayer*> pointLayer(GDALDataset& dataset, const std::filesystem::path& file) {
    OGRLayer* found = nullptr;
    for (int i = 0; i < dataset.GetLayerCount(); ++i) {
        OGRLayer* const layer = dataset.GetLayer(i);
        if (!holdsPoints(*layer)) continue;
        if (found != nullptr) {
            return badData(
                fmt::format("layers {} and {} both hold points", found->GetName(), layer->GetName()), file, 0,
                "keep one of them in a file of its own");
        }
        found = layer;
    }
    if (found == nullptr) return badData("no layer holds points", file);
    return found;
}

class VectorPoints {
  public:
    VectorPoints(OGRLayer& layer, const std::filesystem::path& file) : layer_(layer), file_(file) {
        const OGRFeatureDefn& fields = *layer.GetLayerDefn();
        for (int i = 0; i < fields.GetFieldCount(); ++i) {
            const auto named = namedColumn(fields.GetFieldDefn(i)->GetNameRef());
            if (named && named->column == PointColumn::Z && height_field_ < 0) height_field_ = i;
            if (named && named->column == PointColumn::Sigma) sigma_field_ = i;
            if (named && named->column == PointColumn::Used) used_field_ = i;
        }
    }

    Result<ScatteredPoints> read(Progress& progress, const std::stop_token& stop) {
        points_.crs = wktOf(layer_.GetSpatialRef());
        const auto total = static_cast<double>(std::max<GIntBig>(layer_.GetFeatureCount(), 1));
        const std::string step = fmt::format("reading {}", file_.filename().string());
        layer_.ResetReading();
        for (std::size_t i = 0;; ++i) {
            if (i % kFeaturesBetweenReports == 0) {
                if (stop.stop_requested()) return cancelled();
                progress.report(std::min(1.0, static_cast<double>(i) / total), step);
            }
            const OGRFeatureUniquePtr feature(layer_.GetNextFeature());
            if (!feature) break;
            if (auto taken = take(*feature); !taken) return tl::unexpected(taken.error());
        }
        leaveOutUnused(points_, left_out_);
        if (without_place_ > 0) {
            points_.notes.push_back(fmt::format("{} features have no point", without_place_));
        }
        return std::move(points_);
    }

  private:
    Result<void> take(const OGRFeature& feature) {
        if (used_field_ >= 0 && feature.IsFieldSetAndNotNull(used_field_) != FALSE &&
            std::string_view(feature.GetFieldAsString(used_field_)) == "0") {
            ++left_out_;
            return {};
        }
        const OGRGeometry* const geometry = feature.GetGeometryRef();
        const OGRwkbGeometryType type =
            geometry == nullptr ? wkbNone : wkbFlatten(geometry->getGeometryType());
        if ((type != wkbPoint && type != wkbMultiPoint) || geometry->IsEmpty() != FALSE) {
            ++without_place_;
            return {};
        }
        if (type == wkbPoint) return take(feature, *geometry->toPoint());
        for (const OGRPoint* const point : *geometry->toMultiPoint()) {
            if (auto taken = take(feature, *point); !taken) return taken;
        }
        return {};
    }

    Result<void> take(const OGRFeature& feature, const OGRPoint& point) {
        double height = point.getZ();
        if (point.Is3D() == FALSE) {
            if (height_field_ < 0 || feature.IsFieldSetAndNotNull(height_field_) == FALSE) {
                return badData(fmt::format("point {} has no height", feature.GetFID()), file_, 0,
                               "give 3D points, or a field named z or height");
            }
            height = feature.GetFieldAsDouble(height_field_);
        }
        points_.points.emplace_back(point.getX(), point.getY(), height);
        if (!points_.points.back().allFinite()) {
            return badData(fmt::format("point {} has no place", feature.GetFID()), file_);
        }
        if (sigma_field_ >= 0) {
            const double sigma = feature.GetFieldAsDouble(sigma_field_);
            if (!(sigma >= 0.0) || feature.IsFieldSetAndNotNull(sigma_field_) == FALSE) {
                return badData(fmt::format("point {} has no sigma", feature.GetFID()), file_);
            }
            points_.sigmas.push_back(sigma);
        }
        return {};
    }

    OGRLayer& layer_;
    std::filesystem::path file_;
    int height_field_ = -1;
    int sigma_field_ = -1;
    int used_field_ = -1;
    std::size_t left_out_ = 0;
    std::size_t without_place_ = 0;
    ScatteredPoints points_;
};

}  // namespace

Result<ScatteredPoints> readVectorPoints(const std::filesystem::path& file, Progress& progress,
                                         const std::stop_token& stop) {
    GDALAllRegister();
    const GdalErrors errors;
    const GdalDataset dataset(GDALDataset::Open(file.c_str(), GDAL_OF_VECTOR | GDAL_OF_READONLY));
    if (!dataset) {
        return badData("GDAL reads no points from this file: " + errors.text(), file, 0,
                       "give .csv, .las, .ply, .gpkg or another vector format that GDAL knows");
    }
    const auto layer = pointLayer(*dataset, file);
    if (!layer) return tl::unexpected(layer.error());
    auto points = VectorPoints(**layer, file).read(progress, stop);
    if (points && errors.any()) return badData("the file cannot be read to its end: " + errors.text(), file);
    return points;
}

}  // namespace terrawalk
