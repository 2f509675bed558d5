#include "app/gui/place_panel.hpp"

#include <QGridLayout>
#include <QLabel>
#include <QPainter>
#include <QScrollArea>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>

#include "app/gui/figures.hpp"
#include "app/gui/language.hpp"
#include "app/gui/report_words.hpp"
#include "app/gui/theme.hpp"

namespace terrawalk::gui {

namespace {

constexpr int kLeastWidth_px = 264;

QLabel* label(const QString& text, const char* name = nullptr) {
    auto* made = new QLabel(text);
    if (name != nullptr) made->setObjectName(name);
    made->setWordWrap(true);
    return made;
}

/// A name that may go on in the next line after any sign, and after eight characters without one.
QString breakable(const QString& name) {
    constexpr QChar kMayBreak(0x200B);
    constexpr int kLongest = 8;
    QString words;
    int together = 0;
    for (const QChar c : name) {
        words += c;
        together = c.isLetterOrNumber() ? together + 1 : kLongest;
        if (together < kLongest) continue;
        words += kMayBreak;
        together = 0;
    }
    return words;
}

QLabel* figureLabel(const QString& text) {
    auto* made = new QLabel(text);
    made->setAlignment(Qt::AlignRight | Qt::AlignVCenter);
    return made;
}

/// A share of the variance as a bar.
class ShareBar : public QWidget {
  public:
    explicit ShareBar(double share) : share_(share) { setFixedHeight(6); }

  protected:
    void paintEvent(QPaintEvent*) override {
        QPainter painter(this);
        painter.setRenderHint(QPainter::Antialiasing);
        painter.setPen(Qt::NoPen);
        painter.setBrush(palette().color(QPalette::Mid));
        painter.drawRoundedRect(rect(), 3, 3);
        painter.setBrush(accentColour());
        QRectF filled = rect();
        filled.setWidth(std::max(6.0, filled.width() * share_));
        painter.drawRoundedRect(filled, 3, 3);
    }

