#pragma once

#include <string>
#include <utility>
#include <vector>

namespace terrawalk {

/// Name and version of the program, as written into files.
[[nodiscard]] std::string programVersion();

/// The version alone, e.g. "0.1.0".
[[nodiscard]] std::string versionNumber();

/// Libraries that decide the result, with the versions that run now.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> libraryVersions();

}  // namespace terrawalk
