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

double meanWithoutOutliers(std::vector<double>& values) {
    const auto kept = static_cast<ptrdiff_t>(std::ceil(static_cast<double>(values.size()) * (1 - kOutliers)));
    std::nth_element(values.begin(), values.begin() + kept - 1, values.end());
    return std::accumulate(values.begin(), values.begin() + kept, 0.0) / static_cast<double>(kept);
}

}  // namespace

Errors compare(const Picture& picture, const Picture& reference) {
    Errors errors;
    size_t wrong = 0;
    std::vector<double> ofPixels;
    ofPixels.reserve(picture.rgba.size() / 4);
    for (size_t p = 0; p < picture.rgba.size(); p += 4) {
        double sum = 0;
        for (size_t i = p; i < p + 3; ++i) {
            const double r = reference.rgba[i];
            const double d = std::abs(picture.rgba[i] - r);
            sum += d * d * weightOf(r) / 3;
            errors.largest = std::max(errors.largest, d);
        }
        ofPixels.push_back(sum);
        wrong += isWrong(&picture.rgba[p], &reference.rgba[p]) ? 1 : 0;
    }
    errors.wrongPixels = static_cast<double>(wrong) / static_cast<double>(ofPixels.size());
    errors.relMse = meanWithoutOutliers(ofPixels);
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
    std::vector<double> ofPixels;
    ofPixels.reserve(firstHalf.rgba.size() / 4);
    for (size_t p = 0; p < firstHalf.rgba.size(); p += 4) {
        double sum = 0;
        for (size_t i = p; i < p + 3; ++i) {
            const double r1 = firstHalf.rgba[i];
            const double r2 = secondHalf.rgba[i];
            sum += (r1 - r2) * (r1 - r2) / 4 * weightOf((r1 + r2) / 2) / 3;
        }
        ofPixels.push_back(sum);
    }
    return meanWithoutOutliers(ofPixels);
}

Picture meanOf(const Picture& a, const Picture& b) {
    Picture mean = a;
    for (size_t i = 0; i < mean.rgba.size(); ++i) mean.rgba[i] = (a.rgba[i] + b.rgba[i]) / 2;
    return mean;
}

}  // namespace cost
