#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "fusion/candidate_evaluator.hpp"
#include "fusion/optimiser.hpp"

namespace terrawalk {

/// Candidates that none of the others beats: as good in every loss and better in one.
class ParetoFront {
  public:
    /// Losses that are not finite are left out, and losses that are there already.
    void add(std::span<const double> candidate, std::span<const double> losses);
    [[nodiscard]] const std::vector<FrontPoint>& points() const { return points_; }

  private:
    std::vector<FrontPoint> points_;
};

/// What a search by pagmo leaves beside the evaluator's best.
struct PagmoOutcome {
    std::size_t restarts = 0;  ///< an algorithm ended before the evaluations were spent
    ParetoFront front;         ///< of all that Nsga2 evaluated; empty for the others
    std::string error;         ///< what pagmo says where it refuses; empty: nothing
};

/// Runs the pagmo algorithm of the kind until the evaluator is over. Nsga2 and Pso hand over whole
/// generations, the others one candidate at a time.
[[nodiscard]] PagmoOutcome pagmoSearch(OptimiserKind kind, const SearchBox& box, std::size_t population,
                                       std::uint64_t seed, CandidateEvaluator& evaluator);

}  // namespace terrawalk
