#pragma once

#include <Eigen/Core>
#include <functional>

#include "fusion/fusion_options.hpp"

namespace terrawalk {

/// n + lambda = alpha^2 (n + kappa), the squared spread of the sigma points in units of the Cholesky columns.
/// Source: paper 000, the second of its two forms of lambda (the first, 3 - n, contradicts it).
[[nodiscard]] double sigmaPointSpread(const UnscentedOptions& options, int n);

struct TransformedMoments {
    Eigen::VectorXd mean;
    Eigen::MatrixXd covariance;        ///< of y, without measurement noise
    Eigen::MatrixXd cross_covariance;  ///< of x (rows) with y (columns)
};

using VectorFunction = std::function<Eigen::VectorXd(const Eigen::VectorXd&)>;
/// a - b in the space of y; wraps where y holds an angle.
using DifferenceFunction = std::function<Eigen::VectorXd(const Eigen::VectorXd& a, const Eigen::VectorXd& b)>;

/// Moments of y = f(x), x ~ (mean, covariance), from 2n + 1 sigma points: mean +- columns of the Cholesky
/// factor of (n + lambda) P. All sums are of differences from the centre point y0,
///     m = w sum d_i,  cov = w sum d_i d_i' + (beta - alpha^2) m m',  w = 1 / (2 (n + lambda)),
/// which equals the weighted sums of the textbook and does not cancel when alpha is small.
/// `covariance` must be positive definite. Pure; safe from any thread if `f` is.
/// Source: paper 000, eqs 7-17, corrected (matrix root by Cholesky; weights that sum to one); Julier and
/// Uhlmann 2004.
[[nodiscard]] TransformedMoments unscentedTransform(const Eigen::VectorXd& mean,
                                                    const Eigen::MatrixXd& covariance,
                                                    const VectorFunction& f,
                                                    const DifferenceFunction& difference,
                                                    const UnscentedOptions& options);

/// The same where y holds no angle.
[[nodiscard]] TransformedMoments unscentedTransform(const Eigen::VectorXd& mean,
                                                    const Eigen::MatrixXd& covariance,
                                                    const VectorFunction& f, const UnscentedOptions& options);

}  // namespace terrawalk
