#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "fusion/innovation_record.hpp"
#include "fusion/sensor_ledger.hpp"
#include "fusion/sensor_readings.hpp"
#include "survey/result.hpp"
#include "survey/survey.hpp"

namespace terrawalk {

/// What a row tells against the state: value less prediction, and the sigma of that by the sensor's own
/// (gate) variance.
struct RowTest {
    double innovation = 0.0;
    double sigma = 1.0;
};

/// The states of a filter, as RunFilter works on them. `row` is the number of a row of the reading.
class FilterModel {
  public:
    virtual ~FilterModel() = default;
    /// From the epoch before `epoch`, which is > 0, to it.
    virtual void predict(std::size_t epoch) = 0;
    /// Position and velocity as they are now; of the covariance only what the model has.
    [[nodiscard]] virtual StateEstimate prediction() const = 0;
    [[nodiscard]] virtual Eigen::Matrix3d positionCovariance() const = 0;
    [[nodiscard]] virtual bool finite() const = 0;
    [[nodiscard]] virtual RowTest test(std::size_t epoch, const Reading& reading, std::size_t row) const = 0;
    /// Takes one row, its variance multiplied by `excess`.
    virtual void update(std::size_t epoch, const Reading& reading, std::size_t row, double excess) = 0;
    /// Whether update() takes the reading with more noise than its sensor has, for a reason of the model's
    /// own.
    [[nodiscard]] virtual bool doubts(std::size_t /*epoch*/, const Reading& /*reading*/) const {
        return false;
    }
    /// Takes a row of position or velocity that no sensor gave: a mark, or how people walk.
    virtual void assume(const LinearRow& row) = 0;
    /// Keeps the height near that of the start where nothing measures it.
    virtual void holdHeight() = 0;
    /// Doubts itself so far that the reading, steadily rejected until now, passes the gate.
    virtual void readmit(std::size_t epoch, const Reading& reading) = 0;
};

/// For how long the readings of a sensor have told the same thing. Silence tells nothing: a gap ends it.
class Spell {
  public:
    void tell(bool so, double time_s, double longest_gap_s);
    /// Up to a reading at `time_s`; not a number when there is no spell.
    [[nodiscard]] double lasted(double time_s, double longest_gap_s) const;

  private:
    double since_s_ = std::numeric_limits<double>::quiet_NaN();
    double last_s_ = std::numeric_limits<double>::quiet_NaN();
};

/// Takes one run through a filter, epoch by epoch: readings, gates, Huber weights, ties to marks,
/// re-admission of sensors, and the watch over divergence. Refers to its arguments, which must outlive it.
class RunFilter {
  public:
    RunFilter(const ReadingContext& context, const Run& run, FilterModel& model)
        : context_(context), run_(run), model_(model) {}

    /// Nothing, or why the run must be given up.
    [[nodiscard]] std::optional<Error> step(std::size_t epoch);
    /// Whether a reading of the sensor was dropped in the latest epoch because it lay beyond the gate.
    [[nodiscard]] bool gated(Sensor sensor) const { return gated_[static_cast<std::size_t>(sensor)]; }
    [[nodiscard]] std::vector<SensorUse> sensors() const { return ledger_.uses(); }
    [[nodiscard]] std::vector<SensorInnovations> innovations() const { return record_.sensors(); }
    /// Adds what a reader of the result should know.
    void note(std::vector<std::string>& notes) const;

  private:
    double time(std::size_t epoch) const { return context_.log.time_s[epoch]; }
    Spell& rejectionOf(Sensor sensor) { return rejections_[static_cast<std::size_t>(sensor)]; }
    double worstDeviation(std::size_t epoch, const Reading& reading) const;
    void applyTies(std::size_t epoch);
    void readmit(std::size_t epoch);
    void applyReading(std::size_t epoch, const Reading& reading);
    void remember(std::size_t epoch, const Reading& reading);
    void holdClimb(std::size_t epoch);
    void watchGnss(std::size_t epoch, const Reading& reading, bool outside);
    std::optional<Error> divergence(std::size_t epoch) const;
    Error diverged(std::size_t epoch, const std::string& why) const;

    const ReadingContext& context_;
    const Run& run_;
    FilterModel& model_;
    SensorMemory memory_;
    SensorLedger ledger_;
    InnovationRecord record_;
    std::vector<Reading> readings_;
    std::array<Spell, kSensorCount> rejections_{};
    std::array<bool, kSensorCount> gated_{};
    std::size_t readmissions_ = 0;
    std::size_t next_tie_ = 0;
    Spell far_;
    double far_for_s_ = std::numeric_limits<double>::quiet_NaN();
    double gnss_seen_s_ = std::numeric_limits<double>::quiet_NaN();
    double rejected_share_ = 0.0;
    int rejected_positions_ = 0;
    double bridged_s_ = 0.0;
};

}  // namespace terrawalk
