#include "app/pipeline/ground_track.hpp"

#include <cstdint>
#include <utility>

#include "fusion/fuse_survey.hpp"
#include "mapping/point_cleaning.hpp"
#include "mapping/thinning.hpp"
#include "survey/parallel.hpp"

namespace terrawalk {

Result<GroundTrack> groundBelow(const Survey& survey, std::vector<FusedRun> runs,
                                const GroundPointOptions& ground, std::stop_token stop) {
    GroundTrack track{std::nullopt, std::move(runs), {}, {}};
    const std::size_t n = survey.runs.size();
    std::vector<std::vector<GroundPoint>> points(n);
    parallelFor(n, [&](std::size_t i) {
        points[i] = groundPoints(survey.runs[i], static_cast<std::uint32_t>(i), track.runs[i].trajectory,
                                 ground, stop);
    });
    if (stop.stop_requested()) return cancelled();
    for (std::size_t i = 0; i < n; ++i) {
        track.first_point.push_back(track.points.size());
        track.points.insert(track.points.end(), points[i].begin(), points[i].end());
    }
    track.first_point.push_back(track.points.size());
    return track;
}

Result<GroundTrack> trackGround(const Survey& survey, const FusionOptions& fusion,
                                const GroundPointOptions& ground, Progress& progress, std::stop_token stop) {
    auto fused = fuseSurvey(survey, fusion, progress, stop);
    if (!fused) return tl::unexpected(fused.error());
    auto track = groundBelow(survey, std::move(fused->runs), ground, stop);
    if (track) track->adjustment = std::move(fused->adjustment);
    return track;
}

std::vector<GroundPoint> pointsOfRun(const std::vector<GroundPoint>& points, const GroundTrack& track,
                                     std::size_t run) {
    const auto at = [&](std::size_t i) {
        return points.begin() + static_cast<std::ptrdiff_t>(i);
    };
    return {at(track.first_point[run]), at(track.first_point[run + 1])};
}

std::vector<GroundPoint> ofChosenRuns(const Survey& survey, std::vector<GroundPoint> points,
                                      const SurfaceOptions& options) {
    if (options.fixed_point_runs) return points;
    for (GroundPoint& point : points) {
        const bool left_out = survey.runs[point.run].kind == RunKind::FixedPoint;
        if (left_out && point.state == GroundPointState::Used) point.state = GroundPointState::RunLeftOut;
    }
    return points;
}

Result<std::vector<GroundPoint>> surfacePoints(const Survey& survey, std::vector<GroundPoint> points,
                                               const SurfaceOptions& options, Progress& progress,
                                               std::stop_token stop) {
    auto cleaned =
        cleanGroundPoints(ofChosenRuns(survey, std::move(points), options), options.cleaning, progress, stop);
    if (!cleaned) return cleaned;
    return thinGroundPoints(std::move(*cleaned), options.thinning_cell_m);
}

}  // namespace terrawalk
