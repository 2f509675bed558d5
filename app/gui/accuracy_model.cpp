#include "app/gui/accuracy_model.hpp"

#include <QFont>
#include <cmath>
#include <utility>

#include "app/gui/figures.hpp"
#include "app/gui/report_words.hpp"

namespace terrawalk::gui {

namespace {

QString length(double metres) {
    return number(inUnit(metres), 3);
}

QString cell(const AccuracyGroup& group, int column) {
    const auto& up = group.up;
    switch (column) {
        case AccuracyModel::StageColumn:
            return reportWords(name(group.stage));
        case AccuracyModel::QuantityColumn:
            return reportWords(name(group.quantity));
        case AccuracyModel::RoleColumn:
            return reportWords(name(group.role));
        case AccuracyModel::CountColumn:
            return up                 ? QString::number(up->n)
                   : group.horizontal ? QString::number(group.horizontal->n)
                                      : QString();
        case AccuracyModel::PlanRmse:
            return group.horizontal ? length(group.horizontal->rmse_m) : QString("–");
        case AccuracyModel::HeightMean:
            return up ? length(up->mean_m) : QString("–");
        case AccuracyModel::HeightSd:
            return up && up->sd_m ? length(*up->sd_m) : QString("–");
        case AccuracyModel::HeightRmse:
            return up ? length(up->rmse_m) : QString("–");
        case AccuracyModel::HeightLargest:
            return up ? length(up->largest_m) : QString("–");
        default:
            return {};
    }
}

}  // namespace

void AccuracyModel::show(std::vector<AccuracyGroup> groups, std::optional<std::size_t> headline) {
    beginResetModel();
    groups_ = std::move(groups);
    headline_ = headline;
    endResetModel();
}

int AccuracyModel::rowCount(const QModelIndex& parent) const {
    return parent.isValid() ? 0 : static_cast<int>(groups_.size());
}

int AccuracyModel::columnCount(const QModelIndex& parent) const {
    return parent.isValid() ? 0 : ColumnCount;
}

QVariant AccuracyModel::data(const QModelIndex& index, int role) const {
    if (!index.isValid()) return {};
    const auto row = static_cast<std::size_t>(index.row());
    if (role == Qt::DisplayRole) return cell(groups_[row], index.column());
    if (role == Qt::TextAlignmentRole) {
        return QVariant((index.column() >= CountColumn ? Qt::AlignRight : Qt::AlignLeft) | Qt::AlignVCenter);
    }
    if (role == Qt::FontRole && headline_ == row) {
        QFont bold;
        bold.setBold(true);
        return bold;
    }
    return {};
}

QVariant AccuracyModel::headerData(int section, Qt::Orientation orientation, int role) const {
    if (orientation != Qt::Horizontal) return {};
    if (role == Qt::TextAlignmentRole) {
        return QVariant((section >= CountColumn ? Qt::AlignRight : Qt::AlignLeft) | Qt::AlignVCenter);
    }
    if (role != Qt::DisplayRole) return {};
    switch (section) {
        case StageColumn:
            return tr("Stage");
        case QuantityColumn:
            return tr("Compared");
        case RoleColumn:
            return tr("Marks");
        case CountColumn:
            return tr("n");
        case PlanRmse:
            return tr("Plan RMSE").replace(' ', '\n');
        case HeightMean:
            return tr("Height mean").replace(' ', '\n');
        case HeightSd:
            return tr("SD");
        case HeightRmse:
            return tr("RMSE");
        case HeightLargest:
            return tr("Largest");
        default:
            return {};
    }
}

}  // namespace terrawalk::gui
