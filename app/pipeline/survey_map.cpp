#include "app/pipeline/survey_map.hpp"

#include <algorithm>
#include <cmath>

#include "io/map_projection.hpp"
#include "mapping/contours.hpp"

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
    return SurveyMap{projection.name(), projection.heightReference(), {}, std::move(*marks), {}};
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

Result<std::vector<Eigen::Vector3d>> groundPointsOnMap(const std::vector<GroundPoint>& points,
                                                       const MapProjection& projection) {
    std::vector<Eigen::Vector3d> known_enu_m;
    for (const GroundPoint& point : points) {
        if (point.enu_m.allFinite()) known_enu_m.push_back(point.enu_m);
    }
    auto known = projection.toMap(known_enu_m);
    if (!known) return known;
    std::vector<Eigen::Vector3d> all(points.size(), Eigen::Vector3d::Constant(kMissing));
    std::size_t next = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (points[i].enu_m.allFinite()) all[i] = (*known)[next++];
    }
    return all;
}

/// @param time_s  of the epochs, in order
std::vector<double> residualsAlong(const std::vector<double>& time_s,
                                   const std::vector<SensorInnovations>& sensors) {
    std::vector<double> worst(time_s.size(), kMissing);
    bool some = false;
    for (const SensorInnovations& sensor : sensors) {
        for (const Innovation& reading : sensor.readings) {
            const auto after = std::upper_bound(time_s.begin(), time_s.end(), reading.time_s);
            if (after == time_s.begin()) continue;
            double& epoch = worst[static_cast<std::size_t>(after - time_s.begin()) - 1];
            const auto size = static_cast<double>(std::abs(reading.over_sigma));
            if (!(epoch >= size)) epoch = size;
            some = true;
        }
    }
    return some ? worst : std::vector<double>();
}

int fixOf(const ArrayLog& log, std::size_t epoch) {
    const double code = log.value(Channel::Fix, epoch);
    return present(code) ? static_cast<int>(code) : -1;
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
        std::vector<int> fix;
        for (std::size_t i = 0; i < run.log.size(); ++i) {
            GeodeticPosition position{run.log.value(Channel::Latitude, i),
                                      run.log.value(Channel::Longitude, i),
                                      run.log.value(Channel::EllipsoidalHeight, i)};
            if (!present(position.lat_deg) || !present(position.lon_deg)) continue;
            if (!present(position.h_ell_m)) position.h_ell_m = survey.zero_point.h_ell_m;
            enu_m.push_back(frame.toEnu(position));
            time_s.push_back(run.log.time_s[i]);
            fix.push_back(fixOf(run.log, i));
        }
        auto places = projection->toMap(enu_m);
        if (!places) return tl::unexpected(places.error());
        map->tracks.push_back(
            {run.id, run.kind, std::move(*places), std::move(time_s), std::move(fix), {}, {}, {}, {}});
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
        MapTrack track{products.trajectories[i].run_id, survey.runs[i].kind, {}, {}, {}, {}, {}, {}, {}};
        std::vector<Eigen::Vector3d> enu_m;
        for (const TrajectoryEpoch& epoch : products.trajectories[i].epochs) {
            enu_m.push_back(epoch.position_enu_m);
            track.fix.push_back(fixOf(survey.runs[i].log, track.time_s.size()));
            track.time_s.push_back(epoch.time_s);
            track.speed_mps.push_back(epoch.velocity_enu_mps.head<2>().norm());
            track.sigma_plan_m.push_back(std::sqrt(std::max(epoch.covariance(0, 0), epoch.covariance(1, 1))));
            track.sigma_height_m.push_back(std::sqrt(epoch.covariance(2, 2)));
        }
        if (i < products.innovations.size()) {
            track.residual_over_sigma = residualsAlong(track.time_s, products.innovations[i]);
        }
        auto places = projection->toMap(enu_m);
        if (!places) return tl::unexpected(places.error());
        track.map_m = std::move(*places);
        map->tracks.push_back(std::move(track));
    }
    auto points = groundPointsOnMap(products.ground_points, *projection);
    if (!points) return tl::unexpected(points.error());
    map->ground_points_m = std::move(*points);
    for (PlacedMark& placed : map->marks) {
        if (auto done = addErrors(products.report.residuals, *projection, placed); !done) {
            return tl::unexpected(done.error());
        }
    }
    return map;
}

Result<std::vector<Contour>> surfaceContours(const Products& products, double interval_m, Progress& progress,
                                             const std::stop_token& stop) {
    std::optional<ElevationGrid> sigmas;
    if (products.uncertainty) sigmas = ElevationGrid{products.dem.geometry, products.uncertainty->sigmas_m};
    ContourOptions options{.interval = interval_m};
    if (sigmas) options.sigmas = &*sigmas;
    auto lines = contourLines(products.dem, options, progress, stop);
    if (!lines) return tl::unexpected(lines.error());
    return std::move(lines->contours);
}

SurfaceProfile surfaceProfile(const Products& products, const SurveyMap& map,
                              const std::vector<Eigen::Vector2d>& line_m) {
    const double cell_m = products.dem.geometry.cell_m;
    std::optional<ElevationGrid> sigmas;
    if (products.uncertainty) sigmas = ElevationGrid{products.dem.geometry, products.uncertainty->sigmas_m};
    SurfaceProfile profile;
    profile.points = profileAlong(products.dem, sigmas ? &*sigmas : nullptr, line_m, 0.5 * cell_m);
    for (const PlacedMark& placed : map.marks) {
        const LineOffset at = offsetFrom(line_m, placed.map_m.head<2>());
        const bool beside =
            (placed.map_m.head<2>() - line_m.front()).norm() < 2.0 * cell_m || at.distance > 0.0;
        if (!beside || std::abs(at.offset) > 2.0 * cell_m) continue;
        profile.marks.push_back({placed.mark.name, at.distance, placed.map_m.z()});
    }
    return profile;
}

}  // namespace terrawalk
