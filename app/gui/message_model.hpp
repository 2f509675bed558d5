#pragma once

#include <QAbstractListModel>
#include <QTime>
#include <vector>

#include "app/gui/survey_session.hpp"

namespace terrawalk::gui {

/// What the program has said, the oldest first; one line each.
class MessageModel : public QAbstractListModel {
    Q_OBJECT
  public:
    enum Role { KindRole = Qt::UserRole + 1 };
    using QAbstractListModel::QAbstractListModel;
    void add(MessageKind kind, const QString& text);
    [[nodiscard]] int rowCount(const QModelIndex& parent = {}) const override;
    [[nodiscard]] QVariant data(const QModelIndex& index, int role) const override;
    /// The icons have other colours now.
    void themeChanged();

  private:
    struct Message {
        QTime time;
        MessageKind kind = MessageKind::Info;
        QString text;
    };
    std::vector<Message> messages_;
};

}  // namespace terrawalk::gui
