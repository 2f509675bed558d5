#include "fusion/crossovers.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>

namespace terrawalk {

namespace {

// Samples in square cells, ordered by cell, then by run and time.
class CellIndex {
  public:
    CellIndex(std::span<const GroundSample> samples, double cell_m) : samples_(samples), cell_m_(cell_m) {
        order_.reserve(samples.size());
        for (std::size_t i = 0; i < samples.size(); ++i) {
            order_.push_back(
                {column(samples[i].enu_m.x()), column(samples[i].enu_m.y()), static_cast<std::uint32_t>(i)});
        }
        std::sort(order_.begin(), order_.end(), [](const Entry& a, const Entry& b) {
            if (a.row != b.row) return a.row < b.row;
            return a.column != b.column ? a.column < b.column : a.sample < b.sample;
        });
    }

    /// Samples within `radius_m` of a place, by run and time.
    void near(const Eigen::Vector2d& place_m, double radius_m, std::vector<std::uint32_t>& found) const {
        found.clear();
        const std::int64_t west = column(place_m.x() - radius_m);
        const std::int64_t east = column(place_m.x() + radius_m);
        for (std::int64_t row = column(place_m.y() - radius_m); row <= column(place_m.y() + radius_m);
             ++row) {
            auto it = std::lower_bound(
                order_.begin(), order_.end(), Entry{west, row, 0}, [](const Entry& a, const Entry& b) {
                    if (a.row != b.row) return a.row < b.row;
                    return a.column != b.column ? a.column < b.column : a.sample < b.sample;
                });
            for (; it != order_.end() && it->row == row && it->column <= east; ++it) {
                if ((samples_[it->sample].enu_m.head<2>() - place_m).squaredNorm() <= radius_m * radius_m) {
                    found.push_back(it->sample);
                }
            }
        }
        std::sort(found.begin(), found.end());
    }

  private:
    struct Entry {
        std::int64_t column;
        std::int64_t row;
        std::uint32_t sample;
    };
    std::int64_t column(double x_m) const { return static_cast<std::int64_t>(std::floor(x_m / cell_m_)); }

