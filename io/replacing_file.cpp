#include "io/replacing_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>

#include <cerrno>
#include <charconv>
#include <chrono>
#include <csignal>
#include <system_error>

namespace terrawalk {

namespace {

constexpr std::size_t kBufferBytes = 1U << 20U;
constexpr int kMostTemporaries = 1000;

tl::unexpected<Error> writeFailed(int error, const std::filesystem::path& file) {
    return systemError("cannot write: " + std::generic_category().message(error), file);
}

/// What a run that was killed left of this file, long enough ago that nobody can still be writing it.
void removeLeftOvers(const std::filesystem::path& target) {
    constexpr auto kLong = std::chrono::minutes(1);
    const std::string start = fmt::format(".{}.partial-", target.filename().string());
    const std::filesystem::path folder = target.has_parent_path() ? target.parent_path() : ".";
    std::error_code error;
    for (std::filesystem::directory_iterator entry(folder, error), end; !error && entry != end;
         entry.increment(error)) {
        const std::string name = entry->path().filename().string();
        if (!name.starts_with(start)) continue;
        pid_t writer = 0;
        const char* const digits = name.data() + start.size();
        const auto read = std::from_chars(digits, name.data() + name.size(), writer);
        if (read.ec != std::errc() || read.ptr == digits || *read.ptr != '-' || writer <= 0) continue;
        if (::kill(writer, 0) == 0 || errno != ESRCH) continue;
        std::error_code unknown;
        const auto written = std::filesystem::last_write_time(entry->path(), unknown);
        if (unknown || std::filesystem::file_time_type::clock::now() - written < kLong) continue;
        std::filesystem::remove(entry->path(), unknown);
    }
}

}  // namespace

Result<ReplacingFile> ReplacingFile::create(const std::filesystem::path& target) {
    if (!target.has_filename()) return systemError("cannot write: this is a folder", target);
    std::error_code unknown;
    if (std::filesystem::is_directory(target, unknown)) {
        return systemError("cannot write: a folder of that name is in the way", target);
    }
    removeLeftOvers(target);
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
