#include "page_method.hpp"

#include "figures.hpp"
#include "html.hpp"
#include "recommendation.hpp"

namespace cost {
namespace {

std::string ruleText(const Report& report) {
    return element("p", "", "<b>Recommended</b> is, " + prose("of" + recommendationRule(report).substr(2))) +
           element("p", "",
                   "<b>What to do</b>: <i>switch</i> is recommended, as good and faster; <i>could switch</i> is as good by "
                   "itself; <i>keep</i> what the "
                   "scene has, <i>upgrade</i> to a better picture: where the error changes by a larger factor than the time; "
                   "<i>not needed</i>: no better, and slower or worse; "
                   "<i>your choice</i>: where it does not, and of most numbers of samples; <i>hardly matters</i>: no "
                   "difference that could be measured, or not surely " +
                       prose(percent(kLeastSaving)) + " of the time.");
}

std::string errorText(const Report& report, bool bounds) {
    const Reference& r = report.reference;
    std::string marked = bounds ? ", and marked ≤" : "";
    if (bounds && report.samples() < report.sceneSamples)
        marked += " from " + number(report.floor()) + " on, as expected at the scene's own samples";
    return element("p", "",
                   "<b>Error</b> is relMSE: the mean over pixels and channels of (x − r)² / (r² + " + number(kRelMseEpsilon) +
                       "), x the linear radiance of the picture, r the reference's, without the " + prose(percent(kOutliers)) +
                       " of the pixels that are worst. A pixel <b>visibly changes</b> when a channel of its "
                       "8-bit sRGB value is off by more than " +
                       std::to_string(kUnseenSteps) + " steps.") +
           element("p", "",
                   "The <b>reference</b> has every setting at its most accurate and " + samplesWords(r.samples) +
                       ". Its own error, from the difference of two independent halves, is " + number(r.relMse) +
                       "; smaller errors are not to be believed" + marked + ".");
}

std::string samplesText(const Report& report) {
    if (report.reference.random)
        return element(
            "p", "",
            "<b>Bias</b> is the part of the error that more samples do not remove, from products of independent "
            "pictures, in which noise cancels; named where it exceeds three standard errors. All errors are given for the "
            "scene's own " +
                samplesWords(report.sceneSamples) + ": bias stays, noise falls as their number.");
    return element("p", "",
                   "Whitted's pictures repeat bit for bit: every setting has the same error of too few samples, and may hide it "
                   "by being wrong "
                   "itself. So the <b>error</b> of a setting is that of the scene's own, and what the setting adds or "
                   "takes <b>at the same samples</b>, held against the reference's settings there; more where more was measured. "
                   "The pixels are "
                   "those that the setting alone makes wrong. Numbers of samples are judged by their whole errors.");
}

std::string timeText(const Report& report) {
    return element(
               "p", "",
               "<b>Time</b> is the device's time for the dispatches of one picture: the median of " +
                   std::to_string(report.measurements.front().repeats) +
                   " repeats, in rounds in which all settings take turns. From these the drift of whole rounds is taken "
                   "out. It is compared by the ratios of all pairs of repeats; one whose middle half includes 1 is called "
                   "the same. Nothing is called slower, or is on the line of the plot as faster, that differs by less than twice "
                   "what the repeats scatter, since many settings are compared. Pipelines are created before; "
                   "a driver that caches them makes their time smaller.") +
           element("p", "",
                   prose(number(report.prepareSeconds) + " of " + number(report.seconds) +
                         " s went into baking and into the pipelines of " + std::to_string(report.pipelines) +
                         " variants of the scene, before the first picture."));
}

}  // namespace

std::string hardCasesSection(const Report& report) {
    if (report.hardCases.empty()) return "";
    std::string rows;
    for (const HardCases& row : report.hardCases) {
        std::string broken;
        for (const std::string& one : row.broken) broken += element("li", "", escaped(one));
        const std::string line = "<b class=\"held\">" + std::to_string(row.held) + "</b>" + escaped(row.settings);
        rows += broken.empty() ? element("p", "", line)
                               : element("details", "", element("summary", "", line) + element("ul", "", broken));
    }
    const HardCases& defaults = report.hardCases.front();
    const std::string held = std::to_string(defaults.held) + " of " + std::to_string(defaults.all);
    const std::string text =
        " are held by the default settings: small scenes in which rounding shows, each with a figure and its bound. What this "
        "scene "
        "may not show, another one will. Below, how many each setting alone holds, and which it breaks.";
    return element("h2", "", "Hard cases") + element("p", "", "<b>" + held + "</b>" + text) +
           element("div", "class=\"card cases\"", rows);
}

std::string methodSection(const Report& report, bool bounds) {
    std::string text = ruleText(report) + errorText(report, bounds) + samplesText(report) + timeText(report);
    if (report.samples() < report.sceneSamples)
        text += element("p", "",
                        "Measured with " + samplesWords(report.samples()) + " instead of the scene's " +
                            std::to_string(report.sceneSamples) + ", to end in time.");
    if (!report.baked)
        text += element("p", "", "From a blob only settings of the rendering can change; those of the bake need the scene file.");
    return element("h2", "id=\"method\"", "How this was measured") +
           element("details", "class=\"card\"", element("summary", "", "Rules and definitions") + text);
}

}  // namespace cost
