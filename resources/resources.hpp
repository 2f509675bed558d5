#pragma once

#include <string_view>

/// Files of the folder `resources`, compiled in.
namespace terrawalk::resources {

extern const std::string_view relief_ramp;  ///< CSV: red,green,blue from low to high
extern const std::string_view diverging_ramp;
extern const std::string_view sequential_ramp;
extern const std::string_view chinese_texts;  ///< Qt Linguist XML: English and Chinese, by context

}  // namespace terrawalk::resources
