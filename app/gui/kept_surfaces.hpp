#pragma once

#include <QDateTime>
#include <QString>
#include <cstddef>
#include <filesystem>
#include <vector>

#include "app/pipeline/process.hpp"

namespace terrawalk::gui {

/// Surfaces of a survey's runs on disk, so that heights can be compared after the program ended: a DEM and
/// its standard errors for each run. They are kept while their folder is there.
class KeptSurfaces {
  public:
    explicit KeptSurfaces(std::filesystem::path folder) : folder_(std::move(folder)) {}

    [[nodiscard]] bool wanted() const;
    /// Makes the folder. Returns whether it could.
    [[nodiscard]] bool start() const;
    /// Removes the surfaces, and the folder where nothing else lies in it.
    void stop() const;

    /// The DEM of a run, there or not.
    [[nodiscard]] std::filesystem::path file(const QDateTime& when) const;
    [[nodiscard]] bool has(const QDateTime& when) const;
    /// On disk, with the standard errors.
    [[nodiscard]] qint64 bytes(const QDateTime& when) const;
    /// What a surface takes on disk at most.
    [[nodiscard]] static qint64 mostBytes(const Products& products);
    /// Removes those of no run.
    void keepOnly(const std::vector<QDateTime>& runs) const;

  private:
    std::filesystem::path folder_;
};

}  // namespace terrawalk::gui
