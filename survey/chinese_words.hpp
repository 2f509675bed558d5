#pragma once

#include <string>
#include <string_view>

namespace terrawalk {

/// What the program says in English, in Simplified Chinese: words and sentences, with numbers and names in
/// them, after the context "Report" of resources/i18n/terrawalk_zh_CN.ts. Lists and sentences that are joined
/// by ": ", "; " or ", " are taken apart where all parts are known. What is not known comes back as it is.
/// Pure.
[[nodiscard]] std::string inChinese(std::string_view english);

}  // namespace terrawalk
