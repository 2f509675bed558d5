#include "app/gui/software_rasteriser.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "survey/parallel.hpp"

namespace terrawalk::gui {

namespace {

constexpr int kBandRows = 32;

struct ScreenVertex {
    float x = 0, y = 0, z = 2;  ///< pixels, depth; beyond 1 where it lies behind the camera
    float level = 0;            ///< height in contour intervals
    float red = 0, green = 0, blue = 0;
};

struct Canvas {
    int width = 0, height = 0;
    std::vector<float> depth;
    QImage image;
    QRgb* pixels = nullptr;  ///< of the image, taken once: asking it again is no matter for many threads
    QRgb* line(int y) { return pixels + static_cast<std::ptrdiff_t>(y) * width; }
};

QRgb mixed(QRgb a, QRgb b, float share) {
    const auto part = [&](int from, int to) {
        return static_cast<int>(static_cast<float>(from) + share * static_cast<float>(to - from));
    };
    return qRgb(part(qRed(a), qRed(b)), part(qGreen(a), qGreen(b)), part(qBlue(a), qBlue(b)));
}

/// From scene to pixels of the canvas.
class Lens {
  public:
    Lens(const TerrainFrame& frame, int width, int height)
        : to_clip_(frame.camera.viewProjection().cast<float>()),
          eye_(frame.camera.eye_m().cast<float>()),
          exaggeration_(static_cast<float>(frame.exaggeration)),
          half_(static_cast<float>(width) / 2.0F, static_cast<float>(height) / 2.0F) {}

    [[nodiscard]] Eigen::Vector3f toScreen(Eigen::Vector3f at_m, bool lifted = false) const {
        at_m.z() *= exaggeration_;
        if (lifted) at_m += static_cast<float>(kOverlayLift) * (eye_ - at_m);
        const Eigen::Vector4f clip = to_clip_ * at_m.homogeneous();
        if (clip.w() <= 0.0F || clip.z() < -clip.w()) return {0.0F, 0.0F, 2.0F};
        return {(clip.x() / clip.w() + 1.0F) * half_.x(), (1.0F - clip.y() / clip.w()) * half_.y(),
                clip.z() / clip.w()};
    }

  private:
    Eigen::Matrix4f to_clip_;
    Eigen::Vector3f eye_;
    float exaggeration_;
    Eigen::Vector2f half_;
};

class Shader {
  public:
    explicit Shader(const TerrainFrame& frame)
        : light_(frame.to_light.cast<float>()),
          exaggeration_(static_cast<float>(frame.exaggeration)),
          interval_m_(frame.contour_interval_m),
          floor_m_(frame.scene->origin_map_m().z()),
          wall_{static_cast<float>(frame.wall.red()), static_cast<float>(frame.wall.green()),
                static_cast<float>(frame.wall.blue())} {}

    [[nodiscard]] ScreenVertex operator()(const TerrainVertex& v, const Lens& lens) const {
        const Eigen::Vector3f at = lens.toScreen({v.at_m[0], v.at_m[1], v.at_m[2]});
        const bool wall = v.wall != 0;
        Eigen::Vector3f normal(v.facing[0], v.facing[1], 0.0F);
        if (!wall) {
            normal *= -exaggeration_;
            normal.z() = 1.0F;
        }
        const auto bright =
            static_cast<float>(shade(static_cast<double>(normal.normalized().dot(light_)), wall));
        ScreenVertex s{at.x(), at.y(), at.z(), 0, 0, 0, 0};
        s.level = interval_m_ > 0.0 && !wall
                      ? static_cast<float>((static_cast<double>(v.at_m[2]) + floor_m_) / interval_m_)
                      : std::numeric_limits<float>::quiet_NaN();
        const Eigen::Vector3f own(v.colour[0], v.colour[1], v.colour[2]);
        const Eigen::Vector3f tint = bright * (wall ? wall_ : own);
        s.red = std::min(tint.x(), 255.0F);
        s.green = std::min(tint.y(), 255.0F);
        s.blue = std::min(tint.z(), 255.0F);
        return s;
    }

  private:
    Eigen::Vector3f light_;
    float exaggeration_;
    double interval_m_, floor_m_;
    Eigen::Vector3f wall_;
};

/// A value over the pixels of a triangle: value + x dx + y dy, from its first corner.
struct Plane {
    float value, dx, dy;
    [[nodiscard]] float at(float x, float y) const { return value + dx * x + dy * y; }
};

class TriangleSetup {
  public:
    TriangleSetup(const ScreenVertex& a, const ScreenVertex& b, const ScreenVertex& c) {
        bx_ = b.x - a.x, by_ = b.y - a.y, cx_ = c.x - a.x, cy_ = c.y - a.y;
        area_ = bx_ * cy_ - by_ * cx_;
    }
    [[nodiscard]] float area() const { return area_; }
    [[nodiscard]] Plane plane(float va, float vb, float vc) const {
        const float b = vb - va, c = vc - va;
        const float dx = (b * cy_ - c * by_) / area_, dy = (c * bx_ - b * cx_) / area_;
        return {va, dx, dy};
    }

