#include "page.hpp"

#include <algorithm>

#include "commands.hpp"
#include "figures.hpp"
#include "glossary.hpp"
#include "half_time.hpp"
#include "html.hpp"
#include "page_pictures.hpp"
#include "page_plot.hpp"
#include "page_style.hpp"
#include "recommendation.hpp"

namespace cost {
namespace {

std::string image(const std::string& uri, const std::string& alternative) {
    return "<img src=\"" + uri + "\" alt=\"" + escaped(alternative) + "\" loading=\"lazy\">";
}

std::string figure(const std::string& uri, const std::string& caption) {
    return element("figure", "", image(uri, caption) + element("figcaption", "", escaped(caption)));
}

bool onFront(const Report& report, size_t i) {
    return std::find(report.front.begin(), report.front.end(), i) != report.front.end();
}

std::string anchor(size_t measurement) {
    return "picture-" + std::to_string(measurement);
}

std::string signedPercent(double ratio) {
    return (ratio < 1 ? "−" : "+") + percent(std::abs(ratio - 1));
}

std::string chip(const Comparison& c) {
    return "<span class=\"chip " + verdict(c) + "\">" + verdict(c) + "</span>";
}

/// Measurements whose pictures the page shows: of settings that change it, as many as do not make the page heavy.
std::vector<size_t> pictured(const Report& report) {
    constexpr size_t kMost = 14;
    std::vector<size_t> chosen = {0};
    for (const bool leading : {true, false})
        for (const Comparison& c : report.comparisons)
            if (c.leading == leading && c.change != ErrorChange::none && chosen.size() <= kMost) chosen.push_back(c.measurement);
    return chosen;
}

std::string leverSentence(const Report& report, const Comparison& c) {
    const std::vector<size_t> shown = pictured(report);
    // The picture is to show what the sentence says goes wrong without the accurate setting.
    const bool isCheap = report.measurements[c.measurement].configuration[c.lever] == c.cheap;
    const bool linked = isCheap && std::find(shown.begin(), shown.end(), c.measurement) != shown.end();
    return prose(sentence(report.levers[c.lever], c)) + (linked ? " <a href=\"#" + anchor(c.measurement) + "\">Where?</a>" : "");
}

std::string sampleCount(uint32_t count) {
    return std::to_string(count) + (count == 1 ? " sample" : " samples");
}

/// Where there was no time for the scene's own samples.
std::string insteadOf(const Report& report) {
    return report.samples() < report.sceneSamples ? " instead of the scene's " + std::to_string(report.sceneSamples) : "";
}

std::string atSamples(const Report& report) {
    return report.samples() < report.sceneSamples ? ", but " + sampleCount(report.samples()) + " a pixel" : "";
}

/// What to know beside the answer.
std::string findingsSection(const Report& report) {
    std::string items;
    for (size_t i : findings(report.levers, report.comparisons)) {
        const Comparison& c = report.comparisons[i];
        items += element("li", "class=\"" + verdict(c) + "\"", chip(c) + " " + leverSentence(report, c));
    }
    if (report.budgetMs > 0) items += element("li", "class=\"trade\"", prose(budgetSentence(report)));
    const std::string words =
        "<b>Error</b>: how far a picture is from the reference, in which all is at its most accurate; 0 is no difference. "
        "<b>Look wrong</b>: off by more than " +
        std::to_string(kUnseenSteps) +
        " of a screen's 255 steps. <b>Keep</b>: worth its time. <b>Spare</b>: time for nothing, leave it out. More under "
        "<a href=\"#method\">how this was measured</a>; underlined <a href=\"#words\">words</a> are explained there too.";
    return element("ul", "class=\"findings\"", items) + element("p", "class=\"soft\"", words);
}

/// What to type for a choice, or to write into the scene file.
std::string typed(const Report& report, const std::string& heading, const BudgetChoice& choice) {
    std::string lines;
    for (const std::string& command : commandsFor(report, choice)) lines += "<span>" + escaped(command) + "</span>";
    std::string text = element("p", "", heading) + element("pre", "", lines);
    const std::string keys = sceneKeys(report, choice);
    const std::string beside = optionsBesideKeys(report, choice);
    if (keys.empty()) return text;
    text += element("p", "", "or write into the scene file, beside what its <code>render</code> section holds already,");
    text += element("pre", "", escaped(keys));
    if (!beside.empty()) text += element("p", "", "and give minirt-render <code>" + escaped(beside.substr(1)) + "</code>.");
    return text;
}

/// How to get what the first sentences say, and by which rule they do.
std::string howToSection(const Report& report) {
    const HalfTime half = halfTime(report);
    std::string text =
        typed(report, recommended(report) ? "To get these settings, type" : "To render it with its own settings, type",
              recommendedChoice(report));
    if (half.choice && !half.advised)
        text += typed(report, half.fits ? "For half the time, type" : "For the fastest, type", *half.choice);
    return element("div", "class=\"card howto\"", text + element("p", "class=\"soft\"", prose(recommendationRule(report))));
}

/// Where other work took the device's time meanwhile.
std::string unsteadyWarning(const Report& report) {
    constexpr double kUnsteady = 0.1;
    const Spread& ms = report.measurements.front().ms;
    const double share = (ms.upper - ms.lower) / ms.median;
    if (share <= kUnsteady) return "";
    return element("p", "class=\"warning\"",
                   prose("Times were unsteady: the middle half of the repeats of the same picture differs by " + percent(share) +
                         ". Settings took turns, so a difference in time that is named is there, but not known to better than "
                         "that: measure again while nothing else runs."));
}

std::string head(const Report& report) {
    std::string text = element("h1", "", "What accuracy costs: " + escaped(report.scene)) +
                       element("p", "class=\"answer\"", prose(recommendationSentence(report))) +
                       element("p", "class=\"half\"", prose(halfTimeSentence(report)));
    text += element(
        "p", "class=\"soft\"",
        escaped(std::string(report.device.name) + ", " + std::to_string(report.width) + " × " + std::to_string(report.height) +
                " pixels, " + sampleCount(report.samples()) + " a pixel" + insteadOf(report) + ", " + report.date));
    text += unsteadyWarning(report) + findingsSection(report) + howToSection(report);
    const Measurement& own = report.measurements.front();
    std::string pictures = figure(
        pictureUri(own.picture),
        "The scene with its own settings" + atSamples(report) + ": " + number(own.ms.median) + " ms" +
            (report.reference.random && own.repeats > 1 ? " each, mean of " + std::to_string(own.repeats) + " pictures" : "") +
            ". " + percent(own.error.wrongPixels) + " of the pixels look wrong, the noise of " + sampleCount(report.samples()) +
            " a pixel included");
    pictures += figure(pictureUri(report.reference.mean), "The reference: every lever at its most accurate, " +
                                                              std::to_string(report.reference.samples) + " samples a pixel");
    return text + element("div", "class=\"hero\"", pictures);
}

std::string leversSection(const Report& report) {
    std::string items;
    for (const Comparison& c : report.comparisons)
        items += element("li", c.leading ? "" : "class=\"more\"", chip(c) + element("span", "", leverSentence(report, c)));
    for (const Lever& lever : report.levers)
        if (!lever.idle.empty())
            items +=
                element("li", "", "<span class=\"chip either\">idle</span>" + element("span", "", prose(idleSentence(lever))));
    for (const Failure& f : report.failures)
        items += element("li", "", "<span class=\"chip either\">failed</span>" + element("span", "", escaped(f.reason)));
    const std::string key =
        "A lever is a setting that trades accuracy for time. Each sentence holds a more accurate setting against a cheaper one; "
        "one "
        "of the two is the scene's own. "
        "<b>keep</b>: costs no time, or the error falls by a larger factor than the time grows. <b>trade</b>: more accurate, but "
        "the "
        "time grows by the larger factor. <b>spare</b>: costs time for nothing, leave it out. <b>idle</b>: can change nothing "
        "here. <b>either</b>: no difference. How to set each: "
        "<code>minirtc levers</code>.";
    return element("h2", "", "Each lever, the clearest choice first") + element("ul", "class=\"levers\"", items) +
           element("p", "class=\"soft\"", key);
}

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

std::string cell(const std::string& content, const std::string& cssClass = "") {
    return element("td", cssClass.empty() ? "" : "class=\"" + cssClass + "\"", content);
}

std::string biasCell(const Report& report, const Measurement& m) {
    if (!report.reference.random) return number(m.bias.value);
    if (m.repeats < 2) return "–";
    const double bias = systematicError(m, report.measurements.front().configuration);
    return bias > 0 ? number(bias) : "none seen";
}

std::string row(const Report& report, size_t i) {
    const Measurement& m = report.measurements[i];
    const std::string slowdown = i == 0 ? "" : covers(m.slowdown, 1) ? "in the noise" : signedPercent(m.slowdown.median);
    const std::string spread = number(m.ms.lower) + "–" + number(m.ms.upper);
    const std::string name = "<b class=\"" + groupOf(report, i) + "\">" + std::to_string(i) + "</b> " + escaped(report.nameOf(i));
    return element("tr", "",
                   element("th", "scope=\"row\"", name) + cell(number(m.ms.median)) + cell(spread) + cell(slowdown) +
                       cell(number(m.error.relMse), onFront(report, i) ? "front" : "") + cell(biasCell(report, m)) +
                       cell(percent(m.error.wrongPixels)) + cell(number(m.error.largest)) + cell(number(m.pipelineMs)) +
                       cell(number(static_cast<double>(m.kernelBytes) / 1000)));
}

std::string tableSection(const Report& report) {
    std::string rows;
    for (size_t i : tableOrder(report)) rows += row(report, i);
    const std::string bias = report.reference.random ? "bias, of the error" : "error at the same samples";
    std::string headings = "<th>settings</th>";
    for (const std::string& heading :
         {std::string("ms a picture"), std::string("middle half, ms"), std::string("time against the scene's own"),
          std::string("error (relMSE), noise included"), bias, std::string("pixels that look wrong, noise included"),
          std::string("largest error, radiance"), std::string("pipelines, ms"), std::string("kernels, kB")})
        headings += element("th", "scope=\"col\"", heading);
    return element("h2", "", "All figures") +
           element("p", "class=\"soft narrow\"", "The table goes on to the right: push it aside.") +
           element("div", "class=\"scroll\" tabindex=\"0\"",
                   element("table", "", element("thead", "", element("tr", "", headings)) + element("tbody", "", rows))) +
           element("p", "class=\"soft\"",
                   "Each row is named by what differs from the scene's own settings. <b>Middle half</b>: the middle half of the "
                   "repeats "
                   "took from so many ms to so many. <b>Green</b>: on the Pareto front, "
                   "nothing measured is surely both faster and more accurate. <b>Pipelines</b> and <b>kernels</b>: what the "
                   "driver took to "
                   "translate the programs of the device, once, and how large these are.");
}

/// What a picture is held against: Whitted's show what a lever does at the same samples.
const Picture& judgeOf(const Report& report, size_t i) {
    const Configuration& c = report.measurements[i].configuration;
    const size_t lever = findLever(report.levers, LeverKind::samples);
    const auto found = report.reference.atSamples.find(samplesOf(report.levers, c));
    const bool same = found != report.reference.atSamples.end() && c[lever] == report.levers[lever].initial && i > 0;
    return same ? found->second : report.reference.mean;
}

std::string picturePair(const Report& report, size_t i, const std::string& name) {
    const Measurement& m = report.measurements[i];
    const std::string what =
        std::to_string(i) + ": " + name + " (error " + number(m.error.relMse) + ", " + number(m.ms.median) + " ms)";
    return element("div", "class=\"pair\" id=\"" + anchor(i) + "\"",
                   element("p", "", escaped(what)) + image(pictureUri(m.picture), name) +
                       image(differenceUri(m.picture, judgeOf(report, i)), "where it differs from the reference"));
}

std::string picturesSection(const Report& report) {
    std::string pairs;
    for (size_t i : pictured(report)) pairs += picturePair(report, i, report.nameOf(i));
    const std::string scale =
        element("div", "class=\"key\"",
                element("p", "class=\"soft\"",
                        "Right of each picture is how far its pixels are from the reference, in steps "
                        "of a screen (8-bit sRGB), from 1 to 128 by their logarithm; black is up to " +
                            std::to_string(kUnseenSteps) + ", too little to see." +
                            std::string(report.reference.random ? ""
                                                                : " Where a lever alone is moved, the reference has the same "
                                                                  "samples, so that only what the lever does shows.")) +
                    "<img class=\"scale\" src=\"" + differenceScaleUri() + "\" alt=\"the scale\">" +
                    element("div", "class=\"steps soft\"",
                            "<span>1</span><span>2</span><span>4</span><span>8</span><span>16</span><span>32</span><span>64</"
                            "span><span>128</span>"));
    return element("h2", "", "Pictures and where they are wrong") + scale + element("div", "class=\"pictures\"", pairs);
}

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

std::string methodSection(const Report& report) {
    const Measurement& own = report.measurements.front();
    const Reference& r = report.reference;
    std::string text =
        element("p", "",
                "<b>Error</b> is relMSE: the mean over pixels and channels of (x − r)² / (r² + " + number(kRelMseEpsilon) +
                    "), x the linear radiance of the picture, r the reference's, without the " + percent(kOutliers) +
                    " of the pixels that are worst. A pixel <b>looks wrong</b> when a channel of its "
                    "8-bit sRGB value is off by more than " +
                    std::to_string(kUnseenSteps) + " steps.");
    text += element("p", "",
                    "The <b>reference</b> has every lever at its most accurate setting and " + std::to_string(r.samples) +
                        " samples a pixel. Its own error, from the difference of two independent halves, is " + number(r.relMse) +
                        "; smaller errors than that, noise included, are not to be believed.");
    text +=
        r.random
            ? element("p", "",
                      "<b>Bias</b> is the part of the error that more samples do not remove, from products of independent "
                      "pictures, in which noise cancels; named where it exceeds three standard errors. The sentences are for the "
                      "scene's own " +
                          std::to_string(report.sceneSamples) + " samples a pixel: bias stays, noise falls as their number.")
            : element(
                  "p", "",
                  "<b>At the same samples</b> is the error against the reference's settings at the same sample positions: what "
                  "the lever itself does, without the error of too few samples. Whitted's pictures repeat bit for bit. "
                  "A sentence judges a lever by itself: what the cheaper setting adds in that column is removed, as a share "
                  "of the error, noise included, that the accurate setting has and this on top of it. Noise may hide some of "
                  "it in the column of errors, which therefore differs less; its pixels are those that this lever alone makes "
                  "wrong. Numbers of samples are judged by their whole errors.");
    text += element("p", "",
                    "<b>Time</b> is the device's time for the dispatches of one picture: the median of " +
                        std::to_string(own.repeats) +
                        " repeats, in rounds in which all settings take turns. From these the drift of whole rounds is taken "
                        "out. Costs are ratios of all pairs of repeats; one whose middle half includes 1 is called not "
                        "measurable. Pipelines are created before and have a column of their own; "
                        "a driver that caches them makes it smaller.");
    if (report.samples() < report.sceneSamples)
        text += element("p", "",
                        "Measured with " + sampleCount(report.samples()) + " a pixel" + insteadOf(report) + ", to end in time.");
    text += element("p", "",
                    number(report.prepareSeconds) + " of " + number(report.seconds) +
                        " s went into baking and into the pipelines of " + std::to_string(report.pipelines) +
                        " variants of the scene, before the first picture.");
    if (!report.baked)
        text += element("p", "", "From a blob only levers of the rendering can move; those of the bake need the scene file.");
    return element("h2", "id=\"method\"", "How this was measured") + text;
}

std::string foot(const Report& report) {
    return element("footer", "",
                   escaped(std::string(report.device.name) + ", " + report.device.driver + ". " + report.date + ", " +
                           number(report.seconds) + " s. Again: ") +
                       element("code", "", escaped(report.command)));
}

}  // namespace

std::string page(const Report& report) {
    Glossary glossary;
    const std::string found = glossary.linked(head(report) + plotSection(report) + leversSection(report) + tableSection(report) +
                                              picturesSection(report) + hardCasesSection(report));
    const std::string method = glossary.linked(methodSection(report));
    const std::string body = found + element("h2", "id=\"words\"", "Words") + glossary.list() + method + foot(report);
    return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" "
           "content=\"width=device-width, initial-scale=1\">\n" +
           element("title", "", "What accuracy costs: " + escaped(report.scene)) + element("style", "", kPageStyle) +
           "</head>\n<body>\n" + element("main", "", body) + "</body>\n</html>\n";
}

}  // namespace cost
