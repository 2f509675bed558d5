#pragma once

#include <filesystem>

#include "app/pipeline/process.hpp"
#include "survey/result.hpp"

namespace terrawalk {

/// Writes the report of products as PDF: the same bytes as report.pdf of writeProducts(). Errors: System.
[[nodiscard]] Result<void> writeReport(const Products& products, const std::filesystem::path& file);

}  // namespace terrawalk
