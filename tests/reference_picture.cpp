#include "reference_picture.hpp"

#include <doctest/doctest.h>
#include <tinyexr.h>

#include <cmath>
#include <cstdlib>
#include <memory>
#include <stdexcept>

#include "statistics.hpp"

using glm::dvec3;

namespace test {
namespace {

/// Linear sRGB to XYZ, by rows.
const glm::dmat3 kToXyz = glm::transpose(glm::dmat3{{0.412453, 0.357580, 0.180423},  //
                                                    {0.212671, 0.715160, 0.072169},
                                                    {0.019334, 0.119193, 0.950227}});

XyzPicture toXyz(const float* rgba, uint32_t width, uint32_t height) {
    XyzPicture picture{width, height, {}};
    picture.pixels.reserve(size_t{width} * height);
    for (size_t i = 0; i < size_t{width} * height; ++i)
        picture.pixels.push_back(kToXyz * dvec3(rgba[4 * i], rgba[4 * i + 1], rgba[4 * i + 2]));
    return picture;
}

/// Squares of `side` pixels become one, with their mean.
XyzPicture shrink(const XyzPicture& fine, uint32_t side) {
    XyzPicture picture{fine.width / side, fine.height / side, {}};
    picture.pixels.resize(size_t{picture.width} * picture.height);
    for (size_t i = 0; i < fine.pixels.size(); ++i) {
        const size_t x = i % fine.width / side, y = i / fine.width / side;
        picture.pixels[y * picture.width + x] += fine.pixels[i] / static_cast<double>(side * side);
    }
    return picture;
}

struct MeanTest {
    double z;
    double p;
};

/// `difference` of two means, with the variance of each and its degrees of freedom.
MeanTest testMeans(double difference, double theirs, double theirDof, double ours, double ourDof) {
    const double variance = theirs + ours;
    const double z = difference / std::sqrt(variance);
    const double dof = variance * variance / (theirs * theirs / theirDof + ours * ours / ourDof + 1e-300);
    return {z, studentTail(z, std::min(dof, 1e6))};
}

}  // namespace

/// Ours against theirs in a pixel and a channel.
MeanTest testPixel(const Reference& reference, const Passes& ours, size_t pixel, int channel) {
    const double single = reference.variance.pixels[pixel][channel], theirs = reference.mean.pixels[pixel][channel];
    const auto [mean, spread] = ours.moments(pixel);
    // Where our few samples missed what is rare, they look as if they knew better: they vary at least as Mitsuba's do.
    const double least = single / ours.samples(), dof = reference.samples - 1;
    const bool rare = spread[channel] < least;
    return testMeans(mean[channel] - theirs, single / reference.samples, dof, rare ? least : spread[channel],
                     rare ? dof : static_cast<double>(ours.pictures.size()) - 1);
}

XyzPicture readXyz(const std::filesystem::path& path) {
    float* rgba = nullptr;
    int width = 0, height = 0;
    const char* message = nullptr;
    if (LoadEXR(&rgba, &width, &height, path.string().c_str(), &message) != TINYEXR_SUCCESS)
        throw std::runtime_error(path.string() + ": " + (message ? message : "cannot be read"));
    const std::unique_ptr<float, decltype(&std::free)> owner(rgba, &std::free);
    return toXyz(rgba, static_cast<uint32_t>(width), static_cast<uint32_t>(height));
}

Reference readReference(const std::filesystem::path& folder, const std::string& name) {
    Reference reference{readXyz(folder / (name + ".exr")), readXyz(folder / (name + "_var.exr"))};
    // Mean of squares less square of the mean, summed up in float: below this it is rounding. The same limit as in Mitsuba's own test.
    for (dvec3& v : reference.variance.pixels) v = glm::max(v, dvec3(1e-4));
    return reference;
}

std::pair<dvec3, dvec3> Passes::moments(size_t pixel) const {
    const auto n = static_cast<double>(pictures.size());
    dvec3 mean(0), squares(0);
    for (const XyzPicture& picture : pictures) mean += picture.pixels[pixel] / n;
    for (const XyzPicture& picture : pictures) squares += (picture.pixels[pixel] - mean) * (picture.pixels[pixel] - mean);
    return {mean, squares / (n * (n - 1))};
}

void Passes::replace(const Passes& other, const Selection& selected) {
    for (size_t i = 0; i < pictures.size(); ++i) {
        XyzPicture& picture = pictures[i];
        for (size_t at = 0; at < picture.pixels.size(); ++at)
            if (selected(static_cast<uint32_t>(at % picture.width), static_cast<uint32_t>(at / picture.width)))
                picture.pixels[at] = other.pictures[i].pixels[at];
    }
}

Passes renderPasses(const LoadedScene& scene, uint32_t count, uint32_t samplesEach) {
    constexpr uint32_t kSplit = 4;
    minirt_scene_desc defaults;
    minirt_get_scene_desc(scene.get(), &defaults);
    Passes passes{{}, samplesEach};
    for (uint32_t i = 0; i < count; ++i) {
        minirt_render_desc desc = {};
        desc.width = kSplit * defaults.width, desc.height = kSplit * defaults.height;
        desc.samples = samplesEach / (kSplit * kSplit);
        desc.seed = i + 1;
        const Picture picture = scene.render(desc);
        passes.pictures.push_back(shrink(toXyz(picture.rgba.data(), picture.width, picture.height), kSplit));
    }
    return passes;
}

Agreement compare(const Reference& reference, const Passes& ours, const Selection& selected) {
    const XyzPicture& theirs = reference.mean;
    const auto n = static_cast<double>(ours.pictures.size());
    Agreement agreement;
    std::vector<double> ps;
    std::vector<dvec3> ourMeans(ours.pictures.size(), dvec3(0));
    dvec3 theirMean(0), theirVariance(0);
    double squares = 0;
    for (size_t i = 0; i < theirs.pixels.size(); ++i) {
        if (!selected(static_cast<uint32_t>(i % theirs.width), static_cast<uint32_t>(i / theirs.width))) continue;
        agreement.pixels++;
        for (int k = 0; k < 3; ++k) {
            const MeanTest test = testPixel(reference, ours, i, k);
            ps.push_back(test.p);
            squares += test.z * test.z;
        }
        for (size_t j = 0; j < ourMeans.size(); ++j) ourMeans[j] += ours.pictures[j].pixels[i];
        theirMean += theirs.pixels[i];
        theirVariance += reference.variance.pixels[i] / reference.samples;
    }
    const double level = sidakLevel(static_cast<int>(ps.size()));
    for (const double p : ps) {
        agreement.rejected += p < level ? 1 : 0;
        agreement.leastP = std::min(agreement.leastP, p);
    }
    agreement.rmsZ = std::sqrt(squares / static_cast<double>(ps.size()));
    dvec3 mean(0), spread(0);
    for (const dvec3& m : ourMeans) mean += m / n;
    for (const dvec3& m : ourMeans) spread += (m - mean) * (m - mean) / (n * (n - 1));
    agreement.meanRatio = mean / theirMean;
    for (int k = 0; k < 3; ++k)
        agreement.meanP[k] = testMeans(mean[k] - theirMean[k], theirVariance[k], reference.samples - 1, spread[k], n - 1).p;
    return agreement;
}

Agreement tellAgreement(const std::string& what, const Reference& reference, const Passes& ours, const Selection& selected) {
    const Agreement a = compare(reference, ours, selected);
    MESSAGE(what, ": ", a.pixels, " pixels, ", a.rejected, " of their tests reject, least p ", a.leastP, ", rms z ", a.rmsZ,
            ", means over theirs ", a.meanRatio.x, " ", a.meanRatio.y, " ", a.meanRatio.z, " with p ", a.meanP.x, " ", a.meanP.y,
            " ", a.meanP.z);
    return a;
}

void checkAgreement(const std::string& what, const Reference& reference, const Passes& ours, const Selection& selected) {
    const Agreement a = tellAgreement(what, reference, ours, selected);
    CHECK(a.pixels > 0);
    CHECK(a.rejected == 0);
    for (int k = 0; k < 3; ++k) CHECK(a.meanP[k] > sidakLevel(3));
}

void checkBetween(const std::string& what, const Reference& reference, const Passes& lower, const Passes& upper) {
    const size_t pixels = reference.mean.pixels.size();
    const double level = sidakLevel(static_cast<int>(6 * pixels));
    size_t below = 0, above = 0;
    dvec3 low(0), middle(0), high(0);
    for (size_t i = 0; i < pixels; ++i) {
        for (int k = 0; k < 3; ++k) {
            const MeanTest lowest = testPixel(reference, lower, i, k), highest = testPixel(reference, upper, i, k);
            below += lowest.z > 0 && lowest.p / 2 < level ? 1 : 0;
            above += highest.z < 0 && highest.p / 2 < level ? 1 : 0;
        }
        low += lower.moments(i).first, middle += reference.mean.pixels[i], high += upper.moments(i).first;
    }
    MESSAGE(what, ": ", below, " tests find the reference below, ", above,
            " above; mean over that of the reference: ", low.y / middle.y, " and ", high.y / middle.y);
    CHECK(below == 0);
    CHECK(above == 0);
}

}  // namespace test
