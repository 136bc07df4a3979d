#include "error_metrics.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace cost {
namespace {

bool isAlpha(size_t i) {
    return i % 4 == 3;
}

double weightOf(double reference) {
    return 1.0 / (reference * reference + kRelMseEpsilon);
}

bool isWrong(const float* x, const float* r) {
    for (int k = 0; k < 3; ++k)
        if (std::abs(srgbByte(x[k]) - srgbByte(r[k])) > kUnseenSteps) return true;
    return false;
}

}  // namespace

Errors compare(const Picture& picture, const Picture& reference) {
    Errors errors;
    size_t wrong = 0;
    const size_t pixels = picture.rgba.size() / 4;
    for (size_t i = 0; i < picture.rgba.size(); ++i) {
        if (isAlpha(i)) {
            wrong += isWrong(&picture.rgba[i - 3], &reference.rgba[i - 3]) ? 1 : 0;
            continue;
        }
        const double r = reference.rgba[i];
        const double d = std::abs(picture.rgba[i] - r);
        errors.relMse += d * d * weightOf(r);
        errors.largest = std::max(errors.largest, d);
    }
    errors.relMse /= 3.0 * static_cast<double>(pixels);
    errors.wrongPixels = static_cast<double>(wrong) / static_cast<double>(pixels);
    return errors;
}

Estimate squaredBias(const Picture& a, const Picture& b, const Picture& firstHalf, const Picture& secondHalf) {
    double sum = 0;
    double squares = 0;
    const auto pixels = static_cast<double>(a.rgba.size() / 4);
    for (size_t p = 0; p < a.rgba.size(); p += 4) {
        double product = 0;
        for (size_t i = p; i < p + 3; ++i) {
            const double r1 = firstHalf.rgba[i];
            const double r2 = secondHalf.rgba[i];
            product += (a.rgba[i] - r1) * (b.rgba[i] - r2) * weightOf((r1 + r2) / 2) / 3;
        }
        sum += product;
        squares += product * product;
    }
    const double mean = sum / pixels;
    return {mean, std::sqrt(std::max(squares / pixels - mean * mean, 0.0) / pixels)};
}

double relMseOfMean(const Picture& firstHalf, const Picture& secondHalf) {
    double sum = 0;
    for (size_t i = 0; i < firstHalf.rgba.size(); ++i) {
        if (isAlpha(i)) continue;
        const double r1 = firstHalf.rgba[i];
        const double r2 = secondHalf.rgba[i];
        sum += (r1 - r2) * (r1 - r2) / 4 * weightOf((r1 + r2) / 2);
    }
    return sum / (3.0 * static_cast<double>(firstHalf.rgba.size() / 4));
}

Picture meanOf(const Picture& a, const Picture& b) {
    Picture mean = a;
    for (size_t i = 0; i < mean.rgba.size(); ++i) mean.rgba[i] = (a.rgba[i] + b.rgba[i]) / 2;
    return mean;
}

}  // namespace cost
