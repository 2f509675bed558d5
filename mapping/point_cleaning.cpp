#include "mapping/point_cleaning.hpp"

#include <fmt/format.h>
// Its templates are compiled here: looking up the symbols of libpcl_segmentation would take longer than all
// the rest of starting the program.
#define PCL_NO_PRECOMPILE
#include <pcl/kdtree/kdtree_flann.h>
#include <pcl/point_types.h>
#include <pcl/segmentation/extract_clusters.h>
#include <pcl/segmentation/progressive_morphological_filter.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "mapping/order_statistics.hpp"
#include "mapping/plan_kd_tree.hpp"
#include "mapping/point_order.hpp"
#include "survey/parallel.hpp"

namespace terrawalk {
namespace {

using Cloud = pcl::PointCloud<pcl::PointXYZ>;

/// Used points in curve order, as PCL takes them: float, from an origin near by, so that they lose nothing.
struct UsedPoints {
    Cloud::Ptr cloud = pcl::make_shared<Cloud>();
    std::vector<std::size_t> index;  ///< among all points
};

UsedPoints usedPoints(const std::vector<GroundPoint>& points) {
    std::vector<Eigen::Vector3d> places_m;
    std::vector<std::size_t> found;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (points[i].state != GroundPointState::Used) continue;
        places_m.push_back(points[i].enu_m);
        found.push_back(i);
    }
    UsedPoints used;
    if (places_m.empty()) return used;
    Eigen::Vector3d origin_m = places_m.front();
    for (const Eigen::Vector3d& place : places_m) origin_m = origin_m.cwiseMin(place);
    for (const std::uint32_t i : curveOrder(places_m)) {
        const Eigen::Vector3f p = (places_m[i] - origin_m).cast<float>();
        used.cloud->push_back(pcl::PointXYZ(p.x(), p.y(), p.z()));
        used.index.push_back(found[i]);
    }
    return used;
}

/// Indices that are not among those kept; both rise.
pcl::Indices othersThan(const pcl::Indices& kept, std::size_t count) {
    pcl::Indices others;
    std::size_t next = 0;
    for (std::size_t i = 0; i < count; ++i) {
        if (next < kept.size() && static_cast<std::size_t>(kept[next]) == i) {
            ++next;
        } else {
            others.push_back(static_cast<pcl::index_t>(i));
        }
    }
    return others;
}

/// What a point's nearest neighbours say of it, for all points, a block at a time. PCL's own filters do the
/// same in one go, which nobody could stop.
template <class Value, class Say>
std::vector<Value> ofNeighbours(const Cloud::Ptr& cloud, int neighbours, Say say, Progress& progress,
                                const std::string& step, const std::stop_token& stop) {
    constexpr std::size_t kBlock = 1024;
    pcl::KdTreeFLANN<pcl::PointXYZ> tree(false);  // sorted all the same, as PCL's filters have it
    tree.setInputCloud(cloud);
    std::vector<Value> values(cloud->size());
    std::atomic<std::size_t> done = 0;
    parallelRanges(cloud->size(), kBlock, [&](std::size_t begin, std::size_t end) {
        if (stop.stop_requested()) return;
        // One more, as the point itself is found too.
        pcl::Indices found(static_cast<std::size_t>(neighbours) + 1);
        std::vector<float> squares_m2(found.size());
        for (std::size_t i = begin; i < end; ++i) {
            const int count = tree.nearestKSearch((*cloud)[i], neighbours + 1, found, squares_m2);
            values[i] = say(count, squares_m2);
        }
        progress.report(static_cast<double>(done += end - begin) / static_cast<double>(cloud->size()), step);
    });
    return values;
}

/// As pcl::StatisticalOutlierRemoval.
pcl::Indices statisticalOutliers(const Cloud::Ptr& cloud, const StatisticalOutlierOptions& options,
                                 Progress& progress, const std::stop_token& stop) {
    if (cloud->size() <= static_cast<std::size_t>(options.neighbours)) return {};
    const auto meanDistance = [&](int, const std::vector<float>& squares_m2) {
        double sum = 0.0;
        for (int k = 1; k <= options.neighbours; ++k) {
            sum += double{std::sqrt(squares_m2[static_cast<std::size_t>(k)])};
        }
        return static_cast<float>(sum / options.neighbours);
    };
    const std::vector<float> distances_m = ofNeighbours<float>(
        cloud, options.neighbours, meanDistance, progress, "looking for statistical outliers", stop);
    double sum = 0.0, squares = 0.0;
    for (const float distance_m : distances_m) {
        sum += double{distance_m};
        squares += double{distance_m * distance_m};
    }
    const auto count = static_cast<double>(distances_m.size());
    const double limit_m =
        sum / count + options.sigmas * std::sqrt((squares - sum * sum / count) / (count - 1.0));
    pcl::Indices outliers;
    for (std::size_t i = 0; i < distances_m.size(); ++i) {
        if (double{distances_m[i]} > limit_m) outliers.push_back(static_cast<pcl::index_t>(i));
    }
    return outliers;
}

double spacingRadius_m(const Cloud::Ptr& cloud, int neighbours) {
    constexpr double kWithoutSpacing_m = 1.0;
    constexpr double kShare = 0.95, kMultiple = 2.0;
    constexpr std::size_t kMostPoints = 20'000;
    const auto wanted = static_cast<std::size_t>(neighbours) + 1;
    if (cloud->size() < wanted) return kWithoutSpacing_m;
    pcl::KdTreeFLANN<pcl::PointXYZ> tree(true);
    tree.setInputCloud(cloud);
    pcl::Indices found(wanted);
    std::vector<float> squares_m2(wanted);
    std::vector<double> distances_m;
    const std::size_t step = (cloud->size() + kMostPoints - 1) / kMostPoints;
    for (std::size_t i = 0; i < cloud->size(); i += step) {
        tree.nearestKSearch((*cloud)[i], static_cast<int>(wanted), found, squares_m2);
        distances_m.push_back(std::sqrt(double{squares_m2.back()}));
    }
    std::sort(distances_m.begin(), distances_m.end());
    const double usual_m = quantileOfSorted(distances_m, kShare);
    return usual_m > 0.0 ? kMultiple * usual_m : kWithoutSpacing_m;
}

/// As pcl::RadiusOutlierRemoval of a cloud without gaps.
pcl::Indices radiusOutliers(const Cloud::Ptr& cloud, const RadiusOutlierOptions& options, Progress& progress,
                            const std::stop_token& stop) {
    if (cloud->empty()) return {};
    const int wanted = options.least_neighbours + 1;
    const double radius_m2 = options.radius_m * options.radius_m;
    const auto alone = [&](int count, const std::vector<float>& squares_m2) -> char {
        return count < wanted || double{squares_m2[static_cast<std::size_t>(wanted) - 1]} > radius_m2 ? 1 : 0;
    };
    const std::vector<char> is_alone = ofNeighbours<char>(cloud, options.least_neighbours, alone, progress,
                                                          "looking for isolated points", stop);
    pcl::Indices outliers;
    for (std::size_t i = 0; i < is_alone.size(); ++i) {
        if (is_alone[i] != 0) outliers.push_back(static_cast<pcl::index_t>(i));
    }
    return outliers;
}

/// PCL takes whole metres.
int windowLimit_m(const AboveGroundOptions& options) {
    return static_cast<int>(std::ceil(options.greatest_window_m));
}

/// The sum of the windows: nothing farther away has a say.
double reachOf(const AboveGroundOptions& options) {
    double reach_m = 0.0, window_m = 0.0;
    for (double power = 1.0; window_m < windowLimit_m(options); power *= 2.0) {
        window_m = options.cell_m * (2.0 * power + 1.0);
        reach_m += window_m;
    }
    return reach_m;
}

pcl::Indices groundOf(const Cloud::Ptr& cloud, const AboveGroundOptions& options) {
    pcl::ProgressiveMorphologicalFilter<pcl::PointXYZ> filter;
    filter.setInputCloud(cloud);
    filter.setCellSize(static_cast<float>(options.cell_m));
    filter.setMaxWindowSize(windowLimit_m(options));
    filter.setSlope(static_cast<float>(options.slope));
    filter.setInitialDistance(static_cast<float>(options.least_height_m));
    filter.setMaxDistance(static_cast<float>(options.greatest_height_m));
    pcl::Indices ground;
    filter.extract(ground);
    return ground;
}

/// Square by square, each with what lies about it in reach, so that it can be given up in between.
pcl::Indices narrowThings(const Cloud& cloud, const AboveGroundOptions& options,
                          const std::stop_token& stop) {
    constexpr double kReachesInSide = 3.0;
    const double reach_m = reachOf(options);
    const double side_m = kReachesInSide * reach_m;
    std::map<std::pair<long, long>, pcl::Indices> squares;
    const auto square = [side_m](double at_m) {
        return std::lround(std::floor(at_m / side_m));
    };
    for (std::size_t i = 0; i < cloud.size(); ++i) {
        for (long r = square(cloud[i].y - reach_m); r <= square(cloud[i].y + reach_m); ++r) {
            for (long c = square(cloud[i].x - reach_m); c <= square(cloud[i].x + reach_m); ++c) {
                squares[{r, c}].push_back(static_cast<pcl::index_t>(i));
            }
        }
    }
    const std::vector<std::pair<std::pair<long, long>, pcl::Indices>> list(squares.begin(), squares.end());
    std::vector<char> above(cloud.size(), 0);
    parallelFor(list.size(), [&](std::size_t s) {
        if (stop.stop_requested()) return;
        const auto& [at, members] = list[s];
        const auto part = pcl::make_shared<Cloud>(cloud, members);
        for (const pcl::index_t i : othersThan(groundOf(part, options), part->size())) {
            const pcl::index_t whole = members[static_cast<std::size_t>(i)];
            const pcl::PointXYZ& p = cloud[static_cast<std::size_t>(whole)];
            const bool inside = square(p.y) == at.first && square(p.x) == at.second;
            if (inside) above[static_cast<std::size_t>(whole)] = 1;
        }
    });
    pcl::Indices found;
    for (std::size_t i = 0; i < above.size(); ++i) {
        if (above[i] != 0) found.push_back(static_cast<pcl::index_t>(i));
    }
    return found;
}

double extentOf(const Cloud& cloud, const pcl::Indices& members) {
    Eigen::Vector2f least = Eigen::Vector2f::Constant(HUGE_VALF), greatest = -least;
    for (const pcl::index_t i : members) {
        const Eigen::Vector2f at = cloud[static_cast<std::size_t>(i)].getVector3fMap().head<2>();
        least = least.cwiseMin(at);
        greatest = greatest.cwiseMax(at);
    }
    return (greatest - least).norm();
}

/// Which of the things lie level with ground beside them, as the edge of a terrace does and a plant does not.
std::vector<char> levelWithGround(const Cloud& cloud, const pcl::Indices& things,
                                  const AboveGroundOptions& options) {
    constexpr std::size_t kLeastBeside = 3;
    constexpr std::size_t kMostBeside = 64;
    constexpr double kLeastShare = 0.35;  // at an edge half the ground about is level, less what was taken
    const double reach_m = 2.0 * options.link_m;
    const pcl::Indices ground = othersThan(things, cloud.size());
    std::vector<Eigen::Vector3d> places_m;
    for (const pcl::index_t i : ground) {
        places_m.push_back(cloud[static_cast<std::size_t>(i)].getVector3fMap().cast<double>());
    }
    std::vector<char> level(things.size(), 0);
    if (places_m.size() < kLeastBeside) return level;
    const PlanKdTree tree(places_m);
    std::vector<Neighbour> near;
    for (std::size_t t = 0; t < things.size(); ++t) {
        const Eigen::Vector3d at_m =
            cloud[static_cast<std::size_t>(things[t])].getVector3fMap().cast<double>();
        tree.nearest(at_m.head<2>(), kMostBeside, near);
        std::erase_if(near, [&](const Neighbour& n) { return n.squared_distance_m2 > reach_m * reach_m; });
        const auto at_level = std::count_if(near.begin(), near.end(), [&](const Neighbour& n) {
            return std::abs(places_m[n.point].z() - at_m.z()) <= 0.5 * options.least_height_m;
        });
        const auto least = std::max<double>(kLeastBeside, kLeastShare * static_cast<double>(near.size()));
        level[t] = static_cast<double>(at_level) >= least ? 1 : 0;
    }
    return level;
}

/// Those that belong to nothing as long as a terrace, nor lie level with the ground beside for the most part.
pcl::Indices shortThings(const Cloud::Ptr& cloud, const pcl::Indices& things,
                         const AboveGroundOptions& options) {
    if (things.empty() || options.terrace_length_m == 0.0) return things;
    const auto part = pcl::make_shared<Cloud>(*cloud, things);
    pcl::EuclideanClusterExtraction<pcl::PointXYZ> clusters;
    clusters.setInputCloud(part);
    clusters.setClusterTolerance(options.link_m);
    clusters.setMinClusterSize(1);
    std::vector<pcl::PointIndices> found;
    clusters.extract(found);
    const std::vector<char> level = levelWithGround(*cloud, things, options);
    pcl::Indices taken;
    for (const pcl::PointIndices& cluster : found) {
        if (extentOf(*part, cluster.indices) >= options.terrace_length_m) continue;
        const auto on_ground =
            std::count_if(cluster.indices.begin(), cluster.indices.end(),
                          [&](pcl::index_t i) { return level[static_cast<std::size_t>(i)] != 0; });
        if (2 * static_cast<std::size_t>(on_ground) > cluster.indices.size()) continue;
        for (const pcl::index_t i : cluster.indices) taken.push_back(things[static_cast<std::size_t>(i)]);
    }
    return taken;
}

void mark(std::vector<GroundPoint>& points, const UsedPoints& used, const pcl::Indices& taken,
          GroundPointState state) {
    for (const pcl::index_t i : taken) points[used.index[static_cast<std::size_t>(i)]].state = state;
}

Result<void> check(const PointCleaningOptions& options) {
    const StatisticalOutlierOptions& s = options.statistical;
    if (s.use && !(s.neighbours > 0 && s.sigmas >= 0.0)) {
        return usageError("statistical outliers need at least one neighbour and sigmas not below zero");
    }
    const RadiusOutlierOptions& r = options.radius;
    if (r.use && !(r.radius_m >= 0.0 && r.least_neighbours > 0)) {
        return usageError("radius outliers need a radius not below zero and at least one neighbour");
    }
    const AboveGroundOptions& a = options.above_ground;
    const bool sizes =
        a.cell_m > 0.0 && a.greatest_window_m > 0.0 && a.greatest_window_m <= 1000.0 * a.cell_m;
    const bool heights = a.slope >= 0.0 && a.least_height_m > 0.0 && a.greatest_height_m >= a.least_height_m;
    if (a.use && !(sizes && heights && a.link_m > 0.0 && a.terrace_length_m >= 0.0)) {
        return usageError(
            "sizes and heights of what stands above the ground must be above zero, the greatest "
            "not below the least, the window not above 1000 cells");
    }
    return {};
}

}  // namespace

