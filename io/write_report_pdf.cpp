#include <cairo-pdf.h>
#include <cpl_conv.h>
#include <cpl_minixml.h>
#include <fmt/format.h>
#include <librsvg/rsvg.h>
#include <pango/pangocairo.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/output_folder.hpp"
#include "io/report_style.hpp"
#include "io/report_text.hpp"
#include "io/write_products.hpp"

// The report on paper. The page of HTML is the only source: what it says is laid out here, and nothing is
// worded or computed a second time.

namespace terrawalk {

namespace {

// ---------------------------------------------------------------------------------------------- handles of C

template <auto Free>
struct Freed {
    template <class T>
    void operator()(T* handle) const {
        Free(handle);
    }
};
using Surface = std::unique_ptr<cairo_surface_t, Freed<cairo_surface_destroy>>;
using Context = std::unique_ptr<cairo_t, Freed<cairo_destroy>>;
using Layout = std::unique_ptr<PangoLayout, Freed<g_object_unref>>;
using Font = std::unique_ptr<PangoFontDescription, Freed<pango_font_description_free>>;
using Drawing = std::unique_ptr<RsvgHandle, Freed<g_object_unref>>;
using Page = std::unique_ptr<CPLXMLNode, Freed<CPLDestroyXMLNode>>;

// ---------------------------------------------------------------------------------------------- the page as
// a tree

bool isElement(const CPLXMLNode* node, std::string_view tag) {
    return node->eType == CXT_Element && tag == node->pszValue;
}

std::string attribute(const CPLXMLNode* node, std::string_view name) {
    for (const CPLXMLNode* child = node->psChild; child != nullptr; child = child->psNext) {
        if (child->eType == CXT_Attribute && name == child->pszValue) return child->psChild->pszValue;
    }
    return {};
}

bool hasClass(const CPLXMLNode* node, std::string_view name) {
    return (" " + attribute(node, "class") + " ").find(fmt::format(" {} ", name)) != std::string::npos;
}

/// All text below a node; a <br/> is a line break.
std::string textOf(const CPLXMLNode* node) {
    if (node->eType == CXT_Text) return node->pszValue;
    if (node->eType != CXT_Element) return {};
    if (isElement(node, "br")) return "\n";
    std::string text;
    for (const CPLXMLNode* child = node->psChild; child != nullptr; child = child->psNext)
        text += textOf(child);
    return text;
}

std::vector<const CPLXMLNode*> elementsOf(const CPLXMLNode* node) {
    std::vector<const CPLXMLNode*> elements;
    for (const CPLXMLNode* child = node->psChild; child != nullptr; child = child->psNext) {
        if (child->eType == CXT_Element) elements.push_back(child);
    }
    return elements;
}

const CPLXMLNode* findElement(const CPLXMLNode* node, std::string_view tag) {
    for (; node != nullptr; node = node->psNext) {
        if (node->eType != CXT_Element) continue;
        if (isElement(node, tag)) return node;
        if (const CPLXMLNode* const found = findElement(node->psChild, tag)) return found;
    }
    return nullptr;
}

// ---------------------------------------------------------------------------------------------- style

struct Colour {
    double red, green, blue;
};
constexpr Colour kInk{0.11, 0.13, 0.15}, kQuiet{0.35, 0.39, 0.43}, kRule{0.80, 0.83, 0.86},
    kPanel{0.955, 0.965, 0.975}, kAccent{0.0, 0.435, 0.32}, kWarning{0.6, 0.29, 0.0},
    kWarningPanel{1.0, 0.96, 0.91};

/// The page's own rules for drawings with the colours of its light look put in: librsvg knows no variables.
std::string drawingStyle() {
    std::map<std::string, std::string, std::less<>> values;
    const std::string_view css = kReportStyle;
    const std::string_view light = css.substr(0, css.find('}'));
    for (std::size_t at = light.find("--"); at != std::string_view::npos; at = light.find("--", at)) {
        const std::size_t colon = light.find(':', at), end = light.find(';', at);
        values.emplace(light.substr(at, colon - at), light.substr(colon + 1, end - colon - 1));
        at = end;
    }
    std::string style =
        fmt::format("svg {{ color: {}; font-family: sans-serif; font-size: 12px; }}\n", values.at("--ink"));
    const std::string_view rules = css.substr(css.find("svg text"));
    for (std::string_view rest = rules.substr(0, rules.find("@media")); !rest.empty();) {
        const std::size_t variable = rest.find("var(");
        style += rest.substr(0, variable);
        if (variable == std::string_view::npos) break;
        const std::size_t end = rest.find(')', variable);
        style += values.find(rest.substr(variable + 4, end - variable - 4))->second;
        rest.remove_prefix(end + 1);
    }
    return style;
}

// ---------------------------------------------------------------------------------------------- paper

constexpr double kPageWidth = 595.28, kPageHeight = 841.89, kMargin = 40.0;  // A4, in points
constexpr double kTextWidth = kPageWidth - 2.0 * kMargin;

struct TextLook {
    double size = 9.0;
    bool bold = false;
    Colour colour = kInk;
    bool to_the_right = false;
    bool monospace = false;
};

cairo_status_t append(void* text, const unsigned char* bytes, unsigned int count) {
    static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(bytes), count);
    return CAIRO_STATUS_SUCCESS;
}

/// Pages that fill from the top; a piece that does not fit begins the next.
class Paper {
  public:
    Paper(const std::string& title, const std::string& creator)
        : surface_(cairo_pdf_surface_create_for_stream(&append, &bytes_, kPageWidth, kPageHeight)),
          context_(cairo_create(surface_.get())),
          title_(title),
          style_(drawingStyle()) {
        cairo_pdf_surface_set_metadata(surface_.get(), CAIRO_PDF_METADATA_TITLE, title.c_str());
        cairo_pdf_surface_set_metadata(surface_.get(), CAIRO_PDF_METADATA_CREATOR, creator.c_str());
        // The report bears no date, so that the same survey gives the same bytes.
        cairo_pdf_surface_set_metadata(surface_.get(), CAIRO_PDF_METADATA_CREATE_DATE, "");
    }

