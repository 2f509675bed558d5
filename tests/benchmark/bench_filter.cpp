// The paper's filter: nanoseconds for one epoch of one candidate, in several forms side by side, and the time
// of the paper's whole tuning budget. Run as: bench_filter [repeats] [--budget] [--threads N]
// --budget runs the budget in full instead of extrapolating it.

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/info.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <numeric>
#include <optional>
#include <string_view>
#include <vector>

#include "fusion/batch_filter_input.hpp"
#include "fusion/filter_family.hpp"
#include "fusion/fixed_point_loss.hpp"
#include "fusion/unscented_transform.hpp"
#include "tests/fusion/measured_survey.hpp"
#include "tests/support/random_numbers.hpp"

namespace terrawalk {
namespace {

constexpr std::size_t kPopulation = 100;
constexpr std::size_t kIterations = 1000;
constexpr std::size_t kTrials = 2;  // a move and a trial vector for each individual

/// The textbook: 19 sigma points, full matrices of fixed size, nothing but the track.
Eigen::Vector3d textbookFilter(const MeasuredRun& run, const AukfOptions& options) {
    using Points = Eigen::Matrix<double, 9, 19>;
    using Rows = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 9, 1>;
    using RowPoints = Eigen::Matrix<double, Eigen::Dynamic, 19, 0, 9, 19>;
    using Square = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 9, 9>;
    const double spread = sigmaPointSpread(options.unscented, 9);
    const double lambda = spread - 9.0;
    Eigen::Matrix<double, 19, 1> mean_weights = Eigen::Matrix<double, 19, 1>::Constant(0.5 / spread);
    Eigen::Matrix<double, 19, 1> weights = mean_weights;
    mean_weights[0] = lambda / spread;
    weights[0] =
        lambda / spread + 1.0 - options.unscented.alpha * options.unscented.alpha + options.unscented.beta;
    const auto drawn = [&](const Vector9d& x, const Matrix9d& P) {
        const Matrix9d L = std::sqrt(spread) * Matrix9d(P.llt().matrixL());
        Points points;
        points.col(0) = x;
        points.middleCols<9>(1) = L.colwise() + x;
        points.middleCols<9>(10) = (-L).colwise() + x;
        return points;
    };
    Vector9d x = run.start.mean;
    Matrix9d P = run.start.covariance;
    constexpr std::size_t kYaw = static_cast<std::size_t>(MeasurementRow::Yaw);
    for (const MeasurementEpoch& epoch : run.epochs) {
        if (epoch.dt_s > 0.0) {
            const Points moved = constantAccelerationMatrix(epoch.dt_s) * drawn(x, P);
            x = moved * mean_weights;
            const Points d = moved.colwise() - x;
            P = d * weights.asDiagonal() * d.transpose();
            P.diagonal() += stepNoiseDiagonal(options, epoch.dt_s);
        }
        const bool moving = x.head<2>().norm() >= options.yaw_row.slowest_mps;
        std::array<std::size_t, kRowCount> rows{};
        Eigen::Index m = 0;
        for (std::size_t row = 0; row < kRowCount; ++row) {
            if ((epoch.present & rowBit(row)) != 0 && (row != kYaw || moving))
                rows[static_cast<std::size_t>(m++)] = row;
        }
        if (m == 0) continue;
        const Points points = drawn(x, P);
        RowPoints mapped(m, 19);
        Rows z(m), R(m);
        for (Eigen::Index i = 0; i < m; ++i) {
            const std::size_t row = rows[static_cast<std::size_t>(i)];
            z[i] = epoch.z[row];
            R[i] = epoch.variance[row];
            if (row != kYaw) {
                mapped.row(i) = points.row(kStateOfRow[row]);
                continue;
            }
            for (int k = 0; k < 19; ++k) mapped(i, k) = std::atan2(points(1, k), points(0, k));
            for (int k = 1; k < 19; ++k) mapped(i, k) = mapped(i, 0) + wrapAngle(mapped(i, k) - mapped(i, 0));
        }
        const Rows expected = mapped * mean_weights;
        const RowPoints dz = mapped.colwise() - expected;
        const Points dx = points.colwise() - x;
        Square S = dz * weights.asDiagonal() * dz.transpose();
        S.diagonal() += R;
        const Eigen::Matrix<double, 9, Eigen::Dynamic, 0, 9, 9> C =
            dx * weights.asDiagonal() * dz.transpose();
        Rows nu = z - expected;
        for (Eigen::Index i = 0; i < m; ++i) {
            if (rows[static_cast<std::size_t>(i)] == kYaw) nu[i] = wrapAngle(nu[i]);
        }
        const Eigen::Matrix<double, 9, Eigen::Dynamic, 0, 9, 9> K = S.llt().solve(C.transpose()).transpose();
        x += K * nu;
        P -= K * S * K.transpose();
        P = (0.5 * (P + P.transpose())).eval();
    }
    return x.segment<3>(offset(StateBlock::Position));
}

struct Case {
    std::string name;
    std::size_t candidates;  // in one call
    std::function<double()> work;
    std::vector<double> ns{};  // per epoch and candidate
};

double seconds(const std::function<void()>& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::vector<double> candidatesInBox(std::size_t n, test::RandomNumbers& random) {
    const CandidateBounds bounds = candidateBounds(kAllDimensions);
    std::vector<double> candidates;
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t k = 0; k < kAllDimensions; ++k) {
            candidates.push_back(random.uniform(bounds.lower[k], bounds.upper[k]));
        }
    }
    return candidates;
}

int bench(int repeats, bool whole_budget, std::size_t threads) {
    SimulationOptions simulation;
    simulation.area_epochs = 0;
    simulation.control_stops = 0;
    const SimulatedSurvey simulated = simulatedSurvey(simulation);
    const FusionOptions options;
    const auto loss = FixedPointLoss::prepare(simulated.survey, options);
    if (!loss) {
        fmt::print(stderr, "{}\n", loss.error().text());
        return 1;
    }
    std::vector<MeasuredRun> runs;
    for (const Run& run : simulated.survey.runs) runs.push_back(measured(simulated.survey, run, options));
    std::vector<std::vector<BatchEpoch>> epochs;
    for (const MeasuredRun& run : runs) epochs.push_back(batchEpochs(run, options.aukf));
    const auto steps = static_cast<double>(loss->epochs());

    test::RandomNumbers random(simulation.seed);
    const std::vector<double> box = candidatesInBox(kPopulation, random);
    std::vector<AukfOptions> candidates;
    std::vector<BatchCandidate> batch;
    for (std::size_t c = 0; c < kPopulation; ++c) {
        candidates.push_back(
            withCandidate(options.aukf, std::span(box).subspan(c * kAllDimensions, kAllDimensions)));
        batch.push_back(batchCandidate(candidates.back()));
    }

    std::vector<Case> cases;
    cases.push_back({"Eigen, 19 points, full matrices", 1, [&] {
                         double sum = 0.0;
                         for (const MeasuredRun& run : runs) sum += textbookFilter(run, options.aukf).sum();
                         return sum;
                     }});
    cases.push_back({"the same with consistency (process)", 1, [&] {
                         double sum = 0.0;
                         for (const MeasuredRun& run : runs)
                             sum += filterRun(run, options.aukf)->states.back().mean[3];
                         return sum;
                     }});
    for (const InstructionSet set :
         {InstructionSet::Scalar, InstructionSet::Baseline, InstructionSet::Avx2, InstructionSet::Avx512}) {
        if (!available(set)) continue;
        const std::size_t n = kPopulation / 4 / laneCount(set) * laneCount(set);
        cases.push_back({fmt::format("exact, {} ({} lanes)", name(set), laneCount(set)), n, [&, set, n] {
                             std::vector<double> sums(3 * kMostLanes);
                             double total = 0.0;
                             for (std::size_t first = 0; first < n; first += laneCount(set)) {
                                 for (std::size_t r = 0; r < runs.size(); ++r) {
                                     filterBatch(set, batchRun(runs[r], epochs[r], options.aukf),
                                                 &batch[first], laneCount(set), sums.data(), nullptr);
                                     total += sums[0];
                                 }
                             }
                             return total;
                         }});
    }
    std::vector<double> losses(2 * kPopulation);
    cases.push_back({fmt::format("whole loss, {} threads", threads), kPopulation, [&] {
                         loss->losses(box, kAllDimensions, losses);
                         return losses[0];
                     }});
    // Turn by turn, so that a busy machine is busy for all.
    volatile double kept = 0.0;
    for (int i = 0; i < repeats; ++i) {
        for (Case& c : cases) {
            c.ns.push_back(1e9 * seconds([&] { kept = c.work(); }) /
                           (steps * static_cast<double>(c.candidates)));
        }
    }

    fmt::print("{} runs of {:.0f} epochs (simulated, seed {}), {} repeats; ns per epoch and candidate\n",
               runs.size(), steps / static_cast<double>(runs.size()), simulation.seed, repeats);
    fmt::print("{:<38}{:>9}{:>9}{:>9}{:>9}\n", "", "min", "median", "max", "times");
    const auto median = [](const Case& c) {
        std::vector<double> ns = c.ns;
        std::nth_element(ns.begin(), ns.begin() + static_cast<std::ptrdiff_t>(ns.size() / 2), ns.end());
        return ns[ns.size() / 2];
    };
    for (const Case& c : cases) {
        fmt::print("{:<38}{:>9.1f}{:>9.1f}{:>9.1f}{:>9.1f}\n", c.name,
                   *std::min_element(c.ns.begin(), c.ns.end()), median(c),
                   *std::max_element(c.ns.begin(), c.ns.end()), median(cases[0]) / median(c));
    }
    fmt::print("published C++ filters, one step each: mherb/kalman 7800 ns, sfwa/ukf 15300 ns\n");

    const double budget = steps * static_cast<double>(kPopulation * kIterations * kTrials);
    fmt::print("the paper's budget, {} individuals x {} iterations x {} evaluations: {:.3g} filter epochs\n",
               kPopulation, kIterations, kTrials, budget);
    fmt::print("  extrapolated: {:.1f} s in this form, {:.0f} s in Eigen's on one thread\n",
               1e-9 * budget * median(cases.back()), 1e-9 * budget * median(cases[0]));
    if (!whole_budget) return 0;
    double best = losses[0] + losses[1];
    const std::clock_t cpu_before = std::clock();
    const double took = seconds([&] {
        for (std::size_t i = 0; i < kIterations * kTrials; ++i) {
            loss->losses(candidatesInBox(kPopulation, random), kAllDimensions, losses);
            for (std::size_t c = 0; c < kPopulation; ++c)
                best = std::min(best, losses[2 * c] + losses[2 * c + 1]);
        }
    });
    const double cpu_s = static_cast<double>(std::clock() - cpu_before) / CLOCKS_PER_SEC;
    fmt::print(
        "  run whole on {} threads: {:.1f} s, {:.1f} s of CPU ({:.1f} ns of CPU per epoch and candidate); "
        "least "
        "loss met {:.3f} m2\n",
        threads, took, cpu_s, 1e9 * cpu_s / budget, best);
    return 0;
}

}  // namespace
}  // namespace terrawalk

int main(int argc, char** argv) {
    int repeats = 9;
    bool whole_budget = false;
    auto threads = static_cast<std::size_t>(tbb::info::default_concurrency());
    for (int i = 1; i < argc; ++i) {
        const std::string_view argument(argv[i]);
        if (argument == "--budget") {
            whole_budget = true;
        } else if (argument == "--threads" && i + 1 < argc) {
            threads = static_cast<std::size_t>(std::max(1, std::atoi(argv[++i])));
        } else {
            repeats = std::max(1, std::atoi(argv[i]));
        }
    }
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return terrawalk::bench(repeats, whole_budget, threads);
}
