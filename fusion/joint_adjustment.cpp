#include "fusion/joint_adjustment.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <optional>

#include "fusion/adjustment_groups.hpp"
#include "fusion/crossover_rows.hpp"
#include "fusion/run_model.hpp"
#include "fusion/sensor_rows.hpp"
#include "fusion/sparse_least_squares.hpp"
#include "fusion/squared.hpp"

namespace terrawalk {

namespace {

class JointAdjuster {
  public:
    JointAdjuster(const Survey& survey, std::span<const RunStart> starts, const FusionOptions& options,
                  Progress& progress, std::stop_token stop)
        : survey_(survey), options_(options), progress_(progress), stop_(std::move(stop)) {
        const LocalFrame frame = survey.frame();
        for (const RunStart& start : starts) runs_.push_back(makeRunModel(start, frame, options));
        for (SingleUnknown* one : sharedUnknowns()) one->unknown = unknowns_++;
        for (RunModel& run : runs_) numberUnknowns(run, unknowns_);
    }

    Result<JointSolution> adjust() {
        JointSolution result;
        result.summary.unknowns = unknowns_;
        std::vector<RowGroup> groups = adjustmentGroups(true);
        std::optional<SparseLeastSquares> before;
        const int least = options_.joint.rounds;
        int rounds = 0;  // since the track settled
        for (int round = 0;; ++round) {
            if (stop_.stop_requested()) return cancelled();
            progress_.report(std::min(1.0, (settled_ ? 2.0 + rounds : std::min(round, 1)) / (2.0 + least)),
                             shared_.flow_scale_wanders
                                 ? "adjusting all runs anew: the scale of the optical flow wanders"
                                 : "adjusting all runs");
            const bool robust = round > 0;
            const bool with_pairs = options_.joint.use_crossovers && settled_;
            if (options_.joint.use_crossovers && (round == 0 || with_pairs)) crossovers_.find();
            if (round == 0) {
                result.summary.misfit_before_m = rootMeanSquareMisfit(crossovers_.pairs());
                result.summary.left_out.before_m = rootMeanSquareMisfit(crossovers_.leftOut());
            }
            SparseLeastSquares system(unknowns_, robust ? groups : adjustmentGroups(false), stop_);
            addRows(system, with_pairs);
            if (stop_.stop_requested()) return cancelled();
            wantCovariances(system);
            // With other crossovers another order of elimination is good.
            if (before && !with_pairs) system.continueFrom(*before);
            const auto solution = system.solve();
            if (stop_.stop_requested()) return cancelled();
            if (!solution) {
                return badData("the adjustment of all runs has no solution", survey_.project_file, 0,
                               "use --method ukf, or leave out the run that has no position");
            }
            const double step_m = takeStep(*solution);
            // Crossovers are not to be trusted more for what they themselves said of the plan.
            if (!with_pairs) takeVariances(system);
            if (settled_) ++rounds;
            const bool last = rounds >= 2 * least || (rounds >= least && step_m < kFinalStep_m);
            if (last && flowScaleWanders()) {
                // Anew, and first without crossovers: they were paired by a track that trusted the flow too
                // much.
                shared_.flow_scale_wanders = true;
                settled_ = false;
                round = rounds = 0;
                before.reset();
                continue;
            }
            if (!settled_ && robust && (step_m < kSettledStep_m || round >= kMostToSettle)) {
                settled_ = true;
                if (options_.joint.use_crossovers) {
                    crossovers_.find();
                    result.summary.crossover_test = crossovers_.testHeights(system);
                }
                height_inflation_ = heightInflation(result.summary.crossover_test);
            }
            // Residuals of a track that is still on its way say nothing of the noise.
            if (settled_) {
                const std::vector<GroupStatistics> statistics = system.statistics(*solution);
                if (last) {
                    plan_inflation_ = planInflation(statistics);
                    result.summary.rounds = rounds;
                    result.summary.last_step_m = step_m;
                    result.summary.settled = step_m < kFinalStep_m;
                    for (std::size_t g = 0; g < groups.size(); ++g) {
                        if (statistics[g].rows == 0) continue;
                        result.summary.noise.push_back({groups[g].name, statistics[g].rows,
                                                        statistics[g].redundancy, groups[g].scale,
                                                        statistics[g].down_weighted});
                    }
                    for (const RunModel& run : runs_) result.trajectories.push_back(trajectory(run, system));
                    break;
                }
                if (options_.joint.adapt_noise) system.adaptScales(statistics);
                groups = system.groups();
            }
            before.emplace(std::move(system));
        }
        result.summary.height_inflation = height_inflation_;
        result.summary.plan_inflation = plan_inflation_;
        result.summary.flow_scale_wanders = shared_.flow_scale_wanders;
        if (options_.joint.use_crossovers) {
            crossovers_.find();
            result.summary.misfit_after_m = rootMeanSquareMisfit(crossovers_.pairs());
            result.summary.left_out.after_m = rootMeanSquareMisfit(crossovers_.leftOut());
            result.summary.left_out.n = crossovers_.leftOut().size();
            result.crossovers = crossovers_.pairs();
            result.summary.crossovers = crossovers_.pairs().size();
        }
        return result;
    }

