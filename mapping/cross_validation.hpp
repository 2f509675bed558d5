#pragma once

#include <array>
#include <cstdint>
#include <stop_token>
#include <string_view>
#include <utility>
#include <vector>

#include "mapping/height_interpolator.hpp"
#include "survey/breakline.hpp"

namespace terrawalk {

/// Which points are left out together, to be foretold from the others.
enum class HoldOut {
    LeaveOneOut,    ///< one by one; those far apart share a round, which changes nothing
    RandomFolds,    ///< parts drawn by lot
    SpatialBlocks,  ///< squares drawn by lot into parts: how well gaps are filled
};
inline constexpr std::array<std::pair<HoldOut, std::string_view>, 3> kHoldOuts{{
    {HoldOut::LeaveOneOut, "leave-one-out"},
    {HoldOut::RandomFolds, "random-folds"},
    {HoldOut::SpatialBlocks, "spatial-blocks"},
}};
[[nodiscard]] std::string_view name(HoldOut hold_out);

struct CrossValidationOptions {
    std::vector<InterpolationMethod> methods;  ///< empty: all
    std::vector<Breakline> breaklines;         ///< for the methods that follow them
    std::size_t folds = 10;                    ///< parts of RandomFolds and SpatialBlocks
    double block_m = 0.0;                      ///< side of a block; 0: five mean point spacings
    std::size_t leave_one_out_points = 2000;   ///< that many are left out one by one, or all
    std::uint64_t seed = 1;
    /// Rounds of one hold-out stop when they have fitted this many points, but not before the first is done.
    std::size_t most_fitted_points = 500'000;
};

/// Errors, foretold less given, of one method in one hold-out.
struct HoldOutScore {
    double rmse_m = 0.0;
    double mean_m = 0.0;
    double mean_absolute_m = 0.0;
    double error95_m = 0.0;  ///< 95 % quantile of the absolute error
};

struct HoldOutResult {
    HoldOut hold_out = HoldOut::LeaveOneOut;
    std::size_t rounds = 0;            ///< that were run
    std::size_t compared = 0;          ///< points that every method foretold
    std::size_t outside = 0;           ///< points left out that lay outside the hull of the others
    std::vector<HoldOutScore> scores;  ///< in the order of CrossValidation::methods
};

struct CrossValidation {
    std::vector<InterpolationMethod> methods;  ///< as asked
    std::vector<HoldOutResult> results;        ///< those with something to compare
    /// Best first: by the geometric mean of the RMSE over the hold-outs. Equal ones in the order asked.
    std::vector<InterpolationMethod> ranking;
    std::size_t points = 0;  ///< at different places
    std::size_t folds = 0;
    double block_m = 0.0;  ///< that was used
    std::uint64_t seed = 0;
};

/// Foretells points from the others by each method and ranks the methods. Depends on points, options and seed
/// alone, not on the order of the points or the number of threads. Units as for HeightInterpolator.
/// Errors: as fitInterpolator() and buildConstrainedTin(); BadData for fewer than 10 points at different
/// places, and when no point left out lies within the hull of the others; Usage for fewer than two folds or a
/// negative block; Cancelled.
[[nodiscard]] Result<CrossValidation> crossValidate(const std::vector<Eigen::Vector3d>& points_m,
                                                    const std::vector<double>& sigmas_m,
                                                    const InterpolationOptions& interpolation,
                                                    const CrossValidationOptions& options, Progress& progress,
                                                    std::stop_token stop);

}  // namespace terrawalk
