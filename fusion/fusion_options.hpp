#pragma once

#include "survey/mark_stands.hpp"

namespace terrawalk {

enum class FusionMethod {
    Raw,  ///< sensors as they are: latest GNSS position, barometric height
    Ukf,  ///< 9-state unscented Kalman filter with a Rauch-Tung-Striebel pass
};

/// Every parameter of fusion. All sigmas are 1 sigma.
struct FusionOptions {
    FusionMethod method = FusionMethod::Ukf;
    bool smooth = true;  ///< Rauch-Tung-Striebel pass after the filter
    StandOptions stands;
};

}  // namespace terrawalk
