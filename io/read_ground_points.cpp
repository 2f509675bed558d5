#include "io/read_ground_points.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

#include "io/text_input.hpp"

namespace terrawalk {

namespace {

enum Column : std::size_t { Run, Time, East, North, Up, Sigma, Used, Reason, ColumnCount };
constexpr std::array<std::string_view, ColumnCount> kColumns{"run", "time_s",    "e_m",  "n_m",
                                                             "u_m", "sigma_u_m", "used", "reason"};

class GroundPointParser {
  public:
    explicit GroundPointParser(const std::filesystem::path& file) : file_(file) {}

    [[nodiscard]] std::size_t nextLine() const { return line_ + 1; }

    Result<void> take(const LineBlock& block) {
        for (const char* at = block.begin; at != block.end;) {
            ++line_;
            const char* const line_end = findLineEnd(at, block.end);
            const std::string_view content = trimmed({at, static_cast<std::size_t>(line_end - at)});
            at = afterLineEnd(line_end, block.end);
            if (content.empty()) continue;
            const auto fields = splitCsvLine(content);
            if (!fields) return bad("a quotation mark is not closed");
            if (auto taken = columns_ == 0 ? takeHeader(*fields) : takePoint(*fields); !taken) return taken;
        }
        return {};
    }

    Result<GroundPointTable> finish() {
        if (table_.points.empty()) return bad("no rows");
        return std::move(table_);
    }

  private:
    tl::unexpected<Error> bad(std::string message) const {
        return badData(std::move(message), file_, line_, "it must be a table that terrawalk wrote");
    }

    Result<void> takeHeader(const std::vector<std::string>& names) {
        for (std::size_t i = 0; i < ColumnCount; ++i) {
            const auto found = std::find(names.begin(), names.end(), kColumns[i]);
            if (found == names.end()) return bad(fmt::format("no column {}", kColumns[i]));
            place_[i] = static_cast<std::size_t>(found - names.begin());
        }
        columns_ = names.size();
        return {};
    }

    Result<void> takePoint(const std::vector<std::string>& fields) {
        if (fields.size() != columns_) {
            return bad(fmt::format("{} fields, but the header has {} columns", fields.size(), columns_));
        }
        std::array<double, Sigma + 1> v{};
        for (std::size_t i = Time; i <= Sigma; ++i) {
            const std::string& field = fields[place_[i]];
            const auto number = field.empty() ? std::numeric_limits<double>::quiet_NaN() : parseNumber(field);
            if (!number)
                return bad(fmt::format("column {}: {} is no finite number", kColumns[i], inQuotes(field)));
            v[i] = *number;
        }
        GroundPoint point;
        point.run = runOf(fields[place_[Run]]);
        point.time_s = v[Time];
        point.enu_m = {v[East], v[North], v[Up]};
        point.sigma_u_m = v[Sigma];
        const auto state = stateOf(fields[place_[Used]], fields[place_[Reason]]);
        if (!state) return tl::unexpected(state.error());
        point.state = *state;
        if (point.state == GroundPointState::Used && !point.enu_m.allFinite()) {
            return bad("a point that is used has no place");
        }
        table_.points.push_back(point);
        return {};
    }

    std::uint32_t runOf(const std::string& id) {
        // Points come run by run.
        if (!table_.run_ids.empty() && table_.run_ids.back() == id) {
            return static_cast<std::uint32_t>(table_.run_ids.size() - 1);
        }
        const auto found = std::find(table_.run_ids.begin(), table_.run_ids.end(), id);
        const auto index = static_cast<std::uint32_t>(found - table_.run_ids.begin());
        if (found == table_.run_ids.end()) table_.run_ids.push_back(id);
        return index;
    }

    Result<GroundPointState> stateOf(const std::string& used, const std::string& reason) const {
        if (used == "1" && reason.empty()) return GroundPointState::Used;
        for (std::size_t i = 1; used == "0" && i < kGroundPointStateCount; ++i) {
            const auto state = static_cast<GroundPointState>(i);
            if (name(state) == reason) return state;
        }
        return bad(fmt::format("used {} with reason {}", inQuotes(used), inQuotes(reason)));
    }

    std::filesystem::path file_;
    std::size_t line_ = 0;
    std::size_t columns_ = 0;  // 0: no header yet
    std::array<std::size_t, ColumnCount> place_{};
    GroundPointTable table_;
};

}  // namespace

Result<GroundPointTable> readGroundPointsCsv(const std::filesystem::path& file, Progress& progress,
                                             std::stop_token stop) {
    auto input = ReadableFile::open(file);
    if (!input) return tl::unexpected(input.error());
    const auto source = [&input](char* buffer, std::size_t capacity) {
        return input->read(buffer, capacity);
    };
    GroundPointParser parser(file);
    return parseLines(source, file, input->size(), parser, progress, stop);
}

}  // namespace terrawalk