    [[nodiscard]] double left() const { return left_; }
    [[nodiscard]] double width() const { return width_; }
    [[nodiscard]] double y() const { return y_; }
    [[nodiscard]] double room() const { return kBottom - y_; }  ///< to the bottom of the page
    void moveTo(double y) { y_ = y; }
    void space(double points) { y_ = std::min(y_ + points, kBottom); }

    /// A narrower column until the next call.
    void column(double left, double width) {
        left_ = left;
        width_ = width;
    }
    void wholeWidth() { column(kMargin, kTextWidth); }

    /// Starts a page unless so much fits on this one. Returns whether it did.
    bool require(double height) {
        if (y_ + height <= kBottom || y_ == kMargin) return false;
        finishPage();
        return true;
    }

    [[nodiscard]] Layout layout(const std::string& text, const TextLook& look, double width) {
        Layout made(pango_cairo_create_layout(context_.get()));
        const Font font(pango_font_description_from_string(look.monospace ? "Monospace" : "Sans"));
        pango_font_description_set_absolute_size(font.get(), look.size * PANGO_SCALE);
        if (look.bold) pango_font_description_set_weight(font.get(), PANGO_WEIGHT_BOLD);
        pango_layout_set_font_description(made.get(), font.get());
        pango_layout_set_text(made.get(), text.c_str(), -1);
        pango_layout_set_line_spacing(made.get(), 1.1F);
        if (width > 0.0) {
            pango_layout_set_width(made.get(), static_cast<int>(width * PANGO_SCALE));
            pango_layout_set_wrap(made.get(), PANGO_WRAP_WORD_CHAR);
        }
        if (look.to_the_right) pango_layout_set_alignment(made.get(), PANGO_ALIGN_RIGHT);
        return made;
    }
    [[nodiscard]] static double heightOf(const Layout& layout) {
        int width = 0, height = 0;
        pango_layout_get_size(layout.get(), &width, &height);
        return static_cast<double>(height) / PANGO_SCALE;
    }
    [[nodiscard]] static double widthOf(const Layout& layout) {
        int width = 0, height = 0;
        pango_layout_get_size(layout.get(), &width, &height);
        return static_cast<double>(width) / PANGO_SCALE;
    }
    void put(const Layout& layout, double x, double y, const Colour& colour) {
        ink(colour);
        cairo_move_to(context_.get(), x, y);
        pango_cairo_show_layout(context_.get(), layout.get());
    }
    /// A paragraph; long ones go on over the page's end, line by line.
    void paragraph(const std::string& text, const TextLook& look, double after, double indent = 0.0) {
        const Layout made = layout(text, look, width_ - indent);
        int lines = pango_layout_get_line_count(made.get());
        const std::unique_ptr<PangoLayoutIter, Freed<pango_layout_iter_free>> line(
            pango_layout_get_iter(made.get()));
        for (; lines > 0; --lines, pango_layout_iter_next_line(line.get())) {
            PangoRectangle extents;
            pango_layout_iter_get_line_extents(line.get(), nullptr, &extents);
            const double height = static_cast<double>(extents.height) / PANGO_SCALE;
            require(height);
            ink(look.colour);
            cairo_move_to(context_.get(), left_ + indent + static_cast<double>(extents.x) / PANGO_SCALE,
                          y_ + static_cast<double>(pango_layout_iter_get_baseline(line.get()) - extents.y) /
                                   PANGO_SCALE);
            pango_cairo_show_layout_line(context_.get(), pango_layout_iter_get_line_readonly(line.get()));
            y_ += height;
        }
        space(after);
    }
    void rule(double x, double y, double width, const Colour& colour, double thickness = 0.5) {
        box(x, y, width, thickness, colour);
    }
    void box(double x, double y, double width, double height, const Colour& colour) {
        ink(colour);
        cairo_rectangle(context_.get(), x, y, width, height);
        cairo_fill(context_.get());
    }

