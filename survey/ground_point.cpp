#include "survey/ground_point.hpp"

namespace terrawalk {

std::string_view name(GroundPointState state) {
    static constexpr std::array<std::string_view, kGroundPointStateCount> kNames{
        "used",        "no range",    "range too short", "range too long",
        "weak return", "saturated",   "tilted",          "position unsure",
        "spike",       "thinned",     "run left out",    "statistical outlier",
        "isolated",    "above ground"};
    return kNames[static_cast<std::size_t>(state)];
}

}  // namespace terrawalk
