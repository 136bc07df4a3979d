#include "error_metrics.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <numeric>

namespace cost {
namespace {

double weightOf(double reference) {
    return 1.0 / (reference * reference + kRelMseEpsilon);
}

bool isWrong(const float* x, const float* r) {
    for (int k = 0; k < 3; ++k)
        if (std::abs(srgbByte(x[k]) - srgbByte(r[k])) > kUnseenSteps) return true;
    return false;
}

/// How many of so many values are no outliers.
ptrdiff_t keptOf(size_t count) {
    return static_cast<ptrdiff_t>(std::ceil(static_cast<double>(count) * (1 - kOutliers)));
}

double meanWithoutOutliers(std::vector<float> values) {
    const ptrdiff_t kept = keptOf(values.size());
    std::nth_element(values.begin(), values.begin() + kept - 1, values.end());
    return std::accumulate(values.begin(), values.begin() + kept, 0.0) / static_cast<double>(kept);
}

float largestWithoutOutliers(std::vector<float> values) {
    const auto last = values.begin() + keptOf(values.size()) - 1;
    std::nth_element(values.begin(), last, values.end());
    return *last;
}

Estimate estimateOf(double sum, double squares, double count) {
    const double mean = sum / count;
    return {mean, std::sqrt(std::max(squares / count - mean * mean, 0.0) / count)};
}

}  // namespace

Errors compare(const Picture& picture, const Picture& reference) {
    Errors errors;
    size_t wrong = 0;
    errors.ofPixels.reserve(picture.rgba.size() / 4);
    for (size_t p = 0; p < picture.rgba.size(); p += 4) {
        double sum = 0;
        for (size_t i = p; i < p + 3; ++i) {
            const double r = reference.rgba[i];
            const double d = std::abs(picture.rgba[i] - r);
            sum += d * d * weightOf(r) / 3;
            errors.largest = std::max(errors.largest, d);
        }
        errors.ofPixels.push_back(static_cast<float>(sum));
        wrong += isWrong(&picture.rgba[p], &reference.rgba[p]) ? 1 : 0;
    }
    errors.wrongPixels = static_cast<double>(wrong) / static_cast<double>(errors.ofPixels.size());
    errors.relMse = meanWithoutOutliers(errors.ofPixels);
    return errors;
}

Estimate squaredBias(const Picture& a, const Picture& b, const Picture& firstHalf, const Picture& secondHalf,
                     const Picture& weights) {
    double sum = 0;
    double squares = 0;
    for (size_t p = 0; p < a.rgba.size(); p += 4) {
        double product = 0;
        for (size_t i = p; i < p + 3; ++i) {
            const double first = static_cast<double>(a.rgba[i]) - firstHalf.rgba[i];
            const double second = static_cast<double>(b.rgba[i]) - secondHalf.rgba[i];
            product += first * second * weightOf(weights.rgba[i]) / 3;
        }
        sum += product;
        squares += product * product;
    }
    const size_t pixels = a.rgba.size() / 4;
    return estimateOf(sum, squares, static_cast<double>(pixels));
}

Estimate pairedDifference(const Errors& a, const Errors& b) {
    const float most = std::max(largestWithoutOutliers(a.ofPixels), largestWithoutOutliers(b.ofPixels));
    double sum = 0;
    double squares = 0;
    for (size_t p = 0; p < a.ofPixels.size(); ++p) {
        const double d = static_cast<double>(std::min(a.ofPixels[p], most)) - std::min(b.ofPixels[p], most);
        sum += d;
        squares += d * d;
    }
    return estimateOf(sum, squares, static_cast<double>(a.ofPixels.size()));
}

double relMseOfMean(const Picture& firstHalf, const Picture& secondHalf) {
    std::vector<float> ofPixels;
    ofPixels.reserve(firstHalf.rgba.size() / 4);
    for (size_t p = 0; p < firstHalf.rgba.size(); p += 4) {
        double sum = 0;
        for (size_t i = p; i < p + 3; ++i) {
            const double r1 = firstHalf.rgba[i];
            const double r2 = secondHalf.rgba[i];
            sum += (r1 - r2) * (r1 - r2) / 4 * weightOf((r1 + r2) / 2) / 3;
        }
        ofPixels.push_back(static_cast<float>(sum));
    }
    return meanWithoutOutliers(ofPixels);
}

Picture meanOf(const Picture& a, const Picture& b) {
    Picture mean = a;
    for (size_t i = 0; i < mean.rgba.size(); ++i) mean.rgba[i] = (a.rgba[i] + b.rgba[i]) / 2;
    return mean;
}

}  // namespace cost
