#include "mapping/contours.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <new>

#include "survey/parallel.hpp"
#include "survey/parallel_sort.hpp"

namespace terrawalk {

namespace {

constexpr std::size_t kFiner = 4;  // steps of the fine grid within a cell
constexpr double kMostLevels = 1e5;
constexpr std::size_t kRowsAtOnce = 4;

// ---- The smooth surface ----

/// Derivative per cell along a line of three nodes: central, one-sided at an edge, zero where alone.
double slope(float before, double here, float after) {
    const bool has_before = !std::isnan(before);
    const bool has_after = !std::isnan(after);
    if (has_before && has_after) return 0.5 * (double{after} - double{before});
    if (has_after) return double{after} - here;
    return has_before ? here - double{before} : 0.0;
}

/// Height, its two slopes and the twist at a cell centre: what a Hermite patch takes from a corner.
struct Node {
    double f = 0.0, fx = 0.0, fy = 0.0, fxy = 0.0;
};

class HermiteSurface {
  public:
    explicit HermiteSurface(const ElevationGrid& grid) : grid_(grid) {}

    [[nodiscard]] float at(std::ptrdiff_t row, std::ptrdiff_t column) const {
        const GridGeometry& g = grid_.geometry;
        if (row < 0 || column < 0 || row >= static_cast<std::ptrdiff_t>(g.rows) ||
            column >= static_cast<std::ptrdiff_t>(g.columns)) {
            return kNoHeight;
        }
        return grid_.at(static_cast<std::size_t>(row), static_cast<std::size_t>(column));
    }
    [[nodiscard]] Node node(std::ptrdiff_t row, std::ptrdiff_t column) const {
        const float here = at(row, column);
        const float above = columnSlope(row - 1, column);
        const float below = columnSlope(row + 1, column);
        const double fx = columnSlope(row, column);
        return {here, fx, slope(at(row - 1, column), here, at(row + 1, column)), slope(above, fx, below)};
    }

  private:
    [[nodiscard]] float columnSlope(std::ptrdiff_t row, std::ptrdiff_t column) const {
        const float here = at(row, column);
        if (std::isnan(here)) return kNoHeight;
        return static_cast<float>(slope(at(row, column - 1), here, at(row, column + 1)));
    }
    const ElevationGrid& grid_;
};

/// Cubic Hermite basis at t: value and slope at 0, value and slope at 1. At t = 0 and 1 the others vanish
/// exactly, so that neighbouring patches agree to the bit.
std::array<double, 4> hermite(double t) {
    const double s = 1.0 - t;
    return {s * s * (1.0 + 2.0 * t), t * s * s, t * t * (3.0 - 2.0 * t), -t * t * s};
}

using Patch = std::array<std::array<double, kFiner + 1>, kFiner + 1>;  // [down][right]

Patch patchOf(const std::array<Node, 4>& corners) {  // upper left, upper right, lower left, lower right
    static const auto kBasis = [] {
        std::array<std::array<double, 4>, kFiner + 1> basis{};
        for (std::size_t i = 0; i <= kFiner; ++i) {
            basis[i] = hermite(static_cast<double>(i) / static_cast<double>(kFiner));
        }
        return basis;
    }();
    const auto& [ul, ur, ll, lr] = corners;
    Patch patch{};
    for (std::size_t down = 0; down <= kFiner; ++down) {
        const auto& v = kBasis[down];
        const double left = v[0] * ul.f + v[1] * ul.fy + v[2] * ll.f + v[3] * ll.fy;
        const double left_x = v[0] * ul.fx + v[1] * ul.fxy + v[2] * ll.fx + v[3] * ll.fxy;
        const double right = v[0] * ur.f + v[1] * ur.fy + v[2] * lr.f + v[3] * lr.fy;
        const double right_x = v[0] * ur.fx + v[1] * ur.fxy + v[2] * lr.fx + v[3] * lr.fxy;
        for (std::size_t along = 0; along <= kFiner; ++along) {
            const auto& u = kBasis[along];
            patch[down][along] = u[0] * left + u[1] * left_x + u[2] * right + u[3] * right_x;
        }
    }
    return patch;
}

// ---- Segments ----

/// A corner of a triangle of the fine grid.
struct Corner {
    std::uint64_t id = 0;  ///< of a fine node, or of the middle of a fine quad
    Eigen::Vector2d at;    ///< in fine steps, right and down
    double height = 0.0;
};

/// Where a level crosses an edge between two corners.
struct EdgeId {
    std::uint64_t low = 0, high = 0;
    auto operator<=>(const EdgeId&) const = default;
};

struct Segment {
    std::int64_t level = 0;
    EdgeId from, to;
    Eigen::Vector2d start = Eigen::Vector2d::Zero();  ///< in fine steps
    Eigen::Vector2d end = Eigen::Vector2d::Zero();
};

/// The crossing point, the same from both sides of the edge.
Eigen::Vector2d crossing(const Corner& a, const Corner& b, double level) {
    const Corner& p = a.id < b.id ? a : b;
    const Corner& q = a.id < b.id ? b : a;
    return p.at + (level - p.height) / (q.height - p.height) * (q.at - p.at);
}

EdgeId edgeOf(const Corner& a, const Corner& b) {
    return {std::min(a.id, b.id), std::max(a.id, b.id)};
}

class SegmentMaker {
  public:
    SegmentMaker(const ContourOptions& options, std::vector<Segment>& segments)
        : options_(options), segments_(segments) {}

