#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "io/file_handle.hpp"
#include "survey/result.hpp"

namespace terrawalk {

/// A file that replaces another in one step: written beside the target, renamed over it by `commit`, removed
/// by the destructor without commit. What a run that was killed left of the target's own a minute ago or more
/// is removed first. Not thread-safe. Errors: System.
class ReplacingFile {
  public:
    [[nodiscard]] static Result<ReplacingFile> create(const std::filesystem::path& target);
    ReplacingFile(ReplacingFile&& other) noexcept;
    ReplacingFile& operator=(ReplacingFile&& other) noexcept;
    ~ReplacingFile();

    /// Buffered.
    [[nodiscard]] Result<void> write(std::string_view bytes);
    /// Where the new content lies until commit, for libraries that write files themselves.
    [[nodiscard]] const std::filesystem::path& temporary() const { return temporary_; }
    [[nodiscard]] Result<void> commit();

  private:
    ReplacingFile() = default;
    [[nodiscard]] Result<void> flush();
    std::filesystem::path target_;
    std::filesystem::path temporary_;  ///< empty once there is nothing to remove
    FileHandle handle_;
    std::string buffer_;
};

}  // namespace terrawalk