    /// Height of a drawing at a width; 0 where it cannot be read.
    [[nodiscard]] double drawingHeight(const CPLXMLNode* svg, double width) const {
        const auto [w, h] = viewBox(svg);
        return w > 0.0 ? std::min(width, w * kPointsPerPixel) * h / w : 0.0;
    }
    void draw(const CPLXMLNode* svg, double x, double y, double width) {
        const auto [w, h] = viewBox(svg);
        if (w <= 0.0) return;
        const double shown = std::min(width, w * kPointsPerPixel);
        CPLXMLNode alone = *svg;
        alone.psNext = nullptr;  // or what follows would be written too
        char* const text = CPLSerializeXMLTree(&alone);
        std::string source(text);
        CPLFree(text);
        source.replace(source.find("<svg"), 4, "<svg xmlns=\"http://www.w3.org/2000/svg\"");
        GError* error = nullptr;
        const Drawing drawing(
            rsvg_handle_new_from_data(reinterpret_cast<const guint8*>(source.data()), source.size(), &error));
        const RsvgRectangle place{x, y, shown, shown * h / w};
        const bool drawn =
            drawing &&
            rsvg_handle_set_stylesheet(drawing.get(), reinterpret_cast<const guint8*>(style_.data()),
                                       style_.size(), &error) != FALSE &&
            rsvg_handle_render_document(drawing.get(), context_.get(), &place, &error) != FALSE;
        if (!drawn) fail(fmt::format("a drawing: {}", error != nullptr ? error->message : "no reason named"));
        g_clear_error(&error);
    }

    Result<std::string> finish() {
        finishPage();
        context_.reset();
        cairo_surface_finish(surface_.get());
        if (cairo_surface_status(surface_.get()) != CAIRO_STATUS_SUCCESS) {
            fail(cairo_status_to_string(cairo_surface_status(surface_.get())));
        }
        if (!failure_.empty()) return systemError("cannot make the PDF: " + failure_);
        return std::move(bytes_);
    }

  private:
    static constexpr double kBottom = kPageHeight - kMargin - 16.0;
    static constexpr double kPointsPerPixel = 0.72;

