#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace terrawalk {

enum class BreaklineKind {
    Hard,      ///< triangles keep to it, and the surface may fold there
    Soft,      ///< triangles keep to it, the surface stays smooth across it
    Boundary,  ///< ring; nothing outside it is ground
    Hole,      ///< ring; nothing inside it is ground
};
inline constexpr std::array<std::pair<BreaklineKind, std::string_view>, 4> kBreaklineKinds{{
    {BreaklineKind::Hard, "hard"},
    {BreaklineKind::Soft, "soft"},
    {BreaklineKind::Boundary, "boundary"},
    {BreaklineKind::Hole, "hole"},
}};

/// A polyline that the surface follows, in the frame of the points. A height of NaN is taken from the points
/// alone. Rings may repeat their first vertex or not.
struct Breakline {
    std::vector<Eigen::Vector3d> vertices_m;
    BreaklineKind kind = BreaklineKind::Hard;
    std::string name;  ///< for messages, such as "line 3"
};

}  // namespace terrawalk
