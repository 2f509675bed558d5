#include "fusion/filter_family.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <optional>

#include "fusion/unscented_transform.hpp"

namespace terrawalk {

namespace {

constexpr int kStates = 9;
constexpr std::size_t kYaw = static_cast<std::size_t>(MeasurementRow::Yaw);

// Up to nine rows, without the heap.
using RowVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 9, 1>;
using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 9, 9>;
using StateRowMatrix = Eigen::Matrix<double, kStates, Eigen::Dynamic, 0, kStates, 9>;

double squared(double x) {
    return x * x;
}

Matrix9d symmetric(const Matrix9d& P) {
    return 0.5 * (P + P.transpose());
}

double course(const Vector9d& state) {
    return std::atan2(state[1], state[0]);
}

/// The rows of one epoch that an update takes.
struct EpochRows {
    std::vector<std::size_t> rows;  // in the order of MeasurementRow
    RowVector z;
    RowVector variance;

    Eigen::Index size() const { return z.size(); }
    RowVector measured(const Vector9d& state) const {
        RowVector y(size());
        for (std::size_t i = 0; i < rows.size(); ++i) {
            const int k = kStateOfRow[rows[i]];
            y[static_cast<Eigen::Index>(i)] = k == kNoState ? course(state) : state[k];
        }
        return y;
    }
    RowVector difference(const RowVector& a, const RowVector& b) const {
        RowVector d = a - b;
        for (std::size_t i = 0; i < rows.size(); ++i) {
            if (rows[i] == kYaw) d[static_cast<Eigen::Index>(i)] = wrapAngle(d[static_cast<Eigen::Index>(i)]);
        }
        return d;
    }
};

EpochRows rowsOf(const MeasurementEpoch& epoch, RowSet used) {
    EpochRows rows;
    for (std::size_t row = 0; row < kRowCount; ++row) {
        if ((used & rowBit(row)) != 0) rows.rows.push_back(row);
    }
    const auto m = static_cast<Eigen::Index>(rows.rows.size());
    rows.z.resize(m);
    rows.variance.resize(m);
    for (Eigen::Index i = 0; i < m; ++i) {
        rows.z[i] = epoch.z[rows.rows[static_cast<std::size_t>(i)]];
        rows.variance[i] = epoch.variance[rows.rows[static_cast<std::size_t>(i)]];
    }
    return rows;
}

/// Sums nu' S^-1 nu for each sensor.
class ConsistencySums {
  public:
    explicit ConsistencySums(const RowSensors& sensors) : sensors_(sensors) {}
    // Of rows that one update takes together.
    void add(const EpochRows& rows, const RowVector& innovation, const RowMatrix& S) {
        for (std::size_t from = 0; from < rows.rows.size();) {
            const Sensor sensor = sensors_[rows.rows[from]];
            std::size_t to = from + 1;
            while (to < rows.rows.size() && sensors_[rows.rows[to]] == sensor) ++to;
            const auto at = static_cast<Eigen::Index>(from);
            const auto m = static_cast<Eigen::Index>(to - from);
            const RowMatrix own = S.block(at, at, m, m);
            const RowVector nu = innovation.segment(at, m);
            Sum& sum = sums_[static_cast<std::size_t>(sensor)];
            sum.nis += nu.dot(own.ldlt().solve(nu));
            sum.dof += static_cast<double>(m);
            ++sum.n;
            from = to;
        }
    }
    // Of a row that is taken by itself, after `taken` of the same epoch.
    void add(std::size_t row, RowSet taken, double nis) {
        Sum& sum = sums_[static_cast<std::size_t>(sensors_[row])];
        sum.nis += nis;
        sum.dof += 1.0;
        bool first = true;
        for (std::size_t other = 0; other < kRowCount; ++other) {
            if (sensors_[other] == sensors_[row] && (taken & rowBit(other)) != 0) first = false;
        }
        if (first) ++sum.n;
    }
    std::vector<SensorConsistency> means() const {
        std::vector<SensorConsistency> means;
        for (std::size_t i = 0; i < kSensorCount; ++i) {
            const Sum& sum = sums_[i];
            if (sum.n == 0) continue;
            const auto n = static_cast<double>(sum.n);
            means.push_back({std::string(name(static_cast<Sensor>(i))), sum.n, sum.dof / n, sum.nis / n});
        }
        return means;
    }

