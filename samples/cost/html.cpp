#include "html.hpp"

namespace cost {

std::string escaped(const std::string& text) {
    std::string out;
    for (char c : text) {
        if (c == '&')
            out += "&amp;";
        else if (c == '<')
            out += "&lt;";
        else if (c == '>')
            out += "&gt;";
        else if (c == '"')
            out += "&quot;";
        else
            out += c;
    }
    return out;
}

std::string element(const std::string& name, const std::string& attributes, const std::string& content) {
    return "<" + name + (attributes.empty() ? "" : " " + attributes) + ">" + content + "</" + name + ">\n";
}

std::string prose(const std::string& text) {
    std::string out = escaped(text);
    for (const char* unit : {" %", " ms"})
        for (size_t at = out.find(unit); at != std::string::npos; at = out.find(unit, at + 1)) out.replace(at, 1, "\u00a0");
    const std::string atMost = "≤ ";
    for (size_t at = out.find(atMost); at != std::string::npos; at = out.find(atMost, at + 1))
        out.replace(at, atMost.size(), "≤\u00a0");
    return out;
}

std::string small(const std::string& text) {
    return "<small>" + prose(text) + "</small>";
}

}  // namespace cost