    /// @param t  counter-clockwise on the map
    void triangle(const std::array<const Corner*, 3>& t) {
        const double low = std::min({t[0]->height, t[1]->height, t[2]->height});
        const double high = std::max({t[0]->height, t[1]->height, t[2]->height});
        const auto first = static_cast<std::int64_t>(std::floor((low - options_.base) / options_.interval));
        for (std::int64_t k = first;; ++k) {
            const double level = options_.base + static_cast<double>(k) * options_.interval;
            if (level > high) return;
            if (level > low) cut(t, k, level);
        }
    }

  private:
    void cut(const std::array<const Corner*, 3>& t, std::int64_t k, double level) {
        Segment segment;
        segment.level = k;
        for (std::size_t i = 0; i < 3; ++i) {
            const Corner& a = *t[i];
            const Corner& b = *t[(i + 1) % 3];
            const bool a_above = a.height >= level;
            if (a_above == (b.height >= level)) continue;
            // Going round counter-clockwise, the line with higher ground to its left starts where the edge
            // goes down.
            (a_above ? segment.from : segment.to) = edgeOf(a, b);
            (a_above ? segment.start : segment.end) = crossing(a, b, level);
        }
        segments_.push_back(segment);
    }

    const ContourOptions& options_;
    std::vector<Segment>& segments_;
};

/// All segments between two rows of cell centres.
void cutRow(const ElevationGrid& grid, std::size_t row, const ContourOptions& options,
            std::vector<Segment>& segments) {
    const HermiteSurface surface(grid);
    SegmentMaker maker(options, segments);
    const std::uint64_t fine_columns = grid.geometry.columns * kFiner;
    // Fine nodes have even ids, middles odd ones.
    const auto corner = [&](std::uint64_t down, std::uint64_t along, double height) {
        return Corner{2 * (down * fine_columns + along),
                      {static_cast<double>(along), static_cast<double>(down)},
                      height};
    };
    for (std::size_t column = 0; column + 1 < grid.geometry.columns; ++column) {
        const std::array<float, 4> heights{grid.at(row, column), grid.at(row, column + 1),
                                           grid.at(row + 1, column), grid.at(row + 1, column + 1)};
        if (std::any_of(heights.begin(), heights.end(), [](float h) { return std::isnan(h); })) continue;
        const auto r = static_cast<std::ptrdiff_t>(row);
        const auto c = static_cast<std::ptrdiff_t>(column);
        const Patch patch = patchOf(
            {surface.node(r, c), surface.node(r, c + 1), surface.node(r + 1, c), surface.node(r + 1, c + 1)});
        for (std::size_t down = 0; down < kFiner; ++down) {
            for (std::size_t along = 0; along < kFiner; ++along) {
                const std::uint64_t d = row * kFiner + down;
                const std::uint64_t a = column * kFiner + along;
                const Corner ul = corner(d, a, patch[down][along]);
                const Corner ur = corner(d, a + 1, patch[down][along + 1]);
                const Corner ll = corner(d + 1, a, patch[down + 1][along]);
                const Corner lr = corner(d + 1, a + 1, patch[down + 1][along + 1]);
                const Corner middle{ul.id + 1, 0.5 * (ul.at + lr.at),
                                    0.25 * (ul.height + ur.height + ll.height + lr.height)};
                maker.triangle({&middle, &ll, &lr});
                maker.triangle({&middle, &lr, &ur});
                maker.triangle({&middle, &ur, &ul});
                maker.triangle({&middle, &ul, &ll});
            }
        }
    }
}

// ---- From segments to lines ----

bool startsBefore(const Segment& a, const Segment& b) {
    return a.level != b.level ? a.level < b.level : a.from < b.from;
}

constexpr std::size_t kSegmentsBetweenStops = 65'536;

class Chainer {
  public:
    Chainer(std::vector<Segment> segments, const GridGeometry& geometry, const ContourOptions& options)
        : segments_(std::move(segments)), geometry_(geometry), options_(options) {}

