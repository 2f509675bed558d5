#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <filesystem>
#include <functional>
#include <string>

#include "io/project_file.hpp"
#include "io/read_survey.hpp"
#include "tests/support/temporary_folder.hpp"

namespace terrawalk {
namespace {

using testing::AllOf;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

const std::string kLog = "# format: array-log 1\ntime_s,range_m\n0.0,1.25\n5.0,1.50\n10.0,1.75\n";
const std::string kControl =
    "point,e_m,n_m,u_m,sigma_h_m,sigma_v_m,role\nP01,1,2,3,0.005,0.005,control\nP03,4,5,6,0.005,0.005,"
    "check\n";
const std::string kProject = R"({
  "format": "terrawalk-survey 1",
  "name": "Test field",
  "zero_point": {"lat_deg": 23.182753, "lon_deg": 113.399795, "h_ell_m": 38.0},
  "crs": "EPSG:32649",
  "vertical_datum": "local",
  "control": "control.csv",
  "runs": [
    {"id": "F01", "kind": "fixed-point", "log": "logs/F01.csv", "start": "ZERO", "target": "P01"},
    {"id": "S01", "kind": "area", "log": "logs/S01.csv", "start": "ZERO",
     "stops": [{"point": "P03", "from_s": 2.0, "to_s": 4.5}], "target": "P01"}
  ]
}
)";

std::string replaced(std::string text, std::string_view from, std::string_view to) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
}

class ProjectReader : public testing::Test {
  protected:
    ProjectReader() {
        test::writeBytes(folder_ / "logs/F01.csv", kLog);
        test::writeBytes(folder_ / "logs/S01.csv", kLog);
        test::writeBytes(folder_ / "control.csv", kControl);
        write(kProject);
    }
    void write(const std::string& project) { test::writeBytes(project_, project); }
    Result<Survey> read() const {
        SilentProgress progress;
        return readSurvey(project_, progress, {});
    }
    std::string error() const {
        const auto survey = read();
        return survey ? std::string() : survey.error().text();
    }
    std::string errorOf(const std::string& project) {
        write(project);
        return error();
    }
    std::string errorWith(std::string_view from, std::string_view to) {
        return errorOf(replaced(kProject, from, to));
    }

    const test::TemporaryFolder folder_;
    const std::filesystem::path project_ = folder_ / "survey.json";
};

TEST_F(ProjectReader, ReadsTheWholeSurvey) {
    const auto survey = read();
    ASSERT_TRUE(survey) << survey.error().text();
    EXPECT_EQ(survey->name, "Test field");
    EXPECT_EQ(survey->zero_point.lat_deg, 23.182753);
    EXPECT_EQ(survey->zero_point.lon_deg, 113.399795);
    EXPECT_EQ(survey->zero_point.h_ell_m, 38.0);
    EXPECT_EQ(survey->crs, "EPSG:32649");
    EXPECT_EQ(survey->vertical_datum, "local");
    EXPECT_EQ(survey->control_file, folder_ / "control.csv");
    EXPECT_THAT(survey->marks, SizeIs(2));
    EXPECT_THAT(survey->notes, IsEmpty());
    ASSERT_THAT(survey->runs, SizeIs(2));
    EXPECT_EQ(survey->runs[0].kind, RunKind::FixedPoint);
    EXPECT_EQ(survey->runs[0].start, "ZERO");
    EXPECT_EQ(survey->runs[0].target, "P01");
    EXPECT_EQ(survey->runs[0].log.file, folder_ / "logs/F01.csv");
    const terrawalk::Run& area = survey->runs[1];
    EXPECT_EQ(area.id, "S01");
    EXPECT_EQ(area.kind, RunKind::Area);
    ASSERT_THAT(area.stops, SizeIs(1));
    EXPECT_EQ(area.stops[0].point, "P03");
    EXPECT_EQ(area.stops[0].from_s, 2.0);
    EXPECT_EQ(area.stops[0].to_s, 4.5);
    EXPECT_EQ(area.log.size(), 3U);
}

