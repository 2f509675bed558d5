#pragma once

#include <cstring>
#include <vector>

namespace terrawalk {

/// Whether two columns are the same to the bit, NaN with NaN.
inline bool sameBits(const std::vector<double>& a, const std::vector<double>& b) {
    return a.size() == b.size() &&
           (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0);
}

}  // namespace terrawalk
