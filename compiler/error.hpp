// Errors and warnings that a user reads: where, what is wrong, what to do.
#pragma once
#include <stdexcept>
#include <string>
#include <vector>

namespace minirtc {

/// A place in an input file. `line` and `column` count from 1; 0 means unknown.
struct SourceLocation {
    std::string file;
    int line = 0;
    int column = 0;
};

/// `file:line:column` with the unknown parts left out.
std::string toString(const SourceLocation& location);

/// An input that cannot be baked. `what()` is `file:line:column: message; hint`.
class Error : public std::runtime_error {
public:
    Error(const SourceLocation& location, const std::string& message, const std::string& hint);
    /// For errors that belong to no file.
    Error(const std::string& message, const std::string& hint);
};

/// Warnings gathered while baking, in order; the command prints them to stderr.
struct Diagnostics {
    std::vector<std::string> warnings;
    void warn(const SourceLocation& location, const std::string& message, const std::string& hint);
};

/// The entry of `known` with the least edit distance to `word`, or "" when none is near (distance over half of its length).
std::string nearestWord(const std::string& word, const std::vector<std::string>& known);

}  // namespace minirtc