TEST_F(ProjectReader, OptionalKeysMayBeAbsent) {
    write(R"({"format": "terrawalk-survey 1", "name": "x",
              "zero_point": {"lat_deg": 1, "lon_deg": 2, "h_ell_m": 3},
              "runs": [{"id": "S01", "kind": "area", "log": "logs/S01.csv"}]})");
    const auto survey = read();
    ASSERT_TRUE(survey) << survey.error().text();
    EXPECT_EQ(survey->crs, "");
    EXPECT_EQ(survey->vertical_datum, "local");
    EXPECT_TRUE(survey->control_file.empty());
    EXPECT_THAT(survey->marks, IsEmpty());
    EXPECT_FALSE(survey->runs[0].start);
    EXPECT_FALSE(survey->runs[0].target);
}

TEST_F(ProjectReader, UnknownKeysAreNotedWithPathAndLine) {
    write(replaced(replaced(replaced(kProject, "\"crs\"", "\"weather\": {\"a\": 1}, \"crs\""),
                            "\"id\": \"S01\"", "\"id\": \"S01\", \"walker\": \"A\""),
                   "\"h_ell_m\": 38.0", "\"h_ell_m\": 38.0, \"epoch\": 2010"));
    const auto survey = read();
    ASSERT_TRUE(survey) << survey.error().text();
    EXPECT_THAT(survey->notes,
                testing::UnorderedElementsAre("line 5: unknown key weather is not used",
                                              "line 10: unknown key runs[1].walker is not used",
                                              "line 4: unknown key zero_point.epoch is not used"));
}

TEST_F(ProjectReader, EveryKeyIsCheckedForItsType) {
    struct Case {
        std::string_view from, to, message;
    };
    const std::string file = project_.string();
    for (const Case& c : std::initializer_list<Case>{
             {"\"terrawalk-survey 1\"", "1", ":2: format must be a text, but is a number"},
             {"\"Test field\"", "[]", ":3: name must be a text, but is a list"},
             {"{\"lat_deg\": 23.182753, \"lon_deg\": 113.399795, \"h_ell_m\": 38.0}", "5",
              ":4: zero_point must be an object, but is a number"},
             {"23.182753", "\"23\"", ":4: zero_point.lat_deg must be a number, but is a text"},
             {"38.0", "null", ":4: zero_point.h_ell_m must be a number, but is null"},
             {"\"EPSG:32649\"", "32649", ":5: crs must be a text, but is a number"},
             {"\"local\"", "true", ":6: vertical_datum must be a text, but is true or false"},
             {"\"control.csv\"", "{}", ":7: control must be a text, but is an object"},
             {"\"F01\", \"kind\"", "1, \"kind\"", ":9: runs[0].id must be a text, but is a number"},
             {"\"fixed-point\"", "0", ":9: runs[0].kind must be a text"},
             {"\"logs/S01.csv\"", "[1]", ":10: runs[1].log must be a text, but is a list"},
             {"\"start\": \"ZERO\",\n", "\"start\": 1,\n", ":10: runs[1].start must be a text"},
             {"[{\"point\": \"P03\", \"from_s\": 2.0, \"to_s\": 4.5}]", "{}",
              ":11: runs[1].stops must be a list, but is an object"},
             {"{\"point\": \"P03\", \"from_s\": 2.0, \"to_s\": 4.5}", "7",
              ":11: runs[1].stops[0] must be an object, but is a number"},
             {"2.0", "\"2\"", ":11: runs[1].stops[0].from_s must be a number"}}) {
        EXPECT_THAT(errorWith(c.from, c.to), HasSubstr(file + std::string(c.message)));
    }
    EXPECT_THAT(errorOf("[]"), HasSubstr("the project must be an object, but is a list"));
    EXPECT_THAT(
        errorOf("{\"format\": \"terrawalk-survey 1\", \"name\": \"x\", \"zero_point\": {\"lat_deg\": 1, "
                "\"lon_deg\": 2, \"h_ell_m\": 3},\n\"runs\": {}}"),
        HasSubstr(":2: runs must be a list, but is an object"));
}

