#pragma once

#include <Eigen/Core>
#include <cmath>
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

/// Lower triangular L with L L' = P; where P has no variance left, a column of zeros.
template <int N>
[[nodiscard]] Eigen::Matrix<double, N, N> choleskyColumns(const Eigen::Matrix<double, N, N>& P) {
    Eigen::Matrix<double, N, N> L = Eigen::Matrix<double, N, N>::Zero();
    for (int j = 0; j < N; ++j) {
        const double pivot = P(j, j) - L.row(j).squaredNorm();
        if (!(pivot > 0.0)) continue;
        L(j, j) = std::sqrt(pivot);
        for (int i = j + 1; i < N; ++i) L(i, j) = (P(i, j) - L.row(i).dot(L.row(j))) / L(j, j);
    }
    return L;
}

/// y = f(x) as the unscented transform sees it: y0 + shift + gradient . (x - mean) + e, e ~ (0, omega).
template <int N>
struct StatisticalLinearisation {
    Eigen::Matrix<double, N, 1> gradient;  ///< C' P^-1, C the cross-covariance of x with y
    double shift = 0.0;                    ///< mean of y less y0 = f(mean)
    double omega = 0.0;                    ///< variance of y that no linear function of x explains
};

/// `rise(d)` is f(mean + d) - f(mean), a scalar; `spread` as sigmaPointSpread() of the whole state. A linear
/// update with this gradient and noise R + omega gives the same as the transform over all sigma points.
/// Source: Julier and Uhlmann 2004; Lefebvre, Bruyninckx and De Schutter 2002 for the linear form.
template <int N, class Rise>
[[nodiscard]] StatisticalLinearisation<N> statisticallyLinearised(
    const Eigen::Matrix<double, N, N>& covariance, double spread, const UnscentedOptions& options,
    const Rise& rise) {
    const double weight = 0.5 / spread;
    const double root = std::sqrt(spread);
    const Eigen::Matrix<double, N, N> L = choleskyColumns<N>(covariance);
    StatisticalLinearisation<N> linear;
    linear.gradient.setZero();
    for (int i = 0; i < N; ++i) {
        if (L(i, i) == 0.0) continue;
        const Eigen::Matrix<double, N, 1> step = root * L.col(i);
        const double above = rise(step);
        const double below = rise(Eigen::Matrix<double, N, 1>(-step));
        linear.gradient[i] = (above - below) / (2.0 * root);
        linear.shift += weight * (above + below);
        linear.omega += 0.5 * weight * (above + below) * (above + below);
    }
    linear.omega += (options.beta - options.alpha * options.alpha) * linear.shift * linear.shift;
    // L' gradient = slope along the columns, from the last row upwards.
    for (int i = N - 1; i >= 0; --i) {
        if (L(i, i) == 0.0) continue;
        for (int k = i + 1; k < N; ++k) linear.gradient[i] -= L(k, i) * linear.gradient[k];
        linear.gradient[i] /= L(i, i);
    }
    return linear;
}

}  // namespace terrawalk
