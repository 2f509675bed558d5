#include <gmock/gmock.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/seccomp.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <set>

#include "io/output_folder.hpp"
#include "tests/support/file_size_limit.hpp"
#include "tests/support/temporary_folder.hpp"

namespace terrawalk {
namespace {

namespace fs = std::filesystem;
using test::bytesOf;
using test::TemporaryFolder;
using test::writeBytes;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::UnorderedElementsAre;

std::set<std::string> tree(const fs::path& folder) {
    std::set<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        names.insert(entry.path().lexically_relative(folder).string());
    }
    return names;
}

std::string manifest(const std::vector<std::string>& products) {
    return nlohmann::json{{"format", "terrawalk-output 1"}, {"products", products}}.dump();
}

/// One generation of products: every file names it.
Result<void> writeGeneration(OutputFolder& folder, const std::string& generation, int files = 2) {
    std::vector<std::string> products;
    for (int i = 0; i < files; ++i) {
        const std::string name = (i % 2 == 0 ? "product" : "trajectory/product") + std::to_string(i);
        const auto path = folder.pathFor(name);
        if (!path) return tl::unexpected(path.error());
        if (auto written = writeTextFile(generation, *path); !written) return written;
        products.push_back(name);
    }
    const auto path = folder.pathFor("manifest.json");
    if (!path) return tl::unexpected(path.error());
    return writeTextFile(manifest(products), *path);
}

Result<void> publish(const fs::path& target, const std::string& generation, int files = 2) {
    auto folder = OutputFolder::create(target);
    if (!folder) return tl::unexpected(folder.error());
    if (auto written = writeGeneration(*folder, generation, files); !written) return written;
    return folder->commit();
}

/// The generation that the target holds; fails when it holds two, or a part of one.
std::string wholeGeneration(const fs::path& target) {
    const auto json = nlohmann::json::parse(bytesOf(target / "manifest.json"), nullptr, false);
    if (!json.is_object()) {
        ADD_FAILURE() << "no manifest";
        return {};
    }
    std::set<std::string> generations;
    std::set<std::string> names{"manifest.json"};
    for (const auto& product : json["products"]) {
        const std::string name = product.get<std::string>();
        generations.insert(bytesOf(target / name));
        names.insert(name);
        if (name.find('/') != std::string::npos) names.insert("trajectory");
    }
    EXPECT_EQ(generations.size(), 1U);
    EXPECT_EQ(tree(target), names);
    return *generations.begin();
}

std::string refusalOf(const fs::path& target, ErrorKind kind = ErrorKind::Usage) {
    const auto folder = OutputFolder::create(target);
    if (folder) return "accepted";
    EXPECT_EQ(folder.error().kind, kind);
    return folder.error().text();
}

int statusOf(pid_t child) {
    int status = 0;
    while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
    }
    return status;
}

/// Makes renameat2 fail as on a file system that cannot exchange. For child processes: there is no way back.
bool forbidExchange() {
    std::array<sock_filter, 4> program{{
        BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
        BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, SYS_renameat2, 0, 1),
        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | EINVAL),
        BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW),
    }};
    const sock_fprog filter{static_cast<unsigned short>(program.size()), program.data()};
    return ::prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
           ::prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &filter) == 0;
}

TEST(OutputFolder, AppearsWholeWithItsParentsAtCommit) {
    const TemporaryFolder folder;
    const fs::path target = folder / "a/b/out/";
    auto output = OutputFolder::create(target);
    ASSERT_TRUE(output) << output.error().text();
    ASSERT_TRUE(writeGeneration(*output, "one"));
    EXPECT_FALSE(fs::exists(folder / "a/b/out"));
    const auto committed = output->commit();
    ASSERT_TRUE(committed) << committed.error().text();
    EXPECT_EQ(wholeGeneration(target), "one");
    EXPECT_THAT(tree(folder / "a/b"), ElementsAre("out", "out/manifest.json", "out/product0",
                                                  "out/trajectory", "out/trajectory/product1"));
}