  private:
    // Greatest of the runs' RMS corrections in plan, from where noise factors and crossovers are looked at,
    // and where more rounds gain nothing.
    static constexpr double kSettledStep_m = 0.3;
    static constexpr double kFinalStep_m = 0.1;
    static constexpr int kMostToSettle = 8;
    static constexpr double kPlanDoubt = 0.6;
    static constexpr double kHeightDoubt = 1.8;
    static constexpr double kGreatestHeightMargin = 2.8;
    static constexpr double kGreatestMarginWithoutBarometer = 9.0;  // crossovers alone tell the height there

    std::array<SingleUnknown*, 4> sharedUnknowns() {
        return {&shared_.iron.sin, &shared_.iron.cos, &shared_.gnss_bias[0], &shared_.gnss_bias[1]};
    }

    void addRows(SparseLeastSquares& system, bool with_pairs) {
        SensorRows sensors(options_, shared_, settled_, system);
        sensors.addArray();
        for (RunModel& run : runs_) sensors.addRun(run);
        flow_test_ = sensors.flowTest();
        if (with_pairs) crossovers_.addTo(system);
    }

    // By the last round, when a constant scale has been found.
    bool flowScaleWanders() const {
        return options_.lasting.flow_scale_wander_sigma > 0.0 && !shared_.flow_scale_wanders &&
               flow_test_.goTogether();
    }

    // Returns how far the track moved.
    double takeStep(const Eigen::VectorXd& solution) {
        for (SingleUnknown* one : sharedUnknowns()) {
            one->value += solution[static_cast<Eigen::Index>(one->unknown)];
        }
        double step_m = 0.0;
        for (RunModel& run : runs_) step_m = std::max(step_m, takeSolution(run, solution));
        return step_m;
    }

    void takeVariances(SparseLeastSquares& system) {
        for (RunModel& run : runs_) {
            run.plan_variance_m2.resize(run.correction.knots());
            run.height_variance_m2.resize(run.correction.knots());
            for (std::size_t k = 0; k < run.correction.knots(); ++k) {
                const std::size_t e = run.correction.unknown(k, 0);
                const std::size_t n = run.correction.unknown(k, 1);
                const std::size_t u = run.correction.unknown(k, 2);
                run.height_variance_m2[k] = system.covariance(u, u);
                run.plan_variance_m2[k] = 0.5 * (system.covariance(e, e) + system.covariance(n, n));
            }
        }
    }

    // A few crossovers share a few errors: their test counts beside so many that found the variances right.
    static double heightInflation(const SigmaCoverage& test) {
        constexpr double kBefore = 50.0;
        const auto n = static_cast<double>(test.n);
        return std::clamp((n * test.mean_square + kBefore) / (n + kBefore), 0.25, 2.0);
    }

    // Robust rows give way to jumps of the GNSS position, and the covariance then knows nothing of them; but
    // the track followed some of the way. So the variance of the plan grows as far as the drift of GNSS is
    // larger by its plain mean square than by its robust one.
    static double planInflation(const std::vector<GroupStatistics>& statistics) {
        constexpr double kOfNormalErrors = 0.9;
        constexpr double kGreatest = 4.0;
        double squares = 0.0;
        double redundancy = 0.0;
        for (std::size_t g = kGnssWalkH; g < kGnssWalkV; ++g) {
            squares += statistics[g].squares;
            redundancy += statistics[g].redundancy;
        }
        if (redundancy < 1.0) return 1.0;
        return std::clamp(squares / redundancy / kOfNormalErrors, 1.0, kGreatest);
    }

    void wantCovariances(SparseLeastSquares& system) const {
        for (const RunModel& run : runs_) {
            for (std::size_t k = 0; k < run.correction.knots(); ++k) {
                const std::size_t next = std::min(k + 1, run.correction.knots() - 1);
                for (std::size_t a = 0; a < 3; ++a) {
                    for (std::size_t b = 0; b < 3; ++b) {
                        system.wantCovariance(run.correction.unknown(k, a), run.correction.unknown(k, b));
                        system.wantCovariance(run.correction.unknown(k, a), run.correction.unknown(next, b));
                    }
                }
            }
        }
    }

