#pragma once

#include <filesystem>
#include <string_view>

#include "survey/result.hpp"
#include "survey/trajectory.hpp"

namespace terrawalk {

/// Reads what writeTrajectoryCsv() wrote, columns in any order. The covariance holds the squared sigmas of
/// the position on its diagonal and nothing else; fields that are empty are missing. The run is named by the
/// file. Errors: BadData with file and line for a missing column, a row with another number of fields, a
/// field that is no number, times that do not grow, or no rows; System. Pure but for the file; safe from any
/// thread.
[[nodiscard]] Result<Trajectory> readTrajectoryCsv(const std::filesystem::path& file);
[[nodiscard]] Result<Trajectory> parseTrajectoryCsv(std::string_view bytes,
                                                    const std::filesystem::path& file);

}  // namespace terrawalk
