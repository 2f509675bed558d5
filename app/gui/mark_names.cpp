#include "app/gui/mark_names.hpp"

#include <QLineF>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

namespace terrawalk::gui {

namespace {

constexpr double kSymbol_px = 16.0;
constexpr double kHalo_px = 2.5;

/// Boxes by the squares of the screen that they lie in, so that hundreds of marks take no time.
class TakenBoxes {
  public:
    void add(const QRectF& box) {
        boxes_.push_back(box);
        forSquares(box, [&](const Square& square) {
            in_[square].push_back(boxes_.size() - 1);
            return true;
        });
    }
    [[nodiscard]] bool free(const QRectF& box) const {
        return forSquares(box, [&](const Square& square) {
            const auto found = in_.find(square);
            return found == in_.end() || std::none_of(found->second.begin(), found->second.end(),
                                                      [&](auto i) { return boxes_[i].intersects(box); });
        });
    }
    /// The area of a box that others take, in all.
    [[nodiscard]] double overlap(const QRectF& box) const {
        double area = 0.0;
        for (const QRectF& other : boxes_) {
            const QRectF both = other.intersected(box);
            area += std::max(both.width(), 0.0) * std::max(both.height(), 0.0);
        }
        return area;
    }

  private:
    using Square = std::pair<int, int>;
    /// Until one of them says no; whether all said yes.
    template <class Visit>
    static bool forSquares(const QRectF& box, const Visit& visit) {
        constexpr double kSide_px = 64.0;
        const auto index = [](double px) {
            return static_cast<int>(std::floor(px / kSide_px));
        };
        for (int x = index(box.left()); x <= index(box.right()); ++x) {
            for (int y = index(box.top()); y <= index(box.bottom()); ++y) {
                if (!visit(Square{x, y})) return false;
            }
        }
        return true;
    }
    std::vector<QRectF> boxes_;
    std::map<Square, std::vector<std::size_t>> in_;
};

/// Whether a line goes through a box.
bool crosses(const QLineF& line, const QRectF& box) {
    if (box.contains(line.p1()) || box.contains(line.p2())) return true;
    const std::array sides{QLineF(box.topLeft(), box.topRight()), QLineF(box.topRight(), box.bottomRight()),
                           QLineF(box.bottomRight(), box.bottomLeft()),
                           QLineF(box.bottomLeft(), box.topLeft())};
    return std::any_of(sides.begin(), sides.end(), [&](const QLineF& side) {
        return line.intersects(side) == QLineF::BoundedIntersection;
    });
}

/// From the edge of the symbol to the nearest point of the name; none where they touch.
std::optional<QLineF> leadTo(QPointF symbol, const QRectF& box) {
    const QPointF end(std::clamp(symbol.x(), box.left() - 1.0, box.right() + 1.0),
                      std::clamp(symbol.y(), box.top() + 2.0, box.bottom() - 2.0));
    const QPointF way = end - symbol;
    const double length = std::hypot(way.x(), way.y());
    if (length < kSymbol_px / 2.0) return std::nullopt;
    return QLineF(symbol + way * (0.4 * kSymbol_px / length), end);
}

/// Lower left corners of a name about its symbol.
using Corners = std::vector<QPointF>;

/// Beside the symbol, the best place first.
Corners nearCorners(const QFontMetricsF& metrics, double width_px) {
    constexpr double kOff_px = 9.0;
    const double middle = 0.4 * metrics.ascent();
    return {QPointF(kOff_px, middle), QPointF(-kOff_px - width_px, middle),
            QPointF(-0.5 * width_px, -kOff_px - metrics.descent()),
            QPointF(-0.5 * width_px, kOff_px + metrics.ascent())};
}

/// On rings about the symbol, the nearest first, from the upper right around.
Corners farCorners(const QFontMetricsF& metrics, double width_px) {
    constexpr std::array kRings_px{26.0, 42.0};
    constexpr int kDirections = 12;
    Corners corners;
    for (const double ring_px : kRings_px) {
        for (int i = 0; i < kDirections; ++i) {
            const double angle_rad = (0.5 + i) * 2.0 * M_PI / kDirections;
            const QPointF end(ring_px * std::cos(angle_rad), -ring_px * std::sin(angle_rad));
            corners.push_back(end + QPointF(end.x() < 0.0 ? -width_px : 0.0, 0.4 * metrics.ascent()));
        }
    }
    return corners;
}

class NamePlacer {
  public:
    NamePlacer(const QFontMetricsF& metrics, const std::vector<MarkName>& marks, const NameRoom& room)
        : metrics_(metrics), marks_(marks), room_(room) {
        for (const QRectF& box : room.reserved) taken_.add(box);
        for (const MarkName& mark : marks) {
            if (!room.seen.contains(mark.at)) continue;
            taken_.add(symbolBox(mark));
            if (mark.pin_px > 0.0) taken_.add({mark.at.x() - 2.0, mark.at.y(), 4.0, mark.pin_px});
        }
    }

    std::vector<PlacedName> place() {
        for (std::size_t mark = 0; mark < marks_.size(); ++mark) {
            if (!room_.seen.contains(marks_[mark].at)) continue;
            if (!placeAtFree(mark, Where::Near)) without_place_.push_back(mark);
        }
        for (const Where where : {Where::ClearLine, Where::AnyLine}) {
            if (room_.far_too)
                std::erase_if(without_place_, [&](std::size_t mark) { return placeAtFree(mark, where); });
        }
        for (const std::size_t mark : without_place_) placeAtLeastBad(mark);
        return std::move(placed_);
    }

