#include "app/gui/plot_canvas.hpp"

#include <QEvent>
#include <QKeyEvent>
#include <QLabel>
#include <QMouseEvent>
#include <QStackedLayout>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>
#include <map>
// QCustomPlot needs the keywords that the rest of the program does without. No other file includes it.
#define signals Q_SIGNALS
#define slots Q_SLOTS
#define foreach Q_FOREACH
#include <qcustomplot.h>
#undef signals
#undef slots
#undef foreach

#include "app/gui/plot_thinning.hpp"
#include "app/gui/round_numbers.hpp"
#include "app/gui/theme.hpp"

namespace terrawalk::gui {

namespace {

constexpr double kWheelZoom = 1.25;
/// A click this near to a dot means it.
constexpr double kNameReach_px = 10.0;
constexpr double kYMargin = 0.06;
constexpr double kDragSlack_px = 4.0;
constexpr double kDot_px = 3.5, kMarkDot_px = 6.0;
constexpr double kYTicks = 5.0;
constexpr double kLine_px = 1.5;
constexpr std::size_t kMostWidePoints = 600;
// More categories than that have no room for their names.
constexpr int kNamedCategories = 24;

QString number(double value, int decimals) {
    return QString::number(value, 'f', decimals).replace('-', QChar(0x2212));
}

struct Range {
    double low = HUGE_VAL, high = -HUGE_VAL;
    void add(double v) {
        if (!std::isfinite(v)) return;
        low = std::min(low, v);
        high = std::max(high, v);
    }
    [[nodiscard]] bool empty() const { return !(low <= high); }
};

/// A round step that is not below a number; whole where asked for.
double tickStep(double least, bool whole) {
    const double below = roundBelow(std::max(least, 1e-9));
    double step = below;
    for (const double factor : {1.0, 2.0, 2.5, 5.0}) {
        step = below * factor;
        if (step >= least && std::abs(roundBelow(step) - step) < 1e-9 * step) break;
    }
    return whole ? std::max(1.0, std::round(step)) : step;
}

// Broken at the space that is nearest to the middle.
QString inTwoLines(const QString& text) {
    qsizetype best = -1;
    for (qsizetype i = text.indexOf(' '); i >= 0; i = text.indexOf(' ', i + 1)) {
        if (best < 0 || std::abs(2 * i - text.size()) < std::abs(2 * best - text.size())) best = i;
    }
    return best < 0 ? text : text.left(best) + '\n' + text.mid(best + 1);
}

}  // namespace

QColor seriesColour(SeriesInk ink) {
    const bool dark = currentTheme() == Theme::Dark;
    switch (ink) {
        case SeriesInk::First:
            return dark ? QColor("#4fb3a2") : QColor("#12695c");
        case SeriesInk::Second:
            return dark ? QColor("#f0a35e") : QColor("#d55e00");
        case SeriesInk::Third:
            return dark ? QColor("#7cb8e8") : QColor("#0072b2");
        case SeriesInk::Fourth:
            return dark ? QColor("#d99ac5") : QColor("#a04a86");
        case SeriesInk::Fifth:
            return dark ? QColor("#f0e442") : QColor("#8a6d00");
        case SeriesInk::Sixth:
            return dark ? QColor("#f2877f") : QColor("#b3261e");
        case SeriesInk::Quiet:
            break;
    }
    return quietColour();
}

struct PlotCanvas::Parts {
    /// The lines and dots of one series on the screen.
    struct Shown {
        const PlotSeries* series = nullptr;
        QCPGraph* graph = nullptr;
        QCPGraph *upper = nullptr, *lower = nullptr;
        std::vector<double> above, below;  ///< ends of the band
    };
    struct Panel {
        QCPAxisRect* rect = nullptr;
        std::vector<Shown> shown;
        std::vector<QCPItemRect*> shades;
        QCPGraph* chosen = nullptr;  ///< rings about dots
        QCPItemStraightLine* cursor = nullptr;
        QCPLegend* legend = nullptr;
        QString label;  ///< of y
        Range seen;     ///< of y, in what is visible of x
    };

    explicit Parts(PlotCanvas* owner) : canvas(owner) {}

