#include <QElapsedTimer>
#include <QGuiApplication>
#include <QOffscreenSurface>
#include <QOpenGLContext>
#include <QOpenGLExtraFunctions>
#include <QOpenGLShaderProgram>
#include <QOpenGLWidget>
#include <QPointer>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>

#include "app/gui/terrain_canvas.hpp"

namespace terrawalk::gui {

namespace {

constexpr std::chrono::milliseconds kBuildTime{12};
constexpr int kSamples = 4;
constexpr const char* kSoftwareRenderers[] = {"llvmpipe", "softpipe", "swrast", "swiftshader",
                                              "basic render"};

QSurfaceFormat wantedFormat() {
    QSurfaceFormat format;
    format.setRenderableType(QSurfaceFormat::OpenGL);
    format.setVersion(3, 3);
    format.setProfile(QSurfaceFormat::CoreProfile);
    format.setDepthBufferSize(24);
    format.setSamples(kSamples);
    return format;
}

constexpr const char* kGroundVertex = R"(#version 330 core
layout(location = 0) in vec3 at_m;
layout(location = 1) in vec2 facing;
layout(location = 2) in vec4 colour;
uniform mat4 to_clip;
uniform float exaggeration;
out vec3 normal;
out vec4 tint;
out float height_m;
void main() {
    gl_Position = to_clip * vec4(at_m.xy, at_m.z * exaggeration, 1.0);
    normal = colour.a > 0.5 ? vec3(facing, 0.0) : normalize(vec3(-facing * exaggeration, 1.0));
    tint = colour;
    height_m = at_m.z;
}
)";
// The shading and the contours are those of the software rasteriser.
constexpr const char* kGroundFragment = R"(#version 330 core
in vec3 normal;
in vec4 tint;
in float height_m;
uniform vec3 to_light;
uniform vec3 wall;
uniform float interval_m;   // 0: no contours
uniform float floor_m;      // height of the floor, less whole multiples of five intervals
uniform float pixel;        // of the screen in those of the picture
out vec4 colour;
float cover(float level) {
    float nearest = round(level);
    bool bold = mod(abs(nearest), 5.0) < 0.5;
    float per_px = max(fwidth(level), 1e-9);
    float crowd = bold ? per_px / 5.0 : per_px;
    float away_px = abs(level - nearest) / per_px;
    float line = clamp(pixel * (bold ? 0.9 : 0.5) + 0.5 - away_px, 0.0, 1.0);
    return line * clamp((0.4 - crowd) / 0.2, 0.0, 1.0);
}
void main() {
    bool on_wall = tint.a > 0.5;
    float lit = max(dot(normalize(normal), to_light), 0.0);
    vec3 own = on_wall ? wall * (0.78 + 0.22 * lit) : tint.rgb * (0.48 + 0.66 * lit);
    if (interval_m > 0.0) {
        float line = cover((height_m + floor_m) / interval_m);
        if (!on_wall) own *= 1.0 - 0.35 * line;
    }
    colour = vec4(min(own, 1.0), 1.0);
}
)";

constexpr const char* kLineVertex = R"(#version 330 core
layout(location = 0) in vec3 at_m;
layout(location = 1) in vec3 other_m;
layout(location = 2) in vec4 colour;
layout(location = 3) in vec3 shape;   // side, half width, lifted
uniform mat4 to_clip;
uniform vec3 eye;
uniform float exaggeration;
uniform float lift;
uniform float pixel;
uniform vec2 half_viewport;
out vec4 tint;
vec4 place(vec3 at) {
    vec3 p = vec3(at.xy, at.z * exaggeration);
    return to_clip * vec4(p + shape.z * lift * (eye - p), 1.0);
}
void main() {
    vec4 own = place(at_m), far = place(other_m);
    vec2 along = far.xy / max(far.w, 1e-6) - own.xy / max(own.w, 1e-6);
    along *= half_viewport;
    float length_px = length(along);
    along = length_px > 1e-4 ? along / length_px : vec2(1.0, 0.0);
    float half_px = shape.y * pixel;
    vec2 off_px = vec2(-along.y, along.x) * shape.x * half_px - along * 0.5 * half_px;
    gl_Position = own + vec4(off_px / half_viewport * own.w, 0.0, 0.0);
    tint = colour;
}
)";
constexpr const char* kLineFragment = R"(#version 330 core
in vec4 tint;
out vec4 colour;
void main() { colour = tint; }
)";

