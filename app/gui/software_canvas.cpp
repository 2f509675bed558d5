#include <QElapsedTimer>
#include <QPainter>
#include <QPointer>

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

class SoftwareCanvas final : public TerrainCanvas {
  public:
    explicit SoftwareCanvas(QWidget* parent) : widget_(new SoftwareWidget(parent)) {
        widget_->setAttribute(Qt::WA_TransparentForMouseEvents);
        widget_->setAttribute(Qt::WA_OpaquePaintEvent);
        widget_->paint = [this](QPainter& painter) {
            paintOn(painter);
        };
    }
    ~SoftwareCanvas() override { delete widget_.data(); }
    QWidget* widget() override { return widget_; }
    void setFrame(const TerrainFrame& frame) override {
        if (frame.scene != frame_.scene) store_.clear();
        frame_ = frame;
        stale_ = true;
        widget_->update();
    }
    QImage picture() override {
        QImage image(widget_->size() * widget_->devicePixelRatio(), QImage::Format_RGB32);
        image.setDevicePixelRatio(widget_->devicePixelRatio());
        QPainter painter(&image);
        paintOn(painter);
        return image;
    }
    QString about() const override { return QStringLiteral("software"); }

  private:
    void paintOn(QPainter& painter) {
        const QSize size = widget_->size() * widget_->devicePixelRatio();
        if (stale_ || image_.size() != size) draw(size);
        painter.drawImage(widget_->rect(), image_);
    }
    void draw(QSize size) {
        QElapsedTimer timer;
        timer.start();
        std::vector<BlockStore::Ready> blocks;
        if (frame_.scene) {
            blocks =
                store_.ready(*frame_.scene,
                             frame_.scene->select(frame_.camera, frame_.exaggeration, budget()), kBuildTime);
        }
        std::size_t triangles = 0;
        for (const auto& block : blocks) triangles += block.block->triangles.size();
        image_ = rasterise(frame_, blocks, size, frame_.moving ? 1 : 2);
        stale_ = !frame_.scene ? false : !store_.complete();
        const double ms = static_cast<double>(timer.nsecsElapsed()) * 1e-6;
        if (frame_.moving) moving_.took(triangles, ms);
        if (stale_) widget_->update();
        if (drawn) drawn(triangles, ms, !stale_);
    }
    [[nodiscard]] std::size_t budget() const {
        return frame_.moving ? moving_.triangles() : 4 * moving_.triangles();
    }

    QPointer<SoftwareWidget> widget_;
    TerrainFrame frame_;
    BlockStore store_;
    FrameBudget moving_{40.0};
    QImage image_;
    bool stale_ = true;
};

}  // namespace

std::unique_ptr<TerrainCanvas> makeSoftwareCanvas(QWidget* parent) {
    return std::make_unique<SoftwareCanvas>(parent);
}

}  // namespace terrawalk::gui
