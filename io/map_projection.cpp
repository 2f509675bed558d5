#include "io/map_projection.hpp"

#include <fmt/format.h>
#include <proj.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <optional>

#include "survey/parallel.hpp"

namespace terrawalk {

namespace {

constexpr double kWgs84SemiMajor_m = 6378137.0;
constexpr double kWgs84InverseFlattening = 298.257223563;
constexpr double kProbe_m = 100.0;
constexpr double kLargestStretch = 0.01;
constexpr std::string_view kCrsCure =
    "write a projected CRS in metres, for example \"EPSG:32649\", or leave \"crs\" out";

struct ContextDeleter {
    void operator()(PJ_CONTEXT* context) const { proj_context_destroy(context); }
};
struct PjDeleter {
    void operator()(PJ* object) const { proj_destroy(object); }
};
struct AreaDeleter {
    void operator()(PJ_AREA* area) const { proj_area_destroy(area); }
};
using Context = std::unique_ptr<PJ_CONTEXT, ContextDeleter>;
using Pj = std::unique_ptr<PJ, PjDeleter>;
using Area = std::unique_ptr<PJ_AREA, AreaDeleter>;

void keepMessage(void* kept, int, const char* message) {
    *static_cast<std::string*>(kept) = message;
}

/// PROJ without a network and without a voice: what it would print stands in `said`.
struct Proj {
    std::unique_ptr<std::string> said = std::make_unique<std::string>();
    Context context{proj_context_create()};

