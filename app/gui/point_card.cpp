#include "app/gui/point_card.hpp"

#include <QHBoxLayout>
#include <QToolButton>
#include <QVBoxLayout>
#include <cmath>

#include "app/gui/figures.hpp"
#include "app/gui/theme.hpp"
#include "app/pipeline/place_report.hpp"

namespace terrawalk::gui {

namespace {

constexpr double kAround_s = 5.0;

QString sourceText(std::uint8_t source) {
    switch (static_cast<CellSource>(source)) {
        case CellSource::Measured:
            return PointCard::tr("measured");
        case CellSource::Interpolated:
            return PointCard::tr("interpolated");
        case CellSource::Extrapolated:
            return PointCard::tr("extrapolated");
        case CellSource::None:
            break;
    }
    return PointCard::tr("not known");
}

void addCell(const Products& products, const Eigen::Vector3d& map_m, PlaceFacts& facts) {
    const auto cell = products.dem.geometry.cellAt(map_m.x(), map_m.y());
    if (!cell || !products.uncertainty) return;
    const SurfaceUncertainty& known = *products.uncertainty;
    if (std::isfinite(known.sigmas_m[*cell])) {
        facts.lines.emplace_back(
            PointCard::tr("1 σ"),
            lengthText(static_cast<double>(known.sigmas_m[*cell])).prepend(QString::fromUtf8("± ")));
    }
    facts.lines.emplace_back(
        PointCard::tr("Density"),
        PointCard::tr("%1 points/m²").arg(number(static_cast<double>(known.density_per_m2[*cell]), 2)));
    facts.lines.emplace_back(PointCard::tr("Source"), sourceText(known.sources[*cell]));
}

}  // namespace

PlaceFacts placeFacts(const Survey& survey, const Products& products,
                      const std::vector<Eigen::Vector3d>& points_map_m, const Eigen::Vector3d& map_m) {
    PlaceFacts facts;
    facts.title = PointCard::tr("Height %1").arg(lengthText(map_m.z()));
    addCell(products, map_m, facts);
    facts.lines.emplace_back("E", number(map_m.x(), 2) + " m");
    facts.lines.emplace_back("N", number(map_m.y(), 2) + " m");
    const auto nearest = nearestCarrying(products, points_map_m, map_m.head<2>());
    if (!nearest) return facts;
    const GroundPoint& point = products.ground_points[nearest->point];
    const QString run = QString::fromStdString(survey.runs[point.run].id);
    facts.lines.emplace_back(PointCard::tr("Nearest sample"),
                             PointCard::tr("%1 away").arg(lengthText(nearest->distance_m)));
    facts.lines.emplace_back(PointCard::tr("Its run, time"),
                             QString::fromUtf8("%1, %2 s").arg(run, number(point.time_s, 1)));
    facts.lines.emplace_back(PointCard::tr("Its height"),
                             QString::fromUtf8("%1 ± %2").arg(lengthText(points_map_m[nearest->point].z()),
                                                              lengthText(point.sigma_u_m)));
    const auto& times = survey.runs[point.run].log.time_s;
    facts.around = TrackStretch{run, std::max(point.time_s - kAround_s, times.front()),
                                std::min(point.time_s + kAround_s, times.back())};
    return facts;
}

PointCard::PointCard(QWidget* parent) : QFrame(parent) {
    setObjectName("card");
    setAccessibleName(tr("What is known of the picked point"));
    setAttribute(Qt::WA_StyledBackground);
    auto* body = new QVBoxLayout(this);
    body->setContentsMargins(12, kGrid_px, kGrid_px, 12);
    body->setSpacing(kGrid_px);
    auto* head = new QHBoxLayout;
    title_ = new QLabel;
    title_->setObjectName("cardTitle");
    head->addWidget(title_, 1);
    auto* close = new QToolButton;
    close->setObjectName("closeCard");
    close->setText(QString::fromUtf8("×"));
    close->setAutoRaise(true);
    close->setToolTip(tr("Close"));
    close->setAccessibleName(tr("Close"));
    connect(close, &QToolButton::clicked, this, &PointCard::closed);
    head->addWidget(close);
    body->addLayout(head);
    text_ = new QLabel;
    text_->setObjectName("pointFacts");
    text_->setTextFormat(Qt::RichText);
    text_->setTextInteractionFlags(Qt::TextSelectableByMouse);
    body->addWidget(text_);
    select_ = new QPushButton(tr("Select this stretch"));
    select_->setObjectName("selectStretch");
    select_->setToolTip(
        tr("Selects the track five seconds before and after the nearest sample, in all views."));
    connect(select_, &QPushButton::clicked, this, [this] {
        if (around_) Q_EMIT stretchAsked(*around_);
    });
    body->addWidget(select_);
    hide();
}

void PointCard::show(const PlaceFacts& facts) {
    title_->setText(facts.title);
    QString table = "<table cellspacing='0' cellpadding='0'>";
    for (const auto& [what, how_much] : facts.lines) {
        table += QString("<tr><td style='color:%1; padding-right:16px'>%2</td><td align='right'>%3</td></tr>")
                     .arg(quietColour().name(), what.toHtmlEscaped(), how_much.toHtmlEscaped());
    }
    text_->setText(table + "</table>");
    around_ = facts.around;
    select_->setVisible(around_.has_value());
    adjustSize();
    QFrame::show();
    raise();
}

}  // namespace terrawalk::gui
