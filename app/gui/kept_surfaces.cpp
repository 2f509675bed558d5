#include "app/gui/kept_surfaces.hpp"

#include <QDir>
#include <QFile>
#include <QFileInfo>
#include <QRegularExpression>
#include <QSet>

namespace terrawalk::gui {

namespace fs = std::filesystem;

namespace {

QString nameOf(const QDateTime& when) {
    return when.toUTC().toString("yyyyMMdd'T'HHmmsszzz");
}

/// In the folder: the surfaces stay, and no new ones join them.
constexpr const char* kPaused = ".paused";

/// Of one run: heights, standard errors.
QStringList filesOf(const QString& name) {
    return {name + ".tif", name + "_uncertainty.tif"};
}

}  // namespace

bool KeptSurfaces::wanted() const {
    std::error_code error;
    return fs::is_directory(folder_, error) && !fs::exists(folder_ / kPaused, error);
}

bool KeptSurfaces::start() const {
    std::error_code error;
    return QDir().mkpath(QString::fromStdString(folder_.string())) &&
           (fs::remove(folder_ / kPaused, error) || !error);
}

bool KeptSurfaces::pause() const {
    std::error_code error;
    if (fs::remove(folder_, error)) return true;  // fails, as it should, where there is something in it
    QFile mark(QString::fromStdString((folder_ / kPaused).string()));
    return mark.open(QIODevice::WriteOnly);
}

void KeptSurfaces::removeAll() const {
    keepOnly({});
    if (wanted()) return;
    std::error_code error;
    fs::remove(folder_ / kPaused, error);
    fs::remove(folder_, error);
}

fs::path KeptSurfaces::file(const QDateTime& when) const {
    return folder_ / (nameOf(when).toStdString() + ".tif");
}

bool KeptSurfaces::has(const QDateTime& when) const {
    std::error_code error;
    return fs::exists(file(when), error);
}

qint64 KeptSurfaces::bytes(const QDateTime& when) const {
    qint64 sum = 0;
    const QDir folder(QString::fromStdString(folder_.string()));
    for (const QString& name : filesOf(nameOf(when))) sum += QFileInfo(folder.filePath(name)).size();
    return sum;
}

qint64 KeptSurfaces::mostBytes(const Products& products) {
    // Two rasters of four bytes a cell, and their overviews.
    constexpr double kBytesPerCell = 2.0 * 4.0 * 4.0 / 3.0;
    return static_cast<qint64>(kBytesPerCell * static_cast<double>(products.dem.geometry.size()));
}

void KeptSurfaces::keepOnly(const std::vector<QDateTime>& runs) const {
    static const QRegularExpression own("^\\d{8}T\\d{9}(_uncertainty)?\\.tif$");
    QSet<QString> kept;
    for (const QDateTime& when : runs) {
        for (const QString& name : filesOf(nameOf(when))) kept << name;
    }
    const QDir folder(QString::fromStdString(folder_.string()));
    for (const QString& name : folder.entryList(QDir::Files)) {
        if (own.match(name).hasMatch() && !kept.contains(name)) QFile::remove(folder.filePath(name));
    }
}

}  // namespace terrawalk::gui
