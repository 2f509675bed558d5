#include "app/pipeline/optimiser_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "io/text_input.hpp"

namespace terrawalk {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostBytes = std::size_t{64} << 20U;

/// The lines of a table, each with its number; comments and empty ones left out.
class Rows {
  public:
    explicit Rows(std::string_view text) : rest_(withoutByteOrderMark(text)) {}
    bool next() {
        while (!rest_.empty()) {
            const char* const end = rest_.data() + rest_.size();
            const char* const line_end = findLineEnd(rest_.data(), end);
            row = trimmed({rest_.data(), static_cast<std::size_t>(line_end - rest_.data())});
            rest_.remove_prefix(static_cast<std::size_t>(afterLineEnd(line_end, end) - rest_.data()));
            ++line;
            if (!row.empty() && row.front() != '#') return true;
        }
        return false;
    }
    std::string_view row;
    std::size_t line = 0;

  private:
    std::string_view rest_;
};

}  // namespace

OptimiserLosses& OptimiserTable::of(const std::string& optimiser) {
    const auto found = std::find_if(optimisers.begin(), optimisers.end(),
                                    [&](const OptimiserLosses& o) { return o.optimiser == optimiser; });
    if (found != optimisers.end()) return *found;
    return optimisers.emplace_back(OptimiserLosses{optimiser, {}});
}

Result<OptimiserTable> readOptimiserTable(const fs::path& file) {
    const auto text = readWholeFile(file, kMostBytes);
    if (!text) return tl::unexpected(text.error());
    Rows rows(*text);
    const auto header = rows.next() && isUtf8(rows.row) ? splitCsvLine(rows.row) : std::nullopt;
    const auto bad = [&](const std::string& what) {
        return badData(what, file, rows.line,
                       "choose the CSV of an experiment that repeats searches, such as fig10");
    };
    if (!header || header->size() < 3) return bad("no header with three columns or more");
    const auto loss = std::find_if(header->begin() + 1, header->end(),
                                   [](const std::string& column) { return column.starts_with("loss"); });
    const auto value = static_cast<std::size_t>(loss != header->end() ? loss - header->begin() : 2);
    OptimiserTable table;
    table.quantity = (*header)[value];
    while (rows.next()) {
        const auto fields = splitCsvLine(rows.row);
        if (!fields || fields->size() != header->size())
            return bad("the row has another number of fields than the header");
        const auto number = parseNumber((*fields)[value]);
        if (!number) {
            return bad(fmt::format("column {}: {} is no finite number", inQuotes(table.quantity),
                                   inQuotes((*fields)[value])));
        }
        if ((*fields)[0].empty() || parseNumber((*fields)[0])) return bad("the first column holds no name");
        table.of((*fields)[0]).losses.push_back(*number);
    }
    if (table.optimisers.empty()) return bad("no rows");
    return table;
}

}  // namespace terrawalk
