#pragma once

#include <filesystem>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "mapping/volume.hpp"
#include "survey/progress.hpp"
#include "survey/result.hpp"

namespace terrawalk {

/// What changed from one survey to another, both on the same cells. Lengths in the unit of the DEMs.
struct DifferenceRequest {
    std::filesystem::path earlier;
    std::filesystem::path later;
    std::filesystem::path output = "difference.tif";
    std::filesystem::path earlier_uncertainty;  ///< raster of one sigma; empty: `sigma`
    std::filesystem::path later_uncertainty;
    double sigma = 0.0;  ///< of one DEM's height where no raster tells it
    /// Of height errors from cell to cell; nothing: what the rasters of sigmas tell, and 0 where none does.
    std::optional<double> correlation_range;
    double common_sigma = 0.0;  ///< of an error of the change that all cells share
};

struct DifferenceOutcome {
    DifferenceRequest request;
    std::string unit;
    VolumeResult all;
    VolumeResult significant;  ///< cells that changed beyond 1.96 sigma alone
    std::size_t raised = 0;
    std::size_t lowered = 0;
    double correlation_range = 0.0;  ///< that was used
    std::vector<std::filesystem::path> files;
    std::vector<std::filesystem::path> of_other_heights;  ///< rasters of sigmas that say so of themselves
};

/// Writes OUTPUT, the later heights less the earlier; OUTPUT's stem + "_significance.tif", +1 and -1 where
/// they changed beyond 1.96 sigma; and stem + "_volumes.csv". Errors: Usage without any sigma, and for sigmas
/// and ranges below zero; BadData for rasters that do not fit; System; Cancelled.
[[nodiscard]] Result<DifferenceOutcome> compareDems(const DifferenceRequest& request, Progress& progress,
                                                    std::stop_token stop);

[[nodiscard]] std::string toText(const DifferenceOutcome& outcome);
[[nodiscard]] std::string toJson(const DifferenceOutcome& outcome);

}  // namespace terrawalk
