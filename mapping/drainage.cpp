#include "mapping/drainage.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <queue>
#include <utility>
#include <vector>

namespace terrawalk {

namespace {

constexpr std::size_t kCellsBetweenStops = std::size_t{1} << 16U;

struct Step {
    int down = 0;
    int right = 0;
    double length = 1.0;
};
const double kDiagonal = std::sqrt(2.0);
const std::array<Step, 8> kNeighbours{{{0, 1, 1.0},
                                       {1, 1, kDiagonal},
                                       {1, 0, 1.0},
                                       {1, -1, kDiagonal},
                                       {0, -1, 1.0},
                                       {-1, -1, kDiagonal},
                                       {-1, 0, 1.0},
                                       {-1, 1, kDiagonal}}};

class Flood {
  public:
    explicit Flood(const ElevationGrid& heights)
        : heights_(heights), rows_(heights.geometry.rows), columns_(heights.geometry.columns) {}

    /// The neighbour in that direction, or nothing known (the cell count).
    [[nodiscard]] std::size_t neighbour(std::size_t cell, const Step& step) const {
        const std::size_t row = cell / columns_ + static_cast<std::size_t>(step.down);
        const std::size_t column = cell % columns_ + static_cast<std::size_t>(step.right);
        // Below zero wraps to far beyond the grid.
        if (row >= rows_ || column >= columns_) return size();
        const std::size_t other = row * columns_ + column;
        return std::isnan(heights_.heights_m[other]) ? size() : other;
    }
    [[nodiscard]] std::size_t size() const { return heights_.heights_m.size(); }

    struct Filled {
        std::vector<double> heights;      ///< raised so that from each cell a way leads down to the edge
        std::vector<std::size_t> upward;  ///< cells with a height, none before one that lies lower
    };
    Result<Filled> fill(Progress& progress, const std::stop_token& stop) {
        Filled result;
        std::vector<double>& filled = result.heights;
        filled.reserve(size());
        for (std::size_t cell = 0; cell < size(); ++cell) {
            if (cell % kCellsBetweenStops == 0 && stop.stop_requested()) return cancelled();
            filled.push_back(heights_.heights_m[cell]);
        }
        result.upward.reserve(size());
        std::vector<bool> seen(size(), false);
        using Entry = std::pair<double, std::size_t>;
        std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
        std::queue<std::size_t> pit;
        for (std::size_t cell = 0; cell < size(); ++cell) {
            if (cell % kCellsBetweenStops == 0 && stop.stop_requested()) return cancelled();
            if (std::isnan(heights_.heights_m[cell]) || !isEdge(cell)) continue;
            open.emplace(filled[cell], cell);
            seen[cell] = true;
        }
        for (std::size_t done = 0; !open.empty() || !pit.empty(); ++done) {
            if (done % kCellsBetweenStops == 0) {
                if (stop.stop_requested()) return cancelled();
                progress.report(static_cast<double>(done) / static_cast<double>(size()),
                                "filling depressions");
            }
            std::size_t cell = 0;
            // A cell of the heap that lies lower than the pit's next goes first, or the pit would be left too
            // high.
            if (!pit.empty() && (open.empty() || filled[pit.front()] <= open.top().first)) {
                cell = pit.front();
                pit.pop();
            } else {
                cell = open.top().second;
                open.pop();
            }
            result.upward.push_back(cell);
            const double least = std::nextafter(filled[cell], std::numeric_limits<double>::infinity());
            for (const Step& step : kNeighbours) {
                const std::size_t other = neighbour(cell, step);
                if (other == size() || seen[other]) continue;
                seen[other] = true;
                if (filled[other] <= least) {
                    filled[other] = least;
                    pit.push(other);
                } else {
                    open.emplace(filled[other], other);
                }
            }
        }
        return result;
    }

    /// A neighbour and the part of a cell's water that it gets; the cell count where it leaves the DEM.
    struct Share {
        std::size_t to;
        double part;
    };
    using Shares = std::array<Share, 2>;

    [[nodiscard]] Shares sharesOf(std::size_t cell, const std::vector<double>& filled,
                                  FlowRouting routing) const {
        return routing == FlowRouting::D8 ? alongSteepest(cell, filled) : downSteepestFacet(cell, filled);
    }

  private:
    [[nodiscard]] Shares alongSteepest(std::size_t cell, const std::vector<double>& filled) const {
        Shares shares{{{size(), 1.0}, {size(), 0.0}}};
        double steepest = 0.0;
        for (const Step& step : kNeighbours) {
            const std::size_t other = neighbour(cell, step);
            if (other == size()) continue;
            const double descent = (filled[cell] - filled[other]) / step.length;
            if (descent > steepest) {
                steepest = descent;
                shares[0].to = other;
            }
        }
        return shares;
    }

