#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <mutex>
#include <span>
#include <stop_token>
#include <vector>

#include "fusion/optimiser.hpp"

namespace terrawalk {

/// What the islands of one search have in common. Thread-safe.
class SearchMonitor {
  public:
    SearchMonitor(std::size_t limit, const Recording& recording, Progress& progress, std::stop_token stop);

    [[nodiscard]] bool stopRequested() const { return stop_.stop_requested(); }
    void addEvaluations(std::size_t evaluations);
    void record(std::size_t island, std::span<const double> losses);

  private:
    std::size_t limit_;
    std::size_t report_every_;
    std::atomic<std::size_t> evaluations_{0};
    const Recording& recording_;
    std::mutex recording_mutex_;
    Progress& progress_;
    std::stop_token stop_;
};

/// Losses of some candidates, in their order; valid until the next evaluation.
struct EvaluatedLosses {
    std::span<const double> losses;  ///< m for each candidate
    std::span<const double> sums;    ///< one for each candidate
};

/// The one way from an optimiser to the objective. Counts every evaluation, keeps the limit, replays recorded
/// losses, remembers the best candidate and how the search came to it. One for each island; not thread-safe.
class CandidateEvaluator {
  public:
    CandidateEvaluator(const Objective& objective, std::size_t dimensions, std::size_t limit,
                       std::size_t island, std::span<const double> recorded, SearchMonitor& monitor);

    /// As many of the candidates (n x d), from the first on, as the limit still allows. None once the limit
    /// is reached or a stop was requested: then the search is over.
    [[nodiscard]] EvaluatedLosses evaluate(std::span<const double> candidates);

    [[nodiscard]] std::size_t dimensions() const { return dimensions_; }
    [[nodiscard]] std::size_t lossesEach() const { return objective_.losses; }
    [[nodiscard]] std::size_t evaluations() const { return evaluations_; }
    [[nodiscard]] std::size_t limit() const { return limit_; }
    [[nodiscard]] bool isOver() const { return stopped_ || evaluations_ == limit_; }
    [[nodiscard]] bool wasStopped() const { return stopped_; }
    [[nodiscard]] const std::vector<double>& best() const { return best_; }  ///< empty before the first one
    [[nodiscard]] double bestLoss() const { return best_loss_; }
    [[nodiscard]] const std::vector<double>& bestLosses() const { return best_losses_; }
    [[nodiscard]] const std::vector<ConvergencePoint>& convergence() const { return convergence_; }

  private:
    void fillLosses(std::span<const double> candidates, std::size_t count);
    void keepBest(std::span<const double> candidates, std::size_t count);
    const Objective& objective_;
    std::size_t dimensions_;
    std::size_t limit_;
    std::size_t island_;
    std::span<const double> recorded_;  ///< that were not replayed yet
    SearchMonitor& monitor_;
    std::size_t evaluations_ = 0;
    bool stopped_ = false;
    std::vector<double> losses_;
    std::vector<double> sums_;
    std::vector<double> best_;
    double best_loss_;
    std::vector<double> best_losses_;
    std::vector<ConvergencePoint> convergence_;
};

}  // namespace terrawalk
