#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "io/read_trajectory.hpp"
#include "io/survey_format.hpp"
#include "io/text_input.hpp"
#include "survey/array_log.hpp"

namespace terrawalk {

namespace {

constexpr std::size_t kMostTrajectoryBytes = std::size_t{1} << 30U;

class TrajectoryParser {
  public:
    explicit TrajectoryParser(const std::filesystem::path& file) : file_(file) {
        trajectory_.run_id = file.stem().string();
    }

    Result<Trajectory> parse(std::string_view bytes) {
        const std::string_view text = withoutByteOrderMark(bytes);
        const char* const end = text.data() + text.size();
        for (const char* at = text.data(); at != end;) {
            ++line_;
            const char* const line_end = findLineEnd(at, end);
            const std::string_view content = trimmed({at, static_cast<std::size_t>(line_end - at)});
            at = afterLineEnd(line_end, end);
            if (content.empty()) continue;
            const auto fields = splitCsvLine(content);
            if (!fields) return bad("a quotation mark is not closed");
            auto taken = columns_ == 0 ? takeHeader(*fields) : takeEpoch(*fields);
            if (!taken) return tl::unexpected(taken.error());
        }
        if (trajectory_.epochs.empty()) return bad("no rows");
        return std::move(trajectory_);
    }

  private:
    tl::unexpected<Error> bad(std::string message) const {
        return badData(std::move(message), file_, line_, "it must be a trajectory that terrawalk wrote");
    }

    Result<void> takeHeader(const std::vector<std::string>& names) {
        for (std::size_t i = 0; i < kTrajectoryColumns.size(); ++i) {
            const auto found = std::find(names.begin(), names.end(), kTrajectoryColumns[i]);
            if (found == names.end()) return bad(fmt::format("no column {}", kTrajectoryColumns[i]));
            place_[i] = static_cast<std::size_t>(found - names.begin());
        }
        columns_ = names.size();
        return {};
    }

    Result<void> takeEpoch(const std::vector<std::string>& fields) {
        if (fields.size() != columns_) {
            return bad(fmt::format("{} fields, but the header has {} columns", fields.size(), columns_));
        }
        std::array<double, kTrajectoryColumns.size()> v{};
        for (std::size_t i = 0; i < v.size(); ++i) {
            const std::string& field = fields[place_[i]];
            const auto number = field.empty() ? kMissing : parseNumber(field);
            if (!number) {
                return bad(
                    fmt::format("column {}: {} is no finite number", kTrajectoryColumns[i], inQuotes(field)));
            }
            v[i] = *number;
        }
        const bool later = trajectory_.epochs.empty() || v[0] > trajectory_.epochs.back().time_s;
        if (!present(v[0]) || !later) return bad("the time does not grow");
        TrajectoryEpoch epoch;
        epoch.time_s = v[0];
        epoch.position_enu_m = {v[1], v[2], v[3]};
        epoch.velocity_enu_mps = {v[4], v[5], v[6]};
        for (Eigen::Index axis = 0; axis < 3; ++axis) {
            const double sigma_m = v[7 + static_cast<std::size_t>(axis)];
            epoch.covariance(axis, axis) = sigma_m * sigma_m;
        }
        epoch.attitude = {radians(v[10]), radians(v[11]), yawFromHeading(radians(v[12]))};
        epoch.sigma_tilt_rad = radians(v[13]);
        epoch.sigma_heading_rad = radians(v[14]);
        trajectory_.epochs.push_back(epoch);
        return {};
    }

    const std::filesystem::path& file_;
    std::size_t line_ = 0;
    std::size_t columns_ = 0;  // 0: no header yet
    std::array<std::size_t, kTrajectoryColumns.size()> place_{};
    Trajectory trajectory_;
};

}  // namespace

Result<Trajectory> parseTrajectoryCsv(std::string_view bytes, const std::filesystem::path& file) {
    return TrajectoryParser(file).parse(bytes);
}

Result<Trajectory> readTrajectoryCsv(const std::filesystem::path& file) {
    const auto text = readWholeFile(file, kMostTrajectoryBytes);
    if (!text) return tl::unexpected(text.error());
    return parseTrajectoryCsv(*text, file);
}

}  // namespace terrawalk
