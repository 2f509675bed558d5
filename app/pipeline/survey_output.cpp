#include "app/pipeline/survey_output.hpp"

#include <fstream>
#include <nlohmann/json.hpp>

#include "io/output_folder.hpp"

namespace terrawalk {

Result<SurveyOutput> openSurveyOutput(const std::filesystem::path& folder) {
    const std::filesystem::path file = folder / kManifestName;
    std::ifstream stream(file, std::ios::binary);
    if (!stream.is_open()) {
        return badData("this is no folder that `terrawalk process` wrote", folder, 0,
                       "process the survey first");
    }
    const auto manifest = nlohmann::json::parse(stream, nullptr, false);
    if (!manifest.is_object() || manifest.value("format", "") != kOutputFormat) {
        return badData("this is no manifest of a processed survey", file, 0, "process the survey again");
    }
    try {
        const auto& frame = manifest.at("frame");
        const auto& zero = frame.at("zero_point");
        const LocalFrame local({zero.at("lat_deg").get<double>(), zero.at("lon_deg").get<double>(),
                                zero.at("h_ell_m").get<double>()});
        auto projection = MapProjection::create(local, frame.at("crs").get<std::string>(),
                                                frame.at("vertical_datum").get<std::string>());
        if (!projection) return tl::unexpected(projection.error());
        return SurveyOutput{folder, manifest.value("survey", ""), local, std::move(*projection),
                            manifest.value("survey_date", "")};
    } catch (const nlohmann::json::exception&) {
        return badData("the manifest does not tell the frame of the survey", file, 0,
                       "process the survey again with this version");
    }
}

}  // namespace terrawalk
