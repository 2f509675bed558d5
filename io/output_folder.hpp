#pragma once

#include <filesystem>
#include <string>

#include "survey/result.hpp"

namespace terrawalk {

/// A folder of products that appears whole or not at all. Files are written to a hidden folder beside the target;
/// `commit` swaps the two in one step, so a run killed at any moment leaves the previous products whole. Without
/// commit the destructor removes what was written.
///
/// A target that exists must be empty or an earlier output (it holds manifest.json with Terrawalk's format key);
/// files of others in an earlier output are carried over, but for the side files (.aux.xml, .ovr, .msk, .tfw) of
/// rasters that are replaced. Remains of killed runs are removed by the next one. Errors: Usage for a target that
/// holds something else, System when the disk refuses.
class OutputFolder {
  public:
    [[nodiscard]] static Result<OutputFolder> create(const std::filesystem::path& target);
    OutputFolder(OutputFolder&&) noexcept;
    OutputFolder& operator=(OutputFolder&&) noexcept;
    ~OutputFolder();

    /// Where a product is to be written now; folders on the way are made.
    [[nodiscard]] Result<std::filesystem::path> pathFor(const std::filesystem::path& relative);
    [[nodiscard]] Result<void> commit();

  private:
    OutputFolder() = default;
    void discard() noexcept;
    std::filesystem::path target_;
    std::filesystem::path staging_;
    int lock_ = -1;  ///< held on the staging folder, so that a second run sees that this one is alive
};

/// SHA-256 of a file as 64 hexadecimal digits.
[[nodiscard]] Result<std::string> sha256OfFile(const std::filesystem::path& file);

/// Writes text beside the target and renames it into place.
[[nodiscard]] Result<void> writeTextFile(const std::string& text, const std::filesystem::path& file);

}  // namespace terrawalk