    Proj() {
        proj_log_func(context.get(), said.get(), &keepMessage);
        proj_context_set_enable_network(context.get(), 0);
    }
    [[nodiscard]] Pj create(const std::string& definition) const {
        return Pj(proj_create(context.get(), definition.c_str()));
    }
};

enum class Heights { Local, Ellipsoid };

std::string textOr(const char* text, std::string_view fallback) {
    return std::string(text != nullptr ? std::string_view(text) : fallback);
}

std::string zeroPointText(const GeodeticPosition& zero) {
    return fmt::format("lat {:.9f} lon {:.9f} h {:.3f}", zero.lat_deg, zero.lon_deg, zero.h_ell_m);
}

std::string engineeringCrsWkt2(const std::string& name) {
    return fmt::format(
        "ENGCRS[\"{}\",EDATUM[\"zero point of the survey\"],CS[Cartesian,2],"
        "AXIS[\"(E)\",east,ORDER[1]],AXIS[\"(N)\",north,ORDER[2]],LENGTHUNIT[\"metre\",1,ID[\"EPSG\",9001]]]",
        name);
}

std::string heightSentence(Heights heights, const GeodeticPosition& zero) {
    if (heights == Heights::Ellipsoid) return "Heights are metres above the WGS 84 ellipsoid.";
    return fmt::format(
        "Heights are metres above the plane through the zero point ({}) that is level there; they are not "
        "reduced to a "
        "geoid.",
        zeroPointText(zero));
}

Result<Heights> parseHeights(const std::string& vertical_datum) {
    if (vertical_datum == "local") return Heights::Local;
    if (vertical_datum == "ellipsoid") return Heights::Ellipsoid;
    return badData("vertical datum \"" + vertical_datum + "\" is not supported", {}, 0,
                   "write \"local\" (metres above the zero point) or \"ellipsoid\" (height above WGS 84)");
}

tl::unexpected<Error> unusableCrs(const std::string& crs, const std::string& why) {
    return badData(fmt::format("CRS \"{}\" {}", crs, why), {}, 0, std::string(kCrsCure));
}

/// Why a CRS of this type cannot be the map frame; nothing when it can.
std::optional<std::string> refusal(PJ_TYPE type) {
    switch (type) {
        case PJ_TYPE_PROJECTED_CRS:
            return std::nullopt;
        case PJ_TYPE_GEOGRAPHIC_2D_CRS:
        case PJ_TYPE_GEOGRAPHIC_3D_CRS:
            return "is geographic: its axes are degrees, and a terrain model needs metres";
        case PJ_TYPE_GEOCENTRIC_CRS:
            return "is geocentric: it has no east and north axes";
        case PJ_TYPE_COMPOUND_CRS:
            return "has a vertical part, which is not supported yet: write the horizontal CRS alone (the "
                   "part before "
                   "the \"+\") and \"vertical_datum\": \"ellipsoid\" or \"local\"";
        case PJ_TYPE_VERTICAL_CRS:
            return "is vertical only";
        default:
            return "is not a projected CRS";
    }
}

/// A CRS with a datum shift of its own (+towgs84) wraps the one that has the axes.
Pj unwrapped(const Proj& proj, Pj crs) {
    if (proj_get_type(crs.get()) != PJ_TYPE_BOUND_CRS) return crs;
    return Pj(proj_get_source_crs(proj.context.get(), crs.get()));
}

Result<void> checkAxes(const Proj& proj, const std::string& crs_text, const PJ* crs) {
    PJ_CONTEXT* const context = proj.context.get();
    const Pj axes(proj_crs_get_coordinate_system(context, crs));
    if (!axes) return unusableCrs(crs_text, "has no coordinate system: " + *proj.said);
    const int count = proj_cs_get_axis_count(context, axes.get());
    if (count != 2) return unusableCrs(crs_text, fmt::format("has {} axes, not east and north alone", count));
    std::array<std::string, 2> directions;
    for (int i = 0; i < 2; ++i) {
        const char* direction = nullptr;
        const char* unit = nullptr;
        double unit_m = 0.0;
        proj_cs_get_axis_info(context, axes.get(), i, nullptr, nullptr, &direction, &unit_m, &unit, nullptr,
                              nullptr);
        if (std::abs(unit_m - 1.0) > 1e-12) {
            return unusableCrs(crs_text,
                               fmt::format("has axes in {}, not in metres", textOr(unit, "another unit")));
        }
        directions[static_cast<std::size_t>(i)] = textOr(direction, "unknown");
    }
    const bool usual = directions == std::array<std::string, 2>{"east", "north"} ||
                       directions == std::array<std::string, 2>{"north", "east"};
    if (!usual) {
        return unusableCrs(crs_text, fmt::format("has axes that point {} and {}, not east and north",
                                                 directions[0], directions[1]));
    }
    return {};
}

/// Whether two datums on this ellipsoid and on WGS 84 can lie within metres of each other, as modern
/// geocentric datums do; older datums with ellipsoids of their own lie a hundred metres and more away.
bool nearWgs84Ellipsoid(const Proj& proj, const PJ* crs) {
    const Pj ellipsoid(proj_get_ellipsoid(proj.context.get(), crs));
    if (!ellipsoid) return false;
    double semi_major_m = 0.0;
    double inverse_flattening = 0.0;
    proj_ellipsoid_get_parameters(proj.context.get(), ellipsoid.get(), &semi_major_m, nullptr, nullptr,
                                  &inverse_flattening);
    return std::abs(semi_major_m - kWgs84SemiMajor_m) < 0.5 &&
           std::abs(inverse_flattening - kWgs84InverseFlattening) < 1e-4;
}

/// The best operation from WGS 84 (longitude, latitude, height) to the CRS (east, north) at the zero point.
Pj operationAt(const Proj& proj, const PJ* crs, const GeodeticPosition& zero, bool allow_ballpark) {
    const Pj wgs84 = proj.create("EPSG:4979");
    const Area area(proj_area_create());
    if (!wgs84) return nullptr;
    // PROJ 9.1 never returns from a box that touches 180 degrees, the same meridian as -180.
    const double lon_deg = zero.lon_deg >= 180.0 ? zero.lon_deg - 360.0 : zero.lon_deg;
    proj_area_set_bbox(area.get(), lon_deg, zero.lat_deg, lon_deg, zero.lat_deg);
    const std::array<const char*, 2> options{allow_ballpark ? "ALLOW_BALLPARK=YES" : "ALLOW_BALLPARK=NO",
                                             nullptr};
    const Pj candidates(
        proj_create_crs_to_crs_from_pj(proj.context.get(), wgs84.get(), crs, area.get(), options.data()));
    if (!candidates) return nullptr;
    const Pj east_first(proj_normalize_for_visualization(proj.context.get(), candidates.get()));
    if (!east_first) return nullptr;
    const PJ_COORD projected =
        proj_trans(east_first.get(), PJ_FWD, proj_coord(zero.lon_deg, zero.lat_deg, zero.h_ell_m, 0.0));
    if (!std::isfinite(projected.xy.x) || !std::isfinite(projected.xy.y)) return nullptr;
    return Pj(proj_trans_get_last_used_operation(east_first.get()));
}

std::string stepsOf(const PJ* operation) {
    // PROJ puts the swap of latitude and longitude into the name, which says nothing about the datum.
    std::string name = textOr(proj_get_name(operation), "unnamed operation");
    constexpr std::string_view kSwap = "axis order change (2D)";
    if (name.starts_with(std::string(kSwap) + " + ")) name.erase(0, kSwap.size() + 3);
    if (name.ends_with(" + " + std::string(kSwap))) name.erase(name.size() - kSwap.size() - 3);
    return name;
}

std::optional<std::string> outsideAreaOfUse(const Proj& proj, const PJ* crs, const GeodeticPosition& zero) {
    double west_deg = 0.0;
    double south_deg = 0.0;
    double east_deg = 0.0;
    double north_deg = 0.0;
    if (proj_get_area_of_use(proj.context.get(), crs, &west_deg, &south_deg, &east_deg, &north_deg,
                             nullptr) == 0 ||
        west_deg < -180.0) {
        return std::nullopt;  // the definition names no area
    }
    const bool within_lon = west_deg <= east_deg ? zero.lon_deg >= west_deg && zero.lon_deg <= east_deg
                                                 : zero.lon_deg >= west_deg || zero.lon_deg <= east_deg;
    if (within_lon && zero.lat_deg >= south_deg && zero.lat_deg <= north_deg) return std::nullopt;
    return fmt::format(
        "The zero point lies outside the area that the CRS is made for (lat {:g} to {:g}, lon {:g} to {:g}).",
        south_deg, north_deg, west_deg, east_deg);
}

}  // namespace

struct MapProjection::Impl {
    explicit Impl(const LocalFrame& local_frame) : frame(local_frame) {}

