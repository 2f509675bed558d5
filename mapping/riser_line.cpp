#include "mapping/riser_line.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

#include "mapping/order_statistics.hpp"
#include "survey/parallel.hpp"

namespace terrawalk {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr std::size_t kLeastInWindow = 12;
constexpr std::size_t kLeastNearby = 6;
constexpr double kSeedGain = 9.0;  // of the information criterion; 10 counts as very strong
constexpr double kTrackGain = 4.0;
constexpr double kDoubtfulGain = -25.0;  // neither for a step nor against it
constexpr double kLongestDoubt_m = 25.0;
constexpr double kGreatestPlaceSigma_m = 1.0;
constexpr double kCourseChange_pm = 0.06;  // along a riser, 1 sigma: it bends gently
constexpr double kBendChange_pm = 0.008;
constexpr double kSteeperThanTreads = 3.0;
constexpr double kGroundDetail_m = 0.05;   // that no model of treads holds
constexpr double kMostSteps = 1.5;         // from place to place, that a line is prolonged by
constexpr double kCourseSigma = 0.05;      // of a riser's end, beyond its last window
constexpr double kShareOfLeastStep = 0.8;  // where a riser is followed: it may be lower here and there

std::optional<RiserPlace> placeAt(const RiserSearch& search, const StepFrame& frame, const StepShape& start,
                                  const StepSearch& about, double least_gain) {
    const StepWindow window = windowAt(search.cells, frame, search.scale);
    if (window.points.size() < kLeastInWindow) return std::nullopt;
    const auto [robust, fit] = searchStep(window, start, about);
    if (!determined(robust)) return std::nullopt;
    RiserPlace place;
    place.gain = gainOf(robust, fit);
    if (!(place.gain >= least_gain) || !supported(robust, fit.shape)) return std::nullopt;
    const StepWindow nearby = middleOf(robust);
    if (nearby.points.size() < kLeastNearby) return std::nullopt;
    const auto [seen, expected] = placeStep(nearby, fit, sigmaAbout_m(robust, fit), about);
    const StepFit settled = fitStep(robust, expected.mean);
    const double tread_slope = std::max(std::abs(settled.lower_slope), std::abs(settled.upper_slope));
    const double face_slope = settled.step_m / expected.mean.width_m;
    const bool clear = place.gain >= kTrackGain && expected.mean.width_m <= about.greatest_width_m &&
                       face_slope >= search.options.least_slope &&
                       face_slope >= kSteeperThanTreads * tread_slope;
    place.doubtful = !clear || seen.sigma_m > 0.3;
    place.frame = {frame.toMap(0.0, expected.mean.place_m),
                   frame.course_rad + std::atan(expected.mean.course)};
    place.bend_pm = expected.mean.bend_pm;
    place.width_m = expected.mean.width_m;
    place.height_m = settled.middle_m + robust.mean_height_m;
    place.step_m = settled.step_m;
    place.location_sigma_m = expected.sigma_m;
    place.seen_m = frame.toMap(0.0, seen.mean.place_m);
    place.seen_sigma_m = seen.sigma_m;
    return place;
}

struct PlaneAbout {
    Vector2d gradient;
    double off_m;  // root mean square
};

std::optional<PlaneAbout> planeAbout(const PlanCells& cells, const Vector2d& at_m, double radius_m) {
    Eigen::Matrix3d normal = 1e-9 * Eigen::Matrix3d::Identity();
    Vector3d right = Vector3d::Zero();
    double count = 0.0, first_m = 0.0, squares_m2 = 0.0;
    cells.within(at_m, radius_m, [&](const Vector3d& point) {
        if (count == 0.0) first_m = point.z();
        const double z = point.z() - first_m;
        const Vector3d row(1.0, point.x() - at_m.x(), point.y() - at_m.y());
        normal += row * row.transpose();
        right += z * row;
        squares_m2 += z * z;
        count += 1.0;
    });
    if (count < 8.0) return std::nullopt;
    const Vector3d x = normal.ldlt().solve(right);
    return PlaneAbout{x.tail<2>(), std::sqrt(std::max(0.0, squares_m2 - x.dot(right)) / count)};
}

struct RoughStep {
    StepFrame frame;
    StepShape shape;
    double gain = -std::numeric_limits<double>::infinity();
};

/// The best of some directions about the contour's, straight as yet.
RoughStep roughStepAt(const RiserSearch& search, const Vector2d& at_m, double along_contour_rad) {
    constexpr int kCoursesAside = 2, kPlacesAside = 2;
    constexpr double kBetweenCourses_rad = 0.5;
    constexpr std::array<double, 2> kWidths_m{0.4, 1.0};
    StepScale shorter = search.scale;
    shorter.along_m *= 0.8;
    RoughStep best;
    for (int c = -kCoursesAside; c <= kCoursesAside; ++c) {
        const StepFrame frame{at_m, along_contour_rad + kBetweenCourses_rad * c};
        const StepWindow window = windowAt(search.cells, frame, shorter);
        if (window.points.size() < kLeastInWindow) continue;
        const double smooth_m2 = smoothSquares_m2(window), weight = totalWeight(window);
        for (int i = -kPlacesAside; i <= kPlacesAside; ++i) {
            for (const double width_m : kWidths_m) {
                const StepFit fit = fitStep(window, {0.25 * shorter.reach_m * i, 0.0, 0.0, width_m});
                if (fit.step_m < 0.6 * search.options.least_step_m) continue;
                const double gain = roughGain(smooth_m2, fit, weight);
                if (gain > best.gain) best = {frame, fit.shape, gain};
            }
        }
    }
    return best;
}

/// Where the riser goes on, and what to expect there.
/// @param way  +1 ahead, -1 back
std::optional<RiserPlace> nextPlace(const RiserSearch& search, const RiserPlace& at, int way) {
    const double u = way * search.spacing_m;
    const StepFrame next{at.frame.toMap(u, at.bend_pm * u * u),
                         at.frame.course_rad + std::atan(2.0 * at.bend_pm * u)};
    StepSearch about;
    about.place_m = 0.25 * search.scale.reach_m;
    about.course = 0.16;
    about.bend_pm = 0.012;
    about.greatest_width_m = search.options.greatest_width_m;
    about.from_before = true;
    about.place_sigma_m = std::hypot(at.location_sigma_m, 0.1 * search.spacing_m);
    about.course_sigma = kCourseChange_pm * search.spacing_m;
    about.bend_sigma_pm = kBendChange_pm;
    about.bend_before_pm = 0.95 * at.bend_pm;
    auto place = placeAt(search, next, {0.0, 0.0, about.bend_before_pm, at.width_m}, about, kDoubtfulGain);
    if (!place || place->step_m < kShareOfLeastStep * search.options.least_step_m) return std::nullopt;
    if (place->location_sigma_m > kGreatestPlaceSigma_m) return std::nullopt;
    const double on_m = (place->frame.origin_m - at.frame.origin_m).dot(next.ahead()) * way;
    if (on_m < 0.3 * search.spacing_m) return std::nullopt;
    return place;
}

/// From a place on, one way.
std::vector<RiserPlace> follow(const RiserSearch& search, RiserPlace at, int way, const RiserPlaces& covered,
                               const std::stop_token& stop) {
    constexpr std::size_t kMostPlaces = 100'000;
    std::vector<RiserPlace> found;
    std::size_t sure = 0;
    const Vector2d start_m = at.frame.origin_m;
    bool away = false;
    while (found.size() < kMostPlaces && !stop.stop_requested()) {
        const auto place = nextPlace(search, at, way);
        if (!place) break;
        if (const auto other = covered.nearest(place->frame.origin_m, 0.5 * search.scale.reach_m)) {
            // The same riser, seen from its other end: the gap between them is closed.
            const Vector2d ahead = place->frame.ahead();
            const bool same = other->frame.ahead().dot(ahead) > 0.8;
            const bool farther = (other->frame.origin_m - at.frame.origin_m).dot(ahead) * way > 0.0;
            if (same && farther) {
                found.push_back(*other);
                sure = found.size();
            }
            break;
        }
        const double from_start_m = (place->frame.origin_m - start_m).norm();
        away = away || from_start_m > 2.0 * search.scale.reach_m;
        if (away && from_start_m < search.spacing_m) break;  // once around
        found.push_back(*place);
        if (!place->doubtful) sure = found.size();
        if (static_cast<double>(found.size() - sure) * search.spacing_m > kLongestDoubt_m) break;
        at = *place;
    }
    found.resize(sure);  // a riser does not end in a guess
    return found;
}

/// The smoothest line that what each window saw agrees with: a Kalman filter and Rauch-Tung-Striebel pass
/// over place and change per step, the same for both coordinates.
void smoothLine(std::vector<RiserPlace>& line, double step_m) {
    constexpr double kBendSigma_pm = 0.04;
    using State = Eigen::Matrix2d;  // a column for each coordinate
    Eigen::Matrix2d F;
    F << 1.0, 1.0, 0.0, 1.0;
    const double q = std::pow(kBendSigma_pm * step_m * step_m, 2);
    Eigen::Matrix2d Q;
    Q << 0.25 * q, 0.5 * q, 0.5 * q, q;
    const std::size_t n = line.size();
    std::vector<State> x(n), predicted(n);
    std::vector<Eigen::Matrix2d> P(n), P_predicted(n);
    for (std::size_t i = 0; i < n; ++i) {
        if (i == 0) {
            predicted[i].row(0) = line[0].seen_m.transpose();
            predicted[i].row(1) = step_m * line[0].frame.ahead().transpose();
            P_predicted[i] = Eigen::Vector2d(25.0, 0.1 * step_m * step_m).asDiagonal();
        } else {
            predicted[i] = F * x[i - 1];
            P_predicted[i] = F * P[i - 1] * F.transpose() + Q;
        }
        // Windows overlap: neighbours saw much the same points.
        const double r = 4.0 * line[i].seen_sigma_m * line[i].seen_sigma_m;
        const Eigen::Vector2d gain = P_predicted[i].col(0) / (P_predicted[i](0, 0) + r);
        x[i] = predicted[i] + gain * (line[i].seen_m.transpose() - predicted[i].row(0));
        P[i] = P_predicted[i] - gain * P_predicted[i].row(0);
    }
    for (std::size_t i = n - 1; i-- > 0;) {
        const Eigen::Matrix2d G = P[i] * F.transpose() * P_predicted[i + 1].inverse();
        x[i] += G * (x[i + 1] - predicted[i + 1]);
        P[i] += G * (P[i + 1] - P_predicted[i + 1]) * G.transpose();
    }
    for (std::size_t i = 0; i < n; ++i) {
        line[i].frame.origin_m = x[i].row(0).transpose();
        line[i].frame.course_rad = std::atan2(x[i](1, 1), x[i](1, 0));
        line[i].location_sigma_m = std::sqrt(std::max(0.0, P[i](0, 0)));
        const Vector2d turn = (x[std::min(i + 1, n - 1)].row(1) - x[i > 0 ? i - 1 : 0].row(1)).transpose();
        const Vector2d ahead = line[i].frame.ahead();
        line[i].bend_pm = 0.25 * (ahead.x() * turn.y() - ahead.y() * turn.x()) / (step_m * step_m);
    }
}

double offLimit_m(const StepWindow& window) {
    return kGroundDetail_m + 1.5 * window.scale.noise_m;
}

/// Whether the points right beside the middle of the window bear the model out, on both sides of the face.
bool agreesNearby(const StepWindow& window, const StepFit& fit) {
    const double limit_m = offLimit_m(window);
    std::array<std::vector<double>, 2> offs;
    for (const WindowPoint& p : middleOf(window).points) {
        offs[p.v > 0.0 ? 1 : 0].push_back(std::abs(p.z - fit.height_m(p)));
    }
    return std::all_of(offs.begin(), offs.end(), [&](const std::vector<double>& side) {
        return side.size() >= 3 && median(side) <= limit_m;
    });
}

/// Whether the last points before the end of the ground side with the step, on both sides of the face.
bool agreesAtEnd(const StepWindow& window, const StepFit& fit) {
    constexpr std::size_t kLast = 3;
    const double limit_m = std::min(offLimit_m(window), 0.35 * fit.step_m);
    std::array<std::vector<std::pair<double, double>>, 2> offs;  // distance from the end, off the fit
    for (const WindowPoint& p : window.points) {
        offs[p.v > 0.0 ? 1 : 0].emplace_back(std::abs(p.u), std::abs(p.z - fit.height_m(p)));
    }
    return std::all_of(offs.begin(), offs.end(), [&](auto& side) {
        if (side.size() < kLast) return false;
        std::sort(side.begin(), side.end());
        std::vector<double> last;
        for (std::size_t i = 0; i < kLast; ++i) last.push_back(side[i].second);
        return median(last) <= limit_m;
    });
}

/// Whether the ground goes on beyond a place.
enum class EndOfGround { Beyond, Here };

/// Heights from the points about a place whose line and width are known.
void settle(const RiserSearch& search, RiserPlace& place, EndOfGround end) {
    place.holds = false;
    const StepWindow window = windowAt(search.cells, place.frame, search.scale);
    if (window.points.size() < kLeastInWindow) return;
    const StepShape shape{0.0, 0.0, place.bend_pm, place.width_m};
    const StepWindow robust = robustWindow(window, fitStep(window, shape));
    const StepFit fit = fitStep(robust, shape);
    place.height_m = fit.middle_m + window.mean_height_m;
    place.step_m = fit.step_m;
    place.gain = gainOf(robust, fit);
    const bool enough = end == EndOfGround::Here ? onBothSides(robust, shape) && agreesAtEnd(window, fit)
                                                 : supported(robust, shape);
    place.holds = fit.step_m >= kShareOfLeastStep * search.options.least_step_m &&
                  place.gain >= kDoubtfulGain && enough && agreesNearby(window, fit);
}

/// Widths from where the place is sure, then heights about the smoothed line.
void settleLine(const RiserSearch& search, std::vector<RiserPlace>& line) {
    std::vector<double> widths;
    for (const RiserPlace& place : line) {
        if (!place.doubtful) widths.push_back(place.width_m);
    }
    const double common_m = median(widths);
    for (RiserPlace& place : line) {
        if (place.doubtful) place.width_m = common_m;
        settle(search, place, EndOfGround::Beyond);
    }
}

/// Where the riser of a place leaves the ground.
/// @param way  +1 ahead, -1 back
std::optional<RiserPlace> lastOnGround(const RiserSearch& search, const RiserPlace& from, int way,
                                       const OnGround& on_ground) {
    constexpr int kLooks = 64;
    const double farthest_m = kMostSteps * search.spacing_m;
    const auto at = [&](int look) {
        const double u = way * farthest_m * look / kLooks;
        RiserPlace place = from;
        place.frame = {from.frame.toMap(u, from.bend_pm * u * u),
                       from.frame.course_rad + std::atan(2.0 * from.bend_pm * u)};
        place.location_sigma_m = std::hypot(from.location_sigma_m, kCourseSigma * u);
        return place;
    };
    const auto isOn = [&](const RiserPlace& place) {
        const auto [toe_m, top_m] = faceOf(place);
        return on_ground(toe_m) && on_ground(top_m);
    };
    for (int look = 1; look <= kLooks; ++look) {
        if (!isOn(at(look))) return look > 1 ? std::optional(at(look - 1)) : std::nullopt;
    }
    return std::nullopt;
}

}  // namespace

