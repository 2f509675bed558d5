#pragma once

#include <stop_token>
#include <vector>

#include "survey/ground_point.hpp"
#include "survey/progress.hpp"
#include "survey/result.hpp"

namespace terrawalk {

/// Points farther from their neighbours than others are (Rusu et al. 2008), in space: the mean distance to
/// the neighbours against mean and spread of that distance over all points.
struct StatisticalOutlierOptions {
    bool use = false;
    int neighbours = 12;
    double sigmas = 4.0;
};

/// Points with next to nobody around them, in space.
struct RadiusOutlierOptions {
    bool use = false;
    double radius_m = 0.0;  ///< 0: from the spacing of the points, see isolationRadius_m()
    int least_neighbours = 2;
};

/// What stands on the ground and is narrower than a window: plants, and a hand in front of the range finder
/// (progressive morphological filter, Zhang et al. 2003). The filter alone would take the edge of a terrace
/// for such a thing where few points lie above it; what it took is given back where it goes on for
/// `terrace_length_m`, or where most of it lies level with a good part of the ground within two links, as
/// terraces do and plants do not.
struct AboveGroundOptions {
    bool use = false;
    double cell_m = 0.5;             ///< windows are 3, 5, 9, ... cells wide
    double greatest_window_m = 4.0;  ///< the first that is not below ends the series
    double slope = 0.5;              ///< of the ground
    double least_height_m = 0.4;     ///< above the ground of what is taken away
    double greatest_height_m = 1.0;  ///< whatever stands higher is taken away, steep ground or not
    double link_m = 1.2;             ///< points that near, in space, belong to one thing
    double terrace_length_m = 5.0;   ///< 0: nothing is given back
};

struct PointCleaningOptions {
    StatisticalOutlierOptions statistical;
    RadiusOutlierOptions radius;
    AboveGroundOptions above_ground;

    [[nodiscard]] bool any() const { return statistical.use || radius.use || above_ground.use; }
};

/// The radius as it was set, or twice the distance within which 95 % of the used points have their least
/// number of neighbours: of a million points strewn evenly it takes none. 1 m where there is no spacing to
/// follow. Pure, but for the time that it takes: a search about each of up to 20 000 points.
[[nodiscard]] double isolationRadius_m(const std::vector<GroundPoint>& points,
                                       const RadiusOutlierOptions& options);

/// Marks used points that are no ground as StatisticalOutlier, Isolated or AboveGround; each filter sees what
/// the one before left. Nothing moves and nothing goes: cleaning again with other options begins with
/// withoutCleaning(). Spikes along the track are found earlier, see groundPoints(), and thinning follows, see
/// thinGroundPoints(). Any order of the points and any number of threads mark the same points.
/// Filters: PCL's, the outliers by its trees and its definitions. Errors: Usage for options out of range;
/// System; Cancelled.
[[nodiscard]] Result<std::vector<GroundPoint>> cleanGroundPoints(std::vector<GroundPoint> points,
                                                                 const PointCleaningOptions& options,
                                                                 Progress& progress, std::stop_token stop);

/// Points that cleaning took away count as used again.
[[nodiscard]] std::vector<GroundPoint> withoutCleaning(std::vector<GroundPoint> points);

}  // namespace terrawalk