double isolationRadius_m(const std::vector<GroundPoint>& points, const RadiusOutlierOptions& options) {
    if (options.radius_m > 0.0) return options.radius_m;
    return spacingRadius_m(usedPoints(points).cloud, options.least_neighbours);
}

Result<std::vector<GroundPoint>> cleanGroundPoints(std::vector<GroundPoint> points,
                                                   const PointCleaningOptions& options, Progress& progress,
                                                   std::stop_token stop) {
    if (auto checked = check(options); !checked) return tl::unexpected(checked.error());
    try {
        RadiusOutlierOptions radius = options.radius;
        // Before a point is gone, so that everybody who asks is told the same.
        if (radius.use && !stop.stop_requested()) radius.radius_m = isolationRadius_m(points, radius);
        if (options.statistical.use && !stop.stop_requested()) {
            PartialProgress part(progress, 0.0, 0.2);
            const UsedPoints used = usedPoints(points);
            mark(points, used, statisticalOutliers(used.cloud, options.statistical, part, stop),
                 GroundPointState::StatisticalOutlier);
        }
        if (options.radius.use && !stop.stop_requested()) {
            PartialProgress part(progress, 0.2, 0.3);
            const UsedPoints used = usedPoints(points);
            mark(points, used, radiusOutliers(used.cloud, radius, part, stop), GroundPointState::Isolated);
        }
        if (options.above_ground.use && !stop.stop_requested()) {
            progress.report(0.3, "looking for what stands above the ground");
            const UsedPoints used = usedPoints(points);
            const pcl::Indices narrow = narrowThings(*used.cloud, options.above_ground, stop);
            mark(points, used, shortThings(used.cloud, narrow, options.above_ground),
                 GroundPointState::AboveGround);
        }
    } catch (const std::exception& failure) {
        return systemError(fmt::format("the points cannot be cleaned: {}", failure.what()));
    }
    if (stop.stop_requested()) return cancelled();
    progress.report(1.0, "points cleaned");
    return points;
}

std::vector<GroundPoint> withoutCleaning(std::vector<GroundPoint> points) {
    for (GroundPoint& point : points) {
        if (point.state == GroundPointState::StatisticalOutlier ||
            point.state == GroundPointState::Isolated || point.state == GroundPointState::AboveGround) {
            point.state = GroundPointState::Used;
        }
    }
    return points;
}

}  // namespace terrawalk