std::pair<Vector2d, Vector2d> faceOf(const RiserPlace& place) {
    // An unsure place smears the expected height: as wide as a face of the same second moment.
    constexpr double kLeastWidth_m = 0.1;
    const double sigma_m = place.location_sigma_m;
    const double width_m =
        std::max(kLeastWidth_m, std::sqrt(place.width_m * place.width_m + 12.0 * sigma_m * sigma_m));
    return {place.frame.toMap(0.0, -0.5 * width_m), place.frame.toMap(0.0, 0.5 * width_m)};
}

std::optional<RiserPlace> clearStepAt(const RiserSearch& search, const Vector2d& at_m) {
    const auto plane = planeAbout(search.cells, at_m, search.scale.reach_m);
    // Half the points a step up leave a plane by a quarter of the step, root mean square.
    if (!plane || plane->off_m < 0.15 * search.options.least_step_m) return std::nullopt;
    RoughStep rough = roughStepAt(search, at_m, std::atan2(-plane->gradient.x(), plane->gradient.y()));
    if (!(rough.gain > 0.25 * kSeedGain)) return std::nullopt;
    StepSearch about;
    about.place_m = 0.3 * search.scale.reach_m;
    about.course = 0.3;
    about.bend_pm = 0.03;
    about.greatest_width_m = search.options.greatest_width_m;
    rough.frame.origin_m = rough.frame.toMap(0.0, rough.shape.place_m);
    rough.shape.place_m = 0.0;
    const auto place = placeAt(search, rough.frame, rough.shape, about, kSeedGain);
    if (!place || place->doubtful || place->step_m < search.options.least_step_m) return std::nullopt;
    return place;
}

