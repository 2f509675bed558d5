#include "app/gui/message_model.hpp"

#include <QColor>

#include "app/gui/theme.hpp"

namespace terrawalk::gui {

namespace {

QIcon iconOf(MessageKind kind) {
    switch (kind) {
        case MessageKind::Info:
            return icon("info", quietColour());
        case MessageKind::Done:
            return icon("done", accentColour());
        case MessageKind::Warning:
            return icon("warning", warningColour());
        case MessageKind::Error:
            return icon("error", errorColour());
    }
    return {};
}

}  // namespace

void MessageModel::add(MessageKind kind, const QString& text) {
    const int row = static_cast<int>(messages_.size());
    beginInsertRows({}, row, row);
    messages_.push_back({QTime::currentTime(), kind, text});
    endInsertRows();
}

int MessageModel::rowCount(const QModelIndex& parent) const {
    return parent.isValid() ? 0 : static_cast<int>(messages_.size());
}

QVariant MessageModel::data(const QModelIndex& index, int role) const {
    if (!index.isValid()) return {};
    const Message& message = messages_[static_cast<std::size_t>(index.row())];
    switch (role) {
        case Qt::DisplayRole:
            return message.time.toString("HH:mm:ss") + "   " + message.text;
        case Qt::ToolTipRole:
            return message.text;
        case Qt::DecorationRole:
            return iconOf(message.kind);
        case Qt::ForegroundRole:
            return message.kind == MessageKind::Error ? QVariant(errorColour()) : QVariant();
        case KindRole:
            return static_cast<int>(message.kind);
        default:
            return {};
    }
}

void MessageModel::themeChanged() {
    if (messages_.empty()) return;
    Q_EMIT dataChanged(index(0), index(rowCount() - 1));
}

}  // namespace terrawalk::gui