    void ink(const Colour& colour) {
        cairo_set_source_rgb(context_.get(), colour.red, colour.green, colour.blue);
    }
    void fail(const std::string& why) {
        if (failure_.empty()) failure_ = why;
    }
    static std::pair<double, double> viewBox(const CPLXMLNode* svg) {
        std::array<double, 4> box{};
        const std::string text = attribute(svg, "viewBox");
        const char* at = text.c_str();
        for (double& value : box) {
            char* end = nullptr;
            value = CPLStrtod(at, &end);
            at = end;
        }
        return {box[2], box[3]};
    }
    void finishPage() {
        ++page_;
        const TextLook look{7.5, false, kQuiet};
        const Layout name = layout(title_, look, 0.0), number = layout(fmt::format("{}", page_), look, 0.0);
        const double y = kPageHeight - kMargin - 4.0;
        rule(kMargin, y - 4.0, kTextWidth, kRule);
        put(name, kMargin, y, kQuiet);
        put(number, kMargin + kTextWidth - widthOf(number), y, kQuiet);
        cairo_show_page(context_.get());
        y_ = kMargin;
    }

    std::string bytes_;
    Surface surface_;
    Context context_;
    std::string title_;
    std::string style_;
    double left_ = kMargin, width_ = kTextWidth, y_ = kMargin;
    int page_ = 0;
    std::string failure_;
};

// ---------------------------------------------------------------------------------------------- tables

struct TableCell {
    std::string text;
    TextLook look;
    std::size_t rows = 1;  ///< that it spans
};
struct TableRow {
    std::vector<TableCell> cells;
    bool is_head = false;
    bool begins_group = false;
    std::size_t first_column = 0;  ///< 1 below a cell that spans rows
};

std::size_t rowsSpanned(const CPLXMLNode* cell) {
    const std::string rows = attribute(cell, "rowspan");
    return rows.empty() ? 1 : std::max(1UL, std::strtoul(rows.c_str(), nullptr, 10));
}

TableRow tableRow(const CPLXMLNode* tr, bool is_head, double size) {
    TableRow row;
    row.is_head = is_head;
    for (const CPLXMLNode* const cell : elementsOf(tr)) {
        TextLook look;
        look.size = size;
        look.bold = is_head || isElement(cell, "th") || hasClass(tr, "changed");
        look.to_the_right = hasClass(cell, "n") || hasClass(cell, "number");
        look.monospace = hasClass(cell, "key") || hasClass(cell, "hash");
        if (look.monospace) look.size *= 0.85;
        if (is_head || hasClass(tr, "tied")) look.colour = kQuiet;
        row.cells.push_back({textOf(cell), look, rowsSpanned(cell)});
    }
    return row;
}

std::vector<TableRow> rowsOf(const CPLXMLNode* table, double size) {
    std::vector<TableRow> rows;
    for (const CPLXMLNode* const part : elementsOf(table)) {
        if (isElement(part, "tr")) rows.push_back(tableRow(part, false, size));
        bool first = true, spanned = false;
        for (const CPLXMLNode* const tr : elementsOf(part)) {
            if (!isElement(tr, "tr")) continue;
            TableRow row = tableRow(tr, isElement(part, "thead"), size);
            row.begins_group = std::exchange(first, false) && hasClass(part, "group");
            const bool spans = !row.cells.empty() && row.cells.front().rows > 1;
            if (spanned && !spans) row.first_column = 1;
            spanned = spanned || spans;
            rows.push_back(std::move(row));
        }
    }
    return rows;
}

constexpr double kCellGap = 6.0;

/// The first part of a text that no line break takes apart: a word, or one character of Chinese.
std::string_view firstUnbroken(std::string_view text) {
    const auto is_wide = [](char c) {
        return static_cast<unsigned char>(c) >= 0xE3;  // U+3000 and beyond
    };
    constexpr std::size_t kWideBytes = 3;
    if (is_wide(text.front())) return text.substr(0, kWideBytes);
    const auto* const end =
        std::find_if(text.begin(), text.end(), [&](char c) { return c == ' ' || c == '\n' || is_wide(c); });
    return text.substr(0, static_cast<std::size_t>(end - text.begin()));
}

/// As wide as their text where all fits; else the widest give way, down to their longest word.
std::vector<double> columnWidths(Paper& paper, const std::vector<TableRow>& rows, double whole) {
    std::vector<double> natural, least;
    for (const TableRow& row : rows) {
        for (std::size_t i = 0; i < row.cells.size(); ++i) {
            const std::size_t column = i + row.first_column;
            if (column >= natural.size()) {
                natural.resize(column + 1, 0.0);
                least.resize(column + 1, 0.0);
            }
            const TableCell& cell = row.cells[i];
            natural[column] =
                std::max(natural[column], Paper::widthOf(paper.layout(cell.text, cell.look, 0.0)) + 0.5);
            for (std::size_t at = 0; at < cell.text.size();) {
                const std::string word(firstUnbroken(std::string_view(cell.text).substr(at)));
                // A number with its blanks is one word.
                const std::string& unbroken = cell.look.to_the_right && !row.is_head ? cell.text : word;
                if (!cell.look.monospace) {
                    least[column] =
                        std::max(least[column], Paper::widthOf(paper.layout(unbroken, cell.look, 0.0)) + 0.5);
                }
                at += std::max<std::size_t>(word.size(), 1);  // over a blank
            }
        }
    }
    const double room = whole - kCellGap * static_cast<double>(natural.empty() ? 0 : natural.size() - 1);
    const auto total = [](const std::vector<double>& widths) {
        double sum = 0.0;
        for (const double width : widths) sum += width;
        return sum;
    };
    if (total(natural) <= room) return natural;
    // The limit that makes the sum fit, by halving.
    double low = 0.0, high = room;
    const auto limited = [&](double limit) {
        std::vector<double> widths(natural.size());
        for (std::size_t i = 0; i < widths.size(); ++i) {
            widths[i] = std::min(natural[i], std::max(least[i], limit));
        }
        return widths;
    };
    for (int step = 0; step < 40; ++step) {
        const double middle = 0.5 * (low + high);
        (total(limited(middle)) <= room ? low : high) = middle;
    }
    std::vector<double> widths = limited(low);
    if (const double sum = total(widths); sum > room) {
        for (double& width : widths) width *= room / sum;  // words break
    }
    return widths;
}

class TablePrinter {
  public:
    TablePrinter(Paper& paper, const CPLXMLNode* table) : paper_(paper) {
        // A smaller print where lines would break otherwise, or at least numbers.
        constexpr std::array kSizes{7.5, 7.0, 6.5, 6.0, 5.5};
        const auto choose = [&](bool (TablePrinter::*too_narrow)()) {
            for (const double size : kSizes) {
                rows_ = rowsOf(table, size);
                widths_ = columnWidths(paper, rows_, paper.width());
                if (!(this->*too_narrow)()) return true;
            }
            return false;
        };
        if (!choose(&TablePrinter::anythingBreaks)) choose(&TablePrinter::anyNumberBreaks);
    }

