#include "app/pipeline/memory_need.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

namespace terrawalk {
namespace {

// Measured over surfaces of 3e5 points and 1.6e7 cells (350 and 670 bytes a point, 6 and 11 bytes a cell,
// kriging 17, and 29 with a multiband file), rounded up.
constexpr double kBytesPerCellLinear = 8.0;
constexpr double kBytesPerCell = 12.0;
constexpr double kBytesPerVariance = 8.0;
constexpr double kBytesPerMultiband = 12.0;
constexpr double kBytesPerPointLinear = 400.0;
constexpr double kBytesPerPoint = 700.0;
constexpr double kShare = 0.9;

/// A line of the form "Name:  123 kB".
std::optional<double> kibibytes(const char* file, const std::string& name) {
    std::ifstream lines(file);
    for (std::string line; std::getline(lines, line);) {
        if (!line.starts_with(name + ":")) continue;
        std::istringstream words(line.substr(name.size() + 1));
        double value = 0.0;
        if (words >> value) return value;
    }
    return std::nullopt;
}

}  // namespace

double MemoryNeed::bytes() const {
    const double per_cell = (linear ? kBytesPerCellLinear : kBytesPerCell) +
                            (variances ? kBytesPerVariance : 0.0) +
                            (variances && multiband ? kBytesPerMultiband : 0.0);
    return per_cell * static_cast<double>(cells) +
           (linear ? kBytesPerPointLinear : kBytesPerPoint) * static_cast<double>(points);
}

std::optional<double> availableMemory_bytes() {
    std::optional<double> available;
    if (const auto kib = kibibytes("/proc/meminfo", "MemAvailable")) available = 1024.0 * *kib;
    rlimit limit{};
    if (::getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY) {
        const double used = 1024.0 * kibibytes("/proc/self/status", "VmSize").value_or(0.0);
        const double left = std::max(0.0, static_cast<double>(limit.rlim_cur) - used);
        available = std::min(available.value_or(left), left);
    }
    return available;
}

std::string memoryText(double bytes) {
    return bytes < 1e9 ? fmt::format("{:.0f} MB", std::ceil(bytes / 1e6))
                       : fmt::format("{:.1f} GB", bytes / 1e9);
}

Result<void> checkMemory(const MemoryNeed& need, double available_bytes, double cell) {
    const double usable = kShare * available_bytes;
    if (need.bytes() <= usable) return {};
    MemoryNeed points_alone = need;
    points_alone.cells = 0;
    const double left = usable - points_alone.bytes();
    const std::string message =
        fmt::format("a surface of {} points and {} cells needs about {} of memory, and {} can be had",
                    need.points, need.cells, memoryText(need.bytes()), memoryText(available_bytes));
    if (left <= 0.0) return systemError(message, {}, "thin the points, or use a machine with more memory");
    const double factor = std::sqrt((need.bytes() - points_alone.bytes()) / left);
    // Two digits, upwards.
    const double step = std::pow(10.0, std::floor(std::log10(cell * factor)) - 1.0);
    return systemError(message, {},
                       fmt::format("ask for a resolution of {} or coarser, or for a smaller extent",
                                   std::ceil(cell * factor / step) * step));
}

}  // namespace terrawalk
