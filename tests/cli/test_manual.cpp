#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <regex>
#include <sstream>

#include "tests/cli/cli_support.hpp"

namespace terrawalk {
namespace {

// A subcommand that the manual page does not know is one that nobody finds.
TEST(Manual, NamesEverySubcommandThatTheProgramHas) {
    const auto help = test::terrawalk({"--help"});
    ASSERT_EQ(help.exit_code, 0);
    std::ifstream stream(TERRAWALK_SOURCE_DIR "/resources/man/terrawalk.1");
    std::ostringstream page;
    page << stream.rdbuf();
    const std::string list = help.out.substr(help.out.find("Subcommands:"));
    const std::regex name("\n  ([a-z-]+) +[A-Z]");
    std::size_t found = 0;
    for (std::sregex_iterator it(list.begin(), list.end(), name), end; it != end; ++it, ++found) {
        const std::string subcommand = (*it)[1];
        EXPECT_TRUE(std::regex_search(page.str(), std::regex("\n\\.BI? " + subcommand + "[ \n]")))
            << subcommand;
    }
    EXPECT_GT(found, 10u);
}

}  // namespace
}  // namespace terrawalk
