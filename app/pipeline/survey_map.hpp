#pragma once

#include <Eigen/Core>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "app/pipeline/process.hpp"
#include "mapping/profile.hpp"
#include "survey/contour.hpp"
#include "survey/result.hpp"
#include "survey/survey.hpp"

namespace terrawalk {

/// A run as a line on the map: one place for each epoch that has a position, in its order.
struct MapTrack {
    std::string run_id;
    RunKind kind = RunKind::Area;
    std::vector<Eigen::Vector3d> map_m;
    std::vector<double> time_s;        ///< of the log
    std::vector<int> fix;              ///< of the receiver, as fix_code; -1 where the log does not tell
    std::vector<double> speed_mps;     ///< over ground; empty where nobody tells
    std::vector<double> sigma_plan_m;  ///< larger of the two axes, 1 sigma; empty where nobody tells
    std::vector<double> sigma_height_m;
    /// Size of the worst innovation of any sensor that came between this epoch and the next, over its sigma;
    /// kMissing where none came; empty from methods that do not filter.
    std::vector<double> residual_over_sigma;
};

/// A mark on the map, with what is known of the errors there.
struct PlacedMark {
    ControlMark mark;
    Eigen::Vector3d map_m = Eigen::Vector3d::Zero();
    std::optional<Eigen::Vector2d> array_map_m;  ///< where the fused track says that the mark is; the mean of
                                                 ///< its runs
    std::optional<double> height_error_m;        ///< surface less mark
};

/// A survey in the map frame, for drawing.
struct SurveyMap {
    std::string crs;               ///< human-readable name of the map frame
    std::string height_reference;  ///< what heights count from, one sentence
    std::vector<MapTrack> tracks;
    std::vector<PlacedMark> marks;                 ///< the zero point first
    std::vector<Eigen::Vector3d> ground_points_m;  ///< one for each ground point of the products; not finite
                                                   ///< where it has no place
};

/// The GNSS positions as they were logged. Errors: as MapProjection; Cancelled.
[[nodiscard]] Result<SurveyMap> loggedMap(const Survey& survey, const std::stop_token& stop);
/// Contours of the products' surface, for drawing: in the map frame, `interval_m` apart. Errors: as
/// contourLines().
[[nodiscard]] Result<std::vector<Contour>> surfaceContours(const Products& products, double interval_m,
                                                           Progress& progress, const std::stop_token& stop);

/// Heights and their sigmas along a line over the products' surface, half a cell apart, and the marks beside
/// it.
struct SurfaceProfile {
    struct Mark {
        std::string name;
        double distance_m = 0.0;  ///< along the line
        double height_m = 0.0;
    };
    std::vector<ProfilePoint> points;
    std::vector<Mark> marks;  ///< no farther than two cells from the line
};
/// @param line_m  at least two vertices, map frame
[[nodiscard]] SurfaceProfile surfaceProfile(const Products& products, const SurveyMap& map,
                                            const std::vector<Eigen::Vector2d>& line_m);

/// The fused tracks, and the marks with their errors. Errors: as above.
/// @param products  of this survey
[[nodiscard]] Result<SurveyMap> fusedMap(const Survey& survey, const Products& products,
                                         const std::stop_token& stop);

}  // namespace terrawalk
