#pragma once

#include <stop_token>
#include <vector>

#include "survey/contour.hpp"
#include "survey/elevation_grid.hpp"
#include "survey/progress.hpp"
#include "survey/result.hpp"

namespace terrawalk {

inline constexpr double kSmoothingInErrors_cells = 3.0;

struct ContourOptions {
    double interval = 1.0;  ///< between levels, > 0; levels are its multiples above `base`
    double base = 0.0;
    /// Standard deviation of the Gaussian that the heights go through first, in cells; 0: none.
    double smoothing_cells = 1.0;
    /// Standard errors on the same cells, where they are known: before the Gaussian each height goes to the
    /// mean, by a Gaussian of kSmoothingInErrors_cells, of those around that could be the same ground by its
    /// standard error, and by no more than that error. Lines on level ground then do not follow noise, and
    /// steps stay where they are. Not without smoothing.
    const ElevationGrid* sigmas = nullptr;
    int index_every = 5;  ///< every so many levels one is an index contour
};

struct ContourSet {
    std::vector<Contour> contours;  ///< by level, in an order that does not depend on threads
    double smoothing_rms = 0.0;     ///< by how much smoothing moved the heights
};

/// Smooth contours that never cross. Not the lines are smoothed but the surface: a bicubic Hermite patch over
/// every four neighbouring cell centres, with slopes by central differences (Catmull and Rom 1974), sampled
/// four times as finely and split into triangles. Lines of a function that is linear on triangles cannot
/// cross. A level counts as below a height that equals it. There is no line over cells without a height or
/// beside them, where fewer than four centres are known. Runs on all of TBB's threads; the same bytes with
/// any number of them. Errors: Usage for an interval that is not above zero or that makes more than 100000
/// levels; System when there is not enough memory; Cancelled.
[[nodiscard]] Result<ContourSet> contourLines(const ElevationGrid& heights, const ContourOptions& options,
                                              Progress& progress, std::stop_token stop);

/// About what contourLines() takes: smoothed heights and the pieces of lines, which grow with relief over
/// interval. Pure.
[[nodiscard]] double contourMemory_bytes(const ElevationGrid& heights, const ContourOptions& options);

/// The heights through a Gaussian of that standard deviation, normalised over the cells with a height; those
/// without keep none. Same bytes with any number of threads. Errors: Cancelled.
[[nodiscard]] Result<ElevationGrid> gaussianSmoothed(const ElevationGrid& heights, double sigma_cells,
                                                     std::stop_token stop = {});

}  // namespace terrawalk
