#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string>
#include <vector>

#include "survey/frames.hpp"

namespace terrawalk {

using Matrix6d = Eigen::Matrix<double, 6, 6>;

/// State of the array in one epoch of its log. Covariance order: position e, n, u [m], velocity e, n, u
/// [m/s].
struct TrajectoryEpoch {
    double time_s = 0.0;
    Eigen::Vector3d position_enu_m =
        Eigen::Vector3d::Zero();  ///< origin of the array, not the ground below it
    Eigen::Vector3d velocity_enu_mps = Eigen::Vector3d::Zero();
    Matrix6d covariance = Matrix6d::Zero();
    Attitude attitude;
    double sigma_tilt_rad = 0.0;  ///< roll and pitch, 1 sigma each
    double sigma_heading_rad = 0.0;
};

/// One epoch for each epoch of the log, in the same order.
struct Trajectory {
    std::string run_id;
    std::vector<TrajectoryEpoch> epochs;
};

/// What became of one sensor's measurements in one run: offered = used + sum of rejections.
struct SensorUse {
    struct Rejection {
        std::string reason;
        std::size_t count = 0;
    };
    std::string sensor;  ///< e.g. "GNSS position", "barometer"
    std::size_t offered = 0;
    std::size_t used = 0;
    std::size_t down_weighted = 0;  ///< of the used ones
    std::vector<Rejection> rejections;
};

/// Whether a sensor's innovations are as large as the filter says: the mean of nu' S^-1 nu over its readings
/// in one run. Near `dof` when the sigmas are right, above when the filter is too sure. Source: Bar-Shalom,
/// Li and Kirubarajan 2001, section 5.4.
struct SensorConsistency {
    std::string sensor;
    std::size_t n = 0;      ///< readings that an update took
    double dof = 0.0;       ///< rows per reading
    double mean_nis = 0.0;  ///< normalised innovation squared
};

/// What a filter was surprised by: one reading of a sensor, or the worst of some that follow one another.
struct Innovation {
    double time_s = 0.0;
    float over_sigma = 0.0F;  ///< value less prediction of the worst row, over the sigma of that
    bool used = true;         ///< not beyond the gate
};

struct SensorInnovations {
    SensorConsistency consistency;     ///< names the sensor; of the readings that were used
    std::vector<Innovation> readings;  ///< in time order; empty from methods that keep only sums
};

/// What a reader of the results should know of a run, in plain words.
struct RunNotes {
    std::vector<std::string> limitations;  ///< what the log lacks as a whole, and what stands in for it
    std::vector<std::string> details;      ///< what happened on the way
};

/// A source of noise in the adjustment of all runs, and by what factor the survey's own residuals say that
/// its sigma is off.
struct NoiseFactor {
    std::string source;
    std::size_t rows = 0;
    double redundancy = 0.0;  ///< rows less what the unknowns took of them
    double factor = 1.0;
    std::size_t down_weighted = 0;  ///< rows that count for less than half
};

/// How honest predicted sigmas are, by n differences that they had no part in.
struct SigmaCoverage {
    std::size_t n = 0;
    std::size_t within = 0;    ///< 1.96 sigma; 95 % of n is right
    double mean_square = 0.0;  ///< of difference over sigma; 1 is right
    void add(double difference, double sigma) {
        const double square = difference * difference / (sigma * sigma);
        if (square <= 1.96 * 1.96) ++within;
        ++n;
        mean_square += (square - mean_square) / static_cast<double>(n);
    }
};

/// What the adjustment of all runs came to.
struct AdjustmentSummary {
    std::size_t unknowns = 0;
    std::size_t crossovers = 0;    ///< pairs of passes over the same ground
    double misfit_before_m = 0.0;  ///< RMS of their heights' differences on the filter's tracks
    double misfit_after_m = 0.0;
    struct LeftOut {
        std::size_t n = 0;
        double before_m = 0.0, after_m = 0.0;  ///< as above
    };
    LeftOut left_out;  ///< crossovers that only test, where the options ask for some
    /// Misfits of crossovers over their predicted sigma, before the crossovers had a part in the tracks.
    /// Passes of one run close in time share their errors and do not count.
    SigmaCoverage crossover_test;
    double height_inflation = 1.0;    ///< factor on the variance of heights that follows from this test
    double plan_inflation = 1.0;      ///< factor on the variance of the plan, from the tails of GNSS drift
    bool flow_scale_wanders = false;  ///< whether residuals said so, and it was estimated
    int rounds = 0;                   ///< with crossovers
    double last_step_m = 0.0;  ///< RMS by which the last of them moved the run that moved most, in plan
    bool settled = false;      ///< whether that is little enough
    std::vector<NoiseFactor> noise;
};

/// A run after fusion (or without it, in raw mode).
struct FusedRun {
    Trajectory trajectory;
    std::vector<SensorUse> sensors;
    RunNotes notes;
    std::vector<SensorConsistency> consistency;  ///< from methods that compute it
    std::vector<SensorInnovations> innovations;  ///< from methods that filter epoch by epoch
};

}  // namespace terrawalk