TEST_F(ProjectReader, RequiredKeysAreMissed) {
    EXPECT_THAT(errorOf("{}"), HasSubstr(":1: format is missing"));
    EXPECT_THAT(errorWith("\"format\"", "\"fmt\""), HasSubstr(":1: format is missing"));
    EXPECT_THAT(errorWith("survey 1\"", "survey 2\""),
                HasSubstr(":2: format is \"terrawalk-survey 2\"; write"));
    EXPECT_THAT(errorWith("\"zero_point\"", "\"zero\""), HasSubstr("zero_point is missing"));
    EXPECT_THAT(errorWith("\"lon_deg\"", "\"long\""), HasSubstr(":4: zero_point.lon_deg is missing"));
    EXPECT_THAT(errorWith("\"runs\"", "\"walks\""), HasSubstr("runs is missing"));
    EXPECT_THAT(errorWith("\"id\": \"S01\", ", ""), HasSubstr(":10: runs[1].id is missing"));
    EXPECT_THAT(errorWith("\"kind\": \"area\", ", ""), HasSubstr(":10: runs[1].kind is missing"));
    EXPECT_THAT(errorWith("\"log\": \"logs/S01.csv\", ", ""), HasSubstr(":10: runs[1].log is missing"));
    EXPECT_THAT(errorWith("\"to_s\": 4.5", "\"x\": 4.5"), HasSubstr(":11: runs[1].stops[0].to_s is missing"));
    EXPECT_THAT(errorWith("\"log\": \"logs/S01.csv\"", "\"log\": \"\""),
                HasSubstr(":10: runs[1].log is empty"));
}

TEST_F(ProjectReader, ValuesAreChecked) {
    EXPECT_THAT(errorWith("23.182753", "93.1"),
                HasSubstr(":4: zero_point.lat_deg is 93.1, outside -90 to 90"));
    EXPECT_THAT(errorWith("113.399795", "-180.1"), HasSubstr("zero_point.lon_deg"));
    EXPECT_THAT(errorWith("38.0", "380000"), HasSubstr("zero_point.h_ell_m"));
    EXPECT_THAT(errorWith("\"area\"", "\"Area\""), HasSubstr(":10: runs[1].kind is \"Area\"; write"));
    EXPECT_THAT(errorWith("\"to_s\": 4.5", "\"to_s\": 2.0"),
                HasSubstr(":11: runs[1].stops[0].to_s must be later"));
    EXPECT_THAT(errorWith("\"S01\"", "\"F01\""),
                AllOf(HasSubstr(":10: runs[1].id: \"F01\""), HasSubstr("(line 9)")));
    for (const std::string& id : std::initializer_list<std::string>{".hidden", "a/b", "a b", "..", "\\u0000",
                                                                    "", "\xC3\xB6", std::string(65, 'a')}) {
        EXPECT_THAT(errorWith("\"S01\"", "\"" + id + "\""), HasSubstr(":10: runs[1].id is ")) << id;
    }
    EXPECT_THAT(
        errorOf("{\"format\": \"terrawalk-survey 1\", \"name\": \"x\", \"zero_point\": {\"lat_deg\": 1, "
                "\"lon_deg\": 2, \"h_ell_m\": 3},\n\"runs\": []}"),
        HasSubstr(":2: runs is empty"));
}

TEST_F(ProjectReader, FixedPointRunsNeedStartAndTarget) {
    EXPECT_THAT(errorWith(", \"start\": \"ZERO\", \"target\": \"P01\"}", ", \"start\": \"ZERO\"}"),
                HasSubstr(":9: runs[0].target is missing"));
    EXPECT_THAT(errorWith("\"start\": \"ZERO\", \"target\": \"P01\"}", "\"target\": \"P01\"}"),
                HasSubstr(":9: runs[0].start is missing"));
}

