// Pictures of the Whitted tracer against closed forms: from JSON through minirtc to floats.
#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <optional>

#include "oracle.hpp"
#include "render_scene.hpp"
#include "scene_text.hpp"

using glm::dvec3;
using namespace test;

namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kCutoff = 1.0 / 512;  // rays of less throughput end

std::optional<dvec3> meetFloor(const dvec3& origin, const dvec3& direction) {
    const double t = -origin.y / direction.y;
    if (!(t > 0)) return std::nullopt;
    return origin + t * direction;
}

const char* kPlaster = R"({"model":"phong","diffuse":0.8,"color":[0.9,0.5,0.2]})";
const dvec3 kPlasterWeight = dvec3(0.8) * dvec3(0.9, 0.5, 0.2);

}  // namespace

TEST_CASE("a point light over a plane with and without falloff") {
    GpuContext gpu;
    if (!gpu) return;
    const View view{{0, 3, 5}, {0, 0, 0}};
    const dvec3 light(1, 2, -1), intensity(10, 20, 30);
    for (const bool inverseSquare : {true, false}) {
        const Picture picture = renderScene(
            gpu, "{" + view.text() + R"(,"lights":[)" + pointLight(light, intensity, inverseSquare ? "inverse-square" : "none") +
                     R"(],"materials":{"m":)" + kPlaster + R"(},"objects":[)" + floorOf("m") + "]}");
        checkPixels(picture, 1e-5, [&](uint32_t x, uint32_t y) -> std::optional<dvec3> {
            const std::optional<dvec3> p = meetFloor(view.position, view.direction(x, y));
            if (!p) return std::nullopt;
            const dvec3 away = light - *p;
            const double d2 = glm::dot(away, away);
            return kPlasterWeight * intensity * (away.y / std::sqrt(d2)) / (inverseSquare ? d2 : 1.0);
        });
        CHECK(picture.stats.primary_rays == 48 * 48);
        CHECK(picture.stats.shadow_rays == 48 * 48);
        CHECK(picture.stats.secondary_rays == 0);
    }
}

TEST_CASE("a directional light over a plane and a background beside it") {
    GpuContext gpu;
    if (!gpu) return;
    const View view{{0, 1, 30}, {0, 1.5, 0}, 60};
    const dvec3 direction(1, -2, 0.5), irradiance(3, 2, 1), background(0.25, 0.5, 0.75);
    const Picture picture = renderScene(gpu, "{" + view.text() + R"(,"background":{"color":)" + json(background / 2.0) +
                                                 R"(,"strength":2},"lights":[)" + R"({"type":"directional","direction":)" +
                                                 json(direction) + R"(,"irradiance":)" + json(irradiance) +
                                                 R"(}],"materials":{"m":)" + kPlaster + R"(},"objects":[)" + floorOf("m") + "]}");
    checkPixels(picture, 1e-6, [&](uint32_t x, uint32_t y) -> std::optional<dvec3> {
        const std::optional<dvec3> p = meetFloor(view.position, view.direction(x, y));
        if (!p || std::abs(p->x) > 20.001 || std::abs(p->z) > 20.001) return background;
        if (std::abs(p->x) > 19.999 || std::abs(p->z) > 19.999) return std::nullopt;
        return kPlasterWeight * irradiance * (-direction.y / glm::length(direction));
    });
}

TEST_CASE("a ball throws a shadow on the floor") {
    GpuContext gpu;
    if (!gpu) return;
    const View view{{0, 6, 6}, {0, 0, 0}};
    const dvec3 light(0.5, 8, 0.25), center(0, 2, 0);
    const Picture picture =
        renderScene(gpu, "{" + view.text() + R"(,"lights":[)" + pointLight(light, {1, 1, 1}, "none") + R"(],"materials":{"m":)" +
                             kPlaster + R"(},"objects":[)" + floorOf("m") + "," + sphere(center, 0.75, "m") + "]}");
    size_t shadowed = 0;
    const auto passes = [](const dvec3& origin, const dvec3& d, const dvec3& c) {
        return glm::length(glm::cross(c - origin, d));
    };
    checkPixels(picture, 1e-5, [&](uint32_t x, uint32_t y) -> std::optional<dvec3> {
        const dvec3 d = view.direction(x, y), p = *meetFloor(view.position, d), toLight = glm::normalize(light - p);
        if (passes(view.position, d, center) < 0.7501) return std::nullopt;  // the ball itself
        const double distance = passes(p, toLight, center);
        if (std::abs(distance - 0.75) < 1e-4) return std::nullopt;
        shadowed += distance < 0.75;
        return distance < 0.75 ? dvec3(0) : kPlasterWeight * toLight.y;
    });
    CHECK(shadowed > 30);
}

TEST_CASE("the highlight is that of Phong") {
    GpuContext gpu;
    if (!gpu) return;
    const View view{{0, 3, 3}, {0, 0, -1}};
    const dvec3 light(0, 3, -5);
    const double shininess = 40;
    const Picture picture = renderScene(
        gpu, "{" + view.text() + R"(,"lights":[)" + pointLight(light, {2, 4, 8}, "none") +
                 R"(],"materials":{"m":{"model":"phong","diffuse":0.25,"specular":0.5,"color":[1,0.5,0.25],"shininess":)" +
                 json(shininess) + R"(}},"objects":[)" + floorOf("m") + "]}");
    double brightest = 0;
    checkPixels(picture, 3e-5, [&](uint32_t x, uint32_t y) {
        const dvec3 d = view.direction(x, y), p = *meetFloor(view.position, d), wi = glm::normalize(light - p);
        const dvec3 mirrored(-wi.x, wi.y, -wi.z);
        const double lobe = std::pow(std::max(glm::dot(mirrored, -d), 0.0), shininess);
        brightest = std::max(brightest, lobe);
        return dvec3(1, 0.5, 0.25) * dvec3(2, 4, 8) * (0.25 * wi.y + 0.5 * lobe);
    });
    CHECK(brightest > 0.99);
}

