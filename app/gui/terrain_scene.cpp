#include "app/gui/terrain_scene.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "app/pipeline/relief.hpp"

namespace terrawalk::gui {

namespace {

constexpr std::array<std::uint8_t, 3> kPlainGround{176, 178, 172};
// Of the height range, and of the extent: how far the floor lies below the lowest place.
constexpr double kFloorShareOfHeight = 0.12, kFloorShareOfExtent = 0.012;
// Skirts reach down as far as the coarser neighbour may lie below, on a slope of three.
constexpr double kSkirtSlope = 3.0;
// A cell is drawn as long as it is that large on the screen.
constexpr double kFinestCell_px = 1.3;
constexpr double kCoarsen = 1.35;
constexpr double kCoarsestCell_px = 400.0;

std::size_t blocksAlong(std::size_t cells) {
    return std::max<std::size_t>(1, (cells - 1 + TerrainScene::kBlockCells - 1) / TerrainScene::kBlockCells);
}

bool outside(const Eigen::Matrix4d& to_clip, const Eigen::Vector3d& middle_m, const Eigen::Vector3d& half_m) {
    const Eigen::Vector4d m = to_clip * middle_m.homogeneous();
    for (int axis = 0; axis < 3; ++axis) {
        for (const double sign : {1.0, -1.0}) {
            // The farthest corner of the box along the inward normal of a plane of the frustum.
            const Eigen::RowVector4d plane = to_clip.row(3) - sign * to_clip.row(axis);
            const double reach = plane.head<3>().cwiseAbs().dot(half_m);
            if (m.w() - sign * m[axis] + reach < 0.0) return true;
        }
    }
    return false;
}

}  // namespace

/// The points of one block at one level, with a ring of its neighbours' around them. A point that is not
/// known is taken from the nearest cell that is, within half a step: the edge of the survey stays where it
/// is.
class TerrainScene::Sampler {
  public:
    Sampler(const TerrainScene& scene, const Extent& block, std::size_t step)
        : scene_(scene), g_(scene.products_->dem.geometry), step_(step) {
        rows_ = indices(block.first_row, g_.rows);
        columns_ = indices(block.first_column, g_.columns);
        cells_.reserve(rows_.size() * columns_.size());
        for (const std::ptrdiff_t row : rows_) {
            for (const std::ptrdiff_t column : columns_) cells_.push_back(cellNear(row, column));
        }
    }
    /// Points of the block itself; those of the ring are -1 and rows() or columns().
    [[nodiscard]] int rows() const { return static_cast<int>(rows_.size()) - 2; }
    [[nodiscard]] int columns() const { return static_cast<int>(columns_.size()) - 2; }
    [[nodiscard]] bool known(int i, int j) const { return cell(i, j) != kNone; }
    /// Whether triangles lie between four points: three of them are known.
    [[nodiscard]] bool covered(int i, int j) const {
        return int{known(i, j)} + int{known(i, j + 1)} + int{known(i + 1, j)} + int{known(i + 1, j + 1)} >= 3;
    }
    [[nodiscard]] TerrainVertex vertex(int i, int j) const {
        const std::size_t at = cell(i, j), row = at / g_.columns, column = at % g_.columns;
        const auto s = static_cast<std::ptrdiff_t>(step_);
        const auto r = static_cast<std::ptrdiff_t>(row), c = static_cast<std::ptrdiff_t>(column);
        TerrainVertex v;
        v.at_m = {static_cast<float>(g_.centreX(column) - scene_.origin_map_m_.x()),
                  static_cast<float>(g_.centreY(row) - scene_.origin_map_m_.y()),
                  static_cast<float>(heightOf(r, c) - scene_.origin_map_m_.z())};
        v.facing = {slope(r, c - s, r, c + s, at), slope(r + s, c, r - s, c, at)};
        v.colour = scene_.colourOf(row, column);
        return v;
    }

  private:
    static constexpr std::size_t kNone = static_cast<std::size_t>(-1);

