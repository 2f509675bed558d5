#include "fusion/innovation_record.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fusion/fuse_run.hpp"
#include "tests/fusion/made_run.hpp"

namespace terrawalk {
namespace {

TEST(InnovationRecord, KeepsEveryReadingOfAShortRun) {
    InnovationRecord record;
    for (int i = 0; i < 1000; ++i) record.add(Sensor::Barometer, i, std::sin(i), i % 7 != 0);
    const auto sensors = record.sensors();
    ASSERT_EQ(sensors.size(), 1U);
    EXPECT_EQ(sensors[0].consistency.sensor, name(Sensor::Barometer));
    ASSERT_EQ(sensors[0].readings.size(), 1000U);
    for (int i = 0; i < 1000; ++i) {
        const Innovation& kept = sensors[0].readings[static_cast<std::size_t>(i)];
        EXPECT_EQ(kept.time_s, i);
        EXPECT_EQ(kept.over_sigma, static_cast<float>(std::sin(i)));
        EXPECT_EQ(kept.used, i % 7 != 0);
    }
}

TEST(InnovationRecord, KeepsTheFarthestOfALongRunInLittleMemory) {
    InnovationRecord record;
    constexpr int kReadings = 1'000'000;
    for (int i = 0; i < kReadings; ++i) {
        const bool spike = i % 100'003 == 50'000;
        record.add(Sensor::GnssPosition, i, spike ? -9.0 - i * 1e-6 : std::sin(i * 0.7), !spike);
    }
    const auto readings = record.sensors().at(0).readings;
    EXPECT_LE(readings.size(), 2 * InnovationRecord::kKept);
    EXPECT_GE(readings.size(), InnovationRecord::kKept);
    EXPECT_TRUE(std::is_sorted(readings.begin(), readings.end(),
                               [](const auto& a, const auto& b) { return a.time_s < b.time_s; }));
    // Each spike of one reading is still there, at its time.
    for (int i = 50'000; i < kReadings; i += 100'003) {
        const auto found =
            std::find_if(readings.begin(), readings.end(), [&](const auto& r) { return r.time_s == i; });
        ASSERT_NE(found, readings.end());
        EXPECT_FALSE(found->used);
        EXPECT_FLOAT_EQ(found->over_sigma, static_cast<float>(-9.0 - i * 1e-6));
    }
}

TEST(InnovationRecord, MeanNisIsOfTheReadings) {
    InnovationRecord record;
    record.add(Sensor::OpticalFlow, 0.0, 1.0, true);
    record.addNis(Sensor::OpticalFlow, 3.0, 2);
    record.add(Sensor::OpticalFlow, 1.0, 1.0, true);
    record.addNis(Sensor::OpticalFlow, 2.0, 2);
    const auto sums = record.sensors().at(0).consistency;
    EXPECT_EQ(sums.n, 2U);
    EXPECT_EQ(sums.dof, 2.0);
    EXPECT_EQ(sums.mean_nis, 2.5);
}

TEST(InnovationRecord, TellsOfTheSameReadingsAsTheLedger) {
    for (const FusionMethod method : {FusionMethod::Terrawalk, FusionMethod::Ukf}) {
        const MadeRun made = makeRun();
        FusionOptions options;
        options.method = method;
        SilentProgress progress;
        const auto run = fuseRun(made.survey, made.run(), options, progress, {});
        ASSERT_TRUE(run) << run.error().text();
        ASSERT_FALSE(run->innovations.empty());
        for (const SensorInnovations& sensor : run->innovations) {
            const auto use = std::find_if(run->sensors.begin(), run->sensors.end(), [&](const SensorUse& u) {
                return u.sensor == sensor.consistency.sensor;
            });
            ASSERT_NE(use, run->sensors.end());
            std::size_t gated = 0;
            for (const auto& rejection : use->rejections) {
                if (rejection.reason == "beyond gate") gated += rejection.count;
            }
            EXPECT_EQ(sensor.consistency.n, use->used) << use->sensor;
            EXPECT_EQ(sensor.readings.size(), use->used + gated) << use->sensor;
            EXPECT_EQ(static_cast<std::size_t>(std::count_if(sensor.readings.begin(), sensor.readings.end(),
                                                             [](const auto& r) { return !r.used; })),
                      gated)
                << use->sensor;
            for (const Innovation& reading : sensor.readings) {
                EXPECT_EQ(reading.used, std::abs(reading.over_sigma) <= options.robust.gate_sigma);
            }
        }
    }
}

}  // namespace
}  // namespace terrawalk
