#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "app/pipeline/tune.hpp"
#include "survey/result.hpp"

namespace terrawalk {

/// What makes two tunings the same.
struct TuneIdentity {
    std::string program;              ///< name and version
    std::uint64_t survey = 0;         ///< fingerprint of its data
    std::uint64_t configuration = 0;  ///< of all parameters
    std::string search;               ///< method, optimiser, budget, seed, in words
};

/// The file from which an interrupted tuning goes on. It holds losses, not candidates: these follow from the
/// seed, so that a resumed tuning asks for the same ones and ends with the same bits. Replaced in one step,
/// every few seconds and when the work stops. One call at a time.
class TuneCheckpoint {
  public:
    /// Nothing is written before the first losses. Errors: Usage where the file exists already, so that
    /// nobody's work is thrown away by a forgotten --resume.
    [[nodiscard]] static Result<TuneCheckpoint> begin(std::filesystem::path file, TuneIdentity identity);
    /// Errors: BadData for a file that is missing, damaged, or of another survey, configuration, search or
    /// program.
    [[nodiscard]] static Result<TuneCheckpoint> resume(std::filesystem::path file, TuneIdentity identity);

    [[nodiscard]] const std::filesystem::path& file() const { return file_; }
    [[nodiscard]] bool isEmpty() const;                             ///< no losses yet
    [[nodiscard]] const TuneRecord& read() const { return read_; }  ///< what was resumed from
    void onSearch(std::size_t search, std::uint64_t fingerprint);
    void onLosses(std::size_t search, std::size_t island, std::span<const double> losses);
    [[nodiscard]] Result<void> write();
    void remove();

  private:
    TuneCheckpoint(std::filesystem::path file, TuneIdentity identity);
    [[nodiscard]] std::string text() const;
    std::filesystem::path file_;
    TuneIdentity identity_;
    TuneRecord read_;
    TuneRecord record_;
    std::chrono::steady_clock::time_point last_written_;
};

}  // namespace terrawalk
