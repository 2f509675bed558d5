#include "fusion/crossover_rows.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "fusion/adjustment_groups.hpp"
#include "fusion/random_numbers.hpp"
#include "fusion/squared.hpp"

namespace terrawalk {

namespace {

// Of m passes over the same ground only so many differences are independent as there are passes, while
// pairs grow with their square: where more than this meet, they share their weight.
constexpr double kPairsOfAKnot = 3.0;

}  // namespace

std::vector<GroundSample> CrossoverRows::groundSamples() const {
    std::vector<GroundSample> samples;
    for (std::size_t r = 0; r < runs_.size(); ++r) {
        const RunModel& run = runs_[r];
        for (std::size_t i = 0; i < run.size(); ++i) {
            if (!present(run.above_ground_m[i])) continue;
            Attitude attitude = run.start->attitudes[i].attitude;
            attitude.yaw_rad = trueYaw(run, array_iron_, i);
            const Eigen::Vector3d ray =
                run.log->range_lever_arm_m - run.log->value(Channel::Range, i) * Eigen::Vector3d::UnitZ();
            samples.push_back({static_cast<std::uint32_t>(r), static_cast<std::uint32_t>(i), run.time(i),
                               run.track_m[i] + rotationEnuFromBody(attitude) * ray});
        }
    }
    return samples;
}

void CrossoverRows::find() {
    const std::vector<GroundSample> samples = groundSamples();
    pairs_ = findCrossovers(samples, options_.joint.crossovers);
    const auto kept = std::stable_partition(pairs_.begin(), pairs_.end(),
                                            [&](const Crossover& c) { return !isLeftOut(c); });
    left_out_.assign(kept, pairs_.end());
    pairs_.erase(kept, pairs_.end());
    mark_passes_.clear();
    for (const ControlMark& mark : survey_.marks) {
        if (mark.role != MarkRole::Control || onlyShowsErrors(mark)) continue;
        for (const MarkPass& pass : findMarkPasses(samples, mark.enu_m, options_.joint.crossovers)) {
            mark_passes_.push_back(pass);
        }
    }
}

// The target of a fixed-point run that the options keep from the estimator.
bool CrossoverRows::onlyShowsErrors(const ControlMark& mark) const {
    if (options_.stands.tie_fixed_targets) return false;
    return std::any_of(survey_.runs.begin(), survey_.runs.end(), [&](const Run& run) {
        return run.kind == RunKind::FixedPoint && run.target == mark.name;
    });
}

// Whole cells of the ground, as neighbouring pairs share their points.
bool CrossoverRows::isLeftOut(const Crossover& pair) const {
    constexpr double kCell_m = 10.0;
    const auto cell = [](double metres) {
        return static_cast<std::uint64_t>(static_cast<std::int64_t>(std::floor(metres / kCell_m)));
    };
    const double draw = unitInterval(scramble({cell(pair.place_m.x()), cell(pair.place_m.y())}));
    return draw < options_.joint.left_out_crossovers;
}

// Planes fit where the ground is even; where it is not, they fit the worse the farther apart the passes
// are, or may be.
double CrossoverRows::pairSigma(const Eigen::Vector2d& slope, double roughness_m, double apart_m2) const {
    const JointOptions& o = options_.joint;
    const double uneven = slope.norm() / (slope.norm() + o.pair_even_slope);
    const double sigma =
        o.pair_sigma_m + uneven * (o.pair_uneven_m + o.pair_apart_per_m * std::min(apart_m2, 4.0));
    return std::sqrt((squared(sigma) + squared(0.5 * roughness_m) + slope.squaredNorm() * apart_m2) /
                     o.pair_weight);
}

double CrossoverRows::planVariance(std::size_t run, std::size_t epoch) const {
    const RunModel& r = runs_[run];
    return r.plan_variance_m2.empty() ? 1.0 : r.plan_variance_m2[r.at[epoch].knot];
}

void CrossoverRows::ground(const RunModel& run, std::size_t epoch, const Eigen::Vector2d& slope,
                           double sign) {
    const KnotChain::Place& at = run.at[epoch];
    run.correction.addTo(row_, at, sign, 2);
    // Half of what a slope tells of the plan: the ground is a plane only near by.
    const double share = options_.joint.pair_plan_share;
    run.correction.addTo(row_, at, -sign * share * slope.x(), 0);
    run.correction.addTo(row_, at, -sign * share * slope.y(), 1);
}

std::vector<double> CrossoverRows::pairCrowding() const {
    std::vector<std::vector<double>> pairs_of_knot;
    for (const RunModel& run : runs_) pairs_of_knot.emplace_back(run.correction.knots(), 0.0);
    const auto count = [&](std::uint32_t run, std::uint32_t epoch) -> double& {
        return pairs_of_knot[run][runs_[run].at[epoch].knot];
    };
    for (const Crossover& pair : pairs_) {
        count(pair.run_a, pair.epoch_a) += 1.0;
        count(pair.run_b, pair.epoch_b) += 1.0;
    }
    std::vector<double> crowding;
    for (const Crossover& pair : pairs_) {
        const double pairs = 0.5 * (count(pair.run_a, pair.epoch_a) + count(pair.run_b, pair.epoch_b));
        crowding.push_back(std::max(1.0, pairs / kPairsOfAKnot));
    }
    return crowding;
}

void CrossoverRows::addTo(SparseLeastSquares& system) {
    const std::vector<double> crowding = pairCrowding();
    for (std::size_t p = 0; p < pairs_.size(); ++p) {
        const Crossover& pair = pairs_[p];
        row_.clear();
        ground(runs_[pair.run_a], pair.epoch_a, pair.slope, 1.0);
        ground(runs_[pair.run_b], pair.epoch_b, pair.slope, -1.0);
        system.addRow(kPair, row_.all(), -pair.misfit_m,
                      pairSigma(pair.slope, pair.roughness_m,
                                squared(pair.apart_m) + planVariance(pair.run_a, pair.epoch_a) +
                                    planVariance(pair.run_b, pair.epoch_b)) *
                          std::sqrt(crowding[p]));
    }
    for (const MarkPass& pass : mark_passes_) {
        row_.clear();
        ground(runs_[pass.run], pass.epoch, pass.slope, 1.0);
        // A single pass does not tell the slope across its way.
        const double aside = squared(0.2 * pass.apart_m);
        system.addRow(kMarkPass, row_.all(), -pass.misfit_m,
                      std::hypot(pairSigma(pass.slope, pass.roughness_m,
                                           squared(pass.apart_m) + planVariance(pass.run, pass.epoch)),
                                 std::sqrt(aside)));
    }
}

// Before the crossovers are used they test the track: misfits over what its covariance predicts. Passes
// close in time share their errors, so they do not count.
SigmaCoverage CrossoverRows::testHeights(SparseLeastSquares& system) const {
    constexpr double kApart_s = 120.0;
    constexpr double kOutlier = 5.0;

    SigmaCoverage test;
    const auto heightVariance = [&](std::uint32_t run, std::uint32_t epoch) {
        const std::size_t u = runs_[run].correction.unknown(runs_[run].at[epoch].knot, 2);
        return system.covariance(u, u);
    };
    for (const Crossover& pair : pairs_) {
        const double apart_s =
            std::abs(runs_[pair.run_a].time(pair.epoch_a) - runs_[pair.run_b].time(pair.epoch_b));
        if (pair.run_a == pair.run_b && apart_s < kApart_s) continue;
        const double plan = planVariance(pair.run_a, pair.epoch_a) + planVariance(pair.run_b, pair.epoch_b);
        const double own = squared(pairSigma(pair.slope, pair.roughness_m, squared(pair.apart_m) + plan)) *
                           options_.joint.pair_weight;
        const double sigma = std::sqrt(heightVariance(pair.run_a, pair.epoch_a) +
                                       heightVariance(pair.run_b, pair.epoch_b) + own);
        test.add(std::clamp(pair.misfit_m, -kOutlier * sigma, kOutlier * sigma), sigma);
    }
    return test;
}

double rootMeanSquareMisfit(const std::vector<Crossover>& pairs) {
    double sum = 0.0;
    for (const Crossover& pair : pairs) sum += squared(pair.misfit_m);
    return pairs.empty() ? 0.0 : std::sqrt(sum / static_cast<double>(pairs.size()));
}

}  // namespace terrawalk
