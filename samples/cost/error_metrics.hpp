// How wrong a picture is.
#pragma once
#include "../common/picture_file.hpp"

namespace cost {

/// Keeps relMSE finite where the reference is black.
constexpr double kRelMseEpsilon = 0.01;

/// Share of the pixels, those with the largest error, that relMSE leaves out: else a single spark can decide it. Errors::largest keeps them.
constexpr double kOutliers = 0.001;

/// A pixel is wrong if a channel of its 8-bit sRGB value is off by more than this.
constexpr int kUnseenSteps = 2;

struct Errors {
    double relMse = 0;            // mean over pixels and channels of (x - r)^2 / (r^2 + kRelMseEpsilon), without kOutliers
    double largest = 0;           // of |x - r| over all channels, linear radiance
    double wrongPixels = 0;       // share of all
    std::vector<float> ofPixels;  // what each adds to the mean of relMSE
};

/// Both of one size.
Errors compare(const Picture& picture, const Picture& reference);

struct Estimate {
    double value = 0;
    double standardError = 0;

    bool isSignificant() const { return value > 3 * standardError; }
};

/// The part of relMSE that more samples do not remove. `a` and `b` have independent noise of one mean, and so have the two halves of what they are held
/// against: the mean of (a - r1)(b - r2) / (weights^2 + epsilon) holds the squares of the bias and no variance.
Estimate squaredBias(const Picture& a, const Picture& b, const Picture& firstHalf, const Picture& secondHalf,
                     const Picture& weights);

/// By how much `a` is more wrong than `b`, pixel by pixel: the mean and its standard error. What is beyond the outliers of both counts as where these begin.
Estimate pairedDifference(const Errors& a, const Errors& b);

/// relMSE of the mean of two independent halves, from how much they differ, without kOutliers.
double relMseOfMean(const Picture& firstHalf, const Picture& secondHalf);

/// Of two pictures of one size, pixel by pixel.
Picture meanOf(const Picture& a, const Picture& b);

}  // namespace cost
