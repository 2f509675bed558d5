#include "app/pipeline/marks_on_map.hpp"

#include <fmt/format.h>

#include "app/pipeline/survey_output.hpp"
#include "io/read_points.hpp"
#include "io/read_survey.hpp"

namespace terrawalk {

namespace {

Result<std::vector<MapMark>> surveyMarks(const MarkSource& source, const std::filesystem::path& dem_file,
                                         const CoordinateSystem& dem_crs) {
    const auto folder = source.survey_output.empty() ? dem_file.parent_path() : source.survey_output;
    const auto survey = openSurveyOutput(folder);
    if (!survey) {
        Error error = survey.error();
        error.cure =
            "the marks are local coordinates: name the folder that `terrawalk process` wrote with "
            "--survey, or give points in the DEM's CRS with --check-points";
        return tl::unexpected(error);
    }
    const auto crs = describeCrs(survey->projection.wkt2());
    // An engineering CRS is no projected one: its name alone can be compared.
    const std::string& name = crs ? crs->name : dem_crs.name;
    if (name != dem_crs.name) {
        return badData(fmt::format("the survey is in {}, the DEM in {}", name, dem_crs.name), dem_file);
    }
    auto table = readControlMarks(source.marks);
    if (!table) return tl::unexpected(table.error());
    std::vector<MapMark> placed;
    for (ControlMark& mark : table->marks) {
        const auto map_m = survey->projection.toMap(mark.enu_m);
        if (!map_m) return tl::unexpected(map_m.error());
        placed.push_back({std::move(mark), *map_m});
    }
    return placed;
}

Result<std::vector<MapMark>> checkPoints(const MarkSource& source, const CoordinateSystem& dem_crs,
                                         Progress& progress, std::stop_token stop) {
    const auto read = readPoints(source.check_points, {}, progress, std::move(stop));
    if (!read) return tl::unexpected(read.error());
    if (!read->crs.empty()) {
        const auto crs = describeCrs(read->crs);
        if (!crs) return tl::unexpected(crs.error());
        if (crs->name != dem_crs.name) {
            return badData(fmt::format("the points are in {}, the DEM in {}", crs->name, dem_crs.name),
                           source.check_points, 0, "bring them to the CRS of the DEM");
        }
    }
    if (read->unit && *read->unit != dem_crs.unit) {
        return badData(
            fmt::format("the points are in {}, the DEM in {}", read->unit->symbol, dem_crs.unit.symbol),
            source.check_points);
    }
    std::vector<MapMark> placed;
    for (std::size_t i = 0; i < read->points.size(); ++i) {
        ControlMark mark{fmt::format("point {}", i + 1), read->points[i]};
        mark.role = MarkRole::Check;
        if (!read->sigmas.empty()) mark.sigma_v_m = read->sigmas[i];
        placed.push_back({mark, read->points[i]});
    }
    return placed;
}

}  // namespace

Result<std::vector<MapMark>> marksOnMap(const MarkSource& source, const std::filesystem::path& dem_file,
                                        const CoordinateSystem& dem_crs, Progress& progress,
                                        std::stop_token stop) {
    if (source.marks.empty() == source.check_points.empty()) {
        return usageError("marks come from one file", "give either --marks or --check-points");
    }
    return source.marks.empty() ? checkPoints(source, dem_crs, progress, std::move(stop))
                                : surveyMarks(source, dem_file, dem_crs);
}

}  // namespace terrawalk
