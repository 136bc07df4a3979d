#include "page.hpp"

#include "action.hpp"
#include "better_picture.hpp"
#include "commands.hpp"
#include "figures.hpp"
#include "glossary.hpp"
#include "half_time.hpp"
#include "html.hpp"
#include "page_figures.hpp"
#include "page_gallery.hpp"
#include "page_method.hpp"
#include "page_plot.hpp"
#include "page_settings.hpp"
#include "page_style.hpp"
#include "recommendation.hpp"

namespace cost {
namespace {

std::string goal(const std::string& name, const std::string& answer) {
    return element("dt", "", name) + element("dd", "", prose(answer));
}

/// What to do for each thing that a person may want.
std::string answers(const Report& report) {
    std::string goals = goal("The same picture in less time", recommendationSentence(report)) +
                        goal("Half the time", halfTimeSentence(report)) + goal("A better picture", betterPictureSentence(report));
    if (report.budgetMs > 0) goals += goal(number(report.budgetMs) + " ms", budgetSentence(report));
    return element("dl", "class=\"answers\"", goals);
}

/// The two settings to know.
std::string findingsList(const Report& report) {
    std::string items;
    for (size_t i : findings(report)) {
        const Comparison& c = report.comparisons[i];
        const Action action = adviceOn(report, c).action;
        items += element(
            "li", "class=\"" + actionName(action) + "\"",
            "<b>" + prose(instruction(report, c)) + ".</b> " + prose(sentence(report.levers[c.lever], c, report.floor())));
    }
    return element("ul", "class=\"findings\"", items);
}

std::string definitions(const Report& report) {
    std::string text =
        "<b>Error</b>: how far a picture is from the reference, which has every setting at its most accurate and many samples; 0 "
        "is no difference. ";
    if (!report.reference.random)
        text +=
            "That of another setting is the scene's own and what the setting adds by itself. <b>Visibly change</b>: by more "
            "than " +
            std::to_string(kUnseenSteps) + " of a screen's 255 steps. ";
    text += "<b>Time</b>: in brackets behind it, the middle half of all repeats. ";
    return element("p", "class=\"soft\"", text + "Underlined <a href=\"#words\">words</a> are explained at the end.");
}

/// What to type for a choice, or to write into the scene file.
std::string typed(const Report& report, const std::string& heading, const BudgetChoice& choice) {
    std::string lines;
    for (const std::string& command : commandsFor(report, choice)) lines += "<span>" + escaped(command) + "</span>";
    std::string text = element("p", "", heading) + element("pre", "", lines);
    const std::string keys = sceneKeys(report, choice);
    const std::string beside = optionsBesideKeys(report, choice);
    if (keys.empty()) return text;
    text += element("p", "", "or merge into the <code>render</code> section of the scene file,");
    text += element("pre", "", escaped(keys));
    if (!beside.empty()) text += element("p", "", "and give minirt-render <code>" + escaped(beside.substr(1)) + "</code>.");
    return text;
}

std::string howToSection(const Report& report) {
    const HalfTime half = halfTime(report);
    std::string text = typed(report, recommended(report) ? "For the same picture in less time" : "With the scene's own settings",
                             recommendedChoice(report));
    if (half.isShown()) text += typed(report, half.fits ? "For half the time" : "For the fastest", *half.choice);
    const std::optional<BudgetChoice> better = betterPicture(report);
    if (better && commandsFor(report, *better) != commandsFor(report, recommendedChoice(report)))
        text += typed(report, "For a better picture", *better);
    return element("h2", "", "What to type") + element("div", "class=\"card howto\"", text);
}

/// Where other work took the device's time meanwhile.
std::string unsteadyWarning(const Report& report) {
    constexpr double kUnsteady = 0.1;
    const Spread& ms = report.measurements.front().ms;
    const double share = (ms.upper - ms.lower) / ms.median;
    if (share <= kUnsteady) return "";
    return element("p", "class=\"warning\"",
                   prose("Times were unsteady: the repeats of one picture scatter by " + percent(share) +
                         ". How far a time is known stands in brackets behind it. Measure again while nothing else runs."));
}

std::string head(const Report& report) {
    std::string about = std::string(report.device.name) + ", " + std::to_string(report.width) + " × " +
                        std::to_string(report.height) + " pixels, " + samplesWords(report.sceneSamples);
    if (report.samples() < report.sceneSamples)
        about += " (errors estimated from pictures with " + std::to_string(report.samples()) + ")";
    return element("h1", "", "What accuracy costs: " + escaped(report.scene)) +
           element("p", "class=\"soft\"", escaped(about + ", " + report.date)) + unsteadyWarning(report) + answers(report) +
           findingsList(report) + definitions(report);
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
    const std::string figures = head(report) + howToSection(report) + settingsSection(report) + plotSection(report) +
                                gallerySection(report) + figuresSection(report) + hardCasesSection(report);
    const std::string found = glossary.linked(figures + methodSection(report, hasBound(figures)));
    const std::string body = found + element("h2", "id=\"words\"", "Words") + glossary.list() + foot(report);
    return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" "
           "content=\"width=device-width, initial-scale=1\">\n" +
           element("title", "", "What accuracy costs: " + escaped(report.scene)) + element("style", "", kPageStyle) +
           "</head>\n<body>\n" + element("main", "", body) + "</body>\n</html>\n";
}

}  // namespace cost
