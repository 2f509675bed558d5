#include <fmt/compile.h>
#include <fmt/format.h>

#include <cmath>

#include "io/markup_text.hpp"
#include "io/replacing_file.hpp"
#include "io/survey_format.hpp"
#include "io/write_products.hpp"

namespace terrawalk {

namespace {

/// One line of a CSV table. A value that is not finite is an empty field.
class CsvLine {
  public:
    CsvLine& time(double time_s) {
        separate();
        if (std::isfinite(time_s)) fmt::format_to(std::back_inserter(line_), FMT_COMPILE("{:.3f}"), time_s);
        return *this;
    }
    CsvLine& number(double value) {
        separate();
        if (std::isfinite(value)) fmt::format_to(std::back_inserter(line_), FMT_COMPILE("{:.4f}"), value);
        return *this;
    }
    CsvLine& vector(const Eigen::Vector3d& v) { return number(v.x()).number(v.y()).number(v.z()); }
    CsvLine& text(std::string_view text) {
        separate();
        line_.append(csvField(text));
        return *this;
    }
    /// The finished line; the next one begins empty.
    [[nodiscard]] std::string_view end() {
        line_.push_back('\n');
        done_.swap(line_);
        line_.clear();
        first_ = true;
        return done_;
    }

  private:
    void separate() {
        if (!first_) line_.push_back(',');
        first_ = false;
    }
    std::string line_;
    std::string done_;
    bool first_ = true;
};

/// Clockwise from north, 0 <= heading < 360 also after rounding to four decimals.
double headingDegrees(double yaw_rad) {
    const double heading_deg = degrees(yawFromHeading(yaw_rad));
    const double rounded_deg =
        std::round((heading_deg < 0.0 ? heading_deg + 360.0 : heading_deg) * 1e4) / 1e4;
    return rounded_deg >= 360.0 ? 0.0 : rounded_deg;
}

}  // namespace

Result<void> writeTrajectoryCsv(const Trajectory& trajectory, const std::filesystem::path& file) {
    auto out = ReplacingFile::create(file);
    if (!out) return tl::unexpected(out.error());
    auto written = out->write(fmt::format("{}\n", fmt::join(kTrajectoryColumns, ",")));
    CsvLine line;
    for (const TrajectoryEpoch& epoch : trajectory.epochs) {
        if (!written) return written;
        const Eigen::Vector3d sigma_enu_m = epoch.covariance.diagonal().head<3>().cwiseSqrt();
        line.time(epoch.time_s)
            .vector(epoch.position_enu_m)
            .vector(epoch.velocity_enu_mps)
            .vector(sigma_enu_m);
        line.number(degrees(epoch.attitude.roll_rad)).number(degrees(epoch.attitude.pitch_rad));
        line.number(headingDegrees(epoch.attitude.yaw_rad));
        line.number(degrees(epoch.sigma_tilt_rad)).number(degrees(epoch.sigma_heading_rad));
        written = out->write(line.end());
    }
    if (!written) return written;
    return out->commit();
}

Result<void> writeGroundPointsCsv(const std::vector<GroundPoint>& points,
                                  const std::vector<std::string>& run_ids,
                                  const std::filesystem::path& file) {
    auto out = ReplacingFile::create(file);
    if (!out) return tl::unexpected(out.error());
    auto written = out->write("run,time_s,e_m,n_m,u_m,sigma_u_m,used,reason\n");
    CsvLine line;
    for (const GroundPoint& point : points) {
        if (!written) return written;
        if (point.run >= run_ids.size()) {
            return badData(fmt::format("a ground point names run {} of {}", point.run, run_ids.size()), file);
        }
        const bool used = point.state == GroundPointState::Used;
        line.text(run_ids[point.run]).time(point.time_s).vector(point.enu_m).number(point.sigma_u_m);
        line.text(used ? "1" : "0").text(used ? std::string_view() : name(point.state));
        written = out->write(line.end());
    }
    if (!written) return written;
    return out->commit();
}

}  // namespace terrawalk
