#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <set>

#include "io/read_survey.hpp"
#include "io/short_decimal.hpp"
#include "io/survey_format.hpp"
#include "io/text_input.hpp"

namespace terrawalk {

namespace {

constexpr double kLatestTime_s = 1e9;
constexpr double kLongestJumpBack_s = 60.0;
constexpr std::size_t kLateRowsPerHundred = 5;
constexpr double kLongestLeverArm_m = 10.0;
constexpr std::size_t kRowsComparedWithLast = 100;

constexpr std::string_view kNumberCure =
    "give a number with a decimal dot, or leave the field empty where the sensor gave no value";

/// What a column of the file is, and where its values go.
struct Column {
    enum class Kind { Time, Channel, Auxiliary };
    Kind kind = Kind::Auxiliary;
    std::size_t index = 0;  ///< of the channel or of the auxiliary column
    std::string name;
};

/// What the values of a channel, in the file's unit, must be.
struct ChannelRule {
    Channel channel;
    double least;
    double greatest;
    bool is_integer;
    std::string_view demand;
};
constexpr std::array kChannelRules{
    ChannelRule{Channel::Latitude, -90.0, 90.0, false, "a latitude lies between -90 and 90 degrees"},
    ChannelRule{Channel::Longitude, -180.0, 180.0, false, "a longitude lies between -180 and 180 degrees"},
    ChannelRule{Channel::Fix, 0.0, 9.0, true, "a fix is a whole number from 0 to 9"},
    ChannelRule{Channel::EllipsoidalHeight, -1e5, 1e5, false, "a height on Earth is below 100 km"},
    ChannelRule{Channel::GnssHorizontalAccuracy, 0.0, 1e6, false, "an accuracy lies between 0 and 1000 km"},
    ChannelRule{Channel::GnssVerticalAccuracy, 0.0, 1e6, false, "an accuracy lies between 0 and 1000 km"},
    ChannelRule{Channel::GnssVelocityEast, -1e3, 1e3, false, "no array moves at 1000 m/s"},
    ChannelRule{Channel::GnssVelocityNorth, -1e3, 1e3, false, "no array moves at 1000 m/s"},
    ChannelRule{Channel::GnssVelocityUp, -1e3, 1e3, false, "no array moves at 1000 m/s"},
    ChannelRule{Channel::Pressure, -1e6, 1e6, false, "no air has 10 bar"},
    ChannelRule{Channel::Temperature, -300.0, 1e3, false, "no field has that temperature"},
    ChannelRule{Channel::FlowForward, -1e3, 1e3, false, "no array moves at 1000 m/s"},
    ChannelRule{Channel::FlowLeft, -1e3, 1e3, false, "no array moves at 1000 m/s"},
    ChannelRule{Channel::Roll, -1e4, 1e4, false, "an angle is a few turns at most"},
    ChannelRule{Channel::Pitch, -1e4, 1e4, false, "an angle is a few turns at most"},
    ChannelRule{Channel::Heading, -1e4, 1e4, false, "an angle is a few turns at most"},
    ChannelRule{Channel::AccelerationX, -1e4, 1e4, false, "no hand bears 1000 g"},
    ChannelRule{Channel::AccelerationY, -1e4, 1e4, false, "no hand bears 1000 g"},
    ChannelRule{Channel::AccelerationZ, -1e4, 1e4, false, "no hand bears 1000 g"},
    ChannelRule{Channel::AngularRateX, -1e5, 1e5, false, "no hand turns that fast"},
    ChannelRule{Channel::AngularRateY, -1e5, 1e5, false, "no hand turns that fast"},
    ChannelRule{Channel::AngularRateZ, -1e5, 1e5, false, "no hand turns that fast"},
    ChannelRule{Channel::Range, -1e6, 1e6, false, "no range finder sees 1000 km"},
    ChannelRule{Channel::RangeStrength, -1e9, 1e9, false, "no range finder counts that far"},
    ChannelRule{Channel::FlowQuality, 0.0, 255.0, false, "a flow quality lies between 0 and 255"},
};

constexpr std::size_t indexOf(Channel channel) {
    return static_cast<std::size_t>(channel);
}

bool isFieldEnd(char c) {
    return c == ',' || c == '\n' || c == '\r';
}

/// YYYY-MM-DD[Thh:mm[:ss[.s]][Z|+hh[:mm]|-hh[:mm]]]
bool isIso8601(std::string_view text) {
    const auto takeNumber = [&text](std::size_t digits, int least, int greatest) {
        if (text.size() < digits) return false;
        int value = 0;
        for (const char c : text.substr(0, digits)) {
            if (c < '0' || c > '9') return false;
            value = 10 * value + (c - '0');
        }
        text.remove_prefix(digits);
        return value >= least && value <= greatest;
    };
    const auto take = [&text](std::string_view any_of) {
        if (text.empty() || any_of.find(text.front()) == std::string_view::npos) return false;
        text.remove_prefix(1);
        return true;
    };
    if (!takeNumber(4, 0, 9999) || !take("-") || !takeNumber(2, 1, 12) || !take("-") ||
        !takeNumber(2, 1, 31)) {
        return false;
    }
    if (text.empty()) return true;
    if (!take("T ") || !takeNumber(2, 0, 24) || !take(":") || !takeNumber(2, 0, 59)) return false;
    if (take(":")) {
        if (!takeNumber(2, 0, 60)) return false;  // 60: a leap second
        if (take(".,")) {
            if (!take("0123456789")) return false;
            text.remove_prefix(std::min(text.find_first_not_of("0123456789"), text.size()));
        }
    }
    if (text.empty() || text == "Z") return true;
    if (!take("+-") || !takeNumber(2, 0, 23)) return false;
    if (text.empty()) return true;
    static_cast<void>(take(":"));
    return takeNumber(2, 0, 59) && text.empty();
}

/// Digits after the dot of the last field of a line.
std::size_t lastDecimals(std::string_view line) {
    std::string_view field = trimmed(line.substr(line.rfind(',') + 1));
    if (field.ends_with('"')) field.remove_suffix(1);
    const std::size_t dot = field.find('.');
    return dot == std::string_view::npos ? 0 : field.size() - dot - 1;
}

/// Values of one block of rows, column by column, in the unit of the file.
class BlockValues {
  public:
    /// A row of n columns takes at least n bytes of text, so that a block has no more values than bytes.
    explicit BlockValues(std::size_t columns)
        : rows_per_column_(kBlockBytes / columns + 1),
          values_(std::make_unique_for_overwrite<double[]>(rows_per_column_ * columns)) {}
    [[nodiscard]] double* column(std::size_t c) { return values_.get() + c * rows_per_column_; }
    [[nodiscard]] std::size_t rowsPerColumn() const { return rows_per_column_; }