TEST_F(ProjectReader, EveryNamedMarkMustExist) {
    EXPECT_THAT(errorWith("\"target\": \"P01\"}", "\"target\": \"P99\"}"),
                HasSubstr(":9: runs[0].target: there is no mark \"P99\""));
    EXPECT_THAT(errorWith("\"P03\"", "\"P98\""),
                HasSubstr(":11: runs[1].stops[0].point: there is no mark \"P98\""));
    EXPECT_THAT(errorWith("  \"control\": \"control.csv\",\n", ""),
                AllOf(HasSubstr("no mark \"P01\""), HasSubstr("under \"control\"")));
}

TEST_F(ProjectReader, StopsLieWithinTheLog) {
    EXPECT_THAT(errorWith("\"to_s\": 4.5", "\"to_s\": 10.5"),
                HasSubstr(":11: runs[1].stops[0]: 2 to 10.5 s is not within the log, 0 to 10 s"));
    EXPECT_THAT(errorWith("\"from_s\": 2.0", "\"from_s\": -1"), HasSubstr("is not within the log"));
    EXPECT_EQ(errorWith("\"from_s\": 2.0, \"to_s\": 4.5", "\"from_s\": 0, \"to_s\": 10"), "");
}

TEST_F(ProjectReader, MissingFilesAreNamed) {
    std::filesystem::remove(folder_ / "logs/S01.csv");
    EXPECT_THAT(error(), HasSubstr("logs/S01.csv: no such file"));
    std::filesystem::remove(folder_ / "control.csv");
    EXPECT_THAT(error(), HasSubstr("control.csv: no such file"));
    std::filesystem::remove(project_);
    EXPECT_THAT(error(), HasSubstr("survey.json: no such file"));
    SilentProgress progress;
    EXPECT_THAT(readSurvey(folder_.path(), progress, {}).error().text(), HasSubstr("this is a folder"));
    EXPECT_THAT(readSurvey("/dev/zero", progress, {}).error().text(), HasSubstr("no regular file"));
}

TEST_F(ProjectReader, BreaklinesAreReadWithTheSurvey) {
    test::writeBytes(folder_ / "walls.geojson", R"({"type": "FeatureCollection",
"crs": {"type": "name", "properties": {"name": "urn:ogc:def:crs:EPSG::32649"}},
"features": [{"type": "Feature", "properties": {"kind": "soft"}, "geometry":
{"type": "LineString", "coordinates": [[500010, 2500015, 16], [500030, 2500015, 18]]}}]})");
    write(replaced(kProject, "\"control\":", "\"breaklines\": \"walls.geojson\", \"control\":"));
    const auto survey = read();
    ASSERT_TRUE(survey) << survey.error().text();
    EXPECT_THAT(survey->notes, IsEmpty());
    EXPECT_EQ(survey->breakline_file, folder_ / "walls.geojson");
    ASSERT_THAT(survey->breaklines, SizeIs(1));
    EXPECT_EQ(survey->breaklines.front().kind, BreaklineKind::Soft);
    EXPECT_EQ(survey->breaklines.front().vertices_m.back(), Eigen::Vector3d(500030, 2500015, 18));
    EXPECT_THAT(survey->breakline_crs, HasSubstr("32649"));

    EXPECT_THAT(errorWith("\"control\":", "\"breaklines\": \"none.gpkg\", \"control\":"),
                HasSubstr("none.gpkg"));
    EXPECT_THAT(errorWith("\"control\":", "\"breaklines\": \"../walls.gpkg\", \"control\":"),
                HasSubstr("leaves the project's folder"));
}

TEST_F(ProjectReader, PathsMayNotLeaveTheFolder) {
    const auto withLog = [&](std::string_view path) {
        return errorWith("logs/S01.csv", path);
    };
    EXPECT_THAT(withLog("/etc/passwd"), HasSubstr(":10: runs[1].log: \"/etc/passwd\" is an absolute path"));
    EXPECT_THAT(withLog("../S01.csv"), HasSubstr("leaves the project's folder"));
    EXPECT_THAT(withLog("logs/../../S01.csv"), HasSubstr("leaves the project's folder"));
    EXPECT_THAT(withLog("a\\u0000b"), HasSubstr("control character"));
    EXPECT_EQ(withLog("logs/../logs/./S01.csv"), "");
    EXPECT_THAT(errorWith("\"control.csv\"", "\"../control.csv\""), HasSubstr(":7: control: "));
    EXPECT_THAT(withLog("logs"), HasSubstr("this is a folder"));
}

