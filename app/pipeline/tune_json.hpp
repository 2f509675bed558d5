#pragma once

#include <nlohmann/json.hpp>

#include "survey/survey_report.hpp"

namespace terrawalk {

// The section "tuning" of a configuration file, as far as a report shows it.

[[nodiscard]] nlohmann::ordered_json tuningJson(const TuningRecord& record);

/// Keys that a record does not have are left unread. Throws nlohmann::json::exception for one that is
/// missing or of another type.
[[nodiscard]] TuningRecord tuningOf(const nlohmann::json& section);

}  // namespace terrawalk
