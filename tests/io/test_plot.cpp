#include "io/plot.hpp"

#include <cpl_minixml.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <memory>
#include <sstream>

namespace terrawalk {
namespace {

using testing::HasSubstr;
using testing::Not;

struct Element {
    std::string tag;
    CPLXMLNode* node;
    [[nodiscard]] std::string attribute(const char* key) const { return CPLGetXMLValue(node, key, ""); }
    [[nodiscard]] double number(const char* key) const { return std::stod(attribute(key)); }
    [[nodiscard]] bool hasClass(const std::string& css) const {
        std::istringstream words(attribute("class"));
        return std::find(std::istream_iterator<std::string>(words), {}, css) !=
               std::istream_iterator<std::string>();
    }
};

/// The drawing as a viewer sees it; a file that is no XML has no elements.
class Drawing {
  public:
    explicit Drawing(const Plot& plot)
        : text(plotSvg(plot)), tree_(CPLParseXMLString(text.c_str()), &CPLDestroyXMLNode) {
        collect(tree_.get());
    }
    [[nodiscard]] std::vector<Element> withClass(const std::string& css) const {
        std::vector<Element> found;
        for (const Element& element : elements_) {
            if (element.hasClass(css)) found.push_back(element);
        }
        return found;
    }
    [[nodiscard]] bool isSvg() const {
        return !elements_.empty() && elements_.front().tag == "svg" &&
               elements_.front().attribute("xmlns") == "http://www.w3.org/2000/svg";
    }
    std::string text;

