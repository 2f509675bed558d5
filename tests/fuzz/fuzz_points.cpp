// Whatever the bytes: no crash in any reader of points or of breaklines, and points that are accepted are
// finite. The first byte chooses the format.

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "io/read_breaklines.hpp"
#include "io/read_points.hpp"

namespace {

namespace fs = std::filesystem;

void require(bool promise) {
    if (!promise) std::abort();
}

/// The readers open files by their endings.
fs::path written(const std::uint8_t* data, std::size_t size, const std::string& ending) {
    static const fs::path folder = fs::temp_directory_path() / ("fuzz_points_" + std::to_string(::getpid()));
    fs::create_directories(folder);
    const fs::path file = folder / ("points" + ending);
    const int handle = ::open(file.c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0600);
    require(handle >= 0 && ::write(handle, data, size) == static_cast<ssize_t>(size));
    ::close(handle);
    return file;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace terrawalk;
    if (size == 0) return 0;
    static const std::array<std::string, 4> kEndings{".csv", ".las", ".ply", ".geojson"};
    const std::string& ending = kEndings[data[0] % kEndings.size()];
    const fs::path file = written(data + 1, size - 1, ending);
    SilentProgress progress;
    const auto points = readPoints(file, {}, progress, {});
    if (!points) {
        require(!points.error().text().empty());
    } else {
        require(!points->points.empty());
        require(points->sigmas.empty() || points->sigmas.size() == points->points.size());
        for (const Eigen::Vector3d& point : points->points) require(point.allFinite());
    }
    if (ending == ".geojson") {
        const auto lines = readBreaklines(file, progress, {});
        require(lines || !lines.error().text().empty());
    }
    return 0;
}
