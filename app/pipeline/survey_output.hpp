#pragma once

#include <filesystem>
#include <string>

#include "io/map_projection.hpp"
#include "survey/result.hpp"

namespace terrawalk {

/// A folder that `process` wrote, as far as later jobs need to know it.
struct SurveyOutput {
    std::filesystem::path folder;
    std::string survey;  ///< its name
    LocalFrame frame{GeodeticPosition{}};
    MapProjection projection;
    std::string date;  ///< YYYY-MM-DD; empty where no log tells when it began
};

/// Reads the folder's manifest. Errors: BadData for a folder without one, for one of another kind, and for
/// one from before the manifest held the frame.
[[nodiscard]] Result<SurveyOutput> openSurveyOutput(const std::filesystem::path& folder);

}  // namespace terrawalk
