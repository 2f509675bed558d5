#include "app/cli/surface_options.hpp"

#include <array>
#include <string>
#include <vector>

#include "app/cli/choice_option.hpp"

namespace terrawalk {

void addSurfaceOptions(CLI::App& command, SurfaceRequest& r) {
    command.add_option("points", r.points, "Ground points: .csv .txt .xyz .las .ply .gpkg .shp .geojson")
        ->required();
    command.add_option("-o,--output", r.output, "GeoTIFF to write; its report goes beside it as .json")
        ->required();
    std::string list = "auto";
    std::vector<std::string> names{"auto"};
    for (const auto& [method, text] : kInterpolationMethods) {
        names.emplace_back(text);
        list += ", " + std::string(text);
    }
    command
        .add_option_function<std::string>(
            "--method",
            [&r](const std::string& chosen) {
                r.model.method.reset();
                for (const auto& [method, text] : kInterpolationMethods) {
                    if (text == chosen) r.model.method = method;
                }
            },
            "How heights are interpolated; auto takes the best by cross-validation: " + list)
        ->check(CLI::IsMember(names))
        ->option_text("NAME [auto]");
    command
        .add_option_function<std::vector<std::string>>(
            "--clean",
            [&r](const std::vector<std::string>& filters) {
                for (const std::string& filter : filters) {
                    if (filter == "statistical") r.cleaning.statistical.use = true;
                    if (filter == "radius") r.cleaning.radius.use = true;
                    if (filter == "above-ground") r.cleaning.above_ground.use = true;
                }
            },
            "Points to leave out: statistical (far from their neighbours), radius (isolated), above-ground "
            "(on plants and other narrow things); several with commas [none]")
        ->delimiter(',')
        ->check(CLI::IsMember({"statistical", "radius", "above-ground"}))
        ->type_name("FILTER,...");
    command.add_option(
        "--thin", r.thinning_cell_m,
        "Side of a cell, m, in which the point of median height stands for all [0, all points]");
    command
        .add_option("--resolution", r.resolution, "Side of a cell, in the points' unit [from their spacing]")
        ->check(aboveZero());
    command
        .add_option_function<std::vector<double>>(
            "--extent",
            [&r](const std::vector<double>& e) {
                r.extent = std::array{e[0], e[1], e[2], e[3]};
            },
            "xmin,ymin,xmax,ymax of the grid, widened to whole cells [all points]")
        ->delimiter(',')
        ->expected(4)
        ->type_name("X,Y,X,Y");
    command
        .add_option(
            "--breaklines", r.breaklines,
            "Lines that linear and clough-tocher follow: a vector file, kind hard, soft, boundary or hole")
        ->type_name("FILE");
    addChoice(command, "--terrace-edges", r.model.terrace_edges, kTerraceEdgeUses,
              "Whether risers of half a metre and more are found, for linear and clough-tocher to follow");
    command.add_flag(
        "--multiband", r.multiband,
        "Write heights and standard errors in one file as well, bands in the order of BAG; kriging "
        "has them");
    addChoice(
        command, "--compression", r.storage.compression, kRasterCompressions,
        "How cells are packed in the GeoTIFF; deflate is the smallest, none the fastest, and zstd in between "
        "needs a libtiff of 2018 or later");
    command.add_flag_callback(
        "--no-overviews", [&r] { r.storage.overviews = false; },
        "Leave out the smaller rasters in the file, which let programs draw it fast when zoomed out");
    command.add_option("--longest-edge", r.model.longest_edge_m,
                       "Triangles with a longer edge count as gap and stay empty [from the points]");
    command.add_option("--crs", r.crs, "CRS of the points, e.g. EPSG:2994 [the file's own]");
    command.add_option("--unit", r.unit, "m, ft or us-ft [of the CRS or the file, else m]");
    command
        .add_option("--las-class", r.las_classes,
                    "Class of LAS points that count; may be repeated [2, ground]")
        ->allow_extra_args(false);
    command.add_flag_callback(
        "--no-validation", [&r] { r.model.cross_validate = false; },
        "Do not cross-validate a method that was named");
    command.add_option("--seed", r.model.seed, "Of the cross-validation")->capture_default_str();
}

void addVolumeOptions(CLI::App& command, VolumeRequest& r) {
    command.add_option("dem", r.dem, "Raster of heights, e.g. of `terrawalk surface`")->required();
    CLI::Option* const plane =
        command.add_option("--plane", r.plane, "Height of a level plane to compare with");
    command.add_option("--against", r.against, "Another DEM on the same cells to compare with")
        ->type_name("FILE")
        ->excludes(plane);
    command.add_option("--uncertainty", r.uncertainty, "Raster of the DEM's standard errors")
        ->type_name("FILE");
    command.add_option("--against-uncertainty", r.against_uncertainty, "The same of the other DEM")
        ->type_name("FILE");
    command.add_option("--sigma", r.sigma, "Standard error of a height where no raster tells it")
        ->capture_default_str();
    command.add_option(
        "--correlation-range", r.correlation_range,
        "Distance beyond which height errors are independent; 0: each cell on its own [as the rasters "
        "of standard errors tell, else 0]");
    command
        .add_option("--common-sigma", r.common_sigma,
                    "Standard error of what all cells share, such as a datum")
        ->capture_default_str();
}

}  // namespace terrawalk
