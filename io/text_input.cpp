#include "io/text_input.hpp"

#include <fast_float/fast_float.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <system_error>
#include <utility>

namespace terrawalk {

namespace {

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
constexpr std::string_view kBlanks = " \t";

tl::unexpected<Error> cannotOpen(int error, const std::filesystem::path& file) {
    if (error == ENOENT || error == ENOTDIR) return badData("no such file", file);
    if (error == EACCES || error == EPERM) {
        return systemError("the file may not be read", file, "give this user the right to read it");
    }
    return systemError("cannot open: " + std::generic_category().message(error), file);
}

bool isUtf16(std::string_view text) {
    return text.starts_with("\xFF\xFE") || text.starts_with("\xFE\xFF");
}

// Whether the line end at `at` is whole, whatever byte of the text follows `end`.
bool endsLine(const char* at, const char* end) {
    return *at == '\n' || (*at == '\r' && at + 1 != end);
}

}  // namespace

Result<ReadableFile> ReadableFile::open(const std::filesystem::path& file) {
    ReadableFile input;
    input.file_ = file;
    // O_NONBLOCK: a named pipe without a writer would wait for ever.
    input.handle_ = FileHandle(::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC));
    if (!input.handle_.isOpen()) return cannotOpen(errno, file);
    struct stat status {};
    if (::fstat(input.handle_.get(), &status) != 0) return cannotOpen(errno, file);
    if (S_ISDIR(status.st_mode)) return badData("this is a folder", file, 0, "name a file in it");
    if (!S_ISREG(status.st_mode))
        return badData("this is no regular file", file, 0, "copy the data to a file");
    static_cast<void>(::posix_fadvise(input.handle_.get(), 0, 0, POSIX_FADV_SEQUENTIAL));
    input.size_ = static_cast<std::size_t>(status.st_size);
    return input;
}

Result<std::size_t> ReadableFile::read(char* buffer, std::size_t capacity) {
    std::size_t filled = 0;
    while (filled < capacity) {
        const ssize_t got = ::read(handle_.get(), buffer + filled, capacity - filled);
        if (got == 0) break;
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) return systemError("cannot read: " + std::generic_category().message(errno), file_);
        filled += static_cast<std::size_t>(got);
    }
    return filled;
}

Result<std::string> readWholeFile(const std::filesystem::path& file, std::size_t most_bytes) {
    auto input = ReadableFile::open(file);
    if (!input) return tl::unexpected(input.error());
    const auto tooLarge = [&] {
        return badData(fmt::format("the file is larger than {} MB", most_bytes >> 20U), file, 0,
                       "check that this is the right file");
    };
    if (input->size() > most_bytes) return tooLarge();
    // One byte more than it should have tells whether the file grew meanwhile.
    std::string text(input->size() + 1, '\0');
    const auto filled = input->read(text.data(), text.size());
    if (!filled) return tl::unexpected(filled.error());
    if (*filled == text.size()) return systemError("the file grows while it is read", file, "try again");
    text.resize(*filled);
    return text;
}

LineBlocks::LineBlocks(Source source, std::filesystem::path file)
    : source_(std::move(source)),
      file_(std::move(file)),
      buffer_(std::make_unique_for_overwrite<char[]>(kBlockBytes + 1)) {}

Result<LineBlock> LineBlocks::next(std::size_t first_line) {
    char* const begin = buffer_.get();
    std::memmove(begin, begin + taken_, filled_ - taken_);
    filled_ -= taken_;
    const std::size_t wanted = kBlockBytes - filled_;
    const auto got = source_(begin + filled_, wanted);
    if (!got) return tl::unexpected(got.error());
    filled_ += *got;
    LineBlock block{begin, begin + filled_, false, *got < wanted};

    if (std::exchange(first_, false)) {
        const std::string_view text(begin, filled_);
        if (isUtf16(text)) return badData("the text is UTF-16", file_, 1, "save it as UTF-8");
        block.begin += text.size() - withoutByteOrderMark(text).size();
    }
    const void* const nul = std::memchr(begin, '\0', filled_);
    if (nul != nullptr) {
        const std::size_t line = first_line + countLineEnds(block.begin, static_cast<const char*>(nul));
        return badData("NUL byte: this is no text, or the logger lost power while it wrote", file_, line,
                       "end the file with the last whole line before it");
    }
    if (!block.is_last) {
        while (block.end != block.begin && !endsLine(block.end - 1, begin + filled_)) --block.end;
        if (block.end == block.begin) {
            return badData(fmt::format("the line is longer than {} bytes", kLongestLine), file_, first_line,
                           "check that this is the right file");
        }
    } else if (block.end != block.begin && block.end[-1] != '\n' && block.end[-1] != '\r') {
        block.last_line_open = true;
    }
    if (block.is_last) begin[filled_] = '\n';
    taken_ = static_cast<std::size_t>(block.end - begin);
    return block;
}

