#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "survey/frames.hpp"
#include "survey/result.hpp"

namespace terrawalk {

/// Takes positions from the local frame to the survey's map frame, point by point through PROJ, so that grid
/// convergence and scale are real. Without a CRS the map frame is the local frame itself (an engineering
/// CRS). The coordinate operation is chosen once, at the zero point, and used for every point. Grids are
/// never fetched from the network. Heights: vertical datum "local" keeps u, metres above the zero point's
/// tangent plane; "ellipsoid" gives WGS 84 ellipsoidal height. Not thread-safe (PROJ contexts are not); cheap
/// to create one for each thread.
class MapProjection {
  public:
    /// Errors: BadData for an unknown, geographic, geocentric or compound CRS, for one whose axes are not
    /// metres east and north, for a datum to which PROJ knows no transformation, and for a vertical datum
    /// that is not supported.
    [[nodiscard]] static Result<MapProjection> create(const LocalFrame& frame, const std::string& crs,
                                                      const std::string& vertical_datum);
    MapProjection(MapProjection&&) noexcept;
    MapProjection& operator=(MapProjection&&) noexcept;
    ~MapProjection();

    /// x east, y north, z height [m], whatever axis order the CRS itself has.
    [[nodiscard]] Result<Eigen::Vector3d> toMap(const Eigen::Vector3d& enu_m) const;
    [[nodiscard]] Result<std::vector<Eigen::Vector3d>> toMap(const std::vector<Eigen::Vector3d>& enu_m) const;

    [[nodiscard]] const std::string& wkt2()
        const;  ///< WKT2:2019 of the horizontal CRS or the engineering CRS
    [[nodiscard]] const std::string& name() const;             ///< e.g. "WGS 84 / UTM zone 49N (EPSG:32649)"
    [[nodiscard]] const std::string& heightReference() const;  ///< one sentence
    /// Plain sentences about what the map frame costs in accuracy: a datum shift known to some metres only, a
    /// survey outside the area the CRS is made for, stretched lengths. Empty for WGS 84 / UTM in its own
    /// zone.
    [[nodiscard]] const std::vector<std::string>& warnings() const;

  private:
    struct Impl;
    explicit MapProjection(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

}  // namespace terrawalk
