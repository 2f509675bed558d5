#include "io/coordinate_system.hpp"

#include <cpl_conv.h>
#include <fmt/format.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <memory>

#include "io/gdal_support.hpp"
#include "io/text_input.hpp"

namespace terrawalk {
namespace {

const std::array<LengthUnit, 3> kUnits{{{"m", 1.0}, {"ft", 0.3048}, {"US-ft", 1200.0 / 3937.0}}};

std::string lowerCase(std::string_view text) {
    std::string lower(text);
    std::transform(lower.begin(), lower.end(), lower.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return lower;
}

/// The two feet differ by two millionths.
std::optional<LengthUnit> unitOf(double metres) {
    for (const LengthUnit& unit : kUnits) {
        if (std::abs(metres / unit.metres - 1.0) < 1e-8) return unit;
    }
    return std::nullopt;
}

std::string wkt2Of(const OGRSpatialReference& crs) {
    char* text = nullptr;
    const std::array<const char*, 2> options{"FORMAT=WKT2_2019", nullptr};
    const OGRErr error = crs.exportToWkt(&text, options.data());
    const std::unique_ptr<char, decltype(&CPLFree)> owner(text, &CPLFree);
    return error == OGRERR_NONE && text != nullptr ? text : "";
}

std::string nameOf(const OGRSpatialReference& crs) {
    const char* const name = crs.GetName();
    const char* const authority = crs.GetAuthorityName(nullptr);
    const char* const code = crs.GetAuthorityCode(nullptr);
    std::string text = name != nullptr ? name : "unnamed";
    if (authority != nullptr && code != nullptr) text += fmt::format(" ({}:{})", authority, code);
    return text;
}

}  // namespace

std::optional<LengthUnit> lengthUnit(std::string_view name) {
    for (const LengthUnit& unit : kUnits) {
        if (lowerCase(unit.symbol) == lowerCase(name)) return unit;
    }
    return std::nullopt;
}

Result<CoordinateSystem> describeCrs(const std::string& text) {
    const GdalErrors errors;
    OGRSpatialReference crs;
    if (crs.SetFromUserInput(text.c_str()) != OGRERR_NONE) {
        return badData(fmt::format("{} is no CRS that PROJ knows", inQuotes(text)), {}, 0,
                       "give an authority code such as EPSG:32649");
    }
    CoordinateSystem system;
    system.vertical_datum = "unknown";
    std::optional<LengthUnit> height_unit;
    if (crs.IsCompound() != 0) {
        const char* unit_name = nullptr;
        height_unit = unitOf(crs.GetTargetLinearUnits("VERT_CS", &unit_name));
        const char* const vertical = crs.GetAttrValue("VERT_CS");
        system.vertical_datum = vertical != nullptr ? vertical : "unknown";
        if (!height_unit) return badData("heights are neither in metres nor in feet", {}, 0, "convert them");
        crs.StripVertical();
    }
    if (crs.IsProjected() == 0 && crs.IsLocal() == 0) {
        return badData(fmt::format("{} is no plane CRS: a surface needs east and north in metres or feet",
                                   inQuotes(nameOf(crs))),
                       {}, 0, "project the points first");
    }
    const auto unit = unitOf(crs.GetLinearUnits(nullptr));
    if (!unit) return badData(fmt::format("{} is neither in metres nor in feet", inQuotes(nameOf(crs))));
    if (height_unit && *height_unit != *unit) {
        return badData(
            fmt::format("the plan is in {} and heights are in {}", unit->symbol, height_unit->symbol), {}, 0,
            "convert one of them");
    }
    system.unit = *unit;
    system.wkt2 = wkt2Of(crs);
    system.name = nameOf(crs);
    return system;
}

CoordinateSystem localCoordinateSystem(const LengthUnit& unit) {
    const std::string name = fmt::format("Terrawalk local frame, {}", unit.symbol);
    const std::string unit_wkt =
        unit.symbol == "m" ? R"(LENGTHUNIT["metre",1])"
                           : fmt::format(R"(LENGTHUNIT["{}",{:.17g}])",
                                         unit.symbol == "ft" ? "foot" : "US survey foot", unit.metres);
    return {fmt::format(R"wkt(ENGCRS["{}",EDATUM["Unknown engineering datum"],CS[Cartesian,2],)wkt"
                        R"wkt(AXIS["(E)",east,ORDER[1],{}],AXIS["(N)",north,ORDER[2],{}]])wkt",
                        name, unit_wkt, unit_wkt),
            name, "unknown", unit};
}

}  // namespace terrawalk