    void print() {
        std::vector<const TableRow*> heads;
        for (const TableRow& row : rows_) {
            if (row.is_head) heads.push_back(&row);
        }
        const double head_height = heightOf(heads);
        bool first = true;
        for (const TableRow& row : rows_) {
            if (row.is_head) continue;
            const double height = heightOf({&row});
            if (first) paper_.require(head_height + height);
            const bool new_page = !first && paper_.require(height);
            if (first || new_page) {
                for (const TableRow* head : heads) printRow(*head);
            }
            if (row.begins_group && !first) paper_.rule(paper_.left(), paper_.y(), width(), kQuiet);
            printRow(row);
            first = false;
        }
        paper_.space(8.0);
    }

  private:
    [[nodiscard]] double width() const {
        double sum = -kCellGap;
        for (const double column : widths_) sum += column + kCellGap;
        return sum;
    }
    [[nodiscard]] bool breaks(bool numbers_only) {
        for (const TableRow& row : rows_) {
            for (std::size_t i = 0; i < row.cells.size(); ++i) {
                const TableCell& cell = row.cells[i];
                if (row.is_head || (numbers_only && !cell.look.to_the_right)) continue;
                if (Paper::widthOf(paper_.layout(cell.text, cell.look, 0.0)) >
                    widths_[i + row.first_column]) {
                    return true;
                }
            }
        }
        return false;
    }
    [[nodiscard]] bool anythingBreaks() { return breaks(false); }
    [[nodiscard]] bool anyNumberBreaks() { return breaks(true); }
    [[nodiscard]] double heightOf(const std::vector<const TableRow*>& rows) {
        double sum = 0.0;
        for (const TableRow* row : rows) {
            double height = 0.0;
            for (std::size_t i = 0; i < row->cells.size(); ++i) {
                // What spans rows is held by all of them.
                height = std::max(
                    height, Paper::heightOf(layoutOf(*row, i)) / static_cast<double>(row->cells[i].rows));
            }
            sum += height + kRowGap;
        }
        return sum;
    }
    [[nodiscard]] Layout layoutOf(const TableRow& row, std::size_t i) {
        return paper_.layout(row.cells[i].text, row.cells[i].look, widths_[i + row.first_column]);
    }
    void printRow(const TableRow& row) {
        const double height = heightOf({&row});
        double x = paper_.left();
        for (std::size_t column = 0; column < row.first_column; ++column) x += widths_[column] + kCellGap;
        const double rule_from = x;
        for (std::size_t i = 0; i < row.cells.size(); ++i) {
            const Layout text = layoutOf(row, i);
            // Headings stand on their line.
            const double down = row.is_head ? height - kRowGap - Paper::heightOf(text) : 0.0;
            paper_.put(text, x, paper_.y() + 0.5 * kRowGap + down, row.cells[i].look.colour);
            x += widths_[i + row.first_column] + kCellGap;
        }
        paper_.moveTo(paper_.y() + height);
        paper_.rule(rule_from, paper_.y(), x - kCellGap - rule_from, row.is_head ? kQuiet : kRule);
    }

