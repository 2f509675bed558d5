#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "io/read_survey.hpp"
#include "io/survey_format.hpp"
#include "io/text_input.hpp"

namespace terrawalk {

namespace {

constexpr std::size_t kMostControlBytes = std::size_t{64} << 20U;
// The local frame is a plane that touches the earth; nobody walks further from its origin.
constexpr double kFarthest_m = 100e3;

enum ControlColumn : std::size_t { kPoint, kEast, kNorth, kUp, kSigmaH, kSigmaV, kRole };

class ControlMarksParser {
  public:
    explicit ControlMarksParser(const std::filesystem::path& file) : file_(file) {}

    Result<ControlMarkTable> parse(std::string_view bytes) {
        const std::string_view text = withoutByteOrderMark(bytes);
        const char* const end = text.data() + text.size();
        for (const char* at = text.data(); at != end;) {
            ++line_;
            const char* const line_end = findLineEnd(at, end);
            const std::string_view content = trimmed({at, static_cast<std::size_t>(line_end - at)});
            at = afterLineEnd(line_end, end);
            if (content.empty() || content.front() == '#') continue;
            if (auto taken = takeLine(content); !taken) return tl::unexpected(taken.error());
        }
        if (!has_header_) return bad("no header row", header_cure_);
        if (line_of_.empty()) return bad("no marks", "add the marks, or leave the file out of the project");
        return std::move(table_);
    }

  private:
    tl::unexpected<Error> bad(std::string message, std::string cure = {}) const {
        return badData(std::move(message), file_, line_, std::move(cure));
    }

    Result<void> takeLine(std::string_view line) {
        if (line.size() > kLongestLine)
            return bad(fmt::format("the line is longer than {} bytes", kLongestLine));
        if (line.find('\0') != std::string_view::npos || !isUtf8(line)) {
            return bad("the line is no UTF-8 text", "save the file as UTF-8 text");
        }
        const auto fields = splitCsvLine(line);
        if (!fields) return bad("a quotation mark is not closed");
        return std::exchange(has_header_, true) ? takeMark(*fields) : takeHeader(*fields);
    }

    Result<void> takeHeader(const std::vector<std::string>& names) {
        for (std::size_t i = 0; i < kControlColumns.size(); ++i) {
            const auto found = std::find(names.begin(), names.end(), kControlColumns[i]);
            if (found == names.end())
                return bad(fmt::format("no column {}", kControlColumns[i]), header_cure_);
            place_[i] = static_cast<std::size_t>(found - names.begin());
        }
        const std::set<std::string_view> known(kControlColumns.begin(), kControlColumns.end());
        std::set<std::string_view> met;
        for (const std::string& column : names) {
            if (!met.insert(column).second) {
                return bad(fmt::format("column {} stands twice", inQuotes(column)),
                           "each column needs its own name");
            }
            if (known.contains(column)) continue;
            table_.notes.push_back(
                noteAt(line_, fmt::format("unknown column {} is not used", inQuotes(column))));
        }
        columns_ = names.size();
        return {};
    }

    Result<void> takeMark(const std::vector<std::string>& fields) {
        if (fields.size() != columns_) {
            return bad(fmt::format("{} fields, but the header has {} columns", fields.size(), columns_),
                       "the decimal sign is a dot, and fields are parted by commas");
        }
        ControlMark mark;
        mark.name = fields[place_[kPoint]];
        if (mark.name.empty()) return bad("the mark has no name");
        std::array<double, 5> numbers{};
        for (std::size_t i = 0; i < numbers.size(); ++i) {
            const auto number = numberIn(fields, kEast + i);
            if (!number) return tl::unexpected(number.error());
            numbers[i] = *number;
        }
        mark.enu_m = {numbers[0], numbers[1], numbers[2]};
        mark.sigma_h_m = numbers[3];
        mark.sigma_v_m = numbers[4];
        const auto role = roleIn(fields);
        if (!role) return tl::unexpected(role.error());
        mark.role = *role;

        const auto [same, is_new] = line_of_.emplace(mark.name, line_);
        if (!is_new) {
            return bad(
                fmt::format("mark {} stands twice, first on line {}", inQuotes(mark.name), same->second),
                "keep one of the two rows");
        }
        if (mark.name == kZeroMark) return takeZero(mark);
        table_.marks.push_back(std::move(mark));
        return {};
    }

    // ZERO needs no row. One that says what is true anyway does no harm.
    Result<void> takeZero(const ControlMark& mark) {
        if (!mark.enu_m.isZero(0.0) || mark.role != MarkRole::Control) {
            return bad("ZERO is the zero point: (0, 0, 0) with role control", "give the mark another name");
        }
        table_.notes.push_back(noteAt(line_, "the row of ZERO is not used; it is always (0, 0, 0)"));
        return {};
    }

    Result<double> numberIn(const std::vector<std::string>& fields, std::size_t column) const {
        const std::string& text = fields[place_[column]];
        const auto number = parseNumber(text);
        if (!number) {
            return bad(
                fmt::format("column {}: {} is no finite number", kControlColumns[column], inQuotes(text)),
                "give metres with a decimal dot");
        }
        const bool is_sigma = column >= kSigmaH;
        if (is_sigma && *number < 0.0) {
            return bad(fmt::format("column {}: a sigma cannot be negative", kControlColumns[column]));
        }
        if (std::abs(*number) > kFarthest_m) {
            return bad(
                fmt::format("column {}: {} is more than 100 km", kControlColumns[column], inQuotes(text)),
                "give metres from the zero point in the local frame, not map coordinates");
        }
        return *number;
    }

    Result<MarkRole> roleIn(const std::vector<std::string>& fields) const {
        const std::string& text = fields[place_[kRole]];
        for (const MarkRole role : {MarkRole::Control, MarkRole::Check}) {
            if (text == name(role)) return role;
        }
        return bad(fmt::format("column role: {} is no role", inQuotes(text)), "write control or check");
    }

    const std::filesystem::path& file_;
    const std::string header_cure_ =
        fmt::format("the first row must name the columns {}", fmt::join(kControlColumns, ","));
    std::size_t line_ = 0;
    bool has_header_ = false;
    std::size_t columns_ = 0;
    std::array<std::size_t, kControlColumns.size()> place_{};
    std::map<std::string, std::size_t> line_of_;  // of each mark met so far
    ControlMarkTable table_;
};

}  // namespace

Result<ControlMarkTable> parseControlMarks(std::string_view bytes, const std::filesystem::path& file) {
    return ControlMarksParser(file).parse(bytes);
}

Result<ControlMarkTable> readControlMarks(const std::filesystem::path& file) {
    const auto text = readWholeFile(file, kMostControlBytes);
    if (!text) return tl::unexpected(text.error());
    return parseControlMarks(*text, file);
}

}  // namespace terrawalk
