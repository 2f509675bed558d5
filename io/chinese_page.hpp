#pragma once

#include <string>
#include <string_view>

namespace terrawalk {

/// A page of the report in Simplified Chinese: each text of its markup by inChinese(), names and codes
/// (translate="no") as they are. Sentences that a standard words keep their English beside them. Pure.
[[nodiscard]] std::string chinesePage(std::string_view page);

}  // namespace terrawalk