constexpr const char* kDotVertex = R"(#version 330 core
layout(location = 0) in vec3 at_m;
layout(location = 1) in vec4 colour;
uniform mat4 to_clip;
uniform vec3 eye;
uniform float exaggeration;
uniform float lift;
uniform float size_px;
out vec4 tint;
void main() {
    vec3 p = vec3(at_m.xy, at_m.z * exaggeration);
    gl_Position = to_clip * vec4(p + lift * (eye - p), 1.0);
    gl_PointSize = size_px;
    tint = colour;
}
)";
constexpr const char* kDotFragment = R"(#version 330 core
in vec4 tint;
out vec4 colour;
void main() {
    float away = length(gl_PointCoord - vec2(0.5)) * 2.0;
    if (away > 1.0) discard;
    colour = tint;
}
)";

constexpr const char* kSkyVertex = R"(#version 330 core
out float height;
void main() {
    vec2 corner = vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0);
    height = corner.y * 0.5 + 0.5;
    gl_Position = vec4(corner, 0.0, 1.0);
}
)";
constexpr const char* kSkyFragment = R"(#version 330 core
in float height;
uniform vec3 above;
uniform vec3 below;
out vec4 colour;
void main() { colour = vec4(mix(below, above, height), 1.0); }
)";

struct LineVertex {
    std::array<float, 3> at_m, other_m;
    std::array<std::uint8_t, 4> colour;
    std::array<float, 3> shape;
};
struct DotVertex {
    std::array<float, 3> at_m;
    std::array<std::uint8_t, 4> colour;
};

std::array<std::uint8_t, 4> bytes(QRgb c) {
    return {static_cast<std::uint8_t>(qRed(c)), static_cast<std::uint8_t>(qGreen(c)),
            static_cast<std::uint8_t>(qBlue(c)), static_cast<std::uint8_t>(qAlpha(c))};
}

std::array<float, 3> floats(const Eigen::Vector3f& v) {
    return {v.x(), v.y(), v.z()};
}

QVector3D rgb(const QColor& c) {
    return {c.redF(), c.greenF(), c.blueF()};
}

QMatrix4x4 qt(const Eigen::Matrix4d& m) {
    QMatrix4x4 made;
    for (int row = 0; row < 4; ++row) {
        for (int column = 0; column < 4; ++column) made(row, column) = static_cast<float>(m(row, column));
    }
    return made;
}

QVector3D qt(const Eigen::Vector3d& v) {
    return {static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z())};
}

/// What the graphics hardware holds of one list of vertices.
struct HeldVertices {
    GLuint array = 0, vertices = 0, indices = 0;
    GLsizei count = 0;
};

std::vector<LineVertex> lineVertices(const SceneOverlay& overlay) {
    std::vector<LineVertex> list;
    const auto add = [&](const SceneLine& line, float width_px, auto colour) {
        for (std::size_t i = 1; i < line.at_m.size(); ++i) {
            const auto a = floats(line.at_m[i - 1]), b = floats(line.at_m[i]);
            const float half = width_px / 2.0F, lifted = line.on_ground ? 1.0F : 0.0F;
            const auto corner = [&](bool end, float side) {
                // Seen from its other end a line's sides are the other way round.
                return LineVertex{
                    end ? b : a, end ? a : b, bytes(colour(i)), {end ? -side : side, half, lifted}};
            };
            const LineVertex p = corner(false, -1), q = corner(false, 1), r = corner(true, -1),
                             s = corner(true, 1);
            list.insert(list.end(), {p, r, s, p, s, q});
        }
    };
    for (const SceneLine& line : overlay.lines) {
        // The edge of the whole line first, or each piece would lie on its neighbour's core.
        if (qAlpha(line.edge) > 0) {
            add(line, line.width_px + 2.0F * kLineEdge_px, [&](std::size_t) { return line.edge; });
        }
        add(line, line.width_px, [&](std::size_t i) { return line.colours[i]; });
    }
    return list;
}