    std::vector<std::ptrdiff_t> indices(std::size_t first, std::size_t count) const {
        const auto step = static_cast<std::ptrdiff_t>(step_), end = static_cast<std::ptrdiff_t>(count) - 1;
        const auto begin = static_cast<std::ptrdiff_t>(first);
        const auto last = std::min(begin + static_cast<std::ptrdiff_t>(kBlockCells), end);
        std::vector<std::ptrdiff_t> list{begin - step};
        for (std::ptrdiff_t at = begin; at < last; at += step) list.push_back(at);
        list.push_back(last);
        list.push_back(last == end ? end + 1 : std::min(last + step, end));
        return list;
    }
    [[nodiscard]] std::size_t cell(int i, int j) const {
        return cells_[static_cast<std::size_t>(i + 1) * columns_.size() + static_cast<std::size_t>(j + 1)];
    }
    [[nodiscard]] bool inside(std::ptrdiff_t row, std::ptrdiff_t column) const {
        return row >= 0 && column >= 0 && row < static_cast<std::ptrdiff_t>(g_.rows) &&
               column < static_cast<std::ptrdiff_t>(g_.columns);
    }
    [[nodiscard]] double heightOf(std::ptrdiff_t row, std::ptrdiff_t column) const {
        return static_cast<double>(
            scene_.products_->dem
                .heights_m[static_cast<std::size_t>(row) * g_.columns + static_cast<std::size_t>(column)]);
    }
    [[nodiscard]] std::size_t cellNear(std::ptrdiff_t row, std::ptrdiff_t column) const {
        if (!inside(row, column)) return kNone;
        const auto index = [&](std::ptrdiff_t r, std::ptrdiff_t c) {
            return static_cast<std::size_t>(r) * g_.columns + static_cast<std::size_t>(c);
        };
        if (!std::isnan(heightOf(row, column))) return index(row, column);
        const auto reach = static_cast<std::ptrdiff_t>(step_ / 2);
        std::size_t best = kNone;
        std::ptrdiff_t least = 2 * reach * reach + 1;
        for (std::ptrdiff_t r = row - reach; r <= row + reach; ++r) {
            for (std::ptrdiff_t c = column - reach; c <= column + reach; ++c) {
                const std::ptrdiff_t far = (r - row) * (r - row) + (c - column) * (c - column);
                if (far >= least || !inside(r, c) || std::isnan(heightOf(r, c))) continue;
                least = far;
                best = index(r, c);
            }
        }
        return best;
    }
    /// Rise over run from one cell to another; one that is not known counts as the middle one.
    [[nodiscard]] float slope(std::ptrdiff_t r0, std::ptrdiff_t c0, std::ptrdiff_t r1, std::ptrdiff_t c1,
                              std::size_t middle) const {
        const double own = static_cast<double>(scene_.products_->dem.heights_m[middle]);
        int steps = 0;
        const auto height = [&](std::ptrdiff_t r, std::ptrdiff_t c) {
            if (!inside(r, c) || std::isnan(heightOf(r, c))) return own;
            ++steps;
            return heightOf(r, c);
        };
        const double rise = height(r1, c1) - height(r0, c0);
        if (steps == 0) return 0.0F;
        return static_cast<float>(rise / (steps * static_cast<double>(step_) * g_.cell_m));
    }

    const TerrainScene& scene_;
    const GridGeometry& g_;
    std::size_t step_;
    std::vector<std::ptrdiff_t> rows_, columns_;
    std::vector<std::size_t> cells_;
};

namespace {

/// Collects the triangles of one block.
class BlockBuilder {
  public:
    explicit BlockBuilder(float skirt_m) : skirt_m_(skirt_m) {}
    std::uint32_t add(const TerrainVertex& vertex) {
        block.vertices.push_back(vertex);
        return static_cast<std::uint32_t>(block.vertices.size() - 1);
    }
    void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) { block.triangles.push_back({a, b, c}); }

    /// Down from an edge, which runs counter-clockwise about the ground, to the floor.
    void wall(std::uint32_t from, std::uint32_t to) {
        TerrainVertex a = block.vertices[from], b = block.vertices[to];
        const float east = b.at_m[0] - a.at_m[0], north = b.at_m[1] - a.at_m[1];
        const float length = std::max(std::hypot(east, north), 1e-6F);
        a.facing = b.facing = {north / length, -east / length};
        a.wall = b.wall = 255;
        hang(a, b, a.at_m[2], b.at_m[2]);
    }
    /// The same, but no farther than a neighbour may lie below, and in the colours of the ground.
    void skirt(std::uint32_t from, std::uint32_t to) {
        hang(block.vertices[from], block.vertices[to], skirt_m_, skirt_m_);
    }
    TerrainBlock block;

  private:
    void hang(TerrainVertex a, TerrainVertex b, float down_a_m, float down_b_m) {
        const std::uint32_t upper_a = add(a), upper_b = add(b);
        a.at_m[2] = std::max(0.0F, a.at_m[2] - down_a_m);
        b.at_m[2] = std::max(0.0F, b.at_m[2] - down_b_m);
        const std::uint32_t lower_a = add(a), lower_b = add(b);
        triangle(upper_a, lower_a, lower_b);
        triangle(upper_a, lower_b, upper_b);
    }
    float skirt_m_;
};

}  // namespace