  private:
    std::size_t rows_per_column_;
    std::unique_ptr<double[]> values_;
};

class ArrayLogParser {
  public:
    /// @param bytes_expected  for reserving memory; a guess will do
    ArrayLogParser(const std::filesystem::path& file, std::size_t bytes_expected)
        : bytes_expected_(bytes_expected) {
        log_.file = file;
    }

    [[nodiscard]] std::size_t nextLine() const { return line_ + 1; }

    Result<void> take(const LineBlock& block) {
        const char* at = block.begin;
        while (columns_.empty() && at != block.end) {
            const char* const line_end = findLineEnd(at, block.end);
            ++line_;
            if (auto taken = takeLineOfHead({at, static_cast<std::size_t>(line_end - at)}); !taken)
                return taken;
            at = afterLineEnd(line_end, block.end);
        }
        if (at == block.end) return {};
        return takeRows(at, block);
    }

    Result<ArrayLog> finish() {
        if (columns_.empty()) return bad("no header row", kHeaderCure);
        if (log_.size() == 0) {
            return log_.read_report.cut_off_line > 0 ? bad("the only row is cut off: it has no line end",
                                                           "end the last row with a line end if it is whole")
                                                     : bad("no data rows after the header");
        }
        if (late_rows_ * 100 > log_.size() * kLateRowsPerHundred) {
            return badAt(first_late_line_,
                         fmt::format("{} of {} rows are out of order, more than {} %; this is the first",
                                     late_rows_, log_.size(), kLateRowsPerHundred),
                         "check the logger's clock, and whether two logs were joined");
        }
        dropHalfPositions();
        if (!odd_rows_.empty()) putInOrder();
        noteWhatIsOdd();
        return std::move(log_);
    }