class GlWidget final : public QOpenGLWidget, private QOpenGLExtraFunctions {
  public:
    explicit GlWidget(QWidget* parent, TerrainCanvas& canvas) : QOpenGLWidget(parent), canvas_(canvas) {
        setFormat(wantedFormat());
        setAttribute(Qt::WA_TransparentForMouseEvents);
    }
    ~GlWidget() override {
        if (context() == nullptr) return;
        disconnect(context(), nullptr, this, nullptr);
        makeCurrent();
        release();
        doneCurrent();
    }
    void setFrame(const TerrainFrame& frame) {
        if (frame.scene != frame_.scene) scene_changed_ = true;
        if (frame.overlay != frame_.overlay) overlay_changed_ = true;
        frame_ = frame;
        update();
    }

  protected:
    void initializeGL() override {
        initializeOpenGLFunctions();
        // A widget that moves to another window gets another context, and all of this anew.
        connect(
            context(), &QOpenGLContext::aboutToBeDestroyed, this,
            [this] {
                makeCurrent();
                release();
                doneCurrent();
            },
            Qt::DirectConnection);
        ground_ = program(kGroundVertex, kGroundFragment);
        line_ = program(kLineVertex, kLineFragment);
        dot_ = program(kDotVertex, kDotFragment);
        sky_ = program(kSkyVertex, kSkyFragment);
        glGenVertexArrays(1, &no_vertices_);
        scene_changed_ = overlay_changed_ = true;
    }

    void paintGL() override {
        QElapsedTimer timer;
        timer.start();
        if (scene_changed_) forgetScene();
        if (overlay_changed_) uploadOverlay();
        glClearColor(0.0F, 0.0F, 0.0F, 1.0F);
        glDisable(GL_BLEND);
        glDisable(GL_CULL_FACE);
        glDepthMask(GL_TRUE);
        glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        drawSky();
        glEnable(GL_DEPTH_TEST);
        glDepthFunc(GL_LESS);
        const std::size_t triangles = frame_.scene ? drawGround() : 0;
        if (frame_.overlay) drawOverlay();
        glDisable(GL_DEPTH_TEST);
        glBindVertexArray(0);
        if (frame_.moving) {
            glFinish();
            moving_.took(triangles, static_cast<double>(timer.nsecsElapsed()) * 1e-6);
        }
        const bool complete = !frame_.scene || store_.complete();
        if (!complete) update();
        if (canvas_.drawn)
            canvas_.drawn(triangles, static_cast<double>(timer.nsecsElapsed()) * 1e-6, complete);
    }

  private:
    std::unique_ptr<QOpenGLShaderProgram> program(const char* vertex, const char* fragment) {
        auto made = std::make_unique<QOpenGLShaderProgram>();
        made->addShaderFromSourceCode(QOpenGLShader::Vertex, vertex);
        made->addShaderFromSourceCode(QOpenGLShader::Fragment, fragment);
        made->link();
        return made;
    }

    void release(HeldVertices& b) {
        glDeleteVertexArrays(1, &b.array);
        glDeleteBuffers(1, &b.vertices);
        if (b.indices != 0) glDeleteBuffers(1, &b.indices);
        b = {};
    }
    void release() {
        forgetScene();
        release(lines_);
        release(dots_);
        glDeleteVertexArrays(1, &no_vertices_);
        ground_.reset();
        line_.reset();
        dot_.reset();
        sky_.reset();
    }
    void forgetScene() {
        for (auto& [which, buffers] : uploaded_) release(buffers);
        uploaded_.clear();
        store_.clear();
        scene_changed_ = false;
    }

