#include "fusion/unscented_transform.hpp"

#include <Eigen/Cholesky>
#include <cmath>

namespace terrawalk {

double sigmaPointSpread(const UnscentedOptions& options, int n) {
    return options.alpha * options.alpha * (static_cast<double>(n) + options.kappa);
}

TransformedMoments unscentedTransform(const Eigen::VectorXd& mean, const Eigen::MatrixXd& covariance,
                                      const VectorFunction& f, const DifferenceFunction& difference,
                                      const UnscentedOptions& options) {
    const auto n = mean.size();
    const double spread = sigmaPointSpread(options, static_cast<int>(n));
    const double weight = 0.5 / spread;
    const Eigen::MatrixXd columns = std::sqrt(spread) * Eigen::MatrixXd(covariance.llt().matrixL());

    const Eigen::VectorXd centre = f(mean);
    Eigen::VectorXd shift = Eigen::VectorXd::Zero(centre.size());
    TransformedMoments moments{centre, Eigen::MatrixXd::Zero(centre.size(), centre.size()),
                               Eigen::MatrixXd::Zero(n, centre.size())};
    for (Eigen::Index i = 0; i < n; ++i) {
        const Eigen::VectorXd above = difference(f(mean + columns.col(i)), centre);
        const Eigen::VectorXd below = difference(f(mean - columns.col(i)), centre);
        shift += weight * (above + below);
        moments.covariance += weight * (above * above.transpose() + below * below.transpose());
        moments.cross_covariance += weight * columns.col(i) * (above - below).transpose();
    }
    moments.mean += shift;
    moments.covariance += (options.beta - options.alpha * options.alpha) * shift * shift.transpose();
    return moments;
}

TransformedMoments unscentedTransform(const Eigen::VectorXd& mean, const Eigen::MatrixXd& covariance,
                                      const VectorFunction& f, const UnscentedOptions& options) {
    return unscentedTransform(
        mean, covariance, f,
        [](const Eigen::VectorXd& a, const Eigen::VectorXd& b) -> Eigen::VectorXd { return a - b; }, options);
}

}  // namespace terrawalk
