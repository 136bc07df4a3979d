#include "error.hpp"

#include <algorithm>
#include <numeric>

namespace minirtc {
namespace {

std::string compose(const SourceLocation& location, const std::string& message, const std::string& hint) {
    const std::string place = toString(location);
    return (place.empty() ? "" : place + ": ") + message + (hint.empty() ? "" : "; " + hint);
}

/// Levenshtein distance.
size_t editDistance(const std::string& a, const std::string& b) {
    std::vector<size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), size_t{0});
    for (size_t i = 1; i <= a.size(); ++i) {
        size_t diagonal = row[0];
        row[0] = i;
        for (size_t j = 1; j <= b.size(); ++j) {
            const size_t substituted = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
            diagonal = row[j];
            row[j] = std::min({substituted, row[j] + 1, row[j - 1] + 1});
        }
    }
    return row.back();
}

}  // namespace

std::string toString(const SourceLocation& location) {
    std::string text = location.file;
    if (location.line > 0) text += ":" + std::to_string(location.line);
    if (location.line > 0 && location.column > 0) text += ":" + std::to_string(location.column);
    return text;
}

Error::Error(const SourceLocation& location, const std::string& message, const std::string& hint)
    : std::runtime_error(compose(location, message, hint)) {}

Error::Error(const std::string& message, const std::string& hint) : Error(SourceLocation{}, message, hint) {}

void Diagnostics::warn(const SourceLocation& location, const std::string& message, const std::string& hint) {
    warnings.push_back(compose(location, "warning: " + message, hint));
}

std::string nearestWord(const std::string& word, const std::vector<std::string>& known) {
    std::string best;
    size_t bestDistance = word.size() / 2 + 1;
    for (const std::string& candidate : known) {
        const size_t distance = editDistance(word, candidate);
        if (distance < bestDistance) {
            bestDistance = distance;
            best = candidate;
        }
    }
    return best;
}

}  // namespace minirtc