  private:
    double share_;
};

void addPart(QGridLayout& grid, const QString& name, double part_m, double sigma_m) {
    const int row = grid.rowCount();
    grid.addWidget(label(name), row, 0);
    grid.addWidget(figureLabel(lengthText(part_m)), row, 1);
    grid.addWidget(new ShareBar(sigma_m > 0.0 ? part_m * part_m / (sigma_m * sigma_m) : 0.0), row + 1, 0, 1,
                   2);
}

QString sourceName(CellSource source) {
    switch (source) {
        case CellSource::Measured:
            return PlacePanel::tr("a point lies in this cell");
        case CellSource::Interpolated:
            return PlacePanel::tr("between points");
        case CellSource::Extrapolated:
            return PlacePanel::tr("far from any point");
        case CellSource::None:
            break;
    }
    return {};
}

/// What stands most in the way of a better height, and what would help.
QString adviceText(const PlaceReport& place) {
    if (!place.height_m) {
        return place.nearest.empty()
                   ? PlacePanel::tr("Nobody walked here: there is no surface.")
                   : PlacePanel::tr("There is no surface here: the nearest hit lies %1 away.")
                         .arg(lengthText(place.nearest.front().distance_m, 1));
    }
    if (!place.parts) return PlacePanel::tr("The survey has too few points to tell how sure this height is.");
    const SigmaParts& p = *place.parts;
    const std::pair<double, QString> causes[] = {
        {p.track_m, PlacePanel::tr("the height of the track")},
        {p.plan_m, PlacePanel::tr("the track's error in plan, on this slope")},
        {p.attitude_m, PlacePanel::tr("the direction of the ray, on this slope")},
        {p.interpolation_m, PlacePanel::tr("the way between the points")}};
    const auto largest = std::max_element(std::begin(causes), std::end(causes),
                                          [](const auto& a, const auto& b) { return a.first < b.first; });
    const QString advice =
        PlacePanel::tr("Most of it is %1 (%2).").arg(largest->second, lengthText(largest->first));
    const bool helps = *place.sigma_m - *place.sigma_after_pass_m > 0.05 * *place.sigma_m;
    return joinSentences(
        {advice, helps ? PlacePanel::tr("One more pass here would bring %1 down to about %2.")
                             .arg(lengthText(*place.sigma_m), lengthText(*place.sigma_after_pass_m))
                       : PlacePanel::tr("One more pass here would hardly help.")});
}

void addSigma(QVBoxLayout& column, const PlaceReport& place) {
    column.addWidget(label(PlacePanel::tr("Where the uncertainty comes from"), "cardTitle"));
    auto* grid = new QGridLayout;
    grid->setHorizontalSpacing(kGrid_px);
    grid->setVerticalSpacing(2);
    grid->setColumnStretch(0, 1);
    const SigmaParts& p = *place.parts;
    addPart(*grid, PlacePanel::tr("Height of the track"), p.track_m, *place.sigma_m);
    addPart(*grid, PlacePanel::tr("Track in plan × slope"), p.plan_m, *place.sigma_m);
    addPart(*grid, PlacePanel::tr("Attitude × range × slope"), p.attitude_m, *place.sigma_m);
    addPart(*grid, PlacePanel::tr("Between points, noise"), p.interpolation_m, *place.sigma_m);
    column.addLayout(grid);
}

void addSamples(QVBoxLayout& column, const PlaceReport& place) {
    column.addWidget(label(PlacePanel::tr("Nearest hits"), "cardTitle"));
    auto* grid = new QGridLayout;
    grid->setHorizontalSpacing(kGrid_px);
    grid->setVerticalSpacing(2);
    grid->setColumnStretch(0, 1);
    const QStringList heads{PlacePanel::tr("Run, time"), PlacePanel::tr("away (%1)").arg(lengthUnit()),
                            PlacePanel::tr("height"), PlacePanel::tr("σ")};
    for (int c = 0; c < heads.size(); ++c) {
        auto* head = c == 0 ? label(heads[c]) : figureLabel(heads[c]);
        head->setObjectName("quiet");
        grid->addWidget(head, 0, c);
    }
    for (const NearSample& sample : place.nearest) {
        const int row = grid->rowCount();
        const QString run = QString::fromStdString(sample.run_id);
        // Narrow columns break between the run, its time, and why the hit was not used.
        QString where = breakable(run) + ' ' + number(sample.time_s, 1) + QChar(QChar::Nbsp) + 's';
        const bool used = sample.state == GroundPointState::Used;
        if (!used) where += " · " + reportWords(name(sample.state));
        grid->addWidget(label(where, used ? nullptr : "quiet"), row, 0);
        grid->addWidget(figureLabel(number(inUnit(sample.distance_m), 2)), row, 1);
        grid->addWidget(figureLabel(number(inUnit(sample.height_m), 2)), row, 2);
        grid->addWidget(figureLabel(number(inUnit(sample.sigma_height_m), 2)), row, 3);
    }
    column.addLayout(grid);
}

}  // namespace

PlacePanel::PlacePanel(QWidget* parent) : QFrame(parent) {
    setMinimumWidth(kLeastWidth_px);
    scroll_ = new QScrollArea;
    scroll_->setWidgetResizable(true);
    scroll_->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
    auto* outer = new QVBoxLayout(this);
    outer->setContentsMargins(0, 0, 0, 0);
    outer->addWidget(scroll_);
    auto* holder = new QWidget;
    column_ = new QVBoxLayout(holder);
    column_->setContentsMargins(2 * kGrid_px, kGrid_px, 2 * kGrid_px, kGrid_px);
    scroll_->setWidget(holder);
    clear();
}

void PlacePanel::rebuild() {
    delete content_;
    content_ = new QWidget;
    auto* inner = new QVBoxLayout(content_);
    inner->setContentsMargins(0, 0, 0, 0);
    inner->setSpacing(kGrid_px);
    column_->addWidget(content_);
}

void PlacePanel::clear() {
    rebuild();
    auto& column = *static_cast<QVBoxLayout*>(content_->layout());
    column.addWidget(
        label(tr("Click the map: this panel tells the height there, how sure it is, and why."), "quiet"));
    column.addStretch();
}

void PlacePanel::show(const PlaceReport& place) {
    rebuild();
    auto& column = *static_cast<QVBoxLayout*>(content_->layout());
    auto* height = label(place.height_m ? lengthText(*place.height_m) +
                                              (place.sigma_m ? " ± " + lengthText(*place.sigma_m) : QString())
                                        : tr("no surface"),
                         "figure");
    column.addWidget(height);
    QString where = tr("E %1, N %2").arg(number(place.map_m.x(), 2), number(place.map_m.y(), 2));
    if (place.parts) {
        where += tr(" · slope %1° · %2 to the nearest point · %3 points/m² · %4")
                     .arg(number(std::atan(place.slope) * 180.0 / kPi, 0), lengthText(place.distance_m),
                          number(place.density_per_m2, 1), sourceName(place.source));
    }
    column.addWidget(label(where, "quiet"));
    auto* advice = label(adviceText(place));
    advice->setObjectName("advice");
    column.addWidget(advice);
    if (place.parts) addSigma(column, place);
    if (!place.nearest.empty()) addSamples(column, place);
    column.addStretch();
    fitHeight();
}

void PlacePanel::resizeEvent(QResizeEvent*) {
    fitHeight();
}

// Wrapped texts are as high as the panel is narrow: their layout asks for too little by itself.
void PlacePanel::fitHeight() {
    const QMargins margins = column_->contentsMargins();
    const int width = scroll_->viewport()->width() - margins.left() - margins.right();
    content_->setMinimumHeight(content_->layout()->heightForWidth(std::max(width, 120)));
}

}  // namespace terrawalk::gui
