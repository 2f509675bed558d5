#include "mapping/dem_difference.hpp"

#include <cassert>
#include <cmath>

namespace terrawalk {

namespace {

constexpr std::size_t kCellsBetweenStops = 1U << 20U;
constexpr double kNormal95 = 1.959963984540054;  // two-sided

}  // namespace

Result<DemDifference> demDifference(const ElevationGrid& later, const ElevationGrid& earlier,
                                    const VolumeErrorModel& errors, const std::stop_token& stop) {
    assert(later.geometry == earlier.geometry);
    DemDifference d;
    d.change = later;
    if (stop.stop_requested()) return cancelled();
    for (std::size_t cell = 0; cell < d.change.heights_m.size(); ++cell) {
        d.change.heights_m[cell] -= earlier.heights_m[cell];
    }
    d.significance = d.change;
    ElevationGrid significant = d.change;
    for (std::size_t cell = 0; cell < d.change.heights_m.size(); ++cell) {
        if (cell % kCellsBetweenStops == 0 && stop.stop_requested()) return cancelled();
        const double change = d.change.heights_m[cell];
        if (std::isnan(change)) continue;
        const double own = errors.sigmas_m.size() == 1 ? errors.sigmas_m.front() : errors.sigmas_m[cell];
        const bool beyond = std::abs(change) > kNormal95 * std::hypot(own, errors.common_sigma_m);
        d.significance.heights_m[cell] = !beyond ? 0.0F : change > 0.0 ? 1.0F : -1.0F;
        d.raised += beyond && change > 0.0 ? 1 : 0;
        d.lowered += beyond && change < 0.0 ? 1 : 0;
        if (!beyond) significant.heights_m[cell] = kNoHeight;
    }
    auto all = volumeOf(d.change, errors, stop);
    if (!all) return tl::unexpected(all.error());
    auto beyond_error = volumeOf(significant, errors, stop);
    if (!beyond_error) return tl::unexpected(beyond_error.error());
    d.all = *all;
    d.significant = *beyond_error;
    return d;
}

}  // namespace terrawalk
