#include "io/svg.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "io/markup_text.hpp"

namespace terrawalk {

namespace {

/// A tenth of a pixel, without trailing zeros.
std::string pixels(double value) {
    std::string text = fmt::format("{:.1f}", value);
    if (text.ends_with(".0")) text.resize(text.size() - 2);
    return text == "-0" ? "0" : text;
}

std::string pointList(const std::vector<std::pair<double, double>>& points) {
    std::string list;
    for (const auto& [x, y] : points) {
        if (!list.empty()) list += ' ';
        list += pixels(x) + "," + pixels(y);
    }
    return list;
}

}  // namespace

double niceStep(double least) {
    if (!std::isfinite(least) || least <= 0.0) return 1.0;
    const double power = std::pow(10.0, std::floor(std::log10(least)));
    for (const double digit : {1.0, 2.0, 5.0}) {
        if (digit * power >= least * (1.0 - 1e-9)) return digit * power;
    }
    return 10.0 * power;
}

Ticks niceTicks(double low, double high, int most) {
    Ticks ticks;
    if (!std::isfinite(low) || !std::isfinite(high) || !(high > low) || most < 1) return ticks;
    ticks.step = niceStep((high - low) / most);
    ticks.decimals = std::max(0, -static_cast<int>(std::floor(std::log10(ticks.step) + 1e-9)));
    // Whole multiples of the step, so that no error builds up and zero is exactly zero.
    const double first = std::ceil(low / ticks.step - 1e-9), last = std::floor(high / ticks.step + 1e-9);
    for (int i = 0; i <= most && first + i <= last; ++i) {
        // Adding zero turns a negative zero into a plain one.
        ticks.values.push_back((first + i) * ticks.step + 0.0);
    }
    return ticks;
}

Svg::Svg(double width, double height, std::string_view label)
    : width_(width), height_(height), label_(label) {}

void Svg::element(std::string_view tag, std::string_view attributes, std::string_view css,
                  std::string_view tooltip) {
    fmt::format_to(std::back_inserter(body_), "<{} {}", tag, attributes);
    if (!css.empty()) fmt::format_to(std::back_inserter(body_), " class=\"{}\"", css);
    if (tooltip.empty()) {
        body_ += "/>\n";
    } else {
        fmt::format_to(std::back_inserter(body_), "><title>{}</title></{}>\n", escapedMarkup(tooltip), tag);
    }
}

void Svg::line(double x1, double y1, double x2, double y2, std::string_view css) {
    element("line",
            fmt::format(R"(x1="{}" y1="{}" x2="{}" y2="{}")", pixels(x1), pixels(y1), pixels(x2), pixels(y2)),
            css, {});
}

void Svg::rectangle(double x, double y, double width, double height, std::string_view css,
                    std::string_view tooltip) {
    element("rect",
            fmt::format(R"(x="{}" y="{}" width="{}" height="{}")", pixels(x), pixels(y), pixels(width),
                        pixels(height)),
            css, tooltip);
}

void Svg::circle(double x, double y, double radius, std::string_view css, std::string_view tooltip) {
    element("circle", fmt::format(R"(cx="{}" cy="{}" r="{}")", pixels(x), pixels(y), pixels(radius)), css,
            tooltip);
}

void Svg::polyline(const std::vector<std::pair<double, double>>& points, std::string_view css,
                   std::string_view tooltip) {
    if (points.size() < 2) return;
    element("polyline", fmt::format(R"(points="{}")", pointList(points)), css, tooltip);
}

void Svg::polygon(const std::vector<std::pair<double, double>>& points, std::string_view css,
                  std::string_view tooltip) {
    element("polygon", fmt::format(R"(points="{}")", pointList(points)), css, tooltip);
}

void Svg::image(double x, double y, double width, double height, std::string_view png) {
    element(
        "image",
        fmt::format(
            R"(x="{}" y="{}" width="{}" height="{}" preserveAspectRatio="none" href="data:image/png;base64,{}")",
            pixels(x), pixels(y), pixels(width), pixels(height), base64(png)),
        {}, {});
}

void Svg::text(double x, double y, std::string_view words, std::string_view css, Anchor anchor,
               double turn_deg) {
    this->words(x, y, words, css, anchor, turn_deg, {});
}

void Svg::name(double x, double y, std::string_view name, std::string_view css, Anchor anchor,
               double turn_deg) {
    words(x, y, name, css, anchor, turn_deg, R"( translate="no")");
}

void Svg::words(double x, double y, std::string_view words, std::string_view css, Anchor anchor,
                double turn_deg, std::string_view attributes) {
    auto out = std::back_inserter(body_);
    fmt::format_to(out, R"(<text x="{}" y="{}")", pixels(x), pixels(y));
    if (anchor != Anchor::Start) {
        fmt::format_to(out, R"( text-anchor="{}")", anchor == Anchor::Middle ? "middle" : "end");
    }
    if (turn_deg != 0.0)
        fmt::format_to(out, " transform=\"rotate({} {} {})\"", turn_deg, pixels(x), pixels(y));
    if (!css.empty()) fmt::format_to(out, R"( class="{}")", css);
    fmt::format_to(out, "{}>{}</text>\n", attributes, escapedMarkup(words));
}

std::string Svg::str() const {
    const std::string w = pixels(width_), h = pixels(height_);
    return fmt::format(
        "<svg viewBox=\"0 0 {} {}\" style=\"max-width:{}px\" role=\"img\" aria-label=\"{}\">\n{}</svg>\n", w,
        h, w, escapedMarkup(label_), body_);
}

std::string Svg::file(std::string_view css) const {
    const std::string w = pixels(width_), h = pixels(height_);
    return fmt::format(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\">\n"
        "<title>{2}</title>\n<style>{3}</style>\n{4}</svg>\n",
        w, h, escapedMarkup(label_), css, body_);
}

}  // namespace terrawalk
