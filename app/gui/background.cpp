#include "app/gui/background.hpp"

#include <QCoreApplication>
#include <QPointer>

namespace terrawalk::gui {

QThreadPool* backgroundPool() {
    static QPointer<QThreadPool> pool;
    if (!pool) {
        pool = new QThreadPool(QCoreApplication::instance());
        QObject::connect(QCoreApplication::instance(), &QCoreApplication::aboutToQuit, pool,
                         [] { pool->waitForDone(); });
    }
    return pool;
}

}  // namespace terrawalk::gui
