#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/cli/cli_support.hpp"

namespace terrawalk::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

TEST(ExperimentCommand, PrintsATableAndWritesCsvAndPlot) {
    const TemporaryFolder scratch;
    const auto outcome =
        terrawalk({"experiment", "fig8", "--quick", "-o", scratch.path().string(), "--seed", "9"});
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("seed 9, quick form"));
    EXPECT_THAT(outcome.out, HasSubstr("good points"));
    EXPECT_TRUE(fs::is_regular_file(scratch / "fig8.csv"));
    EXPECT_TRUE(fs::is_regular_file(scratch / "fig8.svg"));
}

TEST(ExperimentCommand, PrintsJsonOrNothing) {
    const TemporaryFolder scratch;
    const std::vector<std::string> command{"experiment", "fig8", "--quick", "-o", scratch.path().string()};
    auto json_command = command;
    json_command.emplace_back("--json");
    const auto json = nlohmann::json::parse(terrawalk(json_command).out);
    EXPECT_EQ(json.at("rows").size(), 3U);
    EXPECT_TRUE(fs::exists(json.at("svg").get<std::string>()));
    auto quiet_command = command;
    quiet_command.emplace_back("--quiet");
    EXPECT_EQ(terrawalk(quiet_command).out, "");
}

TEST(ExperimentCommand, ListsWhatThereIsAndRefusesTheRest) {
    const auto list = terrawalk({"experiment", "--list"});
    EXPECT_EQ(list.exit_code, 0);
    EXPECT_THAT(list.out, HasSubstr("fig7"));
    for (const auto& wrong : {std::vector<std::string>{"experiment", "fig99"}, {"experiment"}}) {
        const auto refused = terrawalk(wrong);
        EXPECT_EQ(refused.exit_code, 2);
        EXPECT_THAT(refused.err, HasSubstr("--list"));
    }
}

}  // namespace
}  // namespace terrawalk::test