    /// Tarboton 1997, equations 1 to 5 and 7. A facet without one of its corners is an edge: water runs along
    /// it as in D8. Both receivers lie lower than the cell, or the angle would have been bounded to one.
    [[nodiscard]] Shares downSteepestFacet(std::size_t cell, const std::vector<double>& filled) const {
        constexpr double kFacet_rad = 0.25 * std::numbers::pi;
        std::array<std::size_t, 8> around{};
        for (std::size_t i = 0; i < 8; ++i) around[i] = neighbour(cell, kNeighbours[i]);
        Shares shares{{{size(), 1.0}, {size(), 0.0}}};
        double steepest = 0.0;
        for (std::size_t facet = 0; facet < 8; ++facet) {
            const std::size_t straight = around[(facet + 1) / 2 * 2 % 8];
            const std::size_t diagonal = around[facet / 2 * 2 + 1];
            const double here = filled[cell];
            double slope = 0.0, part_of_diagonal = 0.0;
            if (straight != size() && diagonal != size()) {
                const double down = here - filled[straight], aside = filled[straight] - filled[diagonal];
                const double angle_rad = std::clamp(std::atan2(aside, down), 0.0, kFacet_rad);
                part_of_diagonal = angle_rad / kFacet_rad;
                slope = aside <= 0.0    ? down
                        : aside >= down ? (here - filled[diagonal]) / kDiagonal
                                        : std::hypot(down, aside);
            } else if (straight != size()) {
                slope = here - filled[straight];
            } else if (diagonal != size()) {
                slope = (here - filled[diagonal]) / kDiagonal;
                part_of_diagonal = 1.0;
            }
            if (!(slope > steepest)) continue;
            steepest = slope;
            shares = {{{straight, 1.0 - part_of_diagonal}, {diagonal, part_of_diagonal}}};
        }
        return shares;
    }

    [[nodiscard]] bool isEdge(std::size_t cell) const {
        return std::any_of(kNeighbours.begin(), kNeighbours.end(),
                           [&](const Step& step) { return neighbour(cell, step) == size(); });
    }
    const ElevationGrid& heights_;
    std::size_t rows_;
    std::size_t columns_;
};

Result<ElevationGrid> accumulationOf(const Flood& flood, const Flood::Filled& filled,
                                     const ElevationGrid& heights, FlowRouting routing, Progress& progress,
                                     const std::stop_token& stop) {
    const double cell_area = heights.geometry.cell_m * heights.geometry.cell_m;
    std::vector<double> area;
    area.reserve(flood.size());
    while (area.size() < flood.size()) {
        if (stop.stop_requested()) return cancelled();
        area.resize(std::min(flood.size(), area.size() + kCellsBetweenStops), cell_area);
    }
    const std::vector<std::size_t>& upward = filled.upward;
    for (std::size_t i = upward.size(); i-- > 0;) {
        if (i % kCellsBetweenStops == 0) {
            if (stop.stop_requested()) return cancelled();
            progress.report(1.0 - static_cast<double>(i) / static_cast<double>(upward.size()),
                            "following the water");
        }
        for (const Flood::Share& share : flood.sharesOf(upward[i], filled.heights, routing)) {
            if (share.to != flood.size() && share.part > 0.0) area[share.to] += share.part * area[upward[i]];
        }
    }
    ElevationGrid accumulation{heights.geometry, std::vector<float>(flood.size(), kNoHeight)};
    for (std::size_t i = 0; i < upward.size(); ++i) {
        if (i % kCellsBetweenStops == 0 && stop.stop_requested()) return cancelled();
        accumulation.heights_m[upward[i]] = static_cast<float>(area[upward[i]]);
    }
    return accumulation;
}

}  // namespace

Result<Drainage> drainageOf(const ElevationGrid& heights, const std::vector<FlowRouting>& routings,
                            Progress& progress, std::stop_token stop) {
    Flood flood(heights);
    PartialProgress filling(progress, 0.0, 0.7);
    const auto filled = flood.fill(filling, stop);
    if (!filled) return tl::unexpected(filled.error());
    Drainage drainage{{}, heights};
    for (std::size_t i = 0; i < filled->upward.size(); ++i) {
        if (i % kCellsBetweenStops == 0 && stop.stop_requested()) return cancelled();
        const std::size_t cell = filled->upward[i];
        drainage.wet_depth.heights_m[cell] =
            static_cast<float>(filled->heights[cell]) - heights.heights_m[cell];
    }
    for (std::size_t r = 0; r < routings.size(); ++r) {
        const double share = 0.3 / static_cast<double>(routings.size());
        PartialProgress following(progress, 0.7 + share * static_cast<double>(r),
                                  0.7 + share * static_cast<double>(r + 1));
        auto accumulation = accumulationOf(flood, *filled, heights, routings[r], following, stop);
        if (!accumulation) return tl::unexpected(accumulation.error());
        drainage.accumulations.push_back(std::move(*accumulation));
    }
    return drainage;
}

}  // namespace terrawalk
