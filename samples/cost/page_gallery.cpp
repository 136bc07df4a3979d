#include "page_gallery.hpp"

#include <algorithm>

#include "figures.hpp"
#include "html.hpp"
#include "page_pictures.hpp"

namespace cost {
namespace {

std::string image(const std::string& uri, const std::string& alternative) {
    return "<img src=\"" + uri + "\" alt=\"" + escaped(alternative) + "\" loading=\"lazy\">";
}

std::string figure(const std::string& uri, const std::string& caption) {
    return element("figure", "", image(uri, caption) + element("figcaption", "", prose(caption)));
}

std::string anchor(size_t measurement) {
    return "picture-" + std::to_string(measurement);
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

/// What a picture is held against: Whitted's show what a lever does at the same samples.
const Picture& judgeOf(const Report& report, size_t i) {
    const Configuration& c = report.measurements[i].configuration;
    const size_t lever = findLever(report.levers, LeverKind::samples);
    const auto found = report.reference.atSamples.find(samplesOf(report.levers, c));
    const bool same = found != report.reference.atSamples.end() && c[lever] == report.levers[lever].initial && i > 0;
    return same ? found->second : report.reference.mean;
}

std::string picturePair(const Report& report, size_t i) {
    const std::string name = report.nameOf(i);
    const std::string what = std::to_string(i) + ": " + name + ", error " + errorFigure(report.errorOf(i), report.floor());
    return element(
        "div", "class=\"pair\" id=\"" + anchor(i) + "\"",
        element("p", "", prose(what)) + image(pictureUri(report.measurements[i].picture), name) +
            image(differenceUri(report.measurements[i].picture, judgeOf(report, i)), "where it differs from the reference"));
}

std::string ownAndReference(const Report& report) {
    const std::string measured = report.samples() < report.sceneSamples ? ", but with " + samplesWords(report.samples()) : "";
    return element("div", "class=\"hero\"",
                   figure(pictureUri(report.measurements.front().picture), "The scene's own settings" + measured) +
                       figure(pictureUri(report.reference.mean),
                              "The reference: every setting at its most accurate, " + samplesWords(report.reference.samples)));
}

std::string scale() {
    std::string steps;
    for (int step = 1; step <= 128; step *= 2) steps += "<span>" + std::to_string(step) + "</span>";
    return "<img class=\"scale\" src=\"" + differenceScaleUri() + "\" alt=\"the scale\">" +
           element("div", "class=\"steps soft\"", steps);
}

std::string galleryKey(const Report& report) {
    std::string text =
        "Right of each picture: how far its pixels are from the reference, in steps of a screen's 255. Black is too little to "
        "see.";
    if (!report.reference.random)
        text +=
            " The reference has the same samples here, so that only what the setting does shows; for other numbers of samples it "
            "is "
            "the one above.";
    return element("div", "class=\"key\"", element("p", "class=\"soft\"", text) + scale());
}

}  // namespace

std::string linkToPicture(const Report& report, size_t measurement, const std::string& html) {
    const std::vector<size_t> shown = pictured(report);
    if (std::find(shown.begin(), shown.end(), measurement) == shown.end()) return html;
    return "<a href=\"#" + anchor(measurement) + "\">" + html + "</a>";
}

std::string gallerySection(const Report& report) {
    std::string pairs;
    for (size_t i : pictured(report))
        if (i > 0 || report.reference.random) pairs += picturePair(report, i);
    return element("h2", "", "Pictures, and where they are wrong") + ownAndReference(report) + galleryKey(report) +
           element("div", "class=\"pictures\"", pairs);
}

}  // namespace cost
