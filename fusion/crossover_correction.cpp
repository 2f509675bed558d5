#include "fusion/crossover_correction.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "fusion/adjustment_groups.hpp"
#include "fusion/crossover_rows.hpp"
#include "fusion/run_model.hpp"
#include "fusion/sensor_readings.hpp"
#include "fusion/sensor_rows.hpp"
#include "fusion/sparse_least_squares.hpp"

namespace terrawalk {

namespace {

// Sigmas of pairs, round by round: misfits are large before the tracks are bent, and no outliers for that.
constexpr std::array kPairScales{5.0, 3.0, 2.0, 1.5, 1.0};
constexpr double kKnot_s = 3.0;
constexpr double kWander_m = 0.03;     // of a correction in a second, in plan
constexpr double kWanderUp_m = 0.025;  // and in height
// As long the filter's errors go together.
constexpr double kMemory_s = 600.0;
constexpr double kMemoryFixed_s = 30.0;

class CrossoverCorrector {
  public:
    CrossoverCorrector(const Survey& survey, std::span<const RunStart> starts, const FusionOptions& options,
                       const std::stop_token& stop)
        : options_(options), stop_(stop), crossovers_(survey, options_, runs_, shared_.iron) {
        options_.joint.knot_s = kKnot_s;
        options_.accelerometer.use = false;  // has no part here
        const LocalFrame frame = survey.frame();
        for (const RunStart& start : starts) runs_.push_back(makeRunModel(start, frame, options_));
        for (RunModel& run : runs_) {
            takeFiltersYaw(run);
            numberTrack(run, unknowns_);
            takeFilterVariances(run);
        }
    }

    std::optional<CrossoverCorrection> correct() {
        CrossoverCorrection result;
        std::vector<RowGroup> groups = adjustmentGroups(true);
        for (std::size_t round = 0; round < kPairScales.size(); ++round) {
            if (stop_.stop_requested()) return std::nullopt;
            crossovers_.find();
            if (round == 0) result.misfit_before_m = rootMeanSquareMisfit(crossovers_.pairs());
            groups[kPair].scale = groups[kMarkPass].scale = kPairScales[round];
            SparseLeastSquares system(unknowns_, groups, stop_);
            SensorRows sensors(options_, shared_, true, system);
            for (RunModel& run : runs_) {
                sensors.addTies(run);
                addHold(run, system);
            }
            crossovers_.addTo(system);
            const auto solution = system.solve();
            if (!solution) return std::nullopt;
            for (RunModel& run : runs_) {
                moveTrack(run, *solution);
                run.correction.take(*solution);
            }
        }
        crossovers_.find();
        result.crossovers = crossovers_.pairs().size();
        result.misfit_after_m = rootMeanSquareMisfit(crossovers_.pairs());
        for (RunModel& run : runs_) result.tracks_m.push_back(std::move(run.track_m));
        return result;
    }

  private:
    static std::size_t epochOfKnot(const RunModel& run, std::size_t knot) {
        const auto& times = run.log->time_s;
        const auto at = std::lower_bound(times.begin(), times.end(), run.correction.time(knot));
        return std::min(static_cast<std::size_t>(at - times.begin()), run.size() - 1);
    }

    // The compass is not corrected any further.
    static void takeFiltersYaw(RunModel& run) {
        run.has_heading = false;
        for (std::size_t i = 0; i < run.size(); ++i) {
            run.yaw_rad[i] = run.start->trajectory.epochs[i].attitude.yaw_rad;
        }
    }

    static void takeFilterVariances(RunModel& run) {
        for (std::size_t k = 0; k < run.correction.knots(); ++k) {
            const auto& P = run.start->trajectory.epochs[epochOfKnot(run, k)].covariance;
            run.plan_variance_m2.push_back(0.5 * (P(0, 0) + P(1, 1)));
        }
    }

    void addHold(const RunModel& run, SparseLeastSquares& system) const {
        for (std::size_t k = 0; k < run.correction.knots(); ++k) {
            const std::size_t epoch = epochOfKnot(run, k);
            const auto& P = run.start->trajectory.epochs[epoch].covariance;
            const bool fixed = !run.gnss.empty() && gnssFixClass(*run.log, epoch) == kFixedClass;
            const double shared = std::sqrt((fixed ? kMemoryFixed_s : kMemory_s) / kKnot_s);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const auto a = static_cast<Eigen::Index>(axis);
                system.addRow(kPrior, {{run.correction.unknown(k, axis), 1.0}},
                              -run.correction.knotValue(k, axis),
                              std::max(std::sqrt(P(a, a)), 0.005) * shared);
                if (k == 0) continue;
                const double dt = run.correction.time(k) - run.correction.time(k - 1);
                system.addRow(
                    kPrior,
                    {{run.correction.unknown(k, axis), 1.0}, {run.correction.unknown(k - 1, axis), -1.0}},
                    run.correction.knotValue(k - 1, axis) - run.correction.knotValue(k, axis),
                    (axis == 2 ? kWanderUp_m : kWander_m) * std::sqrt(dt));
            }
        }
    }

    FusionOptions options_;
    const std::stop_token& stop_;
    std::vector<RunModel> runs_;
    SharedErrors shared_;
    CrossoverRows crossovers_;
    std::size_t unknowns_ = 0;
};

}  // namespace

std::optional<CrossoverCorrection> correctByCrossovers(const Survey& survey, std::span<const RunStart> starts,
                                                       const FusionOptions& options,
                                                       const std::stop_token& stop) {
    return CrossoverCorrector(survey, starts, options, stop).correct();
}

}  // namespace terrawalk
