#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "survey/result.hpp"

namespace terrawalk {

/// What repeated searches came to, by who searched.
struct OptimiserLosses {
    std::string optimiser;
    std::vector<double> losses;
};
struct OptimiserTable {
    std::string quantity;  ///< "loss [m2]"
    std::vector<OptimiserLosses> optimisers;

    /// Of that optimiser; a new one comes last.
    OptimiserLosses& of(const std::string& optimiser);
};

/// Reads the CSV of an experiment that repeats searches, such as fig10, fig11 or fig13: names in the first
/// column; values in the first whose name begins with "loss", or else in the third. Errors: BadData with the
/// line; System.
[[nodiscard]] Result<OptimiserTable> readOptimiserTable(const std::filesystem::path& file);

}  // namespace terrawalk
