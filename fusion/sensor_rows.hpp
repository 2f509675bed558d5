#pragma once

#include <cstddef>
#include <vector>

#include "fusion/fusion_options.hpp"
#include "fusion/run_model.hpp"
#include "fusion/sparse_least_squares.hpp"

namespace terrawalk {

/// Puts what the sensors of a run say into the joint adjustment, one kind of sensor after the other; see
/// adjustJointly() for what the rows mean. For one round; not thread-safe.
class SensorRows {
  public:
    /// @param shared   what all runs share
    /// @param settled  whether the track is near its place
    SensorRows(const FusionOptions& options, const SharedErrors& shared, bool settled,
               SparseLeastSquares& system)
        : options_(options), shared_(shared), settled_(settled), system_(system) {}

    void addArray();
    void addRun(RunModel& run);  ///< all of its sensors, and its ties
    void addTies(const RunModel& run);

  private:
    // position_rows.cpp
    void addStart(const RunModel& run);
    void addGnss(const RunModel& run);
    void addGnssBias(const RunModel& run);
    void addGaussMarkov(const KnotChain& chain, std::size_t part, double sigma, double correlation_s,
                        std::size_t group);
    void addDoppler(const RunModel& run);
    // height_rows.cpp
    void addBarometer(const RunModel& run);
    double aboveGround(const RunModel& run, double time_s);
    void addClimb(RunModel& run);
    // heading_rows.cpp
    void addFlow(const RunModel& run);
    void addHeading(const RunModel& run);
    void addGyro(const RunModel& run);
    void addCompass(const RunModel& run);
    void turnedBy(const RunModel& run, double time_s, double change);
    // motion_rows.cpp
    void addWalk(const RunModel& run);
    std::vector<double> yawOfSteps(const RunModel& run) const;
    void addAcceleration(const RunModel& run);

    void position(const RunModel& run, std::size_t epoch, std::size_t axis, double factor) {
        run.correction.addTo(row_, run.at[epoch], factor, axis);
    }

    const FusionOptions& options_;
    const SharedErrors& shared_;
    bool settled_;
    SparseLeastSquares& system_;
    RowTerms row_;
    std::vector<double> scratch_;
};

}  // namespace terrawalk
