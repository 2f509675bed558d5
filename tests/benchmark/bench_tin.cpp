// A million random points: DelaunayTin::build against CGAL's own insertion of the same points, and the
// gridding of ten million cells. CPU seconds of all threads.

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <random>
#include <string_view>
#include <vector>

#include "mapping/delaunay_tin.hpp"
#include "mapping/delaunay_triangles.hpp"
#include "mapping/gridding.hpp"
#include "mapping/point_order.hpp"

namespace {

using namespace terrawalk;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

constexpr std::size_t kPoints = 1'000'000;
constexpr double kSide_m = 1000.0;
constexpr double kCell_m = 0.316;  // 3165 x 3165 cells
constexpr int kRepeats = 7;

std::vector<Eigen::Vector3d> randomPoints() {
    std::mt19937_64 engine(1);
    const auto unit = [&] {
        return static_cast<double>(engine() >> 11) * 0x1p-53;
    };
    std::vector<Eigen::Vector3d> points(kPoints);
    for (Eigen::Vector3d& point : points) {
        const double x_m = kSide_m * unit();
        const double y_m = kSide_m * unit();
        point = {500'000.0 + x_m, 2'565'000.0 + y_m, 40.0 + 3.0 * unit()};
    }
    return points;
}

double cpuSeconds(const std::function<void()>& work) {
    const std::clock_t begin = std::clock();
    work();
    return static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
}

void printRow(std::string_view what, std::vector<double> seconds) {
    std::sort(seconds.begin(), seconds.end());
    fmt::print("{:<44}{:>9.3f}{:>9.3f}{:>9.3f}\n", what, seconds.front(), seconds[seconds.size() / 2],
               seconds.back());
}

}  // namespace

int main() {
    const std::vector<Eigen::Vector3d> points = randomPoints();
    std::vector<Kernel::Point_2> plan_points;
    for (const Eigen::Vector3d& point : points) {
        plan_points.emplace_back(point.x(), point.y());
    }
    SilentProgress progress;
    std::vector<double> bare, sorted, build, rasterizing, locator;
    std::size_t cells = 0;
    for (int repeat = 0; repeat < kRepeats; ++repeat) {
        bare.push_back(cpuSeconds([&] {
            CGAL::Delaunay_triangulation_2<Kernel> triangulation;
            triangulation.insert(plan_points.begin(), plan_points.end());
        }));
        sorted.push_back(cpuSeconds([&] {
            const auto ordered = inCurveOrder(points);
            if (!delaunayTriangles(ordered, ordered.size() / 2, progress, {})) std::exit(1);
        }));
        Result<DelaunayTin> tin = usageError("not built");
        build.push_back(cpuSeconds([&] { tin = DelaunayTin::build(points, {}, progress, {}); }));
        if (!tin) {
            fmt::print(stderr, "{}\n", tin.error().text());
            return 1;
        }
        const Result<GridGeometry> geometry = gridCovering(tin->mesh(), kCell_m);
        Result<ElevationGrid> grid = usageError("not built");
        rasterizing.push_back(cpuSeconds([&] { grid = rasterize(tin->mesh(), *geometry, progress, {}); }));
        cells = grid->heights_m.size();
        locator.push_back(
            cpuSeconds([&] { static_cast<void>(tin->heightAt(500'000.0 + 0.5 * kSide_m, 2'565'500.0)); }));
    }
    fmt::print("{} points, {} cells, {} repeats; CPU seconds\n", kPoints, cells, kRepeats);
    fmt::print("{:<44}{:>9}{:>9}{:>9}\n", "", "min", "median", "max");
    printRow("CGAL insertion alone, with its sorting", bare);
    printRow("inCurveOrder and delaunayTriangles", sorted);
    printRow("DelaunayTin::build: that, checks, limit", build);
    printRow("rasterize", rasterizing);
    printRow("first heightAt, which makes the locator", locator);
    return 0;
}
