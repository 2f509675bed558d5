#pragma once

#include <cstddef>
#include <vector>

namespace terrawalk {

/// A good point set in the unit cube, n x d, row after row: point k = 1..n has the coordinates
/// frac(k r_j), r_j = 2 cos(2 pi j / e), j = 1..d, with e the smallest prime for which (e - 3) / 2 >= d.
/// Its discrepancy falls like n^(-1 + epsilon), against n^(-1/2) of random points; a hundred points are more
/// even than random ones in most dimensions, though not in each.
/// Pure. Source: Hua and Wang 1981; paper 000, eq 22 (whose "<" is read as ">=", as is standard).
[[nodiscard]] std::vector<double> goodPoints(std::size_t n, std::size_t dimensions);

/// Centred L2 discrepancy of points in the unit cube (n x d, row after row): how far the share of points in
/// boxes that begin in a corner strays from their volume; 0 would be perfectly even. O(n^2 d). Pure.
/// Source: Hickernell 1998, eq 1.2.
[[nodiscard]] double centredDiscrepancy(const std::vector<double>& points, std::size_t dimensions);

}  // namespace terrawalk
