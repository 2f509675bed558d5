#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace terrawalk {

/// Round numbers along an axis: 1, 2 or 5 times a power of ten apart.
struct Ticks {
    std::vector<double> values;
    double step = 1.0;
    int decimals = 0;  ///< with which every value prints in full
};

/// The least of 1, 2, 5 x 10^k that is not below `least`; 1 when `least` is not a positive number.
[[nodiscard]] double niceStep(double least);
/// At most `most` + 1 ticks within [low, high]; none when that is no range.
[[nodiscard]] Ticks niceTicks(double low, double high, int most);

enum class Anchor { Start, Middle, End };

/// A drawing in pixels, y downwards. Looks come from CSS classes alone, so that text and lines follow the
/// page's colours. All text is escaped here.
class Svg {
  public:
    /// @param label  what the drawing shows, for readers who cannot see it
    Svg(double width, double height, std::string_view label);

    void line(double x1, double y1, double x2, double y2, std::string_view css);
    void rectangle(double x, double y, double width, double height, std::string_view css,
                   std::string_view tooltip = {});
    void circle(double x, double y, double radius, std::string_view css, std::string_view tooltip = {});
    /// Open line through the points; drawn only when there are two.
    void polyline(const std::vector<std::pair<double, double>>& points, std::string_view css,
                  std::string_view tooltip = {});
    void polygon(const std::vector<std::pair<double, double>>& points, std::string_view css,
                 std::string_view tooltip = {});
    /// A PNG file, stretched over the rectangle.
    void image(double x, double y, double width, double height, std::string_view png);
    /// @param turn_deg  clockwise about (x, y)
    void text(double x, double y, std::string_view words, std::string_view css, Anchor anchor = Anchor::Start,
              double turn_deg = 0.0);
    /// A name, which is the same in every language.
    void name(double x, double y, std::string_view name, std::string_view css, Anchor anchor = Anchor::Start,
              double turn_deg = 0.0);

    /// The element, no wider on the page than it was drawn.
    [[nodiscard]] std::string str() const;
    /// A stand-alone SVG file, which brings its own style.
    /// @param css  holds none of < and &
    [[nodiscard]] std::string file(std::string_view css) const;

  private:
    void words(double x, double y, std::string_view words, std::string_view css, Anchor anchor,
               double turn_deg, std::string_view attributes);
    void element(std::string_view tag, std::string_view attributes, std::string_view css,
                 std::string_view tooltip);
    double width_;
    double height_;
    std::string label_;
    std::string body_;
};

}  // namespace terrawalk