RiserPlaces::Cell RiserPlaces::cellOf(const Vector2d& at_m) const {
    return {std::floor(at_m.y() / cell_m_), std::floor(at_m.x() / cell_m_)};
}

void RiserPlaces::add(const RiserPlace& place) {
    places_[cellOf(place.frame.origin_m)].push_back(place);
}

std::optional<RiserPlace> RiserPlaces::nearest(const Vector2d& to_m, double radius_m) const {
    const auto [row, column] = cellOf(to_m);
    std::optional<RiserPlace> found;
    for (double r = row - 1.0; r <= row + 1.0; r += 1.0) {
        for (double c = column - 1.0; c <= column + 1.0; c += 1.0) {
            const auto cell = places_.find({r, c});
            if (cell == places_.end()) continue;
            for (const RiserPlace& place : cell->second) {
                const double distance_m = (place.frame.origin_m - to_m).norm();
                if (distance_m >= radius_m) continue;
                radius_m = distance_m;
                found = place;
            }
        }
    }
    return found;
}

std::vector<RiserPlace> riserThrough(const RiserSearch& search, const RiserPlace& start,
                                     const RiserPlaces& covered, const std::stop_token& stop) {
    std::vector<RiserPlace> line, ahead;
    parallelFor(2, [&](std::size_t way) {
        if (way == 0) {
            line = follow(search, start, -1, covered, stop);
        } else {
            ahead = follow(search, start, 1, covered, stop);
        }
    });
    std::reverse(line.begin(), line.end());
    line.push_back(start);
    line.insert(line.end(), ahead.begin(), ahead.end());
    if (line.size() < 2) return line;
    smoothLine(line, search.spacing_m);
    settleLine(search, line);
    for (RiserPlace& place : line) {
        place.seen_m = place.frame.origin_m;
        place.seen_sigma_m = place.location_sigma_m;
    }
    return line;
}

std::vector<RiserPlace> prolonged(const RiserSearch& search, std::vector<RiserPlace> line,
                                  const OnGround& on_ground) {
    for (const int way : {1, -1}) {
        while (!line.empty() && !line.back().holds) line.pop_back();
        if (line.empty()) return line;
        if (auto end = lastOnGround(search, line.back(), way, on_ground)) {
            settle(search, *end, EndOfGround::Here);
            if (end->holds) line.push_back(*end);
        }
        std::reverse(line.begin(), line.end());
    }
    return line;
}

double evidenceOf(const std::vector<RiserPlace>& line, const RiserSearch& search) {
    double gain = 0.0;
    for (const RiserPlace& place : line) gain += std::max(place.gain, 0.0);
    return gain * search.spacing_m / (1.2 * search.scale.along_m);
}

}  // namespace terrawalk
