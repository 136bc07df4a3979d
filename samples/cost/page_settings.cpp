#include "page_settings.hpp"

#include <algorithm>

#include "action.hpp"
#include "commands.hpp"
#include "figures.hpp"
#include "half_time.hpp"
#include "html.hpp"
#include "page_figures.hpp"
#include "page_gallery.hpp"
#include "page_plot.hpp"
#include "recommendation.hpp"

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

/// The headings; pixels are counted only where noise does not hide them.
std::vector<std::string> settingsHeadings(const Report& report) {
    std::vector<std::string> names = {"Time", "Error", "Visibly changed pixels"};
    if (report.reference.random) names.pop_back();
    return names;
}

std::string errorContent(const Report& report, const Comparison& c) {
    return c.change == ErrorChange::none ? "same" : prose(errorFigure(c.errorThen(), report.floor()));
}

/// Of a measurement, and of choices with its settings.
std::string pixelsContent(const Report& report, size_t measurement) {
    const Measurement& m = report.measurements[measurement];
    if (report.isOwnButSamples(m.configuration)) return "–";
    const Comparison* c = report.comparisonOf(measurement);
    const double changed = c ? c->wrongPixels : moreWrongPixels(report, m);
    return changed <= 0 ? "none" : linkToPicture(report, measurement, prose(percent(changed)));
}

std::string comparisonCells(const Report& report, const Comparison& c) {
    const Advice advice = adviceOn(report, c);
    const std::vector<std::string> names = settingsHeadings(report);
    std::string cells =
        element("td", "class=\"tried\"", numberedName("lever", std::to_string(c.measurement), report.nameOf(c.measurement)));
    cells += cell(names[0], timeContent(c.relativeTime)) + cell(names[1], errorContent(report, c));
    if (names.size() > 2) cells += cell(names[2], pixelsContent(report, c.measurement));
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

/// A row of a whole choice: the scene's own settings, or one of the answers at the top of the page. `cells`: time, error, pixels.
std::string choiceRow(const Report& report, const std::string& name, const std::vector<std::string>& cells) {
    const std::vector<std::string> names = settingsHeadings(report);
    std::string row = element("th", "scope=\"row\" colspan=\"2\"", name);
    for (size_t i = 0; i < names.size(); ++i) row += cell(cells[i].empty() ? "" : names[i], cells[i]);
    return element("tr", "", row + cell("", ""));
}

std::string recommendedRow(const Report& report) {
    const size_t i = recommended(report);
    if (i == 0) return "";
    const Measurement& m = report.measurements[i];
    return choiceRow(report, numberedName(groupOf(report, i), std::to_string(i), report.nameOf(i)) + recommendedBadge(),
                     {timeContent(m.slowdown), prose(errorFigure(report.errorOf(i), report.floor())), pixelsContent(report, i)});
}

std::string halfTimeRow(const Report& report) {
    const HalfTime half = halfTime(report);
    if (!half.isShown()) return "";
    const std::string number = half.measurement ? std::to_string(*half.measurement) : kExpectedNumber;
    const std::string time =
        half.measurement ? timeContent(report.measurements[*half.measurement].slowdown) : expectedTimeContent(half);
    return choiceRow(report, numberedName("half", number, changesInWords(report, *half.choice)) + halfTimeBadge(half),
                     {time, prose(errorFigure(half.choice->relMse, report.floor())),
                      pixelsContent(report, report.measurementOf(half.choice->configuration))});
}

/// The scene's own settings, and what the page answers.
std::string choicesBody(const Report& report) {
    const std::string own = choiceRow(report, numberedName("own", "0", report.nameOf(0)),
                                      {"100\u00a0%", prose(errorFigure(report.errorOf(0), report.floor())), ""});
    return element("tbody", "class=\"choices\"", own + recommendedRow(report) + halfTimeRow(report));
}

std::string table(const Report& report) {
    std::string head = element("th", "scope=\"col\"", "Setting") + element("th", "scope=\"col\"", "Tried instead");
    for (const std::string& name : settingsHeadings(report)) head += element("th", "scope=\"col\"", name);
    head += element("th", "scope=\"col\"", "What to do");
    std::string bodies = choicesBody(report);
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

/// What the table's figures and signs mean.
std::string settingsKey(const Report& report, const std::string& table) {
    std::string text =
        "<b>Time</b>: compared with the scene's own settings; beneath it, the middle half of all repeats. "
        "<b>Error</b>: at the scene's own " +
        samplesWords(report.sceneSamples) + ".";
    if (table.find(">–<") != std::string::npos) text += " <b>–</b>: not counted, since other samples change every edge.";
    return element("p", "class=\"soft\"", text + boundKey(report, table) + " <code>minirtc levers</code> tells how to set each.");
}

}  // namespace

std::string settingsSection(const Report& report) {
    const std::string rows = table(report);
    return element("h2", "id=\"settings\"", "Each setting: what the scene has, and what else there is") + rows +
           settingsKey(report, rows) + leftOut(report);
}

}  // namespace cost
