#include "page_plot.hpp"

#include <algorithm>
#include <cmath>

#include "figures.hpp"
#include "html.hpp"
#include "plot.hpp"
#include "recommendation.hpp"

namespace cost {
namespace {

struct Layout {
    const char* cssClass;
    double width, height;
    size_t mostLabels;
    size_t longestName;  // letters that a label has room for beside its number; 0: numbers alone
};

constexpr Layout kNarrow = {"narrow", 320, 330, 20, 0};
constexpr Layout kWide = {"wide", 860, 480, 30, 38};

/// How far a measurement is from the scene's own settings in the plot.
double distanceFromOwn(const Report& report, size_t i) {
    const Measurement& own = report.measurements.front();
    const Measurement& m = report.measurements[i];
    return std::hypot(std::log(m.ms.median / own.ms.median),
                      std::log(std::max(m.error.relMse, 1e-9) / std::max(own.error.relMse, 1e-9)));
}

/// The scene's own settings, what is recommended, the front by time, and the others from the farthest on.
std::vector<size_t> byImportance(const Report& report) {
    std::vector<size_t> order = {0, recommended(report)};
    order.insert(order.end(), report.front.begin(), report.front.end());
    std::vector<size_t> others;
    for (size_t i = 0; i < report.measurements.size(); ++i) others.push_back(i);
    std::stable_sort(others.begin(), others.end(),
                     [&](size_t a, size_t b) { return distanceFromOwn(report, a) > distanceFromOwn(report, b); });
    order.insert(order.end(), others.begin(), others.end());
    std::vector<size_t> once;
    for (size_t i : order)
        if (std::find(once.begin(), once.end(), i) == once.end()) once.push_back(i);
    return once;
}

bool isPale(const Report& report, size_t i) {
    return i > 0 && i != recommended(report) && !standsOut(report.measurements[i], report.measurements.front());
}

/// The measurements that have labels.
std::vector<size_t> labelled(const Report& report, const Layout& layout) {
    std::vector<size_t> chosen;
    for (size_t i : byImportance(report))
        if (chosen.size() < layout.mostLabels && !isPale(report, i)) chosen.push_back(i);
    return chosen;
}

PlotPoint pointOf(const Report& report, const Layout& layout, size_t i) {
    const Measurement& m = report.measurements[i];
    const std::vector<size_t> all = labelled(report, layout);
    PlotPoint point;
    point.number = std::to_string(i);
    point.name = report.nameOf(i);
    point.group = groupOf(report, i);
    point.advised = i == recommended(report);
    point.pale = isPale(report, i);
    if (std::find(all.begin(), all.end(), i) != all.end())
        point.text = point.name.size() <= layout.longestName ? point.number + ": " + point.name : point.number;
    point.time = m.ms.median, point.timeLower = m.ms.lower, point.timeUpper = m.ms.upper;
    point.error = m.error.relMse;
    return point;
}

Plot plotOf(const Report& report, const Layout& layout, const std::vector<size_t>& order) {
    Plot plot;
    plot.width = layout.width;
    plot.height = layout.height;
    plot.cssClass = layout.cssClass;
    plot.floor = report.reference.relMse;
    plot.halfTime = report.measurements.front().ms.median / 2;
    for (size_t i : order) plot.points.push_back(pointOf(report, layout, i));
    for (size_t i : report.front)
        plot.front.push_back(static_cast<size_t>(std::find(order.begin(), order.end(), i) - order.begin()));
    return plot;
}

/// The names of numbers that stand alone in the plot.
std::string numbersList(const Report& report, const std::string& cssClass, std::vector<size_t> numbers) {
    std::sort(numbers.begin(), numbers.end());
    std::string items;
    for (size_t i : numbers)
        items += element("li", "",
                         "<b class=\"" + groupOf(report, i) + "\">" + std::to_string(i) + "</b> " + escaped(report.nameOf(i)));
    return items.empty() ? "" : element("ul", "class=\"numbers " + cssClass + "\"", items);
}

/// With the names of its numbers.
std::string plotOf(const Report& report, const Layout& layout) {
    const std::vector<size_t> order = byImportance(report);
    const DrawnPlot drawn = drawPlot(plotOf(report, layout, order));
    std::vector<size_t> numbers;
    for (size_t i : drawn.numbersAlone) numbers.push_back(order[i]);
    return drawn.svg + numbersList(report, layout.cssClass, numbers);
}

std::string legendItem(const std::string& cssClass, const std::string& mark, const std::string& content) {
    return element("li", "class=\"" + cssClass + "\"", "<svg viewBox=\"0 0 12 12\">" + mark + "</svg>" + content);
}

std::string legend(const Report& report) {
    const auto any = [&](const auto& holds) {
        for (size_t i = 1; i < report.measurements.size(); ++i)
            if (holds(i)) return true;
        return false;
    };
    const auto disc = [](const char* radius) {
        return std::string("<circle cx=\"6\" cy=\"6\" r=\"") + radius + "\" fill=\"currentColor\"/>";
    };
    const size_t advised = recommended(report);
    std::string items = legendItem(groupOf(report, advised), "<path d=\"" + starPath(6, 6, 7) + "\" fill=\"currentColor\"/>",
                                   "recommended: " + escaped(report.nameOf(advised)));
    if (advised > 0) items += legendItem("own", disc("5"), "the scene's own settings");
    items += legendItem("lever", disc("4"), "one lever moved");
    if (any([&](size_t i) { return groupOf(report, i) == "combination"; }))
        items += legendItem("combination",
                            "<path d=\"M1 6l5-5 5 5-5 5z\" fill=\"none\" stroke=\"currentColor\" stroke-width=\"1.6\"/>",
                            "several moved");
    if (any([&](size_t i) { return isPale(report, i); }))
        items += legendItem("lever pale", disc("2.5"), "like the scene's own settings");
    items += legendItem("", "<path d=\"M0 6H12\" stroke=\"var(--front)\" stroke-width=\"2\"/>",
                        "Pareto front: nothing measured is surely both faster and more accurate than these");
    return element("ul", "class=\"legend\"", items);
}

std::string paleSentence(const Report& report) {
    std::string names;
    for (size_t i = 1; i < report.measurements.size(); ++i)
        if (isPale(report, i)) names += (names.empty() ? "" : "; ") + report.nameOf(i) + " (" + std::to_string(i) + ")";
    if (names.empty()) return "";
    return " Small pale dots have no label: in time and in error they are like the scene's own settings, but for chance or " +
           percent(kSameTime) + ". They are " + names + ".";
}

}  // namespace

std::string groupOf(const Report& report, size_t measurement) {
    return measurement == 0 ? "own" : measurement < report.singles ? "lever" : "combination";
}

std::string plotSection(const Report& report) {
    std::string plots;
    for (const Layout& layout : {kNarrow, kWide}) plots += plotOf(report, layout);
    return element("h2", "", "Error against time") + element("div", "class=\"card\"", plots + legend(report)) +
           element(
               "p", "class=\"soft\"",
               prose(
                   "The numbers are those of the table. Left is faster, lower is more accurate; both axes are logarithmic; bars "
                   "span the middle half of the repeats. A dot without a label is in the table, by its time and its error." +
                   paleSentence(report)));
}

}  // namespace cost
