#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "io/point_readers.hpp"
#include "io/short_decimal.hpp"
#include "io/text_input.hpp"

namespace terrawalk {
namespace {

constexpr const char* kHeaderCure =
    "name the columns x, y and z, each with _m or _ft where its unit is to be known";

constexpr const char* kNumberCure = "write numbers with a dot as decimal sign and nothing between thousands";
constexpr const char* kCommaCure =
    "write numbers with a dot as decimal sign and nothing between thousands, or part the columns with "
    "semicolons";

bool isDegrees(std::string_view name) {
    const std::string_view start = name.substr(0, 3);
    return start == "lon" || start == "lat" || start == "Lon" || start == "Lat";
}

/// Maybe empty, and of nothing but what numbers are written with.
bool isOfNumbers(std::string_view field) {
    return field.find_first_not_of("+-0123456789.,' ") == std::string_view::npos;
}

bool isWhole(std::string_view field) {
    return std::all_of(field.begin(), field.end(), [](char c) { return c >= '0' && c <= '9'; });
}

/// "1,234", which is another number to a reader for whom the comma parts thousands.
bool couldPartThousands(std::string_view number) {
    const std::size_t first = number.find_first_of("0123456789"), comma = number.find(',');
    return first < comma && comma - first <= 3 && number[first] != '0' && number.size() - comma == 4 &&
           isWhole(number.substr(comma + 1));
}

/// Characters of CJK Unified Ideographs up to U+9FFF; in UTF-8 they begin with E4 to E9.
bool isChinese(std::string_view name) {
    return std::any_of(name.begin(), name.end(), [](char c) { return c >= '\xE4' && c <= '\xE9'; });
}

/// Whether east and north would fit the plane CRS of China the other way about: north from the equator is
/// 2000 to 6000 km there, east has 6 digits, or 8 with the zone's number.
bool liesInChinaTurned(const Eigen::Vector3d& point) {
    const auto isNorth = [](double value) {
        return value > 1.8e6 && value < 6.2e6;
    };
    return isNorth(point.x()) && !isNorth(point.y());
}

class PointTableParser {
  public:
    PointTableParser(const std::filesystem::path& file, std::size_t bytes) : file_(file), bytes_(bytes) {}

    [[nodiscard]] std::size_t nextLine() const { return line_ + 1; }

    Result<void> take(const LineBlock& block) {
        for (const char* at = block.begin; at != block.end;) {
            ++line_;
            if (const char* const next = takePlainLine(at, block.end); next != nullptr) {
                at = next;
                continue;
            }
            const char* const line_end = findLineEnd(at, block.end);
            const std::string_view line = trimmed({at, static_cast<std::size_t>(line_end - at)});
            at = afterLineEnd(line_end, block.end);
            if (line.empty() || line.front() == '#') continue;
            if (auto taken = takeLine(line); !taken) return taken;
        }
        if (!std::exchange(room_made_, true)) reserveAsIn(block);
        return {};
    }

    Result<ScatteredPoints> finish() {
        if (comma_line_ > 0 && !comma_is_decimal_) {
            line_ = comma_line_;
            return bad("the commas in all numbers could be decimal signs or part thousands", kNumberCure);
        }
        if (comma_line_ > 0) points_.notes.emplace_back("numbers are read with the comma as decimal sign");
        if (chinese_axes_) {
            if (!points_.points.empty() && liesInChinaTurned(points_.points.front())) {
                return badData("the header is Chinese, but by the numbers X is east and Y is north", file_, 0,
                               "name the columns \u4e1c\u5750\u6807 and \u5317\u5750\u6807, or e and n");
            }
            points_.notes.emplace_back("the header is Chinese: X is taken for north and Y for east");
        }
        leaveOutUnused(points_, left_out_);
        return std::move(points_);
    }

  private:
    tl::unexpected<Error> bad(std::string message, std::string cure = {}) const {
        return badData(std::move(message), file_, line_, std::move(cure));
    }

    /// Room for as many points as the file has when all of it is like the first block.
    void reserveAsIn(const LineBlock& block) {
        if (block.begin == block.end) return;
        const double blocks = static_cast<double>(bytes_) / static_cast<double>(block.end - block.begin);
        const auto expected =
            static_cast<std::size_t>(1.01 * blocks * static_cast<double>(points_.points.size()));
        points_.points.reserve(expected);
        if (place_[3]) points_.sigmas.reserve(expected);
    }

