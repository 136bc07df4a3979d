// Nested volumes against the same scene in split interfaces: faces that do not overlap and say themselves which media they part. An own
// tracer in double follows those; it knows no list of volumes.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <vector>

#include "scene_text.hpp"
#include "split_oracle.hpp"

using glm::dvec3;
using namespace test;

namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr int kSides = 24;

// A tumbler with whisky up to kLevel and a cube of ice that floats in it.
constexpr double kInner = 0.9, kFloor = -0.75, kLevel = 0.4, kIceHalf = 0.3, kIceLow = 0.1, kIceHigh = 0.6;

enum Medium { kAir, kGlass, kWhisky, kIce };
constexpr double kIor[] = {1, 1.5, 1.36, 1.31};
const dvec3 kSigma[] = {dvec3(0), dvec3(0.2, 0.05, 0.1), dvec3(0.2, 0.7, 1.8), dvec3(0.1, 0.05, 0)};

using Face = SplitFace;

dvec3 onRing(double radius, double y, int side) {
    const double angle = 2 * kPi * (side % kSides) / kSides;
    return {radius * std::cos(angle), y, -radius * std::sin(angle)};
}

/// The band between two rings; its front is to the right of the way from (r0, y0) to (r1, y1), seen with y upwards and r to the right.
void addBand(std::vector<Face>& faces, double r0, double y0, double r1, double y1, Medium front, Medium back) {
    for (int i = 0; i < kSides; ++i) {
        const dvec3 p00 = onRing(r0, y0, i), p01 = onRing(r0, y0, i + 1), p10 = onRing(r1, y1, i), p11 = onRing(r1, y1, i + 1);
        if (r0 > 0) faces.push_back({p00, p01, p11, front, back});
        if (r1 > 0) faces.push_back({p00, p11, p10, front, back});
        if (r0 == 0) faces.back() = {p00, p11, p10, front, back};
    }
}

std::vector<Face> tumbler(bool split) {
    std::vector<Face> faces;
    addBand(faces, 0, -1, 1, -1, kAir, kGlass);
    addBand(faces, 1, -1, 1, 1, kAir, kGlass);
    addBand(faces, 1, 1, kInner, 1, kAir, kGlass);
    if (split) addBand(faces, kInner, 1, kInner, kLevel, kAir, kGlass);
    addBand(faces, kInner, split ? kLevel : 1, kInner, kFloor, split ? kWhisky : kAir, kGlass);
    addBand(faces, kInner, kFloor, 0, kFloor, split ? kWhisky : kAir, kGlass);
    return faces;
}

/// The whisky as a volume of its own, lapping into the glass by `lap`.
std::vector<Face> filling(double lap) {
    std::vector<Face> faces;
    addBand(faces, 0, kFloor - lap, kInner + lap, kFloor - lap, kAir, kWhisky);
    addBand(faces, kInner + lap, kFloor - lap, kInner + lap, kLevel, kAir, kWhisky);
    addBand(faces, kInner + lap, kLevel, 0, kLevel, kAir, kWhisky);
    return faces;
}

void addQuad(std::vector<Face>& faces, const std::array<dvec3, 4>& p, Medium front, Medium back) {
    faces.push_back({p[0], p[1], p[2], front, back});
    faces.push_back({p[0], p[2], p[3], front, back});
}

/// The sides of the ice from y0 to y1.
void addIceSides(std::vector<Face>& faces, double y0, double y1, Medium front) {
    const dvec3 corners[] = {
        {-kIceHalf, 0, kIceHalf}, {kIceHalf, 0, kIceHalf}, {kIceHalf, 0, -kIceHalf}, {-kIceHalf, 0, -kIceHalf}};
    for (int i = 0; i < 4; ++i) {
        const dvec3 a = corners[i], b = corners[(i + 1) % 4], low(0, y0, 0), high(0, y1, 0);
        addQuad(faces, {a + low, b + low, b + high, a + high}, front, kIce);
    }
}

void addIceLids(std::vector<Face>& faces, Medium below) {
    const double h = kIceHalf;
    addQuad(faces, {dvec3(-h, kIceLow, -h), dvec3(h, kIceLow, -h), dvec3(h, kIceLow, h), dvec3(-h, kIceLow, h)}, below, kIce);
    addQuad(faces, {dvec3(-h, kIceHigh, h), dvec3(h, kIceHigh, h), dvec3(h, kIceHigh, -h), dvec3(-h, kIceHigh, -h)}, kAir, kIce);
}

std::vector<Face> splitScene(bool withIce) {
    std::vector<Face> faces = tumbler(true);
    addBand(faces, kInner, kLevel, 0, kLevel, kAir, kWhisky);  // within the ice it parts nothing: see `sidesWithIce`
    if (!withIce) return faces;
    addIceSides(faces, kIceLow, kLevel, kWhisky);
    addIceSides(faces, kLevel, kIceHigh, kAir);
    addIceLids(faces, kWhisky);
    return faces;
}

std::string objOf(const std::vector<Face>& faces) {
    std::string obj;
    for (const Face& face : faces)
        for (const dvec3& p : {face.a, face.b, face.c}) obj += "v " + json(p.x) + " " + json(p.y) + " " + json(p.z) + "\n";
    for (size_t i = 0; i < faces.size(); ++i)
        obj += "f " + std::to_string(3 * i + 1) + " " + std::to_string(3 * i + 2) + " " + std::to_string(3 * i + 3) + "\n";
    return obj;
}

