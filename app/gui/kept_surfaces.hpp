#pragma once

#include <QDateTime>
#include <QString>
#include <cstddef>
#include <filesystem>
#include <vector>

#include "app/pipeline/process.hpp"

namespace terrawalk::gui {

/// Surfaces of a survey's runs on disk, so that heights can be compared after the program ended: a DEM and
/// its standard errors for each run. Those of new runs join them while their folder is there and holds no
/// mark that says otherwise.
class KeptSurfaces {
  public:
    explicit KeptSurfaces(std::filesystem::path folder) : folder_(std::move(folder)) {}

    [[nodiscard]] bool wanted() const;
    /// Makes the folder. Returns whether it could.
    [[nodiscard]] bool start() const;
    /// No more are kept; those that are there stay. Returns whether it could be noted.
    [[nodiscard]] bool pause() const;
    /// Removes the surfaces, and the folder where no more are wanted and nothing else lies in it.
    void removeAll() const;

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