TerrainScene::TerrainScene(std::shared_ptr<const Products> products, const RasterPicture& picture)
    : products_(std::move(products)) {
    if (picture.layer == RasterLayer::Height) {
        height_legend_ = picture.legend;
    } else if (!picture.levels.empty()) {
        colours_ = picture.levels.front();
    }
    measure();
}

void TerrainScene::measure() {
    const ElevationGrid& dem = products_->dem;
    const GridGeometry& g = dem.geometry;
    Eigen::Vector3d least = Eigen::Vector3d::Constant(HUGE_VAL), greatest = -least;
    for (std::size_t top = 0, block_rows = blocksAlong(g.rows), i = 0; i < block_rows;
         ++i, top += kBlockCells) {
        for (std::size_t left = 0, across = blocksAlong(g.columns), j = 0; j < across;
             ++j, left += kBlockCells) {
            Extent block{top, left, 0, {}, {}};
            Eigen::Vector3d low = Eigen::Vector3d::Constant(HUGE_VAL), high = -low;
            for (std::size_t row = top; row <= std::min<std::size_t>(top + kBlockCells, g.rows - 1); ++row) {
                for (std::size_t c = left; c <= std::min<std::size_t>(left + kBlockCells, g.columns - 1);
                     ++c) {
                    if (std::isnan(dem.at(row, c))) continue;
                    ++block.known;
                    const Eigen::Vector3d at(g.centreX(c), g.centreY(row),
                                             static_cast<double>(dem.at(row, c)));
                    low = low.cwiseMin(at);
                    high = high.cwiseMax(at);
                }
            }
            if (block.known == 0) continue;
            least = least.cwiseMin(low);
            greatest = greatest.cwiseMax(high);
            block.middle_m = (low + high) / 2.0;
            block.half_m = (high - low) / 2.0;
            blocks_.push_back(block);
        }
    }
    if (blocks_.empty()) return;
    lowest_m_ = least.z();
    highest_m_ = greatest.z();
    const double extent_m = (greatest - least).head<2>().norm();
    const double floor_m =
        lowest_m_ - std::max(kFloorShareOfHeight * (highest_m_ - lowest_m_), kFloorShareOfExtent * extent_m);
    origin_map_m_ = {(least.x() + greatest.x()) / 2.0, (least.y() + greatest.y()) / 2.0, floor_m};
    half_size_m_ = {(greatest.x() - least.x()) / 2.0, (greatest.y() - least.y()) / 2.0, highest_m_ - floor_m};
    for (Extent& block : blocks_) {
        // From the floor up, since walls stand on it.
        const double top_m = block.middle_m.z() + block.half_m.z() - floor_m;
        block.middle_m = {block.middle_m.x() - origin_map_m_.x(), block.middle_m.y() - origin_map_m_.y(),
                          top_m / 2.0};
        block.half_m.z() = top_m / 2.0;
    }
}

