#include "app/pipeline/dem_coverage.hpp"

#include <cmath>
#include <vector>

#include "app/pipeline/process.hpp"
#include "fusion/random_numbers.hpp"
#include "mapping/volume.hpp"

namespace terrawalk {

namespace {

constexpr std::size_t kCells = 500;
constexpr std::uint64_t kCellStream = 0x636f766572616765;  // "coverage"

}  // namespace

Result<DemCoverage> measureDemCoverage(const SimulatedSurvey& simulated, const PipelineConfig& config,
                                       std::uint64_t seed, Progress& progress, std::stop_token stop) {
    Survey survey = simulated.survey;
    survey.crs.clear();  // so that the map frame is the frame of the truth
    const auto products = process(survey, config, progress, stop);
    if (!products) return tl::unexpected(products.error());
    if (!products->uncertainty) return badData("the DEM has no standard errors");
    const GridGeometry& g = products->dem.geometry;
    const std::vector<float>& heights = products->dem.heights_m;
    const std::vector<float>& sigmas = products->uncertainty->sigmas_m;

    std::vector<std::size_t> known;
    double mean_m = 0.0;
    for (std::size_t i = 0; i < heights.size(); ++i) {
        if (std::isnan(heights[i])) continue;
        known.push_back(i);
        mean_m += (static_cast<double>(heights[i]) - mean_m) / static_cast<double>(known.size());
    }
    const auto truth = [&](std::size_t cell) {
        return simulated.terrain_height_m(g.centreX(cell % g.columns), g.centreY(cell / g.columns));
    };
    DemCoverage coverage;
    RandomNumbers random{seed, kCellStream};
    double squares = 0.0;
    for (std::size_t k = 0; k < kCells; ++k) {
        const std::size_t cell = known[random.index(known.size())];
        const double error_m = static_cast<double>(heights[cell]) - truth(cell);
        const double sigma_m = sigmas[cell];
        coverage.heights.add(error_m, sigma_m);
        squares += error_m * error_m;
        coverage.mean_sigma_m += sigma_m / static_cast<double>(kCells);
    }
    coverage.rms_error_m = std::sqrt(squares / static_cast<double>(kCells));

    ElevationGrid above_plane = products->dem;
    double true_m3 = 0.0;
    for (const std::size_t cell : known) {
        above_plane.heights_m[cell] = static_cast<float>(static_cast<double>(heights[cell]) - mean_m);
        true_m3 += (truth(cell) - mean_m) * g.cell_m * g.cell_m;
    }
    coverage.error_range_m = products->uncertainty->correlation_range_m;
    const VolumeResult volume =
        volumeOf(above_plane, {.sigmas_m = sigmas, .correlation_range_m = coverage.error_range_m}).value();
    coverage.volume_error_m3 = volume.net_m3 - true_m3;
    coverage.volume_sigma_m3 = volume.net_sigma_m3;
    coverage.area_m2 = volume.area_m2;
    return coverage;
}

}  // namespace terrawalk
