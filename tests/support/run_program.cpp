#include "tests/support/run_program.hpp"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace terrawalk::test {

namespace {

std::string takeFile(const std::string& file) {
    std::ifstream stream(file, std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(stream), {}};
    std::filesystem::remove(file);
    return text;
}

std::string temporaryFile() {
    std::string name = (std::filesystem::temp_directory_path() / "terrawalk-test-XXXXXX").string();
    const int handle = mkstemp(name.data());
    if (handle < 0) throw std::runtime_error("no temporary file");
    close(handle);
    return name;
}

}  // namespace

ProgramOutcome runProgram(const std::vector<std::string>& command,
                          const std::function<void(pid_t)>& meanwhile) {
    const std::string out_file = temporaryFile();
    const std::string err_file = temporaryFile();
    std::vector<char*> arguments;
    for (const std::string& argument : command) arguments.push_back(const_cast<char*>(argument.c_str()));
    arguments.push_back(nullptr);

    const auto start = std::chrono::steady_clock::now();
    const pid_t child = fork();
    if (child < 0) throw std::runtime_error("cannot fork");
    if (child == 0) {
        unsetenv("DISPLAY");
        unsetenv("WAYLAND_DISPLAY");
        dup2(open("/dev/null", O_RDONLY), STDIN_FILENO);
        dup2(open(out_file.c_str(), O_WRONLY | O_TRUNC), STDOUT_FILENO);
        dup2(open(err_file.c_str(), O_WRONLY | O_TRUNC), STDERR_FILENO);
        execv(arguments[0], arguments.data());
        _exit(127);
    }
    if (meanwhile) meanwhile(child);
    int status = 0;
    rusage usage{};
    wait4(child, &status, 0, &usage);
    ProgramOutcome outcome;
    outcome.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (WIFEXITED(status)) outcome.exit_code = WEXITSTATUS(status);
    if (WIFSIGNALED(status)) outcome.signal = WTERMSIG(status);
    const auto secondsOf = [](const timeval& t) {
        return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    outcome.cpu_seconds = secondsOf(usage.ru_utime) + secondsOf(usage.ru_stime);
    outcome.peak_memory_kib = usage.ru_maxrss;
    outcome.out = takeFile(out_file);
    outcome.err = takeFile(err_file);
    return outcome;
}

}  // namespace terrawalk::test
