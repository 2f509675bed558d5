#include "app/cli/export_options.hpp"

#include "app/cli/choice_option.hpp"

namespace terrawalk {

void addExportOptions(CLI::App& command, ExportRequest& r) {
    command.add_option("input", r.input, "Folder that `terrawalk process` wrote")->required();
    command.add_option("-o,--output", r.output, "Folder for the files [INPUT-export]");
    addChoices(command, "--points", r.points, kPointFormats, "Ground points");
    addChoices(command, "--mesh", r.meshes, kMeshFormats, "Surface, beside its PLY and OBJ");
    addChoices(command, "--dem", r.grids, kGridFormats, "Heights, beside their GeoTIFF");
    command.add_flag("--all-points", r.all_points, "Also points that were not used, with their reasons");
}

void addOccupancyOptions(CLI::App& command, OccupancyRequest& r) {
    command.add_option("input", r.input, "Folder that `terrawalk process` wrote")->required();
    command.add_option("-o,--output", r.output, "Folder for the files [INPUT-occupancy]");
    const auto number = [&](const char* option, double& value, double least, double greatest,
                            const char* meaning) {
        command.add_option(option, value, meaning)->check(CLI::Range(least, greatest))->capture_default_str();
    };
    number("--voxel", r.map.occupancy.voxel_m, 0.01, 10.0, "Side of a voxel, m");
    number("--greatest-range", r.map.occupancy.greatest_range_m, 0.1, 1000.0,
           "Of a longer ray the first part counts as free, its hit for nothing, m");
    number("--ground-layer", r.map.above.ground_layer_m, 0.0, 5.0,
           "What lies lower above the DEM counts as ground, m");
    number("--greatest-height", r.map.above.greatest_height_m, 0.1, 100.0, "How far up to look, m");
}

}  // namespace terrawalk