  private:
    struct Sum {
        std::size_t n = 0;
        double nis = 0.0;
        double dof = 0.0;
    };
    RowSensors sensors_;
    std::array<Sum, kSensorCount> sums_{};
};

// Every filter: estimate(), predict(F, q), and update(epoch, used) which returns the rows that it took.

class ExtendedFilter {
  public:
    ExtendedFilter(const StateEstimate& start, const AukfOptions&) : state_(start) {}
    const StateEstimate& estimate() const { return state_; }
    void predict(const Matrix9d& F, const Vector9d& q) {
        state_.mean = F * state_.mean;
        Matrix9d P = F * state_.covariance * F.transpose();
        P.diagonal() += q;
        state_.covariance = symmetric(P);
    }
    RowSet update(const MeasurementEpoch& epoch, RowSet used, ConsistencySums& consistency) {
        const EpochRows rows = rowsOf(epoch, used);
        const auto m = rows.size();
        Eigen::Matrix<double, Eigen::Dynamic, kStates, 0, 9, kStates> H(m, kStates);
        H.setZero();
        for (Eigen::Index i = 0; i < m; ++i) {
            const int k = kStateOfRow[rows.rows[static_cast<std::size_t>(i)]];
            if (k != kNoState) {
                H(i, k) = 1.0;
            } else {
                const double speed2 = state_.mean.head<2>().squaredNorm();
                H(i, 0) = -state_.mean[1] / speed2;
                H(i, 1) = state_.mean[0] / speed2;
            }
        }
        const RowVector nu = rows.difference(rows.z, rows.measured(state_.mean));
        const StateRowMatrix PH = state_.covariance * H.transpose();
        RowMatrix S = H * PH;
        S.diagonal() += rows.variance;
        consistency.add(rows, nu, S);
        const StateRowMatrix K = S.ldlt().solve(PH.transpose()).transpose();
        // Joseph's form
        const Matrix9d I_KH = Matrix9d::Identity() - K * H;
        const Matrix9d P =
            I_KH * state_.covariance * I_KH.transpose() + K * rows.variance.asDiagonal() * K.transpose();
        state_.mean += K * nu;
        state_.covariance = symmetric(P);
        return used;
    }

