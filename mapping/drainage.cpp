#include "mapping/drainage.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
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
        Filled result{{heights_.heights_m.begin(), heights_.heights_m.end()}, {}};
        std::vector<double>& filled = result.heights;
        result.upward.reserve(size());
        std::vector<bool> seen(size(), false);
        using Entry = std::pair<double, std::size_t>;
        std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
        std::queue<std::size_t> pit;
        for (std::size_t cell = 0; cell < size(); ++cell) {
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

    /// Where the cell's water goes; the cell count where it leaves the DEM.
    [[nodiscard]] std::size_t receiver(std::size_t cell, const std::vector<double>& filled) const {
        std::size_t best = size();
        double steepest = 0.0;
        for (const Step& step : kNeighbours) {
            const std::size_t other = neighbour(cell, step);
            if (other == size()) continue;
            const double descent = (filled[cell] - filled[other]) / step.length;
            if (descent > steepest) {
                steepest = descent;
                best = other;
            }
        }
        return best;
    }

  private:
    [[nodiscard]] bool isEdge(std::size_t cell) const {
        return std::any_of(kNeighbours.begin(), kNeighbours.end(),
                           [&](const Step& step) { return neighbour(cell, step) == size(); });
    }
    const ElevationGrid& heights_;
    std::size_t rows_;
    std::size_t columns_;
};

}  // namespace

Result<Drainage> drainageOf(const ElevationGrid& heights, Progress& progress, std::stop_token stop) {
    Flood flood(heights);
    PartialProgress filling(progress, 0.0, 0.7);
    const auto filled = flood.fill(filling, stop);
    if (!filled) return tl::unexpected(filled.error());
    const double cell_area = heights.geometry.cell_m * heights.geometry.cell_m;
    std::vector<double> area(flood.size(), cell_area);
    const std::vector<std::size_t>& upward = filled->upward;
    for (std::size_t i = upward.size(); i-- > 0;) {
        if (i % kCellsBetweenStops == 0) {
            if (stop.stop_requested()) return cancelled();
            progress.report(1.0 - 0.3 * static_cast<double>(i) / static_cast<double>(upward.size()),
                            "following the water");
        }
        const std::size_t to = flood.receiver(upward[i], filled->heights);
        if (to != flood.size()) area[to] += area[upward[i]];
    }
    Drainage drainage{heights, heights};
    for (const std::size_t cell : upward) {
        drainage.accumulation.heights_m[cell] = static_cast<float>(area[cell]);
        drainage.wet_depth.heights_m[cell] =
            static_cast<float>(filled->heights[cell]) - heights.heights_m[cell];
    }
    return drainage;
}

}  // namespace terrawalk
