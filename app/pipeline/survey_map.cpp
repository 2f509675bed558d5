#include "app/pipeline/survey_map.hpp"

#include <algorithm>
#include <cmath>

#include "io/map_projection.hpp"

namespace terrawalk {

namespace {

Result<std::vector<PlacedMark>> placedMarks(const Survey& survey, const MapProjection& projection) {
    std::vector<ControlMark> marks{*survey.findMark(kZeroMark)};
    marks.insert(marks.end(), survey.marks.begin(), survey.marks.end());
    std::vector<PlacedMark> placed;
    for (const ControlMark& mark : marks) {
        const auto at = projection.toMap(mark.enu_m);
        if (!at) return tl::unexpected(at.error());
        placed.push_back({mark, *at, std::nullopt, std::nullopt});
    }
    return placed;
}

Result<SurveyMap> mapWithMarks(const Survey& survey, const MapProjection& projection) {
    auto marks = placedMarks(survey, projection);
    if (!marks) return tl::unexpected(marks.error());
    return SurveyMap{projection.name(), {}, std::move(*marks)};
}

Result<MapProjection> projectionOf(const Survey& survey) {
    return MapProjection::create(survey.frame(), survey.crs, survey.vertical_datum);
}

Result<void> addErrors(const std::vector<Residual>& residuals, const MapProjection& projection,
                       PlacedMark& placed) {
    Eigen::Vector2d sum_m = Eigen::Vector2d::Zero();
    std::size_t n = 0;
    for (const Residual& r : residuals) {
        if (r.mark != placed.mark.name) continue;
        if (r.stage == Stage::Surface && r.quantity == Quantity::SurfaceHeight) {
            placed.height_error_m = r.difference_enu_m.z();
        }
        if (r.stage != Stage::Fused || r.quantity != Quantity::ArrayPosition) continue;
        if (!r.difference_enu_m.head<2>().allFinite()) continue;
        sum_m += r.difference_enu_m.head<2>();
        ++n;
    }
    if (n == 0) return {};
    Eigen::Vector3d array_enu_m = placed.mark.enu_m;
    array_enu_m.head<2>() += sum_m / static_cast<double>(n);
    const auto at = projection.toMap(array_enu_m);
    if (!at) return tl::unexpected(at.error());
    placed.array_map_m = at->head<2>();
    return {};
}

}  // namespace

Result<SurveyMap> loggedMap(const Survey& survey, const std::stop_token& stop) {
    const auto projection = projectionOf(survey);
    if (!projection) return tl::unexpected(projection.error());
    auto map = mapWithMarks(survey, *projection);
    if (!map) return map;
    const LocalFrame frame = survey.frame();
    for (const Run& run : survey.runs) {
        if (stop.stop_requested()) return cancelled();
        std::vector<Eigen::Vector3d> enu_m;
        std::vector<double> time_s;
        for (std::size_t i = 0; i < run.log.size(); ++i) {
            GeodeticPosition position{run.log.value(Channel::Latitude, i),
                                      run.log.value(Channel::Longitude, i),
                                      run.log.value(Channel::EllipsoidalHeight, i)};
            if (!present(position.lat_deg) || !present(position.lon_deg)) continue;
            if (!present(position.h_ell_m)) position.h_ell_m = survey.zero_point.h_ell_m;
            enu_m.push_back(frame.toEnu(position));
            time_s.push_back(run.log.time_s[i]);
        }
        auto places = projection->toMap(enu_m);
        if (!places) return tl::unexpected(places.error());
        map->tracks.push_back({run.id, run.kind, std::move(*places), std::move(time_s), {}, {}});
    }
    return map;
}

Result<SurveyMap> fusedMap(const Survey& survey, const Products& products, const std::stop_token& stop) {
    const auto projection = projectionOf(survey);
    if (!projection) return tl::unexpected(projection.error());
    auto map = mapWithMarks(survey, *projection);
    if (!map) return map;
    for (std::size_t i = 0; i < products.trajectories.size(); ++i) {
        if (stop.stop_requested()) return cancelled();
        MapTrack track{products.trajectories[i].run_id, survey.runs[i].kind, {}, {}, {}, {}};
        std::vector<Eigen::Vector3d> enu_m;
        for (const TrajectoryEpoch& epoch : products.trajectories[i].epochs) {
            enu_m.push_back(epoch.position_enu_m);
            track.time_s.push_back(epoch.time_s);
            track.sigma_plan_m.push_back(std::sqrt(std::max(epoch.covariance(0, 0), epoch.covariance(1, 1))));
            track.sigma_height_m.push_back(std::sqrt(epoch.covariance(2, 2)));
        }
        auto places = projection->toMap(enu_m);
        if (!places) return tl::unexpected(places.error());
        track.map_m = std::move(*places);
        map->tracks.push_back(std::move(track));
    }
    for (PlacedMark& placed : map->marks) {
        if (auto done = addErrors(products.report.residuals, *projection, placed); !done) {
            return tl::unexpected(done.error());
        }
    }
    return map;
}

}  // namespace terrawalk