  private:
    StateEstimate state_;
};

/// Deviations of 2 x 9 sigma points from their centre, column by column.
struct SigmaWeights {
    explicit SigmaWeights(const UnscentedOptions& options)
        : root_spread(std::sqrt(sigmaPointSpread(options, kStates))),
          weight(0.5 / sigmaPointSpread(options, kStates)),
          centre(options.beta - squared(options.alpha)) {}
    double root_spread;
    double weight;
    double centre;  // of the mean shift's square; see unscentedTransform()
};

// Images of the sigma points of x +- root_spread * columns of L, as differences from the image of x.
struct MappedPoints {
    using Columns = Eigen::Matrix<double, Eigen::Dynamic, kStates, 0, 9, kStates>;
    RowVector centre;
    Columns above;
    Columns below;
    RowVector shift;  // mean less centre
};

template <class Function, class Difference>
MappedPoints mapped(const Vector9d& x, const Matrix9d& L, const SigmaWeights& weights, Function f,
                    Difference difference) {
    MappedPoints points;
    points.centre = f(x);
    const auto m = points.centre.size();
    points.above.resize(m, kStates);
    points.below.resize(m, kStates);
    for (int i = 0; i < kStates; ++i) {
        const Vector9d step = weights.root_spread * L.col(i);
        points.above.col(i) = difference(f(x + step), points.centre);
        points.below.col(i) = difference(f(x - step), points.centre);
    }
    points.shift = weights.weight * (points.above + points.below).rowwise().sum();
    return points;
}

MappedPoints mappedByMotion(const Vector9d& x, const Matrix9d& L, const Matrix9d& F,
                            const SigmaWeights& weights) {
    return mapped(
        x, L, weights, [&](const Vector9d& point) -> RowVector { return F * point; },
        [](const RowVector& a, const RowVector& b) -> RowVector { return a - b; });
}

MappedPoints mappedByRows(const Vector9d& x, const Matrix9d& L, const EpochRows& rows,
                          const SigmaWeights& weights) {
    return mapped(
        x, L, weights, [&](const Vector9d& point) { return rows.measured(point); },
        [&](const RowVector& a, const RowVector& b) { return rows.difference(a, b); });
}

class SigmaPointFilter {
  public:
    SigmaPointFilter(const StateEstimate& start, const AukfOptions& options)
        : state_(start), weights_(sigmaPointOptions(options)) {}
    const StateEstimate& estimate() const { return state_; }
    void predict(const Matrix9d& F, const Vector9d& q) {
        const MappedPoints points = mappedByMotion(state_.mean, root(), F, weights_);
        state_.mean = points.centre + points.shift;
        Matrix9d P = covarianceOf(points);
        P.diagonal() += q;
        state_.covariance = symmetric(P);
    }
    RowSet update(const MeasurementEpoch& epoch, RowSet used, ConsistencySums& consistency) {
        const EpochRows rows = rowsOf(epoch, used);
        const Matrix9d L = root();
        const MappedPoints points = mappedByRows(state_.mean, L, rows, weights_);
        RowMatrix S = covarianceOf(points);
        S.diagonal() += rows.variance;
        const StateRowMatrix C =
            weights_.weight * weights_.root_spread * L * (points.above - points.below).transpose();
        const RowVector nu = rows.difference(rows.z, points.centre + points.shift);
        consistency.add(rows, nu, S);
        const StateRowMatrix K = S.ldlt().solve(C.transpose()).transpose();
        state_.mean += K * nu;
        state_.covariance = symmetric(state_.covariance - K * S * K.transpose());
        return used;
    }

  private:
    Matrix9d root() const { return state_.covariance.llt().matrixL(); }
    RowMatrix covarianceOf(const MappedPoints& points) const {
        return weights_.weight *
                   (points.above * points.above.transpose() + points.below * points.below.transpose()) +
               weights_.centre * points.shift * points.shift.transpose();
    }

