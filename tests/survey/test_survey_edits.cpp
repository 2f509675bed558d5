#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "survey/survey_edits.hpp"

namespace terrawalk {
namespace {

using testing::Contains;
using testing::HasSubstr;

Survey walked() {
    Survey survey;
    survey.marks = {{"P01", {1, 2, 3}}, {"P02", {4, 5, 6}}};
    terrawalk::Run run;
    run.id = "S01";
    run.start = "P01";
    run.target = "P02";
    run.stops = {{"P01", 1, 2}, {"P02", 3, 4}};
    for (int i = 0; i <= 10; ++i) {
        run.log.time_s.push_back(i);
        run.log.column(Channel::Latitude).push_back(23.0);
        run.log.column(Channel::Roll).push_back(0.1);
        run.log.column(Channel::Range).push_back(1.5);
    }
    survey.runs = {run};
    run.id = "S02";
    survey.runs.push_back(run);
    return survey;
}

std::size_t missingOf(const ArrayLog& log, Channel channel) {
    const auto& column = log.column(channel);
    return static_cast<std::size_t>(
        std::count_if(column.begin(), column.end(), [](double v) { return !present(v); }));
}

TEST(SurveyEdits, NoneLeaveTheSurveyAsItIs) {
    const auto same = withEdits(walked(), {});
    ASSERT_TRUE(same);
    EXPECT_EQ(same->runs.size(), 2u);
    EXPECT_TRUE(same->notes.empty());
}

TEST(SurveyEdits, StretchTakesTheReadingsOfItsSensorAndKeepsTheEpochs) {
    const auto edited = withEdits(walked(), {.stretches = {{"S02", 2.5, 5.0, EditedSensor::Range}}});
    ASSERT_TRUE(edited) << edited.error().text();
    const ArrayLog& log = edited->runs[1].log;
    EXPECT_EQ(log.size(), 11u);
    EXPECT_EQ(missingOf(log, Channel::Range), 3u);
    EXPECT_FALSE(present(log.value(Channel::Range, 3)));
    EXPECT_TRUE(present(log.value(Channel::Range, 2)));
    EXPECT_TRUE(present(log.value(Channel::Range, 6)));
    EXPECT_EQ(missingOf(log, Channel::Latitude), 0u);
    EXPECT_EQ(missingOf(log, Channel::Roll), 0u);
    EXPECT_EQ(missingOf(edited->runs[0].log, Channel::Range), 0u);
    EXPECT_TRUE(log.column(Channel::Pressure).empty()) << "a channel that the log lacks stays away";
    EXPECT_THAT(edited->notes, Contains(HasSubstr("range of run S02 from 2.5 to 5.0 s")));
}

TEST(SurveyEdits, StretchOfAllSensorsTakesEveryReading) {
    const auto edited = withEdits(walked(), {.stretches = {{"S01", 0, 3}}});
    ASSERT_TRUE(edited);
    for (const Channel channel : {Channel::Latitude, Channel::Roll, Channel::Range}) {
        EXPECT_EQ(missingOf(edited->runs[0].log, channel), 4u);
    }
}

TEST(SurveyEdits, MarkIsGoneEverywhere) {
    const auto edited = withEdits(walked(), {.marks = {"P01"}});
    ASSERT_TRUE(edited);
    EXPECT_FALSE(edited->findMark("P01"));
    for (const terrawalk::Run& run : edited->runs) {
        EXPECT_FALSE(run.start);
        EXPECT_EQ(run.target, "P02");
        ASSERT_EQ(run.stops.size(), 1u);
        EXPECT_EQ(run.stops[0].point, "P02");
    }
}

TEST(SurveyEdits, RunsAndLines) {
    const Breakline line{{{0, 0, kMissing}, {1, 1, kMissing}}, BreaklineKind::Soft, {}};
    const auto edited = withEdits(walked(), {.runs = {"S01"}, .lines = {line}});
    ASSERT_TRUE(edited);
    ASSERT_EQ(edited->runs.size(), 1u);
    EXPECT_EQ(edited->runs[0].id, "S02");
    ASSERT_EQ(edited->breaklines.size(), 1u);
    EXPECT_EQ(edited->breaklines[0].name, "drawn line 1");
    EXPECT_EQ(edited->notes.size(), 2u);
}

TEST(SurveyEdits, WhatTheSurveyLacksIsRefused) {
    EXPECT_FALSE(withEdits(walked(), {.stretches = {{"S09", 0, 3}}}));
    EXPECT_FALSE(withEdits(walked(), {.stretches = {{"S01", 20, 30}}}));
    EXPECT_FALSE(withEdits(walked(), {.runs = {"S09"}}));
    EXPECT_FALSE(withEdits(walked(), {.runs = {"S01", "S02"}}));
    EXPECT_FALSE(withEdits(walked(), {.marks = {"P09"}}));
    EXPECT_FALSE(withEdits(walked(), {.marks = {std::string(kZeroMark)}}));
}

}  // namespace
}  // namespace terrawalk
