#include "app/gui/accuracy_panel.hpp"

#include <QFrame>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QScrollArea>
#include <QScrollBar>
#include <QTableView>
#include <QTableWidget>
#include <QVBoxLayout>
#include <cmath>

#include "app/gui/accuracy_words.hpp"
#include "app/gui/figures.hpp"
#include "app/gui/report_words.hpp"
#include "app/gui/tables.hpp"
#include "app/gui/theme.hpp"

namespace terrawalk::gui {

namespace {

QString text(const std::string& utf8) {
    return QString::fromStdString(utf8);
}

QLabel* heading(const QString& words) {
    auto* label = new QLabel(words);
    label->setObjectName("heading");
    return label;
}

QWidget* figureCard(const KeyFigure& figure) {
    auto* card = new QFrame;
    card->setObjectName("card");
    auto* column = new QVBoxLayout(card);
    column->setContentsMargins(12, 12, 12, 12);
    column->setSpacing(4);
    auto* value = new QLabel(reportWords(figure.value));
    value->setObjectName("figure");
    auto* name = new QLabel(reportWords(figure.label));
    name->setWordWrap(true);
    auto* detail = new QLabel(reportWords(figure.detail));
    detail->setObjectName("quiet");
    detail->setWordWrap(true);
    column->addWidget(value);
    column->addWidget(name);
    column->addWidget(detail);
    column->addStretch();
    return card;
}

/// A table that is as high as its rows: the page scrolls, not the table.
void fitHeight(QTableView& table) {
    int height = table.horizontalHeader()->sizeHint().height() + 2 * table.frameWidth() + 2;
    for (int row = 0; row < table.model()->rowCount(); ++row) height += table.rowHeight(row);
    // Where the columns have no room, the bar under them must not lie on the last row.
    if (table.horizontalHeader()->length() > table.width() - 2 * table.frameWidth())
        height += table.horizontalScrollBar()->sizeHint().height();
    table.setFixedHeight(height);
}

constexpr int kComparedColumn = 1;

/// Columns as wide as their texts; one of them takes the room that is left.
void fillWidth(QTableView& table, int column) {
    table.resizeColumnsToContents();
    QHeaderView& header = *table.horizontalHeader();
    // Its viewport follows a new size later.
    const int rest = table.width() - 2 * table.frameWidth() - header.length();
    if (rest > 0) header.resizeSection(column, header.sectionSize(column) + rest);
}

void dress(QTableView& table) {
    dressTable(table, 26);
    table.setAlternatingRowColors(true);
    table.setSelectionMode(QAbstractItemView::SingleSelection);
    table.setEditTriggers(QAbstractItemView::NoEditTriggers);
    table.setVerticalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
}

QString bullets(const std::vector<std::string>& lines) {
    QString html;
    for (const std::string& line : lines) html += "<li>" + reportWords(line).toHtmlEscaped() + "</li>";
    return html.isEmpty() ? html : "<ul style='margin-left: -24px'>" + html + "</ul>";
}

}  // namespace

AccuracyPanel::AccuracyPanel(Selection& selection, QWidget* parent) : QWidget(parent), selection_(selection) {
    auto* outer = new QVBoxLayout(this);
    outer->setContentsMargins(0, 0, 0, 0);
    auto* hint =
        new QLabel(tr("Nothing to judge yet. Process the survey: its errors at the marks will stand here."));
    hint->setObjectName("quiet");
    hint->setAlignment(Qt::AlignCenter);
    empty_ = hint;
    outer->addWidget(empty_, 1);

    content_ = new QScrollArea;
    auto* page = new QWidget;
    auto* column = new QVBoxLayout(page);
    column->setContentsMargins(2 * kGrid_px, 3 * kGrid_px, 2 * kGrid_px, 3 * kGrid_px);
    column->setSpacing(2 * kGrid_px);
    figures_ = new QHBoxLayout;
    figures_->setSpacing(kGrid_px);
    column->addLayout(figures_);
    column->addWidget(heading(tr("Errors by group (%1)").arg(lengthUnit())));
    groups_ = new QTableView;
    groups_->setObjectName("groups");
    groups_->setModel(&model_);
    dress(*groups_);
    groups_->installEventFilter(this);
    column->addWidget(groups_);
    words_ = new QLabel;
    words_->setWordWrap(true);
    words_->setTextInteractionFlags(Qt::TextSelectableByMouse);
    column->addWidget(words_);
    column->addWidget(heading(tr("Surface less mark, the largest first")));
    marks_ = new QTableWidget;
    marks_->setObjectName("marks");
    dress(*marks_);
    marks_->installEventFilter(this);
    column->addWidget(marks_);
    column->addStretch();
    auto* scroll = static_cast<QScrollArea*>(content_);
    scroll->setWidget(page);
    scroll->setWidgetResizable(true);
    outer->addWidget(content_, 1);
    connect(marks_, &QTableWidget::itemSelectionChanged, this, [this] {
        const auto rows = marks_->selectionModel()->selectedRows();
        if (!rows.isEmpty()) selection_.selectItem(marks_->item(rows.front().row(), 0)->text());
    });
    show(nullptr);
}

void AccuracyPanel::show(std::shared_ptr<const Products> products) {
    empty_->setVisible(!products);
    content_->setVisible(products != nullptr);
    if (!products) return;
    const SurveyReport& report = products->report;
    fillFigures(report);
    model_.show(report.accuracy, report.headline);
    fillWidth(*groups_, kComparedColumn);
    groups_->setHorizontalScrollBarPolicy(Qt::ScrollBarAsNeeded);
    fitHeight(*groups_);
    fillWords(report);
    fillMarks(report);
}

bool AccuracyPanel::eventFilter(QObject* watched, QEvent* event) {
    auto* table = qobject_cast<QTableView*>(watched);
    if (table == groups_ && event->type() == QEvent::Resize) fillWidth(*groups_, kComparedColumn);
    if (table != nullptr && event->type() == QEvent::Resize) fitHeight(*table);
    return QWidget::eventFilter(watched, event);
}

void AccuracyPanel::fillFigures(const SurveyReport& report) {
    while (QLayoutItem* item = figures_->takeAt(0)) {
        delete item->widget();
        delete item;
    }
    for (const KeyFigure& figure : report.figures) figures_->addWidget(figureCard(figure), 1);
}

void AccuracyPanel::fillWords(const SurveyReport& report) {
    QString html;
    const auto add = [&](const QString& title, const std::vector<std::string>& lines) {
        if (!lines.empty()) html += "<p><b>" + title + "</b></p>" + bullets(lines);
    };
    add(tr("What the marks say"), report.statements);
    add(tr("What could not be checked"), report.limitations);
    add(tr("Warnings"), report.warnings);
    words_->setText(html);
}

void AccuracyPanel::fillMarks(const SurveyReport& report) {
    std::vector<const Residual*> rows;
    for (const Residual& r : report.residuals) {
        if (r.stage == Stage::Surface && r.quantity == Quantity::SurfaceHeight) rows.push_back(&r);
    }
    std::sort(rows.begin(), rows.end(), [](const Residual* a, const Residual* b) {
        return std::abs(a->difference_enu_m.z()) > std::abs(b->difference_enu_m.z());
    });
    marks_->clear();
    marks_->setColumnCount(5);
    marks_->setRowCount(static_cast<int>(rows.size()));
    marks_->setHorizontalHeaderLabels({tr("Mark"), tr("Role"), tr("Height error (%1)").arg(lengthUnit()),
                                       tr("Predicted σ (%1)").arg(lengthUnit()), tr("Error / σ")});
    for (int column = 2; column < 5; ++column) {
        marks_->horizontalHeaderItem(column)->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
    }
    marks_->horizontalHeaderItem(0)->setTextAlignment(Qt::AlignLeft | Qt::AlignVCenter);
    marks_->horizontalHeaderItem(1)->setTextAlignment(Qt::AlignLeft | Qt::AlignVCenter);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const Residual& r = *rows[i];
        const int row = static_cast<int>(i);
        const double d = r.difference_enu_m.z(), sigma = r.sigma_enu_m.z();
        marks_->setItem(row, 0, tableCell(text(r.mark), false));
        marks_->setItem(row, 1, tableCell(r.role == MarkRole::Control ? tr("control") : tr("check"), false));
        const QString words = signedLength(d);
        marks_->setItem(row, 2, tableCell(words.left(words.indexOf(' ')), true));
        marks_->setItem(row, 3, tableCell(present(sigma) ? number(inUnit(sigma), 3) : "–", true));
        auto* ratio = tableCell(present(sigma) ? number(std::abs(d) / sigma, 1) : "–", true);
        if (present(sigma) && std::abs(d) > 1.96 * sigma) ratio->setForeground(warningColour());
        marks_->setItem(row, 4, ratio);
    }
    marks_->resizeColumnsToContents();
    marks_->horizontalHeader()->setSectionResizeMode(1, QHeaderView::Stretch);
    fitHeight(*marks_);
}

}  // namespace terrawalk::gui
