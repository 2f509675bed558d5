#include "mapping/step_model.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <optional>

#include "mapping/order_statistics.hpp"

namespace terrawalk {
namespace {

constexpr double kNearShare = 0.35;  // of the reach along
constexpr double kNoiseFloor_m = 0.02;
constexpr double kOutlierSigmas = 2.5;
constexpr double kTreadSlopeSpread = 0.3;
constexpr double kLeastShare = 0.1;  // of the weight, ahead too: no edge runs on beyond the points
constexpr double kGreatestBend_pm = 0.06;
constexpr int kStepParameters = 9;
constexpr int kSmoothParameters = 6;
constexpr std::array<double, 7> kWidths{0.07, 0.17, 0.27, 0.4, 0.57, 0.8, 1.07};  // of the greatest

double tricube(double share) {
    const double s = std::abs(share);
    if (s >= 1.0) return 0.0;
    const double t = 1.0 - s * s * s;
    return t * t * t;
}

bool balanced(double part, double all) {
    return part > kLeastShare * all && part < (1.0 - kLeastShare) * all;
}

void centreHeights(StepWindow& window) {
    double sum = 0.0;
    for (const WindowPoint& p : window.points) sum += p.weight * p.z;
    window.mean_height_m = window.points.empty() ? 0.0 : sum / totalWeight(window);
    for (WindowPoint& p : window.points) p.z -= window.mean_height_m;
}

/// Weighted sums over the points of one part of the ground; s is its own coordinate across.
struct Sums {
    double w = 0.0, u = 0.0, uu = 0.0, z = 0.0, uz = 0.0, zz = 0.0;
    double s = 0.0, ss = 0.0, us = 0.0, zs = 0.0;