    template <class Vertex>
    HeldVertices vertexBuffer(const std::vector<Vertex>& vertices) {
        HeldVertices b;
        glGenVertexArrays(1, &b.array);
        glBindVertexArray(b.array);
        glGenBuffers(1, &b.vertices);
        glBindBuffer(GL_ARRAY_BUFFER, b.vertices);
        glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices.size() * sizeof(Vertex)),
                     vertices.data(), GL_STATIC_DRAW);
        b.count = static_cast<GLsizei>(vertices.size());
        return b;
    }
    void attribute(GLuint place, GLint size, GLenum type, std::size_t stride, std::size_t offset) {
        glEnableVertexAttribArray(place);
        glVertexAttribPointer(place, size, type, type == GL_UNSIGNED_BYTE ? GL_TRUE : GL_FALSE,
                              static_cast<GLsizei>(stride), reinterpret_cast<const void*>(offset));
    }

    const HeldVertices& heldOf(const BlockStore::Ready& ready) {
        const auto [entry, fresh] = uploaded_.try_emplace(ready.which);
        if (!fresh) return entry->second;
        HeldVertices b = vertexBuffer(ready.block->vertices);
        attribute(0, 3, GL_FLOAT, sizeof(TerrainVertex), offsetof(TerrainVertex, at_m));
        attribute(1, 2, GL_FLOAT, sizeof(TerrainVertex), offsetof(TerrainVertex, facing));
        attribute(2, 4, GL_UNSIGNED_BYTE, sizeof(TerrainVertex), offsetof(TerrainVertex, colour));
        const auto& triangles = ready.block->triangles;
        glGenBuffers(1, &b.indices);
        glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, b.indices);
        glBufferData(GL_ELEMENT_ARRAY_BUFFER,
                     static_cast<GLsizeiptr>(triangles.size() * sizeof(triangles.front())), triangles.data(),
                     GL_STATIC_DRAW);
        b.count = static_cast<GLsizei>(3 * triangles.size());
        entry->second = b;
        return entry->second;
    }

    void drawSky() {
        glDisable(GL_DEPTH_TEST);
        sky_->bind();
        sky_->setUniformValue("above", rgb(frame_.sky_above));
        sky_->setUniformValue("below", rgb(frame_.sky_below));
        glBindVertexArray(no_vertices_);
        glDrawArrays(GL_TRIANGLES, 0, 3);
    }

    std::size_t drawGround() {
        const std::size_t budget = frame_.moving ? moving_.triangles() : 4 * moving_.triangles();
        const auto blocks = store_.ready(
            *frame_.scene, frame_.scene->select(frame_.camera, frame_.exaggeration, budget), kBuildTime);
        ground_->bind();
        ground_->setUniformValue("to_clip", qt(frame_.camera.viewProjection()));
        ground_->setUniformValue("exaggeration", static_cast<float>(frame_.exaggeration));
        ground_->setUniformValue("to_light", qt(frame_.to_light));
        ground_->setUniformValue("wall", rgb(frame_.wall));
        // On a processor contours cost too much of a frame that must be quick.
        const bool contours = !(frame_.moving && openGl() == OpenGlKind::Software);
        ground_->setUniformValue("interval_m",
                                 contours ? static_cast<float>(frame_.contour_interval_m) : 0.0F);
        const double whole_m = std::max(5.0 * frame_.contour_interval_m, 1e-9);
        ground_->setUniformValue("floor_m",
                                 static_cast<float>(std::fmod(frame_.scene->origin_map_m().z(), whole_m)));
        ground_->setUniformValue("pixel", static_cast<float>(devicePixelRatio()));
        std::size_t triangles = 0;
        for (const BlockStore::Ready& ready : blocks) {
            const HeldVertices& b = heldOf(ready);
            glBindVertexArray(b.array);
            glDrawElements(GL_TRIANGLES, b.count, GL_UNSIGNED_INT, nullptr);
            triangles += static_cast<std::size_t>(b.count) / 3;
        }
        // What the store forgot is of no use here either.
        for (auto entry = uploaded_.begin(); entry != uploaded_.end();) {
            const bool kept = store_.holds(entry->first);
            if (!kept) release(entry->second);
            entry = kept ? std::next(entry) : uploaded_.erase(entry);
        }
        return triangles;
    }

    void uploadOverlay() {
        overlay_changed_ = false;
        release(lines_);
        release(dots_);
        if (!frame_.overlay) return;
        lines_ = vertexBuffer(lineVertices(*frame_.overlay));
        attribute(0, 3, GL_FLOAT, sizeof(LineVertex), offsetof(LineVertex, at_m));
        attribute(1, 3, GL_FLOAT, sizeof(LineVertex), offsetof(LineVertex, other_m));
        attribute(2, 4, GL_UNSIGNED_BYTE, sizeof(LineVertex), offsetof(LineVertex, colour));
        attribute(3, 3, GL_FLOAT, sizeof(LineVertex), offsetof(LineVertex, shape));
        std::vector<DotVertex> dots;
        for (const SceneDot& dot : frame_.overlay->dots)
            dots.push_back({floats(dot.at_m), bytes(dot.colour)});
        dots_ = vertexBuffer(dots);
        attribute(0, 3, GL_FLOAT, sizeof(DotVertex), offsetof(DotVertex, at_m));
        attribute(1, 4, GL_UNSIGNED_BYTE, sizeof(DotVertex), offsetof(DotVertex, colour));
    }

    void setPlace(QOpenGLShaderProgram& program) {
        program.bind();
        program.setUniformValue("to_clip", qt(frame_.camera.viewProjection()));
        program.setUniformValue("eye", qt(frame_.camera.eye_m()));
        program.setUniformValue("exaggeration", static_cast<float>(frame_.exaggeration));
        program.setUniformValue("lift", static_cast<float>(kOverlayLift));
    }

    void drawOverlay() {
        const auto pixel = static_cast<float>(devicePixelRatio());
        glEnable(GL_BLEND);
        glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
        glDepthMask(GL_FALSE);
        if (lines_.count > 0) {
            setPlace(*line_);
            line_->setUniformValue("pixel", pixel);
            line_->setUniformValue("half_viewport", QVector2D(static_cast<float>(width()) * pixel / 2.0F,
                                                              static_cast<float>(height()) * pixel / 2.0F));
            glBindVertexArray(lines_.array);
            glDrawArrays(GL_TRIANGLES, 0, lines_.count);
        }
        glDepthMask(GL_TRUE);
        if (dots_.count > 0) {
            setPlace(*dot_);
            dot_->setUniformValue("size_px", frame_.dot_px * pixel);
            glEnable(GL_PROGRAM_POINT_SIZE);
            glBindVertexArray(dots_.array);
            glDrawArrays(GL_POINTS, 0, dots_.count);
        }
        glDisable(GL_BLEND);
    }

    TerrainCanvas& canvas_;
    TerrainFrame frame_;
    BlockStore store_;
    FrameBudget moving_{45.0};
    std::unique_ptr<QOpenGLShaderProgram> ground_, line_, dot_, sky_;
    std::map<BlockLevel, HeldVertices> uploaded_;
    HeldVertices lines_, dots_;
    GLuint no_vertices_ = 0;
    bool scene_changed_ = false, overlay_changed_ = false;
};

