#include "io/json_node.hpp"

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>

#include "io/text_input.hpp"

namespace terrawalk {

namespace {

constexpr std::size_t kDeepestLevel = 32;
constexpr std::size_t kMostNodes = 1'000'000;

// Where the parser stands. It reads at most one character beyond a value, and only a blank can lie on another
// line.
struct Place {
    std::size_t line = 1;
    std::size_t token_line = 1;  // of the last character that was no blank
};

class PlacedIterator {
  public:
    using iterator_category = std::input_iterator_tag;
    using value_type = char;
    using difference_type = std::ptrdiff_t;
    using pointer = const char*;
    using reference = char;

    PlacedIterator(const char* at, const char* end, Place& place) : at_(at), end_(end), place_(&place) {}
    char operator*() const { return *at_; }
    PlacedIterator& operator++() {
        const char c = *at_++;
        if (c == '\n' || (c == '\r' && (at_ == end_ || *at_ != '\n'))) {
            ++place_->line;
        } else if (c != ' ' && c != '\t' && c != '\r') {
            place_->token_line = place_->line;
        }
        return *this;
    }
    PlacedIterator operator++(int) {
        PlacedIterator before = *this;
        ++*this;
        return before;
    }
    bool operator==(const PlacedIterator& other) const { return at_ == other.at_; }
    bool operator!=(const PlacedIterator& other) const { return at_ != other.at_; }

  private:
    const char* at_;
    const char* end_;
    Place* place_;
};

JsonNode nodeOf(JsonNode::Type type) {
    JsonNode node;
    node.type = type;
    return node;
}

// Builds the tree from the parser's events. A false return ends the parse; `error` then says why.
class TreeBuilder : public nlohmann::json_sax<nlohmann::json> {
  public:
    TreeBuilder(const Place& place, const std::filesystem::path& file) : place_(place), file_(file) {}

    bool null() override { return add(nodeOf(JsonNode::Type::Null)); }
    bool boolean(bool value) override {
        JsonNode node = nodeOf(JsonNode::Type::Boolean);
        node.boolean = value;
        return add(std::move(node));
    }
    bool number_integer(number_integer_t value) override { return addNumber(static_cast<double>(value)); }
    bool number_unsigned(number_unsigned_t value) override { return addNumber(static_cast<double>(value)); }
    bool number_float(number_float_t value, const string_t&) override { return addNumber(value); }
    bool string(string_t& value) override {
        JsonNode node = nodeOf(JsonNode::Type::String);
        node.text = std::move(value);
        return add(std::move(node));
    }
    bool binary(binary_t&) override { return fail("a binary value"); }
    bool start_object(std::size_t) override { return open(JsonNode::Type::Object); }
    bool start_array(std::size_t) override { return open(JsonNode::Type::Array); }
    bool key(string_t& value) override {
        open_.back()->keys.push_back(std::move(value));
        return true;
    }
    bool end_array() override {
        open_.pop_back();
        return true;
    }
    bool end_object() override {
        const JsonNode& object = *open_.back();
        open_.pop_back();
        std::vector<std::string_view> sorted(object.keys.begin(), object.keys.end());
        std::sort(sorted.begin(), sorted.end());
        const auto twice = std::adjacent_find(sorted.begin(), sorted.end());
        if (twice == sorted.end()) return true;
        const auto second = std::find(object.keys.rbegin(), object.keys.rend(), *twice);
        const auto index = static_cast<std::size_t>(object.keys.rend() - second) - 1;
        return fail("the key " + inQuotes(*twice) + " stands twice in one object",
                    object.elements[index].line);
    }
    bool parse_error(std::size_t, const std::string&, const nlohmann::json::exception& problem) override {
        // "[json.exception.parse_error.101] parse error at line 1, column 2: syntax error ..."
        std::string_view what = problem.what();
        if (const std::size_t id = what.find("] "); id != std::string_view::npos) what.remove_prefix(id + 2);
        if (what.starts_with("parse error")) what.remove_prefix(std::min(what.size(), what.find(": ") + 2));
        return fail("no valid JSON: " + std::string(what), place_.line);
    }

    JsonNode root;
    std::optional<Error> error;

  private:
    bool fail(std::string message, std::size_t line = 0) {
        error = badData(std::move(message), file_, line > 0 ? line : place_.token_line).value();
        return false;
    }
    bool addNumber(double value) {
        JsonNode node = nodeOf(JsonNode::Type::Number);
        node.number = value;
        return add(std::move(node));
    }
    bool add(JsonNode node) { return place(std::move(node)) != nullptr; }
    bool open(JsonNode::Type type) {
        if (open_.size() == kDeepestLevel) return fail("the JSON is nested too deeply");
        JsonNode* const node = place(nodeOf(type));
        if (node != nullptr) open_.push_back(node);
        return node != nullptr;
    }
    // Pointers to open containers stay valid: only the innermost one grows.
    JsonNode* place(JsonNode node) {
        if (++count_ > kMostNodes) {
            fail("the JSON holds more than a million values");
            return nullptr;
        }
        node.line = place_.token_line;
        if (open_.empty()) {
            root = std::move(node);
            return &root;
        }
        return &open_.back()->elements.emplace_back(std::move(node));
    }

    const Place& place_;
    const std::filesystem::path& file_;
    std::vector<JsonNode*> open_;
    std::size_t count_ = 0;
};

}  // namespace

const JsonNode* JsonNode::find(std::string_view key) const {
    const auto found = std::find(keys.begin(), keys.end(), key);
    return found == keys.end() ? nullptr : &elements[static_cast<std::size_t>(found - keys.begin())];
}

Result<JsonNode> parseJson(std::string_view text, const std::filesystem::path& file) {
    const std::string_view json = withoutByteOrderMark(text);
    const char* const end = json.data() + json.size();
    Place place;
    TreeBuilder builder(place, file);
    const bool parsed = nlohmann::json::sax_parse(PlacedIterator(json.data(), end, place),
                                                  PlacedIterator(end, end, place), &builder);
    if (!parsed) return tl::unexpected(*builder.error);
    return std::move(builder.root);
}

}  // namespace terrawalk
