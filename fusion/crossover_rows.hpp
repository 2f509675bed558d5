#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "fusion/crossovers.hpp"
#include "fusion/fusion_options.hpp"
#include "fusion/run_model.hpp"
#include "fusion/sparse_least_squares.hpp"
#include "survey/survey.hpp"

namespace terrawalk {

/// Passes over the same ground, and over marks of known height, as the runs lie at a time; and what they put
/// into the joint adjustment. The references must outlive it. Not thread-safe.
class CrossoverRows {
  public:
    CrossoverRows(const Survey& survey, const FusionOptions& options, const std::vector<RunModel>& runs,
                  const HardIron& array_iron)
        : survey_(survey), options_(options), runs_(runs), array_iron_(array_iron) {}

    /// Looks for them anew.
    void find();
    void addTo(SparseLeastSquares& system);

    [[nodiscard]] const std::vector<Crossover>& pairs() const { return pairs_; }
    /// Those that only test.
    [[nodiscard]] const std::vector<Crossover>& leftOut() const { return left_out_; }

    /// Before the crossovers are used they test the track: misfits over what its covariance predicts, from a
    /// system that was solved without them.
    [[nodiscard]] SigmaCoverage testHeights(SparseLeastSquares& system) const;

  private:
    std::vector<GroundSample> groundSamples() const;
    bool onlyShowsErrors(const ControlMark& mark) const;
    bool isLeftOut(const Crossover& pair) const;
    double pairSigma(const Eigen::Vector2d& slope, double roughness_m, double apart_m2) const;
    double planVariance(std::size_t run, std::size_t epoch) const;
    void ground(const RunModel& run, std::size_t epoch, const Eigen::Vector2d& slope, double sign);
    std::vector<double> pairCrowding() const;

    const Survey& survey_;
    const FusionOptions& options_;
    const std::vector<RunModel>& runs_;
    const HardIron& array_iron_;
    std::vector<Crossover> pairs_;
    std::vector<Crossover> left_out_;
    std::vector<MarkPass> mark_passes_;
    RowTerms row_;
};

/// [m]; zero where there are none.
[[nodiscard]] double rootMeanSquareMisfit(const std::vector<Crossover>& pairs);

}  // namespace terrawalk
