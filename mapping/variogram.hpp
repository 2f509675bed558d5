#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <string_view>
#include <vector>

namespace terrawalk {

/// A Gaussian one is left out: without a nugget its systems cannot be solved in doubles.
enum class VariogramModel { Power, Spherical, Exponential };
[[nodiscard]] std::string_view name(VariogramModel model);

/// Half the expected squared difference of two heights by their distance in plan: 0 at distance 0, nugget
/// plus a part that rises to the sill. A power of the distance rises without end, through the sill at the
/// range.
struct Variogram {
    VariogramModel model = VariogramModel::Power;
    double nugget_m2 = 0.0;
    double sill_m2 = 1.0;   ///< without the nugget
    double range_m = 1.0;   ///< where a spherical one is at the sill, an exponential one at 95 % of it
    double exponent = 1.0;  ///< of a power, 0 < exponent < 2

    /// Without the nugget. @param distance_m >= 0
    [[nodiscard]] double structureAt(double distance_m) const;
};

/// A variogram, and how many pairs of points its form comes from.
struct FittedVariogram {
    Variogram variogram;
    std::size_t pairs = 0;
};

/// Mean over pairs of points within one class of distance.
struct VariogramClass {
    double distance_m = 0.0;
    double semivariance_m2 = 0.0;
    std::size_t pairs = 0;
};

/// Pairs of each of up to 1500 points, spread evenly over the list, with its nearest `neighbours`, in classes
/// of equal count. Pure.
/// @param points_m  in curve order, at different places
[[nodiscard]] std::vector<VariogramClass> empiricalVariogram(const std::vector<Eigen::Vector3d>& points_m,
                                                             std::size_t neighbours);

/// Weighted least squares (Cressie 1985: pairs over squared model value, two rounds) of nugget and sill for
/// each model over a row of ranges; the best of all. Neither nugget nor sill below zero. Without classes or
/// without any variance: exponent 1, sill 1 at 1. Pure.
[[nodiscard]] Variogram fitVariogram(const std::vector<VariogramClass>& classes);

}  // namespace terrawalk
