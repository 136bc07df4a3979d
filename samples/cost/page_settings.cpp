#include "page_settings.hpp"

#include <algorithm>

#include "action.hpp"
#include "figures.hpp"
#include "html.hpp"
#include "page_gallery.hpp"
#include "page_plot.hpp"

namespace cost {
namespace {

/// An action in its colour.
std::string chip(Action action) {
    return "<span class=\"chip " + actionName(action) + "\">" + actionWords(action) + "</span>";
}

/// A cell; `label` names its column where a narrow page has no headings.
std::string cell(const std::string& label, const std::string& content) {
    return element("td", label.empty() ? "" : "data-label=\"" + label + "\"", content);
}

std::string small(const std::string& text) {
    return "<small>" + prose(text) + "</small>";
}

/// The headings; pixels are counted only where noise does not hide them.
std::vector<std::string> settingsHeadings(const Report& report) {
    std::vector<std::string> names = {"Time", "Error", "Visibly changed pixels"};
    if (report.reference.random) names.pop_back();
    return names;
}

std::string timeContent(const Comparison& c) {
    const Spread& time = c.relativeTime;
    return prose(measurable(time) ? relativeTime(time.median) : "same") +
           small(relativeTime(time.lower) + " to " + relativeTime(time.upper));
}

std::string errorContent(const Report& report, const Comparison& c) {
    return c.change == ErrorChange::none ? "same" : prose(errorFigure(c.errorThen(), report.floor()));
}

std::string pixelsContent(const Report& report, const Comparison& c) {
    if (report.levers[c.lever].kind == LeverKind::samples) return "–";
    if (c.change == ErrorChange::none || c.wrongPixels <= 0) return "none";
    return linkToPicture(report, c.measurement, prose(percent(c.wrongPixels)));
}

std::string comparisonCells(const Report& report, const Comparison& c) {
    const Advice advice = adviceOn(report, c);
    const std::vector<std::string> names = settingsHeadings(report);
    std::string cells =
        element("td", "class=\"tried\"",
                "<b class=\"lever\">" + std::to_string(c.measurement) + "</b> " + escaped(report.nameOf(c.measurement)));
    cells += cell(names[0], timeContent(c)) + cell(names[1], errorContent(report, c));
    if (names.size() > 2) cells += cell(names[2], pixelsContent(report, c));
    return cells + element("td", "class=\"do\"", chip(advice.action) + small(advice.reason));
}

/// All comparisons of a lever, the cheapest first, beside what the scene has.
std::string leverRows(const Report& report, std::vector<size_t> comparisons) {
    std::sort(comparisons.begin(), comparisons.end(),
              [&](size_t a, size_t b) { return report.comparisons[a].measurement < report.comparisons[b].measurement; });
    const Lever& lever = report.levers[report.comparisons[comparisons.front()].lever];
    std::string rows;
    for (size_t i : comparisons) {
        std::string head;
        if (rows.empty())
            head = element("th", "scope=\"rowgroup\" rowspan=\"" + std::to_string(comparisons.size()) + "\"",
                           escaped(lever.title) + small("now: " + lever.settings[lever.initial].words));
        rows += element("tr", "", head + comparisonCells(report, report.comparisons[i]));
    }
    return element("tbody", "", rows);
}

std::string ownRow(const Report& report) {
    const std::vector<std::string> names = settingsHeadings(report);
    std::string cells = element("th", "scope=\"row\" colspan=\"2\"", "<b class=\"own\">0</b> the scene's own settings");
    cells += cell(names[0], "100\u00a0%") + cell(names[1], prose(errorFigure(report.errorOf(0), report.floor())));
    if (names.size() > 2) cells += cell("", "");
    return element("tbody", "class=\"own-row\"", element("tr", "", cells + cell("", "")));
}

std::string table(const Report& report) {
    std::string head = element("th", "scope=\"col\"", "Setting") + element("th", "scope=\"col\"", "Tried instead");
    for (const std::string& name : settingsHeadings(report)) head += element("th", "scope=\"col\"", name);
    head += element("th", "scope=\"col\"", "What to do");
    std::string bodies = ownRow(report);
    std::vector<size_t> group;
    const std::vector<size_t> order = byAction(report);
    for (size_t at = 0; at < order.size(); ++at) {
        group.push_back(order[at]);
        const bool last = at + 1 == order.size() || report.comparisons[order[at + 1]].leading;
        if (!last) continue;
        bodies += leverRows(report, group);
        group.clear();
    }
    return element("table", "class=\"settings\"", element("thead", "", element("tr", "", head)) + bodies);
}

/// What was not tried, or failed.
std::string leftOut(const Report& report) {
    std::string items;
    for (const Lever& lever : report.levers)
        if (!lever.idle.empty()) items += element("li", "", prose(idleSentence(lever)));
    for (const Failure& failure : report.failures) items += element("li", "", "Failed: " + escaped(failure.reason));
    return items.empty() ? "" : element("ul", "class=\"left-out soft\"", items);
}

std::string settingsKey(const Report& report) {
    std::string text =
        "<b>Time</b>: compared with the scene's own settings; beneath it, the middle half of all repeats. "
        "<b>Error</b>: at the scene's own " +
        samplesWords(report.sceneSamples) + ".";
    bool marked = false;
    for (size_t i = 0; i < report.singles; ++i) marked = marked || report.errorOf(i) <= report.floor();
    if (marked)
        text += " <b>≤</b>: no larger than what the error of the reference itself can make (" + number(report.floor()) +
                "), and so not to be believed.";
    return element("p", "class=\"soft\"", text + " <code>minirtc levers</code> tells how to set each.");
}

}  // namespace

std::string settingsSection(const Report& report) {
    return element("h2", "id=\"settings\"", "Each setting: what the scene has, and what else there is") + table(report) +
           settingsKey(report) + leftOut(report);
}

}  // namespace cost