    StateEstimate state_;
    SigmaWeights weights_;
};

// Lower triangular L with L L' = A A'.
template <class Wide>
RowMatrix triangular(const Wide& A) {
    const Eigen::Index m = A.rows();
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 27, 9> transposed = A.transpose();
    const Eigen::HouseholderQR<decltype(transposed)> qr(transposed);
    RowMatrix L = qr.matrixQR().topRows(m).template triangularView<Eigen::Upper>().transpose();
    for (Eigen::Index i = 0; i < m; ++i) {
        if (L(i, i) < 0.0) L.col(i) = -L.col(i);
    }
    return L;
}

// L L' + sign v v', by Givens or hyperbolic rotations. Not finite where a downdate leaves no positive
// definite matrix. Source: Golub and Van Loan, section 6.5.4.
template <class Triangle, class Vector>
void rankOne(Triangle& L, Vector v, double sign) {
    const Eigen::Index m = L.rows();
    for (Eigen::Index k = 0; k < m; ++k) {
        const double r = std::sqrt(squared(L(k, k)) + sign * squared(v[k]));
        const double c = r / L(k, k);
        const double s = v[k] / L(k, k);
        L(k, k) = r;
        for (Eigen::Index i = k + 1; i < m; ++i) {
            L(i, k) = (L(i, k) + sign * s * v[i]) / c;
            v[i] = c * v[i] - s * L(i, k);
        }
    }
}

class SquareRootFilter {
  public:
    SquareRootFilter(const StateEstimate& start, const AukfOptions& options)
        : state_(start), root_(start.covariance.llt().matrixL()), weights_(options.unscented) {}
    const StateEstimate& estimate() const { return state_; }
    void predict(const Matrix9d& F, const Vector9d& q) {
        const MappedPoints points = mappedByMotion(state_.mean, root_, F, weights_);
        state_.mean = points.centre + points.shift;
        root_ = rootOf(points, q);
        state_.covariance = root_ * root_.transpose();
    }
    RowSet update(const MeasurementEpoch& epoch, RowSet used, ConsistencySums& consistency) {
        const EpochRows rows = rowsOf(epoch, used);
        const MappedPoints points = mappedByRows(state_.mean, root_, rows, weights_);
        const RowMatrix root_S = rootOf(points, rows.variance);
        const StateRowMatrix C =
            weights_.weight * weights_.root_spread * root_ * (points.above - points.below).transpose();
        const RowVector nu = rows.difference(rows.z, points.centre + points.shift);
        consistency.add(rows, nu, root_S * root_S.transpose());
        // U = K S^(1/2) = C S^(-T/2)
        const StateRowMatrix U = root_S.triangularView<Eigen::Lower>().solve(C.transpose()).transpose();
        state_.mean += U * root_S.triangularView<Eigen::Lower>().solve(nu);
        for (Eigen::Index i = 0; i < rows.size(); ++i) rankOne(root_, Vector9d(U.col(i)), -1.0);
        state_.covariance = root_ * root_.transpose();
        return used;
    }

  private:
    RowMatrix rootOf(const MappedPoints& points, const RowVector& variance) const {
        const Eigen::Index m = points.centre.size();
        Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 9, 27> wide(m, 2 * kStates + m);
        const double w = std::sqrt(weights_.weight);
        wide.leftCols(kStates) = w * points.above;
        wide.middleCols(kStates, kStates) = w * points.below;
        wide.rightCols(m).setZero();
        wide.rightCols(m).diagonal() = variance.cwiseSqrt();
        RowMatrix L = triangular(wide);
        const double sign = weights_.centre < 0.0 ? -1.0 : 1.0;
        rankOne(L, RowVector(std::sqrt(std::abs(weights_.centre)) * points.shift), sign);
        return L;
    }

    StateEstimate state_;
    Matrix9d root_;
    SigmaWeights weights_;
};

/// Measurement noise of one row that follows its innovations; paper 004.
class AdaptiveNoise {
  public:
    /// @param rho  nu^2 - H P H' over the sensor's own variance
    /// @return the factor on that variance; nothing when the reading is to be left out
    std::optional<double> adapted(double rho, const SageHusaOptions& options) {
        beta_ = beta_ / (beta_ + options.forgetting);
        if (rho > options.greatest_factor) {
            factor_ = options.greatest_factor;
            return std::nullopt;
        }
        factor_ = (1.0 - beta_) * factor_ + beta_ * std::max(rho, options.least_factor);
        return factor_;
    }

  private:
    double beta_ = 1.0;
    double factor_ = 1.0;
};

class AdaptiveFilter {
  public:
    AdaptiveFilter(const StateEstimate& start, const AukfOptions& options)
        : state_(start), options_(options) {}
    const StateEstimate& estimate() const { return state_; }
    void predict(const Matrix9d& F, const Vector9d& q) {
        state_ = predicted(state_, {F, Matrix9d(q.asDiagonal())});
    }
    RowSet update(const MeasurementEpoch& epoch, RowSet offered, ConsistencySums& consistency) {
        RowSet used = 0;
        // Linearised at the prediction, so before the other rows.
        if ((offered & rowBit(kYaw)) != 0) {
            const YawRow yaw{epoch.z[kYaw], epoch.variance[kYaw]};
            take(kYaw, linearised(state_, yaw, options_.unscented), epoch.variance[kYaw], used, consistency);
        }
        for (std::size_t row = 0; row < kRowCount; ++row) {
            if (row == kYaw || (offered & rowBit(row)) == 0) continue;
            const int k = kStateOfRow[row];
            const LinearRow linear{static_cast<StateBlock>(k / 3 * 3), Eigen::Vector3d::Unit(k % 3),
                                   epoch.z[row], epoch.variance[row]};
            take(row, linear, epoch.variance[row], used, consistency);
        }
        return used;
    }