    std::span<const GroundSample> samples_;
    double cell_m_;
    std::vector<Entry> order_;
};

// A stretch of samples of one run without a longer break: one pass over a place.
struct Pass {
    std::size_t first = 0;  // in the list of near samples
    std::size_t last = 0;   // one beyond
};

std::vector<Pass> passesIn(std::span<const GroundSample> samples, const std::vector<std::uint32_t>& near) {
    constexpr double kBreak_s = 4.0;
    std::vector<Pass> passes;
    for (std::size_t i = 0; i < near.size(); ++i) {
        const bool goes_on = i > 0 && samples[near[i]].run == samples[near[i - 1]].run &&
                             samples[near[i]].time_s - samples[near[i - 1]].time_s <= kBreak_s;
        if (!goes_on) passes.push_back({i, i});
        passes.back().last = i + 1;
    }
    return passes;
}

struct PlaneFit {
    Eigen::Vector2d height_m = Eigen::Vector2d::Zero();  // of each pass at the place
    Eigen::Vector2d slope = Eigen::Vector2d::Zero();
    double roughness_m = 0.0;
};

// One slope, one height for each pass; hits on plants are held off by Huber weights.
PlaneFit fitPlanes(std::span<const GroundSample> samples, const std::vector<std::uint32_t>& near,
                   std::span<const Pass> passes, const Eigen::Vector2d& place_m,
                   const CrossoverOptions& options) {
    constexpr int kReweights = 3;
    constexpr double kHuber_m = 0.08;
    PlaneFit fit;
    Eigen::Vector4d x = Eigen::Vector4d::Zero();
    for (int round = 0; round < kReweights; ++round) {
        Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
        Eigen::Vector4d right = Eigen::Vector4d::Zero();
        normal(2, 2) = normal(3, 3) = options.ridge_m2;
        double squares = 0.0;
        double weights = 0.0;
        for (std::size_t p = 0; p < passes.size(); ++p) {
            for (std::size_t i = passes[p].first; i < passes[p].last; ++i) {
                const Eigen::Vector3d& at = samples[near[i]].enu_m;
                Eigen::Vector4d a = Eigen::Vector4d::Zero();
                a[static_cast<Eigen::Index>(p)] = 1.0;
                a.tail<2>() = at.head<2>() - place_m;
                const double residual = at.z() - a.dot(x);
                const double near_weight = std::exp(-0.5 * (at.head<2>() - place_m).squaredNorm() /
                                                    (options.bandwidth_m * options.bandwidth_m));
                const double weight =
                    near_weight *
                    (round == 0 ? 1.0 : std::min(1.0, kHuber_m / std::max(std::abs(residual), 1e-9)));
                normal += weight * a * a.transpose();
                right += weight * at.z() * a;
                squares += weight * residual * residual;
                weights += weight;
            }
        }
        for (std::size_t p = passes.size(); p < 2; ++p) {
            normal(static_cast<Eigen::Index>(p), static_cast<Eigen::Index>(p)) = 1.0;
        }
        if (round > 0) fit.roughness_m = std::sqrt(squares / weights);
        x = normal.ldlt().solve(right);
    }
    fit.height_m = x.head<2>();
    fit.slope = x.tail<2>();
    return fit;
}

// The sample of a pass that lies nearest to a place.
std::uint32_t nearestOf(std::span<const GroundSample> samples, const std::vector<std::uint32_t>& near,
                        const Pass& pass, const Eigen::Vector2d& place_m) {
    std::uint32_t best = near[pass.first];
    for (std::size_t i = pass.first; i < pass.last; ++i) {
        if ((samples[near[i]].enu_m.head<2>() - place_m).squaredNorm() <
            (samples[best].enu_m.head<2>() - place_m).squaredNorm()) {
            best = near[i];
        }
    }
    return best;
}

double harmonicMean(double a, double b) {
    return 2.0 * a * b / (a + b);
}

bool holds(const std::vector<std::uint32_t>& near, const Pass& pass, std::uint32_t sample) {
    const auto begin = near.begin() + static_cast<std::ptrdiff_t>(pass.first);
    const auto end = near.begin() + static_cast<std::ptrdiff_t>(pass.last);
    return std::binary_search(begin, end, sample);
}

}  // namespace

std::vector<Crossover> findCrossovers(std::span<const GroundSample> samples,
                                      const CrossoverOptions& options) {
    const CellIndex index(samples, std::max(options.gate_m, options.radius_m));
    std::vector<Crossover> crossovers;
    std::vector<std::uint32_t> near;
    std::vector<std::uint32_t> ground;
    const GroundSample* before = nullptr;
    for (std::uint32_t i = 0; i < samples.size(); ++i) {
        const GroundSample& a = samples[i];
        const bool next = before == nullptr || before->run != a.run ||
                          (a.enu_m - before->enu_m).head<2>().norm() >= options.spacing_m;
        if (!next) continue;
        before = &a;
        index.near(a.enu_m.head<2>(), options.gate_m, near);
        for (const Pass& other : passesIn(samples, near)) {
            const std::uint32_t j = nearestOf(samples, near, other, a.enu_m.head<2>());
            const GroundSample& b = samples[j];
            // Each meeting is found from both passes; it is taken from the earlier one.
            if (j <= i || (b.run == a.run && b.time_s - a.time_s < options.apart_s)) continue;
            Crossover crossover;
            crossover.place_m = 0.5 * (a.enu_m + b.enu_m).head<2>();
            index.near(crossover.place_m, options.radius_m, ground);
            std::array<Pass, 2> pair;
            std::array<bool, 2> found{};
            for (const Pass& pass : passesIn(samples, ground)) {
                if (holds(ground, pass, i)) {
                    pair[0] = pass;
                    found[0] = true;
                }
                if (holds(ground, pass, j)) {
                    pair[1] = pass;
                    found[1] = true;
                }
            }
            // One stretch that lingers about the place has nothing to be compared with.
            if (!found[0] || !found[1] || pair[0].first == pair[1].first) continue;
            const std::size_t n_a = pair[0].last - pair[0].first;
            const std::size_t n_b = pair[1].last - pair[1].first;
            if (std::min(n_a, n_b) < options.fewest_points) continue;
            const PlaneFit fit = fitPlanes(samples, ground, pair, crossover.place_m, options);
            crossover.run_a = a.run;
            crossover.epoch_a = a.epoch;
            crossover.run_b = b.run;
            crossover.epoch_b = b.epoch;
            crossover.slope = fit.slope;
            crossover.misfit_m = fit.height_m[0] - fit.height_m[1];
            crossover.apart_m = (a.enu_m - b.enu_m).head<2>().norm();
            crossover.roughness_m = fit.roughness_m;
            crossover.points = harmonicMean(static_cast<double>(n_a), static_cast<double>(n_b));
            crossovers.push_back(crossover);
        }
    }
    return crossovers;
}

std::vector<MarkPass> findMarkPasses(std::span<const GroundSample> samples, const Eigen::Vector3d& mark_enu_m,
                                     const CrossoverOptions& options) {
    std::vector<std::uint32_t> near;
    for (std::uint32_t i = 0; i < samples.size(); ++i) {
        if ((samples[i].enu_m - mark_enu_m).head<2>().norm() <= options.radius_m) near.push_back(i);
    }
    std::vector<MarkPass> passes;
    const Eigen::Vector2d place_m = mark_enu_m.head<2>();
    for (const Pass& pass : passesIn(samples, near)) {
        if (pass.last - pass.first < options.fewest_points) continue;
        const PlaneFit fit = fitPlanes(samples, near, std::span(&pass, 1), place_m, options);
        const GroundSample& nearest = samples[nearestOf(samples, near, pass, place_m)];
        passes.push_back({nearest.run, nearest.epoch, fit.slope, fit.height_m[0] - mark_enu_m.z(),
                          (nearest.enu_m - mark_enu_m).head<2>().norm(), fit.roughness_m,
                          static_cast<double>(pass.last - pass.first)});
    }
    return passes;
}

}  // namespace terrawalk