  private:
    static constexpr std::string_view kHeaderCure =
        "the first row after the # lines must name the columns, time_s among them";

    struct OddRow {
        std::size_t row;
        std::size_t line;
    };
    /// A row that cannot be taken: the error, or that it is the cut-off last one.
    struct Refusal {
        bool is_cut_off = false;
        std::string message;
        std::string cure;
    };

    tl::unexpected<Error> badAt(std::size_t line, std::string message, std::string_view cure = {}) const {
        return badData(std::move(message), log_.file, line, std::string(cure));
    }
    tl::unexpected<Error> bad(std::string message, std::string_view cure = {}) const {
        return badAt(line_, std::move(message), cure);
    }
    Error tooLong() const {
        return bad(fmt::format("the line is longer than {} bytes", kLongestLine),
                   "check that this is the right file")
            .value();
    }

    // ---- before the rows: metadata and header ----

    Result<void> takeLineOfHead(std::string_view raw) {
        if (raw.size() > kLongestLine) return tl::unexpected(tooLong());
        const std::string_view line = trimmed(raw);
        if (line.empty()) return {};
        if (!isUtf8(line)) return bad("the line is no UTF-8 text", "save the file as UTF-8 text");
        return line.front() == '#' ? takeMetadata(line.substr(1)) : takeHeader(line);
    }

    Result<void> takeMetadata(std::string_view text) {
        const std::size_t colon = text.find(':');
        if (colon == std::string_view::npos) return {};  // a comment
        const std::string_view key = trimmed(text.substr(0, colon));
        const std::string_view value = trimmed(text.substr(colon + 1));
        const bool is_new = metadata_keys_.emplace(key).second;
        const bool known = key == "format" || key == "device" || key == "start_utc" ||
                           key == "sample_interval_s" || key == "range_lever_arm_m" ||
                           key == "gnss_lever_arm_m";
        if (!known) {
            if (is_new) note(line_, fmt::format("unknown metadata key {} is not used", inQuotes(key)));
            return {};
        }
        if (!is_new)
            return bad(fmt::format("metadata key {} stands twice", key), "keep one of the two lines");
        if (key == "format") {
            if (value == kArrayLogFormat) return {};
            return bad(fmt::format("format is {}", inQuotes(value)),
                       fmt::format("it must be {}", kArrayLogFormat));
        }
        if (value.empty()) return {};  // as good as no line
        if (key == "device") {
            log_.device = value;
            return {};
        }
        if (key == "start_utc") {
            if (!isIso8601(value)) {
                return bad(fmt::format("start_utc {} is no ISO 8601 time", inQuotes(value)),
                           "write it like 2024-05-17T08:30:00Z");
            }
            log_.start_utc = value;
            return {};
        }
        if (key == "sample_interval_s") {
            const auto interval_s = parseNumber(value);
            if (!interval_s || *interval_s <= 0.0) {
                return bad(fmt::format("sample_interval_s {} is no positive number", inQuotes(value)));
            }
            log_.sample_interval_s = *interval_s;
            return {};
        }
        return takeLeverArm(key, value,
                            key == "range_lever_arm_m" ? log_.range_lever_arm_m : log_.gnss_lever_arm_m);
    }

    Result<void> takeLeverArm(std::string_view key, std::string_view value, Eigen::Vector3d& arm_m) const {
        std::string_view rest = value;
        for (Eigen::Index axis = 0; axis < 3; ++axis) {
            const std::size_t length = std::min(rest.find_first_of(" \t"), rest.size());
            const auto number = parseNumber(rest.substr(0, length));
            if (!number) {
                return bad(fmt::format("{} {} is no vector", key, inQuotes(value)),
                           "give x y z in metres, parted by blanks");
            }
            if (std::abs(*number) > kLongestLeverArm_m) {
                return bad(fmt::format("{} {} is longer than {} m", key, inQuotes(value), kLongestLeverArm_m),
                           "give metres");
            }
            arm_m[axis] = *number;
            rest = trimmed(rest.substr(length));
        }
        if (!rest.empty()) return bad(fmt::format("{} {} has more than three numbers", key, inQuotes(value)));
        return {};
    }

