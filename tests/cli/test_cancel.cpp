#include <gtest/gtest.h>
#include <signal.h>

#include <chrono>
#include <thread>

#include "tests/cli/cli_support.hpp"
#include "tests/support/slack.hpp"

namespace terrawalk::test {
namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;

class LongSurvey : public testing::Test {
  protected:
    // Long enough that a signal half a second after the start always finds the program at work.
    static void SetUpTestSuite() {
        scratch_ = new TemporaryFolder;
        const auto outcome = terrawalk({"simulate", "-o", survey().string(), "--seed", "3", "--fixed-runs",
                                        "2", "--area-epochs", "120000", "--area-east", "200", "--area-north",
                                        "200", "--check-points", "10", "--control-stops", "2"});
        ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    }
    static void TearDownTestSuite() {
        delete scratch_;
        scratch_ = nullptr;
    }
    static fs::path survey() { return *scratch_ / "survey"; }
    static TemporaryFolder* scratch_;
};
TemporaryFolder* LongSurvey::scratch_ = nullptr;

TEST_F(LongSurvey, CtrlCStopsWithinASecondAndLeavesNothing) {
    for (const int delay_ms : {200, 400, 700, 1100}) {
        const TemporaryFolder here;
        std::chrono::steady_clock::time_point sent;
        const auto outcome =
            terrawalk({"process", survey().string(), "-o", (here / "out").string()}, [&](pid_t program) {
                std::this_thread::sleep_for(milliseconds(delay_ms));
                sent = std::chrono::steady_clock::now();
                kill(program, SIGINT);
            });
        const double took_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - sent).count();
        // A program that is still being loaded has no handler yet and ends by the signal itself; on a busy
        // machine that takes a while.
        EXPECT_TRUE(outcome.exit_code == 4 || (delay_ms < 1100 && outcome.signal == SIGINT))
            << "after " << delay_ms << " ms: " << outcome.exit_code << " " << outcome.err;
        EXPECT_LT(took_s, 1.0 * kSlack) << "after " << delay_ms << " ms";
        EXPECT_TRUE(fs::is_empty(here.path())) << "after " << delay_ms << " ms";
    }
}

TEST_F(LongSurvey, AClosedTerminalLeavesNothing) {
    const TemporaryFolder here;
    const auto outcome =
        terrawalk({"process", survey().string(), "-o", (here / "out").string()}, [](pid_t program) {
            std::this_thread::sleep_for(milliseconds(600));
            kill(program, SIGHUP);
        });
    EXPECT_EQ(outcome.exit_code, 4) << outcome.err;
    EXPECT_TRUE(fs::is_empty(here.path()));
}

TEST_F(LongSurvey, AKilledRunLeavesThePreviousOutputWhole) {
    const TemporaryFolder here;
    const std::string out = (here / "out").string();
    ASSERT_EQ(terrawalk({"process", quickPlot().string(), "-o", out}).exit_code, 0);
    const auto previous = readTree(here / "out");
    for (const int delay_ms : {50, 300, 700, 1100}) {
        const auto outcome = terrawalk({"process", survey().string(), "-o", out}, [&](pid_t program) {
            std::this_thread::sleep_for(milliseconds(delay_ms));
            kill(program, SIGKILL);
        });
        EXPECT_EQ(outcome.signal, SIGKILL);
        EXPECT_TRUE(readTree(here / "out") == previous) << "after " << delay_ms << " ms";
    }
}

// Small surveys finish in a fraction of a second, so that these kills also hit the writing and the swap.
TEST(Kill, AtAnyMomentTheOutputIsTheOldOrTheNewOne) {
    const TemporaryFolder here;
    const std::string out = (here / "out").string();
    const auto make = [&](const char* cell, const std::function<void(pid_t)>& meanwhile) {
        return terrawalk(
            {"process", quickPlot().string(), "-o", out, "--set", std::string("surface.cell_m=") + cell},
            meanwhile);
    };
    ASSERT_EQ(make("0.5", {}).exit_code, 0);
    const auto coarse = readTree(here / "out");
    const auto timed = make("0.25", {});
    ASSERT_EQ(timed.exit_code, 0);
    const auto fine = readTree(here / "out");
    KillNearTheEnd killer(timed.seconds);
    for (int round = 0; round < 40 && killer.hits() < 6; ++round) {
        killer.learn(make(round % 2 == 0 ? "0.5" : "0.25", killer));
        const auto found = readTree(here / "out");
        ASSERT_TRUE(found == coarse || found == fine) << "round " << round;
    }
    EXPECT_EQ(killer.hits(), 6u);
    // The next run removes what the killed ones left beside the output.
    ASSERT_EQ(make("0.5", {}).exit_code, 0);
    std::size_t entries = 0;
    for (const auto& entry : fs::directory_iterator(here.path())) {
        ++entries;
        EXPECT_EQ(entry.path().filename(), "out");
    }
    EXPECT_EQ(entries, 1u);
}

}  // namespace
}  // namespace terrawalk::test
