#include "comparison.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "figures.hpp"

namespace cost {
namespace {

/// Less than this share of time or error is not worth a word.
constexpr double kNoticeable = 0.005;

bool isChance(const Estimate& difference, double noticeable) {
    return std::abs(difference.value) <= std::max(3 * difference.standardError, noticeable);
}

/// Errors of a cheap and an accurate setting.
struct ErrorPair {
    double cheap = 0, accurate = 0;
    bool differ = false;
};

/// Whether a lever changes how many samples there are or which, not what one of them shows.
bool changesSamples(LeverKind kind) {
    return kind == LeverKind::samples || kind == LeverKind::integrator;
}

bool morePixelsAreWrong(const Measurement& cheap, const Measurement& accurate) {
    return std::abs(cheap.sameSamples.wrongPixels - accurate.sameSamples.wrongPixels) > kNoticeablePixels;
}

/// Pictures that repeat bit for bit share the noise of their few samples: on top of it comes what the cheap one gets wrong at these very samples. That it
/// may get a bright spark wrong and so have less noise is no merit.
ErrorPair deterministicErrors(const Measurement& cheap, const Measurement& accurate) {
    ErrorPair pair;
    pair.accurate = accurate.error.relMse;
    pair.cheap = pair.accurate + std::max(cheap.sameSamples.relMse - accurate.sameSamples.relMse, 0.0);
    pair.differ = pair.cheap - pair.accurate > kNoticeable * pair.cheap || morePixelsAreWrong(cheap, accurate);
    return pair;
}

/// The mean difference of the pixels is worth a word and beyond three standard errors, or more pixels look wrong.
ErrorPair sampledErrors(const Measurement& cheap, const Measurement& accurate) {
    ErrorPair pair = {cheap.error.relMse, accurate.error.relMse, false};
    const double noticeable = kNoticeable * std::max(pair.cheap, pair.accurate);
    pair.differ = !isChance(pairedDifference(cheap.error, accurate.error), noticeable) || morePixelsAreWrong(cheap, accurate);
    return pair;
}

/// What more samples leave, the shift between the two, is the cheap one's error; the rest falls as their number.
ErrorPair noisyErrors(const Measurement& cheap, const Measurement& accurate, const Estimate& shift, double moreSamples) {
    const double systematic = shift.isSignificant() ? shift.value : 0;
    ErrorPair pair;
    pair.cheap = systematic + std::max(cheap.error.relMse - systematic, 0.0) / moreSamples;
    pair.accurate = accurate.error.relMse / moreSamples;
    const double noticeable = kNoticeable * std::max(cheap.error.relMse, accurate.error.relMse);
    const bool noise = !isChance(pairedDifference(cheap.error, accurate.error), noticeable);
    pair.differ = noise || systematic > kNoticeable * pair.accurate;
    if (!noise) pair.cheap = systematic + pair.accurate;
    return pair;
}

Spread inverse(const Spread& s) {
    return {1 / s.median, 1 / s.upper, 1 / s.lower};
}

bool measurable(const Spread& slowdown) {
    return !covers(slowdown, 1) && std::abs(slowdown.median - 1) >= kNoticeable;
}

Comparison compareSettings(const std::vector<Lever>& levers, const std::vector<Measurement>& singles, size_t at, size_t lever,
                           double moreSamples) {
    Comparison c;
    const size_t own = levers[lever].initial;
    const size_t other = singles[at].configuration[lever];
    c.lever = lever;
    c.cheap = std::min(own, other);
    c.accurate = std::max(own, other);
    c.measurement = at;
    const Measurement& cheap = other < own ? singles[at] : singles[0];
    const Measurement& accurate = other < own ? singles[0] : singles[at];
    c.slowdown = other < own ? inverse(singles[at].slowdown) : singles[at].slowdown;
    const double time = measurable(c.slowdown) ? std::log(c.slowdown.median) : 0;
    const bool random = singles[0].bias.standardError > 0;
    const ErrorPair errors =
        random ? noisyErrors(cheap, accurate, singles[at].shift, levers[lever].kind == LeverKind::samples ? 1 : moreSamples)
        : changesSamples(levers[lever].kind) ? sampledErrors(cheap, accurate)
                                             : deterministicErrors(cheap, accurate);
    // Of few pixels chance alone could be the difference, but that more samples have less noise needs no proof.
    const bool fewerSamples = levers[lever].kind == LeverKind::samples && errors.cheap > (1 + kNoticeable) * errors.accurate;
    double error = 0;
    if (errors.differ || fewerSamples) {
        c.removed = 1 - errors.accurate / std::max(errors.cheap, 1e-30);
        c.change = c.removed >= 0 ? ErrorChange::less : ErrorChange::more;
        c.wrongPixels = std::max(cheap.sameSamples.wrongPixels - accurate.sameSamples.wrongPixels, 0.0);
        error = std::log(std::max(errors.cheap, 1e-12) / std::max(errors.accurate, 1e-12));
    }
    c.usefulness = error - time;
    return c;
}

std::string capitalised(std::string text) {
    text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
    return text;
}

std::string costPhrase(const Comparison& c, bool plural) {
    const std::string s = plural ? "" : "s";
    if (!measurable(c.slowdown)) return plural ? "have no measurable cost" : "has no measurable cost";
    if (c.slowdown.median < 1) return "save" + s + " " + percent(1 - c.slowdown.median) + " of the time";
    if (c.slowdown.median < 2) return "cost" + s + " " + percent(c.slowdown.median - 1) + " more time";
    return "take" + s + " " + number(c.slowdown.median) + " times as long";
}

std::string changePhrase(const Comparison& c, bool plural) {
    const std::string s = plural ? "" : "s";
    if (c.change == ErrorChange::none) return "change" + s + " nothing that could be measured in the picture";
    std::string phrase;
    if (std::abs(c.removed) < kNoticeable)
        phrase = "change" + s + " little of the error";
    else if (c.change == ErrorChange::less)
        phrase = "remove" + s + " " + percent(c.removed) + " of the error";
    else if (c.removed > -1)
        phrase = "add" + s + " " + percent(-c.removed) + " to the error";
    else
        phrase = "make" + s + " the error " + number(1 - c.removed) + " times as large";
    if (c.wrongPixels > kNoticeablePixels)
        phrase += std::string(c.change == ErrorChange::more ? " at so few samples, but" : ";") + " without " +
                  std::string(plural ? "them" : "it") + " " + percent(c.wrongPixels) + " of the pixels visibly change";
    return phrase;
}

}  // namespace

std::vector<Comparison> compareLevers(const std::vector<Lever>& levers, const std::vector<Measurement>& singles,
                                      double moreSamples) {
    const auto matters = [](const Comparison& a, const Comparison& b) { return std::abs(a.usefulness) > std::abs(b.usefulness); };
    std::vector<std::vector<Comparison>> groups;
    for (size_t lever = 0; lever < levers.size(); ++lever) {
        std::vector<Comparison> group;
        for (size_t at = 1; at < singles.size(); ++at)
            if (singles[at].configuration[lever] != levers[lever].initial)
                group.push_back(compareSettings(levers, singles, at, lever, moreSamples));
        if (group.empty()) continue;
        std::stable_sort(group.begin(), group.end(), matters);
        group.front().leading = true;
        groups.push_back(std::move(group));
    }
    std::stable_sort(groups.begin(), groups.end(), [&](const auto& a, const auto& b) { return matters(a.front(), b.front()); });
    std::vector<Comparison> all;
    for (const std::vector<Comparison>& group : groups) all.insert(all.end(), group.begin(), group.end());
    return all;
}

bool standsOut(const Measurement& m, const Measurement& own) {
    const auto differ = [](double a, double b) { return std::abs(a - b) > kSameTime * b; };
    const bool sameErrors = m.relMse.lower <= own.relMse.upper && own.relMse.lower <= m.relMse.upper;
    const bool time = !covers(m.slowdown, 1) && differ(m.slowdown.median, 1);
    return time || (!sameErrors && differ(m.error.relMse, own.error.relMse));
}

std::string sentence(const Lever& lever, const Comparison& c) {
    const std::string cheap =
        lever.plural && lever.kind != LeverKind::baked ? lever.settings[c.cheap].name : lever.settings[c.cheap].words;
    const std::string subject = capitalised(lever.settings[c.accurate].words) + " instead of " + cheap;
    if (c.change == ErrorChange::none && !measurable(c.slowdown))
        return subject + (lever.plural ? " make" : " makes") +
               " no difference that could be measured, neither in time nor in the picture.";
    return subject + " " + costPhrase(c, lever.plural) + " and " + changePhrase(c, lever.plural) + ".";
}

std::string idleSentence(const Lever& lever) {
    return lever.title + ": left alone, since " + lever.idle + ".";
}

std::string verdict(const Comparison& c) {
    const bool time = measurable(c.slowdown);
    const bool slower = time && c.slowdown.median > 1;
    if (c.change == ErrorChange::none) return !time ? "either" : slower ? "spare" : "keep";
    if (c.wrongPixels > kNoticeablePixels || c.change == ErrorChange::less) return !slower || c.usefulness > 0 ? "keep" : "trade";
    return slower || !time ? "spare" : "trade";
}

std::vector<size_t> findings(const std::vector<Lever>& levers, const std::vector<Comparison>& comparisons) {
    std::vector<size_t> order;
    for (const bool known : {false, true})
        for (size_t i = 0; i < comparisons.size(); ++i) {
            const LeverKind kind = levers[comparisons[i].lever].kind;
            if (comparisons[i].leading && (kind == LeverKind::samples || kind == LeverKind::integrator) == known)
                order.push_back(i);
        }
    std::vector<size_t> chosen;
    for (const char* wanted : {"keep", "spare"}) {
        // What the scene does not do by itself it need not be told to do without.
        const auto fits = [&](size_t i) {
            const Comparison& c = comparisons[i];
            return verdict(c) == wanted && (verdict(c) != std::string("spare") || c.accurate == levers[c.lever].initial);
        };
        const auto found = std::find_if(order.begin(), order.end(), fits);
        if (found != order.end()) chosen.push_back(*found);
    }
    for (size_t i : order)
        if (chosen.size() < 2 && std::find(chosen.begin(), chosen.end(), i) == chosen.end()) chosen.push_back(i);
    return chosen;
}

}  // namespace cost