TEST_CASE("the floor in a mirror has the value of the closed form") {
    GpuContext gpu;
    if (!gpu) return;
    // The mirror stands at z = -4 and shows the floor before it, lit from above.
    const View view{{0, 2, 4}, {0, 1.5, -4}, 10};
    const dvec3 light(1, 3, 2), intensity(10, 20, 30);
    const Picture picture =
        renderScene(gpu, "{" + view.text() + R"(,"lights":[)" + pointLight(light, intensity, "none") + R"(],"materials":{"m":)" +
                             kPlaster + R"(,"mirror":{"model":"phong","diffuse":0,"reflect":0.75}},"objects":[)" + floorOf("m") +
                             "," + rectangle({-10, 0, -4}, {20, 0, 0}, {0, 20, 0}, "mirror") + "]}");
    checkPixels(picture, 1e-5, [&](uint32_t x, uint32_t y) -> std::optional<dvec3> {
        const dvec3 d = view.direction(x, y), atMirror = view.position + d * ((-4 - view.position.z) / d.z);
        if (atMirror.y < 1e-3) return std::nullopt;  // floor seen directly
        const std::optional<dvec3> p = meetFloor(atMirror, {d.x, d.y, -d.z});
        if (!p || p->z > 19.9) return p ? std::nullopt : std::optional<dvec3>(dvec3(0));
        return 0.75 * kPlasterWeight * intensity * glm::normalize(light - *p).y;
    });
}

TEST_CASE("what a mirror shows equals what is seen directly") {
    GpuContext gpu;
    if (!gpu) return;
    const std::string lit = R"("lights":[)" + pointLight({1, 4, -2}, {20, 30, 40}, "inverse-square") + R"(],"materials":{"m":)" +
                            kPlaster + R"(,"mirror":{"model":"phong","diffuse":0,"reflect":1}})";
    const std::string wall = rectangle({-40, 0.5, -6}, {80, 0, 0}, {0, 40, 0}, "m") + "," + sphere({0.5, 2, -4}, 0.8, "m");
    const View above{{0, 2, 4}, {0, 0, 0}, 30}, below{{0, -2, 4}, {0, 0, 0}, 30, 48, {0, -1, 0}};
    const Picture mirrored = renderScene(gpu, "{" + above.text() + "," + lit + R"(,"objects":[)" + wall + "," +
                                                  rectangle({-5, 0, -6}, {0, 0, 10}, {10, 0, 0}, "mirror") + "]}");
    const Picture direct = renderScene(gpu, "{" + below.text() + "," + lit + R"(,"objects":[)" + wall + "]}");
    size_t edges = 0;
    // Rays start off the mirror by as much as its corners are rounded, which shows where light grazes the ball.
    const auto seenDirectly = [&](uint32_t x, uint32_t y) -> std::optional<dvec3> {
        const glm::vec3 value = direct.at(47 - x, y);
        // A mirror image may round to the other side of the ball's outline.
        const bool edge = glm::distance(mirrored.at(x, y), value) > 0.01f;
        edges += edge;
        return edge ? std::nullopt : std::optional<dvec3>(value);
    };
    checkPixels(mirrored, 3e-4, seenDirectly, 0.1);
    CHECK(edges < 4);
    CHECK(mirrored.stats.secondary_rays == 48 * 48);
}

namespace {

/// A slab of glass 1 m thick before a wall 4 m behind its back. `radiance` is that of the wall at a lateral distance from the
/// axis.
double slabRadiance(double ior, double cosI, double distance, uint32_t maxDepth, const std::function<double(double)>& radiance) {
    const double sinI = std::sqrt(1 - cosI * cosI), sinT = sinI / ior, cosT = std::sqrt(1 - sinT * sinT);
    const double r = fresnel(cosI, ior);
    double throughput = 1 - r, lateral = distance * sinI / cosI + sinT / cosT, sum = 0;
    // The k-th term leaves the back after 2 k inner reflections.
    for (uint32_t depth = 1; throughput > kCutoff && depth < maxDepth; depth += 2) {
        if (throughput * (1 - r) > kCutoff) sum += throughput * (1 - r) * radiance(lateral + 4 * sinI / cosI);
        if (throughput * r <= kCutoff || depth + 1 > maxDepth) break;
        throughput *= r * r;
        lateral += 2 * sinT / cosT;
    }
    return sum;
}

std::string slab(const TemporaryDir& dir) {
    return box(dir, "slab", {-16, -16, -1}, {16, 16, 0}, "glass");
}

}  // namespace

TEST_CASE("a slab of glass transmits the series of its Fresnel products") {
    GpuContext gpu;
    if (!gpu) return;
    const View view{{0, 0, 2}, {0, 0, 0}, 60, 33};
    for (const double ior : {1.5, 2.42, 0.8}) {
        CAPTURE(ior);
        TemporaryDir dir;
        const LoadedScene scene(
            gpu, test::bakeScene(dir, "{" + view.text() + R"(,"materials":{"glass":)" + glass(ior) + R"(,"wall":)" + glow(2) +
                                          R"(},"objects":[)" + slab(dir) + "," +
                                          rectangle({-400, -400, -5}, {800, 0, 0}, {0, 800, 0}, "wall") + "]}"));
        for (const uint32_t maxDepth : {0u, 1u, 2u, 3u, 4u, 20u}) {
            CAPTURE(maxDepth);
            checkPixels(scene.render(depthLimit(maxDepth)), 1e-5, [&](uint32_t x, uint32_t y) {
                const double cosI = -view.direction(x, y).z;
                return dvec3(slabRadiance(ior, cosI, 2, maxDepth, [](double) { return 2.0; }));
            });
        }
    }
}

