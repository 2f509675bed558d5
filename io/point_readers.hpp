#pragma once

#include <string_view>

#include "io/read_points.hpp"

namespace terrawalk {

// The formats behind readPoints().

[[nodiscard]] Result<ScatteredPoints> readPointTable(const std::filesystem::path& file, Progress& progress,
                                                     const std::stop_token& stop);
[[nodiscard]] Result<ScatteredPoints> readLas(const std::filesystem::path& file,
                                              const std::vector<int>& classes, Progress& progress,
                                              const std::stop_token& stop);
[[nodiscard]] Result<ScatteredPoints> readPly(const std::filesystem::path& file, Progress& progress,
                                              const std::stop_token& stop);
[[nodiscard]] Result<ScatteredPoints> readVectorPoints(const std::filesystem::path& file, Progress& progress,
                                                       const std::stop_token& stop);

/// The column of a table or field that holds a coordinate or whether a point counts, by its name without the
/// unit, lower case.
enum class PointColumn { X, Y, Z, Sigma, Used };
struct NamedColumn {
    PointColumn column;
    std::optional<LengthUnit> unit;  ///< by the ending of the name
};
[[nodiscard]] std::optional<NamedColumn> namedColumn(std::string_view name);

/// Tables of points that say which of them are ground have 0 in the column `used` for the others: these are
/// left out, and a note says how many.
void leaveOutUnused(ScatteredPoints& points, std::size_t left_out);

}  // namespace terrawalk
