#include "fusion/barometer.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "survey/frames.hpp"

namespace terrawalk {

namespace {

constexpr double kSeaLevelPressure_pa = 101325.0;
constexpr double kSeaLevelTemperature_k = 288.15;
constexpr double kLapseRate_kpm = 0.0065;
constexpr double kGasConstant_jpkgk = 287.05287;
constexpr double kExponent = kGasConstant_jpkgk * kLapseRate_kpm / kStandardGravity_mps2;

}  // namespace

double isaHeight(double pressure_pa) {
    if (!(pressure_pa > 0.0)) return std::numeric_limits<double>::quiet_NaN();
    // expm1 and log keep the digits of small height differences that 1 - pow() would lose.
    return -kSeaLevelTemperature_k / kLapseRate_kpm *
           std::expm1(kExponent * std::log(pressure_pa / kSeaLevelPressure_pa));
}

double isaPressure(double height_m) {
    return kSeaLevelPressure_pa *
           std::exp(std::log1p(-kLapseRate_kpm * height_m / kSeaLevelTemperature_k) / kExponent);
}

Result<PressureHeightFit> fitPressureToHeight(std::span<const PressureAtHeight> readings) {
    const std::size_t n = readings.size();
    if (n < 2) {
        return badData(fmt::format("a pressure-to-height fit needs at least two readings, there are {}", n),
                       {}, 0, "stand on marks of different height");
    }
    double mean_x = 0.0;
    double mean_y = 0.0;
    for (const PressureAtHeight& reading : readings) {
        const double x = isaHeight(reading.pressure_pa);
        if (!std::isfinite(x) || !std::isfinite(reading.height_m)) {
            return badData(fmt::format("no barometric height for a pressure of {} Pa at {} m",
                                       reading.pressure_pa, reading.height_m));
        }
        mean_x += x;
        mean_y += reading.height_m;
    }
    mean_x /= static_cast<double>(n);
    mean_y /= static_cast<double>(n);
    double sum_xx = 0.0;
    double sum_xy = 0.0;
    for (const PressureAtHeight& reading : readings) {
        const double x = isaHeight(reading.pressure_pa) - mean_x;
        sum_xx += x * x;
        sum_xy += x * (reading.height_m - mean_y);
    }
    // A spread below a millimetre is rounding, not relief.
    if (sum_xx < 1e-6 * static_cast<double>(n)) {
        return badData("all pressures are alike, a scale cannot be fitted", {}, 0,
                       "stand on marks of different height");
    }
    PressureHeightFit fit;
    fit.n = n;
    fit.scale = sum_xy / sum_xx;
    fit.offset_m = mean_y - fit.scale * mean_x;
    double sum_rr = 0.0;
    for (const PressureAtHeight& reading : readings) {
        const double residual = reading.height_m - fit.height(reading.pressure_pa);
        sum_rr += residual * residual;
    }
    fit.rmse_m = std::sqrt(sum_rr / static_cast<double>(n));
    return fit;
}

}  // namespace terrawalk