  private:
    float bx_, by_, cx_, cy_, area_;
};

/// How much of a pixel a contour covers: thin lines, every fifth a bolder one, none where they would flow
/// together.
float contourCover(float level, float per_px, float line_px) {
    const float nearest = std::round(level);
    const bool bold = std::fmod(std::abs(nearest), 5.0F) < 0.5F;
    const float crowd = bold ? per_px / 5.0F : per_px;
    const float away_px = std::abs(level - nearest) / std::max(per_px, 1e-9F);
    const float cover = std::clamp(line_px * (bold ? 0.9F : 0.5F) + 0.5F - away_px, 0.0F, 1.0F);
    return cover * std::clamp((0.4F - crowd) / 0.2F, 0.0F, 1.0F);
}

void fill(Canvas& canvas, const ScreenVertex& a, const ScreenVertex& b, const ScreenVertex& c, int first_row,
          int end_row, float line_px) {
    if (a.z > 1.0F || b.z > 1.0F || c.z > 1.0F) return;
    const auto row = [&](float y) {
        return std::clamp(y, static_cast<float>(first_row), static_cast<float>(end_row)) - 0.5F;
    };
    const int top = static_cast<int>(std::ceil(row(std::min({a.y, b.y, c.y}))));
    const int bottom = static_cast<int>(std::ceil(row(std::max({a.y, b.y, c.y})))) - 1;
    if (top > bottom) return;
    const TriangleSetup setup(a, b, c);
    if (std::abs(setup.area()) < 1e-6F) return;
    const Plane z = setup.plane(a.z, b.z, c.z), red = setup.plane(a.red, b.red, c.red),
                green = setup.plane(a.green, b.green, c.green), blue = setup.plane(a.blue, b.blue, c.blue),
                level = setup.plane(a.level, b.level, c.level);
    const bool contours = !std::isnan(level.value);
    const float level_per_px = contours ? std::hypot(level.dx, level.dy) : 0.0F;
    const float nearest = std::min({a.z, b.z, c.z}), farthest = std::max({a.z, b.z, c.z});
    const ScreenVertex* corners[3] = {&a, &b, &c};
    for (int y = top; y <= bottom; ++y) {
        const float middle = static_cast<float>(y) + 0.5F, down = middle - a.y;
        float left = HUGE_VALF, right = -HUGE_VALF;
        for (int k = 0; k < 3; ++k) {
            const ScreenVertex &p = *corners[k], &q = *corners[(k + 1) % 3];
            if ((p.y <= middle) == (q.y <= middle)) continue;
            const float x = p.x + (middle - p.y) / (q.y - p.y) * (q.x - p.x);
            left = std::min(left, x);
            right = std::max(right, x);
        }
        if (!(left < right)) continue;
        // Clamped as they are: far beyond the screen they fit no whole number.
        const float last = static_cast<float>(canvas.width);
        const int begin = static_cast<int>(std::ceil(std::clamp(left, 0.0F, last) - 0.5F));
        const int end = static_cast<int>(std::ceil(std::clamp(right, 0.0F, last) - 0.5F)) - 1;
        float* depth = canvas.depth.data() + static_cast<std::ptrdiff_t>(y) * canvas.width;
        QRgb* pixels = canvas.line(y);
        for (int x = begin; x <= end; ++x) {
            const float at = static_cast<float>(x) + 0.5F - a.x;
            // Of a sliver the plane is not well known.
            const float deep = std::clamp(z.at(at, down), nearest, farthest);
            if (deep >= depth[x]) continue;
            depth[x] = deep;
            float dim = 1.0F;
            if (contours) dim -= 0.35F * contourCover(level.at(at, down), level_per_px, line_px);
            const auto byte = [&](const Plane& p) {
                return static_cast<int>(std::clamp(p.at(at, down), 0.0F, 255.0F) * dim);
            };
            pixels[x] = qRgb(byte(red), byte(green), byte(blue));
        }
    }
}

/// A round spot, where nothing is nearer.
void stamp(Canvas& canvas, const Eigen::Vector3f& at, float radius_px, QRgb colour) {
    const int top = std::max(0, static_cast<int>(std::floor(at.y() - radius_px)));
    const int bottom = std::min(canvas.height - 1, static_cast<int>(std::ceil(at.y() + radius_px)));
    const int left = std::max(0, static_cast<int>(std::floor(at.x() - radius_px)));
    const int right = std::min(canvas.width - 1, static_cast<int>(std::ceil(at.x() + radius_px)));
    for (int y = top; y <= bottom; ++y) {
        for (int x = left; x <= right; ++x) {
            const float away =
                std::hypot(static_cast<float>(x) + 0.5F - at.x(), static_cast<float>(y) + 0.5F - at.y());
            if (away > radius_px ||
                at.z() > canvas.depth[static_cast<std::size_t>(y) * static_cast<std::size_t>(canvas.width) +
                                      static_cast<std::size_t>(x)]) {
                continue;
            }
            canvas.line(y)[x] = colour;
        }
    }
}

void drawLine(Canvas& canvas, const SceneLine& line, const Lens& lens, int scale) {
    const float radius = std::max(0.5F, line.width_px * static_cast<float>(scale) / 2.0F);
    const bool edged = qAlpha(line.edge) > 0;
    for (const bool edge : {true, false}) {
        if (edge && !edged) continue;
        const float own = edge ? radius + kLineEdge_px * static_cast<float>(scale) : radius;
        for (std::size_t i = 1; i < line.at_m.size(); ++i) {
            const Eigen::Vector3f from = lens.toScreen(line.at_m[i - 1], line.on_ground);
            const Eigen::Vector3f to = lens.toScreen(line.at_m[i], line.on_ground);
            if (from.z() > 1.0F || to.z() > 1.0F) continue;
            const float length = (to - from).head<2>().norm();
            // A line that starts far off the screen is not worth a walk to it.
            if (length > 4.0F * static_cast<float>(canvas.width + canvas.height)) continue;
            const int steps = std::max(1, static_cast<int>(std::ceil(length / std::max(0.7F, own * 0.6F))));
            for (int s = 0; s < steps; ++s) {
                const float share = static_cast<float>(s) / static_cast<float>(steps);
                const QRgb colour = edge ? line.edge : line.colours[i];
                stamp(canvas, from + share * (to - from), own, colour);
            }
        }
    }
}

void drawSky(Canvas& canvas, const TerrainFrame& frame) {
    for (int y = 0; y < canvas.height; ++y) {
        const float share = static_cast<float>(y) / static_cast<float>(canvas.height);
        std::fill_n(canvas.line(y), canvas.width, mixed(frame.sky_above.rgb(), frame.sky_below.rgb(), share));
    }
}

void drawGround(Canvas& canvas, const TerrainFrame& frame, const std::vector<BlockStore::Ready>& blocks,
                const Lens& lens, int scale) {
    const Shader shader(frame);
    std::vector<std::vector<ScreenVertex>> seen(blocks.size());
    parallelFor(blocks.size(), [&](std::size_t i) {
        seen[i].reserve(blocks[i].block->vertices.size());
        for (const TerrainVertex& v : blocks[i].block->vertices) seen[i].push_back(shader(v, lens));
    });
    // Bands share no pixel, so they need no order among themselves.
    struct Span {
        float top, bottom;
    };
    std::vector<Span> spans(blocks.size(), {HUGE_VALF, -HUGE_VALF});
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        for (const ScreenVertex& v : seen[i]) {
            if (v.z > 1.0F) continue;
            spans[i] = {std::min(spans[i].top, v.y), std::max(spans[i].bottom, v.y)};
        }
    }
    const float line_px = static_cast<float>(scale);
    const auto bands = static_cast<std::size_t>((canvas.height + kBandRows - 1) / kBandRows);
    parallelFor(bands, [&](std::size_t band) {
        const int row = static_cast<int>(band) * kBandRows;
        const int end = std::min(row + kBandRows, canvas.height);
        for (std::size_t i = 0; i < blocks.size(); ++i) {
            if (spans[i].bottom < static_cast<float>(row) || spans[i].top > static_cast<float>(end)) continue;
            for (const auto& [a, b, c] : blocks[i].block->triangles) {
                fill(canvas, seen[i][a], seen[i][b], seen[i][c], row, end, line_px);
            }
        }
    });
}

}  // namespace

