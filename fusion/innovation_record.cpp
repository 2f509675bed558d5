#include "fusion/innovation_record.hpp"

#include <cmath>

namespace terrawalk {

namespace {

const Innovation& fartherOff(const Innovation& a, const Innovation& b) {
    return std::abs(b.over_sigma) > std::abs(a.over_sigma) ? b : a;
}

}  // namespace

void InnovationRecord::add(Sensor sensor, double time_s, double over_sigma, bool used) {
    Kept& kept = kept_[static_cast<std::size_t>(sensor)];
    const Innovation reading{time_s, static_cast<float>(over_sigma), used};
    if (kept.in_last > 0 && kept.in_last < kept.each_stands_for) {
        kept.readings.back() = fartherOff(kept.readings.back(), reading);
        ++kept.in_last;
        return;
    }
    if (kept.readings.size() == 2 * kKept) {
        for (std::size_t i = 0; i < kKept; ++i) {
            kept.readings[i] = fartherOff(kept.readings[2 * i], kept.readings[2 * i + 1]);
        }
        kept.readings.resize(kKept);
        kept.each_stands_for *= 2;
    }
    kept.readings.push_back(reading);
    kept.in_last = 1;
}

void InnovationRecord::addNis(Sensor sensor, double nis, std::size_t rows) {
    Kept& kept = kept_[static_cast<std::size_t>(sensor)];
    kept.nis += nis;
    kept.rows += rows;
    ++kept.n;
}

std::vector<SensorInnovations> InnovationRecord::sensors() const {
    std::vector<SensorInnovations> list;
    for (std::size_t i = 0; i < kSensorCount; ++i) {
        const Kept& kept = kept_[i];
        if (kept.readings.empty()) continue;
        SensorInnovations sensor;
        sensor.readings = kept.readings;
        sensor.consistency.sensor = name(static_cast<Sensor>(i));
        sensor.consistency.n = kept.n;
        if (kept.n > 0) {
            const auto n = static_cast<double>(kept.n);
            sensor.consistency.dof = static_cast<double>(kept.rows) / n;
            sensor.consistency.mean_nis = kept.nis / n;
        }
        list.push_back(std::move(sensor));
    }
    return list;
}

}  // namespace terrawalk
