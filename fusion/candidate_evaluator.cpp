#include "fusion/candidate_evaluator.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace terrawalk {

namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

}  // namespace

SearchMonitor::SearchMonitor(std::size_t limit, const Recording& recording, Progress& progress,
                             std::stop_token stop)
    : limit_(limit),
      report_every_(std::max<std::size_t>(1, limit / 500)),
      recording_(recording),
      progress_(progress),
      stop_(std::move(stop)) {}

void SearchMonitor::addEvaluations(std::size_t evaluations) {
    const std::size_t before = evaluations_.fetch_add(evaluations, std::memory_order_relaxed);
    const std::size_t after = before + evaluations;
    if (before / report_every_ == after / report_every_) return;
    progress_.report(static_cast<double>(after) / static_cast<double>(limit_), "searching");
}

void SearchMonitor::record(std::size_t island, std::span<const double> losses) {
    if (!recording_.on_losses || losses.empty()) return;
    const std::lock_guard lock(recording_mutex_);
    recording_.on_losses(island, losses);
}

CandidateEvaluator::CandidateEvaluator(const Objective& objective, std::size_t dimensions, std::size_t limit,
                                       std::size_t island, std::span<const double> recorded,
                                       SearchMonitor& monitor)
    : objective_(objective),
      dimensions_(dimensions),
      limit_(limit),
      island_(island),
      recorded_(recorded),
      monitor_(monitor),
      best_loss_(kInfinity) {}

EvaluatedLosses CandidateEvaluator::evaluate(std::span<const double> candidates) {
    const std::size_t count = std::min(candidates.size() / dimensions_, limit_ - evaluations_);
    stopped_ = stopped_ || monitor_.stopRequested();
    if (stopped_ || count == 0) return {};
    fillLosses(candidates, count);
    if (stopped_) return {};
    keepBest(candidates, count);
    monitor_.addEvaluations(count);
    const std::span<const double> losses(losses_.data(), count * objective_.losses);
    return {losses, objective_.losses == 1 ? losses : std::span<const double>(sums_.data(), count)};
}

void CandidateEvaluator::fillLosses(std::span<const double> candidates, std::size_t count) {
    const std::size_t m = objective_.losses;
    losses_.resize(std::max(losses_.size(), count * m));
    const std::span<double> losses(losses_.data(), count * m);
    const std::size_t replayed = std::min(count, recorded_.size() / m);
    std::copy_n(recorded_.begin(), replayed * m, losses.begin());
    recorded_ = recorded_.subspan(replayed * m);
    const std::span<double> fresh = losses.subspan(replayed * m);
    if (!fresh.empty()) {
        objective_.evaluate(candidates.subspan(replayed * dimensions_, (count - replayed) * dimensions_),
                            fresh);
        // The objective may have given up on the batch.
        stopped_ = monitor_.stopRequested();
        if (stopped_) return;
    }
    for (double& loss : losses) {
        if (std::isnan(loss)) loss = kInfinity;
    }
    monitor_.record(island_, fresh);
}

void CandidateEvaluator::keepBest(std::span<const double> candidates, std::size_t count) {
    const std::size_t m = objective_.losses;
    sums_.resize(std::max(sums_.size(), count));
    for (std::size_t i = 0; i < count; ++i) {
        double sum = losses_[i * m];
        for (std::size_t j = 1; j < m; ++j) sum += losses_[i * m + j];
        // Losses of opposite infinite sign.
        if (std::isnan(sum)) sum = kInfinity;
        sums_[i] = sum;
        ++evaluations_;
        if (!(sum < best_loss_) && !best_.empty()) continue;
        best_loss_ = sum;
        best_.assign(candidates.begin() + static_cast<std::ptrdiff_t>(i * dimensions_),
                     candidates.begin() + static_cast<std::ptrdiff_t>((i + 1) * dimensions_));
        best_losses_.assign(losses_.begin() + static_cast<std::ptrdiff_t>(i * m),
                            losses_.begin() + static_cast<std::ptrdiff_t>((i + 1) * m));
        convergence_.push_back({evaluations_, sum});
    }
}

}  // namespace terrawalk
