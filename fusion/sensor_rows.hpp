#pragma once

#include <cstddef>
#include <vector>

#include "fusion/fusion_options.hpp"
#include "fusion/run_model.hpp"
#include "fusion/sparse_least_squares.hpp"

namespace terrawalk {

/// Whether errors of the flow along the way go together, by its residuals over stretches of half a minute.
class FlowTest {
  public:
    /// @param square  of a stretch's sum of errors over what independent errors give
    /// @param share   variance of its way by the flow over that by GNSS: where GNSS tells little, the track
    ///                follows the flow, and little of its errors is left to be seen
    void add(double square, double share) {
        squares_ += square;
        expected_ += share / (1.0 + share);
        ++stretches_;
    }
    [[nodiscard]] bool goTogether() const {
        constexpr std::size_t kFewest = 10;
        constexpr double kOfOtherModels = 0.5;  // what seems to go together and is no error of scale
        constexpr double kTimes = 2.0;
        return stretches_ >= kFewest &&
               squares_ > kOfOtherModels * static_cast<double>(stretches_) + kTimes * expected_;
    }

  private:
    double squares_ = 0.0;
    double expected_ = 0.0;  ///< of the squares when errors are independent
    std::size_t stretches_ = 0;
};

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
    [[nodiscard]] const FlowTest& flowTest() const { return flow_test_; }  ///< of the runs added

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
    // flow_rows.cpp
    void addFlow(const RunModel& run);
    void addFlowScale(const RunModel& run);
    // heading_rows.cpp
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
    FlowTest flow_test_;
};

}  // namespace terrawalk
