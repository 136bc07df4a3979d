#include "json_fields.hpp"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <cstdio>

#include "text_file.hpp"

namespace minirtc {
namespace {

std::string toText(double number) {
    char text[32];
    std::snprintf(text, sizeof text, "%.9g", number);
    return text;
}

std::string describe(const Limits& limits) {
    const bool hasMin = std::isfinite(limits.min), hasMax = std::isfinite(limits.max);
    const std::string min = (limits.minIncluded ? "at least " : "over ") + toText(limits.min);
    const std::string max = (limits.maxIncluded ? "at most " : "under ") + toText(limits.max);
    if (hasMin && hasMax) return "a number " + min + " and " + max;
    if (hasMin) return "a number " + min;
    if (hasMax) return "a number " + max;
    return "a finite number";
}

bool contains(const std::vector<std::string>& words, const std::string& word) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

std::string join(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
    return text;
}

}  // namespace

std::string suggest(const std::string& word, const std::vector<std::string>& known) {
    const std::string nearest = nearestWord(word, known);
    return nearest.empty() ? "known here: " + join(known) : "did you mean '" + nearest + "'?";
}

void requireType(const SceneFile& file, const JsonValue& value, const std::string& name, JsonType type) {
    if (value.type != type) throw Error(file.at(value), name + " is " + describe(value.type), "give " + describe(type));
}

double readNumber(const SceneFile& file, const JsonValue& value, const std::string& key, const Limits& limits) {
    if (value.type != JsonType::number)
        throw Error(file.at(value), inQuotes(key) + " is " + describe(value.type), "give " + describe(limits));
    const double x = value.number;
    if (std::fabs(x) > FLT_MAX)
        throw Error(file.at(value), inQuotes(key) + " is " + toText(x), "single precision ends at 3.4e38");
    // A denormal counts as zero: devices may flush it.
    const double smallest = limits.min == 0 && !limits.minIncluded ? FLT_MIN : limits.min;
    const bool aboveMin = x > smallest || (x == smallest && (limits.minIncluded || smallest == FLT_MIN));
    const bool belowMax = x < limits.max || (x == limits.max && limits.maxIncluded);
    if (!aboveMin || !belowMax) throw Error(file.at(value), inQuotes(key) + " is " + toText(x), "give " + describe(limits));
    return x;
}

glm::dvec3 readVector(const SceneFile& file, const JsonValue& value, const std::string& key, const Limits& limits) {
    if (value.type != JsonType::array)
        throw Error(file.at(value), inQuotes(key) + " is " + describe(value.type), "give an array of 3 numbers");
    if (value.items.size() != 3)
        throw Error(file.at(value), inQuotes(key) + " has " + std::to_string(value.items.size()) + " entries",
                    "give an array of 3 numbers");
    glm::dvec3 v(0);
    for (int i = 0; i < 3; ++i) v[i] = readNumber(file, value.items[i], key + "[" + std::to_string(i) + "]", limits);
    return v;
}

JsonObject::JsonObject(SceneFile& file, const JsonValue& value, const std::string& what, const std::vector<std::string>& known)
    : file_(file), value_(value), what_(what) {
    requireType(file, value, what, JsonType::object);
    for (const JsonMember& member : value.members)
        if (!contains(known, member.key))
            throw Error({file.path, member.line, member.column}, what + " has no key " + inQuotes(member.key),
                        suggest(member.key, known));
}

const JsonValue& JsonObject::require(const std::string& key) const {
    const JsonValue* found = find(key);
    if (!found) throw Error(file_.at(value_), what_ + " has no '" + key + "'", "add it");
    return *found;
}

double JsonObject::number(const std::string& key, double fallback, const Limits& limits) const {
    const JsonValue* found = find(key);
    return found ? readNumber(file_, *found, key, limits) : fallback;
}

uint32_t JsonObject::integer(const std::string& key, uint32_t fallback, uint32_t min, uint32_t max) const {
    const JsonValue* found = find(key);
    if (!found) return fallback;
    const std::string hint = "give a whole number from " + std::to_string(min) + " to " + std::to_string(max);
    if (found->type != JsonType::number) fail(key, "'" + key + "' is " + describe(found->type), hint);
    const double x = found->number;
    if (x != std::floor(x) || x < min || x > max) fail(key, "'" + key + "' is " + toText(x), hint);
    return static_cast<uint32_t>(x);
}

bool JsonObject::boolean(const std::string& key, bool fallback) const {
    const JsonValue* found = find(key);
    if (!found) return fallback;
    requireType(file_, *found, "'" + key + "'", JsonType::boolean);
    return found->boolean;
}

glm::dvec3 JsonObject::vector(const std::string& key, const glm::dvec3& fallback) const {
    const JsonValue* found = find(key);
    return found ? readVector(file_, *found, key) : fallback;
}

glm::vec3 JsonObject::color(const std::string& key, const glm::vec3& fallback, const Limits& limits) const {
    const JsonValue* found = find(key);
    return found ? glm::vec3(readVector(file_, *found, key, limits)) : fallback;
}

const std::string& JsonObject::text(const std::string& key) const {
    const JsonValue& found = require(key);
    requireType(file_, found, "'" + key + "'", JsonType::string);
    if (found.string.empty()) fail(key, "'" + key + "' is empty", "give a name");
    return found.string;
}

std::string JsonObject::word(const std::string& key, const std::string& fallback, const std::vector<std::string>& known) const {
    if (!has(key)) return fallback;
    const std::string& word = text(key);
    if (!contains(known, word)) fail(key, "'" + key + "' is " + inQuotes(word), suggest(word, known));
    return word;
}

std::filesystem::path JsonObject::file(const std::string& key) const {
    const std::string& name = text(key);
    std::filesystem::path path = (file_.folder / std::filesystem::u8path(name)).lexically_normal();
    std::error_code code;
    if (std::filesystem::is_regular_file(path, code)) return path;
    const bool folder = std::filesystem::is_directory(path, code);
    fail(key, folder ? inQuotes(name) + " is a folder" : "there is no file " + inQuotes(name),
         "paths are relative to the scene file's folder");
}

void JsonObject::fail(const std::string& key, const std::string& message, const std::string& hint) const {
    const JsonValue* found = find(key);
    throw Error(file_.at(found ? *found : value_), message, hint);
}

}  // namespace minirtc
