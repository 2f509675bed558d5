// What terrace edges found by themselves do to the height error, on simulated ground whose truth is known.
// Random spreads are named by their points per square metre, walks by the distance of their lines.
// Prints for each terrain, spread of points, noise and seed: edges found, and the RMSE of the linear surface
// without and with them, within 1 m of risers (true slope above 30 degrees over 0.6 m) and elsewhere.
// Usage: bench_terrace_edges FIRST_SEED LAST_SEED [random|walk]

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <map>
#include <utility>

#include "fusion/random_numbers.hpp"
#include "fusion/simulated_terrain.hpp"
#include "fusion/simulation.hpp"
#include "mapping/constrained_tin.hpp"
#include "mapping/delaunay_tin.hpp"
#include "mapping/gridding.hpp"
#include "mapping/ground_points.hpp"
#include "mapping/terrace_edges.hpp"
#include "mapping/thinning.hpp"

namespace {

using namespace terrawalk;
using Points = std::vector<Eigen::Vector3d>;
using Truth = std::function<double(double e_m, double n_m)>;

constexpr double kCell_m = 0.2;
constexpr double kZone_m = 1.0;
constexpr double kRiserSlope = 0.577;

/// Points at random, as a scanner or a surveyor would leave them.
Points scattered(const TerrainModel& terrain, double per_m2, double noise_m, std::uint64_t seed) {
    RandomNumbers random({seed, 77});
    Points points;
    const auto count = static_cast<std::size_t>(per_m2 * 50.0 * 60.0);
    for (std::size_t i = 0; i < count; ++i) {
        const double e = random.uniform(-25.0, 25.0);
        const double n = random.uniform(-10.0, 50.0);
        points.emplace_back(e, n, terrain.height_m(e, n) + noise_m * random.normal());
    }
    return points;
}

/// Points along the walk of a simulated survey, at their true places, thinned as the pipeline does. The lines
/// run along the terraces.
Points walked(SimulatedTerrain kind, double line_spacing_m, double noise_m, std::uint64_t seed,
              Truth& truth) {
    SimulationOptions options;
    options.seed = seed;
    options.terrain = kind;
    options.faults = FaultLevel::None;
    options.noise_scale = 0.0;
    options.fixed_point_runs = 0;
    options.control_stops = 0;
    // The same pace on a longer way.
    options.area_epochs = static_cast<std::size_t>(static_cast<double>(options.area_epochs) *
                                                   options.line_spacing_m / line_spacing_m);
    options.line_spacing_m = line_spacing_m;
    SilentProgress progress;
    const auto made = simulateSurvey(options, progress, {});
    if (!made) {
        fmt::print(stderr, "{}\n", made.error().message);
        std::exit(1);
    }
    truth = made->terrain_height_m;
    std::vector<GroundPoint> ground;
    for (std::size_t r = 0; r < made->survey.runs.size(); ++r) {
        const auto more =
            groundPoints(made->survey.runs[r], static_cast<std::uint32_t>(r), made->truth[r], {});
        ground.insert(ground.end(), more.begin(), more.end());
    }
    RandomNumbers random({seed, 78});
    for (GroundPoint& point : ground) point.enu_m.z() += noise_m * random.normal();
    Points points;
    for (const GroundPoint& point : thinGroundPoints(std::move(ground), 0.5)) {
        if (point.state == GroundPointState::Used) points.push_back(point.enu_m);
    }
    return points;
}

struct Errors {
    double near = 0.0, elsewhere = 0.0;
    std::size_t near_cells = 0, cells = 0;
};

/// Cells within the zone around steep ground.
std::vector<bool> nearRisers(const Truth& truth, const GridGeometry& g) {
    const auto slope = [&](double e, double n) {
        return std::hypot(truth(e + 0.3, n) - truth(e - 0.3, n), truth(e, n + 0.3) - truth(e, n - 0.3)) / 0.6;
    };
    std::vector<bool> steep(g.size()), near(g.size());
    for (std::size_t r = 0; r < g.rows; ++r)
        for (std::size_t c = 0; c < g.columns; ++c)
            steep[r * g.columns + c] = slope(g.centreX(c), g.centreY(r)) > kRiserSlope;
    const auto reach = static_cast<std::ptrdiff_t>(kZone_m / g.cell_m);
    for (std::size_t r = 0; r < g.rows; ++r)
        for (std::size_t c = 0; c < g.columns; ++c) {
            if (!steep[r * g.columns + c]) continue;
            for (std::ptrdiff_t i = -reach; i <= reach; ++i)
                for (std::ptrdiff_t j = -reach; j <= reach; ++j) {
                    const auto rr = static_cast<std::ptrdiff_t>(r) + i,
                               cc = static_cast<std::ptrdiff_t>(c) + j;
                    if (i * i + j * j > reach * reach || rr < 0 || cc < 0 ||
                        rr >= static_cast<std::ptrdiff_t>(g.rows) ||
                        cc >= static_cast<std::ptrdiff_t>(g.columns))
                        continue;
                    near[static_cast<std::size_t>(rr) * g.columns + static_cast<std::size_t>(cc)] = true;
                }
        }
    return near;
}

Errors errorsOf(const ElevationGrid& dem, const ElevationGrid& other, const Truth& truth,
                const std::vector<bool>& near) {
    Errors e;
    const GridGeometry& g = dem.geometry;
    for (std::size_t i = 0; i < g.size(); ++i) {
        if (std::isnan(dem.heights_m[i]) || std::isnan(other.heights_m[i])) continue;
        const double d = dem.heights_m[i] - truth(g.centreX(i % g.columns), g.centreY(i / g.columns));
        (near[i] ? e.near : e.elsewhere) += d * d;
        ++(near[i] ? e.near_cells : e.cells);
    }
    e.near = std::sqrt(e.near / static_cast<double>(std::max<std::size_t>(1, e.near_cells)));
    e.elsewhere = std::sqrt(e.elsewhere / static_cast<double>(std::max<std::size_t>(1, e.cells)));
    return e;
}

template <class T>
T must(Result<T> result) {
    if (result) return std::move(*result);
    fmt::print(stderr, "{}\n", result.error().message);
    std::exit(1);
}

/// Squared errors near risers over all seeds, by spread and noise, and the worst of elsewhere.
struct Summary {
    struct Sums {
        double before = 0.0, after = 0.0, noise = 0.0;
    };
    std::map<std::pair<std::string, double>, Sums> near;
    double worst_elsewhere = 0.0;

