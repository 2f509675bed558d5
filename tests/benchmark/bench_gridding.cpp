// From points in a file to a GeoTIFF, as processes: `terrawalk surface` beside `gdal_grid -a linear` on the
// same points and cells, in turn; CPU seconds of all threads, peak memory, error against the true surface.
// Then Terrawalk alone: the default command, ten million points, natural neighbours, and how the cost grows.
// Run as: bench_gridding [repeats] [folder for gridding_cost.csv and .svg]

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "io/plot.hpp"
#include "io/read_dem.hpp"
#include "tests/support/run_program.hpp"
#include "tests/support/temporary_folder.hpp"

namespace {

using namespace terrawalk;
namespace fs = std::filesystem;

constexpr double kSide_m = 1000.0;
constexpr double kCell_m = 0.3125;  // 3200 x 3200 cells, a whole number of cells from any zero
constexpr std::uint64_t kSeed = 1;

/// Where the points lie: qhull, under gdal_grid, works several times longer far from the origin.
struct Place {
    std::string name;
    double west_m, south_m;
};
const std::array<Place, 2> kPlaces{{{"map", 500'000.0, 2'565'000.0}, {"local", 0.0, 0.0}}};

double trueHeight(double x_m, double y_m) {
    return 40.0 + 3.0 * std::sin(x_m / 9.0) * std::cos(y_m / 7.0);
}

/// Random points with heights of the true surface, to the tenth of a millimetre.
fs::path writePoints(const fs::path& folder, const Place& place, std::size_t count) {
    std::mt19937_64 engine(kSeed);
    const auto unit = [&] {
        return static_cast<double>(engine() >> 11) * 0x1p-53;
    };
    const fs::path file = folder / fmt::format("{}_{}.csv", place.name, count);
    std::ofstream out(file, std::ios::binary);
    out << "x_m,y_m,z_m\n";
    for (std::size_t i = 0; i < count; ++i) {
        const double x_m = kSide_m * unit(), y_m = kSide_m * unit();
        out << fmt::format("{:.4f},{:.4f},{:.4f}\n", place.west_m + x_m, place.south_m + y_m,
                           trueHeight(x_m, y_m));
    }
    return file;
}

/// What makes OGR read the table as points.
fs::path writeVrt(const fs::path& table) {
    fs::path file = table;
    file.replace_extension(".vrt");
    std::ofstream(file) << fmt::format(
        "<OGRVRTDataSource><OGRVRTLayer name=\"{}\"><SrcDataSource>{}</SrcDataSource>"
        "<GeometryType>wkbPoint25D</GeometryType><GeometryField encoding=\"PointFromColumns\" x=\"x_m\" "
        "y=\"y_m\" z=\"z_m\"/></OGRVRTLayer></OGRVRTDataSource>",
        table.stem().string(), table.string());
    return file;
}

/// Root mean square of DEM less true surface at the cell centres; the rim, where only one of them may have
/// heights, is left out.
double rmse(const fs::path& dem, const Place& place) {
    const auto read = readDem(dem, {});
    if (!read) throw std::runtime_error(read.error().text());
    const GridGeometry& g = read->grid.geometry;
    constexpr double kRim_m = 5.0;
    double squares = 0.0, n = 0.0;
    for (std::size_t row = 0; row < g.rows; ++row) {
        const double y_m = g.centreY(row) - place.south_m;
        for (std::size_t column = 0; column < g.columns; ++column) {
            const double x_m = g.centreX(column) - place.west_m;
            if (std::min({x_m, y_m, kSide_m - x_m, kSide_m - y_m}) < kRim_m) continue;
            const double d = double{read->grid.at(row, column)} - trueHeight(x_m, y_m);
            if (!std::isfinite(d)) throw std::runtime_error("a hole in " + dem.string());
            squares += d * d;
            n += 1.0;
        }
    }
    return std::sqrt(squares / n);
}

struct Runs {
    std::vector<double> cpu_s;
    double peak_mib = 0.0;
    double rmse_m = 0.0;

    void add(const std::vector<std::string>& command) {
        const auto outcome = test::runProgram(command);
        if (outcome.exit_code != 0) throw std::runtime_error(outcome.err);
        cpu_s.push_back(outcome.cpu_seconds);
        peak_mib = std::max(peak_mib, static_cast<double>(outcome.peak_memory_kib) / 1024.0);
    }
    [[nodiscard]] double median() const {
        auto sorted = cpu_s;
        std::sort(sorted.begin(), sorted.end());
        return sorted[sorted.size() / 2];
    }
    void print(const std::string& what) const {
        const auto [least, greatest] = std::minmax_element(cpu_s.begin(), cpu_s.end());
        fmt::print("{:<52}{:>8.2f}{:>8.2f}{:>8.2f}{:>9.0f}", what, *least, median(), *greatest, peak_mib);
        fmt::print("{}\n", rmse_m > 0.0 ? fmt::format("{:>11.6f}", rmse_m) : "");
    }
};

std::vector<std::string> surfaceCommand(const fs::path& points, const fs::path& dem, double cell_m,
                                        const Place& place, const std::vector<std::string>& more) {
    std::vector<std::string> command{TERRAWALK_PROGRAM,
                                     "surface",
                                     points.string(),
                                     "-o",
                                     dem.string(),
                                     "--quiet",
                                     "--resolution",
                                     fmt::format("{}", cell_m),
                                     "--extent",
                                     fmt::format("{},{},{},{}", place.west_m, place.south_m,
                                                 place.west_m + kSide_m, place.south_m + kSide_m)};
    command.insert(command.end(), more.begin(), more.end());
    return command;
}

/// A linear surface over all triangles and nothing else: what gdal_grid makes too.
const std::vector<std::string> kPlain{"--method",       "linear", "--no-validation", "--terrace-edges", "off",
                                      "--longest-edge", "100"};

std::vector<std::string> gdalCommand(const fs::path& vrt, const fs::path& dem, const Place& place,
                                     bool compressed) {
    const auto cells = fmt::format("{:.0f}", kSide_m / kCell_m);
    const auto number = [](double value) {
        return fmt::format("{}", value);
    };
    std::vector<std::string> command{"/usr/bin/gdal_grid",
                                     "-q",
                                     "-a",
                                     "linear:radius=0:nodata=-9999",
                                     "-ot",
                                     "Float32",
                                     "-txe",
                                     number(place.west_m),
                                     number(place.west_m + kSide_m),
                                     "-tye",
                                     number(place.south_m + kSide_m),
                                     number(place.south_m),
                                     "-outsize",
                                     cells,
                                     cells,
                                     "-l",
                                     vrt.stem().string()};
    if (compressed) {
        for (const char* option : {"COMPRESS=DEFLATE", "PREDICTOR=3", "TILED=YES"}) {
            command.insert(command.end(), {"-co", option});
        }
    }
    command.insert(command.end(), {vrt.string(), dem.string()});
    return command;
}

void comparePeers(const fs::path& folder, int repeats) {
    for (const Place& place : kPlaces) {
        const fs::path points = writePoints(folder, place, 1'000'000), vrt = writeVrt(points);
        const fs::path ours = folder / "terrawalk.tif", theirs = folder / "gdal.tif";
        // What gdal_grid writes: cells alone, not packed, no overviews.
        std::vector<std::string> alike = kPlain;
        alike.insert(alike.end(), {"--compression", "none", "--no-overviews"});
        Runs plain, bare, gdal, gdal_compressed;
        for (int i = 0; i < repeats; ++i) {
            plain.add(surfaceCommand(points, ours, kCell_m, place, kPlain));
            bare.add(surfaceCommand(points, folder / "bare.tif", kCell_m, place, alike));
            gdal.add(gdalCommand(vrt, theirs, place, false));
            if (i == 0) gdal.rmse_m = rmse(theirs, place);
            gdal_compressed.add(gdalCommand(vrt, theirs, place, true));
        }
        plain.rmse_m = rmse(ours, place);
        bare.rmse_m = rmse(folder / "bare.tif", place);
        plain.print(place.name + ": terrawalk surface, linear");
        bare.print(place.name + ": the same, not compressed, no overviews");
        gdal.print(place.name + ": gdal_grid -a linear, not compressed");
        gdal_compressed.print(place.name + ": gdal_grid -a linear, compressed");
        fmt::print("    like for like {:.1f} times less CPU, {:.2f} of the memory\n",
                   gdal.median() / bare.median(), bare.peak_mib / gdal.peak_mib);
        fmt::print("    by default {:.1f}, compressed {:.1f} times less CPU, {:.2f} of the memory\n",
                   gdal.median() / plain.median(), gdal_compressed.median() / plain.median(),
                   plain.peak_mib / gdal.peak_mib);
    }
}

void measureAlone(const fs::path& folder, int repeats) {
    const Place& place = kPlaces.front();
    const fs::path million = folder / fmt::format("{}_1000000.csv", place.name);
    const fs::path dem = folder / "alone.tif";
    Runs natural, standard, many;
    const fs::path ten_million = writePoints(folder, place, 10'000'000);
    for (int i = 0; i < repeats; ++i) {
        natural.add(
            surfaceCommand(million, dem, 1.0, place, {"--method", "natural-neighbour", "--no-validation"}));
        many.add(surfaceCommand(ten_million, dem, kCell_m, place, kPlain));
    }
    standard.add(surfaceCommand(million, dem, kCell_m, place, {}));
    many.print("ten million points, linear");
    natural.print("natural neighbours, a million cells");
    standard.print("a million points, default command, once");
}

/// CPU seconds for n points and n cells, n = 10^4 to 10^7.
void measureGrowth(const fs::path& folder, int repeats, const fs::path& output) {
    const Place& place = kPlaces.front();
    std::string csv = "points,cells,repeats,cpu_min_s,cpu_median_s,cpu_max_s,peak_mib,seed\n";
    PlotSeries measured{"terrawalk surface, linear", {}, SeriesLook::Points, 0};
    for (const std::size_t n : {10'000U, 30'000U, 100'000U, 300'000U, 1'000'000U, 3'000'000U, 10'000'000U}) {
        const fs::path points = writePoints(folder, place, n);
        const double cell_m = kSide_m / std::round(std::sqrt(static_cast<double>(n)));
        Runs runs;
        for (int i = 0; i < repeats; ++i) {
            runs.add(surfaceCommand(points, folder / "growth.tif", cell_m, place, kPlain));
        }
        const auto [least, greatest] = std::minmax_element(runs.cpu_s.begin(), runs.cpu_s.end());
        fmt::format_to(std::back_inserter(csv), "{},{:.0f},{},{:.3f},{:.3f},{:.3f},{:.0f},{}\n", n,
                       std::pow(std::round(kSide_m / cell_m), 2.0), repeats, *least, runs.median(), *greatest,
                       runs.peak_mib, kSeed);
        measured.points.emplace_back(static_cast<double>(n), runs.median());
        runs.print(fmt::format("{} points and as many cells", n));
    }
    // What starting the program costs, and what each n log n costs, through the ends.
    const auto n_log_n = [](double n) {
        return n * std::log2(n);
    };
    const auto& [few, start_s] = measured.points.front();
    const auto& [most, longest_s] = measured.points.back();
    const double slope = (longest_s - start_s) / (n_log_n(most) - n_log_n(few));
    PlotSeries curve{"start + c n log n, through the ends", {}, SeriesLook::Dashed, 1};
    for (double n = few; n <= 1.001 * most; n *= std::pow(10.0, 0.1)) {
        curve.points.emplace_back(n, start_s + slope * (n_log_n(n) - n_log_n(few)));
    }
    const Plot plot{
        "Cost of a linear surface",
        fmt::format("Random points of an analytic surface (simulated, seed {}), as many cells; CPU "
                    "of the whole process, median of {}",
                    kSeed, repeats),
        {{"", {"points", true}, {"CPU seconds", true}, {measured, curve}, {}}}};
    fs::create_directories(output);
    std::ofstream(output / "gridding_cost.csv", std::ios::binary) << csv;
    std::ofstream(output / "gridding_cost.svg", std::ios::binary) << plotSvg(plot);
}

}  // namespace

int main(int argc, char** argv) {
    const int repeats = argc > 1 ? std::max(1, std::atoi(argv[1])) : 3;
    try {
        const test::TemporaryFolder folder;
        fmt::print(
            "{} repeats in turn, seed {}; CPU seconds of all threads\n{:<52}{:>8}{:>8}{:>8}{:>9}{:>11}\n",
            repeats, kSeed, "a million points, ten million cells", "min", "median", "max", "peak MiB",
            "RMSE m");
        comparePeers(folder.path(), repeats);
        measureAlone(folder.path(), repeats);
        measureGrowth(folder.path(), repeats, argc > 2 ? fs::path(argv[2]) : folder.path());
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}\n", error.what());
        return 1;
    }
    return 0;
}
