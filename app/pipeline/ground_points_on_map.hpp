#pragma once

#include <Eigen/Core>
#include <stop_token>
#include <vector>

#include "app/pipeline/process.hpp"
#include "survey/result.hpp"
#include "survey/survey.hpp"

namespace terrawalk {

/// All ground points in the map frame, in the order of `products`; not finite where there was no range.
/// Errors: as MapProjection; Cancelled.
/// @param products  of this survey
[[nodiscard]] Result<std::vector<Eigen::Vector3d>> groundPointsOnMap(const Survey& survey,
                                                                     const Products& products,
                                                                     const std::stop_token& stop);

}  // namespace terrawalk
