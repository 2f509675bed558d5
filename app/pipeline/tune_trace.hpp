#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "app/pipeline/optimiser_table.hpp"
#include "app/pipeline/tune.hpp"
#include "survey/result.hpp"

namespace terrawalk {

/// How one search for parameters went, for drawing.
struct TuneTrace {
    std::string method;     ///< "aukf"
    std::string optimiser;  ///< "isma"
    std::uint64_t seed = 0;
    std::string loss;  ///< what was made small, with its unit
    std::vector<ConvergencePoint> convergence;
};
[[nodiscard]] TuneTrace traceOf(const TuneOutcome& outcome);

/// All that is known of searches.
struct TuningData {
    std::vector<TuneTrace> traces;
    OptimiserTable table;  ///< of an experiment; empty: none was opened
};
/// The last losses of searches with one loss (that of the last), by optimiser, in the order in which they
/// first came. Pure.
[[nodiscard]] OptimiserTable endLosses(const std::vector<TuneTrace>& traces);

/// Reads a file that `terrawalk tune` wrote, or settings with withTrace(). Errors: BadData where there is no
/// JSON, or no trace of a search in it; System.
[[nodiscard]] Result<TuneTrace> readTuneTrace(const std::filesystem::path& file);

/// A configuration file with the trace beside the tuning that it tells of; as it is where it tells of none.
[[nodiscard]] std::string withTrace(const std::string& config_json, const TuneTrace& trace);

}  // namespace terrawalk
