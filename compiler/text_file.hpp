// Text inputs: whole files and their logical lines.
#pragma once
#include <filesystem>
#include <functional>
#include <istream>
#include <optional>
#include <streambuf>
#include <string>
#include <string_view>

#include "error.hpp"

namespace minirtc {

/// All bytes of a file without a UTF-8 byte order mark. Throws Error when it cannot be read, is UTF-16 or is binary.
std::string readTextFile(const std::filesystem::path& path);

/// Walks over the lines of an OBJ or MTL text. Lines end in LF, CR LF or CR; a backslash at the end joins the next line.
class LineReader {
public:
    explicit LineReader(std::string_view text) : rest_(text) {}

    /// Moves to the next logical line; false at the end.
    bool next();
    /// The line without its outer blanks, empty when it is a comment. Valid until the next call of next().
    std::string_view line() const { return line_; }
    /// Number of the physical line on which it starts, from 1.
    int number() const { return number_; }

private:
    std::string_view takePhysicalLine();

    std::string_view rest_;
    std::string_view line_;
    std::string joined_;
    int number_ = 0;
    int physical_ = 0;
};

/// What tinyobjloader reads instead of a text: the lines that `rewrite` appends to `out` for each logical line of it, or none.
/// A line is made when it is asked for, so that number() is that of the line being read. What `rewrite` throws, the reader
/// throws.
class RewrittenLines : private std::streambuf, public std::istream {
public:
    using Rewrite = std::function<void(std::string_view line, std::string& out)>;
    RewrittenLines(std::string_view text, Rewrite rewrite);

    int number() const { return lines_.number(); }

private:
    int underflow() override;

    LineReader lines_;
    Rewrite rewrite_;
    std::string out_;
};

/// Takes the first blank-separated word off `line`; empty when there is none.
std::string_view takeWord(std::string_view& line);

/// As takeWord, but a word that starts with # ends the line: comments may follow numbers (names may hold a #).
std::string_view takeValue(std::string_view& line);

/// `number` without the + that std::from_chars does not take.
std::string_view skipPlus(std::string_view number);

/// Appends a blank and a finite number for tinyobjloader to a line and returns its value; nothing when `word` is none, has more
/// after it, has over 100 characters, or is NaN or infinite. Any zero becomes 0: tinyobjloader makes NaN of 0e999.
std::optional<double> appendNumber(std::string& line, std::string_view word);

/// `text` without blanks at both ends.
std::string_view trim(std::string_view text);

/// `text` in single quotes for a message, shortened, with anything unprintable replaced: a message is one line.
std::string inQuotes(std::string_view text);

}  // namespace minirtc
