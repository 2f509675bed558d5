#pragma once

#include <CLI/CLI.hpp>
#include <vector>

#include "app/pipeline/tune.hpp"

namespace terrawalk {

/// The search's options, but for its seed. Returns them, so that they can be tied to another.
std::vector<CLI::Option*> addTuneOptions(CLI::App& command, TuneOptions& options);

/// What a second person has to type for the same search.
[[nodiscard]] std::vector<std::string> tuneArguments(const TuneOptions& options);

}  // namespace terrawalk
