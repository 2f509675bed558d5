#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "survey/result.hpp"

namespace terrawalk {

/// What gridding takes at its peak, from above: heights, a mask and the copy that is written for each cell,
/// variances too where the method has them; points, triangulation and a fitted surface for each point.
struct MemoryNeed {
    std::size_t points = 0;
    std::size_t cells = 0;
    bool variances = false;
    bool linear = false;     ///< straight from the triangles
    bool multiband = false;  ///< heights and variances are written into one file, too
    [[nodiscard]] double bytes() const;
};

/// Memory that this process may still take: what the system has to give, within the process's own limit
/// (RLIMIT_AS). Nothing where the system does not tell.
[[nodiscard]] std::optional<double> availableMemory_bytes();

/// "3.4 GB".
[[nodiscard]] std::string memoryText(double bytes);

/// Error System when more than nine tenths of `available_bytes` were needed, with the resolution that fits as
/// cure. Pure.
/// @param cell  resolution that was asked for
[[nodiscard]] Result<void> checkMemory(const MemoryNeed& need, double available_bytes, double cell);

}  // namespace terrawalk