    // Crossovers bind a track more than they test it, pairs side by side err alike, and slopes tell of the
    // plan what they tell of each other: of what crossovers take off a variance, a part is added again, or
    // more.
    static double margin(double doubt, double without_crossovers, double with_crossovers) {
        return 1.0 + doubt * std::max(without_crossovers / with_crossovers - 1.0, 0.0);
    }

    Trajectory trajectory(const RunModel& run, SparseLeastSquares& system) const {
        Trajectory result;
        result.run_id = run.start->run->id;
        result.epochs = run.start->trajectory.epochs;
        for (std::size_t i = 0; i < run.size(); ++i) {
            TrajectoryEpoch& epoch = result.epochs[i];
            epoch.position_enu_m = run.track_m[i];
            const std::size_t before = i == 0 ? 0 : i - 1;
            const std::size_t after = std::min(i + 1, run.size() - 1);
            if (after > before) {
                epoch.velocity_enu_mps =
                    (run.track_m[after] - run.track_m[before]) / (run.time(after) - run.time(before));
            }
            const KnotChain::Place& at = run.at[i];
            const std::size_t next = std::min(at.knot + 1, run.correction.knots() - 1);
            const double g = 1.0 - at.fraction;
            const double f = at.fraction;
            const double dt = next > at.knot ? run.correction.time(next) - run.correction.time(at.knot) : 1.0;
            Eigen::Matrix3d here, there, cross;
            for (std::size_t a = 0; a < 3; ++a) {
                for (std::size_t b = 0; b < 3; ++b) {
                    const auto ia = static_cast<Eigen::Index>(a);
                    const auto ib = static_cast<Eigen::Index>(b);
                    here(ia, ib) = system.covariance(run.correction.unknown(at.knot, a),
                                                     run.correction.unknown(at.knot, b));
                    there(ia, ib) =
                        system.covariance(run.correction.unknown(next, a), run.correction.unknown(next, b));
                    cross(ia, ib) = system.covariance(run.correction.unknown(at.knot, a),
                                                      run.correction.unknown(next, b));
                }
            }
            Eigen::Matrix3d p = g * g * here + f * f * there + g * f * (cross + cross.transpose());
            // Variances are scaled, correlations stay.
            const double plan = plan_inflation_ * margin(kPlanDoubt, run.plan_variance_m2[at.knot],
                                                         0.5 * (here(0, 0) + here(1, 1)));
            const double height = height_inflation_ *
                                  std::min(margin(kHeightDoubt, run.height_variance_m2[at.knot], here(2, 2)),
                                           run.barometer_known[at.knot] ? kGreatestHeightMargin
                                                                        : kGreatestMarginWithoutBarometer);
            const Eigen::Vector3d inflate(std::sqrt(plan), std::sqrt(plan), std::sqrt(height));
            p = inflate.asDiagonal() * p * inflate.asDiagonal();
            epoch.covariance.setZero();
            epoch.covariance.topLeftCorner<3, 3>() = p;
            epoch.covariance.bottomRightCorner<3, 3>() =
                (here + there - cross - cross.transpose()) / squared(dt);
            if (run.has_heading) {
                epoch.attitude.yaw_rad = wrapAngle(trueYaw(run, shared_.iron, i));
                const std::size_t unknown = run.has_gyro ? run.turn.unknown(run.turn_at[i].knot)
                                                         : run.psi.unknown(run.psi_at[i].knot);
                epoch.sigma_heading_rad =
                    std::sqrt(system.covariance(unknown, unknown) + squared(radians(0.5)));
            }
        }
        return result;
    }

    const Survey& survey_;
    const FusionOptions& options_;
    Progress& progress_;
    std::stop_token stop_;
    std::vector<RunModel> runs_;
    SharedErrors shared_;
    CrossoverRows crossovers_{survey_, options_, runs_, shared_.iron};
    std::size_t unknowns_ = 0;
    FlowTest flow_test_;  // of the track before the last solution
    double height_inflation_ = 1.0;
    double plan_inflation_ = 1.0;
    bool settled_ = false;  // the track is near its place
};

}  // namespace

Result<JointSolution> adjustJointly(const Survey& survey, std::span<const RunStart> starts,
                                    const FusionOptions& options, Progress& progress, std::stop_token stop) {
    return JointAdjuster(survey, starts, options, progress, std::move(stop)).adjust();
}

}  // namespace terrawalk