TEST(OutputFolder, ReplacesAnEarlierOutputCompletely) {
    const TemporaryFolder folder;
    ASSERT_TRUE(publish(folder / "out", "one", 6));
    ASSERT_TRUE(publish(folder / "out", "two", 1));
    EXPECT_EQ(wholeGeneration(folder / "out"), "two");
    EXPECT_THAT(tree(folder.path()), ElementsAre("out", "out/manifest.json", "out/product0"));
}

TEST(OutputFolder, TakesAnEmptyFolderWithItsPermissions) {
    const TemporaryFolder folder;
    fs::create_directory(folder / "out");
    fs::permissions(folder / "out", fs::perms::owner_all | fs::perms::group_all);
    ASSERT_TRUE(publish(folder / "out", "one"));
    ASSERT_TRUE(publish(folder / "out", "two"));
    EXPECT_EQ(wholeGeneration(folder / "out"), "two");
    EXPECT_EQ(fs::status(folder / "out").permissions(), fs::perms::owner_all | fs::perms::group_all);
}

TEST(OutputFolder, WithoutCommitNothingIsLeft) {
    const TemporaryFolder folder;
    {
        auto output = OutputFolder::create(folder / "new/out");
        ASSERT_TRUE(output);
        ASSERT_TRUE(writeGeneration(*output, "one"));
        OutputFolder moved = std::move(*output);
        EXPECT_TRUE(fs::exists(folder / "new"));
    }
    EXPECT_TRUE(fs::is_empty(folder.path()));
    ASSERT_TRUE(publish(folder / "out", "one"));
    {
        auto output = OutputFolder::create(folder / "out");
        ASSERT_TRUE(output && writeGeneration(*output, "two"));
    }
    EXPECT_EQ(wholeGeneration(folder / "out"), "one");
    EXPECT_EQ(tree(folder.path()).size(), 5U);
}

TEST(OutputFolder, KeepsFilesOfOthersButNoSideFilesOfItsRasters) {
    const TemporaryFolder folder;
    const fs::path out = folder / "out";
    ASSERT_TRUE(publish(out, "one"));
    writeBytes(out / "manifest.json", manifest({"product0", "trajectory/product1", "dem.tif"}));
    writeBytes(out / "dem.tif", "raster");
    for (const char* side : {"dem.tif.aux.xml", "dem.tif.ovr", "dem.tif.msk", "dem.tfw"})
        writeBytes(out / side, "x");
    writeBytes(out / "notes.txt", "mine");
    writeBytes(out / "trajectory/mine.txt", "mine");
    writeBytes(out / "photos/1.jpg", "photo");
    writeBytes(out / "photos/1.ovr", "side file of no product");
    fs::create_directory(out / "empty");
    fs::create_symlink("nowhere", out / "link");
    ASSERT_TRUE(publish(out, "two", 1));
    EXPECT_THAT(tree(out),
                ElementsAre("empty", "link", "manifest.json", "notes.txt", "photos", "photos/1.jpg",
                            "photos/1.ovr", "product0", "trajectory", "trajectory/mine.txt"));
    EXPECT_EQ(bytesOf(out / "notes.txt"), "mine");
    EXPECT_EQ(bytesOf(out / "product0"), "two");
    EXPECT_EQ(fs::read_symlink(out / "link"), "nowhere");
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1);
}

TEST(OutputFolder, ANewProductNeverReplacesAFileOfOthers) {
    const TemporaryFolder folder;
    ASSERT_TRUE(publish(folder / "out", "one", 1));
    writeBytes(folder / "out/trajectory/product1", "mine");
    const auto refused = publish(folder / "out", "two", 2);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().kind, ErrorKind::Usage);
    EXPECT_THAT(refused.error().text(), HasSubstr("trajectory/product1"));
    EXPECT_EQ(bytesOf(folder / "out/trajectory/product1"), "mine");
    EXPECT_EQ(bytesOf(folder / "out/product0"), "one");
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1);
}

