// Checked access to the keys of a scene file's objects. Whatever is wrong becomes one Error at the value's line and column.
#pragma once
#include <filesystem>
#include <glm/glm.hpp>
#include <limits>
#include <string>
#include <vector>

#include "json_value.hpp"

namespace minirtc {

/// The scene file being read.
struct SceneFile {
    std::string path;
    std::filesystem::path folder;  // relative paths start here
    Diagnostics& diagnostics;

    SourceLocation at(const JsonValue& value) const { return {path, value.line, value.column}; }
};

/// The numbers that a key takes. All must also be finite in float.
struct Limits {
    double min = -std::numeric_limits<double>::infinity();
    double max = std::numeric_limits<double>::infinity();
    bool minIncluded = true;
    bool maxIncluded = true;
};
constexpr Limits kAnyNumber{};
constexpr Limits kNotNegative{0};
constexpr Limits kPositive{0, std::numeric_limits<double>::infinity(), false};
constexpr Limits kZeroToOne{0, 1};

class JsonObject {
public:
    /// Throws unless `value` is an object with known keys only. `what` names it in messages: "the camera".
    JsonObject(SceneFile& file, const JsonValue& value, const std::string& what, const std::vector<std::string>& known);

    const JsonValue& value() const { return value_; }
    const JsonValue* find(const std::string& key) const { return value_.find(key); }
    bool has(const std::string& key) const { return find(key) != nullptr; }
    const JsonValue& require(const std::string& key) const;

    double number(const std::string& key, double fallback, const Limits& limits) const;
    uint32_t integer(const std::string& key, uint32_t fallback, uint32_t min, uint32_t max) const;
    bool boolean(const std::string& key, bool fallback) const;
    glm::dvec3 vector(const std::string& key, const glm::dvec3& fallback) const;
    glm::vec3 color(const std::string& key, const glm::vec3& fallback, const Limits& limits) const;
    /// A required string that is not empty.
    const std::string& text(const std::string& key) const;
    /// One of `known`.
    std::string word(const std::string& key, const std::string& fallback, const std::vector<std::string>& known) const;
    /// The path of an existing file, relative to the scene file.
    std::filesystem::path file(const std::string& key) const;

    /// Throws at the value of `key`, or at the object where it is absent.
    [[noreturn]] void fail(const std::string& key, const std::string& message, const std::string& hint) const;

private:
    SceneFile& file_;
    const JsonValue& value_;
    std::string what_;
};

/// Three numbers [x, y, z]. `key` is for messages.
glm::dvec3 readVector(const SceneFile& file, const JsonValue& value, const std::string& key, const Limits& limits = kAnyNumber);
double readNumber(const SceneFile& file, const JsonValue& value, const std::string& key, const Limits& limits = kAnyNumber);
/// `name` is for messages: "'objects'", "a light".
void requireType(const SceneFile& file, const JsonValue& value, const std::string& name, JsonType type);

/// The hint after an unknown word: "did you mean 'x'?", or all of `known` where none is near.
std::string suggest(const std::string& word, const std::vector<std::string>& known);

}  // namespace minirtc
