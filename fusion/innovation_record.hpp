#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "fusion/sensor_readings.hpp"
#include "survey/trajectory.hpp"

namespace terrawalk {

/// Keeps what a filter was surprised by, in little memory however long a run is: where there are too many
/// readings of a sensor, neighbours become one, and the one that is farther off stands for both.
class InnovationRecord {
  public:
    /// Of one sensor; twice as many readings are kept at most before neighbours are joined.
    static constexpr std::size_t kKept = 16'384;

    /// @param over_sigma  innovation of the worst row over its sigma, with its sign
    void add(Sensor sensor, double time_s, double over_sigma, bool used);
    /// Of one reading that was used: the sum of its rows' squares of that, and how many rows.
    void addNis(Sensor sensor, double nis, std::size_t rows);
    /// The sensors that offered anything, in the order of `Sensor`.
    [[nodiscard]] std::vector<SensorInnovations> sensors() const;

  private:
    struct Kept {
        std::vector<Innovation> readings;
        std::size_t each_stands_for = 1;
        std::size_t in_last = 0;  ///< readings that the last one stands for
        std::size_t n = 0, rows = 0;
        double nis = 0.0;
    };
    std::array<Kept, kSensorCount> kept_;
};

}  // namespace terrawalk
