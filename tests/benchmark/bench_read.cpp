// Reads one generated array log with the program's reader and with a plain reader on std::from_chars, both
// warm from the page cache, and prints what each takes in CPU seconds (user and system, all threads).
//
//     bench_read [megabytes = 500] [repeats = 5]

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "io/read_survey.hpp"
#include "survey/array_log.hpp"

namespace {

using namespace terrawalk;

double cpuSeconds() {
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    const auto seconds = [](const timeval& t) {
        return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
    };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

/// All columns, GNSS and barometer in every second epoch, digits that vary.
bool writeLog(const std::filesystem::path& file, std::size_t bytes) {
    std::FILE* const out = std::fopen(file.c_str(), "w");
    if (out == nullptr) return false;
    std::string text = "# format: array-log 1\n# device: generated\ntime_s";
    for (const ChannelInfo& channel : kChannels) text += fmt::format(",{}", channel.column);
    text += '\n';
    std::size_t written = 0;
    bool good = true;
    for (std::size_t i = 0; written < bytes && good; ++i) {
        const double t = 0.01 * static_cast<double>(i);
        const double a = std::sin(0.7 * t);
        const double b = std::cos(1.3 * t);
        text += fmt::format("{:.3f},", t);
        if (i % 2 == 0) {
            text += fmt::format("{:.9f},{:.9f},{:.3f},4,{:.3f},{:.3f},{:.4f},{:.4f},{:.4f},{:.2f},{:.2f},",
                                23.18 + 1e-3 * a, 113.4 + 1e-3 * b, 38.0 + a, 0.012 + 0.001 * a,
                                0.02 + 0.001 * b, a, b, 0.1 * a, 101325.0 + 30.0 * b, 27.5 + a);
        } else {
            text += ",,,,,,,,,,,";
        }
        text += fmt::format(
            "{:.4f},{:.4f},{},{:.3f},{:.3f},{:.3f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.3f},{}\n", a,
            b, static_cast<int>(200.0 + 50.0 * a), 5.0 * a, 5.0 * b, 180.0 + 170.0 * a, a, b, 9.8 + 0.2 * a,
            20.0 * b, 20.0 * a, 90.0 * b, 1.4 + 0.2 * a, static_cast<int>(900.0 + 300.0 * b));
        if (text.size() > (1U << 20U) || written + text.size() >= bytes) {
            good = std::fwrite(text.data(), 1, text.size(), out) == text.size();
            written += text.size();
            text.clear();
        }
    }
    return std::fclose(out) == 0 && good;
}

using Columns = std::vector<std::vector<double>>;

/// What one writes in an afternoon: the file into memory, lines by memchr, fields by std::from_chars. No
/// checks.
Columns readPlainly(const std::filesystem::path& file) {
    std::string bytes(std::filesystem::file_size(file), '\0');
    std::FILE* const in = std::fopen(file.c_str(), "r");
    if (in == nullptr || std::fread(bytes.data(), 1, bytes.size(), in) != bytes.size()) std::exit(1);
    std::fclose(in);
    Columns columns(1 + kChannelCount);
    const char* at = bytes.data();
    const char* const end = at + bytes.size();
    for (int skipped = 0; skipped < 3; ++skipped) at = std::find(at, end, '\n') + 1;
    while (at < end) {
        const auto length = static_cast<std::size_t>(end - at);
        const char* const line_end = static_cast<const char*>(std::memchr(at, '\n', length));
        for (std::size_t c = 0; c < columns.size(); ++c) {
            double value = kMissing;
            const auto parsed = std::from_chars(at, line_end, value);
            const double factor = c == 0 ? 1.0 : kChannels[c - 1].unit_factor;
            columns[c].push_back(value * factor);
            at = parsed.ptr + 1;
        }
    }
    return columns;
}

Columns readWithTerrawalk(const std::filesystem::path& file) {
    SilentProgress progress;
    auto log = readArrayLog(file, progress, {});
    if (!log) {
        fmt::print(stderr, "{}\n", log.error().text());
        std::exit(1);
    }
    Columns columns{std::move(log->time_s)};
    for (std::vector<double>& channel : log->channels) columns.push_back(std::move(channel));
    return columns;
}

/// Bit by bit, so that missing values count.
bool same(const Columns& a, const Columns& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const auto& x, const auto& y) {
        return x.size() == y.size() && std::equal(x.begin(), x.end(), y.begin(), [](double u, double v) {
                   return u == v || (std::isnan(u) && std::isnan(v));
               });
    });
}

struct Timing {
    std::string_view name;
    std::function<Columns(const std::filesystem::path&)> read;
    std::vector<double> seconds;
};

}  // namespace

int main(int argc, char** argv) {
    const auto argument = [&](int i, std::size_t otherwise) {
        std::size_t value = otherwise;
        if (argc > i) std::from_chars(argv[i], argv[i] + std::strlen(argv[i]), value);
        return value;
    };
    const std::size_t megabytes = argument(1, 500);
    const std::size_t repeats = std::max<std::size_t>(1, argument(2, 5));
    const std::filesystem::path file =
        std::filesystem::temp_directory_path() / fmt::format("terrawalk_bench_read_{}.csv", ::getpid());
    struct Remover {
        const std::filesystem::path& file;
        ~Remover() { std::filesystem::remove(file); }
    } const remover{file};
    if (!writeLog(file, megabytes * 1'000'000)) {
        fmt::print(stderr, "cannot write {}\n", file.string());
        return 1;
    }

    if (!same(readPlainly(file), readWithTerrawalk(file))) {  // and warms up
        fmt::print(stderr, "the readers differ\n");
        return 1;
    }
    std::vector<Timing> timings{{"std::from_chars, no checks", readPlainly, {}},
                                {"terrawalk::readArrayLog", readWithTerrawalk, {}}};
    for (std::size_t i = 0; i < repeats; ++i) {
        for (Timing& timing : timings) {
            const double before = cpuSeconds();
            const Columns columns = timing.read(file);
            timing.seconds.push_back(cpuSeconds() - before);
        }
    }
    fmt::print("Array log of {} MB, {} repeats in turns, CPU seconds\n\n", megabytes, repeats);
    fmt::print("{:<28} {:>8} {:>8} {:>8} {:>8}\n", "reader", "median", "least", "most", "MB/s");
    for (Timing& timing : timings) {
        std::sort(timing.seconds.begin(), timing.seconds.end());
        const double median = timing.seconds[timing.seconds.size() / 2];
        fmt::print("{:<28} {:>8.3f} {:>8.3f} {:>8.3f} {:>8.0f}\n", timing.name, median,
                   timing.seconds.front(), timing.seconds.back(), static_cast<double>(megabytes) / median);
    }
    return 0;
}
