#pragma once

#include <string>

#include "survey/relief_image.hpp"
#include "survey/result.hpp"

namespace terrawalk {

/// The bytes of a PNG file with opacity. The same pixels give the same bytes. Errors: System.
[[nodiscard]] Result<std::string> encodePng(const ReliefImage& image);

}  // namespace terrawalk