TEST(OutputFolder, RefusesWhatIsNotItsOwnAndLeavesItAlone) {
    const TemporaryFolder folder;
    writeBytes(folder / "papers/thesis.tex", "ten years");
    writeBytes(folder / "other/manifest.json", R"({"format": "another program", "products": []})");
    writeBytes(folder / "broken/manifest.json", R"({"format": "terrawalk-output 1", "produ)");
    writeBytes(folder / "file", "x");
    fs::create_symlink("nowhere", folder / "dangling");
    const auto before = tree(folder.path());
    EXPECT_THAT(refusalOf(folder / "papers"), HasSubstr("\"thesis.tex\""));
    EXPECT_THAT(refusalOf(folder / "papers/"), HasSubstr("another folder"));
    EXPECT_THAT(refusalOf(folder / "other"), HasSubstr("\"manifest.json\""));
    EXPECT_THAT(refusalOf(folder / "broken"), HasSubstr("\"manifest.json\""));
    EXPECT_THAT(refusalOf(folder / "file"), HasSubstr("is a file"));
    EXPECT_THAT(refusalOf(folder / "dangling"), HasSubstr("leads nowhere"));
    EXPECT_THAT(refusalOf(folder / "dangling/"), HasSubstr("leads nowhere"));
    EXPECT_THAT(refusalOf(""), HasSubstr("no name"));
    EXPECT_THAT(refusalOf("/"), HasSubstr("root"));
    EXPECT_THAT(refusalOf("/.."), HasSubstr("root"));
    EXPECT_THAT(refusalOf("."), HasSubstr("current folder"));
    EXPECT_THAT(refusalOf(".."), HasSubstr("current folder"));
    EXPECT_THAT(refusalOf("/proc"), HasSubstr("mount point"));
    EXPECT_THAT(refusalOf(folder / "file/out", ErrorKind::System), HasSubstr("folder"));
    EXPECT_EQ(tree(folder.path()), before);
}

TEST(OutputFolder, RefusesATargetThatSomebodyFilledMeanwhile) {
    const TemporaryFolder folder;
    auto output = OutputFolder::create(folder / "out");
    ASSERT_TRUE(output && writeGeneration(*output, "one"));
    writeBytes(folder / "out/thesis.tex", "ten years");
    const auto committed = output->commit();
    ASSERT_FALSE(committed);
    EXPECT_EQ(committed.error().kind, ErrorKind::Usage);
    EXPECT_EQ(bytesOf(folder / "out/thesis.tex"), "ten years");
}

TEST(OutputFolder, ReplacesTheFolderBehindASymbolicLink) {
    const TemporaryFolder folder;
    ASSERT_TRUE(publish(folder / "disk/out", "one"));
    fs::create_directory_symlink("disk/out", folder / "link");
    ASSERT_TRUE(publish(folder / "link/", "two"));
    EXPECT_TRUE(fs::is_symlink(folder / "link"));
    EXPECT_EQ(wholeGeneration(folder / "disk/out"), "two");
}

TEST(OutputFolder, AnUnwritableParentIsASystemError) {
    // /proc takes no folders, not even from root.
    EXPECT_THAT(refusalOf("/proc/terrawalk/out", ErrorKind::System), HasSubstr("/proc/terrawalk"));
}

TEST(OutputFolder, ProductsStayInside) {
    const TemporaryFolder folder;
    auto output = OutputFolder::create(folder / "out");
    ASSERT_TRUE(output);
    for (const char* name : {"", ".", "..", "../x", "a/../../x", "/etc/x", "a/"}) {
        EXPECT_FALSE(output->pathFor(name)) << name;
    }
    EXPECT_TRUE(output->pathFor("a/b/c.csv"));
}