    static constexpr double kRowGap = 3.5;
    Paper& paper_;
    std::vector<TableRow> rows_;
    std::vector<double> widths_;
};

// ---------------------------------------------------------------------------------------------- the page on
// paper

void print(Paper& paper, const CPLXMLNode* node);

void printChildren(Paper& paper, const CPLXMLNode* node) {
    for (const CPLXMLNode* const child : elementsOf(node)) print(paper, child);
}

void printCards(Paper& paper, const CPLXMLNode* figures) {
    const std::vector<const CPLXMLNode*> cards = elementsOf(figures);
    constexpr double kGap = 10.0, kPadding = 8.0;
    const double width =
        (paper.width() - kGap * static_cast<double>(cards.size() - 1)) / static_cast<double>(cards.size());
    constexpr std::array kLooks{TextLook{8.0}, TextLook{17.0, true}, TextLook{8.0, false, kQuiet}};
    std::vector<std::vector<Layout>> texts;
    double height = 0.0;
    for (const CPLXMLNode* const card : cards) {
        texts.emplace_back();
        double sum = 2.0 * kPadding;
        for (const CPLXMLNode* const part : elementsOf(card)) {
            const TextLook& look = kLooks[std::min(texts.back().size(), kLooks.size() - 1)];
            texts.back().push_back(paper.layout(textOf(part), look, width - 2.0 * kPadding));
            sum += Paper::heightOf(texts.back().back());
        }
        height = std::max(height, sum);
    }
    paper.require(height);
    for (std::size_t i = 0; i < cards.size(); ++i) {
        const double x = paper.left() + static_cast<double>(i) * (width + kGap);
        paper.box(x, paper.y(), width, height, kPanel);
        paper.box(x, paper.y(), width, 2.0, hasClass(cards[i], "unknown") ? kWarning : kAccent);
        double y = paper.y() + kPadding;
        for (std::size_t part = 0; part < texts[i].size(); ++part) {
            paper.put(texts[i][part], x + kPadding, y, kLooks[std::min(part, kLooks.size() - 1)].colour);
            y += Paper::heightOf(texts[i][part]);
        }
    }
    paper.space(height + 12.0);
}

constexpr double kSwatch = 20.0, kKeyGap = 10.0, kBelowKey = 14.0;
constexpr TextLook kKeyLook{7.5, false, kInk};

double keyHeight(Paper& paper, const CPLXMLNode* list) {
    double x = 0.0, height = kBelowKey;
    for (const CPLXMLNode* const item : elementsOf(list)) {
        const Layout name = paper.layout(textOf(item), kKeyLook, 0.0);
        const double width = kSwatch + 4.0 + Paper::widthOf(name);
        if (x > 0.0 && x + width > paper.width()) {
            x = 0.0;
            height += Paper::heightOf(name) + 1.0;
        }
        x += width + kKeyGap;
    }
    return height;
}

/// Swatches with the names of the runs, one after the other.
void printKey(Paper& paper, const CPLXMLNode* list) {
    double x = paper.left();
    for (const CPLXMLNode* const item : elementsOf(list)) {
        const CPLXMLNode* const swatch = findElement(item->psChild, "svg");
        const Layout name = paper.layout(textOf(item), kKeyLook, 0.0);
        const double width = kSwatch + 4.0 + Paper::widthOf(name);
        if (x > paper.left() && x + width > paper.left() + paper.width()) {
            x = paper.left();
            paper.space(Paper::heightOf(name) + 1.0);
        }
        if (paper.require(Paper::heightOf(name))) x = paper.left();
        if (swatch != nullptr) paper.draw(swatch, x, paper.y() + 2.0, kSwatch);
        paper.put(name, x + kSwatch + 4.0, paper.y(), kKeyLook.colour);
        x += width + kKeyGap;
    }
    paper.space(kBelowKey);
}

double figureHeight(Paper& paper, const CPLXMLNode* figure, double width) {
    const CPLXMLNode* const svg = findElement(figure->psChild, "svg");
    const CPLXMLNode* const caption = findElement(figure->psChild, "figcaption");
    const CPLXMLNode* const key = findElement(figure->psChild, "ul");
    return (svg != nullptr ? paper.drawingHeight(svg, width) : 0.0) +
           (key != nullptr ? keyHeight(paper, key) : 0.0) +
           (caption != nullptr ? Paper::heightOf(paper.layout(textOf(caption), {8.0}, paper.width())) + 4.0
                               : 0.0);
}

/// The width at which a figure goes on this page below what takes `above`: somewhat smaller, rather than the
/// page half empty. The whole width where it would have to be smaller than that.
double fittingWidth(Paper& paper, const CPLXMLNode* figure, double above) {
    constexpr double kLeastShare = 0.6, kStep = 0.05;
    for (double share = 1.0; share > kLeastShare - 0.5 * kStep; share -= kStep) {
        const double width = share * paper.width();
        if (above + figureHeight(paper, figure, width) <= paper.room()) return width;
    }
    return paper.width();
}

void printFigure(Paper& paper, const CPLXMLNode* figure) {
    const double width = fittingWidth(paper, figure, 0.0);
    paper.require(figureHeight(paper, figure, width));
    for (const CPLXMLNode* const part : elementsOf(figure)) {
        if (isElement(part, "svg")) {
            paper.draw(part, paper.left(), paper.y(), width);
            paper.space(paper.drawingHeight(part, width) + 4.0);
        } else if (isElement(part, "ul")) {
            printKey(paper, part);
        } else {
            paper.paragraph(textOf(part), {8.0, false, kQuiet}, 12.0);
        }
    }
}

void printPair(Paper& paper, const CPLXMLNode* pair) {
    constexpr double kGap = 16.0;
    const std::vector<const CPLXMLNode*> parts = elementsOf(pair);
    const double width = 0.5 * (kTextWidth - kGap);
    double tallest = 0.0;
    paper.column(kMargin, width);
    for (const CPLXMLNode* const part : parts) {
        tallest = std::max(tallest, figureHeight(paper, part, fittingWidth(paper, part, 0.0)));
    }
    paper.wholeWidth();
    paper.require(tallest);
    const double top = paper.y();
    double lowest = top;
    for (std::size_t i = 0; i < parts.size(); ++i) {
        paper.moveTo(top);
        paper.column(kMargin + static_cast<double>(i % 2) * (width + kGap), width);
        print(paper, parts[i]);
        lowest = std::max(lowest, paper.y());
    }
    paper.wholeWidth();
    paper.moveTo(lowest);
}

void printLimits(Paper& paper, const CPLXMLNode* section) {
    paper.space(8.0);
    const double top = paper.y();
    paper.column(kMargin + 10.0, kTextWidth - 10.0);
    printChildren(paper, section);
    paper.wholeWidth();
    // Marked at its side where it stays on one page; the words say what it is anyway.
    if (paper.y() > top) paper.box(kMargin, top, 2.5, paper.y() - top, kWarning);
    paper.space(8.0);
}

void print(Paper& paper, const CPLXMLNode* node) {
    const auto heading = [&](double size, double before, double after) {
        // Never the last line of a page.
        const CPLXMLNode* next = node->psNext;
        while (next != nullptr && next->eType != CXT_Element) next = next->psNext;
        const bool drawn = next != nullptr && isElement(next, "figure");
        const double own = before + 30.0;
        paper.require(drawn ? own + figureHeight(paper, next, fittingWidth(paper, next, own)) : own + 30.0);
        paper.space(before);
        paper.paragraph(textOf(node), {size, true}, after);
    };
    if (isElement(node, "nav") || isElement(node, "style")) return;
    if (isElement(node, "h1")) return paper.paragraph(textOf(node), {20.0, true}, 2.0);
    if (isElement(node, "h2")) return heading(13.0, 12.0, 4.0);
    if (isElement(node, "h3") || isElement(node, "summary")) return heading(9.5, 6.0, 3.0);
    if (isElement(node, "p") || isElement(node, "footer")) {
        const bool quiet = hasClass(node, "note") || hasClass(node, "lead") || isElement(node, "footer");
        return paper.paragraph(textOf(node), {quiet ? 8.0 : 9.0, false, quiet ? kQuiet : kInk}, 5.0);
    }
    if (isElement(node, "li")) {
        constexpr double kIndent = 10.0;
        const Layout dot = paper.layout("\u2022", {9.0}, 0.0);
        paper.require(Paper::heightOf(dot));
        paper.put(dot, paper.left(), paper.y(), kInk);
        return paper.paragraph(textOf(node), {9.0}, 3.0, kIndent);
    }
    if (isElement(node, "table")) return TablePrinter(paper, node).print();
    if (isElement(node, "figure")) return printFigure(paper, node);
    if (hasClass(node, "figures")) return printCards(paper, node);
    if (hasClass(node, "pair")) return printPair(paper, node);
    if (hasClass(node, "limits")) return printLimits(paper, node);
    printChildren(paper, node);
}

/// Whether the machine has a font for it.
bool canShowChinese() {
    const std::unique_ptr<PangoContext, Freed<g_object_unref>> context(
        pango_font_map_create_context(pango_cairo_font_map_get_default()));
    const Layout layout(pango_layout_new(context.get()));
    pango_layout_set_text(layout.get(), "\u6d4b\u91cf", -1);
    return pango_layout_get_unknown_glyphs_count(layout.get()) == 0;
}

std::string pageForPaper(const SurveyReport& report) {
    if (report.language == ReportLanguage::English || canShowChinese()) return reportHtml(report);
    SurveyReport readable = report;
    readable.language = ReportLanguage::English;
    readable.warnings.emplace_back(
        "This machine has no font for Chinese, so this file is in English; report.html is in Chinese. On "
        "Debian install fonts-wqy-microhei.");
    return reportHtml(readable);
}

}  // namespace

Result<std::string> reportPdf(const SurveyReport& report) {
    const std::string html = pageForPaper(report);
    const Page page(CPLParseXMLString(html.c_str()));
    const CPLXMLNode* const body = page ? findElement(page.get(), "body") : nullptr;
    if (body == nullptr) return systemError("the report's page cannot be laid out");
    const CPLXMLNode* const title = findElement(page.get(), "title");
    Paper paper(title != nullptr ? textOf(title) : "", "Terrawalk " + report.program_version);
    printChildren(paper, body);
    return paper.finish();
}

Result<void> writeReportPdf(const SurveyReport& report, const std::filesystem::path& file) {
    const auto pdf = reportPdf(report);
    if (!pdf) return tl::unexpected(pdf.error());
    return writeTextFile(*pdf, file);
}

}  // namespace terrawalk
