#include "json_value.hpp"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <iterator>
#include <nlohmann/json.hpp>

#include "text_file.hpp"

namespace minirtc {
namespace {

using Json = nlohmann::json;

/// Iterator over a text that publishes how far the parser has read: nlohmann's SAX events carry no positions.
class TrackedIterator {
public:
    using iterator_category = std::input_iterator_tag;
    using value_type = char;
    using difference_type = std::ptrdiff_t;
    using pointer = const char*;
    using reference = const char&;

    TrackedIterator(const char* at, const char** furthest) : at_(at), furthest_(furthest) {}
    reference operator*() const { return *at_; }
    TrackedIterator& operator++() {
        *furthest_ = ++at_;
        return *this;
    }
    TrackedIterator operator++(int) {
        TrackedIterator old = *this;
        ++*this;
        return old;
    }
    bool operator==(const TrackedIterator& o) const { return at_ == o.at_; }
    bool operator!=(const TrackedIterator& o) const { return at_ != o.at_; }

private:
    const char* at_;
    const char** furthest_;
};

/// Builds the tree from SAX events. Each event comes when the parser has read exactly the token, or one character more after
/// a number, so the token's start is found by walking back.
class TreeBuilder : public nlohmann::json_sax<Json> {
public:
    TreeBuilder(const std::string& text, const std::string& file) : text_(text), file_(file), read(text.data()) {
        for (size_t i = 0; i < text.size(); ++i)
            if (text[i] == '\n') lineStarts_.push_back(i + 1);
    }

    bool null() override { return add(JsonType::null, back(4)), true; }
    bool boolean(bool value) override { return add(JsonType::boolean, back(value ? 4 : 5)).boolean = value, true; }
    bool number_integer(number_integer_t value) override { return addNumber(static_cast<double>(value)); }
    bool number_unsigned(number_unsigned_t value) override { return addNumber(static_cast<double>(value)); }
    bool number_float(number_float_t value, const string_t&) override { return addNumber(value); }
    bool string(string_t& value) override { return add(JsonType::string, stringStart()).string = value, true; }
    bool binary(binary_t&) override { return false; }
    bool start_object(size_t) override { return open(JsonType::object); }
    bool start_array(size_t) override { return open(JsonType::array); }
    bool end_object() override {
        rejectDuplicates(open_.back()->members);
        open_.pop_back();
        return true;
    }
    bool end_array() override { return open_.pop_back(), true; }

    bool key(string_t& key) override {
        const SourceLocation at = locate(stringStart());
        open_.back()->members.push_back({key, at.line, at.column, {}});
        return true;
    }

    bool parse_error(size_t, const std::string& token, const nlohmann::detail::exception& error) override {
        constexpr int kNumberOverflow = 406;
        if (error.id == kNumberOverflow)
            throw Error(locate(numberStart()), "the number " + token + " is too large", "give a finite number");
        throw Error(locate(back(1)), "not valid JSON: " + reason(error.what()),
                    "check commas, quotes and brackets here and just before");
    }

    JsonValue root;

private:
    void rejectDuplicates(const std::vector<JsonMember>& members) const {
        std::vector<const JsonMember*> sorted;
        sorted.reserve(members.size());
        for (const JsonMember& member : members) sorted.push_back(&member);
        const auto byKey = [](const JsonMember* a, const JsonMember* b) { return a->key < b->key; };
        std::stable_sort(sorted.begin(), sorted.end(), byKey);
        const auto same = [](const JsonMember* a, const JsonMember* b) { return a->key == b->key; };
        const auto twice = std::adjacent_find(sorted.begin(), sorted.end(), same);
        if (twice == sorted.end()) return;
        const JsonMember &first = **twice, &second = **std::next(twice);
        throw Error({file_, second.line, second.column}, "the key " + inQuotes(second.key) + " is given twice",
                    "remove it here or in line " + std::to_string(first.line));
    }

    /// nlohmann's message without its own idea of the position.
    static std::string reason(const std::string& what) {
        const size_t column = what.find("column ");
        const size_t colon = column == std::string::npos ? column : what.find(": ", column);
        std::string text = colon == std::string::npos ? what : what.substr(colon + 2);
        std::replace(text.begin(), text.end(), ';', ',');
        return text;
    }

    size_t offset() const { return static_cast<size_t>(read - text_.data()); }
    size_t back(size_t length) const { return offset() - std::min(offset(), length); }

    size_t stringStart() const {
        size_t quote = back(1);
        const auto escaped = [&](size_t i) {
            size_t backslashes = 0;
            while (i > backslashes && text_[i - 1 - backslashes] == '\\') ++backslashes;
            return backslashes % 2 == 1;
        };
        do --quote;
        while (text_[quote] != '"' || escaped(quote));
        return quote;
    }

    size_t numberStart() const {
        const auto partOfNumber = [&](size_t i) { return std::strchr("0123456789+-.eE", text_[i]) != nullptr; };
        size_t i = offset();
        while (i > 0 && !partOfNumber(i - 1)) --i;
        while (i > 0 && partOfNumber(i - 1)) --i;
        return i;
    }

    SourceLocation locate(size_t at) const {
        const auto next = std::upper_bound(lineStarts_.begin(), lineStarts_.end(), at);
        return {file_, static_cast<int>(next - lineStarts_.begin()), static_cast<int>(at - *std::prev(next)) + 1};
    }

    JsonValue& add(JsonType type, size_t at) {
        const SourceLocation place = locate(at);
        JsonValue* value = &root;
        if (!open_.empty() && open_.back()->type == JsonType::object) value = &open_.back()->members.back().value;
        if (!open_.empty() && open_.back()->type == JsonType::array) value = &open_.back()->items.emplace_back();
        value->type = type, value->line = place.line, value->column = place.column;
        return *value;
    }

    bool addNumber(double number) { return add(JsonType::number, numberStart()).number = number, true; }

    bool open(JsonType type) {
        constexpr size_t kDeepest = 64;
        if (open_.size() == kDeepest) throw Error(locate(back(1)), "the brackets nest too deeply", "a scene needs 6 levels");
        open_.push_back(&add(type, back(1)));
        return true;
    }

    const std::string& text_;
    const std::string& file_;
    std::vector<size_t> lineStarts_{0};
    // Of the innermost open value on; a parent's vector does not grow while a child is open, so the pointers stay good.
    std::vector<JsonValue*> open_;

public:
    const char* read;
};

}  // namespace

const JsonValue* JsonValue::find(const std::string& key) const {
    const auto found = std::find_if(members.begin(), members.end(), [&](const JsonMember& m) { return m.key == key; });
    return found == members.end() ? nullptr : &found->value;
}

JsonValue parseJson(const std::string& text, const std::string& file) {
    TreeBuilder builder(text, file);
    const TrackedIterator begin(text.data(), &builder.read);
    const TrackedIterator end(text.data() + text.size(), &builder.read);
    const bool ignoreComments = true;
    Json::sax_parse(begin, end, &builder, Json::input_format_t::json, true, ignoreComments);
    return std::move(builder.root);
}

std::string describe(JsonType type) {
    switch (type) {
        case JsonType::null:
            return "null";
        case JsonType::boolean:
            return "true or false";
        case JsonType::number:
            return "a number";
        case JsonType::string:
            return "a string";
        case JsonType::array:
            return "an array";
        case JsonType::object:
            return "an object";
    }
    return "";
}

}  // namespace minirtc