std::vector<Eigen::Vector3d> TerrainScene::corners(double exaggeration) const {
    // Of the blocks, not of the whole: a survey seldom fills its rectangle.
    std::vector<Eigen::Vector3d> list;
    for (const Extent& block : blocks_) {
        for (int i = 0; i < 8; ++i) {
            const Eigen::Vector3d sign((i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1, (i & 4) != 0 ? 1 : -1);
            Eigen::Vector3d corner = block.middle_m + block.half_m.cwiseProduct(sign);
            corner.z() *= exaggeration;
            list.push_back(corner);
        }
    }
    return list;
}

Eigen::Vector3d TerrainScene::toScene(const Eigen::Vector3d& map_m, double exaggeration) const {
    Eigen::Vector3d at = map_m - origin_map_m_;
    at.z() *= exaggeration;
    return at;
}

Eigen::Vector3d TerrainScene::toMap(const Eigen::Vector3d& scene_m, double exaggeration) const {
    Eigen::Vector3d at = scene_m;
    at.z() /= exaggeration;
    return at + origin_map_m_;
}

std::array<std::uint8_t, 3> TerrainScene::colourOf(std::size_t row, std::size_t column) const {
    const auto bytes = [](const QColor& c) {
        return std::array{static_cast<std::uint8_t>(c.red()), static_cast<std::uint8_t>(c.green()),
                          static_cast<std::uint8_t>(c.blue())};
    };
    if (!height_legend_.ramp.empty()) {
        const auto& ramp = height_legend_.ramp;
        const double range_m = std::max(height_legend_.high - height_legend_.low, 1e-9);
        const double share = std::clamp(
            (static_cast<double>(products_->dem.at(row, column)) - height_legend_.low) / range_m, 0.0, 1.0);
        const double at = share * static_cast<double>(ramp.size() - 1);
        const auto lower = std::min(static_cast<std::size_t>(at), ramp.size() - 1);
        const auto a = bytes(ramp[lower]), b = bytes(ramp[std::min(lower + 1, ramp.size() - 1)]);
        const double part = at - static_cast<double>(lower);
        std::array<std::uint8_t, 3> mixed{};
        for (std::size_t i = 0; i < 3; ++i) {
            mixed[i] = static_cast<std::uint8_t>(std::lround(a[i] + part * (b[i] - a[i])));
        }
        return mixed;
    }
    if (colours_.isNull()) return kPlainGround;
    const QColor c = colours_.pixelColor(static_cast<int>(column), static_cast<int>(row));
    return c.alpha() == 0 ? kPlainGround : bytes(c);
}

std::optional<double> TerrainScene::heightAt(double x_map_m, double y_map_m) const {
    const ElevationGrid& dem = products_->dem;
    const GridGeometry& g = dem.geometry;
    const auto nearest = g.cellAt(x_map_m, y_map_m);
    if (!nearest || std::isnan(dem.heights_m[*nearest])) return std::nullopt;
    const double column = (x_map_m - g.west_m) / g.cell_m - 0.5, row = (g.north_m - y_map_m) / g.cell_m - 0.5;
    double sum = 0.0, weights = 0.0;
    for (int i = 0; i < 4; ++i) {
        const double r = std::floor(row) + (i & 1), c = std::floor(column) + (i >> 1);
        if (r < 0 || c < 0 || r >= static_cast<double>(g.rows) || c >= static_cast<double>(g.columns))
            continue;
        const auto height =
            static_cast<double>(dem.at(static_cast<std::size_t>(r), static_cast<std::size_t>(c)));
        if (std::isnan(height)) continue;
        const double weight = (1.0 - std::abs(row - r)) * (1.0 - std::abs(column - c));
        sum += weight * height;
        weights += weight;
    }
    return weights > 1e-12 ? sum / weights : static_cast<double>(dem.heights_m[*nearest]);
}

std::optional<Eigen::Vector3d> TerrainScene::firstHit(const SightLine& sight, double exaggeration,
                                                      double step_m) const {
    // The part of the line within the box of all that is known.
    double begin = 0.0, end = HUGE_VAL;
    const double cell_m = products_->dem.geometry.cell_m;
    const double top_m = half_size_m_.z() * exaggeration + cell_m;
    const Eigen::Vector3d low(-half_size_m_.x() - cell_m, -half_size_m_.y() - cell_m, 0.0);
    const Eigen::Vector3d high(half_size_m_.x() + cell_m, half_size_m_.y() + cell_m, top_m);
    for (int axis = 0; axis < 3; ++axis) {
        const double d = sight.direction[axis], from = sight.from_m[axis];
        if (std::abs(d) < 1e-12) {
            if (from < low[axis] || from > high[axis]) return std::nullopt;
            continue;
        }
        const double a = (low[axis] - from) / d, b = (high[axis] - from) / d;
        begin = std::max(begin, std::min(a, b));
        end = std::min(end, std::max(a, b));
    }
    if (!(begin < end)) return std::nullopt;
    const auto at = [&](double t) {
        return Eigen::Vector3d(sight.from_m + t * sight.direction);
    };
    const auto below = [&](double t) {
        const Eigen::Vector3d p = at(t);
        const auto height = heightAt(p.x() + origin_map_m_.x(), p.y() + origin_map_m_.y());
        return height && p.z() <= (*height - origin_map_m_.z()) * exaggeration;
    };
    const double step = std::max(0.5 * cell_m, step_m) / std::max(sight.direction.head<2>().norm(), 0.05);
    double last = begin;
    for (double t = begin; t <= end; t += step) {
        if (below(t)) {
            double clear = last, hit = t;
            for (int i = 0; i < 30; ++i) {
                const double middle = (clear + hit) / 2.0;
                (below(middle) ? hit : clear) = middle;
            }
            return at(hit);
        }
        last = t;
    }
    return below(end) ? std::optional(at(end)) : std::nullopt;
}

TerrainBlock TerrainScene::build(BlockLevel which) const {
    const std::size_t step = std::size_t{1} << which.level;
    const Sampler points(*this, blocks_[which.block], step);
    BlockBuilder builder(
        static_cast<float>(kSkirtSlope * static_cast<double>(step) * products_->dem.geometry.cell_m));
    constexpr std::uint32_t kNone = static_cast<std::uint32_t>(-1);
    std::vector<std::uint32_t> ids(static_cast<std::size_t>(points.rows() * points.columns()), kNone);
    const auto id = [&](int i, int j) -> std::uint32_t& {
        return ids[static_cast<std::size_t>(i * points.columns() + j)];
    };
    for (int i = 0; i < points.rows(); ++i) {
        for (int j = 0; j < points.columns(); ++j) {
            if (points.known(i, j)) id(i, j) = builder.add(points.vertex(i, j));
        }
    }
    const auto side = [&](std::uint32_t from, std::uint32_t to, int i, int j) {
        if (from == kNone || to == kNone) return;
        const bool own = i >= 0 && j >= 0 && i + 1 < points.rows() && j + 1 < points.columns();
        if (!points.covered(i, j)) {
            builder.wall(from, to);
        } else if (!own) {
            builder.skirt(from, to);
        }
    };
    for (int i = 0; i + 1 < points.rows(); ++i) {
        for (int j = 0; j + 1 < points.columns(); ++j) {
            if (!points.covered(i, j)) continue;
            const std::array<std::uint32_t, 4> ring{id(i, j), id(i + 1, j), id(i + 1, j + 1), id(i, j + 1)};
            const auto hole = std::find(ring.begin(), ring.end(), kNone);
            if (hole != ring.end()) {
                const auto k = static_cast<std::size_t>(hole - ring.begin());
                const std::uint32_t a = ring[(k + 1) % 4], b = ring[(k + 2) % 4], c = ring[(k + 3) % 4];
                builder.triangle(a, b, c);
                builder.wall(c, a);
            } else {
                // Along the diagonal that climbs less, so that risers of terraces stay straight.
                const auto height = [&](std::size_t k) {
                    return builder.block.vertices[ring[k]].at_m[2];
                };
                const std::size_t k =
                    std::abs(height(0) - height(2)) <= std::abs(height(1) - height(3)) ? 0 : 1;
                builder.triangle(ring[k], ring[k + 1], ring[k + 2]);
                builder.triangle(ring[k], ring[k + 2], ring[(k + 3) % 4]);
            }
            side(ring[0], ring[1], i, j - 1);
            side(ring[1], ring[2], i + 1, j);
            side(ring[2], ring[3], i, j + 1);
            side(ring[3], ring[0], i - 1, j);
        }
    }
    return std::move(builder.block);
}

std::size_t TerrainScene::trianglesOf(BlockLevel which) const {
    const std::size_t quads = blocks_[which.block].known >> (2 * which.level);
    return 2 * quads + 8 * (kBlockCells >> which.level);
}

std::vector<BlockLevel> TerrainScene::select(const OrbitCamera& camera, double exaggeration,
                                             std::size_t budget) const {
    struct Seen {
        std::uint32_t block;
        double cell_px;
    };
    std::vector<Seen> seen;
    const Eigen::Matrix4d to_clip = camera.viewProjection();
    const Eigen::Vector3d eye = camera.eye_m(), stretch(1.0, 1.0, exaggeration);
    for (std::uint32_t i = 0; i < blocks_.size(); ++i) {
        const Eigen::Vector3d middle = blocks_[i].middle_m.cwiseProduct(stretch);
        const Eigen::Vector3d half = blocks_[i].half_m.cwiseProduct(stretch);
        if (outside(to_clip, middle, half)) continue;
        // To the nearest place of the box.
        const double away_m = ((eye - middle).cwiseAbs() - half).cwiseMax(0.0).norm();
        seen.push_back({i, camera.pixelsPerMetre(std::max(away_m, 1e-3)) * products_->dem.geometry.cell_m});
    }
    std::vector<BlockLevel> chosen;
    for (double finest_px = kFinestCell_px; finest_px < kCoarsestCell_px; finest_px *= kCoarsen) {
        chosen.clear();
        std::size_t triangles = 0;
        for (const Seen& s : seen) {
            const double level = std::floor(std::log2(std::max(finest_px / s.cell_px, 1.0)));
            chosen.push_back(
                {s.block, std::min(static_cast<std::uint32_t>(level), TerrainScene::kLevels - 1)});
            triangles += trianglesOf(chosen.back());
        }
        if (triangles <= budget) break;
    }
    return chosen;
}

}  // namespace terrawalk::gui
