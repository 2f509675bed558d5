#include <QCoreApplication>
#include <thread>

#include "app/gui/background_job.hpp"

using namespace terrawalk;

// The worker writes what it has shown to the window already.
int main(int argc, char** argv) {
    QCoreApplication app(argc, argv);
    int shared = 0, seen = 0;
    gui::BackgroundJob job;
    QObject::connect(&job, &gui::BackgroundJob::told, &app, [&] { seen += shared; });
    QObject::connect(&job, &gui::BackgroundJob::runningChanged, &app, [&](bool running) {
        if (!running) app.quit();
    });
    job.start([&shared](Progress& progress, const std::stop_token&) -> gui::BackgroundJob::Delivery {
        shared = 1;
        progress.message(Severity::Info, "look");
        // Long enough for the window to look, or else the result would order the two.
        std::this_thread::sleep_for(std::chrono::milliseconds(500));
        shared = 2;
        return {};
    });
    return app.exec();
}