    Result<void> takeHeader(std::string_view line) {
        const auto names = splitCsvLine(line);
        if (!names) return bad("a quotation mark is not closed");
        const bool has_time = std::find(names->begin(), names->end(), kTimeColumn) != names->end();
        if (!has_time) {
            const bool is_row = std::all_of(names->begin(), names->end(), [](const std::string& field) {
                return field.empty() || parseNumber(field).has_value();
            });
            return bad(is_row ? "no header row before the data" : "the header row has no column time_s",
                       kHeaderCure);
        }
        std::set<std::string_view> met;
        std::vector<Column> columns;
        for (const std::string& column : *names) {
            if (column.empty()) return bad(fmt::format("column {} has no name", columns.size() + 1));
            if (!met.insert(column).second) {
                return bad(fmt::format("column {} stands twice", inQuotes(column)),
                           "each column needs its own name");
            }
            columns.push_back(columnNamed(column));
        }
        if (!metadata_keys_.contains("format")) {
            note(line_, fmt::format("no format line; read as {}", kArrayLogFormat));
        }
        header_line_ = line_;
        columns_ = std::move(columns);
        values_.emplace(columns_.size());
        return {};
    }

    Column columnNamed(const std::string& column) {
        if (column == kTimeColumn) return {Column::Kind::Time, 0, column};
        for (std::size_t i = 0; i < kChannelCount; ++i) {
            if (column == kChannels[i].column) return {Column::Kind::Channel, i, column};
        }
        log_.auxiliary.push_back({column, {}, 0});
        return {Column::Kind::Auxiliary, log_.auxiliary.size() - 1, column};
    }

    // ---- the rows ----

    Result<void> takeRows(const char* begin, const LineBlock& block) {
        row_lines_.clear();
        rows_begin_ = begin;
        std::optional<Error> error;
        for (const char* at = begin; at < block.end && !error;) {
            ++line_;
            const char* const row_begin = at;
            if (*at <= '#' && isBlankOrComment(at, block.end)) {
                at = afterLineEnd(findLineEnd(at, block.end), block.end);
            } else {
                Refusal refusal;
                const char* const row_end = readRow(at, block, refusal);
                if (row_end != nullptr) {
                    row_lines_.push_back(line_);
                    at = row_end + (row_end[0] == '\r' && row_end[1] == '\n' ? 2 : 1);
                } else if (refusal.is_cut_off) {
                    log_.read_report.cut_off_line = line_;
                    ++log_.read_report.rows_read;
                    break;
                } else {
                    error = bad(std::move(refusal.message), refusal.cure).value();
                }
            }
            if (at - row_begin > static_cast<std::ptrdiff_t>(kLongestLine)) error = tooLong();
        }
        // A value out of its range in an earlier row comes first.
        if (auto checked = checkRows(); !checked) return checked;
        if (error) return tl::unexpected(std::move(*error));
        appendRows(begin, block);
        return {};
    }

    static bool isBlankOrComment(const char* at, const char* end) {
        while (at < end && (*at == ' ' || *at == '\t')) ++at;
        return at == end || *at == '#' || *at == '\n' || *at == '\r';
    }

    /// Reads one row into the block's values. Returns its line end, or null with a refusal.
    const char* readRow(const char* at, const LineBlock& block, Refusal& refusal) {
        const char* const row_begin = at;
        const std::size_t last = columns_.size() - 1;
        double* out = values_->column(0) + row_lines_.size();
        for (std::size_t c = 0; c <= last; ++c, out += values_->rowsPerColumn()) {
            const char* end = at;
            if (isFieldEnd(*at)) {
                *out = kMissing;
            } else {
                end = readShortDecimal(at, *out);
                if (end == nullptr || !isFieldEnd(*end)) end = readAwkwardField(at, c, block, *out, refusal);
                if (end == nullptr) return nullptr;
            }
            const bool line_ends = *end != ',';
            if (line_ends != (c == last)) {
                refusal = wrongFieldCount(c + 1, line_ends && isOpenEnd(end, block));
                return nullptr;
            }
            at = end + 1;
        }
        const char* const line_end = at - 1;
        if (isOpenEnd(line_end, block) && !lastNumberIsWhole(row_begin, line_end)) {
            refusal.is_cut_off = true;
            return nullptr;
        }
        return line_end;
    }

