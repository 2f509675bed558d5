#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "survey/result.hpp"

namespace terrawalk {

struct LengthUnit {
    std::string symbol;  ///< "m", "ft" (international), "US-ft"
    double metres = 1.0;
    bool operator==(const LengthUnit&) const = default;
};
/// "m", "ft" or "us-ft", any case; nothing for another name.
[[nodiscard]] std::optional<LengthUnit> lengthUnit(std::string_view name);

/// A map frame as products need it: axes east and north in one linear unit, heights in the same unit.
struct CoordinateSystem {
    std::string wkt2;  ///< of the horizontal part
    std::string name;
    std::string vertical_datum;  ///< name of the vertical part; "unknown" where none is given
    LengthUnit unit;
};

/// From an authority code ("EPSG:2994", "EPSG:32649+5773"), WKT or PROJ text. Errors: BadData for text that
/// PROJ does not understand, for a geographic or geocentric CRS, and for a unit other than metre, foot and US
/// survey foot or another one for heights than for the plan.
[[nodiscard]] Result<CoordinateSystem> describeCrs(const std::string& text);

/// Points without any CRS: an engineering CRS of that unit.
[[nodiscard]] CoordinateSystem localCoordinateSystem(const LengthUnit& unit);

}  // namespace terrawalk
