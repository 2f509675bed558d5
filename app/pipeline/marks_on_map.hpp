#pragma once

#include <filesystem>
#include <stop_token>
#include <string>
#include <vector>

#include "io/coordinate_system.hpp"
#include "survey/progress.hpp"
#include "survey/result.hpp"
#include "survey/survey.hpp"

namespace terrawalk {

/// Where marks come from: a table of a survey in its local frame, or points in the DEM's own frame.
struct MarkSource {
    std::filesystem::path marks;  ///< control.csv of a survey
    std::filesystem::path
        survey_output;                   ///< folder of `process` that knows the local frame; empty: the DEM's
    std::filesystem::path check_points;  ///< any file that readPoints() reads, in the DEM's CRS
    [[nodiscard]] bool empty() const { return marks.empty() && check_points.empty(); }
};

struct MapMark {
    ControlMark mark;  ///< as in its file; of check points enu_m is the place on the map
    Eigen::Vector3d map = Eigen::Vector3d::Zero();  ///< in the frame and the unit of the DEM
};

/// Reads marks and takes them to the map. Check points are named after their place in the file and have role
/// check. Errors: Usage for neither or both; BadData for a survey in another CRS than the DEM.
[[nodiscard]] Result<std::vector<MapMark>> marksOnMap(const MarkSource& source,
                                                      const std::filesystem::path& dem_file,
                                                      const CoordinateSystem& dem_crs, Progress& progress,
                                                      std::stop_token stop);

}  // namespace terrawalk