class OpenGlCanvas final : public TerrainCanvas {
  public:
    explicit OpenGlCanvas(QWidget* parent) : widget_(new GlWidget(parent, *this)) {}
    ~OpenGlCanvas() override { delete widget_.data(); }
    QWidget* widget() override { return widget_; }
    void setFrame(const TerrainFrame& frame) override { widget_->setFrame(frame); }
    QImage picture() override { return widget_->grabFramebuffer(); }
    QString about() const override { return QStringLiteral("OpenGL"); }

  private:
    QPointer<GlWidget> widget_;
};

/// Whether a processor does the work of the graphics hardware.
bool drawsInSoftware(QOpenGLContext& context) {
    const auto* name = reinterpret_cast<const char*>(context.functions()->glGetString(GL_RENDERER));
    const QString renderer = QString::fromLatin1(name).toLower();
    return std::any_of(std::begin(kSoftwareRenderers), std::end(kSoftwareRenderers),
                       [&](const char* known) { return renderer.contains(QLatin1String(known)); });
}

OpenGlKind tryOpenGl() {
    const QString platform = QGuiApplication::platformName();
    if (platform == "offscreen" || platform == "minimal" || platform.startsWith("linuxfb")) {
        return OpenGlKind::None;
    }
    QOpenGLContext context;
    context.setFormat(wantedFormat());
    if (!context.create() || context.format().version() < qMakePair(3, 3)) return OpenGlKind::None;
    QOffscreenSurface surface;
    surface.setFormat(context.format());
    surface.create();
    if (!surface.isValid() || !context.makeCurrent(&surface)) return OpenGlKind::None;
    QOpenGLShaderProgram trial;
    const bool works = trial.addShaderFromSourceCode(QOpenGLShader::Vertex, kGroundVertex) &&
                       trial.addShaderFromSourceCode(QOpenGLShader::Fragment, kGroundFragment) &&
                       trial.link();
    const bool software = works && drawsInSoftware(context);
    context.doneCurrent();
    return !works ? OpenGlKind::None : software ? OpenGlKind::Software : OpenGlKind::Hardware;
}

}  // namespace

OpenGlKind openGl() {
    static const OpenGlKind kind = tryOpenGl();
    return kind;
}

std::unique_ptr<TerrainCanvas> makeOpenGlCanvas(QWidget* parent) {
    return std::make_unique<OpenGlCanvas>(parent);
}

}  // namespace terrawalk::gui
