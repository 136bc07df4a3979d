// A picture of another renderer with the variance of its samples, and whether ours is of the same scene.
//
// Mitsuba's references (its `moment` integrator) hold mean and variance of the samples of each pixel in CIE XYZ, stored as if both were
// linear sRGB: the variance picture has negative parts, and only back in XYZ is it a variance. So all is tested in XYZ.
#pragma once
#include <filesystem>
#include <functional>
#include <glm/glm.hpp>
#include <vector>

#include "render_scene.hpp"

namespace test {

/// A picture in XYZ, top row first.
struct XyzPicture {
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<glm::dvec3> pixels;
};

/// An EXR file of linear sRGB.
XyzPicture readXyz(const std::filesystem::path& path);

struct Reference {
    XyzPicture mean;
    XyzPicture variance;  // of a sample
    double samples = 32000;
};

/// `name`.exr and `name`_var.exr.
Reference readReference(const std::filesystem::path& folder, const std::string& name);

/// Which pixels are meant.
using Selection = std::function<bool(uint32_t x, uint32_t y)>;

/// Independent pictures of one scene.
struct Passes {
    std::vector<XyzPicture> pictures;
    uint32_t samplesEach = 0;

    double samples() const { return static_cast<double>(pictures.size()) * samplesEach; }
    /// Of a pixel: the mean of the pictures, and the variance of that mean.
    std::pair<glm::dvec3, glm::dvec3> moments(size_t pixel) const;
    /// Takes the selected pixels from passes of as many pictures.
    void replace(const Passes& other, const Selection& selected);
};

/// By the box filter, `samplesEach` a pixel, a multiple of 16: every pixel is a square of 4 x 4 of a larger picture, since devices like these
/// do large pictures of few samples sooner than small ones of many.
Passes renderPasses(const LoadedScene& scene, uint32_t count, uint32_t samplesEach);

struct Agreement {
    size_t pixels = 0;
    size_t rejected = 0;      // tests of a pixel's X, Y or Z whose p-value is under the level
    double leastP = 1;        // of all these tests
    double rmsZ = 0;          // of their statistics; 1 for the same picture
    glm::dvec3 meanRatio{1};  // of the means over all pixels, ours over theirs
    glm::dvec3 meanP{1};
};

/// Tests each pixel's X, Y and Z for equal means, at a level that rejects equal pictures once in a hundred (Sidak), and the means over all pixels.
Agreement compare(const Reference& reference, const Passes& ours, const Selection& selected);

/// Says what `compare` gives.
Agreement tellAgreement(const std::string& what, const Reference& reference, const Passes& ours, const Selection& selected);

/// The same, and fails the running case unless all tests accept.
void checkAgreement(const std::string& what, const Reference& reference, const Passes& ours, const Selection& selected);

/// Fails the running case where a pixel of the reference is darker than `lower` or brighter than `upper`, by the same level.
void checkBetween(const std::string& what, const Reference& reference, const Passes& lower, const Passes& upper);

}  // namespace test