TEST(OutputFolder, RemovesRemainsOfKilledRunsButNotThoseOfLiveOnes) {
    const TemporaryFolder folder;
    writeBytes(folder / ".out.partial-123-0/product0", "dead");
    writeBytes(folder / ".out.partial-notes/mine", "of somebody else");
    writeBytes(folder / ".other.partial-123-0/product0", "another target");
    auto live = OutputFolder::create(folder / "out");
    ASSERT_TRUE(live && writeGeneration(*live, "live"));
    ASSERT_TRUE(publish(folder / "out", "one"));
    EXPECT_FALSE(fs::exists(folder / ".out.partial-123-0"));
    EXPECT_TRUE(fs::exists(folder / ".out.partial-notes/mine"));
    EXPECT_TRUE(fs::exists(folder / ".other.partial-123-0/product0"));
    ASSERT_TRUE(live->commit());
    EXPECT_EQ(wholeGeneration(folder / "out"), "live");
}

TEST(OutputFolder, PutsBackWhatARunKilledBetweenTwoRenamesPutAside) {
    const TemporaryFolder folder;
    ASSERT_TRUE(publish(folder / "out", "one"));
    fs::rename(folder / "out", folder / ".out.previous");
    { ASSERT_TRUE(OutputFolder::create(folder / "out")); }
    EXPECT_EQ(wholeGeneration(folder / "out"), "one");
    EXPECT_FALSE(fs::exists(folder / ".out.previous"));
}

TEST(OutputFolder, WorksWhereTheFileSystemCannotExchange) {
    const TemporaryFolder folder;
    ASSERT_TRUE(publish(folder / "out", "one"));
    writeBytes(folder / "out/notes.txt", "mine");
    const pid_t child = ::fork();
    if (child == 0) ::_exit(!forbidExchange() ? 77 : publish(folder / "out", "two") ? 0 : 1);
    const int status = statusOf(child);
    if (WIFEXITED(status) && WEXITSTATUS(status) == 77) GTEST_SKIP() << "no seccomp here";
    EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
    EXPECT_EQ(bytesOf(folder / "out/product0"), "two");
    EXPECT_EQ(bytesOf(folder / "out/notes.txt"), "mine");
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1);
}

/// In memory where there is such a place: a disk that really syncs makes many rounds slow.
fs::path quickPlace() {
    return fs::is_directory("/dev/shm") ? "/dev/shm" : fs::temp_directory_path();
}

/// Kills a run that publishes over and over, at other moments each time, and looks.
void survivesKills(bool exchange) {
    const TemporaryFolder folder(quickPlace());
    const fs::path target = folder / "out";
    const auto begin = std::chrono::steady_clock::now();
    for (int i = 0; i < 10; ++i) ASSERT_TRUE(publish(target, "first", 5));
    const double publish_us =
        std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - begin).count() / 10.0;
    std::set<std::string> seen;
    constexpr std::size_t kRounds = 200;
    for (std::size_t round = 0; round < kRounds; ++round) {
        std::array<int, 2> started{};
        ASSERT_EQ(::pipe(started.data()), 0);
        const pid_t child = ::fork();
        ASSERT_GE(child, 0);
        if (child == 0) {
            if (!exchange && !forbidExchange()) ::_exit(77);
            // Every other round is killed only after it has published once, however slow the machine.
            const auto ready_at = static_cast<int>(round % 2);
            for (int i = 0;; ++i) {
                if (i == ready_at && ::write(started[1], "x", 1) != 1) ::_exit(1);
                const std::string generation = std::to_string(round) + "/" + std::to_string(i);
                if (!publish(target, generation, 3 + (i % 3))) ::_exit(1);
            }
        }
        ::close(started[1]);
        char ready = 0;
        EXPECT_GE(::read(started[0], &ready, 1), 0);
        ::close(started[0]);
        // Spread over three publications; 37 and 200 have no common divisor.
        ::usleep(
            static_cast<useconds_t>(3.0 * publish_us * static_cast<double>(round * 37 % kRounds) / kRounds));
        ::kill(child, SIGKILL);
        const int status = statusOf(child);
        if (WIFEXITED(status) && WEXITSTATUS(status) == 77) GTEST_SKIP() << "no seccomp here";
        ASSERT_TRUE(WIFSIGNALED(status)) << "round " << round;
        if (!exchange) {
            // Between two renames the target is missing until the next run looks.
            ASSERT_TRUE(OutputFolder::create(target));
        }
        seen.insert(wholeGeneration(target));
        if (::testing::Test::HasFailure()) FAIL() << "round " << round;
    }
    // The kills fell into runs that did publish.
    EXPECT_GE(seen.size(), kRounds / 2);
    ASSERT_TRUE(publish(target, "last"));
    EXPECT_EQ(wholeGeneration(target), "last");
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1);
}

