#include "fusion/sensor_ledger.hpp"

#include <algorithm>
#include <string>

namespace terrawalk {

void SensorLedger::use(Sensor sensor, bool down_weighted) {
    SensorUse& use = of(sensor);
    ++use.offered;
    ++use.used;
    if (down_weighted) ++use.down_weighted;
}

void SensorLedger::reject(Sensor sensor, std::string_view reason) {
    SensorUse& use = of(sensor);
    ++use.offered;
    auto found =
        std::find_if(use.rejections.begin(), use.rejections.end(),
                     [&](const SensorUse::Rejection& rejection) { return rejection.reason == reason; });
    if (found == use.rejections.end()) {
        found = use.rejections.insert(use.rejections.end(), SensorUse::Rejection{std::string(reason), 0});
    }
    ++found->count;
}

std::vector<SensorUse> SensorLedger::uses() const {
    std::vector<SensorUse> offered;
    for (std::size_t i = 0; i < kSensorCount; ++i) {
        if (uses_[i].offered == 0) continue;
        offered.push_back(uses_[i]);
        offered.back().sensor = name(static_cast<Sensor>(i));
    }
    return offered;
}

}  // namespace terrawalk
