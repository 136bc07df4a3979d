#include "pareto.hpp"

#include <algorithm>
#include <cmath>

#include "recommendation.hpp"

namespace cost {
namespace {

constexpr double kSameError = 0.02;  // share of an error, that is none

/// Whether a median is surely below another: by twice what both scatter, since of many settings that are compared with one another some differ by more than
/// their quartiles by chance.
bool surelyLess(const Spread& a, const Spread& b) {
    constexpr double kWidened = 2;
    const auto scatter = [](const Spread& s) { return std::log(s.upper / s.lower) / 2; };
    return std::log(b.median / a.median) > kWidened * std::hypot(scatter(a), scatter(b));
}

/// Over that of the scene's own settings; what is faster than these by chance, or cannot be told from them, is none.
double timeOf(const Measurement& m) {
    const bool byChance = m.slowdown.median < 1 && !surelyDiffers(m.slowdown);
    return byChance || covers(m.slowdown, 1) ? 1 : m.slowdown.median;
}

/// By its error, or by pixels that look wrong at the same samples where the errors of few samples hide them.
bool surelyMoreAccurate(const Report& report, size_t a, size_t b) {
    const Measurement& x = report.measurements[a];
    const Measurement& y = report.measurements[b];
    const bool fewerPixels = moreWrongPixels(report, y) - moreWrongPixels(report, x) > kNoticeablePixels;
    if (fewerPixels && report.errorOf(a) <= report.errorOf(b) * (1 + kSameError)) return true;
    return report.errorOf(a) < report.errorOf(b) * (1 - kSameError) && surelyLess(x.relMse, y.relMse);
}

}  // namespace

bool isLikeOwn(const Report& report, size_t measurement) {
    const Measurement& m = report.measurements[measurement];
    if (!covers(m.slowdown, 1) && std::abs(m.slowdown.median - 1) > kSameTime) return false;
    if (const Comparison* c = report.comparisonOf(measurement)) return c->change == ErrorChange::none;
    return !surelyMoreAccurate(report, measurement, 0) && !surelyMoreAccurate(report, 0, measurement);
}

std::vector<size_t> surelyOnFront(const Report& report) {
    std::vector<size_t> order = {0};
    for (size_t i = 1; i < report.measurements.size(); ++i)
        if (!isLikeOwn(report, i)) order.push_back(i);
    std::stable_sort(order.begin(), order.end(), [&](size_t a, size_t b) {
        const double timeA = timeOf(report.measurements[a]);
        const double timeB = timeOf(report.measurements[b]);
        return timeA != timeB ? timeA < timeB : report.errorOf(a) < report.errorOf(b);
    });
    std::vector<size_t> front;
    for (size_t i : order) {
        if (!front.empty() && !surelyMoreAccurate(report, i, front.back())) continue;
        const double time = timeOf(report.measurements[i]);
        while (!front.empty() && timeOf(report.measurements[front.back()]) * (1 + kSameTime) >= time) front.pop_back();
        front.push_back(i);
    }
    return front;
}

}  // namespace cost