  private:
    // `sensor_variance`: the part of the row's variance that is the sensor's and adapts.
    void take(std::size_t row, LinearRow linear, double sensor_variance, RowSet& used,
              ConsistencySums& consistency) {
        const double others = predictedVariance(state_, linear) + (linear.variance - sensor_variance);
        const double nu = innovation(state_, linear);
        const auto factor = noise_[row].adapted((squared(nu) - others) / sensor_variance, options_.adaptive);
        if (!factor) return;
        linear.variance += (*factor - 1.0) * sensor_variance;
        consistency.add(row, used, squared(nu) / (predictedVariance(state_, linear) + linear.variance));
        state_ = updated(state_, linear);
        used = static_cast<RowSet>(used | rowBit(row));
    }

    StateEstimate state_;
    AukfOptions options_;
    std::array<AdaptiveNoise, kRowCount> noise_{};
};

template <class Filter>
Result<FilteredRun> filteredBy(const MeasuredRun& run, const AukfOptions& options,
                               const std::stop_token& stop) {
    Filter filter(run.start, options);
    ConsistencySums consistency(run.sensors);
    FilteredRun filtered;
    filtered.states.reserve(run.epochs.size());
    filtered.used.reserve(run.epochs.size());
    const double slowest2 = squared(options.yaw_row.slowest_mps);
    double time_s = 0.0;
    for (std::size_t i = 0; i < run.epochs.size(); ++i) {
        if (i % 256 == 0 && stop.stop_requested()) return cancelled();
        const MeasurementEpoch& epoch = run.epochs[i];
        time_s += epoch.dt_s;
        if (epoch.dt_s > 0.0) {
            filter.predict(constantAccelerationMatrix(epoch.dt_s), stepNoiseDiagonal(options, epoch.dt_s));
        }
        RowSet used = epoch.present;
        // At rest the course has no meaning.
        if (!(filter.estimate().mean.template head<2>().squaredNorm() >= slowest2)) {
            used = static_cast<RowSet>(used & ~rowBit(kYaw));
        }
        if (used != 0) used = filter.update(epoch, used, consistency);
        if (!filter.estimate().finite()) {
            return badData(
                fmt::format("run {}: the filter diverged {:.2f} s after its start", run.run_id, time_s), {},
                0, "try other process noise, or --method ukf");
        }
        filtered.states.push_back(filter.estimate());
        filtered.used.push_back(used);
    }
    filtered.consistency = consistency.means();
    return filtered;
}

}  // namespace

UnscentedOptions sigmaPointOptions(const AukfOptions& options) {
    return options.filter == FilterKind::Ckf ? UnscentedOptions{1.0, 0.0, 0.0} : options.unscented;
}

Result<FilteredRun> filterRun(const MeasuredRun& run, const AukfOptions& options, std::stop_token stop) {
    switch (options.filter) {
        case FilterKind::Ekf:
            return filteredBy<ExtendedFilter>(run, options, stop);
        case FilterKind::Ckf:
        case FilterKind::Ukf:
            return filteredBy<SigmaPointFilter>(run, options, stop);
        case FilterKind::SquareRootUkf:
            return filteredBy<SquareRootFilter>(run, options, stop);
        case FilterKind::AdaptiveUkf:
            return filteredBy<AdaptiveFilter>(run, options, stop);
    }
    return usageError("unknown filter");
}

}  // namespace terrawalk
