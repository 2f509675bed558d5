#include <QElapsedTimer>
#include <QPainter>
#include <QPointer>
#include <cstdint>

#include "app/gui/background.hpp"
#include "app/gui/software_rasteriser.hpp"
#include "app/gui/terrain_canvas.hpp"

namespace terrawalk::gui {

namespace {

constexpr std::chrono::milliseconds kBuildTime{12};

class SoftwareWidget final : public QWidget {
  public:
    using QWidget::QWidget;
    std::function<void(QPainter&)> paint;

  protected:
    void paintEvent(QPaintEvent*) override {
        QPainter painter(this);
        if (paint) paint(painter);
    }
};

/// Pictures are made beside the window, the newest frame next; the last one stands until then.
class SoftwareCanvas final : public TerrainCanvas {
  public:
    explicit SoftwareCanvas(QWidget* parent) : widget_(new SoftwareWidget(parent)) {
        widget_->setAttribute(Qt::WA_TransparentForMouseEvents);
        widget_->setAttribute(Qt::WA_OpaquePaintEvent);
        widget_->paint = [this](QPainter& painter) {
            paintOn(painter);
        };
    }
    ~SoftwareCanvas() override {
        picture_beside_.wait();
        delete widget_.data();
    }
    QWidget* widget() override { return widget_; }
    void setFrame(const TerrainFrame& frame) override {
        frame_ = frame;
        ++wanted_;
        start();
    }
    QImage picture() override {
        picture_beside_.wait();
        Picture made = draw(frame_, size(), wanted_);
        while (!made.complete) made = draw(frame_, size(), wanted_);
        QImage image = made.image;
        image.setDevicePixelRatio(widget_->devicePixelRatio());
        return image;
    }
    QString about() const override { return QStringLiteral("software"); }

  private:
    struct Picture {
        QImage image;
        std::size_t triangles = 0;
        double ms = 0.0;
        bool complete = true;
        bool moving = false;
        std::uint64_t frame = 0;
    };

    [[nodiscard]] QSize size() const { return widget_->size() * widget_->devicePixelRatio(); }
    void paintOn(QPainter& painter) {
        if (image_.isNull()) {
            painter.fillRect(widget_->rect(), frame_.sky_below);
        } else {
            painter.drawImage(widget_->rect(), image_);
        }
        if (asked_for_ != size()) start();
    }
    void start() {
        if (picture_beside_.running() || size().isEmpty()) return;
        asked_for_ = size();
        picture_beside_.start([this, frame = frame_, size = asked_for_, number = wanted_] {
            return draw(frame, size, number);
        });
    }
    void take(const Picture& made) {
        image_ = made.image;
        if (made.moving) moving_.took(made.triangles, made.ms);
        widget_->update();
        if (drawn) drawn(made.triangles, made.ms, made.complete && made.frame == wanted_);
        if (!made.complete || made.frame != wanted_ || asked_for_ != size()) start();
    }
    /// By one thread at a time: the blocks are its own.
    Picture draw(const TerrainFrame& frame, QSize size, std::uint64_t number) {
        QElapsedTimer timer;
        timer.start();
        if (frame.scene != store_scene_) store_.clear();
        store_scene_ = frame.scene;
        Picture made;
        std::vector<BlockStore::Ready> blocks;
        if (frame.scene) {
            const std::size_t budget = (frame.moving ? 1 : 4) * moving_.triangles();
            blocks = store_.ready(*frame.scene, frame.scene->select(frame.camera, frame.exaggeration, budget),
                                  kBuildTime);
            made.complete = store_.complete();
        }
        for (const auto& block : blocks) made.triangles += block.block->triangles.size();
        made.image = rasterise(frame, blocks, size, frame.moving ? 1 : 2);
        made.ms = static_cast<double>(timer.nsecsElapsed()) * 1e-6;
        made.moving = frame.moving;
        made.frame = number;
        return made;
    }

    QPointer<SoftwareWidget> widget_;
    TerrainFrame frame_;
    std::uint64_t wanted_ = 0;  ///< number of the newest frame
    QSize asked_for_;
    QImage image_;
    FrameBudget moving_{40.0};
    BlockStore store_;
    std::shared_ptr<const TerrainScene> store_scene_;
    Background<Picture> picture_beside_{[this](Picture made) {
        take(made);
    }};
};

}  // namespace

std::unique_ptr<TerrainCanvas> makeSoftwareCanvas(QWidget* parent) {
    return std::make_unique<SoftwareCanvas>(parent);
}

}  // namespace terrawalk::gui
