#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "io/file_handle.hpp"
#include "survey/result.hpp"

namespace terrawalk {

/// What every output folder holds: a JSON object with "format", its kind, and "products", the relative
/// paths of the files in it that Terrawalk wrote.
inline constexpr std::string_view kManifestName = "manifest.json";
inline constexpr std::string_view kOutputFormat = "terrawalk-output 1";          ///< products of a survey
inline constexpr std::string_view kSimulationFormat = "terrawalk-simulation 1";  ///< a simulated survey

/// A folder of products that appears whole or not at all. Files are written to a hidden folder beside the
/// target; `commit` swaps the two in one step, so a run killed at any moment leaves the previous products
/// whole. Without commit the destructor removes what was written. Where the file system cannot swap two
/// folders, commit renames twice; a run killed between the two leaves the previous products beside the
/// target, and the next `create` puts them back.
///
/// A target that exists must be empty or an earlier output of the same kind, so that products never replace
/// the survey they come from; files of others in an earlier output are carried over, but for the side files
/// (.aux.xml, .ovr, .msk, .tfw) of rasters that are replaced. Remains of killed runs are removed by the next
/// one. Two runs may write to one target at once: each commits whole, the later one stays. Errors: Usage for
/// a target that holds something else, System when the disk refuses.
class OutputFolder {
  public:
    [[nodiscard]] static Result<OutputFolder> create(const std::filesystem::path& target,
                                                     std::string_view format = kOutputFormat);
    OutputFolder(OutputFolder&& other) noexcept;
    OutputFolder& operator=(OutputFolder&& other) noexcept;
    ~OutputFolder();

    /// Where a product is to be written now; folders on the way are made.
    [[nodiscard]] Result<std::filesystem::path> pathFor(const std::filesystem::path& relative);
    /// To be called once, with all files closed and manifest.json among them. An error that says that the new
    /// products are in place tells of remains that could not be removed; after any other error the target is
    /// as it was.
    [[nodiscard]] Result<void> commit();

  private:
    OutputFolder() = default;
    [[nodiscard]] Result<void> swapIn();
    void discard() noexcept;
    std::filesystem::path target_;
    std::string format_;
    std::filesystem::path staging_;                    ///< empty once there is nothing to remove
    std::vector<std::filesystem::path> made_parents_;  ///< innermost first
    FileHandle lock_;  ///< held on the staging folder, so that a second run sees that this one is alive
};

/// SHA-256 of a file as 64 hexadecimal digits.
[[nodiscard]] Result<std::string> sha256OfFile(const std::filesystem::path& file);

/// Writes text beside the target and renames it into place.
[[nodiscard]] Result<void> writeTextFile(const std::string& text, const std::filesystem::path& file);

}  // namespace terrawalk
