#include "app/gui/plots_view.hpp"

#include <QApplication>
#include <QComboBox>
#include <QElapsedTimer>
#include <QLabel>
#include <QPushButton>
#include <QSignalSpy>
#include <QTest>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "app/gui/plot_canvas.hpp"
#include "app/gui/plot_thinning.hpp"
#include "app/gui/theme.hpp"
#include "tests/gui/processed_sample.hpp"
#include "tests/support/slack.hpp"

using namespace terrawalk;
using namespace terrawalk::gui;

class TestPlotsView : public QObject {
    Q_OBJECT
  private Q_SLOTS:
    void initTestCase();
    void thinnedLineKeepsFirstLastLeastAndGreatest();
    void thinnedLineKeepsGaps();
    void thinnedDotsTakeEachPixelOnce();
    void gapsOfASensorBreakItsLine();
    void fixesAreNamedTheBestHighest();
    void bandIsOfTheCovariance();
    void groundPointsAreAllThere();
    void innovationsAreThoseOfTheFilter();
    void histogramCountsEachErrorOnce();
    void everyPlotSaysSomething();
    void dragSelectsAStretch();
    void keysSelectAStretch();
    void clickOnAnErrorChoosesItsMark();
    void wheelZoomsAndRightDragMoves();
    void selectionElsewhereChoosesTheRun();
    void readoutHasTimeValueAndUnit();
    void newResultsKeepTheZoom();
    void themesHaveTheirColours();
    void largeLogStaysFluid();
    void pictures();

  private:
    /// Shows the sample in a view that has its final size.
    void show(PlotsView& view) const;
    static QWidget* plotWidget(PlotsView& view);
    /// From one time to another in the middle of the uppermost panel.
    static void drag(PlotsView& view, double from_s, double to_s, Qt::MouseButton button);
    test::ProcessedSample sample_;
};

void TestPlotsView::initTestCase() {
    applyTheme(Theme::Light);
    sample_ = test::processedSample("quick_plot");
}

void TestPlotsView::show(PlotsView& view) const {
    view.resize(1000, 700);
    view.show();
    view.show(sample_.survey, sample_.map, sample_.products);
    QTest::qWait(30);
}

QWidget* TestPlotsView::plotWidget(PlotsView& view) {
    return view.canvas().childAt(300, 100);
}

void TestPlotsView::drag(PlotsView& view, double from_s, double to_s, Qt::MouseButton button) {
    QWidget* widget = plotWidget(view);
    const auto at = [&](double time_s) {
        return widget->mapFrom(&view.canvas(),
                               QPoint(qRound(view.canvas().pixelOf(0, time_s, 0.0).x()), 100));
    };
    const QPoint from = at(from_s), to = at(to_s);
    QTest::mousePress(widget, button, {}, from);
    for (const QPoint place : {(from + to) / 2, to}) {
        QMouseEvent move(QEvent::MouseMove, place, widget->mapToGlobal(place), Qt::NoButton, button, {});
        QApplication::sendEvent(widget, &move);
    }
    QTest::mouseRelease(widget, button, {}, to);
    QTest::qWait(10);
}

