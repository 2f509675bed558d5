#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "fusion/sensor_readings.hpp"
#include "survey/trajectory.hpp"

namespace terrawalk {

/// Counts what became of every reading of a run.
class SensorLedger {
  public:
    void use(Sensor sensor, bool down_weighted);
    void reject(Sensor sensor, std::string_view reason);
    /// The sensors that offered anything, in the order of `Sensor`.
    [[nodiscard]] std::vector<SensorUse> uses() const;

  private:
    SensorUse& of(Sensor sensor) { return uses_[static_cast<std::size_t>(sensor)]; }

    std::array<SensorUse, kSensorCount> uses_;
};

}  // namespace terrawalk
