#pragma once

#include <filesystem>
#include <stop_token>
#include <string>
#include <vector>

#include "survey/breakline.hpp"
#include "survey/progress.hpp"
#include "survey/result.hpp"

namespace terrawalk {

struct BreaklineFile {
    std::vector<Breakline> lines;
    std::string crs;  ///< as describeCrs() takes it; empty where the file has none
};

/// Lines and polygons of a vector file that GDAL reads (GeoPackage, Shapefile, GeoJSON, DXF, ...), all
/// layers. A field "kind" says hard, soft, boundary or hole; without it lines are hard, and polygons are
/// boundaries with their inner rings as holes. Flat geometry gets heights of NaN. Names are "LAYER feature
/// N". Errors: BadData for a file without lines, for a kind that is none, and for a layer with another CRS
/// than the one before.
[[nodiscard]] Result<BreaklineFile> readBreaklines(const std::filesystem::path& file, Progress& progress,
                                                   std::stop_token stop);

}  // namespace terrawalk
