#include "app/pipeline/report_file.hpp"

#include "io/write_products.hpp"

namespace terrawalk {

Result<void> writeReport(const Products& products, const std::filesystem::path& file) {
    return writeReportPdf(products.report, file);
}

}  // namespace terrawalk
