#include "fusion/sparse_least_squares.hpp"

#include <Eigen/SparseCore>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "survey/upper_median.hpp"

namespace terrawalk {

namespace {

using SparseMatrix = Eigen::SparseMatrix<double>;

double squared(double x) {
    return x * x;
}

double robustWeightOf(Loss loss, double tuning, double deviation) {
    const double size = std::abs(deviation);
    switch (loss) {
        case Loss::Square:
            return 1.0;
        case Loss::Huber:
            return size <= tuning ? 1.0 : tuning / size;
        case Loss::Cauchy:
            return 1.0 / (1.0 + squared(size / tuning));
    }
    return 1.0;
}

}  // namespace

double expectedWeightedSquare(Loss loss, double tuning) {
    // Midpoint rule over +-8 sigma; the integrand is smooth, 2000 steps leave 1e-6.
    constexpr int kSteps = 2000;
    constexpr double kReach = 8.0;
    double sum = 0.0;
    double mass = 0.0;
    for (int i = 0; i < kSteps; ++i) {
        const double r = kReach * (2.0 * (i + 0.5) / kSteps - 1.0);
        const double density = std::exp(-0.5 * r * r);
        sum += density * robustWeightOf(loss, tuning, r) * r * r;
        mass += density;
    }
    return sum / mass;
}

SparseLeastSquares::SparseLeastSquares(std::size_t unknowns, std::vector<RowGroup> groups,
                                       std::stop_token stop)
    : unknowns_(unknowns), stop_(std::move(stop)), groups_(std::move(groups)) {}

std::size_t SparseLeastSquares::addRow(std::size_t group, std::span<const Coefficient> coefficients,
                                       double residual, double sigma) {
    assert(sigma > 0.0 && group < groups_.size());
    for (const Coefficient& c : coefficients) {
        if (c.value != 0.0) coefficients_.push_back(c);
    }
    first_.push_back(coefficients_.size());
    residuals_.push_back(residual);
    sigmas_.push_back(sigma);
    row_groups_.push_back(static_cast<std::uint32_t>(group));
    return residuals_.size() - 1;
}

double SparseLeastSquares::weightOf(std::size_t row, double residual) const {
    const RowGroup& group = groups_[row_groups_[row]];
    return robustWeightOf(group.loss, group.tuning, residual / (group.scale * sigmas_[row]));
}

double SparseLeastSquares::robustWeight(std::size_t row) const {
    return weightOf(row, residuals_[row]);
}

std::optional<Eigen::VectorXd> SparseLeastSquares::solve() {
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(coefficients_.size() * 6 + wanted_.size());
    for (const auto& [i, j] : wanted_) {
        entries.emplace_back(static_cast<int>(std::max(i, j)), static_cast<int>(std::min(i, j)), 0.0);
    }
    Eigen::VectorXd right = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(unknowns_));
    for (std::size_t row = 0; row < rows(); ++row) {
        const double sigma = groups_[row_groups_[row]].scale * sigmas_[row];
        const double weight = weightOf(row, residuals_[row]) / squared(sigma);
        for (std::size_t p = first_[row]; p < first_[row + 1]; ++p) {
            const Coefficient& a = coefficients_[p];
            right[static_cast<Eigen::Index>(a.unknown)] += weight * a.value * residuals_[row];
            for (std::size_t q = first_[row]; q < first_[row + 1]; ++q) {
                const Coefficient& b = coefficients_[q];
                if (b.unknown > a.unknown) continue;
                entries.emplace_back(static_cast<int>(a.unknown), static_cast<int>(b.unknown),
                                     weight * a.value * b.value);
            }
        }
    }
    SparseMatrix normal(static_cast<int>(unknowns_), static_cast<int>(unknowns_));
    normal.setFromTriplets(entries.begin(), entries.end());
    inverse_.reset();
    if (factor_) {
        if (!factor_->refactorize(normal, stop_)) return std::nullopt;
    } else {
        auto factor = SparseCholesky::factorize(normal, stop_);
        if (!factor) return std::nullopt;
        factor_ = std::move(*factor);
    }
    Eigen::VectorXd solution = factor_->solve(right);
    if (!solution.allFinite()) return std::nullopt;
    return solution;
}

double SparseLeastSquares::covariance(std::size_t i, std::size_t j) {
    if (!inverse_) {
        if (!stopped_) {
            auto inverse = factor_->selectedInverse(stop_);
            stopped_ = !inverse;
            if (inverse) inverse_ = std::move(*inverse);
        }
        if (stopped_) return std::numeric_limits<double>::quiet_NaN();
    }
    return inverse_->at(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
}

std::vector<GroupStatistics> SparseLeastSquares::statistics(const Eigen::VectorXd& solution) {
    std::vector<GroupStatistics> result(groups_.size());
    std::vector<std::vector<double>> deviations(groups_.size());
    for (std::size_t row = 0; row < rows(); ++row) {
        const RowGroup& group = groups_[row_groups_[row]];
        GroupStatistics& s = result[row_groups_[row]];
        const double sigma = group.scale * sigmas_[row];
        double after = residuals_[row];
        double predicted = 0.0;
        for (std::size_t p = first_[row]; p < first_[row + 1]; ++p) {
            const Coefficient& a = coefficients_[p];
            after -= a.value * solution[static_cast<Eigen::Index>(a.unknown)];
            predicted += squared(a.value) * covariance(a.unknown, a.unknown);
            for (std::size_t q = p + 1; q < first_[row + 1]; ++q) {
                const Coefficient& b = coefficients_[q];
                predicted += 2.0 * a.value * b.value * covariance(a.unknown, b.unknown);
            }
        }
        const double used = weightOf(row, residuals_[row]);  // what solve() took
        const double weight = weightOf(row, after);
        ++s.rows;
        const double redundancy = std::clamp(1.0 - used * predicted / squared(sigma), 0.0, 1.0);
        s.redundancy += redundancy;
        if (group.by_median) {
            deviations[row_groups_[row]].push_back(std::abs(after) /
                                                   (sigma * std::sqrt(std::max(redundancy, 0.02))));
        }
        s.squares += squared(after / sigma);
        s.weighted_squares += weight * squared(after / sigma);
        if (weight < 0.5) ++s.down_weighted;
    }
    for (std::size_t g = 0; g < groups_.size(); ++g) {
        std::vector<double>& all = deviations[g];
        if (all.empty()) continue;
        result[g].median_deviation = upperMedian(all) / 0.6745;
    }
    return result;
}

void SparseLeastSquares::adaptScales(const std::vector<GroupStatistics>& statistics) {
    for (std::size_t g = 0; g < groups_.size(); ++g) {
        RowGroup& group = groups_[g];
        const GroupStatistics& s = statistics[g];
        if (!group.adapt || s.rows == 0) continue;
        if (group.by_median) {
            const auto rows = static_cast<double>(s.rows);
            // `median_deviation` is in units of the present sigma.
            const double ratio =
                (rows * squared(s.median_deviation) + group.prior_rows / squared(group.scale)) /
                (rows + group.prior_rows);
            group.scale = std::clamp(group.scale * std::sqrt(ratio), group.least_scale, group.greatest_scale);
            continue;
        }
        const double expected = expectedWeightedSquare(group.loss, group.tuning);
        const double variance_ratio =
            (s.weighted_squares / expected + group.prior_rows / squared(group.scale)) /
            (s.redundancy + group.prior_rows);
        group.scale =
            std::clamp(group.scale * std::sqrt(variance_ratio), group.least_scale, group.greatest_scale);
    }
}

}  // namespace terrawalk