const char* findLineEnd(const char* begin, const char* end) {
    return std::find_if(begin, end, [](char c) { return c == '\n' || c == '\r'; });
}

std::size_t countLineEnds(const char* begin, const char* end) {
    std::size_t count = 0;
    for (const char* at = findLineEnd(begin, end); at != end; at = findLineEnd(afterLineEnd(at, end), end))
        ++count;
    return count;
}

std::string_view withoutByteOrderMark(std::string_view text) {
    if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
    return text;
}

std::string_view trimmed(std::string_view text) {
    const std::size_t begin = text.find_first_not_of(kBlanks);
    if (begin == std::string_view::npos) return {};
    return text.substr(begin, text.find_last_not_of(kBlanks) + 1 - begin);
}

bool isUtf8(std::string_view text) {
    const auto byteAt = [&](std::size_t i) -> unsigned {
        return static_cast<unsigned char>(text[i]);
    };
    for (std::size_t i = 0; i < text.size();) {
        const unsigned lead = byteAt(i);
        const std::size_t length = lead < 0x80   ? 1
                                   : lead < 0xC2 ? 0
                                   : lead < 0xE0 ? 2
                                   : lead < 0xF0 ? 3
                                   : lead < 0xF5 ? 4
                                                 : 0;
        if (length == 0 || i + length > text.size()) return false;
        for (std::size_t k = 1; k < length; ++k) {
            if ((byteAt(i + k) & 0xC0U) != 0x80U) return false;
        }
        // Overlong forms, surrogates, and what lies beyond U+10FFFF.
        const unsigned second = length > 1 ? byteAt(i + 1) : 0;
        if ((lead == 0xE0 && second < 0xA0) || (lead == 0xED && second > 0x9F) ||
            (lead == 0xF0 && second < 0x90) || (lead == 0xF4 && second > 0x8F)) {
            return false;
        }
        i += length;
    }
    return true;
}

std::string inQuotes(std::string_view text) {
    constexpr std::size_t most = 40;
    if (text.size() <= most) return fmt::format("\"{}\"", text);
    std::size_t length = most;
    while (length > 0 && (static_cast<unsigned char>(text[length]) & 0xC0U) == 0x80U) --length;
    return fmt::format("\"{}...\"", text.substr(0, length > 0 ? length : most));
}

std::string noteAt(std::size_t line, const std::string& message) {
    Error note;
    note.message = fmt::format("line {}: {}", line, message);
    return note.text();
}

std::optional<double> parseNumber(std::string_view text, char decimal_sign) {
    if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
    double value = 0.0;
    const char* const end = text.data() + text.size();
    const fast_float::parse_options options(fast_float::chars_format::general, decimal_sign);
    const auto parsed = fast_float::from_chars_advanced(text.data(), end, value, options);
    if (parsed.ec != std::errc() || parsed.ptr != end || !std::isfinite(value)) return std::nullopt;
    return value;
}

CsvField readCsvField(const char* begin, const char* line_end) {
    const auto skipBlanks = [&](const char* at) {
        return std::find_if(at, line_end, [](char c) { return c != ' ' && c != '\t'; });
    };
    const char* at = skipBlanks(begin);
    if (at != line_end && *at == '"') {
        std::string text;
        for (const char* quote = at;;) {
            const char* const from = quote + 1;
            quote = std::find(from, line_end, '"');
            text.append(from, quote);
            if (quote == line_end) return {std::move(text), line_end, false};
            ++quote;
            if (quote == line_end || *quote != '"') {
                const char* const after = skipBlanks(quote);
                if (after == line_end || *after == ',') return {std::move(text), after};
                break;  // something follows the closing mark: no quoted field after all
            }
            text.push_back('"');
        }
    }
    const char* const end = std::find(at, line_end, ',');
    return {std::string(trimmed({at, static_cast<std::size_t>(end - at)})), end};
}

std::optional<std::vector<std::string>> splitCsvLine(std::string_view line) {
    const char* const end = line.data() + line.size();
    std::vector<std::string> fields;
    for (const char* at = line.data();;) {
        CsvField field = readCsvField(at, end);
        if (!field.is_whole) return std::nullopt;
        fields.push_back(std::move(field.text));
        if (field.end == end) return fields;
        at = field.end + 1;
    }
}

}  // namespace terrawalk
