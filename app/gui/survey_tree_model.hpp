#pragma once

#include <QStandardItemModel>

#include "app/pipeline/process.hpp"
#include "app/pipeline/survey_map.hpp"
#include "survey/survey.hpp"

namespace terrawalk::gui {

/// Runs, marks and results of a survey as a tree of two columns: name, with a box that shows or hides it on
/// the map, and its state.
class SurveyTreeModel : public QStandardItemModel {
    Q_OBJECT
  public:
    enum Role { KindRole = Qt::UserRole + 1, IdRole };
    enum Kind { Group, RunItem, MarkItem, EdgesItem, ResultItem };

    explicit SurveyTreeModel(QObject* parent = nullptr);
    /// @param products  null before the survey is processed
    void show(const Survey& survey, const SurveyMap& map, const Products* products);

  Q_SIGNALS:
    void visibilityChanged(int kind, const QString& id, bool visible);

  private:
    void addRuns(const Survey& survey, const Products* products);
    void addMarks(const SurveyMap& map);
    void addResults(const Products& products);
    QStandardItem* addGroup(const QString& name, qsizetype count);
};

}  // namespace terrawalk::gui
