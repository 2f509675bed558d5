#include "mapping/mark_residuals.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "mapping/order_statistics.hpp"

namespace terrawalk {

namespace {

bool hasSoundRange(const GroundPoint& point) {
    const bool sound = point.state == GroundPointState::Used || point.state == GroundPointState::Thinned ||
                       point.state == GroundPointState::RunLeftOut ||
                       point.state == GroundPointState::PositionUnsure;
    return sound && point.enu_m.allFinite();
}

bool isSound(const GroundPoint& point) {
    return hasSoundRange(point) && point.state != GroundPointState::PositionUnsure;
}

template <class Value>
double medianOf(const std::vector<const GroundPoint*>& points, Value value) {
    std::vector<double> values;
    values.reserve(points.size());
    for (const GroundPoint* point : points) {
        if (std::isfinite(value(*point))) values.push_back(value(*point));
    }
    return values.empty() ? kMissing : median(std::move(values));
}

Residual residualAt(const ControlMark& mark, Stage stage, Quantity quantity) {
    Residual residual;
    residual.stage = stage;
    residual.quantity = quantity;
    residual.mark = mark.name;
    residual.role = mark.role;
    residual.mark_enu_m = mark.enu_m;
    return residual;
}

Residual positionResidual(const MarkStand& stand, const Trajectory& trajectory,
                          const std::vector<const GroundPoint*>& points, Stage stage) {
    Residual residual = residualAt(stand.mark, stage, Quantity::ArrayPosition);
    for (Eigen::Index axis = 0; axis < 2; ++axis) {
        residual.difference_enu_m[axis] =
            medianOf(points,
                     [&](const GroundPoint& p) { return trajectory.epochs[p.epoch].position_enu_m[axis]; }) -
            stand.mark.enu_m[axis];
        residual.sigma_enu_m[axis] =
            std::hypot(medianOf(points,
                                [&](const GroundPoint& p) {
                                    return std::sqrt(trajectory.epochs[p.epoch].covariance(axis, axis));
                                }),
                       stand.mark.sigma_h_m);
    }
    residual.difference_enu_m.z() =
        medianOf(points, [](const GroundPoint& p) { return p.enu_m.z(); }) - stand.mark.enu_m.z();
    residual.sigma_enu_m.z() =
        std::hypot(medianOf(points, [](const GroundPoint& p) { return p.sigma_u_m; }), stand.mark.sigma_v_m);
    return residual;
}

/// Of the difference between a ground point's height and a mark's.
double sampleSigma(const GroundPoint& point, const ControlMark& mark, const SurfaceHeightAt& surface_height) {
    if (!surface_height) return kMissing;
    const auto below = surface_height(point.enu_m), at_mark = surface_height(mark.enu_m);
    if (!below || !at_mark) return kMissing;
    const double ground_m = below->height_m - at_mark->height_m;
    const double plan_m = std::hypot(point.sigma_e_m, point.sigma_n_m) / std::sqrt(2.0);
    const double slope = std::isfinite(at_mark->slope) ? at_mark->slope : 0.0;
    const Eigen::Vector4d parts_m(point.sigma_u_m, slope * plan_m, ground_m, mark.sigma_v_m);
    return parts_m.norm();
}

/// The nearest point that a mark has met so far.
struct Nearest {
    double distance_squared_m2 = 0.0;
    const GroundPoint* point = nullptr;

