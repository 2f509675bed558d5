#include "app/pipeline/place_report.hpp"

#include <algorithm>
#include <cmath>

namespace terrawalk {

namespace {

constexpr std::size_t kShownSamples = 6;

struct Distance {
    double squared_m2;
    std::size_t point;
    bool operator<(const Distance& other) const {
        return squared_m2 != other.squared_m2 ? squared_m2 < other.squared_m2 : point < other.point;
    }
};

/// Of the nearest points that pass, the nearest first.
template <class Passes>
std::vector<Distance> nearestPoints(const std::vector<Eigen::Vector3d>& points_map_m,
                                    const Eigen::Vector2d& at_m, std::size_t count, const Passes& passes) {
    std::vector<Distance> all;
    for (std::size_t i = 0; i < points_map_m.size(); ++i) {
        if (!points_map_m[i].allFinite() || !passes(i)) continue;
        all.push_back({(points_map_m[i].head<2>() - at_m).squaredNorm(), i});
    }
    const std::size_t kept = std::min(count, all.size());
    std::partial_sort(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(kept), all.end());
    all.resize(kept);
    return all;
}

struct Carries {
    const Products& products;
    bool operator()(std::size_t i) const { return products.ground_points[i].state == GroundPointState::Used; }
};

NearSample sampleOf(const Survey& survey, const GroundPoint& point, const Eigen::Vector3d& map_m,
                    double squared_m2) {
    return {survey.runs[point.run].id, point.time_s, std::sqrt(squared_m2), map_m.z(),
            point.sigma_u_m,           point.state};
}

InterpolationErrorModel modelOf(const UncertaintySummary& summary) {
    return {summary.coefficients, summary.greatest_distance_m, summary.left_out};
}

/// Share of the track in the error in plan; the rest is the ray's direction.
double trackShare(const Products& products, const GroundPoint& point) {
    const TrajectoryEpoch& epoch = products.trajectories[point.run].epochs[point.epoch];
    const double all = point.sigma_e_m * point.sigma_e_m + point.sigma_n_m * point.sigma_n_m;
    const double track = epoch.covariance(0, 0) + epoch.covariance(1, 1);
    return all > 0.0 ? std::min(1.0, track / all) : 1.0;
}

void addSigma(const Products& products, const SurveyMap& map, std::size_t cell, PlaceReport& place) {
    const auto& summary = products.report.surface.uncertainty;
    if (!products.uncertainty || !summary || std::isnan(products.uncertainty->sigmas_m[cell])) return;
    const GridGeometry& g = products.dem.geometry;
    const std::size_t row = cell / g.columns, column = cell % g.columns;
    const Eigen::Vector2d centre_m(g.centreX(column), g.centreY(row));
    const auto near = nearestPoints(map.ground_points_m, centre_m, kCarryingPoints, Carries{products});
    if (near.empty()) return;
    std::vector<CarryingPoint> carrying;
    for (const Distance& d : near) {
        const GroundPoint& point = products.ground_points[d.point];
        carrying.push_back({map.ground_points_m[d.point].head<2>(), d.squared_m2,
                            trackSigmaOf(point, products.trajectories[point.run])});
    }
    const InterpolationErrorModel model = modelOf(*summary);
    CellSigma sigma = cellSigma(products.dem, row, column, carrying, model);
    const double share = trackShare(products, products.ground_points[near.front().point]);
    place.sigma_m = products.uncertainty->sigmas_m[cell];
    if (summary->own_variance) {  // what the track does not account for is the method's own
        const double own_m2 =
            *place.sigma_m * *place.sigma_m - sigma.track_m * sigma.track_m - sigma.lean_m * sigma.lean_m;
        sigma.interpolation_m = std::sqrt(std::max(0.0, own_m2));
    }
    place.density_per_m2 = products.uncertainty->density_per_m2[cell];
    place.source = static_cast<CellSource>(products.uncertainty->sources[cell]);
    place.slope = sigma.slope;
    place.distance_m = sigma.distance_m;
    place.parts = SigmaParts{sigma.track_m, sigma.lean_m * std::sqrt(share),
                             sigma.lean_m * std::sqrt(1.0 - share), sigma.interpolation_m};
    // The mean of two passes, and a point on the spot.
    const double shared =
        0.5 * (1.0 + kOtherPassCorrelation) * (sigma.track_m * sigma.track_m + sigma.lean_m * sigma.lean_m);
    place.sigma_after_pass_m = std::sqrt(shared + summary->at_point_m * summary->at_point_m);
}

}  // namespace

std::optional<NearestPoint> nearestCarrying(const Products& products,
                                            const std::vector<Eigen::Vector3d>& points_map_m,
                                            const Eigen::Vector2d& at_m) {
    const auto nearest = nearestPoints(points_map_m, at_m, 1, Carries{products});
    if (nearest.empty()) return std::nullopt;
    return NearestPoint{nearest.front().point, std::sqrt(nearest.front().squared_m2)};
}

PlaceReport placeReport(const Survey& survey, const Products& products, const SurveyMap& map,
                        const Eigen::Vector2d& at_m) {
    PlaceReport place;
    place.map_m = at_m;
    for (const Distance& d :
         nearestPoints(map.ground_points_m, at_m, kShownSamples, [](std::size_t) { return true; })) {
        place.nearest.push_back(
            sampleOf(survey, products.ground_points[d.point], map.ground_points_m[d.point], d.squared_m2));
    }
    const auto cell = products.dem.geometry.cellAt(at_m.x(), at_m.y());
    if (!cell || std::isnan(products.dem.heights_m[*cell])) return place;
    place.height_m = products.dem.heights_m[*cell];
    addSigma(products, map, *cell, place);
    return place;
}

}  // namespace terrawalk
