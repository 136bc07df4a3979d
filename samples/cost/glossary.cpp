#include "glossary.hpp"

#include <algorithm>
#include <cctype>
#include <vector>

#include "html.hpp"

namespace cost {
namespace {

struct Term {
    std::string id;
    std::string title;
    std::vector<std::string> words;  // that lead to it, small but for names; a longer one before one that it begins with
    std::string meaning;             // HTML
};

const std::vector<Term> kTerms = {
    {"absorption",
     "Absorption",
     {"absorption"},
     "A medium takes light away, the more the longer the way through it. Setting <code>absorption</code>."},
    {"bias", "Bias", {"bias"}, "The part of the error that more samples do not remove."},
    {"blob", "Blob", {"blob"}, "The file (.mrt) that <code>minirtc bake</code> makes of a scene."},
    {"bounce",
     "Bounce",
     {"bounces", "bounce"},
     "A ray that is reflected or refracted goes on after a bounce, at most so many times. Setting <code>depth</code>, "
     "<code>--max-depth</code>."},
    {"cutoff",
     "Cut-off",
     {"cut-off"},
     "The share of the light up to which a ray counts as weak. Setting <code>cutoff</code>, <code>--cutoff</code>."},
    {"dispersion",
     "Dispersion",
     {"dispersion"},
     "Each colour of light refracts by another angle: of three channels, or of single wavelengths (spectral). Setting "
     "<code>dispersion</code>."},
    {"double",
     "Double precision",
     {"double precision", "single precision"},
     "Numbers of 64 bits instead of the 32 of single precision, where a ray meets a surface. Setting <code>precision</code>."},
    {"fresnel",
     "Fresnel",
     {"Fresnel"},
     "How much of the light a smooth surface reflects and how much it lets in: exact by Fresnel's equations, or by Schlick's "
     "formula, which comes near "
     "them. Setting <code>fresnel</code>."},
    {"integrator",
     "Integrator",
     {"integrator"},
     "The method that computes the light of a pixel: Whitted's tracer or a path tracer. <code>--integrator</code>."},
    {"kernel",
     "Kernel",
     {"kernels", "kernel"},
     "A program that runs on the device; its <b>pipeline</b> is what the driver has translated it to."},
    {"light",
     "Light, ways to find it",
     {"both ways to find light", "light found by", "power heuristic", "balance heuristic"},
     "A path tracer finds light where surfaces send its rays, or by picking lights (next-event estimation, NEE). Multiple "
     "importance sampling (MIS) does both and "
     "weighs them by the power or the balance heuristic (Veach 1997). Setting <code>light_sampling</code>, "
     "<code>--light-sampling</code>."},
    {"llvmpipe", "llvmpipe", {"llvmpipe"}, "Mesa's driver lavapipe, which runs a graphics card's programs on the processor."},
    {"look-wrong",
     "Look wrong, visibly change",
     {"look wrong", "looks wrong", "visibly change"},
     "A pixel that looks wrong is so far from the reference's that a screen shows it: by more than 2 of 255 steps, noise "
     "included. Those that visibly change "
     "by a setting alone are counted without the noise: the pictures with it and without it have the same."},
    {"moeller",
     "Möller–Trumbore",
     {"Möller–Trumbore"},
     "The usual test of a ray against a triangle (1997). Between two triangles a ray may slip through; with an epsilon, flat "
     "and near hits get lost too. Setting "
     "<code>intersection</code>."},
    {"nesting",
     "Nesting of volumes",
     {"nesting"},
     "How a ray knows which media it is in, such as ice in whisky in glass: ordered, by a set in which one displaces the "
     "others; by parity, where the first of two "
     "that overlap counts; or not at all. Setting <code>nesting</code>."},
    {"noise", "Noise", {"noise"}, "The part of the error that is chance, for want of samples."},
    {"normals",
     "Normals",
     {"smooth normals", "flat normals"},
     "The directions by which surfaces are shaded: flat, one a face; smooth, interpolated between the corners. Setting "
     "<code>normals</code>."},
    {"path",
     "Path tracer",
     {"path tracers", "path tracer"},
     "It follows light at random over all surfaces, for all kinds of light. As one kernel or, in parts, as a wavefront it "
     "draws the same."},
    {"radiance", "Radiance", {"radiance"}, "The brightness of light, before it is fitted to a screen."},
    {"offset",
     "Ray offset",
     {"ray offset"},
     "How far off a surface the rays start that leave it, lest rounding make them hit it again: constant, scaled by the "
     "distance to the camera, or just beyond the "
     "error that rounding can have made (error-bounded). Setting <code>ray_offset</code>."},
    {"reference",
     "Reference",
     {"reference"},
     "The picture that the others are held against: every setting at its most accurate, and many samples."},
    {"relmse",
     "relMSE",
     {"relMSE"},
     "Relative mean square error: the mean of squared differences from the reference, each relative to its brightness."},
    {"sample", "Sample", {"samples", "sample"}, "One look through a pixel; its colour is the mean of them. <code>--spp</code>."},
    {"watertight",
     "Watertight",
     {"watertight"},
     "A test of a ray against triangles that leaves no gap along an edge which two of them share (Woop, Benthin and Wald "
     "2013). Setting <code>intersection</code>."},
    {"weak",
     "Weak rays",
     {"weak rays", "Russian roulette", "roulette"},
     "Those of Whitted's tracer that carry no more light than the cut-off. They end, or play Russian roulette: few survive "
     "and count for the others, "
     "which is noise in place of light that is always missing. Setting <code>weak_rays</code>."},
    {"whitted",
     "Whitted's tracer",
     {"Whitted's"},
     "It follows mirror and refracted rays and hard shadows (1980), not light that rough surfaces pass on."},
};

bool isLetter(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || (static_cast<unsigned char>(c) & 0x80) || c == '-' || c == '_';
}

/// How long the word of a term is that stands at a place of a text, or 0. A sentence may begin with it.
size_t matchAt(const std::string& text, size_t at, const Term& term) {
    if (at > 0 && isLetter(text[at - 1])) return 0;
    for (const std::string& word : term.words) {
        if (at + word.size() > text.size() || text.compare(at + 1, word.size() - 1, word, 1, std::string::npos) != 0) continue;
        const bool begins = std::toupper(static_cast<unsigned char>(word[0])) == static_cast<unsigned char>(text[at]);
        if ((text[at] == word[0] || begins) && (at + word.size() == text.size() || !isLetter(text[at + word.size()])))
            return word.size();
    }
    return 0;
}

/// Follows the tags of a text, to know where words may be links.
class Place {
public:
    /// `tag`: without its angle brackets.
    void pass(const std::string& tag) {
        const bool closes = tag[0] == '/';
        const std::string name = tag.substr(closes ? 1 : 0, tag.find_first_of(" \n", 1) - (closes ? 1 : 0));
        for (const char* kept : {"a", "pre", "code", "svg", "h1", "h2", "summary"})
            if (name == kept) depth_ += closes ? -1 : 1;
    }
    bool takesLinks() const { return depth_ == 0; }

private:
    int depth_ = 0;
};

}  // namespace

std::string Glossary::linked(const std::string& html) {
    std::string out;
    Place place;
    for (size_t at = 0; at < html.size();) {
        if (html[at] == '<') {
            const size_t end = html.find('>', at);
            place.pass(html.substr(at + 1, end - at - 1));
            out += html.substr(at, end + 1 - at);
            at = end + 1;
            continue;
        }
        size_t length = 0;
        for (size_t i = 0; place.takesLinks() && length == 0 && i < kTerms.size(); ++i) {
            length = found_.count(i) ? 0 : matchAt(html, at, kTerms[i]);
            if (length == 0) continue;
            found_.insert(i);
            out += "<a class=\"term\" href=\"#word-" + kTerms[i].id + "\">" + html.substr(at, length) + "</a>";
        }
        if (length == 0) out += html[at++];
        at += length;
    }
    return out;
}

std::string Glossary::list() const {
    std::string items;
    for (size_t i : found_)
        items += element("dt", "id=\"word-" + kTerms[i].id + "\"", kTerms[i].title) + element("dd", "", kTerms[i].meaning);
    return items.empty() ? "" : element("dl", "class=\"words\"", items);
}

}  // namespace cost