    static bool isOpenEnd(const char* line_end, const LineBlock& block) {
        return block.last_line_open && line_end == block.end;
    }

    /// A field of any other form: blanks, quotation marks, exponents, many digits, text.
    const char* readAwkwardField(const char* at, std::size_t c, const LineBlock& block, double& value,
                                 Refusal& refusal) {
        const char* const line_end = findLineEnd(at, block.end);
        while (at != line_end && *at == ' ') ++at;
        const char* const plain_end = readShortDecimal(at, value);
        if (plain_end != nullptr && isFieldEnd(*plain_end)) return plain_end;

        const CsvField field = readCsvField(at, line_end);
        const bool may_be_cut = field.end == line_end && isOpenEnd(line_end, block);
        const Column& column = columns_[c];
        if (!field.is_whole) {
            refusal = {
                may_be_cut, fmt::format("column {}: the quotation mark is not closed", column.name), {}};
            return nullptr;
        }
        const auto number = parseNumber(field.text);
        value = number.value_or(kMissing);
        if (number || field.text.empty()) return field.end;
        if (may_be_cut) {
            refusal.is_cut_off = true;
            return nullptr;
        }
        if (column.kind == Column::Kind::Auxiliary) {
            ++log_.auxiliary[column.index].not_numeric;
            return field.end;
        }
        refusal = {false, fmt::format("column {}: {} is no finite number", column.name, inQuotes(field.text)),
                   std::string(kNumberCure)};
        return nullptr;
    }

    Refusal wrongFieldCount(std::size_t fields, bool is_cut_off) const {
        const std::size_t columns = columns_.size();
        return {is_cut_off,
                fields < columns ? fmt::format("{} fields, but the header has {} columns", fields, columns)
                                 : fmt::format("more fields than the {} columns of the header", columns),
                "the decimal sign is a dot, and an empty field keeps its comma"};
    }

    /// Whether the last number of a row without a line end was not cut: loggers write a column with a fixed
    /// number of decimals, and 12.34 in a column of two decimals has them all. Without decimals nothing can
    /// be told.
    bool lastNumberIsWhole(const char* row_begin, const char* row_end) {
        const std::size_t decimals = lastDecimals({row_begin, static_cast<std::size_t>(row_end - row_begin)});
        if (decimals == 0) return false;
        std::size_t compared = 0;
        const char* line_end = row_begin;
        while (line_end != rows_begin_ && compared < kRowsComparedWithLast) {
            const char* const end = line_end - 1;
            const char* begin = end;
            while (begin != rows_begin_ && begin[-1] != '\n' && begin[-1] != '\r') --begin;
            line_end = begin;
            const std::string_view line = trimmed({begin, static_cast<std::size_t>(end - begin)});
            if (line.empty() || line.front() == '#' || line.back() == ',') continue;
            if (lastDecimals(line) != decimals) return false;
            ++compared;
        }
        if (compared == 0) return false;
        note(line_, "the last row has no line end; it is kept, since its last number is whole");
        return true;
    }

    /// The first row of the block that breaks a rule, and the order of times.
    Result<void> checkRows() {
        std::size_t first_bad = row_lines_.size();
        std::optional<Error> error;
        const auto check = [&](std::size_t c, const auto& isGood, std::string_view problem,
                               std::string_view cure) {
            const double* const values = values_->column(c);
            const auto row =
                static_cast<std::size_t>(std::find_if_not(values, values + first_bad, isGood) - values);
            if (row == first_bad) return;
            first_bad = row;
            const std::string value = present(values[row]) ? fmt::format("{}: ", values[row]) : "";
            error =
                badAt(row_lines_[row], fmt::format("column {}: {}{}", columns_[c].name, value, problem), cure)
                    .value();
        };
        for (std::size_t c = 0; c < columns_.size(); ++c) {
            const Column& column = columns_[c];
            if (column.kind == Column::Kind::Time) {
                check(c, present, "the time is missing", "every row needs its time");
                check(
                    c, [](double t) { return std::abs(t) < kLatestTime_s; },
                    "this is no time since the log's start",
                    "count time_s in seconds from the start of the log; start_utc ties it to UTC");
            }
            if (column.kind != Column::Kind::Channel) continue;
            for (const ChannelRule& rule : kChannelRules) {
                if (indexOf(rule.channel) != column.index) continue;
                check(
                    c,
                    [&rule](double v) {
                        return !present(v) || (v >= rule.least && v <= rule.greatest &&
                                               (!rule.is_integer || v == std::floor(v)));
                    },
                    rule.demand, "correct the value, or leave the field empty");
            }
        }
        if (auto ordered = checkTimes(first_bad); !ordered) return ordered;
        if (error) return tl::unexpected(std::move(*error));
        return {};
    }

