// Whatever the bytes: no crash, and a project that is accepted has runs that can name files.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "io/project_file.hpp"
#include "io/survey_format.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace terrawalk;
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    const auto project = parseProjectFile(bytes, "fuzz.json");
    if (!project) {
        if (project.error().text().empty() || project.error().line == 0) std::abort();
        return 0;
    }
    const std::vector<Run>& runs = project->survey.runs;
    if (runs.empty() || runs.size() != project->sources.size()) std::abort();
    for (std::size_t i = 0; i < runs.size(); ++i) {
        const bool complete = runs[i].kind == RunKind::Area || (runs[i].start && runs[i].target);
        if (!isSafeRunId(runs[i].id) || project->sources[i].log.empty() || !complete) std::abort();
        if (runs[i].stops.size() != project->sources[i].stop_lines.size()) std::abort();
    }
    return 0;
}