    LocalFrame frame;
    Heights heights = Heights::Local;
    std::string wkt2;
    std::string name;
    std::string height_reference;
    std::vector<std::string> warnings;
    std::optional<Proj> proj;  ///< absent: the map frame is the local frame
    Pj operation;              ///< goes before its context

    [[nodiscard]] Result<void> useCrs(const std::string& crs_text);
    [[nodiscard]] Result<void> chooseOperation(const std::string& crs_text, const PJ* crs,
                                               const PJ* axes_crs);
    void project(const Eigen::Vector3d* enu_m, std::size_t count, Eigen::Vector3d* map_m) const;
    void checkLengths();
};

Result<void> MapProjection::Impl::useCrs(const std::string& crs_text) {
    proj.emplace();
    Pj crs = proj->create(crs_text);
    if (!crs) return unusableCrs(crs_text, "is not known (" + *proj->said + ")");
    const char* const wkt = proj_is_crs(crs.get()) != 0
                                ? proj_as_wkt(proj->context.get(), crs.get(), PJ_WKT2_2019,
                                              std::array<const char*, 2>{"MULTILINE=NO", nullptr}.data())
                                : nullptr;
    if (wkt == nullptr) return unusableCrs(crs_text, "does not describe a coordinate reference system");
    wkt2 = wkt;
    const Pj full = Pj(proj_clone(proj->context.get(), crs.get()));
    const Pj axes_crs = unwrapped(*proj, std::move(crs));
    if (const auto why = refusal(proj_get_type(axes_crs.get()))) return unusableCrs(crs_text, *why);
    if (auto axes = checkAxes(*proj, crs_text, axes_crs.get()); !axes) return axes;

    const char* const authority = proj_get_id_auth_name(axes_crs.get(), 0);
    const char* const code = proj_get_id_code(axes_crs.get(), 0);
    name = textOr(proj_get_name(axes_crs.get()), "unnamed CRS");
    if (authority != nullptr && code != nullptr) name += fmt::format(" ({}:{})", authority, code);
    if (auto chosen = chooseOperation(crs_text, full.get(), axes_crs.get()); !chosen) return chosen;
    if (const auto outside = outsideAreaOfUse(*proj, axes_crs.get(), frame.zeroPoint()))
        warnings.push_back(*outside);
    checkLengths();
    return {};
}

Result<void> MapProjection::Impl::chooseOperation(const std::string& crs_text, const PJ* crs,
                                                  const PJ* axes_crs) {
    operation = operationAt(*proj, crs, frame.zeroPoint(), false);
    if (operation) {
        const double accuracy_m = proj_coordoperation_get_accuracy(proj->context.get(), operation.get());
        if (accuracy_m > 0.0) {
            warnings.push_back(fmt::format(
                "Positions go from WGS 84 to the datum of {} by \"{}\", which is good to about {:g} m.", name,
                stepsOf(operation.get()), accuracy_m));
        }
        return {};
    }
    if (nearWgs84Ellipsoid(*proj, axes_crs)) {
        operation = operationAt(*proj, crs, frame.zeroPoint(), true);
        if (operation) {
            warnings.push_back(fmt::format(
                "PROJ knows no transformation from WGS 84 to the datum of {}; the two are taken as one, "
                "which may be wrong by a metre or so.",
                name));
            return {};
        }
    }
    return unusableCrs(
        crs_text,
        fmt::format("cannot be reached from WGS 84 at the zero point ({}): PROJ knows no "
                    "transformation to its datum there{}",
                    zeroPointText(frame.zeroPoint()), proj->said->empty() ? "" : " (" + *proj->said + ")"));
}

/// A survey needs lengths that are near those on the ground.
void MapProjection::Impl::checkLengths() {
    const std::array<Eigen::Vector3d, 3> probes{Eigen::Vector3d::Zero(), Eigen::Vector3d::UnitX() * kProbe_m,
                                                Eigen::Vector3d::UnitY() * kProbe_m};
    std::array<Eigen::Vector3d, 3> map_m;
    project(probes.data(), probes.size(), map_m.data());
    const double scale_east = (map_m[1] - map_m[0]).head<2>().norm() / kProbe_m;
    const double scale_north = (map_m[2] - map_m[0]).head<2>().norm() / kProbe_m;
    const double worst = std::abs(scale_east - 1.0) > std::abs(scale_north - 1.0) ? scale_east : scale_north;
    if (std::abs(worst - 1.0) > kLargestStretch) {
        warnings.push_back(
            fmt::format("In {} 1 m on the ground is {:.3f} m on the map here; lengths, areas and slopes "
                        "taken from the map are "
                        "wrong by that factor.",
                        name, worst));
    }
}

/// Points that PROJ cannot take there become infinite.
void MapProjection::Impl::project(const Eigen::Vector3d* enu_m, std::size_t count,
                                  Eigen::Vector3d* map_m) const {
    if (!operation && heights == Heights::Local) {
        std::copy_n(enu_m, count, map_m);
        return;
    }
    // map_m first holds longitude, latitude and ellipsoidal height.
    parallelRanges(count, 1024, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const GeodeticPosition position = frame.toGeodetic(enu_m[i]);
            map_m[i] = {position.lon_deg, position.lat_deg, position.h_ell_m};
        }
    });
    if (!operation) {
        for (std::size_t i = 0; i < count; ++i) map_m[i].head<2>() = enu_m[i].head<2>();
        return;
    }
    constexpr std::size_t kChunk = 4096;
    std::array<double, kChunk> h_ell_m{};
    for (std::size_t begin = 0; begin < count; begin += kChunk) {
        const std::size_t n = std::min(kChunk, count - begin);
        double* const first = map_m[begin].data();
        for (std::size_t i = 0; i < n; ++i) h_ell_m[i] = first[3 * i + 2];
        constexpr std::size_t kStride = sizeof(Eigen::Vector3d);
        proj_trans_generic(operation.get(), PJ_FWD, first, kStride, n, first + 1, kStride, n, first + 2,
                           kStride, n, nullptr, 0, 0);
        // A horizontal CRS says nothing about heights: they stay what the vertical datum asks for.
        for (std::size_t i = 0; i < n; ++i) {
            first[3 * i + 2] = heights == Heights::Ellipsoid ? h_ell_m[i] : enu_m[begin + i].z();
        }
    }
}

