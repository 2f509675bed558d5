#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <stop_token>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "io/plot.hpp"
#include "survey/progress.hpp"
#include "survey/result.hpp"

namespace terrawalk {

struct ExperimentOptions {
    bool quick =
        false;  ///< a small form of the same experiment, done in seconds; the notes say what is smaller
    std::uint64_t seed = 1;
    std::filesystem::path survey;  ///< folder or project file, for experiments on logs; empty: simulated
};

/// A cell of a table: empty, text or a number.
using Cell = std::variant<std::monostate, std::string, double>;

struct ExperimentTable {
    std::vector<std::string> columns;  ///< with units
    std::vector<std::vector<Cell>> rows;
};

/// What one experiment gives. Its figures are printed beside those of the paper where it has some.
struct ExperimentReport {
    std::string title;               ///< such as "Fig 8: initial populations"
    bool simulated = true;           ///< data come from a simulator; test functions are no data
    ExperimentTable summary;         ///< printed
    ExperimentTable data;            ///< the CSV file; the summary where it has no columns
    Plot plot;                       ///< title and note are filled in when it is drawn
    std::vector<std::string> notes;  ///< what was chosen, what the figures do not tell
};

/// Files that were written.
struct ExperimentFiles {
    std::filesystem::path csv;
    std::filesystem::path svg;
};

struct Experiment {
    std::string_view name;   ///< by which it is called: "fig8"
    std::string_view about;  ///< one line for the list
    Result<ExperimentReport> (*run)(const ExperimentOptions&, Progress&, std::stop_token);
    bool takes_survey = false;
};

/// All of them, in the order of the papers.
[[nodiscard]] std::span<const Experiment> experiments();

/// Runs the experiment and writes NAME.csv and NAME.svg into `output`, which is made where it is missing.
/// Usage for an unknown name. The same options give the same bytes on any number of threads, but for
/// measured times.
[[nodiscard]] Result<ExperimentReport> runExperiment(std::string_view name, const ExperimentOptions& options,
                                                     const std::filesystem::path& output, Progress& progress,
                                                     std::stop_token stop);

[[nodiscard]] ExperimentFiles experimentFiles(std::string_view name, const std::filesystem::path& output);

/// "simulated, seed 1", with what else holds for the run.
[[nodiscard]] std::string conditions(const ExperimentReport& report, const ExperimentOptions& options);

/// Numbers with four significant digits, columns aligned.
[[nodiscard]] std::string toText(const ExperimentTable& table);
/// A list of objects, one for each row.
[[nodiscard]] std::string toJson(const ExperimentTable& table);
/// The table with notes below.
[[nodiscard]] std::string toText(const ExperimentReport& report, const ExperimentOptions& options);
[[nodiscard]] std::string toJson(const ExperimentReport& report, const ExperimentOptions& options,
                                 const ExperimentFiles& files);
/// Numbers in the shortest form that reads back to the same bits.
[[nodiscard]] std::string toCsv(const ExperimentTable& table);

}  // namespace terrawalk
