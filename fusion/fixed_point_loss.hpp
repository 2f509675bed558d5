#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "fusion/fusion_options.hpp"
#include "survey/result.hpp"
#include "survey/survey.hpp"

namespace terrawalk {

/// A candidate of the tuner is a list of numbers in this order:
///   0-8   log10 of the diagonal of Q (`StepNoiseOptions`): position e, n, u [m^2], velocity e, n, u
///         [m^2/s^2], acceleration e, n, u [m^2/s^4], the order of paper 000, eq 2
///   9-11  alpha, beta, kappa, where these are tuned as well
/// so it has 9 dimensions or 12 (paper 000, figures 10 and 11).
inline constexpr std::size_t kNoiseDimensions = 9;
inline constexpr std::size_t kAllDimensions = 12;

struct CandidateBounds {
    std::vector<double> lower;
    std::vector<double> upper;
};

/// The box in which a tuner searches. alpha, beta and kappa are the paper's; it gives none for Q.
[[nodiscard]] CandidateBounds candidateBounds(std::size_t dimensions, double lowest_log10_noise = -8.0,
                                              double highest_log10_noise = 1.0);

/// The parameters of `options` as a candidate, and back.
[[nodiscard]] std::vector<double> candidateOf(const AukfOptions& options, std::size_t dimensions);
[[nodiscard]] AukfOptions withCandidate(AukfOptions options, std::span<const double> candidate);

/// Squared distance between the fused position and the mark [m^2], summed over runs or of one run.
struct SquaredError {
    double horizontal_m2 = 0.0;
    double vertical_m2 = 0.0;

    [[nodiscard]] double total_m2() const { return horizontal_m2 + vertical_m2; }
};

/// A fixed-point run that the loss is taken over.
struct FixedPointRun {
    std::string id;
    std::string target;
    std::size_t epochs = 0;
};

/// The loss of paper 000, section 2.3: for each fixed-point run the squared distance between the mean of the
/// fused positions over the still seconds at the target (`StandOptions`) and the mark as the total station
/// has it, raised by the height of the array above it, which the range finder tells. The filter is the one
/// that `FusionOptions::aukf` names, on the model of fusion/positioning_model.hpp.
///
/// Made once, then evaluated for many candidates. Marks of role check are never used: runs that begin or end
/// on one take no part. Evaluation does not depend on the number of threads, on the other candidates of the
/// batch or on the instruction set of the machine: the same bits everywhere. Safe from any thread; cheap to
/// copy.
class FixedPointLoss {
  public:
    /// Errors: BadData when no run can take part, or when one cannot be read (runReference()).
    [[nodiscard]] static Result<FixedPointLoss> prepare(const Survey& survey, const FusionOptions& options);

    [[nodiscard]] const std::vector<FixedPointRun>& runs() const { return runs_; }
    [[nodiscard]] std::size_t epochs() const;  ///< of all runs: filter steps for one candidate

    /// The loss over some of the runs, by index into runs(); over all but one, to leave that out and test on
    /// it.
    [[nodiscard]] FixedPointLoss over(std::span<const std::size_t> runs) const;
    [[nodiscard]] FixedPointLoss without(std::size_t run) const;

    /// Sums over the runs, for each candidate. A candidate under which a filter diverges has infinite loss.
    /// @param candidates  n x dimensions, row after row
    /// @param dimensions  9 or 12; with 9, alpha, beta and kappa are those of the options
    /// @param losses      n x 2: horizontal, vertical [m^2]
    void losses(std::span<const double> candidates, std::size_t dimensions, std::span<double> losses) const;

    [[nodiscard]] SquaredError loss(std::span<const double> candidate) const;
    /// Of each run, in the order of runs().
    [[nodiscard]] std::vector<SquaredError> runLosses(std::span<const double> candidate) const;

    /// Root of the mean over the runs [m].
    [[nodiscard]] double rmse(double loss_m2) const;

  private:
    struct Prepared;
    FixedPointLoss(std::shared_ptr<const Prepared> prepared, std::vector<std::size_t> chosen);
    // Of each candidate and run: n x runs.
    void errors(std::span<const double> candidates, std::size_t dimensions,
                std::span<SquaredError> errors) const;

    std::shared_ptr<const Prepared> prepared_;
    std::vector<std::size_t> chosen_;  // of the prepared runs, ascending
    std::vector<FixedPointRun> runs_;
};

}  // namespace terrawalk
