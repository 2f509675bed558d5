#pragma once

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/file_handle.hpp"
#include "survey/progress.hpp"
#include "survey/result.hpp"

namespace terrawalk {

/// A regular file, open for reading. Errors: BadData when there is no such file or when it is a folder or a
/// device, System when the machine refuses to open or to read it.
class ReadableFile {
  public:
    [[nodiscard]] static Result<ReadableFile> open(const std::filesystem::path& file);
    [[nodiscard]] std::size_t size() const { return size_; }
    /// Fills the buffer as far as the file reaches; returns the number of bytes.
    [[nodiscard]] Result<std::size_t> read(char* buffer, std::size_t capacity);

  private:
    std::filesystem::path file_;
    FileHandle handle_;
    std::size_t size_ = 0;
};

/// The whole text of a small file. BadData when it is larger than `most_bytes`.
[[nodiscard]] Result<std::string> readWholeFile(const std::filesystem::path& file, std::size_t most_bytes);

/// Longest line that a table may have.
inline constexpr std::size_t kLongestLine = std::size_t{64} << 10U;
inline constexpr std::size_t kBlockBytes = std::size_t{256} << 10U;

/// Some whole lines of a text. A line ends with LF, CR LF or CR.
struct LineBlock {
    const char* begin = nullptr;
    const char* end = nullptr;    ///< readable, and a line end when the last line has none of its own
    bool last_line_open = false;  ///< the text ends without a line end
    bool is_last = false;
};

/// Cuts a text of any length into blocks of whole lines; holds one block at a time.
class LineBlocks {
  public:
    /// Fills a buffer and returns the number of bytes; fewer than asked for only at the end of the text.
    using Source = std::function<Result<std::size_t>(char* buffer, std::size_t capacity)>;
    LineBlocks(Source source, std::filesystem::path file);

    /// The next block, valid until the next call. `first_line` is its line number, for errors: BadData for a
    /// NUL byte and for a line longer than a block. The first block starts after the byte-order mark, if
    /// there is one.
    [[nodiscard]] Result<LineBlock> next(std::size_t first_line);

  private:
    Source source_;
    std::filesystem::path file_;
    std::unique_ptr<char[]> buffer_;
    std::size_t filled_ = 0;  ///< bytes in the buffer
    std::size_t taken_ = 0;   ///< bytes of the last block
    bool first_ = true;
};

/// Feeds a parser block by block: Parser::nextLine(), take(block), and finish() after the last, which gives
/// the result. `bytes` of the text are for the progress alone.
template <class Parser>
auto parseLines(LineBlocks::Source source, const std::filesystem::path& file, std::size_t bytes,
                Parser& parser, Progress& progress, const std::stop_token& stop)
    -> decltype(parser.finish()) {
    const std::string step = "reading " + file.filename().string();
    LineBlocks blocks(std::move(source), file);
    std::size_t bytes_done = 0;
    for (;;) {
        if (stop.stop_requested()) return cancelled();
        const auto block = blocks.next(parser.nextLine());
        if (!block) return tl::unexpected(block.error());
        if (auto taken = parser.take(*block); !taken) return tl::unexpected(taken.error());
        bytes_done += static_cast<std::size_t>(block->end - block->begin);
        progress.report(std::min(1.0, static_cast<double>(bytes_done) /
                                          static_cast<double>(std::max(bytes, std::size_t{1}))),
                        step);
        if (block->is_last) return parser.finish();
    }
}

/// Where the line that starts at `begin` ends: at its line end or at `end`.
[[nodiscard]] const char* findLineEnd(const char* begin, const char* end);
/// Start of the next line, given a line end of this one.
[[nodiscard]] inline const char* afterLineEnd(const char* line_end, const char* end) {
    if (line_end == end) return end;
    return *line_end == '\r' && line_end + 1 != end && line_end[1] == '\n' ? line_end + 2 : line_end + 1;
}
[[nodiscard]] std::size_t countLineEnds(const char* begin, const char* end);

[[nodiscard]] std::string_view withoutByteOrderMark(std::string_view text);
[[nodiscard]] std::string_view trimmed(std::string_view text);  ///< without blanks and tabs at both ends
[[nodiscard]] bool isUtf8(std::string_view text);
/// In quotation marks, at most 40 bytes of it: for error messages.
[[nodiscard]] std::string inQuotes(std::string_view text);

/// "line 12: message" for the notes of a report; bytes that a terminal cannot show are written as escapes.
[[nodiscard]] std::string noteAt(std::size_t line, const std::string& message);

/// The whole text as a number: finite, decimal. Never depends on the locale.
[[nodiscard]] std::optional<double> parseNumber(std::string_view text, char decimal_sign = '.');

/// One field of a table with commas. Blanks round it do not count; a field in quotation marks may hold
/// commas.
struct CsvField {
    std::string text;
    const char* end = nullptr;  ///< the comma after it, or the end of the line
    bool is_whole = true;       ///< false when its closing quotation mark is missing
};
[[nodiscard]] CsvField readCsvField(const char* begin, const char* line_end);
/// All fields of a line; nothing when a closing quotation mark is missing.
[[nodiscard]] std::optional<std::vector<std::string>> splitCsvLine(std::string_view line);

}  // namespace terrawalk