    Result<std::vector<Contour>> chain(const std::stop_token& stop) {
        if (!sort(stop)) return cancelled();
        taken_.assign(segments_.size(), false);
        has_before_.assign(segments_.size(), false);
        for (std::size_t i = 0; i < segments_.size(); ++i) {
            if (i % kSegmentsBetweenStops == 0 && stop.stop_requested()) return cancelled();
            const std::size_t next = after(segments_[i]);
            if (next < segments_.size()) has_before_[next] = true;
        }
        std::vector<Contour> lines;
        const auto takeAll = [&](bool rings) {
            for (std::size_t i = 0; i < segments_.size() && !stop.stop_requested(); ++i) {
                if (taken_[i] || (!rings && has_before_[i])) continue;
                Contour line = follow(i);
                if (line.vertices.size() >= 2) lines.push_back(std::move(line));
            }
        };
        takeAll(false);
        takeAll(true);
        if (stop.stop_requested()) return cancelled();
        std::stable_sort(lines.begin(), lines.end(),
                         [](const Contour& a, const Contour& b) { return a.level < b.level; });
        return lines;
    }

  private:
    /// No two segments are alike, so that the order is one. False when it was stopped.
    bool sort(const std::stop_token& stop) {
        struct Stopped {};
        try {
            parallelSort(segments_, [&stop](const Segment& a, const Segment& b) {
                if (stop.stop_requested()) throw Stopped{};
                return startsBefore(a, b);
            });
        } catch (const Stopped&) {
            return false;
        }
        return true;
    }
    [[nodiscard]] std::size_t after(const Segment& segment) const {
        Segment wanted;
        wanted.level = segment.level;
        wanted.from = segment.to;
        const auto found = std::lower_bound(segments_.begin(), segments_.end(), wanted, startsBefore);
        if (found == segments_.end() || startsBefore(wanted, *found)) return segments_.size();
        return static_cast<std::size_t>(found - segments_.begin());
    }
    [[nodiscard]] Eigen::Vector2d onMap(const Eigen::Vector2d& fine) const {
        const double step = geometry_.cell_m / static_cast<double>(kFiner);
        return {geometry_.centreX(0) + fine.x() * step, geometry_.centreY(0) - fine.y() * step};
    }
    static void add(Contour& line, const Eigen::Vector2d& vertex) {
        // A level that meets a corner of a triangle leaves segments without length.
        if (line.vertices.empty() || line.vertices.back() != vertex) line.vertices.push_back(vertex);
    }
    Contour follow(std::size_t first) {
        const std::int64_t k = segments_[first].level;
        Contour line{options_.base + static_cast<double>(k) * options_.interval,
                     k % options_.index_every == 0,
                     false,
                     {}};
        add(line, onMap(segments_[first].start));
        std::size_t i = first;
        do {
            taken_[i] = true;
            add(line, onMap(segments_[i].end));
            i = after(segments_[i]);
        } while (i < segments_.size() && !taken_[i]);
        line.closed = i == first;
        return line;
    }