    void add(const WindowPoint& p, double across) {
        const double ww = p.weight, wu = ww * p.u, wz = ww * p.z;
        w += ww;
        u += wu;
        uu += wu * p.u;
        z += wz;
        uz += wz * p.u;
        zz += wz * p.z;
        s += ww * across;
        ss += ww * across * across;
        us += wu * across;
        zs += wz * across;
    }
};

/// What an unlikely shape adds to the sum of squares.
double penalty_m2(const StepSearch& search, double noise_m, const StepShape& shape) {
    if (!search.from_before) return 0.0;
    const Eigen::Vector3d off(shape.place_m / search.place_sigma_m, shape.course / search.course_sigma,
                              (shape.bend_pm - search.bend_before_pm) / search.bend_sigma_pm);
    return noise_m * noise_m * off.squaredNorm();
}

/// Keeps the better one; ties go to the first.
void tryShape(const StepWindow& window, const StepShape& shape, const StepSearch& search, StepFit& best) {
    const StepFit other = fitStep(window, shape);
    if (other.step_m <= 0.0) return;
    const double noise_m = window.scale.noise_m;
    if (other.squares_m2 + penalty_m2(search, noise_m, other.shape) <
        best.squares_m2 + penalty_m2(search, noise_m, best.shape)) {
        best = other;
    }
}

StepFit searchPlace(const StepWindow& window, const StepFit& from, const StepSearch& search, double share) {
    constexpr int kPlaces = 4, kCourses = 2;
    StepFit best = from;
    for (int i = -kPlaces; i <= kPlaces; ++i) {
        for (int j = -kCourses; j <= kCourses; ++j) {
            StepShape shape = from.shape;
            shape.place_m += share * search.place_m * i / kPlaces;
            shape.course += share * search.course * j / kCourses;
            tryShape(window, shape, search, best);
        }
    }
    return best;
}

StepFit searchWidth(const StepWindow& window, const StepFit& from, const StepSearch& search) {
    constexpr int kBends = 2;
    StepFit best = from;
    for (const double width : kWidths) {
        for (int i = -kBends; i <= kBends; ++i) {
            StepShape shape = best.shape;
            shape.width_m = width * search.greatest_width_m;
            shape.bend_pm = std::clamp(from.shape.bend_pm + search.bend_pm * i / kBends, -kGreatestBend_pm,
                                       kGreatestBend_pm);
            tryShape(window, shape, search, best);
        }
    }
    return best;
}

struct Trial {
    double place_m, width_m, squares_m2;
};

constexpr int kTrialPlaces = 8;  // to either side

/// Rising steps on a grid of places about the fit and of widths.
std::vector<Trial> trialsAbout(const StepWindow& window, const StepShape& about, double range_m,
                               double greatest_width_m) {
    std::vector<Trial> trials;
    for (const double width : kWidths) {
        for (int i = -kTrialPlaces; i <= kTrialPlaces; ++i) {
            StepShape shape = about;
            shape.place_m += range_m * i / kTrialPlaces;
            shape.width_m = width * greatest_width_m;
            const StepFit fit = fitStep(window, shape);
            if (fit.step_m > 0.0) trials.push_back({shape.place_m, shape.width_m, fit.squares_m2});
        }
    }
    return trials;
}

StepPlace meanOf(const std::vector<Trial>& trials, const StepShape& about, double range_m, double sigma_m,
                 double prior_sigma_m) {
    StepPlace placed{about, range_m};
    if (trials.empty()) return placed;
    const auto exponent = [&](const Trial& trial) {
        const double off = trial.place_m / prior_sigma_m;
        return 0.5 * (trial.squares_m2 / (sigma_m * sigma_m) + off * off);
    };
    double least = std::numeric_limits<double>::infinity();
    for (const Trial& trial : trials) least = std::min(least, exponent(trial));
    double weights = 0.0, place = 0.0, width = 0.0, place2 = 0.0;
    for (const Trial& trial : trials) {
        const double weight = std::exp(least - exponent(trial));
        weights += weight;
        place += weight * trial.place_m;
        place2 += weight * trial.place_m * trial.place_m;
        width += weight * trial.width_m;
    }
    const double spacing_m = range_m / kTrialPlaces;
    placed.mean.place_m = place / weights;
    placed.mean.width_m = width / weights;
    placed.sigma_m = std::sqrt(std::max(0.0, place2 / weights - placed.mean.place_m * placed.mean.place_m) +
                               spacing_m * spacing_m / 12.0);
    return placed;
}

}  // namespace

StepWindow windowAt(const PlanCells& cells, const StepFrame& frame, const StepScale& scale) {
    StepWindow window{{}, scale, 0.0};
    const Eigen::Vector2d ahead = frame.ahead();
    cells.within(frame.origin_m, std::hypot(scale.along_m, scale.reach_m), [&](const Eigen::Vector3d& point) {
        const Eigen::Vector2d d = point.head<2>() - frame.origin_m;
        const double u = d.dot(ahead);
        const double v = ahead.x() * d.y() - ahead.y() * d.x();
        if (std::abs(v) > scale.reach_m) return;
        const double weight = tricube(u / scale.along_m);
        if (weight > 0.0) window.points.push_back({u, v, point.z(), weight});
    });
    centreHeights(window);
    return window;
}

StepWindow middleOf(const StepWindow& window) {
    StepWindow middle{{}, window.scale, window.mean_height_m};
    for (const WindowPoint& p : window.points) {
        if (std::abs(p.u) <= kNearShare * window.scale.along_m) middle.points.push_back(p);
    }
    return middle;
}

double totalWeight(const StepWindow& window) {
    double weights = 0.0;
    for (const WindowPoint& p : window.points) weights += p.weight;
    return weights;
}

double StepFit::height_m(const WindowPoint& p) const {
    const double t = shape.offset_m(p);
    const double half_m = 0.5 * shape.width_m;
    return middle_m + along_slope * p.u + lower_slope * std::min(t + half_m, 0.0) +
           upper_slope * std::max(t - half_m, 0.0) + step_m * std::clamp(t / shape.width_m, -0.5, 0.5);
}

StepFit fitStep(const StepWindow& window, const StepShape& shape) {
    // Columns: 1, u, lower tread, upper tread, face. On a tread the face's column is one half and the other
    // tread's zero, so that each point counts in one part only.
    const double half_m = 0.5 * shape.width_m;
    Sums lower, upper, face;
    for (const WindowPoint& p : window.points) {
        const double t = shape.offset_m(p);
        if (t < -half_m) {
            lower.add(p, t + half_m);
        } else if (t > half_m) {
            upper.add(p, t - half_m);
        } else {
            face.add(p, t / shape.width_m);
        }
    }
    const auto all = [&](double Sums::*sum) {
        return lower.*sum + face.*sum + upper.*sum;
    };
    const double prior =
        window.scale.noise_m * window.scale.noise_m / (kTreadSlopeSpread * kTreadSlopeSpread);
    Eigen::Matrix<double, 5, 5> normal = Eigen::Matrix<double, 5, 5>::Zero();
    normal(0, 0) = all(&Sums::w) + 1e-12;
    normal(1, 0) = all(&Sums::u);
    normal(1, 1) = all(&Sums::uu) + prior;
    normal(2, 0) = lower.s;
    normal(2, 1) = lower.us;
    normal(2, 2) = lower.ss + prior;
    normal(3, 0) = upper.s;
    normal(3, 1) = upper.us;
    normal(3, 3) = upper.ss + prior;
    normal(4, 0) = 0.5 * (upper.w - lower.w) + face.s;
    normal(4, 1) = 0.5 * (upper.u - lower.u) + face.us;
    normal(4, 2) = -0.5 * lower.s;
    normal(4, 3) = 0.5 * upper.s;
    normal(4, 4) = 0.25 * (upper.w + lower.w) + face.ss + 1e-9;
    Eigen::Matrix<double, 5, 1> right;
    right << all(&Sums::z), all(&Sums::uz), lower.zs, upper.zs, 0.5 * (upper.z - lower.z) + face.zs;
    const Eigen::Matrix<double, 5, 1> x = normal.selfadjointView<Eigen::Lower>().llt().solve(right);
    return {shape, x[0], x[1], x[2], x[3], x[4], std::max(0.0, all(&Sums::zz) - x.dot(right))};
}

StepWindow robustWindow(const StepWindow& window, const StepFit& fit) {
    std::vector<double> offs;
    for (const WindowPoint& p : window.points) offs.push_back(std::abs(p.z - fit.height_m(p)));
    const double limit_m = kOutlierSigmas * std::max(kNoiseFloor_m, 1.4826 * median(offs));
    StepWindow robust = window;
    for (std::size_t i = 0; i < offs.size(); ++i) {
        if (offs[i] > limit_m) robust.points[i].weight *= limit_m / offs[i];
    }
    return robust;
}

FoundStep searchStep(const StepWindow& window, const StepShape& start, const StepSearch& search) {
    StepFit fit = fitStep(window, start);
    fit = searchPlace(window, fit, search, 1.0);
    fit = searchWidth(window, fit, search);
    FoundStep found{robustWindow(window, fit), {}};
    fit = fitStep(found.window, fit.shape);
    fit = searchPlace(found.window, fit, search, 0.5);
    fit = searchWidth(found.window, fit, search);
    found.fit = searchPlace(found.window, fit, search, 0.2);
    return found;
}

double smoothSquares_m2(const StepWindow& window) {
    using Vector6d = Eigen::Matrix<double, kSmoothParameters, 1>;
    Eigen::Matrix<double, kSmoothParameters, kSmoothParameters> normal;
    normal.setIdentity();
    normal *= 1e-9;
    Vector6d right = Vector6d::Zero();
    double squares = 0.0;
    for (const WindowPoint& p : window.points) {
        Vector6d row;
        row << 1.0, p.u, p.v, p.u * p.u, p.u * p.v, p.v * p.v;
        normal += p.weight * row * row.transpose();
        right += p.weight * p.z * row;
        squares += p.weight * p.z * p.z;
    }
    const Vector6d x = normal.ldlt().solve(right);
    return std::max(0.0, squares - x.dot(right));
}

double roughGain(double smooth_squares_m2, const StepFit& fit, double total_weight) {
    const double floor_m2 = total_weight * kNoiseFloor_m * kNoiseFloor_m;
    return total_weight * std::log((smooth_squares_m2 + floor_m2) / (fit.squares_m2 + floor_m2));
}

double gainOf(const StepWindow& window, const StepFit& fit) {
    const double n = totalWeight(window);
    return roughGain(smoothSquares_m2(window), fit, n) - (kStepParameters - kSmoothParameters) * std::log(n);
}

bool onBothSides(const StepWindow& window, const StepShape& shape) {
    constexpr int kLeastOnSide = 5;
    double left = 0.0;
    int count_left = 0, count_right = 0;
    for (const WindowPoint& p : window.points) {
        const bool on_left = shape.offset_m(p) > 0.0;
        if (on_left) left += p.weight;
        if (std::abs(p.u) < 0.7 * window.scale.along_m) ++(on_left ? count_left : count_right);
    }
    return count_left >= kLeastOnSide && count_right >= kLeastOnSide && balanced(left, totalWeight(window));
}

bool supported(const StepWindow& window, const StepShape& shape) {
    double ahead = 0.0;
    for (const WindowPoint& p : window.points) {
        if (p.u > 0.0) ahead += p.weight;
    }
    return onBothSides(window, shape) && balanced(ahead, totalWeight(window));
}

bool determined(const StepWindow& window) {
    return totalWeight(window) > kStepParameters + 1.0;
}

double sigmaAbout_m(const StepWindow& window, const StepFit& fit) {
    const double n = totalWeight(window);
    return std::sqrt((fit.squares_m2 + n * kNoiseFloor_m * kNoiseFloor_m) / (n - kStepParameters));
}

StepPlaces placeStep(const StepWindow& window, const StepFit& fit, double sigma_m, const StepSearch& search) {
    // Coarse over the whole window first, then as fine as the place is sure.
    const double range_m = 0.6 * window.scale.reach_m;
    const std::vector<Trial> coarse = trialsAbout(window, fit.shape, range_m, search.greatest_width_m);
    const auto place = [&](double prior_sigma_m) {
        const StepPlace first = meanOf(coarse, fit.shape, range_m, sigma_m, prior_sigma_m);
        if (first.sigma_m > 0.3 * range_m) return first;
        const double fine_m = 3.0 * first.sigma_m;
        return meanOf(trialsAbout(window, first.mean, fine_m, search.greatest_width_m), first.mean, fine_m,
                      sigma_m, prior_sigma_m);
    };
    StepPlaces places;
    places.seen = place(std::numeric_limits<double>::infinity());
    places.expected = search.from_before ? place(search.place_sigma_m) : places.seen;
    return places;
}

}  // namespace terrawalk
