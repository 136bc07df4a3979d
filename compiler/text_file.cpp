#include "text_file.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>

namespace minirtc {
namespace {

bool isBlank(char c) {
    return c == ' ' || c == '\t' || c == '\f' || c == '\v';
}

bool isBinary(char c) {
    return static_cast<unsigned char>(c) < 0x20 && !isBlank(c) && c != '\n' && c != '\r';
}

void rejectUnreadableText(const std::filesystem::path& path, const std::string& text) {
    const std::string mark = text.substr(0, 2);
    if (mark == "\xff\xfe" || mark == "\xfe\xff") throw Error({path.string()}, "the file is UTF-16", "save it as UTF-8 or ASCII");
    const auto binary = std::find_if(text.begin(), text.end(), isBinary);
    if (binary == text.end()) return;
    const int line = 1 + static_cast<int>(std::count(text.begin(), binary, '\n'));
    throw Error({path.string(), line}, "the file is not text (it holds the byte " + std::to_string(int(*binary)) + ")",
                "check that this is the file you meant");
}

}  // namespace

std::string readTextFile(const std::filesystem::path& path) {
    std::error_code code;
    if (std::filesystem::is_directory(path, code)) throw Error({path.string()}, "this is a folder", "name a file");
    std::ifstream file(path, std::ios::binary);
    if (!file) throw Error({path.string()}, "the file cannot be opened", "check that it exists and may be read");
    std::string text;
    const auto size = std::filesystem::file_size(path, code);
    if (!code) text.reserve(size);
    char block[1 << 16];
    while (file.read(block, sizeof block) || file.gcount() > 0) text.append(block, static_cast<size_t>(file.gcount()));
    if (file.bad()) throw Error({path.string()}, "the file cannot be read to its end", "check the disk");
    rejectUnreadableText(path, text);
    if (text.compare(0, 3, "\xef\xbb\xbf") == 0) text.erase(0, 3);
    return text;
}

std::string_view LineReader::takePhysicalLine() {
    size_t end = 0;
    while (end < rest_.size() && rest_[end] != '\r' && rest_[end] != '\n') ++end;
    const std::string_view line = rest_.substr(0, end);
    ++physical_;
    const size_t mark = rest_.compare(end, 2, "\r\n") == 0 ? 2 : 1;
    rest_.remove_prefix(std::min(end + mark, rest_.size()));
    return line;
}

bool LineReader::next() {
    if (rest_.empty()) return false;
    number_ = physical_ + 1;
    line_ = takePhysicalLine();
    if (!line_.empty() && line_.back() == '\\') {
        joined_.clear();
        while (!line_.empty() && line_.back() == '\\') {
            joined_.append(line_.substr(0, line_.size() - 1)).push_back(' ');
            line_ = takePhysicalLine();
        }
        joined_.append(line_);
        line_ = joined_;
    }
    line_ = trim(line_);
    if (!line_.empty() && line_.front() == '#') line_ = {};
    return true;
}

RewrittenLines::RewrittenLines(std::string_view text, Rewrite rewrite)
    : std::istream(this), lines_(text), rewrite_(std::move(rewrite)) {
    exceptions(std::ios::badbit);  // else the stream keeps what rewrite_ throws
}

int RewrittenLines::underflow() {
    for (out_.clear(); out_.empty(); rewrite_(lines_.line(), out_))
        if (!lines_.next()) return EOF;
    out_ += '\n';
    setg(out_.data(), out_.data(), out_.data() + out_.size());
    return static_cast<unsigned char>(out_.front());
}

std::string_view trim(std::string_view text) {
    while (!text.empty() && isBlank(text.front())) text.remove_prefix(1);
    while (!text.empty() && isBlank(text.back())) text.remove_suffix(1);
    return text;
}

std::string_view takeWord(std::string_view& line) {
    while (!line.empty() && isBlank(line.front())) line.remove_prefix(1);
    size_t length = 0;
    while (length < line.size() && !isBlank(line[length])) ++length;
    const std::string_view word = line.substr(0, length);
    line.remove_prefix(length);
    return word;
}

std::string_view takeValue(std::string_view& line) {
    const std::string_view word = takeWord(line);
    if (word.empty() || word.front() != '#') return word;
    line = {};
    return {};
}

std::string_view skipPlus(std::string_view number) {
    return number.substr(number.size() > 1 && number[0] == '+' && number[1] != '-' ? 1 : 0);
}

std::optional<double> appendNumber(std::string& line, std::string_view word) {
    constexpr size_t kLongest = 100;  // with more digits tinyobjloader overflows where the number does not
    if (word.size() > kLongest) return std::nullopt;
    const std::string_view digits = skipPlus(word);
    double value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (end != digits.data() + digits.size() || error == std::errc::invalid_argument) return std::nullopt;
    // from_chars reports underflow and overflow alike and leaves the value alone.
    if (error == std::errc::result_out_of_range) value = std::strtod(std::string(digits).c_str(), nullptr);
    if (!std::isfinite(value)) return std::nullopt;
    line.append(" ").append(value == 0 ? "0" : word);
    return value;
}

std::string inQuotes(std::string_view text) {
    constexpr size_t kLongest = 60;
    std::string shown(text.substr(0, kLongest));
    for (char& c : shown)
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
    return "'" + shown + (text.size() > kLongest ? "..." : "") + "'";
}

}  // namespace minirtc