TEST_F(ProjectReader, LinksMayNotLeaveTheFolderEither) {
    const test::TemporaryFolder elsewhere;
    test::writeBytes(elsewhere / "S01.csv", kLog);
    std::filesystem::create_symlink(elsewhere / "S01.csv", folder_ / "logs/out.csv");
    std::filesystem::create_directory_symlink(elsewhere.path(), folder_ / "outside");
    std::filesystem::create_symlink("S01.csv", folder_ / "logs/in.csv");
    std::filesystem::create_symlink("loop.csv", folder_ / "logs/loop.csv");
    std::filesystem::create_symlink("/nowhere/at/all.csv", folder_ / "logs/dangling.csv");
    const auto withLog = [&](std::string_view path) {
        return errorWith("logs/S01.csv", path);
    };
    EXPECT_THAT(withLog("logs/out.csv"), HasSubstr("leads out of the project's folder by a link"));
    EXPECT_THAT(withLog("outside/S01.csv"), HasSubstr("leads out of the project's folder by a link"));
    EXPECT_EQ(withLog("logs/in.csv"), "");
    EXPECT_NE(withLog("logs/loop.csv"), "");
    EXPECT_NE(withLog("logs/dangling.csv"), "");
}

TEST_F(ProjectReader, FolderMayBeReachedByALink) {
    const test::TemporaryFolder elsewhere;
    std::filesystem::create_directory_symlink(folder_.path(), elsewhere / "field");
    SilentProgress progress;
    EXPECT_TRUE(readSurvey(elsewhere / "field/survey.json", progress, {}));
}

TEST_F(ProjectReader, SharedLogIsNoted) {
    write(replaced(kProject, "logs/F01.csv", "logs/S01.csv"));
    const auto survey = read();
    ASSERT_TRUE(survey) << survey.error().text();
    EXPECT_THAT(survey->notes, ElementsAre("line 10: runs[1] reads the same log as runs[0]"));
}

TEST_F(ProjectReader, NotesOfTheControlFileArePassedOn) {
    test::writeBytes(folder_ / "control.csv", kControl + "ZERO,0,0,0,0,0,control\n");
    const auto survey = read();
    ASSERT_TRUE(survey) << survey.error().text();
    ASSERT_THAT(survey->notes, SizeIs(1));
    EXPECT_THAT(survey->notes[0], HasSubstr("control marks, line 4: the row of ZERO"));
}

