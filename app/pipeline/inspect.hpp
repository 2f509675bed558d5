#pragma once

#include <optional>
#include <string>
#include <vector>

#include "survey/survey.hpp"
#include "survey/survey_report.hpp"

namespace terrawalk {

/// One sensor of a log as it really came.
struct SensorSummary {
    std::string sensor;
    std::vector<std::string> columns;  ///< the ones that the log has
    std::size_t epochs = 0;            ///< with a value in its first column
    double rate_hz = 0.0;              ///< 1 / median step between its epochs; 0 below two epochs
    double longest_gap_s = 0.0;
    double least = 0.0;  ///< of the first column, in the file's unit
    double greatest = 0.0;
};

struct LogSummary {
    std::string run_id;  ///< empty for a single log
    std::string file;
    std::string device;
    std::string start_utc;
    std::size_t epochs = 0;
    double duration_s = 0.0;
    double interval_s = 0.0;  ///< median step between epochs
    std::size_t gaps = 0;     ///< steps of more than 2.5 intervals
    double longest_gap_s = 0.0;
    std::vector<SensorSummary> sensors;
    std::vector<CountedReason> fixes;
    std::vector<std::string> missing;  ///< sensors that the log does not have
    std::vector<std::string> auxiliary;
    LogReadReport read_report;
};

/// Looks at a log without judging it. Pure.
[[nodiscard]] LogSummary inspectLog(const ArrayLog& log, std::string run_id);

/// Epochs by GNSS fix, in the order of the codes; "no code" where the log has positions but no fix column.
[[nodiscard]] std::vector<CountedReason> fixShares(const ArrayLog& log);

[[nodiscard]] std::string toText(const LogSummary& summary);
[[nodiscard]] std::string toJson(const std::vector<LogSummary>& summaries);

}  // namespace terrawalk