    /// Nearly all lines are of one form: no blanks, no quotation marks, short decimals. Takes such a line and
    /// returns where the next one begins; null when the line is of another form, which takeLine() looks at.
    const char* takePlainLine(const char* at, const char* end) {
        if (roles_.empty() || *at == '#' || *at == ' ' || *at == '\t') return nullptr;
        std::array<double, kRoles> numbers{};
        for (std::size_t field = 0; field < roles_.size(); ++field) {
            if (field > 0 && *at++ != separator_) return nullptr;
            if (roles_[field] != kNoRole) {
                at = readShortDecimal(at, numbers[roles_[field]]);
                if (at == nullptr) return nullptr;
            } else {
                at = std::find_if(at, end,
                                  [this](char c) { return c == separator_ || c == '\n' || c == '\r'; });
                if (at == end) return nullptr;
            }
        }
        if (*at != separator_ && *at != '\n' && *at != '\r') return nullptr;
        const char* const line_end = findLineEnd(at, end);
        if (roles_.size() + static_cast<std::size_t>(std::count(at, line_end, separator_)) > columns_) {
            return nullptr;
        }
        if (numbers[3] < 0.0 || (place_[4] && numbers[4] == 0.0)) return nullptr;
        points_.points.emplace_back(numbers[0], numbers[1], numbers[2]);
        if (place_[3]) points_.sigmas.push_back(numbers[3]);
        return afterLineEnd(line_end, end);
    }

    /// What takePlainLine() looks for, column by column.
    void setRoles() {
        if (separator_ == ' ') return;
        roles_.assign(fields_wanted_, kNoRole);
        for (std::size_t k = 0; k < place_.size(); ++k) {
            if (place_[k]) roles_[*place_[k]] = k;
        }
    }

    Result<void> takeLine(std::string_view line) {
        if (fields_wanted_ == 0) {
            if (auto header = takeHeader(line); !header) return header;
            if (has_header_) return {};
        }
        split(line);
        // A remark may hold separators; numbers beyond the header were numbers with commas.
        if (has_header_ && fields_.size() > columns_ && parseNumber(fields_[columns_])) {
            return bad(fmt::format("{} fields under a header of {}", fields_.size(), columns_),
                       separator_ == ',' ? kCommaCure : kNumberCure);
        }
        if (fields_.size() < fields_wanted_) {
            return bad(fmt::format("{} fields, but column {} is needed", fields_.size(), fields_wanted_),
                       "one line for each point, with a dot as decimal sign");
        }
        if (place_[4] && fields_[*place_[4]] == "0") {
            ++left_out_;
            return {};
        }
        std::array<double, kRoles> numbers{};
        for (std::size_t k = 0; k < 4; ++k) {
            if (!place_[k]) continue;
            const std::string_view field = fields_[*place_[k]];
            const auto number = numberIn(field);
            if (!number) {
                return bad(fmt::format("{} in column {} is no number", inQuotes(field), *place_[k] + 1),
                           !field.empty() && isOfNumbers(field) ? kNumberCure : "");
            }
            numbers[k] = *number;
        }
        if (comma_line_ > 0 && dot_seen_) {
            return bad("some numbers have a comma and some a dot as decimal sign", kNumberCure);
        }
        points_.points.emplace_back(numbers[0], numbers[1], numbers[2]);
        if (place_[3]) {
            if (numbers[3] < 0.0) return bad("a sigma below zero");
            points_.sigmas.push_back(numbers[3]);
        }
        return {};
    }

    /// With a dot or, where commas do not part the columns, with a comma as decimal sign; finish() and
    /// takeLine() hold all lines to one of them.
    std::optional<double> numberIn(std::string_view field) {
        const bool has_comma = separator_ != ',' && field.find(',') != std::string_view::npos;
        const auto number = parseNumber(field, has_comma ? ',' : '.');
        if (!number) return std::nullopt;
        if (!has_comma) {
            dot_seen_ = dot_seen_ || field.find('.') != std::string_view::npos;
            return number;
        }
        comma_is_decimal_ = comma_is_decimal_ || !couldPartThousands(field);
        if (comma_line_ == 0) {
            comma_line_ = line_;
            roles_.clear();  // plain lines have dots; those before this line are looked at by their values
            dot_seen_ = dot_seen_ ||
                        std::any_of(points_.points.begin(), points_.points.end(),
                                    [](const Eigen::Vector3d& p) { return p != p.array().floor().matrix(); });
        }
        return number;
    }

