// What the page's words mean: those of the field that a reader need not know.
#pragma once
#include <set>
#include <string>

namespace cost {

/// Collects the words that a page uses.
class Glossary {
public:
    /// The same HTML, in which the first of each word, over all calls, leads to what it means; not in headings, commands and plots.
    std::string linked(const std::string& html);

    /// What the words found so far mean, as a list; "" where none was.
    std::string list() const;

private:
    std::set<size_t> found_;
};

}  // namespace cost