std::string fill(Medium medium) {
    return R"({"model":"pbr","roughness":0,"transmission":1,"ior":)" + json(kIor[medium]) + R"(,"attenuationColor":)" +
           json(glm::exp(-kSigma[medium])) + "}";
}

const View kView{{0.3, 1.6, 3.4}, {0, -0.05, 0}, 38, 40, {0, 1, 0}, 12};

/// `nesting`: "ordered" or "parity". `priority`: of the whisky over glass and ice.
std::vector<dvec3> nestedPicture(const GpuContext& gpu, double lap, const std::string& nesting, int priority, bool withIce) {
    const TemporaryDir dir;
    dir.write("glass.obj", objOf(tumbler(false)));
    dir.write("whisky.obj", objOf(filling(lap)));
    std::vector<Face> cube;
    addIceSides(cube, kIceLow, kIceHigh, kAir);
    addIceLids(cube, kAir);
    dir.write("ice.obj", objOf(cube));
    const Picture picture =
        renderScene(gpu, dir,
                    "{" + kView.text() + R"(,"nesting":")" + nesting + R"(","background":{"color":[0.25,0.25,0.25]},"lights":[)" +
                        pointLight({0, 0, -4}, {40, 40, 40}, "inverse-square") + R"(],"materials":{"glass":)" + fill(kGlass) +
                        R"(,"whisky":)" + fill(kWhisky) + R"(,"ice":)" + fill(kIce) +
                        R"(,"wall":{"model":"phong","diffuse":0.5}},"objects":[{"mesh":"glass.obj","material":"glass"},)" +
                        R"({"mesh":"whisky.obj","material":"whisky","priority":)" + std::to_string(priority) + "}," +
                        (withIce ? R"({"mesh":"ice.obj","material":"ice","priority":)" + std::to_string(priority) + "}," : "") +
                        rectangle({-30, -30, -6}, {60, 0, 0}, {0, 60, 0}, "wall") + "]}");
    std::vector<dvec3> pixels;
    for (uint32_t i = 0; i < kView.size * kView.size; ++i) pixels.emplace_back(picture.at(i % kView.size, i / kView.size));
    return pixels;
}

/// The surface of the whisky parts nothing where the ice is.
Sides sidesWithIce(const Face& face, const dvec3& p) {
    const bool inIce = face.front == kAir && face.back == kWhisky && std::abs(p.x) < kIceHalf && std::abs(p.z) < kIceHalf;
    return inIce ? Sides{kIce, kIce} : Sides{face.front, face.back};
}

std::vector<dvec3> splitPicture(bool withIce) {
    std::vector<SplitMedium> media;
    for (int i = 0; i < 4; ++i) media.push_back({kIor[i], kSigma[i]});
    SplitScene scene(splitScene(withIce), media, litWall,
                     withIce ? sidesWithIce : std::function<Sides(const Face&, const dvec3&)>());
    std::vector<dvec3> pixels;
    for (uint32_t y = 0; y < kView.size; ++y)
        for (uint32_t x = 0; x < kView.size; ++x)
            pixels.push_back(scene.radiance(kView.position, kView.direction(x, y), static_cast<int>(kView.maxDepth)));
    CHECK(scene.misfits() <= 2);  // rays within rounding of an edge
    return pixels;
}

double meanDifference(const std::vector<dvec3>& a, const std::vector<dvec3>& b) {
    double sum = 0;
    for (size_t i = 0; i < a.size(); ++i)
        sum += std::abs(a[i].x - b[i].x) + std::abs(a[i].y - b[i].y) + std::abs(a[i].z - b[i].z);
    return sum / (3.0 * static_cast<double>(a.size()));
}

}  // namespace

TEST_CASE(
    "a glass of whisky with ice equals its split interfaces, at once or linearly with how far the whisky laps into the glass") {
    GpuContext gpu;
    if (!gpu) return;
    const std::vector<dvec3> split = splitPicture(true), withoutIce = splitPicture(false);
    constexpr double kLaps[] = {0.08, 0.04, 0.02, 0.01};
    double above[4], parity[4];
    for (int i = 0; i < 4; ++i) {
        // Ordered by size, the glass displaces the whisky: its wall is the interface whatever the lap. Where the whisky displaces the glass,
        // and for the stack, which keeps the first of two surfaces, the interface is off by the lap.
        const double ordered = meanDifference(nestedPicture(gpu, kLaps[i], "ordered", 0, true), split);
        above[i] = meanDifference(nestedPicture(gpu, kLaps[i], "ordered", 1, true), split);
        parity[i] = meanDifference(nestedPicture(gpu, kLaps[i], "parity", 0, false), withoutIce);
        MESSAGE("lap ", kLaps[i], ": mean difference ordered ", ordered, ", with the whisky above ", above[i],
                ", parity without ice ", parity[i]);
        CHECK(ordered < 1e-5);
    }
    for (const double* difference : {above, parity}) {
        for (int i = 1; i < 4; ++i) CHECK(difference[i] < 0.75 * difference[i - 1]);
        CHECK(difference[0] / difference[3] > 4.5);
        CHECK(difference[0] / difference[3] < 12);
    }
    // Ice that floats is a deep overlap: the stack shows whisky where the ice is, seen from above, however thin the lap.
    const double floating = meanDifference(nestedPicture(gpu, 0.01, "parity", 0, true), split);
    MESSAGE("parity with floating ice, lap 0.01: ", floating);
    CHECK(floating > 1.5 * parity[3]);
}
