#pragma once

#include <QImage>
#include <QTemporaryDir>
#include <QTimer>
#include <QWidget>
#include <memory>
#include <vector>

#include "app/gui/background.hpp"
#include "app/pipeline/process.hpp"

class QAction;
class QLabel;
class QPrinter;
class QScrollArea;
class QToolBar;
class QVBoxLayout;

namespace terrawalk::gui {

/// The report as it will be on paper, the same file as `process` writes; printed and saved from here.
class ReportView : public QWidget {
    Q_OBJECT
  public:
    explicit ReportView(QWidget* parent = nullptr);
    void show(std::shared_ptr<const Survey> survey, std::shared_ptr<const Products> products);
    using QWidget::show;
    void themeChanged();
    /// Whether the report is being made or drawn.
    [[nodiscard]] bool preparing() const { return pages_beside_.running() || resized_.isActive(); }
    [[nodiscard]] std::size_t pages() const { return pages_.size(); }
    /// Empty before it is made.
    [[nodiscard]] const QString& file() const { return file_; }
    /// Errors: false with a reason in problem().
    bool saveTo(const QString& path);
    void print(QPrinter& printer);

  Q_SIGNALS:
    void failed(const QString& problem);
    void saved(const QString& path);

  protected:
    void showEvent(QShowEvent* event) override;
    void resizeEvent(QResizeEvent* event) override;

  private:
    struct Made {
        QString file;
        QString problem;
        std::vector<QImage> pages;
        int width_px = 0;  ///< of a page, in the window's pixels
        double pixel_ratio = 1.0;
    };
    void make();
    void draw();
    void take(const Made& made);
    [[nodiscard]] int pageWidth_px() const;
    static Made drawnPages(const QString& file, int width_px, double pixel_ratio);
    void layOut();
    void askAndSave();
    void askAndPrint();
    std::shared_ptr<const Survey> survey_;
    std::shared_ptr<const Products> products_;
    bool current_ = false;  ///< the pages are those of the products
    QTemporaryDir folder_;
    QString file_;
    std::vector<QImage> pages_;
    double pixel_ratio_ = 1.0;  ///< of the pages
    Background<Made> pages_beside_{[this](Made made) {
        take(made);
    }};
    QTimer resized_;
    QToolBar* bar_ = nullptr;
    QAction* save_ = nullptr;
    QAction* print_ = nullptr;
    QScrollArea* scroll_ = nullptr;
    QVBoxLayout* column_ = nullptr;
    QLabel* hint_ = nullptr;
};

}  // namespace terrawalk::gui
