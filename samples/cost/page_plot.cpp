#include "page_plot.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "action.hpp"
#include "commands.hpp"
#include "figures.hpp"
#include "html.hpp"
#include "pareto.hpp"
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

constexpr Layout kNarrow = {"narrow", 340, 360, 12, 0};
constexpr Layout kWide = {"wide", 860, 480, 18, 44};

/// What the plot shows, worked out once.
struct Shown {
    const Report& report;
    HalfTime half;
    size_t advised;
    std::vector<size_t> order;  // measurements, the most important first

    bool isHalf(size_t i) const { return half.isShown() && half.measurement == i; }
    bool isExpectedShown() const { return half.isShown() && !half.measurement; }
    bool isPale(size_t i) const {
        if (i == 0 || i == advised || isHalf(i)) return false;
        const Comparison* c = report.comparisonOf(i);
        return c ? adviceOn(report, *c).action == Action::hardlyMatters : isLikeOwn(report, i);
    }
    /// Of each setting the leading choice that changes the picture, and all numbers of samples.
    bool isWorthNaming(const Comparison& c) const {
        return (c.leading || report.levers[c.lever].kind == LeverKind::samples) && c.change != ErrorChange::none;
    }
    /// Whether a measurement is worth a label.
    bool isNamed(size_t i) const {
        const Comparison* c = report.comparisonOf(i);
        const bool onFront = std::find(report.front.begin(), report.front.end(), i) != report.front.end();
        return i == 0 || i == advised || isHalf(i) || onFront || (!isPale(i) && (!c || isWorthNaming(*c)));
    }
};

/// How far a measurement is from the scene's own settings in the plot.
double distanceFromOwn(const Report& report, size_t i) {
    return std::hypot(std::log(report.measurements[i].slowdown.median),
                      std::log(std::max(report.errorOf(i), 1e-9) / std::max(report.errorOf(0), 1e-9)));
}

/// The scene's own settings, what is recommended, what halves the time, the front by time, and the others from the farthest on.
std::vector<size_t> byImportance(const Report& report, const HalfTime& half, size_t advised) {
    std::vector<size_t> order = {0, advised};
    if (half.isShown() && half.measurement) order.push_back(*half.measurement);
    order.insert(order.end(), report.front.begin(), report.front.end());
    std::vector<size_t> others(report.measurements.size());
    std::iota(others.begin(), others.end(), size_t{0});
    std::stable_sort(others.begin(), others.end(),
                     [&](size_t a, size_t b) { return distanceFromOwn(report, a) > distanceFromOwn(report, b); });
    order.insert(order.end(), others.begin(), others.end());
    std::vector<size_t> once;
    for (size_t i : order)
        if (std::find(once.begin(), once.end(), i) == once.end()) once.push_back(i);
    return once;
}

Shown shownOf(const Report& report) {
    Shown shown{report, halfTime(report), recommended(report), {}};
    shown.order = byImportance(report, shown.half, shown.advised);
    return shown;
}

Mark markOf(const Shown& shown, size_t i) {
    if (i == shown.advised) return Mark::star;
    if (shown.isHalf(i)) return Mark::square;
    return groupOf(shown.report, i) == "combination" && !shown.isPale(i) ? Mark::hollowDiamond : Mark::disc;
}

PlotPoint pointOf(const Shown& shown, size_t i) {
    const Measurement& m = shown.report.measurements[i];
    PlotPoint point;
    point.number = std::to_string(i);
    point.name = shown.report.nameOf(i);
    point.group = shown.isHalf(i) ? "half" : groupOf(shown.report, i);
    point.mark = markOf(shown, i);
    point.important = i == 0 || i == shown.advised || shown.isHalf(i);
    point.pale = shown.isPale(i);
    if (shown.isNamed(i)) point.text = point.number;
    point.time = m.slowdown.median, point.timeLower = m.slowdown.lower, point.timeUpper = m.slowdown.upper;
    point.error = shown.report.errorOf(i);
    return point;
}

PlotPoint expectedPoint(const Shown& shown) {
    PlotPoint point;
    point.number = kExpectedNumber;
    point.name = changesInWords(shown.report, *shown.half.choice);
    point.group = "half";
    point.mark = Mark::hollowSquare;
    point.important = true;
    point.text = point.number;
    point.time = point.timeLower = point.timeUpper = shown.half.relativeTime();
    point.error = shown.half.choice->relMse;
    return point;
}

/// The points in the order of `shown`; what is expected to halve the time comes after the scene's own settings and what is recommended.
Plot pointsOf(const Shown& shown) {
    Plot plot;
    for (size_t i : shown.order) plot.points.push_back(pointOf(shown, i));
    const size_t first = shown.advised == 0 ? 1 : 2;
    const size_t more = shown.isExpectedShown() ? 1 : 0;
    if (more) plot.points.insert(plot.points.begin() + static_cast<ptrdiff_t>(first), expectedPoint(shown));
    for (size_t i : shown.report.front) {
        const auto at = static_cast<size_t>(std::find(shown.order.begin(), shown.order.end(), i) - shown.order.begin());
        plot.front.push_back(at < first ? at : at + more);
    }
    return plot;
}

