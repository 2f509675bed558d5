// A million random points to a grid of a million cells by each method. CPU seconds of all threads.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <random>
#include <vector>

#include "mapping/height_interpolator.hpp"

namespace {

using namespace terrawalk;

constexpr std::size_t kPoints = 1'000'000;
constexpr double kSide_m = 1000.0;
constexpr int kRepeats = 3;

std::vector<Eigen::Vector3d> randomPoints() {
    std::mt19937_64 engine(1);
    const auto unit = [&] {
        return static_cast<double>(engine() >> 11) * 0x1p-53;
    };
    std::vector<Eigen::Vector3d> points(kPoints);
    for (Eigen::Vector3d& point : points) {
        const double x_m = kSide_m * unit();
        const double y_m = kSide_m * unit();
        point = {500'000.0 + x_m, 2'565'000.0 + y_m, 40.0 + 3.0 * std::sin(x_m / 9.0) * std::cos(y_m / 7.0)};
    }
    return points;
}

double cpuSecondsSince(std::clock_t begin) {
    return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

}  // namespace

int main() {
    const std::vector<Eigen::Vector3d> points = randomPoints();
    const GridGeometry geometry{500'000.0, 2'566'000.0, 1.0, 1000, 1000};
    SilentProgress progress;
    fmt::print("{} points, {} cells, median of {}; CPU seconds\n{:<20}{:>9}{:>9}{:>9}\n", kPoints,
               geometry.size(), kRepeats, "", "fit", "grid", "both");
    for (const auto& [method, text] : kInterpolationMethods) {
        std::vector<double> fitting, gridding, both;
        for (int repeat = 0; repeat < kRepeats; ++repeat) {
            const std::clock_t begin = std::clock();
            const auto surface = fitInterpolator(method, points, {}, {}, progress, {});
            fitting.push_back(cpuSecondsSince(begin));
            if (!surface || !interpolateGrid(**surface, geometry, {}, progress, {})) return 1;
            both.push_back(cpuSecondsSince(begin));
            gridding.push_back(both.back() - fitting.back());
        }
        fmt::print("{:<20}{:>9.2f}{:>9.2f}{:>9.2f}\n", text, median(fitting), median(gridding), median(both));
    }
    return 0;
}
