#pragma once

#include <QFutureWatcher>
#include <QWidget>
#include <memory>
#include <optional>

#include "app/gui/map_scene.hpp"
#include "app/gui/map_transform.hpp"
#include "app/gui/raster_picture.hpp"

namespace terrawalk::gui {

/// The map: wheel zooms about the cursor, drag or arrow keys pan, Home shows all.
class MapView : public QWidget {
    Q_OBJECT
  public:
    explicit MapView(QWidget* parent = nullptr);
    ~MapView() override;

    /// Shows a survey, and results where there are some; where the place is another, all of it comes in view.
    void show(std::shared_ptr<const SurveyMap> survey, std::shared_ptr<const Products> products);
    void setLayer(RasterLayer layer);
    void setColouring(TrackColouring colouring);
    void setRunVisible(const QString& run, bool visible);
    void setMarkVisible(const QString& mark, bool visible);
    void setEdgesVisible(bool visible);
    void highlight(const QString& run_or_mark);
    void fit();
    void centreOn(QPointF map_m);
    void zoomBy(double factor);

    [[nodiscard]] const MapScene& scene() const { return scene_; }
    [[nodiscard]] const MapTransform& transform() const { return transform_; }
    [[nodiscard]] RasterLayer layer() const { return layer_; }
    /// Whether the layer that was asked for is still being coloured.
    [[nodiscard]] bool colouringLayer() const { return watcher_.isRunning(); }

  Q_SIGNALS:
    /// What lies under the cursor; no height where there is no surface, nothing at all without a map.
    void hovered(const QString& readout);
    void layerShown();

  protected:
    void paintEvent(QPaintEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;
    void wheelEvent(QWheelEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void mouseReleaseEvent(QMouseEvent* event) override;
    void mouseDoubleClickEvent(QMouseEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    void leaveEvent(QEvent* event) override;

  private:
    void colourLayer();
    void toggle(QSet<QString>& hidden, const QString& name, bool visible);
    MapScene scene_;
    MapTransform transform_;
    RasterLayer layer_ = RasterLayer::Height;
    QFutureWatcher<std::shared_ptr<const RasterPicture>> watcher_;
    std::optional<QPointF> dragged_from_;
    bool fitted_ = false;  ///< until a person moves the map, it keeps showing all
};

/// Coordinates, height and sigma of a place, as the status line shows them.
[[nodiscard]] QString readout(const MapScene& scene, QPointF map_m);

}  // namespace terrawalk::gui
