#pragma once

#include <QStandardItemModel>

#include "app/gui/view_state.hpp"
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
    enum Kind { Group, RunItem, MarkItem, EdgesItem, ResultItem, StretchItem, LineItem };

    explicit SurveyTreeModel(QObject* parent = nullptr);
    /// @param survey    as in its files
    /// @param products  null before the survey is processed
    /// @param shown     tells what is hidden on the map
    void show(const Survey& survey, const SurveyMap& map, const Products* products, const SurveyEdits& edits,
              const ViewChoice& shown);

  Q_SIGNALS:
    void visibilityChanged(int kind, const QString& id, bool visible);

  private:
    void addRuns(const Survey& survey, const Products* products, const SurveyEdits& edits,
                 const ViewChoice& shown);
    void addMarks(const Survey& survey, const SurveyMap& map, const SurveyEdits& edits,
                  const ViewChoice& shown);
    void addEdits(const SurveyEdits& edits);
    void addResults(const Products& products, const ViewChoice& shown);
    QStandardItem* addGroup(const QString& name, qsizetype count);
};

}  // namespace terrawalk::gui
