#include "app/pipeline/crossover_misfit.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include "fusion/crossovers.hpp"
#include "mapping/order_statistics.hpp"

namespace terrawalk {

CrossoverMisfit crossoverMisfit(const GroundTrack& track) {
    std::vector<GroundSample> samples;
    for (const GroundPoint& point : track.points) {
        if (point.state == GroundPointState::Used) {
            samples.push_back({point.run, point.epoch, point.time_s, point.enu_m});
        }
    }
    CrossoverOptions options;
    options.gate_m = 0.5;
    options.apart_s = 20.0;
    std::vector<double> misfits_m;
    double squares = 0.0;
    for (const Crossover& crossover : findCrossovers(samples, options)) {
        misfits_m.push_back(std::abs(crossover.misfit_m));
        squares += crossover.misfit_m * crossover.misfit_m;
    }
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    if (misfits_m.empty()) return {kNone, kNone, 0};
    const std::size_t count = misfits_m.size();
    return {std::sqrt(squares / static_cast<double>(count)), median(std::move(misfits_m)), count};
}

}  // namespace terrawalk