    std::vector<Segment> segments_;
    const GridGeometry& geometry_;
    const ContourOptions& options_;
    std::vector<bool> taken_;
    std::vector<bool> has_before_;
};

Result<void> checkOptions(const ElevationGrid& heights, const ContourOptions& options) {
    if (!(options.interval > 0.0) || !std::isfinite(options.interval) || !std::isfinite(options.base)) {
        return usageError("the interval between contours must be above zero");
    }
    if (!(options.smoothing_cells >= 0.0) || options.smoothing_cells > 100.0) {
        return usageError("contours can be smoothed over 0 to 100 cells");
    }
    double low = HUGE_VAL, high = -HUGE_VAL;
    for (const float height : heights.heights_m) {
        if (std::isnan(height)) continue;
        low = std::min(low, double{height});
        high = std::max(high, double{height});
    }
    if ((high - low) / options.interval > kMostLevels) {
        return usageError(
            fmt::format("heights from {} to {} make more than {} levels", low, high, kMostLevels),
            "choose a larger interval");
    }
    return {};
}

double rmsDifference(const ElevationGrid& a, const ElevationGrid& b) {
    double sum = 0.0;
    std::size_t n = 0;
    for (std::size_t i = 0; i < a.heights_m.size(); ++i) {
        if (std::isnan(a.heights_m[i])) continue;
        const double d = double{a.heights_m[i]} - double{b.heights_m[i]};
        sum += d * d;
        ++n;
    }
    return n == 0 ? 0.0 : std::sqrt(sum / static_cast<double>(n));
}

}  // namespace

double contourMemory_bytes(const ElevationGrid& heights, const ContourOptions& options) {
    // Heights smoothed once and twice, and the two halves of the smoothing.
    const double grid_bytes = options.sigmas == nullptr ? 16.0 : 20.0;
    // A line cuts some ten of the triangles within a cell (measured without smoothing; 4 with it); its pieces
    // exist twice while they are gathered, and then as vertices.
    constexpr double kPiecesPerCell = 10.0;
    constexpr double kBytesPerPiece = 2.0 * sizeof(Segment) + sizeof(Eigen::Vector2d);
    double crossings = 0.0;
    const GridGeometry& g = heights.geometry;
    for (std::size_t row = 0; row + 1 < g.rows; ++row) {
        for (std::size_t column = 0; column + 1 < g.columns; ++column) {
            const auto [low, high] =
                std::minmax({heights.at(row, column), heights.at(row, column + 1),
                             heights.at(row + 1, column), heights.at(row + 1, column + 1)});
            // Comparisons with NaN are false: such a cell has no line.
            if (high > low) crossings += (double{high} - double{low}) / options.interval;
        }
    }
    return grid_bytes * static_cast<double>(g.size()) + kPiecesPerCell * kBytesPerPiece * crossings;
}

Result<ElevationGrid> gaussianSmoothed(const ElevationGrid& heights, double sigma_cells,
                                       std::stop_token stop) {
    if (!(sigma_cells > 0.0)) return heights;
    const GridGeometry& g = heights.geometry;
    const auto reach = static_cast<std::ptrdiff_t>(std::ceil(3.0 * sigma_cells));
    std::vector<double> weights;
    for (std::ptrdiff_t i = -reach; i <= reach; ++i) {
        const double share = static_cast<double>(i) / sigma_cells;
        weights.push_back(std::exp(-0.5 * share * share));
    }
    // Weight times height along rows, and the weight itself; then the same along columns.
    std::vector<float> sums(g.size(), 0.0F), parts(g.size(), 0.0F);
    parallelFor(g.rows, [&](std::size_t row) {
        if (stop.stop_requested()) return;
        const auto columns = static_cast<std::ptrdiff_t>(g.columns);
        for (std::ptrdiff_t c = 0; c < columns; ++c) {
            double sum = 0.0, part = 0.0;
            for (std::ptrdiff_t i = std::max<std::ptrdiff_t>(-reach, -c);
                 i <= std::min(reach, columns - 1 - c); ++i) {
                const double height = heights.at(row, static_cast<std::size_t>(c + i));
                if (std::isnan(height)) continue;
                const double weight = weights[static_cast<std::size_t>(i + reach)];
                sum += weight * height;
                part += weight;
            }
            sums[row * g.columns + static_cast<std::size_t>(c)] =
                static_cast<float>(part > 0.0 ? sum / part : 0.0);
            parts[row * g.columns + static_cast<std::size_t>(c)] = static_cast<float>(part);
        }
    });
    ElevationGrid smooth{g, std::vector<float>(g.size(), kNoHeight)};
    parallelFor(g.rows, [&](std::size_t row) {
        if (stop.stop_requested()) return;
        const auto r = static_cast<std::ptrdiff_t>(row);
        const auto rows = static_cast<std::ptrdiff_t>(g.rows);
        for (std::size_t column = 0; column < g.columns; ++column) {
            if (std::isnan(heights.at(row, column))) continue;
            double sum = 0.0, part = 0.0;
            for (std::ptrdiff_t i = std::max<std::ptrdiff_t>(-reach, -r); i <= std::min(reach, rows - 1 - r);
                 ++i) {
                const std::size_t cell = static_cast<std::size_t>(r + i) * g.columns + column;
                const double weight = weights[static_cast<std::size_t>(i + reach)] * double{parts[cell]};
                sum += weight * double{sums[cell]};
                part += weight;
            }
            smooth.heights_m[row * g.columns + column] = static_cast<float>(sum / part);
        }
    });
    if (stop.stop_requested()) return cancelled();
    return smooth;
}

namespace {

/// A bilateral filter (Tomasi and Manduchi 1998): the mean of the heights around by a Gaussian of their
/// distance and by Tukey's biweight of their difference. What lies beyond a step does not count.
Result<ElevationGrid> smoothedWithinErrors(const ElevationGrid& heights, const ElevationGrid& sigmas,
                                           const std::stop_token& stop) {
    constexpr float kAlikeErrors = 3.0F;  // heights that differ by more errors than this are of other ground
    assert(sigmas.geometry == heights.geometry);
    const GridGeometry& g = heights.geometry;
    const auto reach = static_cast<std::ptrdiff_t>(std::ceil(2.0 * kSmoothingInErrors_cells));
    std::vector<float> near;
    for (std::ptrdiff_t i = -reach; i <= reach; ++i) {
        const double share = static_cast<double>(i) / kSmoothingInErrors_cells;
        near.push_back(static_cast<float>(std::exp(-0.5 * share * share)));
    }
    ElevationGrid smooth = heights;
    parallelFor(g.rows, [&](std::size_t row) {
        if (stop.stop_requested()) return;
        const std::size_t first_row = row - std::min(row, static_cast<std::size_t>(reach));
        const std::size_t last_row = std::min(row + static_cast<std::size_t>(reach), g.rows - 1);
        for (std::size_t column = 0; column < g.columns; ++column) {
            const float here = heights.at(row, column), sigma = sigmas.at(row, column);
            if (std::isnan(here) || !(sigma > 0.0F)) continue;
            const float per_unit = 1.0F / (kAlikeErrors * sigma);
            const std::size_t first = column - std::min(column, static_cast<std::size_t>(reach));
            const std::size_t last = std::min(column + static_cast<std::size_t>(reach), g.columns - 1);
            double sum = 0.0, weights = 0.0;
            for (std::size_t r = first_row; r <= last_row; ++r) {
                float row_sum = 0.0F, row_weights = 0.0F;
                for (std::size_t c = first; c <= last; ++c) {
                    const float difference = heights.at(r, c) - here;
                    const float share = difference * per_unit;
                    const float alike = 1.0F - share * share;
                    // Comparisons with NaN are false: there is no height.
                    const float weight =
                        alike > 0.0F ? near[c + static_cast<std::size_t>(reach) - column] * alike * alike
                                     : 0.0F;
                    row_weights += weight;
                    row_sum += alike > 0.0F ? weight * difference : 0.0F;
                }
                const double weight = near[r + static_cast<std::size_t>(reach) - row];
                sum += weight * double{row_sum};
                weights += weight * double{row_weights};
            }
            const float moved = static_cast<float>(sum / weights);
            smooth.heights_m[row * g.columns + column] = here + std::clamp(moved, -sigma, sigma);
        }
    });
    if (stop.stop_requested()) return cancelled();
    return smooth;
}

Result<ElevationGrid> smoothedFor(const ElevationGrid& heights, const ContourOptions& options,
                                  const std::stop_token& stop) {
    if (options.sigmas == nullptr || options.smoothing_cells == 0.0) {
        return gaussianSmoothed(heights, options.smoothing_cells, stop);
    }
    const auto within = smoothedWithinErrors(heights, *options.sigmas, stop);
    return within ? gaussianSmoothed(*within, options.smoothing_cells, stop) : within;
}

}  // namespace

Result<ContourSet> contourLines(const ElevationGrid& heights, const ContourOptions& options,
                                Progress& progress, std::stop_token stop) {
    if (auto checked = checkOptions(heights, options); !checked) return tl::unexpected(checked.error());
    const GridGeometry& g = heights.geometry;
    if (g.rows < 2 || g.columns < 2) return ContourSet{};
    try {
        progress.report(0.0, "smoothing");
        const auto smoothed = smoothedFor(heights, options, stop);
        if (!smoothed) return tl::unexpected(smoothed.error());
        const ElevationGrid& smooth = *smoothed;
        std::vector<std::vector<Segment>> by_row(g.rows - 1);
        std::atomic<std::size_t> done{0};
        parallelRanges(g.rows - 1, kRowsAtOnce, [&](std::size_t begin, std::size_t end) {
            if (stop.stop_requested()) return;
            for (std::size_t row = begin; row < end; ++row) {
                cutRow(smooth, row, options, by_row[row]);
            }
            done += end - begin;
            progress.report(0.1 + 0.6 * static_cast<double>(done) / static_cast<double>(g.rows),
                            "cutting contours");
        });
        if (stop.stop_requested()) return cancelled();
        std::vector<Segment> segments;
        for (std::vector<Segment>& row : by_row) {
            if (stop.stop_requested()) return cancelled();
            segments.insert(segments.end(), row.begin(), row.end());
            std::vector<Segment>().swap(row);
        }
        progress.report(0.7, "joining contours");
        auto lines = Chainer(std::move(segments), g, options).chain(stop);
        if (!lines) return tl::unexpected(lines.error());
        progress.report(1.0, "contours");
        return ContourSet{std::move(*lines), rmsDifference(heights, smooth)};
    } catch (const std::bad_alloc&) {
        return systemError("not enough memory for so many contours", {},
                           "choose a larger interval or larger cells");
    }
}

}  // namespace terrawalk
