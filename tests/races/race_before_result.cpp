#include <QCoreApplication>

#include "app/gui/background_job.hpp"

using namespace terrawalk;

// The window writes what the worker reads, before the worker has handed over its result.
int main(int argc, char** argv) {
    QCoreApplication app(argc, argv);
    int shared = 0;
    gui::BackgroundJob job;
    QObject::connect(&job, &gui::BackgroundJob::runningChanged, &app, [&app](bool running) {
        if (!running) app.quit();
    });
    job.start([&shared](Progress&, const std::stop_token&) -> gui::BackgroundJob::Delivery {
        const int seen = shared;
        return [seen] {
            static_cast<void>(seen);
        };
    });
    ++shared;
    return app.exec();
}
