// JSON that knows where it stands in its file, so that every complaint about a value names line and column.
#pragma once
#include <string>
#include <vector>

#include "error.hpp"

namespace minirtc {

enum class JsonType { null, boolean, number, string, array, object };

struct JsonMember;

/// A JSON value; only the field of its `type` has a meaning.
struct JsonValue {
    JsonType type = JsonType::null;
    bool boolean = false;
    double number = 0;
    std::string string;
    std::vector<JsonValue> items;
    std::vector<JsonMember> members;  // in the order of the file, keys unique
    int line = 0;
    int column = 0;

    /// The member's value, or null.
    const JsonValue* find(const std::string& key) const;
};

struct JsonMember {
    std::string key;
    int line = 0;
    int column = 0;
    JsonValue value;
};

/// Parses a text with // and /* */ comments. `file` is for messages. Throws Error at the first syntax error, duplicate key,
/// number beyond double or nesting deeper than 64.
JsonValue parseJson(const std::string& text, const std::string& file);

/// "a number", "an object", ... for messages.
std::string describe(JsonType type);

}  // namespace minirtc