TEST(OutputFolder, AKillAtAnyMomentLeavesOneWholeGeneration) {
    survivesKills(true);
}

TEST(OutputFolder, AKillAtAnyMomentLeavesOneWholeGenerationWithoutExchangeToo) {
    survivesKills(false);
}

TEST(OutputFolder, RunsAtOnceNeverMixTheirProducts) {
    const TemporaryFolder folder(quickPlace());
    const fs::path target = folder / "out";
    std::vector<pid_t> children;
    for (int who = 0; who < 4; ++who) {
        const pid_t child = ::fork();
        ASSERT_GE(child, 0);
        if (child == 0) {
            for (int i = 0; i < 25; ++i) {
                if (!publish(target, std::to_string(who) + "/" + std::to_string(i), 2 + who)) ::_exit(1);
            }
            ::_exit(0);
        }
        children.push_back(child);
    }
    for (const pid_t child : children) {
        const int status = statusOf(child);
        EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
    }
    EXPECT_THAT(wholeGeneration(target), HasSubstr("/24"));
    EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1);
}

TEST(WriteTextFile, ReplacesWholeOrNotAtAll) {
    const TemporaryFolder folder;
    ASSERT_TRUE(writeTextFile("old", folder / "a.txt"));
    ASSERT_TRUE(writeTextFile("new", folder / "a.txt"));
    EXPECT_EQ(bytesOf(folder / "a.txt"), "new");
    fs::create_directory(folder / "folder");
    EXPECT_FALSE(writeTextFile("x", folder / "folder"));
    EXPECT_FALSE(writeTextFile("x", folder / "folder/"));
    const auto missing = writeTextFile("x", folder / "missing/a.txt");
    ASSERT_FALSE(missing);
    EXPECT_EQ(missing.error().kind, ErrorKind::System);
    EXPECT_THAT(tree(folder.path()), ElementsAre("a.txt", "folder"));
}

TEST(WriteTextFile, AFullDiskIsAnErrorAndTheOldFileStays) {
    const TemporaryFolder folder;
    ASSERT_TRUE(writeTextFile("old", folder / "a.txt"));
    const auto written = [&] {
        const test::FileSizeLimit full_disk(100000);
        return writeTextFile(std::string(3000000, 'x'), folder / "a.txt");
    }();
    ASSERT_FALSE(written);
    EXPECT_EQ(written.error().kind, ErrorKind::System);
    EXPECT_EQ(bytesOf(folder / "a.txt"), "old");
    EXPECT_THAT(tree(folder.path()), ElementsAre("a.txt"));
}

TEST(Sha256OfFile, GivesThePublishedValues) {
    const TemporaryFolder folder;
    writeBytes(folder / "empty", "");
    writeBytes(folder / "abc", "abc");
    writeBytes(folder / "million", std::string(1000000, 'a'));
    EXPECT_EQ(sha256OfFile(folder / "empty"),
              "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
    EXPECT_EQ(sha256OfFile(folder / "abc"),
              "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
    // FIPS 180-2, appendix B.3.
    EXPECT_EQ(sha256OfFile(folder / "million"),
              "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
    EXPECT_FALSE(sha256OfFile(folder / "missing"));
    EXPECT_FALSE(sha256OfFile(folder.path()));
}

}  // namespace
}  // namespace terrawalk
