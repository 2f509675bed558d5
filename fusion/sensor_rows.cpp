#include "fusion/sensor_rows.hpp"

#include "fusion/adjustment_groups.hpp"

namespace terrawalk {

void SensorRows::addArray() {
    const double iron = radians(options_.lasting.hard_iron_sigma_deg);
    for (const SingleUnknown* part : {&shared_.iron.sin, &shared_.iron.cos}) {
        system_.addRow(kPrior, {{part->unknown, 1.0}}, -part->value, iron);
    }
    for (const SingleUnknown& bias : shared_.gnss_bias) {
        system_.addRow(kPrior, {{bias.unknown, 1.0}}, -bias.value, options_.lasting.gnss_bias_sigma_m);
    }
}

void SensorRows::addRun(RunModel& run) {
    addStart(run);
    addTies(run);
    addGnss(run);
    addDoppler(run);
    addBarometer(run);
    addFlow(run);
    addHeading(run);
    addWalk(run);
    addClimb(run);
    addAcceleration(run);
}

}  // namespace terrawalk
