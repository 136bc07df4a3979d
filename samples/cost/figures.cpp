#include "figures.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace cost {
namespace {

std::string fixed(double value, int decimals) {
    char text[48];
    std::snprintf(text, sizeof text, "%.*f", decimals, value);
    return text;
}

std::string significant(double value, int digits) {
    char text[48];
    std::snprintf(text, sizeof text, "%.*g", digits, value);
    return text;
}

}  // namespace

std::string percent(double share) {
    const double value = share * 100;
    const double size = std::abs(value);
    if (size > 0 && size < 0.01) return "under 0.01 %";
    if (size > 99.99 && size < 100) return "over 99.99 %";
    if (size > 99 && size < 100) return significant(value, size > 99.9 ? 4 : 3) + " %";
    return (size < 9.95 ? significant(value, 2) : fixed(value, 0)) + " %";
}

std::string number(double value) {
    if (value == 0) return "0";
    const int magnitude = static_cast<int>(std::floor(std::log10(std::abs(value))));
    return magnitude < -6 ? significant(value, 2) : fixed(value, std::max(2 - magnitude, 0));
}

std::string errorFigure(double error, double floor) {
    return error > floor || floor <= 0 ? number(error) : "≤ " + number(floor);
}

std::string errorChange(double from, double to, double floor) {
    const std::string now = errorFigure(from, floor);
    const std::string then = errorFigure(to, floor);
    if (now == then) return "the error stays at " + now;
    return std::string("the error ") + (to > from ? "rises" : "falls") + " from " + now + " to " + then;
}

std::string relativeTime(double ratio) {
    if (ratio >= 2) return number(ratio) + " ×";
    return (ratio < 1 ? "−" : "+") + percent(std::abs(ratio - 1));
}

std::string timeRange(const Spread& ratio) {
    const bool asFactor = ratio.median >= 2;
    const auto written = [&](double value) { return asFactor ? number(value) : percent(std::abs(value - 1)); };
    std::string from = written(ratio.median < 1 ? ratio.upper : ratio.lower);
    const std::string to = written(ratio.median < 1 ? ratio.lower : ratio.upper);
    if (from == to) return "";
    const std::string unit = " %";
    if (!asFactor) from.erase(from.size() - unit.size());
    return " (" + from + " to " + to + ")";
}

std::string timeDifference(const Spread& ratio) {
    const std::string difference = ratio.median >= 2
                                       ? number(ratio.median) + " times the time"
                                       : percent(std::abs(ratio.median - 1)) + (ratio.median < 1 ? " less" : " more") + " time";
    return difference + timeRange(ratio);
}

size_t letterCount(const std::string& text) {
    const auto begins = [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; };
    return static_cast<size_t>(std::count_if(text.begin(), text.end(), begins));
}

}  // namespace cost