    /// The first line that counts: names, or already a point.
    Result<void> takeHeader(std::string_view line) {
        // A comma may stand in a number.
        separator_ = line.find(';') != std::string_view::npos    ? ';'
                     : line.find('\t') != std::string_view::npos ? '\t'
                     : line.find(',') != std::string_view::npos  ? ','
                                                                 : ' ';
        split(line);
        columns_ = fields_.size();
        const auto isNumber = [this](std::string_view field) {
            return parseNumber(field) || (separator_ != ',' && parseNumber(field, ','));
        };
        if (fields_.size() >= 3 && isNumber(fields_[0]) && isNumber(fields_[1])) {
            if (fields_.size() > 3 && isWhole(fields_[0]) && fields_[0].size() <= 6 && !isWhole(fields_[1])) {
                return bad(
                    fmt::format("{} looks like the number of a point, not like x", inQuotes(fields_[0])),
                    "put a header above the table, e.g. number,n,e,z");
            }
            if (separator_ == ',' && fields_.size() >= 6 &&
                std::all_of(fields_.begin(), fields_.begin() + 6, isWhole)) {
                return bad("these columns could be numbers with a comma as decimal sign",
                           "put a header above the table, and write numbers with a dot");
            }
            place_ = {0, 1, 2, std::nullopt, std::nullopt};
            fields_wanted_ = 3;
            points_.notes.emplace_back(
                "the table has no header: its first three columns are taken for x, y and z");
            setRoles();
            return {};
        }
        if (std::all_of(fields_.begin(), fields_.end(), isOfNumbers)) {
            return bad("the first line names no columns, and does not begin with two numbers",
                       "put a header above the table, e.g. number,n,e,z; write numbers with a dot as decimal "
                       "sign");
        }
        if (!isUtf8(line)) return bad("the header is not UTF-8", "save the table as UTF-8");
        has_header_ = true;
        for (std::size_t i = 0; i < fields_.size(); ++i) {
            const auto named = namedColumn(fields_[i]);
            if (!named) continue;
            std::optional<std::size_t>& place = place_[static_cast<std::size_t>(named->column)];
            if (place) {
                return bad(fmt::format("columns {} and {} both could be the same coordinate",
                                       inQuotes(fields_[*place]), inQuotes(fields_[i])),
                           kHeaderCure);
            }
            place = i;
            fields_wanted_ = std::max(fields_wanted_, i + 1);
            if (named->unit && points_.unit && *named->unit != *points_.unit) {
                return bad("the columns have different units", "convert them to one");
            }
            if (named->unit) points_.unit = named->unit;
        }
        if (!place_[0] || !place_[1] || !place_[2]) {
            const bool degrees = std::any_of(fields_.begin(), fields_.end(), isDegrees);
            return bad(
                degrees ? "the points are in degrees" : "the header names no x, y and z",
                degrees ? "project them to metres first, e.g. with QGIS or ogr2ogr -t_srs" : kHeaderCure);
        }
        followChineseAxes();
        setRoles();
        return {};
    }

    /// Surveys in China count X to the north and Y to the east.
    void followChineseAxes() {
        const auto named = [this](std::size_t axis, char lower, char upper) {
            const std::string_view name = fields_[*place_[axis]];
            return name.find(lower) != std::string_view::npos || name.find(upper) != std::string_view::npos;
        };
        if (!std::any_of(fields_.begin(), fields_.end(), isChinese) || !named(0, 'x', 'X') ||
            !named(1, 'y', 'Y')) {
            return;
        }
        std::swap(place_[0], place_[1]);
        chinese_axes_ = true;
    }

    void split(std::string_view line) {
        fields_.clear();
        for (std::size_t begin = 0; begin <= line.size();) {
            const std::size_t end =
                std::min(separator_ == ' ' ? line.find_first_of(" \t", begin) : line.find(separator_, begin),
                         line.size());
            std::string_view field = trimmed(line.substr(begin, end - begin));
            if (field.size() >= 2 && field.front() == '"' && field.back() == '"') {
                field = field.substr(1, field.size() - 2);
            }
            if (separator_ != ' ' || !field.empty()) fields_.push_back(field);
            begin = end + 1;
        }
    }

    std::filesystem::path file_;
    std::size_t bytes_;
    bool room_made_ = false;
    ScatteredPoints points_;
    std::array<std::optional<std::size_t>, 5> place_{};  ///< by PointColumn
    static constexpr std::size_t kRoles = 5, kNoRole = kRoles;
    std::size_t left_out_ = 0;
    std::vector<std::size_t> roles_;  ///< by column, as far as one is needed: which number, or none
    std::vector<std::string_view> fields_;
    std::size_t fields_wanted_ = 0;
    std::size_t columns_ = 0;  ///< of the first line
    std::size_t line_ = 0;
    char separator_ = ',';
    std::size_t comma_line_ = 0;     ///< of the first number with a comma, 0: none
    bool comma_is_decimal_ = false;  ///< since one cannot part thousands
    bool dot_seen_ = false;
    bool chinese_axes_ = false;
    bool has_header_ = false;
};

}  // namespace

Result<ScatteredPoints> readPointTable(const std::filesystem::path& file, Progress& progress,
                                       const std::stop_token& stop) {
    auto input = ReadableFile::open(file);
    if (!input) return tl::unexpected(input.error());
    if (input->size() == 0) return badData("the file is empty", file);
    const auto source = [&input](char* buffer, std::size_t capacity) {
        return input->read(buffer, capacity);
    };
    PointTableParser parser(file, input->size());
    return parseLines(source, file, input->size(), parser, progress, stop);
}

}  // namespace terrawalk