TEST_CASE("a slab of glass shifts what is behind it") {
    GpuContext gpu;
    if (!gpu) return;
    const double ior = 1.5;
    const View view{{0, 0, 2}, {0, 0, 0}, 80, 48};
    TemporaryDir dir;
    const Picture picture =
        renderScene(gpu, dir,
                    "{" + view.text() + R"(,"lights":[)" + pointLight({0, 0, -3}, {8, 8, 8}, "inverse-square") +
                        R"(],"materials":{"glass":)" + glass(ior) + R"(,"wall":{"model":"phong","diffuse":0.5}},"objects":[)" +
                        slab(dir) + "," + rectangle({-16, -16, -5}, {32, 0, 0}, {0, 32, 0}, "wall") + "]}");
    const auto wall = [](double lateral) {
        const double d2 = 4 + lateral * lateral;
        return 0.5 * 8 * 2 / std::sqrt(d2) / d2;
    };
    checkPixels(picture, 2e-5,
                [&](uint32_t x, uint32_t y) { return dvec3(slabRadiance(ior, -view.direction(x, y).z, 2, 20, wall)); });
}

namespace {

/// What comes back from `planes` half mirrors in a row to a ray in the gap before plane `next`, going deeper or back out, when
/// every way out shines with 1.
double halfMirrorRadiance(int planes, int next, bool deeper, double throughput, uint32_t depth, uint32_t maxDepth) {
    if (next < 0 || next >= planes) return throughput;
    if (depth == maxDepth || throughput / 2 <= kCutoff) return 0;
    const int beyond = deeper ? next + 1 : next - 1, back = deeper ? next - 1 : next + 1;
    return halfMirrorRadiance(planes, beyond, deeper, throughput / 2, depth + 1, maxDepth) +
           halfMirrorRadiance(planes, back, !deeper, throughput / 2, depth + 1, maxDepth);
}

}  // namespace

TEST_CASE("a row of half mirrors sends back the exact sum over its tree of rays") {
    GpuContext gpu;
    if (!gpu) return;
    std::string planes;
    for (int i = 0; i < 5; ++i) planes += (i ? "," : "") + rectangle({-8, -8, -0.5 * i}, {16, 0, 0}, {0, 16, 0}, "half");
    const View view{{0, 0, 3}, {0, 0, 0}, 30, 16};
    TemporaryDir dir;
    const LoadedScene scene(
        gpu,
        test::bakeScene(dir, "{" + view.text() + R"(,"background":{"color":[1,1,1]},"materials":{"half":{"model":"phong",)" +
                                 R"("diffuse":0,"reflect":0.5,"refract":0.5,"ior":1,"thin":true}},"objects":[)" + planes + "]}"));
    for (const uint32_t maxDepth : {0u, 1u, 2u, 5u, 8u, 20u}) {
        CAPTURE(maxDepth);
        const Picture picture = scene.render(depthLimit(maxDepth));
        const auto expected = static_cast<float>(halfMirrorRadiance(5, 0, true, 1, 0, maxDepth));
        for (uint32_t i = 0; i < 256; ++i) REQUIRE(picture.at(i % 16, i / 16) == glm::vec3(expected));
        CHECK((expected > 0.5f) == (maxDepth > 3));
    }
}

namespace {

/// Light enters through z = 0, meets the oblique face at 45 degrees and leaves through the top.
const char* kPrism =
    "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nv 1 1 -2\nv -1 1 -2\n"
    "f 1 2 3 4\nf 4 3 5 6\nf 1 6 5 2\nf 2 5 3\nf 1 4 6\n";

/// A prism of glass below a ceiling of radiance 3, seen along its axis.
Picture prismPicture(const GpuContext& gpu, const std::string& material) {
    const View view{{0, 0, 5}, {0, 0, 0}, 0.5, 9};
    TemporaryDir dir;
    dir.write("prism.obj", kPrism);
    return renderScene(gpu, dir,
                       "{" + view.text() + R"(,"materials":{"glass":)" + material + R"(,"ceiling":)" + glow(3) +
                           R"(},"objects":[{"mesh":"prism.obj","material":"glass"},)" +
                           rectangle({-50, 5, -50}, {100, 0, 0}, {0, 0, 100}, "ceiling") + "]}");
}

}  // namespace

TEST_CASE("a prism reflects totally above the critical angle and transmits below it") {
    GpuContext gpu;
    if (!gpu) return;
    for (const double ior : {1.5, 1.3}) {
        CAPTURE(ior);
        const Picture picture = prismPicture(gpu, glass(ior));
        const double r = fresnel(1, ior), oblique = fresnel(std::sqrt(0.5), 1 / ior);
        CHECK((oblique == 1) == (ior > std::sqrt(2.0)));
        // What passes the oblique face bends upwards and meets the ceiling too.
        const double expected = (1 - r) * (oblique * (1 - r) + (1 - oblique)) * 3;
        CHECK(picture.at(4, 4).x == doctest::Approx(expected).epsilon(1e-5));
    }
}

TEST_CASE("phong glass without Fresnel sends everything into total reflection") {
    GpuContext gpu;
    if (!gpu) return;
    const Picture picture = prismPicture(gpu, R"({"model":"phong","diffuse":0,"refract":0.5,"ior":1.5})");
    for (uint32_t i = 0; i < 81; ++i) CHECK(picture.at(i % 9, i / 9) == glm::vec3(0.75f));  // two interfaces of weight 0.5
}

