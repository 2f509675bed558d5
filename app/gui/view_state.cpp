#include "app/gui/view_state.hpp"

#include <QCoreApplication>

namespace terrawalk::gui {

namespace {

QString words(const char* text) {
    return QCoreApplication::translate("ViewState", text);
}

void toggle(QSet<QString>& hidden, const QString& name, bool visible) {
    if (visible) {
        hidden.remove(name);
    } else {
        hidden.insert(name);
    }
}

}  // namespace

void ViewState::set(ViewChoice choice) {
    if (choice == now_) return;
    now_ = std::move(choice);
    Q_EMIT changed();
}

void ViewState::setLayer(RasterLayer layer) {
    ViewChoice next = now_;
    next.layer = layer;
    set(std::move(next));
}

void ViewState::setColouring(TrackColouring colouring) {
    ViewChoice next = now_;
    next.colouring = colouring;
    set(std::move(next));
}

void ViewState::setRunVisible(const QString& run, bool visible) {
    ViewChoice next = now_;
    toggle(next.hidden_runs, run, visible);
    set(std::move(next));
}

void ViewState::setMarkVisible(const QString& mark, bool visible) {
    ViewChoice next = now_;
    toggle(next.hidden_marks, mark, visible);
    set(std::move(next));
}

void ViewState::setShown(bool ViewChoice::*what, bool shown) {
    ViewChoice next = now_;
    next.*what = shown;
    set(std::move(next));
}

void ViewState::setEdits(const SurveyEdits& edits) {
    ViewChoice next = now_;
    next.edits = std::make_shared<const SurveyEdits>(edits);
    set(std::move(next));
}

void ViewState::setChange(std::shared_ptr<const HeightChange> change) {
    ViewChoice next = now_;
    next.change = std::move(change);
    if (next.change) {
        next.layer = RasterLayer::Change;
    } else if (next.layer == RasterLayer::Change) {
        next.layer = RasterLayer::Height;
    }
    const bool some = next.change != nullptr;
    if (some && !available_.contains(RasterLayer::Change)) available_ << RasterLayer::Change;
    if (!some) available_.removeAll(RasterLayer::Change);
    set(std::move(next));
    Q_EMIT availableChanged();
}

void ViewState::setAvailable(const QList<RasterLayer>& layers) {
    available_ = layers;
    if (now_.change && !available_.contains(RasterLayer::Change)) available_ << RasterLayer::Change;
    Q_EMIT availableChanged();
}

QList<std::pair<RasterLayer, QString>> layerNames() {
    return {{RasterLayer::Height, words(QT_TRANSLATE_NOOP("ViewState", "Shaded heights"))},
            {RasterLayer::Uncertainty, words(QT_TRANSLATE_NOOP("ViewState", "Uncertainty"))},
            {RasterLayer::Density, words(QT_TRANSLATE_NOOP("ViewState", "Point density"))},
            {RasterLayer::Source, words(QT_TRANSLATE_NOOP("ViewState", "Source of heights"))},
            {RasterLayer::Change, words(QT_TRANSLATE_NOOP("ViewState", "Change of height"))},
            {RasterLayer::None, words(QT_TRANSLATE_NOOP("ViewState", "No ground"))}};
}

QList<std::pair<TrackColouring, QString>> colouringNames() {
    return {{TrackColouring::Run, words(QT_TRANSLATE_NOOP("ViewState", "Tracks by run"))},
            {TrackColouring::Fix, words(QT_TRANSLATE_NOOP("ViewState", "Tracks by fix"))},
            {TrackColouring::Speed, words(QT_TRANSLATE_NOOP("ViewState", "Tracks by speed"))},
            {TrackColouring::Height, words(QT_TRANSLATE_NOOP("ViewState", "Tracks by height"))},
            {TrackColouring::SigmaPlan, words(QT_TRANSLATE_NOOP("ViewState", "Tracks by plan σ"))},
            {TrackColouring::SigmaHeight, words(QT_TRANSLATE_NOOP("ViewState", "Tracks by height σ"))},
            {TrackColouring::Residual, words(QT_TRANSLATE_NOOP("ViewState", "Tracks by residual"))}};
}

}  // namespace terrawalk::gui