TEST_F(ProjectReader, DamagedJsonNamesTheLine) {
    EXPECT_THAT(errorOf(""), HasSubstr("survey.json:1: no valid JSON"));
    EXPECT_THAT(errorWith("\"runs\": [", "\"runs\": [,"), HasSubstr("survey.json:8: no valid JSON"));
    EXPECT_THAT(errorWith("\"crs\"", "\"name\""), HasSubstr("survey.json:5: the key \"name\" stands twice"));
    EXPECT_THAT(errorOf(std::string(100'000, '[')), HasSubstr("nested too deeply"));
    EXPECT_THAT(errorOf(std::string(1000, '\0')), HasSubstr("no valid JSON"));
}

TEST_F(ProjectReader, HugeProjectFilesAreRefused) {
    std::filesystem::resize_file(project_, std::uintmax_t{9} << 20U);
    EXPECT_THAT(error(), HasSubstr("larger than 8 MB"));
}

TEST_F(ProjectReader, TruncationAtEveryByteIsAnErrorWithAMessage) {
    const std::size_t whole = kProject.rfind('}') + 1;
    for (std::size_t length = 0; length < whole; ++length) {
        const auto project = parseProjectFile(std::string_view(kProject).substr(0, length), "survey.json");
        ASSERT_FALSE(project) << length;
        ASSERT_FALSE(project.error().message.empty());
        ASSERT_GT(project.error().line, 0U);
    }
    EXPECT_TRUE(parseProjectFile(std::string_view(kProject).substr(0, whole), "survey.json"));
}

TEST_F(ProjectReader, FirstBadRunIsReportedWhateverTheThreads) {
    std::string runs;
    for (int i = 0; i < 12; ++i) {
        const bool bad = i >= 5;
        // The first bad log is the longest, so that it is finished last.
        std::string log = "# format: array-log 1\ntime_s\n";
        for (int k = 0; k < (i == 5 ? 100'000 : 10); ++k) log += fmt::format("{}\n", k);
        test::writeBytes(folder_ / fmt::format("logs/A{}.csv", i), log + (bad ? "abc\n" : ""));
        runs += fmt::format("{}{{\"id\": \"A{}\", \"kind\": \"area\", \"log\": \"logs/A{}.csv\"}}",
                            i ? ",\n" : "", i, i);
    }
    write(
        R"({"format": "terrawalk-survey 1", "name": "x", "zero_point": {"lat_deg": 1, "lon_deg": 2, "h_ell_m": 3}, "runs": [)" +
        runs + "]}");
    for (const std::size_t threads : {1U, 2U, 4U}) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        for (int repeat = 0; repeat < 3; ++repeat) {
            EXPECT_THAT(error(), HasSubstr("logs/A5.csv:100003: column time_s: \"abc\""));
        }
    }
}

TEST_F(ProjectReader, CanBeCancelled) {
    std::stop_source stop;
    stop.request_stop();
    SilentProgress progress;
    const auto survey = readSurvey(project_, progress, stop.get_token());
    ASSERT_FALSE(survey);
    EXPECT_EQ(survey.error().kind, ErrorKind::Cancelled);
}

TEST_F(ProjectReader, ProgressAddsUpToOne) {
    class Last final : public Progress {
      public:
        void report(double fraction, std::string_view) override { greatest = std::max(greatest, fraction); }
        void message(Severity, std::string_view) override {}
        double greatest = 0.0;
    } progress;
    const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
    ASSERT_TRUE(readSurvey(project_, progress, {}));
    EXPECT_NEAR(progress.greatest, 1.0, 1e-6);
}

TEST(RealData, PaddockFlightIsRead) {
    const std::filesystem::path project =
        std::filesystem::path(TERRAWALK_SHARED_DATA) / "paddock_flight/survey.json";
    if (!std::filesystem::exists(project)) GTEST_SKIP() << project << " is not here";
    SilentProgress progress;
    const auto survey = readSurvey(project, progress, {});
    ASSERT_TRUE(survey) << survey.error().text();
    EXPECT_THAT(survey->notes, IsEmpty());
    ASSERT_THAT(survey->runs, SizeIs(1));
    const ArrayLog& log = survey->runs[0].log;
    EXPECT_NEAR(static_cast<double>(log.size()), 5000.0, 50.0);
    EXPECT_EQ(log.sample_interval_s, 0.1);
    EXPECT_EQ(log.start_utc, "2014-12-27T00:00:00Z");
    EXPECT_FALSE(log.has(Channel::EllipsoidalHeight));
    EXPECT_THAT(log.read_report.notes, IsEmpty());
    EXPECT_EQ(log.read_report.cut_off_line, 0U);
    std::size_t fixes = 0;
    for (std::size_t i = 0; i < log.size(); ++i) {
        const bool here = present(log.value(Channel::Latitude, i));
        ASSERT_EQ(here, present(log.value(Channel::Longitude, i)));
        if (!here) continue;
        ++fixes;
        ASSERT_NEAR(log.value(Channel::Latitude, i), survey->zero_point.lat_deg, 0.01);
        ASSERT_NEAR(log.value(Channel::Longitude, i), survey->zero_point.lon_deg, 0.01);
    }
    EXPECT_NEAR(static_cast<double>(fixes) / static_cast<double>(log.size()), 0.5, 0.05);
    EXPECT_DOUBLE_EQ(log.value(Channel::Heading, 0), radians(343.880));
}

}  // namespace
}  // namespace terrawalk
