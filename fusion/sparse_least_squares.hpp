#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

#include "fusion/selected_inverse.hpp"

namespace terrawalk {

/// How a group of rows treats residuals that are large against their sigma.
enum class Loss : std::uint8_t {
    Square,  ///< every residual counts by its square
    Huber,   ///< beyond `tuning` sigmas it counts by its size
    Cauchy,  ///< beyond `tuning` sigmas it hardly counts more than there
};

/// Rows whose noise has one common cause. Their sigmas are right up to one factor, which can be estimated.
struct RowGroup {
    std::string name;
    Loss loss = Loss::Square;
    double tuning = 3.0;
    bool by_median = false;    ///< the factor comes from the median residual: for rows with many outliers
    bool adapt = false;        ///< whether the factor may be estimated
    double least_scale = 0.2;  ///< limits of the factor
    double greatest_scale = 5.0;
    double prior_rows = 20.0;  ///< how many residuals the factor 1 is worth as an opinion
    double scale = 1.0;        ///< the factor
};

/// What one group of rows came to.
struct GroupStatistics {
    std::size_t rows = 0;
    double redundancy = 0.0;        ///< rows less what the unknowns took of them
    double weighted_squares = 0.0;  ///< sum of weight (residual / sigma)^2
    double squares = 0.0;           ///< the same without weights: outliers count in full
    double median_deviation = 0.0;  ///< |residual| / its sigma, redundancy counted, over 0.6745
    std::size_t down_weighted = 0;  ///< rows whose weight fell below a half
};

/// One coefficient of a row.
struct Coefficient {
    std::size_t unknown = 0;
    double value = 0.0;
};

/// Sparse weighted least squares over independent rows
///
///     sum_j a_j x_j = residual + noise,  noise ~ (0, (scale sigma)^2)
///
/// with robust weights (iteratively re-weighted) and noise factors by variance components. Units are those of
/// the caller. Not thread-safe; different objects are independent. Sources: Huber 1981; Foerstner 1979 and
/// Koch 1999, section 3.6 (variance components); Takahashi, Fagan and Chin 1973 (selected inverse).
class SparseLeastSquares {
  public:
    /// @param stop  ends solve() without a solution, and leaves covariances NaN
    SparseLeastSquares(std::size_t unknowns, std::vector<RowGroup> groups, std::stop_token stop = {});

    /// @param sigma  > 0
    /// @return number of the row
    std::size_t addRow(std::size_t group, std::span<const Coefficient> coefficients, double residual,
                       double sigma);
    std::size_t addRow(std::size_t group, std::initializer_list<Coefficient> coefficients, double residual,
                       double sigma) {
        return addRow(group, std::span(coefficients.begin(), coefficients.size()), residual, sigma);
    }

    /// Asks for the covariance of two unknowns that may stand in no row together. Before solve().
    void wantCovariance(std::size_t i, std::size_t j) { wanted_.emplace_back(i, j); }

    /// Takes the order of elimination of an earlier system with much the same pattern.
    void continueFrom(SparseLeastSquares& earlier) { factor_ = std::move(earlier.factor_); }

    /// Least-squares x for the weights of the present residuals; nothing when the rows do not determine it,
    /// or after a stop request.
    [[nodiscard]] std::optional<Eigen::VectorXd> solve();

    /// Entry of the inverse normal matrix, the covariance of the unknowns as the rows have it. Both unknowns
    /// must stand in one row together, be the same, or have been asked for. Needs solve(), and computes all
    /// of them on first use.
    [[nodiscard]] double covariance(std::size_t i, std::size_t j);

    /// Statistics of each group after solve(), its x put into the rows (`solution`).
    [[nodiscard]] std::vector<GroupStatistics> statistics(const Eigen::VectorXd& solution);
    /// New factors for the groups that adapt, from these statistics; also kept in groups().
    void adaptScales(const std::vector<GroupStatistics>& statistics);

    [[nodiscard]] const std::vector<RowGroup>& groups() const { return groups_; }
    [[nodiscard]] std::size_t rows() const { return residuals_.size(); }
    [[nodiscard]] std::size_t unknowns() const { return unknowns_; }
    /// Weight of a row in 0..1 by its present residual.
    [[nodiscard]] double robustWeight(std::size_t row) const;

  private:
    [[nodiscard]] double weightOf(std::size_t row, double residual) const;

    std::size_t unknowns_;
    std::stop_token stop_;
    std::vector<RowGroup> groups_;
    std::vector<std::size_t> first_{0};  // of each row's coefficients, and the end
    std::vector<Coefficient> coefficients_;
    std::vector<double> residuals_;
    std::vector<double> sigmas_;
    std::vector<std::uint32_t> row_groups_;
    std::vector<std::pair<std::size_t, std::size_t>> wanted_;
    std::optional<SparseCholesky> factor_;
    std::optional<SelectedInverse> inverse_;
    bool stopped_ = false;  // before there was an inverse; thousands of covariances must not try again
};

/// Expected weight (r / sigma)^2 of a standard normal r under a loss; what weighted squares are divided by.
[[nodiscard]] double expectedWeightedSquare(Loss loss, double tuning);

}  // namespace terrawalk
