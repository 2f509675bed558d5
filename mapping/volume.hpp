#pragma once

#include <cstddef>
#include <stop_token>
#include <vector>

#include "survey/elevation_grid.hpp"
#include "survey/result.hpp"

namespace terrawalk {

/// How the errors of the height differences hang together.
struct VolumeErrorModel {
    /// One sigma of a cell's difference, in the order of the cells; or a single one for all.
    std::vector<float> sigmas_m{0.0F};
    /// Distance beyond which errors of two cells are independent (range of a spherical correlogram); 0: each
    /// cell on its own.
    double correlation_range_m = 0.0;
    /// One sigma of an error that all cells share, such as a datum.
    double common_sigma_m = 0.0;
};

struct VolumePart {
    double volume_m3 = 0.0;  ///< not below zero
    double sigma_m3 = 0.0;   ///< standard error
    double area_m2 = 0.0;
};

struct VolumeResult {
    VolumePart above;     ///< where the difference is above zero: cut, when a plane is asked for
    VolumePart below;     ///< where it is below: fill
    double net_m3 = 0.0;  ///< above less below
    double net_sigma_m3 = 0.0;
    double area_m2 = 0.0;
    std::size_t cells = 0;  ///< with a difference; the others count for nothing
};

/// Cell by cell: height of the difference times area. Its variance is the sum over all pairs of cells of
/// sigma_i sigma_j rho(distance), times area squared, and the common part; what it costs to know which cells
/// lie above and which below is not in the two parts. Pairs are counted between square blocks of an eighth of
/// the range (Journel and Huijbregts 1978, estimation variance of a block by discretization), which sees a
/// little more correlation than there is. Pure; the same bits everywhere. Error: Cancelled.
/// @param difference  heights less the reference; NaN where either is unknown
/// @param errors      sigmas for one cell or for all, finite where the difference is
[[nodiscard]] Result<VolumeResult> volumeOf(const ElevationGrid& difference, const VolumeErrorModel& errors,
                                            const std::stop_token& stop = {});

}  // namespace terrawalk
