#include "app/pipeline/ground_points_on_map.hpp"

#include "io/map_projection.hpp"

namespace terrawalk {

Result<std::vector<Eigen::Vector3d>> groundPointsOnMap(const Survey& survey, const Products& products,
                                                       const std::stop_token& stop) {
    constexpr std::size_t kPart = 10'000;
    const auto projection = MapProjection::create(survey.frame(), survey.crs, survey.vertical_datum);
    if (!projection) return tl::unexpected(projection.error());
    std::vector<Eigen::Vector3d> places(products.ground_points.size(), Eigen::Vector3d::Constant(kMissing));
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (i % kPart == 0 && stop.stop_requested()) return cancelled();
        const Eigen::Vector3d& enu_m = products.ground_points[i].enu_m;
        if (!enu_m.allFinite()) continue;
        auto at = projection->toMap(enu_m);
        if (!at) return tl::unexpected(at.error());
        places[i] = *at;
    }
    return places;
}

}  // namespace terrawalk
