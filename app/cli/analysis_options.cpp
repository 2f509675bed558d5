#include "app/cli/analysis_options.hpp"

#include <map>
#include <string>

#include "app/cli/choice_option.hpp"
#include "survey/frames.hpp"

namespace terrawalk {

namespace {

CLI::Option* addFile(CLI::App& command, const char* option, std::filesystem::path& file,
                     const char* meaning) {
    return command.add_option(option, file, meaning)->type_name("FILE");
}

void addMarkSource(CLI::App& command, MarkSource& source) {
    CLI::Option* const marks =
        addFile(command, "--marks", source.marks, "Marks of a survey (control.csv), in its local frame");
    command
        .add_option("--survey", source.survey_output,
                    "Folder of `terrawalk process` that knows that frame [the DEM's folder]")
        ->needs(marks);
    addFile(command, "--check-points", source.check_points,
            "Points in the DEM's own CRS: .csv .las .ply .gpkg, with sigma_z where it is known")
        ->excludes(marks);
}

void addCorners(CLI::App& command, const char* option, std::vector<Eigen::Vector2d>& path, std::size_t place,
                const char* meaning) {
    command
        .add_option_function<std::vector<double>>(
            option,
            [&path, place](const std::vector<double>& xy) {
                if (path.size() <= place) path.resize(place + 1, Eigen::Vector2d::Zero());
                path[place] = {xy[0], xy[1]};
            },
            meaning)
        ->delimiter(',')
        ->expected(2)
        ->type_name("X,Y");
}

}  // namespace

void addContourOptions(CLI::App& command, ContourRequest& r) {
    command.add_option("dem", r.dem, "Raster of heights")->required();
    command.add_option("-o,--output", r.output, "File to write: .gpkg, .geojson or .dxf")->required();
    command.add_option("--interval", r.options.interval, "Between levels, in the DEM's unit")
        ->capture_default_str();
    command.add_option("--base", r.options.base, "A level that the others are counted from")
        ->capture_default_str();
    command
        .add_option("--smoothing", r.options.smoothing_cells,
                    "Standard deviation of the Gaussian that the heights go through first, in cells; 0: none")
        ->capture_default_str();
    addFile(command, "--uncertainty", r.uncertainty,
            "Raster of standard errors that heights are smoothed further within [DEM_uncertainty.tif]");
    command
        .add_option("--index-every", r.options.index_every, "Every so many levels one is an index contour")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
}

void addDifferenceOptions(CLI::App& command, DifferenceRequest& r) {
    command.add_option("earlier", r.earlier, "DEM of the earlier survey")->required();
    command.add_option("later", r.later, "DEM of the later survey, on the same cells")->required();
    command.add_option("-o,--output", r.output, "GeoTIFF of the change, later less earlier")
        ->capture_default_str();
    addFile(command, "--earlier-uncertainty", r.earlier_uncertainty, "Raster of the earlier standard errors");
    addFile(command, "--later-uncertainty", r.later_uncertainty, "Raster of the later standard errors");
    command.add_option("--sigma", r.sigma, "Standard error of one DEM's height where no raster tells it")
        ->capture_default_str();
    command.add_option(
        "--correlation-range", r.correlation_range,
        "Distance beyond which height errors are independent; 0: each cell on its own [as the rasters "
        "of standard errors tell, else 0]");
    command
        .add_option("--common-sigma", r.common_sigma,
                    "Standard error of the change that all cells share, such as a datum")
        ->capture_default_str();
}

void addProfileOptions(CLI::App& command, ProfileRequest& r) {
    command.add_option("dem", r.dem, "Raster of heights")->required();
    addFile(command, "--line", r.line, "Vector file with the one line to follow");
    addCorners(command, "--from", r.path, 0, "Where a straight profile begins");
    addCorners(command, "--to", r.path, 1, "Where it ends");
    command.get_option("--from")->needs("--to")->excludes("--line");
    command.get_option("--to")->needs("--from")->excludes("--line");
    command.add_option("-o,--output", r.output, "Table to write; the drawing goes beside it as .svg")
        ->capture_default_str();
    addFile(command, "--uncertainty", r.uncertainty, "Raster of standard errors, drawn as a ribbon");
    command.add_option("--step", r.step, "Between points along the line [half a cell]")->check(aboveZero());
    addMarkSource(command, r.marks);
    command.add_option("--mark-distance", r.mark_distance,
                       "Marks farther from the line are left out [two cells]");
}

void addDeriveOptions(CLI::App& command, DeriveRequest& r) {
    command.add_option("dem", r.dem, "Raster of heights")->required();
    command.add_option("-o,--output", r.output, "Folder for DEM_slope.tif and so on [that of the DEM]");
    const auto flag = [&](const char* option, std::vector<Derivative> derivatives, const char* meaning) {
        command.add_flag_callback(
            option,
            [&r, derivatives] {
                r.derivatives.insert(r.derivatives.end(), derivatives.begin(), derivatives.end());
            },
            meaning);
    };
    flag("--hillshade", {Derivative::Hillshade}, "Light from the sun, 1 to 255 (Horn)");
    flag("--slope", {Derivative::Slope}, "Steepness (Horn)");
    flag("--aspect", {Derivative::Aspect}, "Way down, degrees clockwise from north (Horn)");
    flag("--curvature", {Derivative::Curvature, Derivative::ProfileCurvature, Derivative::PlanCurvature},
         "In all, along and across the slope, convex positive (Zevenbergen and Thorne)");
    flag("--roughness", {Derivative::Roughness}, "Range of heights in nine cells");
    command.add_flag("--flow-accumulation", r.flow_accumulation,
                     "Area that drains through each cell (priority flood, D8)");
    command.add_flag("--flow-accumulation-dinf", r.flow_accumulation_dinf,
                     "The same by D-infinity: slopes without stripes, valleys that spread");
    command.add_flag("--wet-spots", r.wet_spots, "Depth of water that stands before it spills");
    addChoice(command, "--slope-unit", r.options.slope_unit, kSlopeUnits, "Of the slope");
    const auto angle = [&](const char* option, double& radians_value, const char* meaning, double most) {
        command
            .add_option_function<double>(
                option, [&radians_value](double value) { radians_value = radians(value); }, meaning)
            ->check(CLI::Range(0.0, most));
    };
    angle("--sun-azimuth", r.options.sun.sun_azimuth_rad, "Of the hillshade, degrees from north [315]",
          360.0);
    angle("--sun-altitude", r.options.sun.sun_altitude_rad, "Of the hillshade, degrees [45]", 90.0);
}

void addValidateOptions(CLI::App& command, ValidateRequest& r) {
    command.add_option("dem", r.dem, "Raster of heights")->required();
    addMarkSource(command, r.marks);
    addFile(command, "--uncertainty", r.uncertainty, "Raster of standard errors, to be tested too");
    command.add_option("-o,--output", r.output, "Table of the differences (.csv); JSON goes beside it");
    const std::map<std::string, double> units{{"m", 1.0}, {"cm", 0.01}, {"mm", 0.001}};
    command
        .add_option("--vertical-class", r.vertical_class_m,
                    "RMSE_V to test for, e.g. 5cm: says by the ASPRS standards whether it is met")
        ->transform(CLI::AsNumberWithUnit(
            units, CLI::AsNumberWithUnit::Options(CLI::AsNumberWithUnit::CASE_SENSITIVE |
                                                  CLI::AsNumberWithUnit::UNIT_REQUIRED)))
        ->check(CLI::Range(0.001, 10.0))
        ->type_name("LENGTH");
    command.add_option("--seed", r.seed, "Of the bootstrap")->capture_default_str();
}

void addWalkAdviceOptions(CLI::App& command, WalkAdviceRequest& r) {
    command.add_option("uncertainty", r.uncertainty, "Raster of standard errors of the heights")->required();
    command.add_option("-o,--output", r.output, "GeoPackage of polygons to write")->capture_default_str();
    command.add_option("--target", r.target_sigma,
                       "Standard error that the ground should be known to [twice the median]");
    command.add_option("--least-area", r.least_area,
                       "Smaller pieces are left out [25 m2, but no more than 1 % of the field]");
}

}  // namespace terrawalk
