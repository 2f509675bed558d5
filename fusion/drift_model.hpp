#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "fusion/run_filter.hpp"

namespace terrawalk {

/// The fifteen states of the filter with error states; local ENU, SI, angles in radians. Those that the
/// optical flow depends on stand first.
enum DriftState : int {
    kVelocityEast,
    kVelocityNorth,
    kFlowScale,     ///< flow read per flow; 1 without error
    kCompassError,  ///< yaw read less yaw, as far as it wanders
    kIronSin,       ///< hard iron: yaw read less yaw is A sin yaw + B cos yaw; this is A
    kIronCos,       ///< B
    kVelocityUp,
    kEast,
    kNorth,
    kUp,
    kBarometerDrift,
    kGust,
    kGnssErrorEast,
    kGnssErrorNorth,
    kGnssErrorUp,
};
inline constexpr int kDriftStates = 15;
using DriftVector = Eigen::Matrix<double, kDriftStates, 1>;
using DriftMatrix = Eigen::Matrix<double, kDriftStates, kDriftStates>;

struct DriftEstimate {
    DriftVector mean = DriftVector::Zero();
    DriftMatrix covariance = DriftMatrix::Zero();
};

/// x(t + dt) = F x(t) + w, w ~ (0, Q).
struct DriftTransition {
    DriftMatrix F;
    DriftMatrix Q;
};

/// One scalar measurement: value = direction . state + noise.
struct DriftRow {
    DriftVector direction = DriftVector::Zero();
    double value = 0.0;
    double variance = 1.0;
};

[[nodiscard]] double innovation(const DriftEstimate& state, const DriftRow& row);
/// Variance of the innovation, noise included.
[[nodiscard]] double innovationVariance(const DriftEstimate& state, const DriftRow& row);
/// The state after one row; Joseph's form, made symmetric.
[[nodiscard]] DriftEstimate updated(const DriftEstimate& state, const DriftRow& row);

/// Flow along a direction over ground, as the measured yaw has it:
///     z = s d . Rz(psi + A sin yaw + B cos yaw) v + noise,
/// taken through the unscented transform of (v_e, v_n, s, psi, A, B), 13 sigma points, and given as the
/// linear row that does the same. Followed by updated() it is the unscented update.
[[nodiscard]] DriftRow linearisedFlow(const DriftEstimate& state, const Eigen::Vector2d& direction,
                                      double yaw_rad, double value_mps, double variance,
                                      const UnscentedOptions& options);

/// Sigmas of the GNSS error state, and whether the receiver changed the kind of fix in this epoch: then the
/// error is another one, and the transition forgets the old.
struct GnssErrorStep {
    bool renewed = false;
    double sigma_m = 0.0;
    double sigma_up_m = 0.0;
};

/// Transition over any step dt_s > 0: exact for random walk, integrated random walk and Gauss-Markov states,
/// so gaps need no smaller steps.
[[nodiscard]] DriftTransition driftTransition(const FusionOptions& options, double dt_s,
                                              const GnssErrorStep& gnss);

/// The fifteen states of one run, for RunFilter. Remembers what the smoother needs to go back.
class DriftModel final : public FilterModel {
  public:
    explicit DriftModel(const ReadingContext& context);

    void predict(std::size_t epoch) override;
    [[nodiscard]] StateEstimate prediction() const override;
    [[nodiscard]] Eigen::Matrix3d positionCovariance() const override;
    [[nodiscard]] bool finite() const override;
    [[nodiscard]] RowTest test(std::size_t epoch, const Reading& reading, std::size_t row) const override;
    void update(std::size_t epoch, const Reading& reading, std::size_t row, double excess) override;
    [[nodiscard]] bool doubts(std::size_t epoch, const Reading& reading) const override;
    void assume(const LinearRow& row) override;
    void holdHeight() override;
    void readmit(std::size_t epoch, const Reading& reading) override;

    [[nodiscard]] const DriftEstimate& state() const { return state_; }
    [[nodiscard]] const std::vector<double>& gnssJumpSizes() const { return gnss_jump_m_; }
    /// Factor on the variance of a sensor, as its innovations have it.
    [[nodiscard]] double noiseFactor(Sensor sensor) const {
        return factors_[static_cast<std::size_t>(sensor)].value;
    }
    /// From the epoch before `epoch` into it, doubts at re-admissions included.
    [[nodiscard]] DriftTransition transitionInto(std::size_t epoch) const;

  private:
    struct NoiseFactor {
        double value = 1.0;
        double time_s = 0.0;      // of the latest reading
        double interval_s = 0.0;  // before it
    };
    struct Doubt {
        std::size_t epoch = 0;
        DriftVector variance = DriftVector::Zero();
    };
    GnssErrorStep gnssStep(std::size_t epoch);
    bool heightIsTold() const;
    DriftRow row(std::size_t epoch, const Reading& reading, std::size_t r) const;
    double jumpOf(std::size_t epoch, const Reading& reading) const;
    void adapt(std::size_t epoch, const Reading& reading, const DriftRow& row);

    const ReadingContext& context_;
    std::vector<double> gnss_jump_m_;  // of each epoch; see gnssJumps
    DriftEstimate state_;
    std::vector<GnssErrorStep> gnss_steps_;  // one for each epoch predicted into, from the first on
    std::vector<Doubt> doubts_;
    std::array<NoiseFactor, kSensorCount> factors_{};
    long fix_code_ = -1;  // of the latest position used; none yet
};

}  // namespace terrawalk
