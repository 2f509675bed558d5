#pragma once

#include <QAbstractTableModel>
#include <vector>

#include "survey/survey_report.hpp"

namespace terrawalk::gui {

/// The accuracy table of a report: one row for each group of comparisons, lengths in metres.
class AccuracyModel : public QAbstractTableModel {
    Q_OBJECT
  public:
    enum Column {
        StageColumn,
        QuantityColumn,
        RoleColumn,
        CountColumn,
        PlanRmse,
        HeightMean,
        HeightSd,
        HeightRmse,
        HeightLargest,
        ColumnCount
    };
    using QAbstractTableModel::QAbstractTableModel;
    void show(std::vector<AccuracyGroup> groups, std::optional<std::size_t> headline);
    [[nodiscard]] int rowCount(const QModelIndex& parent = {}) const override;
    [[nodiscard]] int columnCount(const QModelIndex& parent = {}) const override;
    [[nodiscard]] QVariant data(const QModelIndex& index, int role) const override;
    [[nodiscard]] QVariant headerData(int section, Qt::Orientation orientation, int role) const override;

  private:
    std::vector<AccuracyGroup> groups_;
    std::optional<std::size_t> headline_;
};

}  // namespace terrawalk::gui