namespace {

/// An uncompressed TGA file of 8-bit sRGB texels, row 0 at the top.
std::string tga(uint16_t width, uint16_t height, const std::vector<std::array<uint8_t, 3>>& rgb) {
    std::string file(18, '\0');
    file[2] = 2, file[12] = char(width & 255), file[13] = char(width >> 8), file[14] = char(height & 255),
    file[15] = char(height >> 8);
    file[16] = 24, file[17] = 0x20;
    for (const auto& texel : rgb) file += {char(texel[2]), char(texel[1]), char(texel[0])};
    return file;
}

double srgb(uint8_t value) {
    const double c = value / 255.0;
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

/// How an image goes on beyond its rim.
enum class Beyond { repeats, mirrors, clamps };

/// Linear texels and how a sampler reads them: centres at half-integers.
struct Texels {
    int width, height;
    std::vector<dvec3> values;

    static int place(int i, int count, Beyond beyond) {
        if (beyond == Beyond::clamps) return std::min(std::max(i, 0), count - 1);
        const int turn = ((i % (2 * count)) + 2 * count) % (2 * count);
        return beyond == Beyond::repeats ? turn % count : std::min(turn, 2 * count - 1 - turn);
    }
    dvec3 at(int x, int y, Beyond u, Beyond v) const { return values[size_t(place(y, height, v)) * width + place(x, width, u)]; }
    dvec3 bilinear(double u, double v, Beyond beyondU, Beyond beyondV) const {
        const double x = u * width - 0.5, y = v * height - 0.5, fx = x - std::floor(x), fy = y - std::floor(y);
        const int x0 = int(std::floor(x)), y0 = int(std::floor(y));
        const auto row = [&](int r) { return at(x0, r, beyondU, beyondV) * (1 - fx) + at(x0 + 1, r, beyondU, beyondV) * fx; };
        return row(y0) * (1 - fy) + row(y0 + 1) * fy;
    }
};

/// Texels of every kind of value, with their file.
struct Image {
    Texels texels;
    std::string file;

    Image(int width, int height) : texels{width, height, {}} {
        std::vector<std::array<uint8_t, 3>> bytes;
        for (int i = 0; i < width * height; ++i) {
            bytes.push_back({uint8_t(i * 53 + 20), uint8_t(255 - i * 31), uint8_t(i * i * 7 + 3)});
            texels.values.push_back({srgb(bytes.back()[0]), srgb(bytes.back()[1]), srgb(bytes.back()[2])});
        }
        file = tga(uint16_t(width), uint16_t(height), bytes);
    }
};

constexpr double kHalf = 0x1p-11;  // rounding of a texel to 16 bits

}  // namespace

TEST_CASE("a texture is bilinear and decoded from sRGB and goes on as its material says") {
    GpuContext gpu;
    if (!gpu) return;
    const Image image(5, 4);
    TemporaryDir dir;
    dir.write("image.tga", image.file);
    // Texture coordinates from (-0.75, -1.5) to (1.5, 2) over [-1,1]^2, in the plane z = 0.
    dir.write("quad.obj",
              "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt -0.75 -1.5\nvt 1.5 -1.5\nvt 1.5 2\nvt -0.75 2\nf 1/1 2/2 3/3 4/4\n");
    const View view{{0, 0, 4}, {0, 0, 0}, 28, 64};
    const std::vector<std::pair<std::string, Beyond>> ways = {
        {"", Beyond::repeats}, {R"(,"textureWrap":"mirror")", Beyond::mirrors}, {R"(,"textureWrap":"clamp")", Beyond::clamps}};
    for (const auto& [key, beyond] : ways) {
        CAPTURE(key);
        const Picture picture =
            renderScene(gpu, dir,
                        "{" + view.text() + R"(,"lights":[{"type":"directional","direction":[0,0,-1],"irradiance":)" +
                            json(dvec3(kPi)) + R"(}],"materials":{"m":{"model":"pbr","baseColor":"image.tga")" + key +
                            R"(}},"objects":[{"mesh":"quad.obj","material":"m"}]})");
        checkPixels(
            picture, 2 * kHalf,
            [&, beyond = beyond](uint32_t x, uint32_t y) {
                const dvec3 d = view.direction(x, y), p = view.position - d * (4 / d.z);
                const double u = -0.75 + (p.x + 1) / 2 * 2.25, v = -1.5 + (p.y + 1) / 2 * 3.5;
                return image.texels.bilinear(u, 1 - v, beyond, beyond);
            },
            1e-2);
    }
}

TEST_CASE("the texture of a rectangle stands upright") {
    GpuContext gpu;
    if (!gpu) return;
    const Image image(4, 4);
    TemporaryDir dir;
    dir.write("image.tga", image.file);
    const View view{{0, 0, 4}, {0, 0, 0}, 28, 64};
    const Picture picture =
        renderScene(gpu, dir,
                    "{" + view.text() + R"(,"lights":[{"type":"directional","direction":[0,0,-1],"irradiance":)" +
                        json(dvec3(kPi)) + R"(}],"materials":{"m":{"model":"pbr","baseColor":"image.tga"}},"objects":[)" +
                        rectangle({-1, -1, 0}, {2, 0, 0}, {0, 2, 0}, "m") + "]}");
    checkPixels(
        picture, 2 * kHalf,
        [&](uint32_t x, uint32_t y) {
            const dvec3 d = view.direction(x, y), p = view.position - d * (4 / d.z);
            return image.texels.bilinear((p.x + 1) / 2, (1 - p.y) / 2, Beyond::repeats, Beyond::repeats);
        },
        1e-2);
}

TEST_CASE("the background shows each direction where it belongs") {
    GpuContext gpu;
    if (!gpu) return;
    const Image image(8, 5);
    TemporaryDir dir;
    dir.write("sky.tga", image.file);
    const std::vector<dvec3> directions = {{1, 0, 0},  {-1, 0, 0},        {0, 0, 1},         {0, 0, -1},       {0, 1, 0},
                                           {0, -1, 0}, {-1, 0.3, 1e-4},   {-1, 0.3, -1e-4},  {1e-4, 1, 1e-4},  {-1e-4, -1, 2e-4},
                                           {1, 1, 1},  {-0.4, -0.7, 0.2}, {0.2, -0.3, -0.9}, {-0.6, 0.1, -0.3}};
    for (const double rotation : {0.0, 90.0, -137.0}) {
        CAPTURE(rotation);
        View view{{0, 0, 0}, {1, 0, 0}, 1, 1};
        const LoadedScene scene(
            gpu, test::bakeScene(dir, "{" + view.text() + R"(,"background":{"image":"sky.tga","strength":1.5,"rotation":)" +
                                          json(rotation) + R"(},"materials":{"m":)" + kPlaster + R"(},"objects":[)" +
                                          sphere({0, 100, 100}, 0.01, "m") + "]}"));
        for (const dvec3& direction : directions) {
            CAPTURE(direction.x);
            CAPTURE(direction.y);
            CAPTURE(direction.z);
            const minirt_camera camera = {
                {0, 0, 0}, {direction.x, direction.y, direction.z}, {0.1, std::abs(direction.y) > 0.9 ? 0.0 : 1.0, 0.2}, 1, 0, 0};
            minirt_render_desc desc = {};
            desc.camera = &camera;
            const glm::vec3 got = scene.render(desc).at(0, 0);
            // -Z at a quarter of the width, then +X, +Z, -X; the panorama turns to the left of whoever stands in it.
            const double u = std::atan2(direction.z, direction.x) / (2 * kPi) + 0.5 + rotation / 360;
            const double v = std::atan2(std::hypot(direction.x, direction.z), direction.y) / kPi;
            const bool pole = direction.x == 0 && direction.z == 0;
            const dvec3 expected =
                1.5 * image.texels.bilinear(pole ? 0.5 + rotation / 360 : u, v, Beyond::repeats, Beyond::clamps);
            for (int k = 0; k < 3; ++k) CHECK(got[k] == doctest::Approx(expected[k]).epsilon(2e-3));
        }
    }
}

TEST_CASE("glass of index 1 is invisible bit for bit") {
    GpuContext gpu;
    if (!gpu) return;
    const Image image(16, 9);
    TemporaryDir dir;
    dir.write("sky.tga", image.file);
    std::string ball;
    for (const oracle::Triangle& triangle : oracle::icosphere({0, 0, 0}, 1, 3))
        for (const glm::vec3& p : triangle) ball += "v " + json(p.x) + " " + json(p.y) + " " + json(p.z) + "\n";
    for (int i = 1; i <= 20 * 64 * 3; i += 3)
        ball += "f " + std::to_string(i) + " " + std::to_string(i + 1) + " " + std::to_string(i + 2) + "\n";
    dir.write("ball.obj", ball);
    const View view{{0, 0, 5}, {0, 0, 0}, 60, 64};
    const auto scene = [&](const std::string& material) {
        return "{" + view.text() + R"(,"background":{"image":"sky.tga"},"materials":{"glass":)" + material + R"(},"objects":[)" +
               sphere({0.5, 0.2, 0}, 1.5, "glass") +
               R"(,{"mesh":"ball.obj","material":"glass","smooth":true,"translate":[0.2,-0.1,0]},)" +
               sphere({0.5, 0.2, -300}, 0.001, "glass") + "]}";
    };
    const Picture with = renderScene(gpu, dir, scene(glass(1)));
    CHECK(with.stats.secondary_rays > 1000);
    // The same rays meet nothing where all of it is moved away.
    const Picture without = renderScene(gpu, dir,
                                        "{" + view.text() + R"(,"background":{"image":"sky.tga"},"materials":{"glass":)" +
                                            glass(1) + R"(},"objects":[)" + sphere({0, 0, 1000}, 1, "glass") + "]}");
    CHECK(with == without);
    CHECK(without.stats.secondary_rays == 0);
}

TEST_CASE("a sphere has the outline and the normals of a sphere") {
    GpuContext gpu;
    if (!gpu) return;
    for (const dvec3& center : {dvec3(0, 0, 0), dvec3(1e5, -2e5, 3e5)}) {
        View view{center + dvec3(0, 0, 6), center, 40, 64};
        const dvec3 toLight = glm::normalize(dvec3(1, 2, 3));
        const Picture picture = renderScene(
            gpu, "{" + view.text() + R"(,"background":{"color":[7,7,7]},"lights":[{"type":"directional","direction":)" +
                     json(-toLight) + R"(}],"materials":{"m":)" + kPlaster + R"(},"objects":[)" + sphere(center, 2, "m") + "]}");
        checkPixels(
            picture, 2e-5,
            [&](uint32_t x, uint32_t y) -> std::optional<dvec3> {
                const dvec3 d = view.direction(x, y), o = view.position - center;
                const double along = -glm::dot(o, d), distance = glm::length(o + along * d);
                if (std::abs(distance - 2) < 1e-5) return std::nullopt;
                if (distance > 2) return dvec3(7);
                const dvec3 n = (o + d * (along - std::sqrt(4 - distance * distance))) / 2.0;
                return kPlasterWeight * std::max(glm::dot(n, toLight), 0.0);
            },
            0.05);
    }
}

TEST_CASE("smooth normals on finer balls approach the sphere") {
    GpuContext gpu;
    if (!gpu) return;
    const View view{{0, 0, 6}, {0, 0, 0}, 36, 64};
    const dvec3 toLight = glm::normalize(dvec3(1, 1, 2));
    double before = 0;
    for (int level = 2; level <= 5; ++level) {
        std::string text;
        const oracle::Mesh mesh = oracle::icosphere({0, 0, 0}, 2, level);
        for (const oracle::Triangle& triangle : mesh)
            for (const glm::vec3& p : triangle) {
                text += "v " + json(p.x) + " " + json(p.y) + " " + json(p.z) + "\n";
                text += "vn " + json(p.x) + " " + json(p.y) + " " + json(p.z) + "\n";
            }
        for (size_t i = 1; i <= mesh.size() * 3; i += 3) {
            text += "f";
            for (size_t k = i; k < i + 3; ++k) text += " " + std::to_string(k) + "//" + std::to_string(k);
            text += "\n";
        }
        TemporaryDir dir;
        dir.write("ball.obj", text);
        const Picture picture =
            renderScene(gpu, dir,
                        "{" + view.text() + R"(,"lights":[{"type":"directional","direction":)" + json(-toLight) +
                            R"(}],"materials":{"m":)" + kPlaster + R"(},"objects":[{"mesh":"ball.obj","material":"m"}]})");
        double worst = 0;
        for (uint32_t y = 0; y < 64; ++y)
            for (uint32_t x = 0; x < 64; ++x) {
                const dvec3 d = view.direction(x, y), o = view.position;
                const double along = -glm::dot(o, d), distance = glm::length(o + along * d);
                if (distance > 1.8) continue;
                const dvec3 n = (o + d * (along - std::sqrt(4 - distance * distance))) / 2.0;
                worst = std::max(worst, std::abs(picture.at(x, y).x - kPlasterWeight.x * std::max(glm::dot(n, toLight), 0.0)));
            }
        MESSAGE("level " << level << ": largest error " << worst);
        if (level > 2) CHECK(worst < before / 2.5);
        before = worst;
    }
    CHECK(before < 2e-3);
}

TEST_CASE("checkers alternate by the parity of world-space cells") {
    GpuContext gpu;
    if (!gpu) return;
    for (const dvec3& offset : {dvec3(0), dvec3(100001, 0, -100000.5)})
        for (const double scale : {1.0, 0.75}) {
            CAPTURE(offset.x);
            CAPTURE(scale);
            const View view{offset + dvec3(0, 6, 0.01), offset, 60, 64};
            const Picture picture =
                renderScene(gpu, "{" + view.text() + R"(,"materials":{"a":)" + glow(1) + R"(,"b":)" + glow(2) +
                                     R"(,"m":{"model":"checker","a":"a","b":"b","scale":)" + json(scale) + R"(}},"objects":[)" +
                                     rectangle(offset + dvec3(-20, 0, -20), {0, 0, 40}, {40, 0, 0}, "m") + "]}");
            checkPixels(picture, 0, [&](uint32_t x, uint32_t y) -> std::optional<dvec3> {
                const dvec3 p = *meetFloor(view.position, view.direction(x, y));
                const double cx = p.x / scale, cz = p.z / scale;
                if (std::abs(cx - std::round(cx)) < 1e-4 || std::abs(cz - std::round(cz)) < 1e-4) return std::nullopt;
                const bool even = std::fmod(std::abs(std::floor(cx) + std::floor(cz)), 2) == 0;
                return dvec3(even ? 1 : 2);
            });
        }
}

TEST_CASE("checkers lie on the two axes across the normal") {
    GpuContext gpu;
    if (!gpu) return;
    // Looking along -X and -Z at walls through the origin.
    for (const int axis : {0, 2}) {
        View view{{0, 0, 0}, {0, 0, 0}, 60, 64};
        view.position[axis] = 6;
        const dvec3 u = axis == 0 ? dvec3(0, 0, -40) : dvec3(40, 0, 0),
                    corner = axis == 0 ? dvec3(0, -20, 20) : dvec3(-20, -20, 0);
        const Picture picture = renderScene(gpu, "{" + view.text() + R"(,"materials":{"a":)" + glow(1) + R"(,"b":)" + glow(2) +
                                                     R"(,"m":{"model":"checker","a":"a","b":"b"}},"objects":[)" +
                                                     rectangle(corner, u, {0, 40, 0}, "m") + "]}");
        checkPixels(picture, 0, [&](uint32_t x, uint32_t y) -> std::optional<dvec3> {
            const dvec3 d = view.direction(x, y), p = view.position - d * (6 / d[axis]);
            const double across = p[2 - axis];
            if (std::abs(across - std::round(across)) < 1e-4 || std::abs(p.y - std::round(p.y)) < 1e-4) return std::nullopt;
            return dvec3(std::fmod(std::abs(std::floor(across) + std::floor(p.y)), 2) == 0 ? 1 : 2);
        });
    }
}

TEST_CASE("an emitter shows its own radiance and nothing else does") {
    GpuContext gpu;
    if (!gpu) return;
    const View view{{0, 0, 5}, {0, 0, 0}, 60, 32};
    const Picture picture = renderScene(
        gpu, "{" + view.text() + R"(,"materials":{"m":{"model":"pbr","baseColor":[1,1,1],"emissive":[1.5,2.25,3.125]},"dark":)" +
                 kPlaster + R"(},"objects":[)" + rectangle({-20, -20, 0}, {20, 0, 0}, {0, 40, 0}, "m") + "," +
                 rectangle({0, -20, 0}, {20, 0, 0}, {0, 40, 0}, "dark") + "]}");
    for (uint32_t y = 0; y < 32; ++y)
        for (uint32_t x = 0; x < 32; ++x) CHECK(picture.at(x, y) == (x < 16 ? glm::vec3(1.5f, 2.25f, 3.125f) : glm::vec3(0)));
}

TEST_CASE("an emitter shines to its front unless it is double-sided, and so do lights with size") {
    GpuContext gpu;
    if (!gpu) return;
    const dvec3 left(-20, -20, 0), middle(0, -20, 0), x(20, 0, 0), y(0, 40, 0);
    const std::string emitter = R"({"model":"pbr","baseColor":[0,0,0],"emissive":[1,2,4])";
    for (const double z : {5.0, -5.0}) {
        CAPTURE(z);
        const View view{{0, 0, z}, {0, 0, 0}, 60, 32};
        const Picture picture = renderScene(gpu, "{" + view.text() + R"(,"materials":{"one":)" + emitter + R"(},"both":)" +
                                                     emitter + R"(,"doubleSided":true}},"objects":[)" +
                                                     rectangle(left, x, y, "one") + "," + rectangle(middle, x, y, "both") + "]}");
        const glm::vec3 radiance(1, 2, 4);
        bool right = true;
        for (uint32_t row = 0; row < 32; ++row) {
            for (uint32_t column = 0; column < 32; ++column) {
                const bool isOne = (column < 16) == (z > 0);
                right = right && picture.at(column, row) == (isOne && z < 0 ? glm::vec3(0) : radiance);
            }
        }
        CHECK(right);
    }
    const View view{{0, 0, 8}, {0, 0, 0}, 60, 32};
    const Picture picture =
        renderScene(gpu, "{" + view.text() +
                             R"(,"lights":[{"type":"rectangle","origin":[-3,-1,0],"u":[2,0,0],"v":[0,2,0],"radiance":[1,2,4]},)" +
                             R"({"type":"rectangle","origin":[-1,-1,0],"u":[0,2,0],"v":[2,0,0]},)" +
                             R"({"type":"sphere","center":[2,0,0],"radius":0.9,"radiance":[4,2,1]}],"materials":{"m":)" +
                             kPlaster + R"(},"objects":[)" + sphere({0, 0, -50}, 1, "m") + "]}");
    CHECK(picture.at(9, 16) == glm::vec3(1, 2, 4));
    CHECK(picture.at(16, 16) == glm::vec3(0));
    CHECK(picture.at(22, 16) == glm::vec3(4, 2, 1));
}

TEST_CASE("a spot light is full in its inner cone and dark outside of its outer one") {
    GpuContext gpu;
    if (!gpu) return;
    const View view{{0, 6, 6}, {0, 0, 0}};
    const dvec3 light(0.5, 4, 0.25), axis(0.2, -3, -0.4), intensity(10, 20, 30);
    for (const auto& [inner, outer] : {std::pair{10.0, 25.0}, {0.0, 45.0}, {20.0, 20.0}, {0.0, 90.0}}) {
        for (const bool inverseSquare : {true, false}) {
            CAPTURE(inner);
            CAPTURE(outer);
            const std::string spot = R"({"type":"spot","position":)" + json(light) + R"(,"direction":)" + json(axis) +
                                     R"(,"intensity":)" + json(intensity) + R"(,"innerConeAngle":)" + json(inner) +
                                     R"(,"outerConeAngle":)" + json(outer) + (inverseSquare ? "}" : R"(,"falloff":"none"})");
            const Picture picture = renderScene(gpu, "{" + view.text() + R"(,"lights":[)" + spot + R"(],"materials":{"m":)" +
                                                         kPlaster + R"(},"objects":[)" + floorOf("m") + "]}");
            const double from = std::cos(glm::radians(inner)), to = std::cos(glm::radians(outer));
            checkPixels(
                picture, 1e-4,
                [&, inner = inner, outer = outer](uint32_t x, uint32_t y) -> std::optional<dvec3> {
                    const dvec3 p = *meetFloor(view.position, view.direction(x, y)), away = light - p;
                    const double d2 = glm::dot(away, away), cosine = glm::dot(-away, axis) / std::sqrt(d2) / glm::length(axis);
                    if (inner == outer && std::abs(cosine - to) < 1e-4) return std::nullopt;
                    const double t = inner == outer ? cosine > to : std::min(std::max((cosine - to) / (from - to), 0.0), 1.0);
                    return kPlasterWeight * intensity * t * t * (away.y / std::sqrt(d2)) / (inverseSquare ? d2 : 1.0);
                },
                1e-1);
        }
    }
    // Beside lights of the other kinds.
    const std::string place = R"("position":)" + json(light) + R"(,"intensity":)" + json(intensity);
    const auto lit = [&](const std::string& lights) {
        return renderScene(gpu, "{" + view.text() + R"(,"lights":[)" + lights + R"(],"materials":{"m":)" + kPlaster +
                                    R"(},"objects":[)" + floorOf("m") + "]}");
    };
    const std::string spot = R"({"type":"spot","direction":[0,-1,0],)" + place + "}", point = R"({"type":"point",)" + place + "}",
                      sun = R"({"type":"directional","direction":[1,-2,0.5]})";
    const Picture together = lit(spot + "," + point + "," + sun), a = lit(spot), b = lit(point), c = lit(sun);
    checkPixels(together, 1e-6,
                [&](uint32_t x, uint32_t y) { return dvec3(a.at(x, y)) + dvec3(b.at(x, y)) + dvec3(c.at(x, y)); });
}

namespace {

/// Mirrors, glass, textures of light: something in every pixel, none of them alike.
std::string busyScene(const View& view) {
    return "{" + view.text() + R"(,"background":{"color":[0.1,0.2,0.4]},"lights":[)" +
           pointLight({2, 5, 3}, {40, 40, 40}, "inverse-square") + R"(],"materials":{"m":)" + kPlaster + R"(,"glass":)" +
           glass(1.5) + R"(,"mirror":{"model":"phong","diffuse":0.2,"reflect":0.7},)" +
           R"("n":{"model":"phong","diffuse":0.5,"color":[0.2,0.4,0.8]},"tiles":{"model":"checker","a":"m","b":"n","scale":0.7}},"objects":[)" +
           floorOf("tiles") + "," + sphere({-1, 1, 0}, 1, "glass") + "," + sphere({1.2, 0.8, -0.5}, 0.8, "mirror") + "]}";
}

const View kBusyView{{0, 2, 6}, {0, 0.7, 0}, 35, 45};

}  // namespace

TEST_CASE("a depth limit of 0 leaves mirrors and glass black") {
    GpuContext gpu;
    if (!gpu) return;
    TemporaryDir dir;
    View view = kBusyView;
    view.maxDepth = 0;
    const LoadedScene scene(gpu, test::bakeScene(dir, busyScene(view)));
    const Picture picture = scene.render();
    CHECK(picture.stats.secondary_rays == 0);
    CHECK(picture.at(14, 24) == glm::vec3(0));  // in the glass ball
    minirt_render_desc desc = {};
    desc.max_depth = 1;  // the limit plus one
    CHECK(scene.render(desc) == picture);
    desc.max_depth = 21;
    CHECK(scene.render(desc).at(14, 24) != glm::vec3(0));
}

TEST_CASE("several samples are the mean of the single ones") {
    GpuContext gpu;
    if (!gpu) return;
    TemporaryDir dir;
    const LoadedScene scene(gpu, test::bakeScene(dir, busyScene(kBusyView)));
    std::vector<Picture> singles;
    minirt_render_desc desc = {};
    for (uint32_t i = 0; i < 8; ++i) {
        desc.samples = 1;
        desc.first_sample = i;
        singles.push_back(scene.render(desc));
    }
    CHECK(!(singles[0] == singles[1]));
    const auto mean = [&](uint32_t first, uint32_t count) {
        desc.first_sample = first;
        desc.samples = count;
        return scene.render(desc);
    };
    const Picture whole = mean(0, 8), head = mean(0, 3), tail = mean(3, 5);
    CHECK(whole.stats.primary_rays == 45 * 45 * 8);
    double worstMean = 0, worstSplit = 0;
    for (size_t i = 0; i < whole.rgba.size(); ++i) {
        double sum = 0;
        for (const Picture& single : singles) sum += static_cast<double>(single.rgba[i]);
        const double value = whole.rgba[i];
        worstMean = std::max(worstMean, std::abs(sum / 8 - value) / std::max(value, 1e-3));
        worstSplit =
            std::max(worstSplit, std::abs((3.0 * head.rgba[i] + 5.0 * tail.rgba[i]) / 8 - value) / std::max(value, 1e-3));
    }
    CHECK(worstMean < 1e-6);
    CHECK(worstSplit < 1e-6);
}

TEST_CASE("a region equals the same part of the whole picture bit for bit") {
    GpuContext gpu;
    if (!gpu) return;
    TemporaryDir dir;
    const LoadedScene scene(gpu, test::bakeScene(dir, busyScene(kBusyView)));
    minirt_render_desc desc = {};
    desc.samples = 2;
    const Picture whole = scene.render(desc);
    for (const minirt_region& region :
         {minirt_region{3, 5, 17, 9}, minirt_region{0, 0, 1, 1}, minirt_region{44, 44, 1, 1}, minirt_region{8, 0, 37, 45}}) {
        CAPTURE(region.x);
        desc.region = region;
        const Picture part = scene.render(desc);
        CHECK(part.stats.primary_rays == uint64_t{2} * region.width * region.height);
        for (uint32_t y = 0; y < 45; ++y)
            for (uint32_t x = 0; x < 45; ++x) {
                const bool inside = x >= region.x && x < region.x + region.width && y >= region.y && y < region.y + region.height;
                REQUIRE(part.at(x, y) == (inside ? whole.at(x, y) : glm::vec3(0)));
                REQUIRE(part.rgba[4 * (y * 45 + x) + 3] == (inside ? 1.0f : 0.0f));
            }
    }
}

TEST_CASE("an opaque mirror with Fresnel is the same from both sides whatever else the kernel holds") {
    GpuContext gpu;
    if (!gpu) return;
    TemporaryDir dir;
    const auto scene = [](double z) {
        const View view{{1, 2, z}, {0, 0, 0}, 40, 24};
        return "{" + view.text() + R"(,"background":{"color":[1,1,1]},"materials":{"m":{"model":"phong","diffuse":0,)" +
               R"("reflect":1,"fresnel":true,"ior":1.5}},"objects":[)" + rectangle({-20, -20, 0}, {40, 0, 0}, {0, 40, 0}, "m") +
               "]}";
    };
    for (const double z : {5.0, -5.0}) {
        CAPTURE(z);
        const Picture picture = renderScene(gpu, dir, scene(z));
        CHECK(renderWithAllEffects(gpu, dir, scene(z)) == picture);
        const View view{{1, 2, z}, {0, 0, 0}, 40, 24};
        checkPixels(picture, 1e-5, [&](uint32_t x, uint32_t y) -> std::optional<dvec3> {
            return dvec3(fresnel(std::abs(view.direction(x, y).z), 1.5));
        });
    }
}

TEST_CASE("a file that is background and texture wraps as each of them does") {
    GpuContext gpu;
    if (!gpu) return;
    TemporaryDir dir;
    // Three rows of one texel each: red, green, blue; uncompressed TGA, top row first.
    std::string tga(18, '\0');
    tga[2] = 2, tga[12] = 1, tga[14] = 3, tga[16] = 24, tga[17] = 0x20;
    tga += std::string("\0\0\xff\0\xff\0\xff\0\0", 9);
    dir.write("one.tga", tga);
    dir.write("other.tga", tga);
    dir.write("quad.obj", "v -2 -2 0\nv 2 -2 0\nv 2 2 0\nv -2 2 0\nvt 0 0\nvt 1 0\nvt 1 3\nvt 0 3\nf 1/1 2/2 3/3 4/4\n");
    const View view{{0, 0, 6}, {0, 0, 0}, 60, 32};
    const auto scene = [&](const std::string& texture) {
        return "{" + view.text() +
               R"(,"background":{"image":"one.tga"},"lights":[{"type":"directional","direction":[0,0,-1]}],)" +
               R"("materials":{"m":{"model":"pbr","baseColor":")" + texture +
               R"("}},"objects":[{"mesh":"quad.obj","material":"m"}]})";
    };
    CHECK(renderScene(gpu, dir, scene("one.tga")) == renderScene(gpu, dir, scene("other.tga")));
}

TEST_CASE("both node layouts and kernels with all effects give the same picture") {
    GpuContext gpu;
    if (!gpu) return;
    TemporaryDir dir;
    const Picture quantised =
        LoadedScene(gpu, test::bakeScene(dir, busyScene(kBusyView), minirtc::LayoutChoice::quantised)).render();
    const Picture exact = LoadedScene(gpu, test::bakeScene(dir, busyScene(kBusyView), minirtc::LayoutChoice::floating)).render();
    CHECK(quantised == exact);
    CHECK(renderWithAllEffects(gpu, dir, busyScene(kBusyView)) == quantised);
}
