#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "app/pipeline/jobs.hpp"
#include "app/pipeline/new_survey_job.hpp"
#include "io/read_survey.hpp"
#include "tests/support/temporary_folder.hpp"

namespace terrawalk {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

const fs::path kSamples = fs::path(TERRAWALK_SOURCE_DIR) / "sample_surveys";

/// The logs and marks of a sample, as a stick holds them: all in one folder, and no project.
void putLooseFiles(const fs::path& sample, const fs::path& folder) {
    fs::create_directories(folder);
    for (const auto& log : fs::directory_iterator(sample / "logs")) {
        fs::copy_file(log.path(), folder / log.path().filename());
    }
    fs::copy_file(sample / "control.csv", folder / "marks.csv");
}

SurveyDraft draftOf(const NewSurveyRequest& request) {
    SilentProgress silent;
    auto draft = draftSurvey(request, silent, {});
    EXPECT_TRUE(draft.has_value()) << (draft ? "" : draft.error().text());
    return draft ? *draft : SurveyDraft{};
}

TEST(LooseKind, IsToldByTheHeaderRow) {
    EXPECT_EQ(looseKind("# format: array-log 1\n\ntime_s,lat_deg\n0,1\n"), LooseKind::Log);
    EXPECT_EQ(looseKind("\xEF\xBB\xBFrole,point,e_m\n"), LooseKind::Marks);
    EXPECT_EQ(looseKind("time_s,e_m,n_m,u_m\n"), LooseKind::Trajectory);
    EXPECT_EQ(looseKind("name,price\n"), LooseKind::Other);
    EXPECT_EQ(looseKind("\"time_s\n"), LooseKind::Other);
    EXPECT_EQ(looseKind("# only a comment"), LooseKind::Other);
    EXPECT_EQ(looseKind(""), LooseKind::Other);
}

TEST(UtmZone, FollowsTheMapsOfTheWorld) {
    EXPECT_EQ(utmZone({23.18, 113.4, 0}), "EPSG:32649");
    EXPECT_EQ(utmZone({-33.9, 18.4, 0}), "EPSG:32734");
    EXPECT_EQ(utmZone({60.4, 5.3, 0}), "EPSG:32632");   // Bergen
    EXPECT_EQ(utmZone({78.2, 15.6, 0}), "EPSG:32633");  // Longyearbyen
    EXPECT_EQ(utmZone({0.0, 180.0, 0}), "EPSG:32601");
    EXPECT_EQ(utmZone({86.0, 0.0, 0}), "");
}

class GuessOfSample : public testing::TestWithParam<const char*> {};

// The samples' own project files are the truth that guesses are held to.
TEST_P(GuessOfSample, FindsKindsTargetsZeroPointAndFrame) {
    const test::TemporaryFolder scratch;
    putLooseFiles(kSamples / GetParam(), scratch / "walk");
    const SurveyDraft draft = draftOf({.files = {scratch / "walk"}});
    SilentProgress silent;
    const auto truth = readSurvey(kSamples / GetParam() / "survey.json", silent, {});
    ASSERT_TRUE(truth.has_value());
    EXPECT_TRUE(draft.bad_files.empty());
    EXPECT_EQ(draft.name, "walk");
    EXPECT_EQ(draft.crs, truth->crs);
    EXPECT_EQ(draft.marks.size(), truth->marks.size());
    ASSERT_EQ(draft.runs.size(), truth->runs.size());
    for (std::size_t i = 0; i < draft.runs.size(); ++i) {
        EXPECT_EQ(draft.runs[i].id, truth->runs[i].id);
        EXPECT_EQ(draft.runs[i].kind, truth->runs[i].kind) << draft.runs[i].id;
        EXPECT_EQ(draft.runs[i].target, truth->runs[i].target) << draft.runs[i].id;
        EXPECT_EQ(draft.runs[i].start, truth->runs[i].start) << draft.runs[i].id;
        EXPECT_FALSE(draft.runs[i].reason.empty());
        EXPECT_FALSE(problemOf(draft, i));
    }
    // The fixes of the samples err by 1.2 to 1.6 m, for seconds on end: that much over the root of the walks.
    const double tolerance_m = 3.0 * 1.6 / std::sqrt(static_cast<double>(draft.runs.size()));
    const Eigen::Vector3d off_m = truth->frame().toEnu(draft.zero_point);
    EXPECT_LT(off_m.head<2>().norm(), std::sqrt(2.0) * tolerance_m);
    EXPECT_LT(std::abs(off_m.z()), 2.0 * tolerance_m) << "heights err more";
}
INSTANTIATE_TEST_SUITE_P(Samples, GuessOfSample, testing::Values("quick_plot", "mango_orchard"));

TEST(NewSurvey, IsWrittenBesideTheLogsAndReadBackAsGuessed) {
    const test::TemporaryFolder scratch;
    putLooseFiles(kSamples / "quick_plot", scratch / "walk");
    SilentProgress silent;
    const auto made = makeNewSurvey({.files = {scratch / "walk"}, .name = "North \"terrace\""}, silent, {});
    ASSERT_TRUE(made.has_value()) << made.error().text();
    EXPECT_TRUE(fs::equivalent(made->survey.project_file, scratch / "walk/survey.json"));
    const auto read = readSurvey(scratch / "walk/survey.json", silent, {});
    ASSERT_TRUE(read.has_value()) << read.error().text();
    EXPECT_EQ(read->name, "North \"terrace\"");
    EXPECT_EQ(read->runs.size(), 4u);
    EXPECT_EQ(read->runs[1].target, "P02");
    EXPECT_EQ(read->control_file.filename(), "marks.csv");
    EXPECT_TRUE(read->notes.empty());
}

TEST(NewSurvey, IsNeverWrittenOverAnotherUnasked) {
    const test::TemporaryFolder scratch;
    putLooseFiles(kSamples / "quick_plot", scratch / "walk");
    test::writeBytes(scratch / "walk/survey.json", "mine");
    SilentProgress silent;
    NewSurveyRequest request{.files = {scratch / "walk"}};
    const auto refused = makeNewSurvey(request, silent, {});
    ASSERT_FALSE(refused.has_value());
    EXPECT_EQ(refused.error().kind, ErrorKind::Usage);
    EXPECT_EQ(test::bytesOf(scratch / "walk/survey.json"), "mine");
    request.replace = true;
    ASSERT_TRUE(makeNewSurvey(request, silent, {}).has_value());
    EXPECT_THAT(test::bytesOf(scratch / "walk/survey.json"), HasSubstr("terrawalk-survey 1"));
}

TEST(NewSurvey, NamesBadFilesWithLineAndCure) {
    const test::TemporaryFolder scratch;
    putLooseFiles(kSamples / "quick_plot", scratch / "walk");
    test::writeBytes(scratch / "walk/S02.csv", "time_s,lat_deg\n0,95\n");
    test::writeBytes(scratch / "walk/notes.csv", "day,weather\n1,rain\n");
    test::writeBytes(scratch / "walk/empty.csv", "");
    const SurveyDraft draft = draftOf({.files = {scratch / "walk", scratch / "walk/notes.csv"}});
    std::string told;
    for (const Error& error : draft.bad_files) told += error.text() + "\n";
    EXPECT_THAT(told, HasSubstr("S02.csv:2:"));
    EXPECT_THAT(told, HasSubstr("empty.csv: the file is empty"));
    EXPECT_EQ(draft.runs.size(), 4u) << "the good ones stay";
    std::string noted;
    for (const std::string& note : draft.notes) noted += note + "\n";
    EXPECT_THAT(noted, HasSubstr("notes.csv is passed over")) << "it was found in the folder first";
    const SurveyDraft named = draftOf({.files = {scratch / "walk/notes.csv"}});
    ASSERT_EQ(named.bad_files.size(), 1u);
    EXPECT_THAT(named.bad_files[0].text(), HasSubstr("point,e_m")) << "the cure tells both headers";
    SilentProgress silent;
    EXPECT_FALSE(writeDraft(draft, false).has_value());
    EXPECT_FALSE(fs::exists(scratch / "walk/survey.json"));
}

TEST(NewSurvey, TakesCorrectionsAndRefusesWhatCannotBe) {
    const test::TemporaryFolder scratch;
    putLooseFiles(kSamples / "quick_plot", scratch / "walk");
    NewSurveyRequest request{.files = {scratch / "walk"}};
    request.targets["F01"] = "C01";
    request.area_runs = {"F02"};
    request.zero_point = GeodeticPosition{23.182753, 113.399795, 38.0};
    request.crs = "";
    SurveyDraft draft = draftOf(request);
    EXPECT_EQ(draft.runs[0].target, "C01");
    EXPECT_EQ(draft.runs[1].kind, RunKind::Area);
    EXPECT_FALSE(draft.runs[1].target.has_value());
    EXPECT_EQ(draft.zero_point.h_ell_m, 38.0);
    EXPECT_EQ(draft.crs, "");
    ASSERT_TRUE(writeDraft(draft, false).has_value());

    const auto refusal = [&](auto change) {
        SurveyDraft other = draft;
        change(other);
        const auto written = writeDraft(other, true);
        return written ? std::string() : written.error().text();
    };
    EXPECT_THAT(refusal([](SurveyDraft& d) { d.runs[0].target = "P99"; }), HasSubstr("P99"));
    EXPECT_THAT(refusal([](SurveyDraft& d) { d.runs[0].target.reset(); }), HasSubstr("no target mark"));
    EXPECT_THAT(refusal([](SurveyDraft& d) { d.runs[1].id = "F01"; }), HasSubstr("two runs"));
    EXPECT_THAT(refusal([](SurveyDraft& d) { d.runs[1].id = "../x"; }), HasSubstr("cannot be the name"));
    EXPECT_THAT(refusal([](SurveyDraft& d) { d.crs = "EPSG:4326"; }), HasSubstr("EPSG:4326"));
    EXPECT_THAT(refusal([&](SurveyDraft& d) { d.project_file = scratch / "elsewhere/survey.json"; }),
                HasSubstr("outside the survey's folder"));
    EXPECT_THAT(refusal([](SurveyDraft& d) { d.runs.clear(); }), HasSubstr("no log"));
    request.targets = {{"F77", "P01"}};
    SilentProgress silent;
    const auto unknown = draftSurvey(request, silent, {});
    ASSERT_FALSE(unknown.has_value());
    EXPECT_THAT(unknown.error().text(), HasSubstr("F77"));
}

TEST(NewSurvey, WithoutPositionsNeedsToBeToldTheZeroPoint) {
    const test::TemporaryFolder scratch;
    test::writeBytes(scratch / "walk/S01.csv", "time_s,range_m\n0.0,1.2\n0.2,1.2\n0.4,1.2\n");
    SilentProgress silent;
    NewSurveyRequest request{.files = {scratch / "walk"}};
    const auto refused = makeNewSurvey(request, silent, {});
    ASSERT_FALSE(refused.has_value());
    EXPECT_EQ(refused.error().kind, ErrorKind::Usage);
    EXPECT_THAT(refused.error().text(), HasSubstr("zero point"));
    request.zero_point = GeodeticPosition{23.18, 113.4, 38.0};
    const auto made = makeNewSurvey(request, silent, {});
    ASSERT_TRUE(made.has_value()) << made.error().text();
    EXPECT_EQ(made->survey.crs, "EPSG:32649");
}

TEST(NewSurvey, TargetInTheNameOfTheFileWins) {
    const test::TemporaryFolder scratch;
    putLooseFiles(kSamples / "quick_plot", scratch / "walk");
    fs::rename(scratch / "walk/F01.csv", scratch / "walk/ZERO_to_P03 (2).csv");
    const SurveyDraft draft = draftOf({.files = {scratch / "walk"}});
    const auto& run = draft.runs.back();
    EXPECT_EQ(run.id, "ZERO_to_P03__2_");
    EXPECT_EQ(run.target, "P03");
    EXPECT_THAT(run.reason, HasSubstr("name"));
}

TEST(CommonFolder, HoldsAllFiles) {
    EXPECT_EQ(commonFolder({"/a/b/c.csv", "/a/b/d/e.csv", "/a/bb/f.csv"}), "/a");
    EXPECT_EQ(commonFolder({"/a/b/c.csv"}), "/a/b");
    EXPECT_EQ(commonFolder({}), "");
}

}  // namespace
}  // namespace terrawalk
