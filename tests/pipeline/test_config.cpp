#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "app/pipeline/config.hpp"
#include "tests/support/temporary_folder.hpp"

namespace terrawalk {
namespace {

using nlohmann::json;
using testing::HasSubstr;

TEST(Config, EveryParameterCanBeSetToItsOwnDefaultAndRefusesAnotherType) {
    for (const ParameterInfo& p : describeParameters()) {
        PipelineConfig config;
        const auto done = applySetting(config, p.key + "=" + p.default_value);
        EXPECT_TRUE(done) << p.key << ": " << done.error().text();
        EXPECT_EQ(toJson(config), toJson(PipelineConfig{})) << p.key;
        EXPECT_FALSE(applySetting(config, p.key + "=no-such-value")) << p.key;
        EXPECT_FALSE(p.meaning.empty()) << p.key;
    }
}

// A key that is listed but not connected, or connected to another's field, would do nothing or harm.
TEST(Config, EveryParameterChangesItselfAndNothingElse) {
    const json before = json::parse(toJson(PipelineConfig{})).flatten();
    for (const ParameterInfo& p : describeParameters()) {
        std::string pointer = "/" + p.key;
        std::replace(pointer.begin(), pointer.end(), '.', '/');
        bool changed = false;
        for (const char* candidate : {"true",
                                      "false",
                                      "1",
                                      "2",
                                      "3.5",
                                      "30",
                                      "0.3",
                                      "0.01",
                                      "raw",
                                      "ukf",
                                      "always",
                                      "rtk",
                                      "never",
                                      "ekf",
                                      "kriging",
                                      "off",
                                      "zh",
                                      R"(["P01"])",
                                      R"([{"run":"S01","from_s":1,"to_s":2.5,"sensor":"range"}])",
                                      R"([{"kind":"soft","vertices_m":[[1,2.5],[3,4,5]]}])"}) {
            PipelineConfig config;
            if (!applySetting(config, p.key + "=" + candidate)) continue;
            const json after = json::parse(toJson(config)).flatten();
            if (after == before) continue;
            for (const auto& [key, value] : after.items()) {
                EXPECT_TRUE(key.starts_with(pointer) || value == before.at(key))
                    << p.key << " also changed " << key;
            }
            changed = true;
        }
        EXPECT_TRUE(changed) << p.key;
    }
}

TEST(Config, PrintedJsonIsReadBackExactly) {
    PipelineConfig config;
    ASSERT_TRUE(applySetting(config, "surface.cell_m=0.1"));
    ASSERT_TRUE(applySetting(config, "ground.greatest_tilt_deg=33.3"));
    ASSERT_TRUE(applySetting(config, "fusion.method=raw"));
    const test::TemporaryFolder scratch;
    test::writeBytes(scratch / "config.json", toJson(config));
    PipelineConfig read;
    const auto done = applyConfigFile(read, scratch / "config.json");
    ASSERT_TRUE(done) << done.error().text();
    EXPECT_EQ(toJson(read), toJson(config));
}

TEST(Config, BrokenFilesNameFileAndLine) {
    const test::TemporaryFolder scratch;
    const auto error = [&](const std::string& bytes) {
        test::writeBytes(scratch / "c.json", bytes);
        PipelineConfig config;
        const auto done = applyConfigFile(config, scratch / "c.json");
        return done ? std::string("accepted") : done.error().text();
    };
    EXPECT_THAT(error("{\n\"seed\": 1,\n}"), HasSubstr("c.json:3: "));
    EXPECT_THAT(error(""), HasSubstr("not valid JSON"));
    EXPECT_THAT(error(R"({"surface": {"cell_m": 1e999}})"), HasSubstr("too large"));
    EXPECT_THAT(error("[]"), HasSubstr("one JSON object"));
    EXPECT_THAT(error(R"({"surface": {"cell_m": "wide"}})"), HasSubstr("surface.cell_m"));
    EXPECT_THAT(error(R"({"surface": {"cell_m": [1]}})"), HasSubstr("surface.cell_m"));
    EXPECT_THAT(error(R"({"surfaec": {"cell_m": 1}})"), HasSubstr("did you mean"));
    EXPECT_THAT(error(R"({"format": "other 1"})"), HasSubstr("terrawalk-config 1"));
    std::string deep;
    for (int i = 0; i < 50000; ++i) deep += "{\"a\":";
    EXPECT_THAT(error(deep + "1" + std::string(50000, '}')), HasSubstr("unknown parameter"));
    EXPECT_THAT(error("{\"seed\": " + std::string(50000, '[') + std::string(50000, ']') + "}"),
                HasSubstr("seed"));
}

TEST(Config, EditsThatCannotBeAreRefusedAndChangeNothing) {
    for (const char* bad : {
             "edits.stretches={}",
             R"(edits.stretches=["S01"])",
             R"(edits.stretches=[{"run":"S01","from_s":1}])",
             R"(edits.stretches=[{"run":"S01","from_s":3,"to_s":2}])",
             R"(edits.stretches=[{"run":7,"from_s":1,"to_s":2}])",
             R"(edits.stretches=[{"run":"S01","from_s":1,"to_s":2,"sensor":"sonar"}])",
             R"(edits.marks=[7])",
             R"(edits.lines=[{"vertices_m":[[1]]}])",
             R"(edits.lines=[{"vertices_m":[[1,2,3,4]]}])",
             R"(edits.lines=[{"vertices_m":[["1",2]]}])",
             R"(edits.lines=[{"kind":"wall","vertices_m":[[1,2],[3,4]]}])",
             R"(edits.lines=[{"kind":"hard"}])",
             R"(edits.lines=[[[1,2],[3,4]]])",
         }) {
        PipelineConfig config;
        EXPECT_FALSE(applySetting(config, bad)) << bad;
        EXPECT_EQ(toJson(config), toJson(PipelineConfig{})) << bad;
    }
}

TEST(Config, SettingsReportTellsRequestedFromUsed) {
    PipelineConfig requested;
    ASSERT_TRUE(applySetting(requested, "surface.thinning_cell_m=1"));
    PipelineConfig used = requested;
    used.surface.cell_m = 0.5;
    std::size_t checked = 0;
    for (const UsedSetting& s : settingsReport(requested, used)) {
        if (s.key == "surface.thinning_cell_m") {
            EXPECT_EQ(s.requested, "1.0");
            EXPECT_EQ(s.used, "1.0");
            ++checked;
        }
        if (s.key == "surface.cell_m") {
            EXPECT_EQ(s.requested, "default");
            EXPECT_EQ(s.used, "0.5");
            ++checked;
        }
    }
    EXPECT_EQ(checked, 2u);
}

}  // namespace
}  // namespace terrawalk