MapProjection::MapProjection(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
MapProjection::MapProjection(MapProjection&&) noexcept = default;
MapProjection& MapProjection::operator=(MapProjection&&) noexcept = default;
MapProjection::~MapProjection() = default;

Result<MapProjection> MapProjection::create(const LocalFrame& frame, const std::string& crs,
                                            const std::string& vertical_datum) {
    const auto heights = parseHeights(vertical_datum);
    if (!heights) return tl::unexpected(heights.error());
    auto impl = std::make_unique<Impl>(frame);
    impl->heights = *heights;
    impl->height_reference = heightSentence(*heights, frame.zeroPoint());
    if (crs.empty()) {
        impl->name = "Terrawalk local frame, zero point " + zeroPointText(frame.zeroPoint());
        impl->wkt2 = engineeringCrsWkt2(impl->name);
    } else if (auto used = impl->useCrs(crs); !used) {
        return tl::unexpected(used.error());
    }
    return MapProjection(std::move(impl));
}

Result<Eigen::Vector3d> MapProjection::toMap(const Eigen::Vector3d& enu_m) const {
    auto mapped = toMap(std::vector<Eigen::Vector3d>{enu_m});
    if (!mapped) return tl::unexpected(mapped.error());
    return mapped->front();
}

Result<std::vector<Eigen::Vector3d>> MapProjection::toMap(const std::vector<Eigen::Vector3d>& enu_m) const {
    std::vector<Eigen::Vector3d> map_m(enu_m.size());
    impl_->project(enu_m.data(), enu_m.size(), map_m.data());
    for (std::size_t i = 0; i < map_m.size(); ++i) {
        if (map_m[i].allFinite()) continue;
        return badData(
            fmt::format("the point e {:.3f} n {:.3f} u {:.3f} m of the local frame cannot be taken to {}",
                        enu_m[i].x(), enu_m[i].y(), enu_m[i].z(), impl_->name));
    }
    return map_m;
}

const std::string& MapProjection::wkt2() const {
    return impl_->wkt2;
}
const std::string& MapProjection::name() const {
    return impl_->name;
}
const std::string& MapProjection::heightReference() const {
    return impl_->height_reference;
}
const std::vector<std::string>& MapProjection::warnings() const {
    return impl_->warnings;
}

}  // namespace terrawalk
