#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <string_view>

#include "io/markup_text.hpp"
#include "io/output_folder.hpp"
#include "io/report_text.hpp"
#include "io/write_products.hpp"

namespace terrawalk {

namespace {

std::string csvNumber(double value) {
    if (!std::isfinite(value)) return {};
    const std::string text = fmt::format("{:.6f}", value);
    return text == "-0.000000" ? "0.000000" : text;
}

std::string csvVector(const Eigen::Vector3d& v) {
    return csvNumber(v.x()) + "," + csvNumber(v.y()) + "," + csvNumber(v.z());
}

}  // namespace

std::string residualsCsv(const std::vector<Residual>& residuals) {
    std::string out =
        "stage,quantity,mark,role,run,mark_e_m,mark_n_m,mark_u_m,d_e_m,d_n_m,d_u_m,"
        "sigma_e_m,sigma_n_m,sigma_u_m,used_by_estimator,slope,cover,possible_blunder\n";
    for (const Residual& r : residuals) {
        fmt::format_to(std::back_inserter(out), "{},{},{},{},{},{},{},{},{},{},{},{}\n", name(r.stage),
                       name(r.quantity), csvField(r.mark), name(r.role), csvField(r.run),
                       csvVector(r.mark_enu_m), csvVector(r.difference_enu_m), csvVector(r.sigma_enu_m),
                       r.used_by_estimator ? "true" : "false", csvNumber(r.slope), name(r.cover),
                       r.possible_blunder ? "true" : "false");
    }
    return out;
}

Result<void> writeResidualsCsv(const std::vector<Residual>& residuals, const std::filesystem::path& file) {
    return writeTextFile(residualsCsv(residuals), file);
}

}  // namespace terrawalk
