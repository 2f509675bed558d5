#include "app/pipeline/derive_job.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "app/pipeline/raster_input.hpp"
#include "mapping/drainage.hpp"

namespace terrawalk {

namespace {

namespace fs = std::filesystem;

constexpr double kBytesPerCell = 12.0;  // the raster and what writing it takes

struct Meaning {
    std::string quantity;
    std::string unit;
    std::string method;
};

Meaning meaningOf(Derivative derivative, const DerivativeOptions& options, const std::string& unit) {
    constexpr const char* kHorn = "Horn 1981";
    constexpr const char* kQuadratic = "Zevenbergen and Thorne 1987";
    switch (derivative) {
        case Derivative::Hillshade:
            return {"Hillshade, 1 to 255", "1", kHorn};
        case Derivative::Slope:
            return {"Slope", options.slope_unit == SlopeUnit::Percent ? "percent" : "degrees", kHorn};
        case Derivative::Aspect:
            return {"Aspect, clockwise from north", "degrees", kHorn};
        case Derivative::Curvature:
            return {"Curvature, convex positive", "1/" + unit, kQuadratic};
        case Derivative::ProfileCurvature:
            return {"Profile curvature, convex positive", "1/" + unit, kQuadratic};
        case Derivative::PlanCurvature:
            return {"Plan curvature, convex positive", "1/" + unit, kQuadratic};
        case Derivative::Roughness:
            return {"Roughness, range of nine cells", unit, "Wilson et al. 2007"};
    }
    return {};
}

std::vector<FlowRouting> routingsOf(const DeriveRequest& request) {
    std::vector<FlowRouting> routings;
    if (request.flow_accumulation) routings.push_back(FlowRouting::D8);
    if (request.flow_accumulation_dinf) routings.push_back(FlowRouting::DInfinity);
    return routings;
}

class RasterWriter {
  public:
    RasterWriter(const DeriveRequest& request, const DemFile& dem, DeriveOutcome& outcome)
        : request_(request), dem_(dem), outcome_(outcome) {}

    Result<void> write(const ElevationGrid& grid, const std::string& name, const Meaning& meaning,
                       const std::stop_token& stop) {
        const fs::path folder = request_.output.empty() ? request_.dem.parent_path() : request_.output;
        const fs::path file = folder / fmt::format("{}_{}.tif", request_.dem.stem().string(), name);
        const std::string title = fmt::format("{}, {}", request_.dem.stem().string(), name);
        auto done = writeDem(
            grid, describeDerived(dem_, title, meaning.quantity, meaning.unit, meaning.method), file, stop);
        if (done) outcome_.files.push_back(file);
        return done;
    }

  private:
    const DeriveRequest& request_;
    const DemFile& dem_;
    DeriveOutcome& outcome_;
};

}  // namespace

Result<DeriveOutcome> deriveRasters(const DeriveRequest& request, Progress& progress, std::stop_token stop) {
    const std::vector<FlowRouting> routings = routingsOf(request);
    const bool water = !routings.empty() || request.wet_spots;
    if (request.derivatives.empty() && !water) {
        return usageError("nothing to derive", "name a raster, e.g. --slope or --hillshade");
    }
    progress.report(0.0, "reading");
    const auto dem = readDem(request.dem, stop);
    if (!dem) return tl::unexpected(dem.error());
    const double per_cell = kBytesPerCell + (water ? kDrainageBytesPerCell : 0.0) +
                            (routings.size() > 1 ? kAccumulationBytesPerCell : 0.0);
    if (auto fits = checkCellMemory(dem->grid.geometry.size(), per_cell, "deriving rasters of"); !fits) {
        return tl::unexpected(fits.error());
    }
    if (!request.output.empty()) {
        std::error_code error;
        fs::create_directories(request.output, error);
        if (error) return systemError("cannot make the folder: " + error.message(), request.output);
    }
    DeriveOutcome outcome{request, {}};
    RasterWriter writer(request, *dem, outcome);
    const auto steps = static_cast<double>(request.derivatives.size() + (water ? 2 : 0));
    for (std::size_t i = 0; i < request.derivatives.size(); ++i) {
        const Derivative derivative = request.derivatives[i];
        PartialProgress part(progress, static_cast<double>(i) / steps, static_cast<double>(i + 1) / steps);
        const auto grid = derivativeOf(dem->grid, derivative, request.options, part, stop);
        if (!grid) return tl::unexpected(grid.error());
        const std::string name(kDerivatives[static_cast<std::size_t>(derivative)].second);
        if (auto done =
                writer.write(*grid, name, meaningOf(derivative, request.options, dem->crs.unit.symbol), stop);
            !done) {
            return tl::unexpected(done.error());
        }
    }
    if (water) {
        PartialProgress part(progress, static_cast<double>(request.derivatives.size()) / steps, 1.0);
        const auto drainage = drainageOf(dem->grid, routings, part, stop);
        if (!drainage) return tl::unexpected(drainage.error());
        const std::string& unit = dem->crs.unit.symbol;
        Result<void> done;
        for (std::size_t r = 0; r < routings.size() && done; ++r) {
            const bool d8 = routings[r] == FlowRouting::D8;
            done =
                writer.write(drainage->accumulations[r], d8 ? "flow_accumulation" : "flow_accumulation_dinf",
                             {"Area that drains through the cell", unit + "2",
                              d8 ? "priority flood (Barnes et al. 2014), D8 (O'Callaghan and Mark 1984)"
                                 : "priority flood (Barnes et al. 2014), D-infinity (Tarboton 1997)"},
                             stop);
        }
        if (done && request.wet_spots) {
            done = writer.write(
                drainage->wet_depth, "wet_spots",
                {"Depth of standing water before it spills", unit, "priority flood (Barnes et al. 2014)"},
                stop);
        }
        if (!done) return tl::unexpected(done.error());
    }
    progress.report(1.0, "done");
    return outcome;
}

std::string toText(const DeriveOutcome& outcome) {
    std::string text;
    for (const fs::path& file : outcome.files) text += "Written to " + printable(file.string()) + "\n";
    return text;
}

std::string toJson(const DeriveOutcome& outcome) {
    nlohmann::ordered_json files = nlohmann::ordered_json::array();
    for (const fs::path& file : outcome.files) files.push_back(file.string());
    const nlohmann::ordered_json document{{"format", "terrawalk-derive 1"},
                                          {"dem", outcome.request.dem.string()},
                                          {"slope_unit", name(outcome.request.options.slope_unit)},
                                          {"files", files}};
    return document.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace terrawalk
