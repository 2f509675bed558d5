#pragma once

#include <stdexcept>

#include "fusion/positioning_model.hpp"
#include "fusion/simulation.hpp"
#include "tests/support/small_survey.hpp"

namespace terrawalk {

inline MeasuredRun measured(const Survey& survey, const Run& run, const FusionOptions& options) {
    RunNotes notes;
    SensorLedger ledger;
    const auto attitudes = epochAttitudes(run.log, options.attitude, notes);
    const auto reference = runReference(survey, run, options, attitudes, notes);
    if (!reference) throw std::runtime_error(reference.error().text());
    return measuredRun(survey, run, options, attitudes, *reference, ledger);
}

}  // namespace terrawalk