  private:
    void collect(CPLXMLNode* node) {
        for (; node != nullptr; node = node->psNext) {
            if (node->eType != CXT_Element) continue;
            if (node->pszValue[0] != '?') elements_.push_back({node->pszValue, node});
            collect(node->psChild);
        }
    }
    std::unique_ptr<CPLXMLNode, decltype(&CPLDestroyXMLNode)> tree_;
    std::vector<Element> elements_;
};

std::vector<std::pair<double, double>> pointsOf(const Element& polyline) {
    std::vector<std::pair<double, double>> points;
    std::istringstream list(polyline.attribute("points"));
    double x = 0.0;
    double y = 0.0;
    char comma = 0;
    while (list >> x >> comma >> y) points.emplace_back(x, y);
    return points;
}

Plot one(PlotPanel panel) {
    return {.title = "t", .note = "n", .panels = {std::move(panel)}};
}

TEST(Plot, IsAnSvgFileWhateverNamesSay) {
    PlotPanel panel{.title = "<b> & \"c\"", .x = {.label = "x > 1"}, .y = {.label = "y & z"}};
    panel.series = {{.name = "a<b>&", .points = {{0, 0}, {1, 1}}}};
    panel.samples = {};
    const Drawing drawing(
        {.title = "1 < 2 & 3", .note = "\x01 control", .panels = {panel, panel}, .columns = 2});
    EXPECT_TRUE(drawing.isSvg());
    EXPECT_THAT(drawing.text, Not(HasSubstr("a<b>")));
}

TEST(Plot, OfNothingIsStillAPlot) {
    EXPECT_TRUE(Drawing({}).isSvg());
    EXPECT_TRUE(Drawing(one({.title = "empty", .series = {{.name = "none"}}, .samples = {}})).isSvg());
    EXPECT_TRUE(Drawing(one({.title = "empty", .samples = {{.name = "none"}}})).isSvg());
}

// Powers of ten lie equally far apart; what has no logarithm parts the line.
TEST(Plot, LogarithmicAxesSpreadPowersEvenly) {
    const Drawing drawing(
        one({.x = {.logarithmic = true},
             .y = {.logarithmic = true},
             .series = {
                 {.points = {{1, 1e-3}, {10, 1e-6}, {100, 1e-9}, {200, 0.0}, {300, 1e-3}, {500, 1e-3}}}}}));
    const auto lines = drawing.withClass("line");
    ASSERT_EQ(lines.size(), 2U);
    const auto points = pointsOf(lines.front());
    ASSERT_EQ(points.size(), 3U);
    // A tenth of a pixel is what the file resolves.
    EXPECT_NEAR(points[1].first - points[0].first, points[2].first - points[1].first, 0.21);
    EXPECT_NEAR(points[1].second - points[0].second, points[2].second - points[1].second, 0.21);
    EXPECT_GT(points[1].second, points[0].second);
}

TEST(Plot, CurvesStayInTheFrameOfAGivenRange) {
    PlotSeries wave;
    for (int i = 0; i <= 200; ++i) wave.points.emplace_back(0.1 * i, 3.0 * std::sin(0.3 * i));
    const Drawing drawing(
        one({.x = {.range = std::pair{2.0, 18.0}}, .y = {.range = std::pair{-1.0, 1.0}}, .series = {wave}}));
    const Element frame = drawing.withClass("frame").front();
    const double left = frame.number("x"), top = frame.number("y");
    const double right = left + frame.number("width"), bottom = top + frame.number("height");
    std::size_t drawn = 0;
    bool touches_top = false;
    for (const Element& line : drawing.withClass("line")) {
        for (const auto& [x, y] : pointsOf(line)) {
            if (line.tag != "polyline") continue;
            ++drawn;
            EXPECT_GE(x, left - 0.1);
            EXPECT_LE(x, right + 0.1);
            EXPECT_GE(y, top - 0.1);
            EXPECT_LE(y, bottom + 0.1);
            touches_top = touches_top || std::abs(y - top) < 0.1;
        }
    }
    EXPECT_GT(drawn, 20U);
    EXPECT_TRUE(touches_top);
}

// Quartiles of 1..5 and an outlier: 2.25, 3.5 and 4.75 by linear interpolation; the whisker ends at 5.
TEST(Plot, BoxShowsQuartilesAndOutliers) {
    const Drawing drawing(one({.samples = {{.name = "s", .values = {4, 1, 100, 3, 2, 5}}}}));
    ASSERT_EQ(drawing.withClass("box").size(), 1U);
    EXPECT_THAT(drawing.text, HasSubstr("median 3.5, quartiles 2.25 and 4.75"));
    EXPECT_EQ(drawing.withClass("outlier").size(), 1U);
    // The axis is linear: heights in pixels tell the values.
    const Element box = drawing.withClass("box").front();
    const double px_per_unit = box.number("height") / 2.5;
    const double median_y = drawing.withClass("median").front().number("y1");
    EXPECT_NEAR((box.number("y") + box.number("height") - median_y) / px_per_unit, 1.25, 0.1);
    EXPECT_NEAR((median_y - drawing.withClass("outlier").front().number("cy")) / px_per_unit, 96.5, 2.0);
}

TEST(Plot, ASingleValueIsABarFromZero) {
    const Drawing drawing(
        one({.samples = {{.name = "a", .values = {2.0}, .reference = 3.0}, {.name = "b", .values = {4.0}}}}));
    const auto bars = drawing.withClass("box");
    ASSERT_EQ(bars.size(), 2U);
    EXPECT_NEAR(bars[1].number("height"), 2.0 * bars[0].number("height"), 0.21);
    const Element frame = drawing.withClass("frame").front();
    EXPECT_NEAR(bars[0].number("y") + bars[0].number("height"), frame.number("y") + frame.number("height"),
                0.11);
    const auto reference = drawing.withClass("reference");
    ASSERT_EQ(reference.size(), 1U);
    EXPECT_NEAR(bars[0].number("y") - reference[0].number("y1"), 0.5 * bars[0].number("height"), 0.21);
}

TEST(Plot, ASingleValueIsAMarkOnALogarithmicAxis) {
    const Drawing drawing(one({.y = {.logarithmic = true},
                               .samples = {{.name = "a", .values = {2.0}}, {.name = "b", .values = {4.0}}}}));
    for (const Element& box : drawing.withClass("box")) EXPECT_LT(box.number("height"), 0.11);
    EXPECT_EQ(drawing.withClass("median").size(), 2U);
}

std::vector<std::string> labelsOf(const Drawing& drawing) {
    std::vector<std::string> labels;
    const std::string open = "class=\"tick\"";
    for (std::size_t at = 0; (at = drawing.text.find(open, at)) != std::string::npos;) {
        at = drawing.text.find('>', at) + 1;
        labels.push_back(drawing.text.substr(at, drawing.text.find('<', at) - at));
    }
    return labels;
}

TEST(Plot, ShortLogarithmicAxesAreLabelledInEachDecade) {
    const Drawing drawing(
        one({.y = {.logarithmic = true}, .samples = {{.name = "a", .values = {0.04, 0.06, 0.3, 0.4}}}}));
    EXPECT_THAT(labelsOf(drawing), testing::ElementsAre("0.05", "0.1", "0.2", "a"));
}

TEST(Plot, WholeNumbersHaveNoHalves) {
    const std::vector<PlotSeries> series{{.points = {{101, 1}, {102, 2}}, .look = SeriesLook::Points}};
    const std::pair range{100.5, 102.5};
    const auto labels = [&](bool whole) {
        return labelsOf(Drawing(one({.x = {.whole_numbers = whole, .range = range}, .series = series})));
    };
    EXPECT_THAT(labels(false), testing::Contains("101.4"));
    EXPECT_THAT(labels(true), testing::Contains("101"));
    EXPECT_THAT(labels(true), testing::Not(testing::Contains("101.4")));
}

TEST(Plot, EqualScalesMakeASquareOfASquare) {
    const Drawing drawing(one({.x = {.range = std::pair{0.0, 10.0}},
                               .y = {.range = std::pair{0.0, 10.0}},
                               .series = {{.points = {{5, 5}}, .look = SeriesLook::Points}},
                               .equal_scales = true}));
    const Element frame = drawing.withClass("frame").front();
    EXPECT_NEAR(frame.number("width"), frame.number("height"), 0.11);
    const Element point = drawing.withClass("point").front();
    EXPECT_NEAR(point.number("cx"), frame.number("x") + 0.5 * frame.number("width"), 0.11);
}

TEST(Plot, KeyHoldsEachNameOnce) {
    const PlotPanel panel{
        .series = {{.name = "only", .points = {{0, 0}, {1, 1}}}, {.points = {{0, 1}, {1, 0}}}}};
    const Drawing drawing({.panels = {panel, panel}, .reference = "paper"});
    const auto key = drawing.withClass("key");
    ASSERT_EQ(key.size(), 2U);
    EXPECT_STREQ(CPLGetXMLValue(key[0].node, "", ""), "only");
    EXPECT_STREQ(CPLGetXMLValue(key[1].node, "", ""), "paper");
}

}  // namespace
}  // namespace terrawalk