  private:
    [[nodiscard]] double width(std::size_t mark) const {
        return metrics_.horizontalAdvance(marks_[mark].name);
    }
    [[nodiscard]] QRectF boxAt(std::size_t mark, QPointF corner) const {
        return {marks_[mark].at + corner - QPointF(0, metrics_.ascent()),
                QSizeF(width(mark), metrics_.height())};
    }
    void put(std::size_t mark, QPointF corner, bool led) {
        placed_.push_back({mark, marks_[mark].at + corner, boxAt(mark, corner), led});
        taken_.add(placed_.back().box);
    }
    enum class Where { Near, ClearLine, AnyLine };
    bool placeAtFree(std::size_t mark, Where where) {
        const bool led = where != Where::Near;
        const Corners corners = led ? farCorners(metrics_, width(mark)) : nearCorners(metrics_, width(mark));
        const auto corner = std::find_if(corners.begin(), corners.end(), [&](QPointF c) {
            const QRectF box = boxAt(mark, c);
            return room_.seen.contains(box) &&
                   (where == Where::ClearLine ? freeWithLine(mark, box) : taken_.free(box));
        });
        if (corner == corners.end()) return false;
        put(mark, *corner, led);
        return true;
    }
    /// A line may not strike names out or join two of them, nor may a name lie on the line of another.
    [[nodiscard]] bool freeWithLine(std::size_t mark, const QRectF& box) const {
        constexpr double kApart_px = 4.0;
        const auto apart = [](const QRectF& other) {
            return other.adjusted(-kApart_px, 0.0, kApart_px, 0.0);
        };
        if (!taken_.free(apart(box))) return false;
        const auto lead = leadTo(marks_[mark].at, box);
        return std::none_of(placed_.begin(), placed_.end(), [&](const PlacedName& other) {
            if (lead && crosses(*lead, apart(other.box))) return true;
            const auto others = other.led ? leadTo(marks_[other.mark].at, other.box) : std::nullopt;
            if (!others) return false;
            return crosses(*others, apart(box)) ||
                   (lead && lead->intersects(*others) == QLineF::BoundedIntersection);
        });
    }
    void placeAtLeastBad(std::size_t mark) {
        constexpr double kMostCovered = 0.25;
        const Corners corners = nearCorners(metrics_, width(mark));
        double least = HUGE_VAL;
        QPointF best;
        for (const QPointF corner : corners) {
            const QRectF box = boxAt(mark, corner), seen = box.intersected(room_.seen);
            const double overlap =
                taken_.overlap(box) + box.width() * box.height() - seen.width() * seen.height();
            if (overlap < least) best = corner;
            least = std::min(least, overlap);
        }
        const QRectF box = boxAt(mark, best);
        if (marks_[mark].highlighted || least <= kMostCovered * box.width() * box.height())
            put(mark, best, false);
    }

    const QFontMetricsF& metrics_;
    const std::vector<MarkName>& marks_;
    const NameRoom& room_;
    TakenBoxes taken_;
    std::vector<std::size_t> without_place_;
    std::vector<PlacedName> placed_;
};

void drawLead(QPainter& painter, const QLineF& lead) {
    for (const auto& [colour, width] :
         {std::pair{QColor(255, 255, 255, 200), 3.0}, std::pair{QColor(20, 24, 28), 1.0}}) {
        painter.setPen(QPen(colour, width));
        painter.drawLine(lead);
    }
}

}  // namespace

QRectF symbolBox(const MarkName& mark) {
    return {mark.at.x() - 0.5 * kSymbol_px, mark.at.y() - 0.5 * kSymbol_px, kSymbol_px, kSymbol_px};
}

MarkNames placeMarkNames(const QFontMetricsF& metrics, std::vector<MarkName> marks, const NameRoom& room) {
    MarkNames names{std::move(marks), {}};
    names.places = NamePlacer(metrics, names.marks, room).place();
    return names;
}

void drawMarkNames(QPainter& painter, const MarkNames& names, const QPalette& palette) {
    for (const PlacedName& place : names.places) {
        const MarkName& mark = names.marks[place.mark];
        painter.setOpacity(mark.opacity);
        if (!place.led) continue;
        if (const auto lead = leadTo(mark.at, place.box)) drawLead(painter, *lead);
    }
    for (const PlacedName& place : names.places) {
        const MarkName& mark = names.marks[place.mark];
        painter.setOpacity(mark.opacity);
        drawLabel(painter, place.start, mark.name, palette);
    }
    painter.setOpacity(1.0);
}

void drawLabel(QPainter& painter, QPointF at, const QString& label, const QPalette& palette) {
    constexpr double r = kHalo_px / 2.0, d = 0.7 * r;
    constexpr std::array<QPointF, 8> kAround{QPointF(r, 0), QPointF(-r, 0), QPointF(0, r),  QPointF(0, -r),
                                             QPointF(d, d), QPointF(d, -d), QPointF(-d, d), QPointF(-d, -d)};
    painter.setPen(palette.color(QPalette::Base));
    for (const QPointF& off : kAround) painter.drawText(at + off, label);
    painter.setPen(palette.color(QPalette::Text));
    painter.drawText(at, label);
}

}  // namespace terrawalk::gui
