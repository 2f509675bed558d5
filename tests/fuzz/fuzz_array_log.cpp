// Whatever the bytes: no crash, and a log that is accepted keeps the promises of its type.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "io/read_survey.hpp"

namespace {

void require(bool promise) {
    if (!promise) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace terrawalk;
    SilentProgress progress;
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    const auto log = parseArrayLog(bytes, "fuzz.csv", progress, {});
    if (!log) {
        require(!log.error().text().empty());
        return 0;
    }
    const LogReadReport& report = log->read_report;
    require(log->size() > 0);
    require(report.rows_read ==
            log->size() + report.repeated_lines.size() + (report.cut_off_line > 0 ? std::size_t{1} : 0));
    for (std::size_t i = 0; i < log->size(); ++i) {
        require(std::isfinite(log->time_s[i]));
        require(i == 0 || log->time_s[i] > log->time_s[i - 1]);
        require(present(log->value(Channel::Latitude, i)) == present(log->value(Channel::Longitude, i)));
    }
    for (const std::vector<double>& channel : log->channels) {
        require(channel.empty() || channel.size() == log->size());
        for (const double value : channel) require(!std::isinf(value));
    }
    for (const AuxiliaryColumn& column : log->auxiliary) {
        require(column.values.size() == log->size());
        for (const double value : column.values) require(!std::isinf(value));
    }
    return 0;
}