    /// Remembers rows that do not come after all earlier ones; looks at the first `rows` rows of the block.
    Result<void> checkTimes(std::size_t rows) {
        const auto time = std::find_if(columns_.begin(), columns_.end(), [](const Column& column) {
            return column.kind == Column::Kind::Time;
        });
        const double* const time_s = values_->column(static_cast<std::size_t>(time - columns_.begin()));
        for (std::size_t i = 0; i < rows; ++i) {
            if (time_s[i] > newest_s_) {
                newest_s_ = time_s[i];
                newest_line_ = row_lines_[i];
                continue;
            }
            if (time_s[i] < newest_s_ - kLongestJumpBack_s) {
                return badAt(row_lines_[i],
                             fmt::format("the clock jumps back from {} s (line {}) to {} s, more than {} s",
                                         newest_s_, newest_line_, time_s[i], kLongestJumpBack_s),
                             "part the log there, or correct the time");
            }
            if (time_s[i] < newest_s_ && late_rows_++ == 0) first_late_line_ = row_lines_[i];
            odd_rows_.push_back({log_.size() + i, row_lines_[i]});
        }
        return {};
    }

    /// Puts the block's values, in the unit of the program, behind those of the blocks before it.
    void appendRows(const char* begin, const LineBlock& block) {
        const std::size_t rows = row_lines_.size();
        log_.read_report.rows_read += rows;
        if (log_.size() == 0 && rows > 0) {
            const auto bytes = static_cast<double>(block.end - begin);
            const double rows_expected =
                static_cast<double>(rows) * static_cast<double>(bytes_expected_) / bytes;
            for (const Column& column : columns_) {
                valuesOf(column).reserve(rows + static_cast<std::size_t>(1.02 * rows_expected));
            }
        }
        for (std::size_t c = 0; c < columns_.size(); ++c) {
            double* const values = values_->column(c);
            if (columns_[c].kind == Column::Kind::Channel) {
                const double factor = kChannels[columns_[c].index].unit_factor;
                if (factor != 1.0) std::for_each(values, values + rows, [factor](double& v) { v *= factor; });
            }
            std::vector<double>& all = valuesOf(columns_[c]);
            all.insert(all.end(), values, values + rows);
        }
    }

    std::vector<double>& valuesOf(const Column& column) {
        switch (column.kind) {
            case Column::Kind::Time:
                return log_.time_s;
            case Column::Kind::Channel:
                return log_.channels[column.index];
            case Column::Kind::Auxiliary:
                return log_.auxiliary[column.index].values;
        }
        return log_.time_s;
    }

    // ---- after the rows ----

    /// A latitude without its longitude is no position.
    void dropHalfPositions() {
        std::vector<double>& lat_deg = log_.column(Channel::Latitude);
        std::vector<double>& lon_deg = log_.column(Channel::Longitude);
        if (lat_deg.empty() != lon_deg.empty()) {
            note(header_line_, "only one of the columns lat_deg and lon_deg; the log has no positions");
            lat_deg.clear();
            lon_deg.clear();
        }
        std::size_t halves = 0;
        for (std::size_t i = 0; i < lat_deg.size(); ++i) {
            if (present(lat_deg[i]) == present(lon_deg[i])) continue;
            lat_deg[i] = lon_deg[i] = kMissing;
            ++halves;
        }
        if (halves > 0) {
            note(header_line_, fmt::format("{} rows give only one of latitude and longitude; "
                                           "their positions are taken as missing",
                                           halves));
        }
    }