    void offer(double candidate_m2, const GroundPoint& candidate) {
        const auto place = [](const GroundPoint& p) {
            return std::tie(p.run, p.epoch);
        };
        if (point == nullptr || candidate_m2 < distance_squared_m2 ||
            (candidate_m2 == distance_squared_m2 && place(candidate) < place(*point))) {
            distance_squared_m2 = candidate_m2;
            point = &candidate;
        }
    }
};

/// For each mark the nearest sound point within the limit. The marks are few, so they are sorted and the many
/// points visit them.
std::vector<Nearest> nearestPoints(const std::vector<ControlMark>& marks,
                                   const std::vector<GroundPoint>& points, double greatest_distance_m) {
    std::vector<std::size_t> eastward(marks.size());
    std::iota(eastward.begin(), eastward.end(), std::size_t{0});
    std::stable_sort(eastward.begin(), eastward.end(),
                     [&](std::size_t a, std::size_t b) { return marks[a].enu_m.x() < marks[b].enu_m.x(); });
    const double greatest_m2 = greatest_distance_m * greatest_distance_m;

    std::vector<Nearest> nearest(marks.size());
    for (const GroundPoint& point : points) {
        if (!isSound(point)) continue;
        const double west_m = point.enu_m.x() - greatest_distance_m;
        const double east_m = point.enu_m.x() + greatest_distance_m;
        auto at = std::lower_bound(eastward.begin(), eastward.end(), west_m,
                                   [&](std::size_t mark, double e_m) { return marks[mark].enu_m.x() < e_m; });
        for (; at != eastward.end() && marks[*at].enu_m.x() <= east_m; ++at) {
            const double d2 = (point.enu_m - marks[*at].enu_m).head<2>().squaredNorm();
            if (d2 <= greatest_m2) nearest[*at].offer(d2, point);
        }
    }
    return nearest;
}

}  // namespace

std::set<std::string> tiedMarks(const Survey& survey, const StandOptions& options) {
    std::set<std::string> names;
    for (const Run& run : survey.runs) {
        for (const MarkStand& stand : markStands(survey, run, options)) {
            if (stand.may_tie) names.insert(stand.mark.name);
        }
    }
    return names;
}

MarkResiduals positionResiduals(const Run& run, const std::vector<MarkStand>& stands,
                                const Trajectory& trajectory, const std::vector<GroundPoint>& points,
                                Stage stage, bool tied) {
    MarkResiduals out;
    for (const MarkStand& stand : stands) {
        if (stand.place == StandPlace::Start && stand.may_tie) continue;
        std::vector<const GroundPoint*> on_mark;
        for (const GroundPoint& point : points) {
            if (point.time_s >= stand.from_s && point.time_s <= stand.to_s && hasSoundRange(point)) {
                on_mark.push_back(&point);
            }
        }
        if (on_mark.empty()) {
            out.missing.push_back({stage, Quantity::ArrayPosition, stand.mark.name, stand.mark.role, run.id});
            continue;
        }
        Residual residual = positionResidual(stand, trajectory, on_mark, stage);
        residual.run = run.id;
        residual.used_by_estimator = tied && stand.may_tie;
        out.residuals.push_back(std::move(residual));
    }
    return out;
}

MarkResiduals nearestSampleResiduals(const Survey& survey, const std::vector<GroundPoint>& points,
                                     Stage stage, const std::set<std::string>& tied_marks,
                                     const NearestSampleOptions& options,
                                     const SurfaceHeightAt& surface_height) {
    const std::vector<Nearest> nearest = nearestPoints(survey.marks, points, options.greatest_distance_m);
    MarkResiduals out;
    for (std::size_t i = 0; i < survey.marks.size(); ++i) {
        const ControlMark& mark = survey.marks[i];
        const GroundPoint* point = nearest[i].point;
        if (point == nullptr) {
            out.missing.push_back({stage, Quantity::NearestSample, mark.name, mark.role, {}});
            continue;
        }
        Residual residual = residualAt(mark, stage, Quantity::NearestSample);
        residual.run = survey.runs.at(point->run).id;
        residual.difference_enu_m.z() = point->enu_m.z() - mark.enu_m.z();
        residual.sigma_enu_m.z() = sampleSigma(*point, mark, surface_height);
        residual.used_by_estimator = tied_marks.contains(mark.name);
        out.residuals.push_back(std::move(residual));
    }
    return out;
}

GroundCover coverAt(const ControlMark& mark, const std::vector<GroundPoint>& cleaned) {
    constexpr double kNear_m = 1.0;
    constexpr std::size_t kLeastHits = 3;
    std::size_t hits = 0, on_plants = 0;
    for (const GroundPoint& point : cleaned) {
        const bool plant = point.state == GroundPointState::AboveGround;
        if (!plant && !hasSoundRange(point)) continue;
        if (!((point.enu_m - mark.enu_m).head<2>().norm() <= kNear_m)) continue;
        ++hits;
        on_plants += plant ? 1 : 0;
    }
    if (on_plants > 0) return GroundCover::Vegetated;
    return hits >= kLeastHits ? GroundCover::Open : GroundCover::Unknown;
}

MarkResiduals surfaceResiduals(const std::vector<ControlMark>& marks, const SurfaceHeightAt& surface_height,
                               Stage stage, const std::set<std::string>& tied_marks) {
    MarkResiduals out;
    for (const ControlMark& mark : marks) {
        const std::optional<SurfaceHeight> surface = surface_height(mark.enu_m);
        if (!surface || !std::isfinite(surface->height_m)) {
            out.missing.push_back({stage, Quantity::SurfaceHeight, mark.name, mark.role, {}});
            continue;
        }
        Residual residual = residualAt(mark, stage, Quantity::SurfaceHeight);
        residual.difference_enu_m.z() = surface->height_m - mark.enu_m.z();
        residual.sigma_enu_m.z() = std::hypot(surface->sigma_m, mark.sigma_v_m);
        residual.slope = surface->slope;
        residual.used_by_estimator = tied_marks.contains(mark.name);
        out.residuals.push_back(std::move(residual));
    }
    return out;
}

}  // namespace terrawalk
