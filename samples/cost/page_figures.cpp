#include "page_figures.hpp"

#include <algorithm>

#include "commands.hpp"
#include "figures.hpp"
#include "html.hpp"
#include "page_plot.hpp"
#include "recommendation.hpp"

namespace cost {
namespace {

/// The scene's own settings, then levers by their use, then combinations by time.
std::vector<size_t> tableOrder(const Report& report) {
    std::vector<size_t> order;
    for (size_t i = 0; i < report.measurements.size(); ++i) order.push_back(i);
    const auto rank = [&](size_t i) {
        const Configuration& c = report.measurements[i].configuration;
        const Configuration& own = report.measurements[0].configuration;
        if (i == 0 || i >= report.singles) return i == 0 ? size_t{0} : report.comparisons.size() + 2;
        const size_t lever = static_cast<size_t>(std::mismatch(c.begin(), c.end(), own.begin()).first - c.begin());
        size_t at = 0;
        while (at < report.comparisons.size() && report.comparisons[at].lever != lever) ++at;
        return at + 1;
    };
    std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) {
        return rank(a) != rank(b)
                   ? rank(a) < rank(b)
                   : rank(a) > report.comparisons.size() && report.measurements[a].ms.median < report.measurements[b].ms.median;
    });
    return order;
}

std::string cells(const std::vector<std::string>& contents) {
    std::string out;
    for (const std::string& content : contents) out += element("td", "", prose(content));
    return out;
}

std::string biasCell(const Report& report, const Measurement& m) {
    if (!report.reference.random) return number(m.bias.value);
    if (m.repeats < 2) return "–";
    const double bias = systematicError(m, report.measurements.front().configuration);
    return bias > 0 ? number(bias) : "none seen";
}

std::string badges(const Report& report, const HalfTime& half, size_t i) {
    return (i == recommended(report) ? recommendedBadge() : "") +
           (half.isShown() && half.measurement == i ? halfTimeBadge(half) : "");
}

std::string row(const Report& report, const HalfTime& half, size_t i) {
    const Measurement& m = report.measurements[i];
    const std::string name = numberedName(groupOf(report, i), std::to_string(i), report.nameOf(i)) + badges(report, half, i);
    return element("tr", "",
                   element("th", "scope=\"row\"", name) + element("td", "", i == 0 ? prose("100 %") : timeContent(m.slowdown)) +
                       cells({number(m.ms.median), errorFigure(report.errorOf(i), report.floor()), number(m.error.relMse),
                              biasCell(report, m), percent(m.error.wrongPixels), number(m.error.largest), number(m.pipelineMs),
                              number(static_cast<double>(m.kernelBytes) / 1000)}));
}

/// What halves the time, where it was not measured.
std::string expectedRow(const Report& report, const HalfTime& half) {
    if (!half.isShown() || half.measurement) return "";
    const std::string name = numberedName("half", kExpectedNumber, changesInWords(report, *half.choice)) + halfTimeBadge(half);
    return element("tr", "",
                   element("th", "scope=\"row\"", name) + element("td", "", expectedTimeContent(half)) +
                       cells({"–", errorFigure(half.choice->relMse, report.floor()), "–", "–", "–", "–", "–", "–"}));
}

std::vector<std::string> figuresHeadings(const Report& report) {
    return {"time",
            "ms, as measured",
            "error",
            "error as measured",
            report.reference.random ? "of it no noise (bias)" : "error at the same samples",
            "pixels that look wrong",
            "largest error, radiance",
            "pipelines, ms",
            "kernels, kB"};
}

std::string figuresKey(const Report& report, const std::string& table) {
    const bool fewer = report.samples() < report.sceneSamples;
    const std::string sceneSamples = "the scene's own " + std::to_string(report.sceneSamples);
    std::string text =
        "Each row is named by what differs from the scene's own settings; the numbers are those of the plot. <b>Time</b>: "
        "beneath "
        "it, the middle half of all repeats. <b>Error as measured</b>: of the picture as it was rendered";
    if (fewer) text += ", with " + samplesWords(report.samples()) + " in place of " + sceneSamples;
    text +=
        ". <b>Error</b>, as on the rest of the page: the error of the scene's own settings, and what other settings surely add "
        "or take";
    if (fewer) text += ", estimated for " + sceneSamples;
    text += "." + boundKey(report, table) + " <b>Look wrong</b>: off by more than " + std::to_string(kUnseenSteps) +
            " of a screen's 255 steps, for want of samples too. <b>Pipelines</b> and <b>kernels</b>: what the driver took to "
            "translate the "
            "programs of the device, once, and how large these are.";
    return element("p", "class=\"soft\"", text);
}

}  // namespace

std::string timeContent(const Spread& time) {
    return prose(measurable(time) ? relativeTime(time.median) : "same") +
           small(relativeTime(time.lower) + " to " + relativeTime(time.upper));
}

std::string expectedTimeContent(const HalfTime& half) {
    return prose(relativeTime(half.relativeTime())) + small("expected");
}

std::string boundKey(const Report& report, const std::string& table) {
    if (!hasBound(table)) return "";
    return " <b>≤</b>: no larger than what the error of the reference itself can make (" + number(report.floor()) +
           "), and so not to be believed.";
}

bool hasBound(const std::string& html) {
    return html.find("≤") != std::string::npos;
}

std::string figuresSection(const Report& report) {
    const HalfTime half = halfTime(report);
    std::string rows;
    for (size_t i : tableOrder(report)) rows += row(report, half, i) + (i == 0 ? expectedRow(report, half) : "");
    std::string head = "<th>settings</th>";
    for (const std::string& heading : figuresHeadings(report)) head += element("th", "scope=\"col\"", heading);
    const std::string table =
        element("table", "class=\"figures\"", element("thead", "", element("tr", "", head)) + element("tbody", "", rows));
    return element("h2", "id=\"figures\"", "All figures") +
           element(
               "details", "class=\"card\"",
               element("summary", "",
                       std::to_string(report.measurements.size()) + " choices of settings, each with its time and its errors") +
                   element("div", "class=\"scroll\" tabindex=\"0\"", table) + figuresKey(report, table));
}

}  // namespace cost
