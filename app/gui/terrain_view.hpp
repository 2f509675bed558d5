#pragma once

#include <QTimer>
#include <QWidget>
#include <memory>
#include <optional>

#include "app/gui/background.hpp"
#include "app/gui/map_scene.hpp"
#include "app/gui/selection.hpp"
#include "app/gui/terrain_canvas.hpp"
#include "app/gui/terrain_frame.hpp"

class QDoubleSpinBox;
class QSlider;
class QToolBar;

namespace terrawalk::gui {

class PointCard;

/// How the 3-D view draws: by graphics hardware where there is some. Where a processor would only imitate it,
/// the program's own rasteriser is several times faster. OpenGL that is asked for and not there is Software.
enum class TerrainRenderer { Automatic, OpenGl, Software };

/// The surface in three dimensions. Left drag turns, right or shift drag moves, the wheel comes nearer at the
/// cursor, a click tells of a place, a double click looks at it; arrow keys, plus, minus and Home do the
/// same.
class TerrainView : public QWidget {
    Q_OBJECT
  public:
    /// Both must outlive the view.
    TerrainView(ViewState& state, Selection& selection, TerrainRenderer renderer = TerrainRenderer::Automatic,
                QWidget* parent = nullptr);
    ~TerrainView() override;

    /// Shows a survey, and its surface where there are products; where the place is another, all comes in
    /// view.
    void show(std::shared_ptr<const Survey> survey, std::shared_ptr<const SurveyMap> map,
              std::shared_ptr<const Products> products);
    /// Heights times this much; between 0.5 and 20.
    void setExaggeration(double factor);
    /// Where the light comes from.
    /// @param azimuth_deg  clockwise from north
    /// @param height_deg   above the horizon, 5 to 90
    void setLight(double azimuth_deg, double height_deg);
    void viewFrom(ViewFrom side);
    /// The first view again.
    void resetView();
    void zoomBy(double factor);
    /// Tells of the place of the surface under a pixel of the picture, as a click there does.
    void pickAt(QPointF px);
    using QWidget::show;

    [[nodiscard]] const OrbitCamera& camera() const { return frame_.camera; }
    [[nodiscard]] const TerrainFrame& frame() const { return frame_; }
    [[nodiscard]] std::optional<Eigen::Vector3d> picked_map_m() const { return picked_map_m_; }
    /// Whether the surface is still being made ready.
    [[nodiscard]] bool building() const { return building_; }
    /// Nothing before the view was first shown with a surface.
    [[nodiscard]] TerrainCanvas* canvas() const { return canvas_.get(); }

  public Q_SLOTS:
    void themeChanged();

  Q_SIGNALS:
    void picked(QPointF map_m);
    /// What lies under the cursor, as the map tells it.
    void hovered(const QString& readout);
    void surfaceShown();
    /// After each picture.
    void drawn(qulonglong triangles, double ms, bool complete);

  protected:
    void paintEvent(QPaintEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;
    void showEvent(QShowEvent* event) override;
    void wheelEvent(QWheelEvent* event) override;
    void mousePressEvent(QMouseEvent* event) override;
    void mouseMoveEvent(QMouseEvent* event) override;
    void mouseReleaseEvent(QMouseEvent* event) override;
    void mouseDoubleClickEvent(QMouseEvent* event) override;
    void keyPressEvent(QKeyEvent* event) override;
    void leaveEvent(QEvent* event) override;

  private:
    /// What is made ready beside the window.
    struct Built {
        std::shared_ptr<const RasterPicture> picture;
        std::shared_ptr<const TerrainScene> scene;
        std::shared_ptr<const std::vector<Eigen::Vector3d>> points_map_m;
        std::shared_ptr<const SceneOverlay> overlay;
        MapScene overlay_of;  ///< what the overlay shows
        QPalette palette;
    };
    void makeToolBar();
    void build();
    void take(Built built);
    void ensureCanvas();
    void layOut();
    void fit();
    void renewOverlay();
    void chooseContours();
    void followState();
    void renew(bool moving);
    void paintFurniture(QPainter& painter);
    void hidePick();
    [[nodiscard]] std::optional<Eigen::Vector3d> sceneAt(QPointF px) const;
    [[nodiscard]] QPointF inPicture(QPointF px) const;
    [[nodiscard]] QRect pictureRect() const;

    ViewState& state_;
    Selection& selection_;
    TerrainRenderer renderer_;
    std::shared_ptr<const Survey> survey_;
    MapScene map_;
    std::shared_ptr<const std::vector<Eigen::Vector3d>> points_map_m_;
    Background<Built> scene_beside_{[this](Built built) {
        take(std::move(built));
    }};
    TerrainFrame frame_;
    std::unique_ptr<TerrainCanvas> canvas_;
    QWidget* furniture_ = nullptr;  ///< lies on the picture
    QToolBar* tools_ = nullptr;
    QDoubleSpinBox* exaggeration_ = nullptr;
    PointCard* card_ = nullptr;
    QTimer rest_;
    std::optional<Eigen::Vector3d> picked_map_m_;
    QPointF pressed_at_, last_at_;
    Qt::MouseButton held_ = Qt::NoButton;
    bool dragging_ = false;
    bool building_ = false;
    bool fitted_ = false;  ///< until a person moves the view, it keeps showing all
};

}  // namespace terrawalk::gui
