// Frames of the 3-D view over a surface of a million triangles, while it is turned and at rest. On software
// GL:
//   LIBGL_ALWAYS_SOFTWARE=1 xvfb-run -a -s "-screen 0 1400x900x24" build/release/bin/bench_terrain_view
//   [cells]
// Measures what the view would choose there, and OpenGL where there is any.

#include <fmt/format.h>

#include <QApplication>
#include <QElapsedTimer>
#include <QMouseEvent>
#include <QTest>
#include <algorithm>
#include <cmath>
#include <vector>

#include "app/gui/terrain_view.hpp"

namespace {

using namespace terrawalk;
using namespace terrawalk::gui;

/// Rolling terraces, `cells` a side.
std::shared_ptr<const Products> surface(std::size_t cells) {
    auto products = std::make_shared<Products>();
    products->dem.geometry = {0.0, 0.25 * static_cast<double>(cells), 0.25, cells, cells};
    products->dem.heights_m.resize(cells * cells);
    for (std::size_t row = 0; row < cells; ++row) {
        for (std::size_t column = 0; column < cells; ++column) {
            const double x = static_cast<double>(column) * 0.25, y = static_cast<double>(row) * 0.25;
            const double slope = 0.12 * y + 3.0 * std::sin(x / 19.0);
            products->dem.heights_m[row * cells + column] =
                static_cast<float>(1.5 * std::floor(slope / 1.5) + 0.05 * std::sin(x) * std::cos(y));
        }
    }
    return products;
}

struct Times {
    std::vector<double> ms;
    std::size_t triangles = 0;
    [[nodiscard]] double at(double share) {
        std::sort(ms.begin(), ms.end());
        return ms[static_cast<std::size_t>(share * static_cast<double>(ms.size() - 1))];
    }
};

void print(const char* what, Times& times) {
    fmt::print("{:<28}{:>12}{:>12.1f}{:>12.1f}{:>12.1f}{:>14.1f}\n", what, times.triangles, times.at(0.0),
               times.at(0.5), times.at(0.95), 1000.0 / times.at(0.5));
}

bool measure(TerrainRenderer renderer, std::size_t cells) {
    ViewState state;
    Selection selection;
    TerrainView view(state, selection, renderer);
    view.resize(1280, 800);
    auto survey = std::make_shared<Survey>();
    survey->zero_point = {30.0, 110.0, 0.0};
    view.show(survey, std::make_shared<const SurveyMap>(), surface(cells));
    view.show();
    std::size_t triangles = 0;
    bool complete = false, any = false;
    QObject::connect(&view, &TerrainView::drawn, [&](qulonglong n, double, bool all) {
        triangles = n;
        complete = all;
        any = true;
    });
    if (!QTest::qWaitForWindowExposed(&view)) return false;
    if (!QTest::qWaitFor([&] { return view.canvas() != nullptr && complete; }, 60'000)) return false;

    Times turning, rest, silence;
    // Runs the event loop until a picture has come; each turn of it is a time in which the window is deaf.
    const auto waitFor = [&](const bool& come) {
        while (!come) {
            QElapsedTimer turn;
            turn.start();
            QApplication::processEvents(QEventLoop::AllEvents);
            silence.ms.push_back(static_cast<double>(turn.nsecsElapsed()) * 1e-6);
        }
    };
    const QPoint middle = view.rect().center();
    QTest::mousePress(&view, Qt::LeftButton, {}, middle);
    QElapsedTimer timer;
    for (int i = 1; i <= 80; ++i) {
        timer.start();
        const QPointF at = middle + QPointF(4 * i, 20 * std::sin(i / 8.0));
        QMouseEvent move(QEvent::MouseMove, at, view.mapToGlobal(at), Qt::NoButton, Qt::LeftButton, {});
        any = false;
        QApplication::sendEvent(&view, &move);
        waitFor(any);
        // Furniture, and putting it together in the window.
        QApplication::processEvents();
        // The first frames teach the view how much it can draw in time.
        if (i <= 20) continue;
        turning.ms.push_back(static_cast<double>(timer.nsecsElapsed()) * 1e-6);
        turning.triangles = std::max(turning.triangles, triangles);
    }
    QTest::mouseRelease(&view, Qt::LeftButton, {}, middle + QPoint(320, 0));
    for (int i = 0; i < 7; ++i) {
        complete = false;
        timer.start();
        view.viewFrom(i % 2 == 0 ? ViewFrom::Oblique : ViewFrom::South);
        waitFor(complete);
        rest.ms.push_back(static_cast<double>(timer.nsecsElapsed()) * 1e-6);
        rest.triangles = std::max(rest.triangles, triangles);
    }
    fmt::print("{} renderer\n", view.canvas()->about().toStdString());
    print("  while it is turned", turning);
    print("  at rest, until the last frame", rest);
    fmt::print("  longest silence of the event loop: {:.1f} ms\n", silence.at(1.0));
    return true;
}

}  // namespace

int main(int argc, char** argv) {
    QApplication app(argc, argv);
    const std::size_t cells = argc > 1 ? std::strtoul(argv[1], nullptr, 10) : 709;
    fmt::print("{} x {} cells, {} triangles, 1280 x 800\n", cells, cells, 2 * (cells - 1) * (cells - 1));
    fmt::print("{:<28}{:>12}{:>12}{:>12}{:>12}{:>14}\n", "", "drawn", "min ms", "median ms", "95 % ms",
               "frames/s");
    if (!measure(TerrainRenderer::Automatic, cells)) return 1;
    return openGl() == OpenGlKind::None || measure(TerrainRenderer::OpenGl, cells) ? 0 : 1;
}
