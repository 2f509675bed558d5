#include "app/gui/report_view.hpp"

#include <poppler/qt6/poppler-qt6.h>

#include <QAction>
#include <QFile>
#include <QFileDialog>
#include <QFileInfo>
#include <QLabel>
#include <QPainter>
#include <QPrintDialog>
#include <QPrinter>
#include <QSaveFile>
#include <QScrollArea>
#include <QScrollBar>
#include <QToolBar>
#include <QVBoxLayout>
#include <algorithm>

#include "app/gui/language.hpp"
#include "app/gui/recent_surveys.hpp"
#include "app/gui/report_words.hpp"
#include "app/gui/theme.hpp"

namespace terrawalk::gui {

namespace {

constexpr double kPrint_dpi = 300.0;
constexpr int kWidestPage_px = 900;
constexpr double kPoints_dpi = 72.0;

QImage drawn(Poppler::Document& document, int page, double dpi) {
    const std::unique_ptr<Poppler::Page> one = document.page(page);
    return one ? one->renderToImage(dpi, dpi) : QImage();
}

std::unique_ptr<Poppler::Document> opened(const QString& file) {
    auto document = Poppler::Document::load(file);
    if (document) {
        document->setRenderHint(Poppler::Document::Antialiasing);
        document->setRenderHint(Poppler::Document::TextAntialiasing);
    }
    return document;
}

}  // namespace

ReportView::ReportView(QWidget* parent) : QWidget(parent) {
    bar_ = new QToolBar(tr("Report"));
    bar_->setIconSize({18, 18});
    bar_->setToolButtonStyle(Qt::ToolButtonTextBesideIcon);
    save_ = bar_->addAction(tr("Save as PDF…"), this, &ReportView::askAndSave);
    print_ = bar_->addAction(tr("Print…"), this, &ReportView::askAndPrint);
    hint_ = new QLabel;
    hint_->setObjectName("quiet");
    hint_->setAlignment(Qt::AlignCenter);
    scroll_ = new QScrollArea;
    scroll_->setWidgetResizable(true);
    // A bar that comes with the pages would take the room they were drawn for.
    scroll_->setVerticalScrollBarPolicy(Qt::ScrollBarAlwaysOn);
    auto* layout = new QVBoxLayout(this);
    layout->setContentsMargins(0, 0, 0, 0);
    layout->setSpacing(0);
    layout->addWidget(bar_);
    layout->addWidget(hint_, 1);
    layout->addWidget(scroll_, 1);
    resized_.setSingleShot(true);
    resized_.setInterval(120);
    connect(&resized_, &QTimer::timeout, this, &ReportView::draw);
    themeChanged();
    show(nullptr, nullptr);
}

void ReportView::themeChanged() {
    save_->setIcon(icon("save"));
    print_->setIcon(icon("print"));
}

void ReportView::show(std::shared_ptr<const Survey> survey, std::shared_ptr<const Products> products) {
    survey_ = std::move(survey);
    products_ = std::move(products);
    current_ = false;
    pages_.clear();
    file_.clear();
    pages_beside_.drop();
    scroll_->verticalScrollBar()->setValue(0);
    layOut();
    if (isVisible()) make();
}

void ReportView::showEvent(QShowEvent*) {
    if (!current_) make();
}

void ReportView::make() {
    if (!products_) return;
    current_ = true;
    const QString file = folder_.filePath("report.pdf");
    pages_beside_.start([survey = survey_, products = products_, language = reportLanguage(), file,
                         width_px = pageWidth_px(), ratio = devicePixelRatioF()]() -> Made {
        if (const auto written = writeReport(*survey, *products, language, file.toStdString()); !written) {
            return {{}, errorWords(written.error()), {}};
        }
        return drawnPages(file, width_px, ratio);
    });
    layOut();
}

// Beside the window, for its width; the pages before stay until these are there.
void ReportView::draw() {
    if (file_.isEmpty()) return;
    pages_beside_.start([file = file_, width_px = pageWidth_px(), ratio = devicePixelRatioF()] {
        return drawnPages(file, width_px, ratio);
    });
}

ReportView::Made ReportView::drawnPages(const QString& file, int width_px, double pixel_ratio) {
    const auto document = opened(file);
    if (!document) return {{}, tr("The report cannot be drawn."), {}};
    Made made{file, {}, {}, width_px, pixel_ratio};
    for (int page = 0; page < document->numPages(); ++page) {
        const std::unique_ptr<Poppler::Page> one = document->page(page);
        const double paper_points = one ? one->pageSizeF().width() : 0.0;
        if (paper_points <= 0.0) return {{}, tr("The report cannot be drawn."), {}};
        made.pages.push_back(drawn(*document, page, width_px * pixel_ratio * kPoints_dpi / paper_points));
    }
    return made;
}

int ReportView::pageWidth_px() const {
    const int room_px = width() - scroll_->verticalScrollBar()->sizeHint().width() - 4 * kGrid_px;
    return std::clamp(room_px, 240, kWidestPage_px);
}

void ReportView::take(const Made& made) {
    file_ = made.file;
    pages_ = made.pages;
    pixel_ratio_ = made.pixel_ratio;
    if (!made.problem.isEmpty()) Q_EMIT failed(made.problem);
    layOut();
    // The window may have another width by now.
    if (made.width_px != pageWidth_px() && !pages_.empty()) resized_.start();
}

void ReportView::layOut() {
    const bool ready = !pages_.empty();
    save_->setEnabled(ready);
    print_->setEnabled(ready);
    scroll_->setVisible(ready);
    hint_->setVisible(!ready);
    hint_->setText(
        products_ ? tr("The report is being made ready…")
                  : tr("No report yet. Process the survey: what it says to its client will stand here."));
    if (!ready) return;
    QScrollBar& bar = *scroll_->verticalScrollBar();
    const double place = bar.maximum() > 0 ? static_cast<double>(bar.value()) / bar.maximum() : 0.0;
    auto* paper = new QWidget;
    column_ = new QVBoxLayout(paper);
    column_->setContentsMargins(2 * kGrid_px, 2 * kGrid_px, 2 * kGrid_px, 2 * kGrid_px);
    column_->setSpacing(2 * kGrid_px);
    for (const QImage& page : pages_) {
        auto* label = new QLabel;
        QPixmap picture = QPixmap::fromImage(page);
        picture.setDevicePixelRatio(pixel_ratio_);
        label->setPixmap(picture);
        label->setAlignment(Qt::AlignHCenter);
        column_->addWidget(label);
    }
    column_->addStretch();
    scroll_->setWidget(paper);
    // The same pages in another size.
    bar.setValue(qRound(place * bar.maximum()));
}

void ReportView::resizeEvent(QResizeEvent*) {
    if (!pages_.empty()) resized_.start();
}

bool ReportView::saveTo(const QString& path) {
    QFile source(file_);
    QSaveFile target(path);
    if (source.open(QIODevice::ReadOnly) && target.open(QIODevice::WriteOnly)) {
        target.write(source.readAll());
        if (target.commit()) {
            Q_EMIT saved(path);
            return true;
        }
    }
    Q_EMIT failed(tr("%1: cannot be written (%2)").arg(path, target.errorString()));
    return false;
}

void ReportView::askAndSave() {
    const QString path = QFileDialog::getSaveFileName(this, tr("Save the report"),
                                                      lastFolder() + "/report.pdf", tr("PDF (*.pdf)"));
    if (path.isEmpty()) return;
    rememberFolder(path);
    saveTo(path);
}

void ReportView::askAndPrint() {
    QPrinter printer(QPrinter::HighResolution);
    QPrintDialog dialog(&printer, this);
    if (dialog.exec() == QDialog::Accepted) print(printer);
}

void ReportView::print(QPrinter& printer) {
    const auto document = opened(file_);
    if (!document) return;
    QPainter painter(&printer);
    for (int page = 0; page < document->numPages(); ++page) {
        if (page > 0) printer.newPage();
        const QImage image = drawn(*document, page, kPrint_dpi);
        const QRectF paper = printer.pageLayout().paintRectPixels(printer.resolution());
        const QSizeF size = QSizeF(image.size()).scaled(paper.size(), Qt::KeepAspectRatio);
        painter.drawImage(QRectF(QPointF((paper.width() - size.width()) / 2.0, 0.0), size), image);
    }
}

}  // namespace terrawalk::gui
