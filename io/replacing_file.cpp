#include "io/replacing_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>

#include <cerrno>
#include <system_error>

namespace terrawalk {

namespace {

constexpr std::size_t kBufferBytes = 1U << 20U;
constexpr int kMostTemporaries = 1000;

tl::unexpected<Error> writeFailed(int error, const std::filesystem::path& file) {
    return systemError("cannot write: " + std::generic_category().message(error), file);
}

}  // namespace

Result<ReplacingFile> ReplacingFile::create(const std::filesystem::path& target) {
    if (!target.has_filename()) return systemError("cannot write: this is a folder", target);
    std::error_code unknown;
    if (std::filesystem::is_directory(target, unknown)) {
        return systemError("cannot write: a folder of that name is in the way", target);
    }
    for (int attempt = 0; attempt < kMostTemporaries; ++attempt) {
        ReplacingFile file;
        std::filesystem::path temporary = target;
        temporary.replace_filename(
            fmt::format(".{}.partial-{}-{}", target.filename().string(), ::getpid(), attempt));
        file.handle_ = FileHandle(::open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
        if (file.handle_.isOpen()) {
            file.target_ = target;
            file.temporary_ = std::move(temporary);
            return file;
        }
        if (errno != EEXIST) return writeFailed(errno, target);
    }
    return writeFailed(EEXIST, target);
}

ReplacingFile::ReplacingFile(ReplacingFile&& other) noexcept
    : target_(std::move(other.target_)),
      temporary_(std::exchange(other.temporary_, {})),
      handle_(std::move(other.handle_)),
      buffer_(std::move(other.buffer_)) {}

ReplacingFile& ReplacingFile::operator=(ReplacingFile&& other) noexcept {
    std::swap(target_, other.target_);
    std::swap(temporary_, other.temporary_);
    std::swap(handle_, other.handle_);
    std::swap(buffer_, other.buffer_);
    return *this;
}

ReplacingFile::~ReplacingFile() {
    if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

Result<void> ReplacingFile::write(std::string_view bytes) {
    buffer_.append(bytes);
    return buffer_.size() < kBufferBytes ? Result<void>() : flush();
}

Result<void> ReplacingFile::flush() {
    std::string_view rest = buffer_;
    while (!rest.empty()) {
        const ssize_t written = ::write(handle_.get(), rest.data(), rest.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) return writeFailed(errno, target_);
        rest.remove_prefix(static_cast<std::size_t>(written));
    }
    buffer_.clear();
    return {};
}

Result<void> ReplacingFile::commit() {
    if (auto flushed = flush(); !flushed) return flushed;
    if (!handle_.close()) return writeFailed(errno, target_);
    if (std::rename(temporary_.c_str(), target_.c_str()) != 0) return writeFailed(errno, target_);
    temporary_.clear();
    return {};
}

}  // namespace terrawalk
