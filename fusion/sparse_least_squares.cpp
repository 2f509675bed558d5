#include "fusion/sparse_least_squares.hpp"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

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

struct SparseLeastSquares::Factor {
    Eigen::SimplicialLDLT<SparseMatrix, Eigen::Lower, Eigen::AMDOrdering<int>> ldlt;
    // Selected inverse, in the order of the factor: column starts and rows of L's pattern, with the diagonal
    // apart.
    std::vector<double> inverse_diagonal;
    std::vector<double> inverse_lower;
    std::vector<int> where;  // row -> place in the column under work

    void invert() {
        const SparseMatrix& L = ldlt.matrixL().nestedExpression();
        const auto n = static_cast<std::size_t>(L.cols());
        const int* outer = L.outerIndexPtr();
        const int* inner = L.innerIndexPtr();
        const double* value = L.valuePtr();
        inverse_diagonal.assign(n, 0.0);
        inverse_lower.assign(static_cast<std::size_t>(L.nonZeros()), 0.0);
        std::vector<double> sum;
        const Eigen::VectorXd& D = ldlt.vectorD();
        where.assign(n, -1);
        // Z_ij = -sum_k Z_ik L_kj for the rows of column j, then Z_jj = 1/d_j - sum_k L_kj Z_kj.
        for (std::size_t jj = n; jj-- > 0;) {
            const auto j = static_cast<int>(jj);
            const int begin = outer[j];
            const int end = outer[j + 1];
            const auto m = static_cast<std::size_t>(end - begin);
            sum.assign(m, 0.0);
            for (int p = begin; p < end; ++p) where[static_cast<std::size_t>(inner[p])] = p - begin;
            for (int p = begin; p < end; ++p) {
                const int k = inner[p];
                const double Lkj = value[p];
                const auto at_k = static_cast<std::size_t>(p - begin);
                sum[at_k] -= Lkj * inverse_diagonal[static_cast<std::size_t>(k)];
                for (int q = outer[k]; q < outer[k + 1]; ++q) {
                    const int at = where[static_cast<std::size_t>(inner[q])];
                    if (at < 0) continue;
                    const double z = inverse_lower[static_cast<std::size_t>(q)];
                    sum[static_cast<std::size_t>(at)] -= Lkj * z;
                    sum[at_k] -= value[begin + at] * z;
                }
            }
            double diagonal = 1.0 / D[j];
            for (int p = begin; p < end; ++p) {
                inverse_lower[static_cast<std::size_t>(p)] = sum[static_cast<std::size_t>(p - begin)];
                diagonal -= value[p] * sum[static_cast<std::size_t>(p - begin)];
                where[static_cast<std::size_t>(inner[p])] = -1;
            }
            inverse_diagonal[jj] = diagonal;
        }
    }

    double entry(std::size_t i, std::size_t j) {
        if (inverse_diagonal.empty()) invert();
        const auto& order = ldlt.permutationP().indices();
        int a = order[static_cast<Eigen::Index>(i)];
        int b = order[static_cast<Eigen::Index>(j)];
        if (a == b) return inverse_diagonal[static_cast<std::size_t>(a)];
        if (a > b) std::swap(a, b);
        const SparseMatrix& L = ldlt.matrixL().nestedExpression();
        const int* begin = L.innerIndexPtr() + L.outerIndexPtr()[a];
        const int* end = L.innerIndexPtr() + L.outerIndexPtr()[a + 1];
        const int* found = std::lower_bound(begin, end, b);
        if (found == end || *found != b) return std::numeric_limits<double>::quiet_NaN();
        return inverse_lower[static_cast<std::size_t>(found - L.innerIndexPtr())];
    }
};

SparseLeastSquares::SparseLeastSquares(std::size_t unknowns, std::vector<RowGroup> groups)
    : unknowns_(unknowns), groups_(std::move(groups)) {}
SparseLeastSquares::~SparseLeastSquares() = default;
SparseLeastSquares::SparseLeastSquares(SparseLeastSquares&&) noexcept = default;
SparseLeastSquares& SparseLeastSquares::operator=(SparseLeastSquares&&) noexcept = default;

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
    factor_ = std::make_unique<Factor>();
    factor_->ldlt.compute(normal);
    if (factor_->ldlt.info() != Eigen::Success) return std::nullopt;
    if (!(factor_->ldlt.vectorD().minCoeff() > 0.0)) return std::nullopt;
    Eigen::VectorXd solution = factor_->ldlt.solve(right);
    if (!solution.allFinite()) return std::nullopt;
    return solution;
}

double SparseLeastSquares::covariance(std::size_t i, std::size_t j) {
    return factor_->entry(i, j);
}

std::vector<GroupStatistics> SparseLeastSquares::statistics(const Eigen::VectorXd& solution) {
    std::vector<GroupStatistics> result(groups_.size());
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
        s.redundancy += std::clamp(1.0 - used * predicted / squared(sigma), 0.0, 1.0);
        s.weighted_squares += weight * squared(after / sigma);
        if (weight < 0.5) ++s.down_weighted;
    }
    return result;
}

void SparseLeastSquares::adaptScales(const std::vector<GroupStatistics>& statistics) {
    for (std::size_t g = 0; g < groups_.size(); ++g) {
        RowGroup& group = groups_[g];
        const GroupStatistics& s = statistics[g];
        if (!group.adapt || s.rows == 0) continue;
        const double expected = expectedWeightedSquare(group.loss, group.tuning);
        const double variance_ratio =
            (s.weighted_squares / expected + group.prior_rows / squared(group.scale)) /
            (s.redundancy + group.prior_rows);
        group.scale =
            std::clamp(group.scale * std::sqrt(variance_ratio), group.least_scale, group.greatest_scale);
    }
}

}  // namespace terrawalk
