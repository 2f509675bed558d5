#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "app/pipeline/process.hpp"
#include "app/pipeline/survey_map.hpp"
#include "survey/ground_point.hpp"
#include "survey/survey.hpp"

namespace terrawalk {

/// A hit of the range finder beside a place.
struct NearSample {
    std::string run_id;
    double time_s = 0.0;
    double distance_m = 0.0;  ///< in plan
    double height_m = 0.0;    ///< map frame
    double sigma_height_m = 0.0;
    GroundPointState state = GroundPointState::Used;
};

/// Where the standard error of a height comes from; variances add up to that of the cell.
struct SigmaParts {
    double track_m = 0.0;     ///< height of the track: GNSS, barometer, crossovers
    double plan_m = 0.0;      ///< error of the track in plan, times the slope
    double attitude_m = 0.0;  ///< error of the ray's direction in plan, times the slope
    double interpolation_m =
        0.0;  ///< between points, with the noise of ranges and the roughness of the ground
};

/// All that is known of one place of a surface.
struct PlaceReport {
    Eigen::Vector2d map_m = Eigen::Vector2d::Zero();
    std::optional<double> height_m;  ///< of the DEM's cell; nothing outside the surface
    std::optional<double> sigma_m;
    std::optional<SigmaParts> parts;
    double slope = 0.0;       ///< rise over run
    double distance_m = 0.0;  ///< to the nearest point that carries the surface
    double density_per_m2 = 0.0;
    CellSource source = CellSource::None;
    /// Sigma that one more pass over the place, as good as those beside it, would leave.
    std::optional<double> sigma_after_pass_m;
    std::vector<NearSample> nearest;  ///< the nearest hits with a place, used or not
};

/// The ground point next to a place that carries the surface.
struct NearestPoint {
    std::size_t point = 0;    ///< of the products
    double distance_m = 0.0;  ///< in plan
};
/// Nothing where no point was used. Costs one look at every ground point. Pure.
/// @param points_map_m  one for each ground point of the products
[[nodiscard]] std::optional<NearestPoint> nearestCarrying(const Products& products,
                                                          const std::vector<Eigen::Vector3d>& points_map_m,
                                                          const Eigen::Vector2d& at_m);

/// Costs one look at every ground point. Pure.
/// @param survey  with its edits made; products and map are of it
[[nodiscard]] PlaceReport placeReport(const Survey& survey, const Products& products, const SurveyMap& map,
                                      const Eigen::Vector2d& at_m);

}  // namespace terrawalk