QImage rasterise(const TerrainFrame& frame, const std::vector<BlockStore::Ready>& blocks, QSize size_px,
                 int samples) {
    Canvas canvas{size_px.width() * samples, size_px.height() * samples, {}, {}, nullptr};
    canvas.image = QImage(canvas.width, canvas.height, QImage::Format_RGB32);
    canvas.pixels = reinterpret_cast<QRgb*>(canvas.image.bits());
    canvas.depth.assign(static_cast<std::size_t>(canvas.width) * static_cast<std::size_t>(canvas.height),
                        1.0F);
    drawSky(canvas, frame);
    const Lens lens(frame, canvas.width, canvas.height);
    if (frame.scene) drawGround(canvas, frame, blocks, lens, samples);
    if (frame.overlay) {
        for (const SceneLine& line : frame.overlay->lines) drawLine(canvas, line, lens, samples);
        const float radius = frame.dot_px * static_cast<float>(samples) / 2.0F;
        for (const SceneDot& dot : frame.overlay->dots) {
            const Eigen::Vector3f at = lens.toScreen(dot.at_m, true);
            if (at.z() <= 1.0F) stamp(canvas, at, radius, dot.colour);
        }
    }
    if (samples == 1) return canvas.image;
    return canvas.image.scaled(size_px, Qt::IgnoreAspectRatio, Qt::SmoothTransformation);
}

}  // namespace terrawalk::gui
