#pragma once

#include <cpl_error.h>
#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include <memory>
#include <string>

namespace terrawalk {

struct DatasetDeleter {
    void operator()(GDALDataset* dataset) const { GDALClose(dataset); }
};
using GdalDataset = std::unique_ptr<GDALDataset, DatasetDeleter>;

/// Keeps what GDAL would print in this thread.
class GdalErrors {
  public:
    GdalErrors() { CPLPushErrorHandlerEx(&keep, this); }
    GdalErrors(const GdalErrors&) = delete;
    GdalErrors& operator=(const GdalErrors&) = delete;
    ~GdalErrors() { CPLPopErrorHandler(); }

    [[nodiscard]] bool any() const { return !first_.empty(); }
    [[nodiscard]] std::string text() const { return any() ? first_ : "GDAL names no reason"; }

  private:
    static void CPL_STDCALL keep(CPLErr severity, CPLErrorNum, const char* message) {
        auto& self = *static_cast<GdalErrors*>(CPLGetErrorHandlerUserData());
        // The first failure is the cause; those that follow are its echoes.
        if (severity >= CE_Failure && self.first_.empty()) self.first_ = message;
    }
    std::string first_;
};

/// Well-known text; empty without a CRS, or where GDAL cannot write it.
inline std::string wktOf(const OGRSpatialReference* crs) {
    if (crs == nullptr) return {};
    char* text = nullptr;
    const bool ok = crs->exportToWkt(&text) == OGRERR_NONE && text != nullptr;
    std::string wkt = ok ? text : "";
    CPLFree(text);
    return wkt;
}

}  // namespace terrawalk
