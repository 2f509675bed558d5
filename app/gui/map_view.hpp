#pragma once

#include <QImage>
#include <QPalette>
#include <QWidget>
#include <memory>
#include <optional>

#include "app/gui/background.hpp"
#include "app/gui/map_scene.hpp"
#include "app/gui/map_transform.hpp"
#include "app/gui/raster_picture.hpp"

namespace terrawalk::gui {

/// What a press of the left button does.
enum class MapTool {
    Pan,            ///< drag moves the map, a click asks what is there
    SelectStretch,  ///< drag along a track
    SelectArea,     ///< drag a rectangle: all passes through it, beside the earlier ones with Shift
    Measure,        ///< clicks; lengths and area
    Profile,        ///< clicks; a double click or Enter ends the line
    HardLine,       ///< the same for what is drawn
    SoftLine,
    Boundary,
    Hole,
};

/// The map: wheel zooms about the cursor, drag or arrow keys pan, Home shows all. A tool that draws takes
/// clicks: Enter or a double click ends it, Backspace takes the last vertex back, Escape all of them. Without
/// a mouse: Space shows a cross, arrow keys move it (with Shift by a pixel), and Space clicks there; tools
/// that select by a drag take one click for each of its ends.
class MapView : public QWidget {
    Q_OBJECT
  public:
    /// Both must outlive the view.
    MapView(ViewState& state, Selection& selection, QWidget* parent = nullptr);

    /// Shows a survey, and results where there are some; where the place is another, all of it comes in view.
    void show(std::shared_ptr<const SurveyMap> survey, std::shared_ptr<const Products> products);
    void setTool(MapTool tool);
    void fit();
    void centreOn(QPointF map_m);
    void zoomBy(double factor);

    [[nodiscard]] const MapScene& scene() const { return scene_; }
    [[nodiscard]] const MapTransform& transform() const { return transform_; }
    [[nodiscard]] MapTool tool() const { return tool_; }
    /// Whether a part of the picture is still being made: the layer, contours, or the lines over it.
    [[nodiscard]] bool preparing() const;

  Q_SIGNALS:
    /// What lies under the cursor; no height where there is no surface, nothing at all without a map.
    void hovered(const QString& readout);
    void layerShown();
    void placeAsked(QPointF map_m);
    /// A finished line of a drawing tool, map metres; rings without their first vertex again.
    void lineDrawn(terrawalk::gui::MapTool tool, const QPolygonF& vertices_m);
    void toolChanged(terrawalk::gui::MapTool tool);

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
    void makeContours();
    [[nodiscard]] bool linesCurrent() const;
    [[nodiscard]] MarkNames placedNames() const;
    void paintLines(QPainter& painter, const MarkNames& names);
    void drawLinesBeside(const MarkNames& names);
    void followState();
    void followSelection();
    void moveBy(QPointF by_px);
    void click(QPointF screen_px);
    void startSelection(QPointF screen_px);
    void extendSelection(QPointF screen_px);
    void extendStretch(QPointF screen_px);
    void extendArea(QPointF screen_px);
    void pressKeyCursor();
    void moveKeyCursor(QPointF by_px);
    void showSketch(std::optional<QPointF> cursor_px);
    void finishLine();
    /// Contours, edges, points and tracks as they lie on the screen: thousands of smooth lines take longer
    /// than the window may be deaf.
    struct LinePicture {
        MapScene scene;
        MapTransform transform;
        QPalette palette;
        QImage image;
    };
    void takeLayer(std::shared_ptr<const RasterPicture> raster);
    void takeContours(std::shared_ptr<const std::vector<Contour>> contours);
    void takeLines(LinePicture lines);
    [[nodiscard]] bool selects() const {
        return tool_ == MapTool::SelectStretch || tool_ == MapTool::SelectArea;
    }
    [[nodiscard]] bool selecting() const { return stretch_from_ || area_from_m_; }
    [[nodiscard]] bool draws() const { return tool_ != MapTool::Pan && !selects(); }

    ViewState& state_;
    Selection& selection_;
    MapScene scene_;
    MapTransform transform_;
    MapTool tool_ = MapTool::Pan;
    Background<std::shared_ptr<const RasterPicture>> layer_beside_{
        [this](std::shared_ptr<const RasterPicture> raster) {
            takeLayer(std::move(raster));
        }};
    Background<std::shared_ptr<const std::vector<Contour>>> contours_beside_{
        [this](std::shared_ptr<const std::vector<Contour>> contours) {
            takeContours(std::move(contours));
        }};
    LinePicture lines_;
    Background<LinePicture> lines_beside_{[this](LinePicture lines) {
        takeLines(std::move(lines));
    }};
    std::optional<QPointF> pressed_at_;
    std::optional<QPointF> dragged_from_;
    std::optional<TrackHit> stretch_from_;
    std::optional<QPointF> area_from_m_;
    std::vector<TrackStretch> kept_;  ///< selected before this area
    std::optional<QPointF> key_cursor_m_;
    QPolygonF drawn_m_;
    bool fitted_ = false;  ///< until a person moves the map, it keeps showing all
};

/// Coordinates, height and sigma of a place, as the status line shows them.
[[nodiscard]] QString readout(const MapScene& scene, QPointF map_m);
/// Length of a line, and area of what it encloses where it has three vertices, in words.
[[nodiscard]] QString measureText(const QPolygonF& vertices_m, bool closed);
[[nodiscard]] bool drawsRing(MapTool tool);

}  // namespace terrawalk::gui