Plot plotOf(const Shown& shown, const Layout& layout) {
    Plot plot = pointsOf(shown);
    plot.width = layout.width;
    plot.height = layout.height;
    plot.cssClass = layout.cssClass;
    plot.floor = shown.report.floor();
    size_t labels = 0;
    for (PlotPoint& point : plot.points) {
        if (point.text.empty()) continue;
        if (labels++ >= layout.mostLabels) point.text = "";
        if (!point.text.empty() && letterCount(point.name) <= layout.longestName) point.text += ": " + point.name;
    }
    return plot;
}

/// The names of numbers that stand alone in the plot.
std::string numbersList(const Plot& plot, const std::vector<size_t>& points) {
    std::string items;
    for (size_t i : points) {
        if (plot.points[i].number == kExpectedNumber) continue;  // the legend names it
        items += element("li", "", numberedName(plot.points[i].group, plot.points[i].number, plot.points[i].name));
    }
    return items.empty() ? "" : element("ul", "class=\"numbers " + plot.cssClass + "\"", items);
}

/// With the names of its numbers.
std::string plotWithNames(const Shown& shown, const Layout& layout) {
    const Plot plot = plotOf(shown, layout);
    const DrawnPlot drawn = drawPlot(plot);
    return drawn.svg + numbersList(plot, drawn.numbersAlone);
}

std::string legendItem(const std::string& cssClass, const std::string& mark, const std::string& content) {
    return element("li", "class=\"" + cssClass + "\"", "<svg viewBox=\"0 0 12 12\">" + mark + "</svg>" + content);
}

/// The marks of single choices: what is recommended, the scene's own settings, what halves the time.
std::string choicesLegend(const Shown& shown) {
    const Report& report = shown.report;
    std::string items = legendItem(groupOf(report, shown.advised), markSvg(Mark::star, 6, 6, 7),
                                   "recommended: " + escaped(report.nameOf(shown.advised)));
    if (shown.advised > 0) items += legendItem("own", markSvg(Mark::disc, 6, 6, 5), "the scene's own settings");
    if (!shown.half.isShown()) return items;
    const std::string what = shown.half.fits ? "half the time: " : "the fastest: ";
    const std::string name = escaped(changesInWords(report, *shown.half.choice));
    return items + (shown.half.measurement ? legendItem("half", markSvg(Mark::square, 6, 6, 5), what + name)
                                           : legendItem("half", markSvg(Mark::hollowSquare, 6, 6, 5),
                                                        what + name + " (" + kExpectedNumber + ", expected, not measured)"));
}

std::string legend(const Shown& shown) {
    const auto any = [&](const auto& holds) {
        return std::any_of(shown.order.begin(), shown.order.end(), [&](size_t i) { return i > 0 && holds(i); });
    };
    std::string items = choicesLegend(shown) + legendItem("lever", markSvg(Mark::disc, 6, 6, 4), "one setting changed");
    if (any([&](size_t i) { return markOf(shown, i) == Mark::hollowDiamond; }))
        items += legendItem("combination", markSvg(Mark::hollowDiamond, 6, 6, 5.5), "several changed");
    if (any([&](size_t i) { return shown.isPale(i); }))
        items += legendItem("lever pale", markSvg(Mark::disc, 6, 6, 2.5), "hardly matters");
    if (shown.report.front.size() > 1)
        items += legendItem("front-line", "<path d=\"M0 6H12\"/>",
                            "the best found: further along, a picture takes longer and is surely more accurate");
    return element("ul", "class=\"legend\"", items);
}

/// Combinations that a reader would ask about, since they look as good as what is recommended; what speaks against single settings is in their table.
std::string notRecommendedList(const Shown& shown) {
    std::string items;
    for (size_t i = shown.report.singles; i < shown.report.measurements.size(); ++i) {
        const std::string reason = shown.isPale(i) ? "" : whyNotRecommended(shown.report, i);
        if (reason.empty()) continue;
        items += element(
            "li", "", numberedName(groupOf(shown.report, i), std::to_string(i), shown.report.nameOf(i)) + ": " + prose(reason));
    }
    if (items.empty()) return "";
    return element("p", "class=\"soft\"",
                   "Several changed, as good as ★ or better by the looks of the plot, but not recommended:") +
           element("ul", "class=\"numbers\"", items);
}

}  // namespace

std::string groupOf(const Report& report, size_t measurement) {
    return measurement == 0 ? "own" : measurement < report.singles ? "lever" : "combination";
}

std::string numberedName(const std::string& group, const std::string& number, const std::string& name) {
    return "<b class=\"" + group + "\">" + number + "</b> " + escaped(name);
}

std::string recommendedBadge() {
    return " <span class=\"badge\">★ recommended</span>";
}

std::string halfTimeBadge(const HalfTime& half) {
    const std::string name = half.fits ? "half the time" : "the fastest";
    return " <span class=\"badge\">" + (half.measurement ? "■ " + name : "□ " + name + ", expected") + "</span>";
}

std::string plotSection(const Report& report) {
    const Shown shown = shownOf(report);
    std::string plots;
    for (const Layout& layout : {kNarrow, kWide}) plots += plotWithNames(shown, layout);
    return element("h2", "", "Error against time") +
           element("div", "class=\"card\"", plots + legend(shown) + notRecommendedList(shown)) +
           element("p", "class=\"soft\"",
                   "Each mark is a picture with other settings: further left is faster, further down more accurate. The numbers "
                   "are those of the table "
                   "above and of <a href=\"#figures\">all figures</a>; a bar is how far the time is known.");
}

}  // namespace cost