    void build();
    void addPanel(std::size_t index, QCPMarginGroup& margins);
    QCPLegend* addLegend();
    void fitTexts();
    void addSeries(Panel& panel, const PlotSeries& series);
    void addBars(Panel& panel, const PlotSeries& series);
    void addBoxes(Panel& panel, const PlotSeries& series);
    void addBand(Shown& shown, QCPAxis* x, QCPAxis* y, const QColor& colour);
    static QSharedPointer<QCPAxisTicker> namedTicks(const QStringList& names);
    void nameCategories(QCPAxisRect& rect);
    void style(QCPAxisRect& rect) const;
    void setX(double from, double to);
    void refill();
    void refill(std::size_t index);
    void scaleY(std::size_t index);
    void refillDots(std::size_t index);
    [[nodiscard]] QCPItemRect* newShade(QCPAxisRect& rect) const;
    void placeShade();
    [[nodiscard]] QString nameAt(const QPointF& px) const;
    void moveStretch(double from_by, double to_by);
    void showCursor(const QPointF* px);
    [[nodiscard]] Range wholeX() const;
    [[nodiscard]] std::size_t columns() const;
    [[nodiscard]] int panelAt(const QPointF& px) const;
    void wheel(const QWheelEvent& event);
    void press(const QMouseEvent& event);
    void move(const QMouseEvent& event);
    void release(const QMouseEvent& event);