    /// Merges the late rows into the others, drops repeated times.
    void putInOrder() {
        const std::vector<double>& time_s = log_.time_s;
        std::vector<std::size_t> in_order;
        in_order.reserve(time_s.size());
        auto odd = odd_rows_.begin();
        for (std::size_t i = 0; i < time_s.size(); ++i) {
            if (odd != odd_rows_.end() && odd->row == i) {
                ++odd;
            } else {
                in_order.push_back(i);
            }
        }
        const auto earlier = [&](std::size_t a, std::size_t b) {
            return time_s[a] < time_s[b];
        };
        std::vector<std::size_t> late;
        for (const OddRow& row : odd_rows_) late.push_back(row.row);
        std::stable_sort(late.begin(), late.end(), earlier);
        std::vector<std::size_t> merged(time_s.size());
        std::merge(in_order.begin(), in_order.end(), late.begin(), late.end(), merged.begin(), earlier);
        const auto repeats = std::unique(merged.begin(), merged.end(), [&](std::size_t a, std::size_t b) {
            return time_s[a] == time_s[b];
        });
        merged.erase(repeats, merged.end());

        std::vector<bool> kept(time_s.size(), false);
        for (const std::size_t row : merged) kept[row] = true;
        LogReadReport& report = log_.read_report;
        for (const OddRow& row : odd_rows_) {
            (kept[row.row] ? report.late_lines : report.repeated_lines).push_back(row.line);
        }
        for (const Column& column : columns_) {
            std::vector<double>& values = valuesOf(column);
            if (values.empty() || column.kind == Column::Kind::Time) continue;
            values = gathered(values, merged);
        }
        log_.time_s = gathered(log_.time_s, merged);
    }

    static std::vector<double> gathered(const std::vector<double>& values,
                                        const std::vector<std::size_t>& rows) {
        std::vector<double> out(rows.size());
        std::transform(rows.begin(), rows.end(), out.begin(), [&](std::size_t row) { return values[row]; });
        return out;
    }

    void noteWhatIsOdd() {
        for (const AuxiliaryColumn& column : log_.auxiliary) {
            const std::string text =
                fmt::format("unknown column {} is kept as auxiliary", inQuotes(column.name));
            note(header_line_,
                 column.not_numeric == 0
                     ? text
                     : text + fmt::format("; {} of its fields are no numbers", column.not_numeric));
        }
    }

    void note(std::size_t line, const std::string& message) {
        log_.read_report.notes.push_back(noteAt(line, message));
    }

    ArrayLog log_;
    std::size_t bytes_expected_;
    std::size_t line_ = 0;  ///< that was read last
    std::size_t header_line_ = 0;
    std::set<std::string, std::less<>> metadata_keys_;
    std::vector<Column> columns_;  ///< empty before the header
    std::optional<BlockValues> values_;
    std::vector<std::size_t> row_lines_;  ///< line of each row of the block
    const char* rows_begin_ = nullptr;    ///< of the block
    double newest_s_ = -std::numeric_limits<double>::infinity();
    std::size_t newest_line_ = 0;
    std::size_t late_rows_ = 0;  ///< repeated ones included
    std::size_t first_late_line_ = 0;
    std::vector<OddRow> odd_rows_;  ///< late or repeated, in the order of the file
};

}  // namespace

Result<ArrayLog> readArrayLog(const std::filesystem::path& file, Progress& progress, std::stop_token stop) {
    auto input = ReadableFile::open(file);
    if (!input) return tl::unexpected(input.error());
    if (input->size() == 0) return badData("the file is empty", file);
    const auto source = [&input](char* buffer, std::size_t capacity) {
        return input->read(buffer, capacity);
    };
    ArrayLogParser parser(file, input->size());
    return parseLines(source, file, input->size(), parser, progress, stop);
}

Result<ArrayLog> parseArrayLog(std::string_view bytes, const std::filesystem::path& file, Progress& progress,
                               std::stop_token stop) {
    if (bytes.empty()) return badData("the file is empty", file);
    std::string_view rest = bytes;
    const auto source = [&rest](char* buffer, std::size_t capacity) -> Result<std::size_t> {
        const std::size_t length = rest.copy(buffer, capacity);
        rest.remove_prefix(length);
        return length;
    };
    ArrayLogParser parser(file, bytes.size());
    return parseLines(source, file, bytes.size(), parser, progress, stop);
}

}  // namespace terrawalk