void TestPlotsView::thinnedLineKeepsFirstLastLeastAndGreatest() {
    std::vector<double> x, y;
    for (int i = 0; i < 100'000; ++i) {
        x.push_back(i * 0.01);
        y.push_back(std::sin(i * 0.37) + (i == 54'321 ? 50.0 : 0.0));
    }
    const PlotPoints points = thinnedLine(x, y, 0.0, 1000.0, 800);
    QVERIFY(points.x.size() <= 4 * 801);
    QVERIFY(std::is_sorted(points.x.begin(), points.x.end()));
    QCOMPARE(points.x.front(), x.front());
    QCOMPARE(points.x.back(), x.back());
    // A spike of one reading in 100 000 is seen.
    QCOMPARE(*std::max_element(points.y.begin(), points.y.end()), *std::max_element(y.begin(), y.end()));
    // Each column reaches as far as its values do.
    for (int column = 0; column < 800; column += 37) {
        const auto of = [&](const std::vector<double>& xs, const std::vector<double>& ys) {
            double low = HUGE_VAL, high = -HUGE_VAL;
            for (std::size_t i = 0; i < xs.size(); ++i) {
                if (std::floor(xs[i] / 1.25) != column) continue;
                low = std::min(low, ys[i]);
                high = std::max(high, ys[i]);
            }
            return std::pair(low, high);
        };
        QCOMPARE(of(points.x, points.y), of(x, y));
    }
}

void TestPlotsView::thinnedLineKeepsGaps() {
    std::vector<double> x, y;
    for (int i = 0; i < 10'000; ++i) {
        x.push_back(i);
        // One missing value in a column of a hundred.
        y.push_back(i == 4'250 ? std::nan("") : 1.0);
    }
    const PlotPoints points = thinnedLine(x, y, 0.0, 10'000.0, 100);
    QCOMPARE(std::count_if(points.y.begin(), points.y.end(), [](double v) { return std::isnan(v); }), 1);
    // Zoomed in, all that is in view is there, and one more on each side.
    const PlotPoints near = thinnedLine(x, y, 100.5, 110.5, 100);
    QCOMPARE(near.x.front(), 100.0);
    QCOMPARE(near.x.back(), 111.0);
    QCOMPARE(near.x.size(), std::size_t{12});
}

void TestPlotsView::thinnedDotsTakeEachPixelOnce() {
    std::vector<double> x, y;
    for (int i = 0; i < 50'000; ++i) {
        x.push_back(std::fmod(i * 0.618034, 1.0));
        y.push_back(std::fmod(i * 0.414214, 1.0));
    }
    x.push_back(0.5);
    y.push_back(7.0);
    const PlotPoints points = thinnedDots(x, y, {0.0, 1.0, 0.0, 1.0, 40, 30});
    QCOMPARE(points.x.size(), std::size_t{40 * 30});
    QVERIFY(*std::max_element(points.y.begin(), points.y.end()) <= 1.0);
}

void TestPlotsView::gapsOfASensorBreakItsLine() {
    Survey survey;
    Run run;
    run.id = "R";
    for (int i = 0; i < 100; ++i) {
        run.log.time_s.push_back(i * 0.2);
        // A slow sensor: one reading in five epochs; silent from 8 s to 12 s.
        const bool silent = i > 40 && i < 60;
        run.log.column(Channel::Pressure).push_back(i % 5 == 0 && !silent ? 100'000.0 + i : kMissing);
    }
    survey.runs.push_back(run);
    const Plot plot = plotOf(PlotKind::Barometer, 0, survey, nullptr);
    QCOMPARE(plot.panels.size(), std::size_t{1});
    const PlotSeries& series = plot.panels[0].series[0];
    const auto gaps = std::count_if(series.y.begin(), series.y.end(), [](double v) { return std::isnan(v); });
    QCOMPARE(gaps, 1);
    const auto gap = std::find_if(series.y.begin(), series.y.end(), [](double v) { return std::isnan(v); });
    const double at_s = series.x[static_cast<std::size_t>(gap - series.y.begin())];
    QVERIFY(at_s > 8.0 && at_s < 12.0);
    // In hectopascal.
    QCOMPARE(series.y.front(), 1000.0);
}

void TestPlotsView::fixesAreNamedTheBestHighest() {
    Survey survey;
    Run run;
    run.id = "R";
    int i = 0;
    for (const int fix : {fix_code::kNone, fix_code::kSingle, fix_code::kRtkFloat, fix_code::kRtkFixed, 6}) {
        run.log.time_s.push_back(0.2 * i++);
        run.log.column(Channel::Fix).push_back(fix);
    }
    survey.runs.push_back(run);
    const Plot plot = plotOf(PlotKind::GnssPosition, 0, survey, nullptr);
    QCOMPARE(plot.panels.size(), std::size_t{1});
    const PlotPanel& panel = plot.panels[0];
    QStringList names;
    for (const double y : panel.series[0].y) names << panel.value_names.value(std::lround(y));
    QCOMPARE(names, QStringList({"none", "single", "RTK float", "RTK fixed", "other"}));
    QVERIFY(std::is_sorted(panel.series[0].y.begin(), panel.series[0].y.begin() + 4));
    PlotCanvas canvas;
    canvas.resize(600, 300);
    canvas.show(plot);
    QVERIFY2(canvas.readoutAt(0, 0.6).endsWith("RTK fixed"), qPrintable(canvas.readoutAt(0, 0.6)));
}

void TestPlotsView::bandIsOfTheCovariance() {
    const std::size_t run = sample_.survey->runs.size() - 1;
    const Plot plot = plotOf(PlotKind::Position, run, *sample_.survey, sample_.products.get());
    QCOMPARE(plot.panels.size(), std::size_t{3});
    const auto& epochs = sample_.products->trajectories[run].epochs;
    for (int axis = 0; axis < 3; ++axis) {
        const PlotSeries& fused = plot.panels[static_cast<std::size_t>(axis)].series.back();
        std::size_t i = 0;
        for (const TrajectoryEpoch& epoch : epochs) {
            while (std::isnan(fused.y[i])) ++i;
            QCOMPARE(fused.x[i], epoch.time_s);
            QCOMPARE(fused.y[i], epoch.position_enu_m[axis]);
            QVERIFY(std::abs(fused.half_band[i] - 1.96 * std::sqrt(epoch.covariance(axis, axis))) < 1e-12);
            ++i;
        }
    }
}

void TestPlotsView::groundPointsAreAllThere() {
    const std::size_t run = sample_.survey->runs.size() - 1;
    const Plot plot = plotOf(PlotKind::GroundHeights, run, *sample_.survey, sample_.products.get());
    std::size_t plotted = 0, there = 0;
    for (const PlotSeries& series : plot.panels.at(0).series) plotted += series.x.size();
    for (const GroundPoint& point : sample_.products->ground_points) {
        there += point.run == run && point.enu_m.allFinite() ? 1U : 0U;
    }
    QCOMPARE(plotted, there);
}

void TestPlotsView::innovationsAreThoseOfTheFilter() {
    const std::size_t run = sample_.survey->runs.size() - 1;
    const auto& sensors = sample_.products->innovations.at(run);
    QVERIFY(sensors.size() > 2);
    const Plot plot = plotOf(PlotKind::Innovations, run, *sample_.survey, sample_.products.get());
    QVERIFY(plot.over_time);
    std::size_t plotted = 0, there = 0;
    for (const PlotPanel& panel : plot.panels) {
        for (const PlotSeries& series : panel.series)
            plotted += series.style == SeriesStyle::Dots ? series.x.size() : 0;
    }
    for (const SensorInnovations& sensor : sensors) there += sensor.readings.size();
    QCOMPARE(plotted, there);
    const Plot bars = plotOf(PlotKind::Consistency, run, *sample_.survey, sample_.products.get());
    QVERIFY(!bars.over_time);
    const auto& first = sensors.front().consistency;
    QCOMPARE(bars.panels.at(0).series.at(0).y.at(0), first.mean_nis / first.dof);
}

void TestPlotsView::histogramCountsEachErrorOnce() {
    Products products;
    const std::vector<double> errors{-0.31, -0.1, -0.05, 0.0, 0.02, 0.04, 0.11, 0.2, 0.5};
    for (const double e : errors) {
        Residual r;
        r.stage = Stage::Surface;
        r.quantity = Quantity::SurfaceHeight;
        r.difference_enu_m.z() = e;
        r.sigma_enu_m.z() = 0.1;
        r.mark = "M" + std::to_string(products.report.residuals.size());
        products.report.residuals.push_back(r);
    }
    // One that the estimator used has no part in it.
    products.report.residuals.push_back(products.report.residuals.back());
    products.report.residuals.back().used_by_estimator = true;
    const Plot histogram = plotOf(PlotKind::ErrorHistogram, 0, *sample_.survey, &products);
    const PlotSeries& bars = histogram.panels.at(0).series.at(0);
    QCOMPARE(std::accumulate(bars.y.begin(), bars.y.end(), 0.0), static_cast<double>(errors.size()));
    // The bell has the area of the bars.
    const PlotSeries& bell = histogram.panels[0].series.at(1);
    double area = 0.0;
    for (std::size_t i = 1; i < bell.x.size(); ++i) {
        area += (bell.x[i] - bell.x[i - 1]) * (bell.y[i] + bell.y[i - 1]) / 2.0;
    }
    QVERIFY(std::abs(area / (static_cast<double>(errors.size()) * histogram.bar_width) - 1.0) < 1e-3);

    const Plot quantiles = plotOf(PlotKind::QuantileQuantile, 0, *sample_.survey, &products);
    const PlotSeries& dots = quantiles.panels.at(0).series.at(0);
    QCOMPARE(dots.y, errors);
    // The middle of nine is the median of the normal distribution; the ends are mirrored.
    QVERIFY(std::abs(dots.x[4]) < 1e-9);
    QVERIFY(std::abs(dots.x[0] + 1.593219) < 1e-5);  // quantile of 0.5 / 9
    QVERIFY(std::abs(dots.x[8] + dots.x[0]) < 1e-9);

    const Plot normalised = plotOf(PlotKind::NormalisedErrors, 0, *sample_.survey, &products);
    QVERIFY2(normalised.note.startsWith("6 of 9"), qPrintable(normalised.note));
}

void TestPlotsView::everyPlotSaysSomething() {
    Selection selection;
    PlotsView view(selection);
    view.resize(900, 600);
    view.show();
    for (const bool processed : {false, true}) {
        view.show(sample_.survey, sample_.map, processed ? sample_.products : nullptr);
        for (const PlotKind kind : allPlots()) {
            view.setPlot(kind);
            const Plot& plot = view.canvas().plot();
            QVERIFY2(!plot.panels.empty() || !plot.reason.isEmpty(), qPrintable(plotName(kind)));
            for (const PlotPanel& panel : plot.panels) {
                for (const PlotSeries& series : panel.series) QCOMPARE(series.x.size(), series.y.size());
            }
            QVERIFY(!plotName(kind).isEmpty());
        }
    }
    view.show(nullptr, nullptr, nullptr);
    QVERIFY(!view.canvas().plot().reason.isEmpty());
}

void TestPlotsView::dragSelectsAStretch() {
    Selection selection;
    PlotsView view(selection);
    show(view);
    view.setPlot(PlotKind::Speed);
    QTest::qWait(30);
    auto* exclude = view.findChild<QPushButton*>("excludeStretch");
    QVERIFY(!exclude->isEnabled());
    const double from_s = 20.0, to_s = 40.0;
    drag(view, from_s, to_s, Qt::LeftButton);
    QCOMPARE(selection.stretches().size(), 1U);
    const auto [left, right] = view.canvas().visibleX();
    const double pixel_s = (right - left) / view.canvas().width();
    QVERIFY(std::abs(selection.stretches().front().from_s - from_s) < 2 * pixel_s);
    QVERIFY(std::abs(selection.stretches().front().to_s - to_s) < 2 * pixel_s);
    QCOMPARE(selection.stretches().front().run, view.run());
    // Beyond the log there is nothing to select.
    drag(view, from_s, right + (right - left), Qt::LeftButton);
    QVERIFY(selection.stretches().front().to_s <= sample_.survey->runs.back().log.time_s.back());

    QSignalSpy asked(&view, &PlotsView::excludeAsked);
    view.setPlot(PlotKind::Barometer);
    QVERIFY(exclude->isEnabled());
    QTest::mouseClick(exclude, Qt::LeftButton);
    QCOMPARE(asked.size(), 1);
    QCOMPARE(asked.front()[0].value<std::vector<TrackStretch>>(), selection.stretches());
    QCOMPARE(asked.front()[1].toString(), QString("barometer"));
}

void TestPlotsView::keysSelectAStretch() {
    Selection selection;
    PlotsView view(selection);
    show(view);
    view.setPlot(PlotKind::Speed);
    QTest::qWait(30);
    const auto [from, to] = view.canvas().visibleX();
    for (int i = 0; i < 5; ++i) QTest::keyClick(&view.canvas(), Qt::Key_Right, Qt::ShiftModifier);
    for (int i = 0; i < 3; ++i) QTest::keyClick(&view.canvas(), Qt::Key_Left, Qt::ControlModifier);
    QCOMPARE(selection.stretches().size(), 1U);
    const TrackStretch& stretch = selection.stretches().front();
    QVERIFY(std::abs(stretch.to_s - stretch.from_s - 0.08 * (to - from)) < 1e-6);
    QVERIFY(stretch.from_s < (from + to) / 2 && stretch.to_s > (from + to) / 2);
}

void TestPlotsView::clickOnAnErrorChoosesItsMark() {
    Selection selection;
    PlotsView view(selection);
    show(view);
    auto* exclude = view.findChild<QPushButton*>("excludeStretch");
    for (const PlotKind kind : {PlotKind::NormalisedErrors, PlotKind::QuantileQuantile}) {
        selection.clear();
        view.setPlot(kind);
        QTest::qWait(30);
        const PlotSeries& dots = view.canvas().plot().panels[0].series[0];
        QCOMPARE(static_cast<std::size_t>(dots.names.size()), dots.x.size());
        QVERIFY(exclude->isVisible() && !exclude->isEnabled());
        const auto mark = std::find_if(dots.names.begin(), dots.names.end(),
                                       [](const QString& name) { return name != "ZERO"; });
        const auto i = static_cast<std::size_t>(mark - dots.names.begin());
        QWidget* widget = plotWidget(view);
        const QPoint at =
            widget->mapFrom(&view.canvas(), view.canvas().pixelOf(0, dots.x[i], dots.y[i]).toPoint());
        QTest::mouseClick(widget, Qt::LeftButton, {}, at);
        QCOMPARE(selection.item(), *mark);
        QSignalSpy asked(&view, &PlotsView::excludeMarkAsked);
        QVERIFY(exclude->isEnabled());
        QTest::mouseClick(exclude, Qt::LeftButton);
        QCOMPARE(asked.size(), 1);
        QCOMPARE(asked.front()[0].toString(), *mark);
    }
}

void TestPlotsView::wheelZoomsAndRightDragMoves() {
    Selection selection;
    PlotsView view(selection);
    show(view);
    view.setPlot(PlotKind::Position);
    QTest::qWait(30);
    const auto whole = view.canvas().visibleX();
    const double about_s = whole.first + 0.25 * (whole.second - whole.first);
    view.canvas().zoom(4.0, about_s);
    const auto near = view.canvas().visibleX();
    QVERIFY(std::abs((near.second - near.first) * 4.0 - (whole.second - whole.first)) < 1e-9);
    QVERIFY(std::abs((about_s - near.first) / (near.second - near.first) - 0.25) < 1e-9);
    QTest::qWait(30);
    drag(view, about_s, about_s + 5.0, Qt::RightButton);
    QVERIFY(std::abs(view.canvas().visibleX().first - (near.first - 5.0)) < 0.5);
    QVERIFY(selection.stretches().empty());
    QTest::mouseDClick(plotWidget(view), Qt::LeftButton, {}, {300, 100});
    QCOMPARE(view.canvas().visibleX(), whole);
    QWheelEvent wheel({300, 100}, plotWidget(view)->mapToGlobal(QPointF(300, 100)), {}, {0, 120},
                      Qt::NoButton, {}, Qt::NoScrollPhase, false);
    QApplication::sendEvent(plotWidget(view), &wheel);
    const auto wheeled = view.canvas().visibleX();
    QVERIFY(wheeled.second - wheeled.first < whole.second - whole.first);
}

void TestPlotsView::selectionElsewhereChoosesTheRun() {
    Selection selection;
    PlotsView view(selection);
    view.show(sample_.survey, sample_.map, sample_.products);
    const QString first = QString::fromStdString(sample_.survey->runs.front().id);
    QVERIFY(view.run() != first);
    selection.select({first, 3.0, 5.0});
    QCOMPARE(view.run(), first);
    // A person who looks at another run keeps it, and there is no stretch to exclude there.
    view.setRun(QString::fromStdString(sample_.survey->runs.back().id));
    QVERIFY(view.run() != first);
    QVERIFY(!view.findChild<QPushButton*>("excludeStretch")->isEnabled());
    // A mark is no run.
    selection.selectItem(QString::fromStdString(sample_.survey->marks.front().name));
    QVERIFY(view.run() != first);
}

void TestPlotsView::readoutHasTimeValueAndUnit() {
    Selection selection;
    PlotsView view(selection);
    show(view);
    view.setPlot(PlotKind::Position);
    QTest::qWait(30);
    const auto& epoch = sample_.products->trajectories.back().epochs[200];
    const QString line = view.canvas().readoutAt(2, epoch.time_s);
    QVERIFY2(line.contains(QString::number(epoch.time_s, 'f', 1) + " s"), qPrintable(line));
    const QString height = QString::number(epoch.position_enu_m.z(), 'f', 2).replace('-', QChar(0x2212));
    QVERIFY2(line.contains(height + QString::fromUtf8(" ± ")) && line.endsWith(" m"), qPrintable(line));
    const QPointF at = view.canvas().pixelOf(2, epoch.time_s, epoch.position_enu_m.z());
    QMouseEvent move(QEvent::MouseMove, at, plotWidget(view)->mapToGlobal(at), Qt::NoButton, {}, {});
    QApplication::sendEvent(plotWidget(view), &move);
    const QString told = view.findChild<QLabel*>("plotReadout")->text();
    QVERIFY2(told.contains(" m"), qPrintable(QString("%1 at %2, %3").arg(told).arg(at.x()).arg(at.y())));
}

void TestPlotsView::newResultsKeepTheZoom() {
    Selection selection;
    PlotsView view(selection);
    show(view);
    view.setPlot(PlotKind::Speed);
    view.canvas().zoom(3.0, 20.0);
    const auto seen = view.canvas().visibleX();
    view.show(sample_.survey, sample_.map, std::make_shared<Products>(*sample_.products));
    QCOMPARE(view.canvas().visibleX(), seen);
}

void TestPlotsView::themesHaveTheirColours() {
    Selection selection;
    PlotsView view(selection);
    show(view);
    view.setPlot(PlotKind::Position);
    QTest::qWait(30);
    const auto ground = [&] {
        return view.canvas().grab().toImage().pixelColor(3, 3).lightness();
    };
    const int light = ground();
    applyTheme(Theme::Dark);
    view.themeChanged();
    QTest::qWait(30);
    const int dark = ground();
    applyTheme(Theme::Light);
    QVERIFY(light > 200 && dark < 60);
}

void TestPlotsView::largeLogStaysFluid() {
    auto survey = std::make_shared<Survey>();
    Run run;
    run.id = "long";
    constexpr int kRecords = 1'000'000;
    for (int i = 0; i < kRecords; ++i) {
        run.log.time_s.push_back(i * 0.02);
        for (const Channel channel :
             {Channel::AccelerationX, Channel::AccelerationY, Channel::AccelerationZ}) {
            run.log.column(channel).push_back(std::sin(i * 0.3 + static_cast<double>(channel)) +
                                              1e-3 * (i % 97));
        }
    }
    survey->runs.push_back(std::move(run));
    Selection selection;
    PlotsView view(selection);
    view.resize(1280, 800);
    view.show();
    view.show(survey, std::make_shared<const SurveyMap>(), nullptr);
    view.setPlot(PlotKind::Acceleration);
    QTest::qWait(50);
    QVERIFY(view.canvas().pointsDrawn() < 3 * 4 * 1300);
    std::vector<qint64> times_ms;
    for (int i = 0; i < 7; ++i) {
        QElapsedTimer timer;
        timer.start();
        view.canvas().zoom(i % 2 == 0 ? 1.1 : 1.0 / 1.1, 9'000.0);
        QApplication::processEvents();
        times_ms.push_back(timer.elapsed());
    }
    std::nth_element(times_ms.begin(), times_ms.begin() + 3, times_ms.end());
    qInfo("three lines of a million readings: %lld ms for a step of zoom", times_ms[3]);
    // Far above what it takes, far below what a plot of all points does on a busy machine.
    QVERIFY2(times_ms[3] < 400 * test::kSlack, qPrintable(QString::number(times_ms[3])));
}

/// Pictures of all plots, for a person to look at: only where TERRAWALK_PICTURES names a folder.
void TestPlotsView::pictures() {
    const QString folder = qEnvironmentVariable("TERRAWALK_PICTURES");
    if (folder.isEmpty()) QSKIP("TERRAWALK_PICTURES is not set");
    const auto sample = test::processedSample("mango_orchard");
    for (const Theme theme : {Theme::Light, Theme::Dark}) {
        applyTheme(theme);
        Selection selection;
        PlotsView view(selection);
        view.resize(1280, 800);
        view.show();
        view.show(sample.survey, sample.map, sample.products);
        const auto& log = sample.survey->runs.back().log;
        selection.select({QString::fromStdString(sample.survey->runs.back().id), log.time_s[log.size() / 3],
                          log.time_s[log.size() / 2]});
        for (const PlotKind kind : allPlots()) {
            view.setPlot(kind);
            QTest::qWait(50);
            QVERIFY(view.grab().save(folder + "/plot_" + QString::number(static_cast<int>(kind)) +
                                     (theme == Theme::Dark ? "_dark.png" : "_light.png")));
        }
    }
    applyTheme(Theme::Light);
}

int main(int argc, char** argv) {
    QApplication app(argc, argv);
    TestPlotsView test;
    return QTest::qExec(&test, argc, argv);
}

#include "test_plots_view.moc"