    PlotCanvas* canvas;
    QCustomPlot* view = nullptr;
    QLabel* words = nullptr;
    QStackedLayout* stack = nullptr;
    Plot plot;
    std::vector<Panel> panels;
    double from = 0.0, to = 1.0;
    std::vector<std::pair<double, double>> stretches;
    QString named;
    std::optional<QPointF> pressed;
    QPointF last;
    Qt::MouseButton button = Qt::NoButton;
    bool dragging = false;
};

PlotCanvas::PlotCanvas(QWidget* parent) : QWidget(parent), parts_(std::make_unique<Parts>(this)) {
    setObjectName("plotCanvas");
    setFocusPolicy(Qt::StrongFocus);
    parts_->stack = new QStackedLayout(this);
    parts_->stack->setContentsMargins(0, 0, 0, 0);
    parts_->view = new QCustomPlot;
    parts_->view->setFocusPolicy(Qt::NoFocus);
    parts_->view->setMouseTracking(true);
    parts_->view->setAutoAddPlottableToLegend(false);
    parts_->view->installEventFilter(this);
    parts_->words = new QLabel;
    parts_->words->setObjectName("quiet");
    parts_->words->setAlignment(Qt::AlignCenter);
    parts_->words->setWordWrap(true);
    parts_->words->setMargin(6 * kGrid_px);
    parts_->stack->addWidget(parts_->view);
    parts_->stack->addWidget(parts_->words);
}

PlotCanvas::~PlotCanvas() = default;

void PlotCanvas::show(Plot plot) {
    const bool same_axis = plot.over_time && parts_->plot.over_time && plot.title == parts_->plot.title;
    const auto seen = visibleX();
    parts_->plot = std::move(plot);
    setAccessibleName(parts_->plot.title);
    parts_->words->setText(parts_->plot.reason);
    parts_->stack->setCurrentIndex(parts_->plot.panels.empty() ? 1 : 0);
    parts_->build();
    // Processed again, the same plot keeps what is looked at.
    if (same_axis) {
        parts_->setX(seen.first, seen.second);
    } else {
        resetZoom();
    }
}

void PlotCanvas::setStretches(std::vector<std::pair<double, double>> stretches_s) {
    parts_->stretches = std::move(stretches_s);
    parts_->placeShade();
    parts_->view->replot(QCustomPlot::rpQueuedReplot);
}

void PlotCanvas::setNamed(const QString& name) {
    if (parts_->named == name) return;
    parts_->named = name;
    parts_->placeShade();
    parts_->view->replot(QCustomPlot::rpQueuedReplot);
}

void PlotCanvas::themeChanged() {
    const auto seen = visibleX();
    parts_->build();
    parts_->setX(seen.first, seen.second);
}

void PlotCanvas::resetZoom() {
    const Range whole = parts_->wholeX();
    if (whole.empty()) return;
    const double width = whole.high - whole.low;
    const bool bare = parts_->plot.over_time || !parts_->plot.categories.isEmpty();
    const double margin = bare ? 0.0 : width > 0.0 ? 0.04 * width : 0.5;
    parts_->setX(whole.low - margin, whole.high + margin + (width > 0.0 ? 0.0 : 1e-3));
}

void PlotCanvas::zoom(double factor, double about_x) {
    const auto [from, to] = visibleX();
    parts_->setX(about_x + (from - about_x) / factor, about_x + (to - about_x) / factor);
}

std::pair<double, double> PlotCanvas::visibleX() const {
    return {parts_->from, parts_->to};
}

QPointF PlotCanvas::pixelOf(std::size_t panel, double x, double y) const {
    const QCPAxisRect& rect = *parts_->panels[panel].rect;
    const QPointF in_view(rect.axis(QCPAxis::atBottom)->coordToPixel(x),
                          rect.axis(QCPAxis::atLeft)->coordToPixel(y));
    return parts_->view->mapTo(this, in_view.toPoint());
}

std::size_t PlotCanvas::pointsDrawn() const {
    std::size_t n = 0;
    for (const auto& panel : parts_->panels) {
        for (const auto& shown : panel.shown) n += static_cast<std::size_t>(shown.graph->data()->size());
    }
    return n;
}

const Plot& PlotCanvas::plot() const {
    return parts_->plot;
}

QString PlotCanvas::readoutAt(std::size_t index, double x) const {
    const Plot& plot = parts_->plot;
    if (index >= plot.panels.size()) return {};
    const PlotPanel& panel = plot.panels[index];
    const auto with = [](const QString& value, const QString& unit) {
        return unit.isEmpty() ? value : value + " " + unit;
    };
    const double seen = parts_->to - parts_->from;
    QString line;
    if (!plot.categories.isEmpty()) {
        const auto place = static_cast<qsizetype>(std::lround(x));
        if (place < 0 || place >= plot.categories.size()) return {};
        line = plot.categories[place];
    } else {
        line = with(number(x, plot.over_time ? (seen < 20.0 ? 2 : 1) : 3), plot.x_unit);
    }
    for (const PlotSeries& series : panel.series) {
        if (series.style == SeriesStyle::Guide) continue;
        // The nearest of those that are near.
        const double reach = plot.categories.isEmpty() ? seen * 0.02 : 0.5;
        double least = reach;
        std::optional<std::size_t> nearest;
        std::size_t begin = 0, end = series.x.size();
        if (std::is_sorted(series.x.begin(), series.x.end())) {
            const auto at = [&](double value) {
                return static_cast<std::size_t>(std::lower_bound(series.x.begin(), series.x.end(), value) -
                                                series.x.begin());
            };
            begin = at(x - reach);
            end = std::min(series.x.size(), at(x + reach) + 1);
        }
        for (std::size_t i = begin; i < end; ++i) {
            if (std::isnan(series.y[i]) || !(std::abs(series.x[i] - x) <= least)) continue;
            least = std::abs(series.x[i] - x);
            nearest = i;
        }
        if (!nearest) continue;
        QString value = panel.value_names.isEmpty()
                            ? number(series.y[*nearest], panel.decimals)
                            : panel.value_names.value(std::lround(series.y[*nearest]));
        if (!series.half_band.empty()) {
            value += QString::fromUtf8(" ± ") + number(series.half_band[*nearest], panel.decimals);
        }
        line += "    " + series.name + " " + with(value, panel.unit);
    }
    return line;
}

void PlotCanvas::Parts::style(QCPAxisRect& rect) const {
    const QPalette palette = canvas->palette();
    const QColor line = palette.color(QPalette::Mid), quiet = quietColour();
    rect.setBackground(palette.color(QPalette::Base));
    rect.setupFullAxesBox(false);
    for (QCPAxis* axis : rect.axes()) {
        axis->setBasePen(QPen(line));
        axis->setTickPen(QPen(line));
        axis->setSubTickPen(Qt::NoPen);
        axis->setTickLabelColor(quiet);
        axis->setLabelColor(palette.color(QPalette::Text));
        axis->setTickLabelFont(canvas->font());
        axis->setLabelFont(canvas->font());
        QColor grid = line;
        grid.setAlpha(110);
        axis->grid()->setPen(QPen(grid, 1.0));
        axis->grid()->setZeroLinePen(QPen(line, 1.0));
        const bool box = axis->axisType() == QCPAxis::atTop || axis->axisType() == QCPAxis::atRight;
        if (box) axis->setTicks(false);
    }
}

QSharedPointer<QCPAxisTicker> PlotCanvas::Parts::namedTicks(const QStringList& names) {
    auto ticker = QSharedPointer<QCPAxisTickerText>::create();
    for (qsizetype i = 0; i < names.size(); ++i) ticker->addTick(static_cast<double>(i), names[i]);
    return ticker;
}

void PlotCanvas::Parts::nameCategories(QCPAxisRect& rect) {
    auto ticker = QSharedPointer<QCPAxisTickerText>::create();
    const qsizetype step = 1 + (plot.categories.size() - 1) / kNamedCategories;
    constexpr qsizetype kUpright = 8;
    for (qsizetype i = 0; i < plot.categories.size(); i += step) {
        QString name = plot.categories[i];
        if (plot.categories.size() <= kUpright) name.replace(' ', '\n');
        ticker->addTick(static_cast<double>(i), name);
    }
    QCPAxis* axis = rect.axis(QCPAxis::atBottom);
    axis->setTicker(ticker);
    axis->grid()->setVisible(false);
    if (plot.categories.size() > kUpright) axis->setTickLabelRotation(-60);
}

void PlotCanvas::Parts::addBand(Shown& shown, QCPAxis* x, QCPAxis* y, const QColor& colour) {
    const PlotSeries& series = *shown.series;
    for (std::size_t i = 0; i < series.y.size(); ++i) {
        shown.above.push_back(series.y[i] + series.half_band[i]);
        shown.below.push_back(series.y[i] - series.half_band[i]);
    }
    QColor fill = colour;
    fill.setAlpha(currentTheme() == Theme::Dark ? 70 : 50);
    shown.upper = view->addGraph(x, y);
    shown.lower = view->addGraph(x, y);
    for (QCPGraph* edge : {shown.upper, shown.lower}) {
        edge->setPen(Qt::NoPen);
        edge->setName({});
        edge->setAdaptiveSampling(false);
    }
    shown.upper->setBrush(fill);
    shown.upper->setChannelFillGraph(shown.lower);
}

void PlotCanvas::Parts::addBars(Panel& panel, const PlotSeries& series) {
    auto* bars = new QCPBars(panel.rect->axis(QCPAxis::atBottom), panel.rect->axis(QCPAxis::atLeft));
    const QColor colour = seriesColour(series.ink);
    QColor fill = colour;
    fill.setAlpha(190);
    bars->setName(series.name);
    bars->setPen(QPen(canvas->palette().color(QPalette::Base), 1.0));
    bars->setBrush(fill);
    bars->setWidth(plot.bar_width);
    bars->setData(QVector<double>(series.x.begin(), series.x.end()),
                  QVector<double>(series.y.begin(), series.y.end()), true);
}

void PlotCanvas::Parts::addBoxes(Panel& panel, const PlotSeries& series) {
    auto* boxes =
        new QCPStatisticalBox(panel.rect->axis(QCPAxis::atBottom), panel.rect->axis(QCPAxis::atLeft));
    const QColor colour = seriesColour(series.ink), ink = canvas->palette().color(QPalette::Text);
    QColor fill = colour;
    fill.setAlpha(90);
    boxes->setName(series.name);
    boxes->setPen(QPen(colour, 1.2));
    boxes->setBrush(fill);
    boxes->setMedianPen(QPen(ink, 2.0));
    boxes->setWhiskerPen(QPen(colour, 1.2));
    boxes->setWhiskerBarPen(QPen(colour, 1.2));
    boxes->setWidth(0.5);
    boxes->setWhiskerWidth(0.25);
    boxes->setOutlierStyle(QCPScatterStyle(QCPScatterStyle::ssCircle, colour, kMarkDot_px));
    std::map<double, std::vector<double>> groups;
    for (std::size_t i = 0; i < series.x.size(); ++i) groups[series.x[i]].push_back(series.y[i]);
    for (const auto& [x, values] : groups) {
        const BoxOfValues box = boxOf(values);
        boxes->addData(x, box.low_whisker, box.lower_quartile, box.median, box.upper_quartile,
                       box.high_whisker, QVector<double>(box.outliers.begin(), box.outliers.end()));
    }
}

void PlotCanvas::Parts::addSeries(Panel& panel, const PlotSeries& series) {
    if (series.style == SeriesStyle::Bars) return addBars(panel, series);
    if (series.style == SeriesStyle::Boxes) return addBoxes(panel, series);
    QCPAxis *x = panel.rect->axis(QCPAxis::atBottom), *y = panel.rect->axis(QCPAxis::atLeft);
    Shown shown;
    shown.series = &series;
    const QColor colour = seriesColour(series.ink);
    if (!series.half_band.empty()) addBand(shown, x, y, colour);
    shown.graph = view->addGraph(x, y);
    shown.graph->setName(series.name);
    // The points are thinned already.
    shown.graph->setAdaptiveSampling(false);
    if (series.style == SeriesStyle::Dots) {
        QColor ink = colour;
        if (series.ink == SeriesInk::Quiet) ink.setAlpha(60);
        shown.graph->setLineStyle(QCPGraph::lsNone);
        shown.graph->setScatterStyle(
            QCPScatterStyle(QCPScatterStyle::ssDisc, ink, plot.over_time ? kDot_px : kMarkDot_px));
    } else {
        const bool guide = series.style == SeriesStyle::Guide;
        shown.graph->setPen(QPen(colour, guide ? 1.0 : kLine_px, guide ? Qt::DashLine : Qt::SolidLine));
    }
    panel.shown.push_back(std::move(shown));
}

// Above its panel, at the right.
QCPLegend* PlotCanvas::Parts::addLegend() {
    constexpr double kAsSmallAsMayBe = 0.001;
    const int row = view->plotLayout()->rowCount();
    auto* line = new QCPLayoutGrid;
    view->plotLayout()->addElement(row, 0, line);
    view->plotLayout()->setRowStretchFactor(row, kAsSmallAsMayBe);
    auto* legend = new QCPLegend;
    line->addElement(0, 0, new QCPLayoutElement(view));
    line->addElement(0, 1, legend);
    line->setColumnStretchFactor(1, kAsSmallAsMayBe);
    legend->setLayer("legend");
    legend->setBrush(Qt::NoBrush);
    legend->setBorderPen(Qt::NoPen);
    legend->setFont(canvas->font());
    legend->setTextColor(canvas->palette().color(QPalette::Text));
    legend->setRowSpacing(0);
    legend->setMargins(QMargins(6, 2, 16, 0));
    legend->setFillOrder(QCPLegend::foColumnsFirst);
    return legend;
}

// As many columns of a legend as there is room for; the name of an axis in two lines where one is too long.
void PlotCanvas::Parts::fitTexts() {
    constexpr int kBeside_px = 24;
    for (Panel& panel : panels) {
        if (panel.legend != nullptr && panel.legend->itemCount() > 0) {
            int widest = 1;
            for (int i = 0; i < panel.legend->itemCount(); ++i) {
                widest = std::max(widest, panel.legend->item(i)->minimumOuterSizeHint().width());
            }
            widest += panel.legend->columnSpacing();
            panel.legend->setWrap(
                std::clamp((view->width() - kBeside_px) / widest, 1, panel.legend->itemCount()));
            panel.legend->setFillOrder(QCPLegend::foColumnsFirst, true);
        }
        QCPAxis* y = panel.rect->axis(QCPAxis::atLeft);
        const int room = view->height() / static_cast<int>(panels.size()) - 2 * kBeside_px;
        y->setLabel(QFontMetrics(y->labelFont()).horizontalAdvance(panel.label) <= room
                        ? panel.label
                        : inTwoLines(panel.label));
    }
}

void PlotCanvas::Parts::addPanel(std::size_t index, QCPMarginGroup& margins) {
    const PlotPanel& source = plot.panels[index];
    const bool lowest = index + 1 == plot.panels.size();
    Panel panel;
    panel.rect = new QCPAxisRect(view, true);
    const bool legend_needed =
        source.series.size() > 1 || (source.series.size() == 1 && !source.series.front().half_band.empty());
    if (legend_needed) panel.legend = addLegend();
    const int row = view->plotLayout()->rowCount();
    view->plotLayout()->addElement(row, 0, panel.rect);
    // The lowest holds the axis of all.
    constexpr double kWithAxis = 1.3;
    if (lowest && index > 0) view->plotLayout()->setRowStretchFactor(row, kWithAxis);
    style(*panel.rect);
    panel.rect->setMarginGroup(QCP::msLeft | QCP::msRight, &margins);
    panel.rect->setMinimumMargins(QMargins(48, index == 0 ? 12 : 4, 16, 4));
    QCPAxis *x = panel.rect->axis(QCPAxis::atBottom), *y = panel.rect->axis(QCPAxis::atLeft);
    panel.label = source.unit.isEmpty() ? source.label : QString("%1 (%2)").arg(source.label, source.unit);
    y->setNumberFormat("f");
    if (!plot.categories.isEmpty()) nameCategories(*panel.rect);
    x->setTickLabels(lowest);
    if (lowest) {
        x->setLabel(plot.x_unit.isEmpty() ? plot.x_label : QString("%1 (%2)").arg(plot.x_label, plot.x_unit));
    }
    const int plottables = view->plottableCount();
    for (const PlotSeries& series : source.series) addSeries(panel, series);
    for (int i = plottables; panel.legend != nullptr && i < view->plottableCount(); ++i) {
        QCPAbstractPlottable* plottable = view->plottable(i);
        // Edges of bands have no name.
        if (!plottable->name().isEmpty()) plottable->addToLegend(panel.legend);
    }
    panel.chosen = view->addGraph(x, y);
    panel.chosen->setLineStyle(QCPGraph::lsNone);
    panel.chosen->setScatterStyle(
        QCPScatterStyle(QCPScatterStyle::ssCircle, QPen(accentColour(), 2.0), Qt::NoBrush, 14.0));
    panel.cursor = new QCPItemStraightLine(view);
    panel.cursor->setClipAxisRect(panel.rect);
    panel.cursor->setPen(QPen(quietColour(), 1.0, Qt::DotLine));
    for (QCPItemPosition* point : {panel.cursor->point1, panel.cursor->point2}) {
        point->setTypeX(QCPItemPosition::ptPlotCoords);
        point->setTypeY(QCPItemPosition::ptAxisRectRatio);
        point->setAxes(x, y);
        point->setAxisRect(panel.rect);
    }
    panel.cursor->setVisible(false);
    panels.push_back(std::move(panel));
}

void PlotCanvas::Parts::build() {
    view->clearItems();
    view->clearPlottables();
    view->plotLayout()->clear();
    panels.clear();
    view->setBackground(canvas->palette().color(QPalette::Base));
    auto* margins = new QCPMarginGroup(view);
    for (std::size_t i = 0; i < plot.panels.size(); ++i) addPanel(i, *margins);
    view->plotLayout()->setRowSpacing(4);
    fitTexts();
    placeShade();
}

Range PlotCanvas::Parts::wholeX() const {
    Range whole;
    if (!plot.categories.isEmpty()) return {-0.75, static_cast<double>(plot.categories.size()) - 0.25};
    for (const PlotPanel& panel : plot.panels) {
        for (const PlotSeries& series : panel.series) {
            if (series.style == SeriesStyle::Bars) {
                for (const double x : series.x) {
                    whole.add(x - plot.bar_width / 2.0);
                    whole.add(x + plot.bar_width / 2.0);
                }
            } else if (plot.over_time && series.style == SeriesStyle::Line && !series.x.empty()) {
                whole.add(series.x.front());
                whole.add(series.x.back());
            } else {
                for (const double x : series.x) whole.add(x);
            }
        }
    }
    return whole;
}

std::size_t PlotCanvas::Parts::columns() const {
    return static_cast<std::size_t>(std::max(64, view->width()));
}

void PlotCanvas::Parts::setX(double new_from, double new_to) {
    if (!(new_from < new_to) || panels.empty()) return;
    from = new_from;
    to = new_to;
    refill();
    view->replot(QCustomPlot::rpQueuedReplot);
}

void PlotCanvas::Parts::refill() {
    for (std::size_t i = 0; i < panels.size(); ++i) refill(i);
}

void PlotCanvas::Parts::refill(std::size_t index) {
    Panel& panel = panels[index];
    Range seen;
    const auto put = [&](QCPGraph* graph, const std::vector<double>& x, const std::vector<double>& y) {
        const PlotPoints points = thinnedLine(x, y, from, to, columns());
        for (std::size_t i = 0; i < points.x.size(); ++i) {
            if (points.x[i] >= from && points.x[i] <= to) seen.add(points.y[i]);
        }
        graph->setData(QVector<double>(points.x.begin(), points.x.end()),
                       QVector<double>(points.y.begin(), points.y.end()), true);
        // Qt draws a wide line of many points a hundred times slower than one of a pixel.
        if (graph->pen().style() == Qt::SolidLine) {
            QPen pen = graph->pen();
            pen.setWidthF(points.x.size() > kMostWidePoints ? 1.0 : kLine_px);
            graph->setPen(pen);
        }
    };
    for (Shown& shown : panel.shown) {
        const PlotSeries& series = *shown.series;
        if (series.style == SeriesStyle::Line || series.style == SeriesStyle::Guide) {
            put(shown.graph, series.x, series.y);
            if (shown.upper == nullptr) continue;
            put(shown.upper, series.x, shown.above);
            put(shown.lower, series.x, shown.below);
        } else if (series.sets_scale) {
            for (std::size_t i = 0; i < series.x.size(); ++i) {
                if (series.x[i] >= from && series.x[i] <= to) seen.add(series.y[i]);
            }
        }
    }
    for (const PlotSeries& series : plot.panels[index].series) {
        if (series.style != SeriesStyle::Bars && series.style != SeriesStyle::Boxes) continue;
        for (const double y : series.y) seen.add(y);
    }
    if (plot.panels[index].from_zero) seen.add(0.0);
    if (seen.empty()) seen = {0.0, 1.0};
    panel.seen = seen;
    scaleY(index);
    panel.rect->axis(QCPAxis::atBottom)->setRange(from, to);
    refillDots(index);
}

void PlotCanvas::Parts::scaleY(std::size_t index) {
    const PlotPanel& source = plot.panels[index];
    Range seen = panels[index].seen;
    if (source.highest && seen.low < *source.highest) seen.high = std::min(seen.high, *source.highest);
    QCPAxis* axis = panels[index].rect->axis(QCPAxis::atLeft);
    // A value that stays the same has a middle, and as much room as its last digit deserves.
    const double least = 0.6 * std::pow(10.0, -source.decimals);
    const double margin =
        std::max(kYMargin * (seen.high - seen.low), seen.high - seen.low < least ? least : 0.0);
    const double low = source.from_zero && seen.low >= 0.0 ? 0.0 : seen.low - margin;
    const double high = seen.high + margin;
    axis->setRange(low, high);
    if (!source.value_names.isEmpty()) {
        axis->setTicker(namedTicks(source.value_names));
        return;
    }
    const double step = tickStep((high - low) / kYTicks, source.decimals == 0);
    auto ticker = QSharedPointer<QCPAxisTickerFixed>::create();
    ticker->setTickStep(step);
    axis->setTicker(ticker);
    // No more digits than the steps between ticks have.
    axis->setNumberPrecision(std::clamp(static_cast<int>(std::ceil(-std::log10(step) - 1e-9)), 0, 6));
}

void PlotCanvas::Parts::refillDots(std::size_t index) {
    Panel& panel = panels[index];
    const QCPRange y = panel.rect->axis(QCPAxis::atLeft)->range();
    const PlotWindow window{from,    to,        y.lower,
                            y.upper, columns(), static_cast<std::size_t>(std::max(32, panel.rect->height()))};
    for (Shown& shown : panel.shown) {
        if (shown.series->style != SeriesStyle::Dots) continue;
        const PlotPoints points = thinnedDots(shown.series->x, shown.series->y, window);
        shown.graph->setData(QVector<double>(points.x.begin(), points.x.end()),
                             QVector<double>(points.y.begin(), points.y.end()));
    }
}

QCPItemRect* PlotCanvas::Parts::newShade(QCPAxisRect& rect) const {
    auto* shade = new QCPItemRect(view);
    shade->setClipAxisRect(&rect);
    for (QCPItemPosition* corner : {shade->topLeft, shade->bottomRight}) {
        corner->setTypeX(QCPItemPosition::ptPlotCoords);
        corner->setTypeY(QCPItemPosition::ptAxisRectRatio);
        corner->setAxes(rect.axis(QCPAxis::atBottom), rect.axis(QCPAxis::atLeft));
        corner->setAxisRect(&rect);
    }
    QColor colour = accentColour();
    colour.setAlpha(60);
    shade->setBrush(colour);
    shade->setPen(Qt::NoPen);
    return shade;
}

void PlotCanvas::Parts::placeShade() {
    auto parts = plot.over_time ? stretches : std::vector<std::pair<double, double>>();
    if (const auto category = plot.categories.indexOf(named); plot.of_marks && category >= 0) {
        const auto at = static_cast<double>(category);
        parts.emplace_back(at - 0.5, at + 0.5);
    }
    for (Panel& panel : panels) {
        while (panel.shades.size() < parts.size()) panel.shades.push_back(newShade(*panel.rect));
        for (std::size_t i = 0; i < panel.shades.size(); ++i) {
            panel.shades[i]->setVisible(i < parts.size());
            if (i >= parts.size()) continue;
            panel.shades[i]->topLeft->setCoords(parts[i].first, 0.0);
            panel.shades[i]->bottomRight->setCoords(parts[i].second, 1.0);
        }
        QVector<double> x, y;
        for (const Shown& shown : panel.shown) {
            for (qsizetype i = 0; i < shown.series->names.size(); ++i) {
                if (named.isEmpty() || shown.series->names[i] != named) continue;
                x << shown.series->x[static_cast<std::size_t>(i)];
                y << shown.series->y[static_cast<std::size_t>(i)];
            }
        }
        panel.chosen->setData(x, y);
    }
}

/// Of the dot under the cursor, or of the category.
QString PlotCanvas::Parts::nameAt(const QPointF& px) const {
    const int index = panelAt(px);
    if (index < 0) return {};
    const Panel& panel = panels[static_cast<std::size_t>(index)];
    const QCPAxis *x = panel.rect->axis(QCPAxis::atBottom), *y = panel.rect->axis(QCPAxis::atLeft);
    QString nearest;
    double least_px = kNameReach_px;
    for (const Shown& shown : panel.shown) {
        for (qsizetype i = 0; i < shown.series->names.size(); ++i) {
            const auto at = static_cast<std::size_t>(i);
            const double off_px = std::hypot(x->coordToPixel(shown.series->x[at]) - px.x(),
                                             y->coordToPixel(shown.series->y[at]) - px.y());
            if (off_px >= least_px) continue;
            least_px = off_px;
            nearest = shown.series->names[i];
        }
    }
    if (!nearest.isEmpty() || !plot.of_marks) return nearest;
    return plot.categories.value(static_cast<qsizetype>(std::lround(x->pixelToCoord(px.x()))));
}

/// With the keys: a stretch in the middle of the view where there is none.
void PlotCanvas::Parts::moveStretch(double from_by, double to_by) {
    if (!plot.over_time || panels.empty()) return;
    const Range whole = wholeX();
    const double middle = (from + to) / 2.0;
    auto [a, b] = stretches.empty() ? std::pair{middle, middle} : stretches.back();
    a = std::clamp(a + from_by, whole.low, whole.high);
    b = std::clamp(b + to_by, whole.low, whole.high);
    if (a < b) Q_EMIT canvas->stretchDragged(a, b);
}

int PlotCanvas::Parts::panelAt(const QPointF& px) const {
    for (std::size_t i = 0; i < panels.size(); ++i) {
        if (panels[i].rect->rect().contains(px.toPoint())) return static_cast<int>(i);
    }
    return -1;
}

void PlotCanvas::Parts::showCursor(const QPointF* px) {
    const int index = px != nullptr ? panelAt(*px) : -1;
    const double x = index >= 0 ? panels[0].rect->axis(QCPAxis::atBottom)->pixelToCoord(px->x()) : 0.0;
    for (Panel& panel : panels) {
        panel.cursor->setVisible(index >= 0);
        panel.cursor->point1->setCoords(x, 0.0);
        panel.cursor->point2->setCoords(x, 1.0);
    }
    view->replot(QCustomPlot::rpQueuedReplot);
    Q_EMIT canvas->readout(index >= 0 ? canvas->readoutAt(static_cast<std::size_t>(index), x) : QString());
}

void PlotCanvas::Parts::wheel(const QWheelEvent& event) {
    if (panels.empty()) return;
    const double about = panels[0].rect->axis(QCPAxis::atBottom)->pixelToCoord(event.position().x());
    canvas->zoom(std::pow(kWheelZoom, event.angleDelta().y() / 120.0), about);
}

void PlotCanvas::Parts::press(const QMouseEvent& event) {
    if (panelAt(event.position()) < 0) return;
    pressed = last = event.position();
    button = event.button();
    dragging = false;
}

void PlotCanvas::Parts::move(const QMouseEvent& event) {
    const QPointF at = event.position();
    if (!pressed) return showCursor(&at);
    if (!dragging && (at - *pressed).manhattanLength() < kDragSlack_px) return;
    dragging = true;
    const QCPAxis* x = panels[0].rect->axis(QCPAxis::atBottom);
    if (button != Qt::LeftButton || !plot.over_time) {
        const double by = x->pixelToCoord(last.x()) - x->pixelToCoord(at.x());
        last = at;
        return setX(from + by, to + by);
    }
    const double a = x->pixelToCoord(pressed->x()), b = x->pixelToCoord(at.x());
    stretches = {{std::min(a, b), std::max(a, b)}};
    placeShade();
    showCursor(&at);
}

void PlotCanvas::Parts::release(const QMouseEvent&) {
    const bool selected = dragging && button == Qt::LeftButton && plot.over_time && !stretches.empty();
    const auto clicked = button == Qt::LeftButton && !dragging ? std::exchange(pressed, {}) : std::nullopt;
    pressed.reset();
    dragging = false;
    if (const QString name = clicked ? nameAt(*clicked) : QString(); !name.isEmpty())
        Q_EMIT canvas->nameClicked(name);
    if (!selected) return;
    // No farther than the log goes.
    const Range whole = wholeX();
    const double a = std::clamp(stretches.front().first, whole.low, whole.high);
    const double b = std::clamp(stretches.front().second, whole.low, whole.high);
    if (a < b) Q_EMIT canvas->stretchDragged(a, b);
}

bool PlotCanvas::eventFilter(QObject* watched, QEvent* event) {
    if (watched != parts_->view) return QWidget::eventFilter(watched, event);
    switch (event->type()) {
        case QEvent::Wheel:
            parts_->wheel(*static_cast<QWheelEvent*>(event));
            return true;
        case QEvent::MouseButtonPress:
            setFocus(Qt::MouseFocusReason);
            parts_->press(*static_cast<QMouseEvent*>(event));
            return true;
        case QEvent::MouseMove:
            parts_->move(*static_cast<QMouseEvent*>(event));
            return true;
        case QEvent::MouseButtonRelease:
            parts_->release(*static_cast<QMouseEvent*>(event));
            return true;
        case QEvent::MouseButtonDblClick:
            resetZoom();
            return true;
        case QEvent::Leave:
            parts_->showCursor(nullptr);
            break;
        case QEvent::Resize:
            // As many points as there are columns now; the plot itself has its new size after this event.
            QMetaObject::invokeMethod(
                this,
                [this] {
                    parts_->fitTexts();
                    parts_->setX(parts_->from, parts_->to);
                },
                Qt::QueuedConnection);
            break;
        default:
            break;
    }
    return QWidget::eventFilter(watched, event);
}

void PlotCanvas::keyPressEvent(QKeyEvent* event) {
    const auto [from, to] = visibleX();
    const double middle = (from + to) / 2.0, step = (to - from) / 8.0;
    const bool left = event->key() == Qt::Key_Left;
    if ((left || event->key() == Qt::Key_Right) &&
        event->modifiers() & (Qt::ShiftModifier | Qt::ControlModifier)) {
        const double by = (left ? -1.0 : 1.0) * (to - from) / 100.0;
        const bool end = event->modifiers() & Qt::ShiftModifier;
        return parts_->moveStretch(end ? 0.0 : by, end ? by : 0.0);
    }
    switch (event->key()) {
        case Qt::Key_Left:
            return parts_->setX(from - step, to - step);
        case Qt::Key_Right:
            return parts_->setX(from + step, to + step);
        case Qt::Key_Plus:
        case Qt::Key_Equal:
            return zoom(kWheelZoom, middle);
        case Qt::Key_Minus:
            return zoom(1.0 / kWheelZoom, middle);
        case Qt::Key_Home:
            return resetZoom();
        default:
            return QWidget::keyPressEvent(event);
    }
}

}  // namespace terrawalk::gui