    void add(const std::string& spread, double noise_m, const Errors& before, const Errors& after,
             const Errors& noise) {
        const auto cells = static_cast<double>(before.near_cells);
        near[{spread, noise_m}].noise += cells * noise.near * noise.near;
        near[{spread, noise_m}].before += cells * before.near * before.near;
        near[{spread, noise_m}].after += cells * after.near * after.near;
    }
    void print() const {
        fmt::print(
            "\nTerraces, all seeds: RMSE within 1 m of a riser with edges over that without, and the part "
            "of\n"
            "the latter that is the points' noise alone, which no edge takes away\n");
        for (const auto& [key, sums] : near) {
            fmt::print("{:<12}{:>5.2f}{:>8.3f}{:>8.3f}\n", key.first, key.second,
                       std::sqrt(sums.after / sums.before), std::sqrt(sums.noise / sums.before));
        }
        fmt::print("All terrains, worst ratio elsewhere: {:.3f}\n", worst_elsewhere);
    }
};

void measure(Summary& summary, SimulatedTerrain kind, const std::string& spread, const Points& points,
             double noise_m, std::uint64_t seed, const Truth& truth) {
    SilentProgress progress;
    const auto start = std::chrono::steady_clock::now();
    const TerraceEdges found = must(findTerraceEdges(points, {}, {}, progress, {}));
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const DelaunayTin plain = must(DelaunayTin::build(points, {}, progress, {}));
    const GridGeometry g = must(gridCovering(plain.mesh(), kCell_m));
    const ConstrainedTin edged =
        must(buildConstrainedTin(points, softBreaklines(found.edges), {plain.longestEdge_m()}, progress, {}));
    const std::vector<bool> near = nearRisers(truth, g);
    const ElevationGrid before = must(rasterize(plain.mesh(), g, progress, {}));
    const ElevationGrid after = must(rasterize(edged.groundMesh(), g, progress, {}));
    const Errors a = errorsOf(before, after, truth, near), b = errorsOf(after, before, truth, near);
    // The same points without the ground under them.
    TriangleMesh noise_alone = plain.mesh();
    for (Eigen::Vector3d& vertex : noise_alone.vertices_m) vertex.z() -= truth(vertex.x(), vertex.y());
    const ElevationGrid noise = must(rasterize(noise_alone, g, progress, {}));
    const Errors c = errorsOf(
        noise, after, [](double, double) { return 0.0; }, near);
    if (kind == SimulatedTerrain::TerracedOrchard) summary.add(spread, noise_m, a, b, c);
    summary.worst_elsewhere = std::max(summary.worst_elsewhere, b.elsewhere / a.elsewhere);
    double length_m = 0.0, sigma = 0.0;
    for (const TerraceEdge& edge : found.edges) {
        length_m += edge.length_m;
        sigma += edge.length_m * edge.location_sigma_m;
    }
    const double area_m2 = kCell_m * kCell_m;
    fmt::print(
        "{:<17}{:<12}{:>5.2f}{:>6}{:>7}{:>6}{:>8.0f}{:>7.2f} |{:>7.0f}{:>8.4f}{:>8.4f}{:>7.3f} "
        "|{:>8.4f}{:>8.4f}{:>7.3f} |{:>6.2f}\n",
        name(kind), spread, noise_m, seed, points.size(), found.edges.size(), length_m,
        length_m > 0 ? sigma / length_m : 0.0, area_m2 * static_cast<double>(a.near_cells), a.near, b.near,
        a.near_cells > 0 ? b.near / a.near : 1.0, a.elsewhere, b.elsewhere, b.elsewhere / a.elsewhere,
        seconds);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 3 && argc != 4) {
        fmt::print(stderr, "usage: bench_terrace_edges FIRST_SEED LAST_SEED [random|walk]\n");
        return 2;
    }
    fmt::print("{:<17}{:<12}{:>5}{:>6}{:>7}{:>6}{:>8}{:>7} |{:>7}{:>8}{:>8}{:>7} |{:>8}{:>8}{:>7} |{:>6}\n",
               "terrain", "points", "noise", "seed", "n", "edges", "len m", "sigma", "zone m2", "near",
               "edged", "ratio", "else", "edged", "ratio", "s");
    Summary summary;
    const std::string only = argc == 4 ? argv[3] : "";
    for (std::uint64_t seed = std::stoull(argv[1]); seed <= std::stoull(argv[2]); ++seed) {
        for (const SimulatedTerrain kind : {SimulatedTerrain::TerracedOrchard, SimulatedTerrain::Gully,
                                            SimulatedTerrain::Plain, SimulatedTerrain::Ridge}) {
            const TerrainModel terrain(kind, seed);
            for (const double noise_m : {0.02, 0.1, 0.3}) {
                for (const double per_m2 : {0.5, 1.0, 4.0}) {
                    if (only == "walk") break;
                    measure(summary, kind, fmt::format("random {:g}", per_m2),
                            scattered(terrain, per_m2, noise_m, seed), noise_m, seed,
                            [&](double e, double n) { return terrain.height_m(e, n); });
                }
                if (only == "random") continue;
                for (const double spacing_m : {1.5, 3.0}) {
                    Truth truth;
                    const Points points = walked(kind, spacing_m, noise_m, seed, truth);
                    measure(summary, kind, fmt::format("walk {:g}", spacing_m), points, noise_m, seed, truth);
                }
            }
        }
    }
    summary.print();
}
