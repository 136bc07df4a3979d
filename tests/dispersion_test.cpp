// Light parts into colours as the closed forms say: prisms by their exit angles, white light by its whiteness.
#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstring>
#include <fstream>
#include <functional>
#include <glm/gtc/constants.hpp>

#include "gems.hpp"
#include "glasses.hpp"
#include "minirt.h"
#include "render_scene.hpp"
#include "runtime_hooks.hpp"
#include "shader_source.hpp"
#include "spectrum.hpp"

using glm::dvec3;
using minirtc::findGlass;
using minirtc::indexOf;
using test::GpuContext;
using test::LoadedScene;
using test::Picture;
using test::TemporaryDir;

namespace {

constexpr double kPi = glm::pi<double>();
constexpr double kDegree = kPi / 180;
constexpr double kApex = 60 * kDegree;
const double kWavelengths[] = {0.40, 0.4861327, 0.5461, 0.6562725, 0.75};

std::string json(double number) {
    char text[32];
    std::snprintf(text, sizeof text, "%.17g", number);
    return text;
}

/// An equilateral prism of edge 2 along y; the apex lies at x = 1, the faces beside it towards +z and -z.
std::string prismObj() {
    const std::string base = json(1 - std::sqrt(3.0));
    return "v 1 -5 0\nv " + base + " -5 -1\nv " + base + " -5 1\nv 1 5 0\nv " + base + " 5 -1\nv " + base +
           " 5 1\nf 3 2 1\nf 5 6 4\nf 4 6 3 1\nf 6 5 2 3\nf 5 4 1 2\n";
}

/// A plate 1 m thick and 20 m wide.
std::string plateObj() {
    return "v -10 -10 0\nv 10 -10 0\nv 10 10 0\nv -10 10 0\nv -10 -10 -1\nv 10 -10 -1\nv 10 10 -1\nv -10 10 -1\n"
           "f 1 2 3 4\nf 6 5 8 7\nf 2 6 7 3\nf 5 1 4 8\nf 4 3 7 8\nf 5 6 2 1\n";
}

/// Angles are counted from -z towards +x. A ray of direction `in` that meets the face towards +z at `incidence` leaves the other at:
double exitAngle(double incidence, double index) {
    const double inside = kApex - std::asin(std::sin(incidence) / index);
    return kApex / 2 - std::asin(index * std::sin(inside));
}

double transmittance(double incidence, double index) {
    const double r1 = std::asin(std::sin(incidence) / index);
    const double out = std::asin(index * std::sin(kApex - r1));
    return (1 - f64::meetInterface({std::sin(incidence), -std::cos(incidence), 0}, {0, 1, 0}, index).reflectance) *
           (1 - f64::meetInterface({std::sin(out), -std::cos(out), 0}, {0, 1, 0}, index).reflectance);
}

/// A panorama that is black but for a window of kWindow + 1 columns from `first`. There it is kWindow, or counts the columns.
constexpr int kColumns = 1024;
constexpr int kWindow = 250;

void writePanorama(const std::filesystem::path& path, int first, bool counts) {
    std::ofstream file(path, std::ios::binary);
    file << "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 4 +X " << kColumns << "\n";
    for (int i = 0; i < 4 * kColumns; ++i) {
        const int at = i % kColumns - first;
        const bool inside = at >= 0 && at <= kWindow;
        const auto value = static_cast<char>(static_cast<unsigned char>(!inside ? 0 : counts ? at : kWindow));
        file << value << value << value << static_cast<char>(static_cast<unsigned char>(inside ? 136 : 0));
    }
}

/// The column, from `first`, that a ray of this angle sees.
double columnAt(double angle, int first) {
    return (0.25 + angle / (2 * kPi)) * kColumns - 0.5 - first;
}
constexpr double kRadiansAColumn = 2 * kPi / kColumns;

/// One pixel that looks at a prism's face, and what it sees through it of both panoramas.
struct Bench {
    const GpuContext& gpu;
    double incidence;
    int first;
    TemporaryDir dir{};

    Bench(const GpuContext& device, double degrees, double middleIndex)
        : gpu(device),
          incidence(degrees * kDegree),
          first(static_cast<int>(columnAt(exitAngle(incidence, middleIndex), 0)) - kWindow / 2) {
        dir.write("prism.obj", prismObj());
        writePanorama(dir.path() / "counts.hdr", first, true);
        writePanorama(dir.path() / "even.hdr", first, false);
    }

    std::string scene(const std::string& glass, const std::string& image, const std::string& render) const {
        const double in = incidence - kApex / 2, x = 1 - 0.4 * std::sqrt(3.0), z = 0.4;
        const std::string target = "[" + json(x) + ",0," + json(z) + "]";
        const std::string position = "[" + json(x - 4 * std::sin(in)) + ",0," + json(z + 4 * std::cos(in)) + "]";
        return R"({"camera":{"position":)" + position + R"(,"target":)" + target + R"(,"vfov":1e-5},"background":{"image":")" +
               image + R"("},"materials":{"g":{"model":"pbr","roughness":0,"transmission":1,)" + glass +
               R"(}},"objects":[{"mesh":"prism.obj","material":"g"}],"render":{"size":[1,1],"maxDepth":2)" + render + "}}";
    }

    glm::dvec3 see(const std::string& glass, const std::string& image, const std::string& render, uint32_t sample = 0) const {
        minirt_render_desc desc = {};
        desc.first_sample = sample;
        return LoadedScene(gpu, bakeScene(dir, scene(glass, image, render))).render(desc).at(0, 0);
    }

    /// The angle at which each channel left.
    glm::dvec3 angles(const std::string& glass, const std::string& render) const {
        const glm::dvec3 column =
            see(glass, "counts.hdr", render) / see(glass, "even.hdr", render) * static_cast<double>(kWindow);
        return ((column + static_cast<double>(first) + 0.5) / static_cast<double>(kColumns) - 0.25) * 2.0 * kPi;
    }
};

/// Changes a blob and makes its checksums right again. What the validator says of it.
std::string change(const std::filesystem::path& path, const std::function<void(minirt_blob&)>& edit) {
    std::vector<minirt_vec4> rows(std::filesystem::file_size(path) / sizeof(minirt_vec4));
    auto* bytes = reinterpret_cast<uint8_t*>(rows.data());
    const size_t size = rows.size() * sizeof(minirt_vec4);
    std::ifstream(path, std::ios::binary).read(reinterpret_cast<char*>(bytes), static_cast<std::streamsize>(size));
    minirt_blob blob;
    REQUIRE(minirt_validate(bytes, size, &blob, nullptr) == MINIRT_OK);
    edit(blob);
    auto* header = reinterpret_cast<minirt_blob_header*>(bytes);
    auto* table = reinterpret_cast<minirt_blob_section*>(bytes + sizeof *header);
    for (uint32_t i = 0; i < header->section_count; ++i)
        table[i].checksum = minirt_checksum(bytes + table[i].offset, (table[i].size + 255) / 256 * 256);
    header->checksum = minirt_header_checksum(bytes, table[0].offset);
    std::ofstream(path, std::ios::binary).write(reinterpret_cast<const char*>(bytes), static_cast<std::streamsize>(size));
    minirt_validation validation;
    minirt_validate(bytes, size, nullptr, &validation);
    return validation.message;
}

/// No ray is dropped for being weak.
void followAllRays(const std::filesystem::path& path) {
    CHECK(change(path, [](minirt_blob& blob) { const_cast<minirt_scene_desc*>(blob.scene)->throughput_cutoff = 0; }).empty());
}

/// White all round a plate or a prism, that fill the picture.
std::string whiteScene(const std::string& mesh, const std::string& glass, const std::string& render) {
    return R"({"camera":{"position":[0.3,0.8,4],"target":[-0.1,0,0],"vfov":6},"background":{"color":[1,1,1]},
        "materials":{"g":{"model":"pbr","roughness":0,"transmission":1,)" +
           glass + R"(}},"objects":[{"mesh":")" + mesh + R"(.obj","material":"g"}],"render":{"size":[16,16],"maxDepth":30)" +
           render + "}}";
}

/// Largest deviation of a channel from white, and the root of the mean of their squares.
struct Deviation {
    double largest = 0;
    double rms = 0;
};

Deviation fromWhite(const Picture& picture) {
    Deviation result;
    for (uint32_t i = 0; i < picture.width * picture.height; ++i) {
        for (int k = 0; k < 3; ++k) {
            const double off = std::abs(picture.at(i % picture.width, i / picture.width)[k] - 1.0);
            result.largest = std::max(result.largest, off);
            result.rms += off * off;
        }
    }
    result.rms = std::sqrt(result.rms / (3.0 * picture.width * picture.height));
    return result;
}

Deviation whiteThrough(const GpuContext& gpu, const std::string& mesh, const std::string& glass, const std::string& render) {
    const TemporaryDir dir;
    dir.write("prism.obj", prismObj());
    dir.write("plate.obj", plateObj());
    const auto blob = bakeScene(dir, whiteScene(mesh, glass, render));
    followAllRays(blob);
    return fromWhite(LoadedScene(gpu, blob).render());
}

const std::string kSpectral = R"(,"dispersionMode":"spectral")";

}  // namespace

TEST_CASE("the shader's own curve and refraction bend five wavelengths through a prism as the formulas say") {
    double worst = 0;
    for (const char* name : {"bk7", "f2", "sf11", "fused_silica", "water"}) {
        const minirtc::Glass& glass = *findGlass(name);
        const auto curve = minirtc::disperse(glass).curve;
        for (const double wavelength : kWavelengths) {
            const double index = indexOf(glass, wavelength), incidence = (index > 1.7 ? 65 : 50) * kDegree;
            const auto c = static_cast<float>(1 / (wavelength * wavelength));
            const float eta = f32::indexOnCurve(glm::vec4(curve[0], curve[1], curve[2], curve[3]), static_cast<float>(curve[4]),
                                                static_cast<float>(curve[5]), c);
            const double in = incidence - kApex / 2;
            const glm::vec3 front(std::sin(kApex / 2), 0, std::cos(kApex / 2)), back(front.x, 0, -front.z);
            const glm::vec3 inside = f32::meetInterface(glm::vec3(std::sin(in), 0, -std::cos(in)), front, eta).refracted;
            const glm::vec3 out = f32::meetInterface(inside, -back, 1 / eta).refracted;
            worst = std::max(worst, std::abs(std::atan2(double{out.x}, -double{out.z}) - exitAngle(incidence, index)));
        }
    }
    MESSAGE("largest error of an exit angle ", worst, " rad");
    CHECK(worst < 1e-5);
}

TEST_CASE("rays leave a prism at the angles of its indices: five wavelengths one by one, and three channels at once") {
    const GpuContext gpu;
    if (!gpu) return;
    double worst = 0;
    const struct {
        const char* name;
        double degrees;
    } prisms[] = {{"BK7", 50}, {"SF11", 65}};
    for (const auto& prism : prisms) {
        const minirtc::Glass& glass = *findGlass(prism.name);
        const Bench bench(gpu, prism.degrees, indexOf(glass, 0.55));
        for (const double wavelength : kWavelengths) {
            const double index = indexOf(glass, wavelength);
            const double angle = bench.angles(R"("ior":)" + json(index), "").g;
            worst = std::max(worst, std::abs(angle - exitAngle(bench.incidence, index)));
        }
        const glm::dvec3 angles = bench.angles(R"("glass":")" + std::string(prism.name) + "\"", "");
        const double lines[] = {minirtc::kLineC, minirtc::kLineD, minirtc::kLineF};
        for (int k = 0; k < 3; ++k)
            worst = std::max(worst, std::abs(angles[k] - exitAngle(bench.incidence, indexOf(glass, lines[k]))));
        MESSAGE(std::string(prism.name), ": red and blue part by ", angles.r - angles.b, " rad");
        CHECK(angles.r > angles.g);
        CHECK(angles.g > angles.b);
    }
    MESSAGE("largest error of an exit angle ", worst, " rad");
    CHECK(worst < 1e-4);
}

TEST_CASE("the wavelengths of a sample leave a prism each at its own angle") {
    const GpuContext gpu;
    if (!gpu) return;
    const minirtc::Glass& glass = *findGlass("SF11");
    const auto waves = minirtc::whiteLight(1u << MINIRT_SPECTRUM_BITS);
    const Bench bench(gpu, 65, indexOf(glass, 0.55));
    double worst = 0;
    for (const uint32_t sample : {0u, 1u, 7u, 100u, 4000000000u}) {
        dvec3 expected(0), slope(0);  // by angle
        for (uint32_t k = 0; k < 4; ++k) {
            const auto& wave = waves[f32::wavelengthEntry(glm::uvec2(0), sample, k, MINIRT_SPECTRUM_BITS)];
            const double index = indexOf(glass, wave.micrometres);
            const dvec3 weight = wave.rgb / 4.0 * transmittance(bench.incidence, index);
            expected += weight * columnAt(exitAngle(bench.incidence, index), bench.first);
            slope += glm::abs(weight) / kRadiansAColumn;
        }
        const dvec3 seen = bench.see(R"("glass":"SF11")", "counts.hdr", kSpectral, sample);
        for (int k = 0; k < 3; ++k) worst = std::max(worst, std::abs(seen[k] - expected[k]) / slope[k]);
    }
    MESSAGE("as large as an error of all angles of ", worst, " rad");
    CHECK(worst < 1e-4);
}

TEST_CASE("white light stays white through glass that does not disperse, and through three channels of glass that does") {
    const GpuContext gpu;
    if (!gpu) return;
    for (const char* mesh : {"prism", "plate"}) {
        CHECK(whiteThrough(gpu, mesh, R"("ior":1.6)", "").largest < 1e-4);
        CHECK(whiteThrough(gpu, mesh, R"("ior":1.6)", kSpectral).largest < 1e-4);
        CHECK(whiteThrough(gpu, mesh, R"("glass":"SF11")", "").largest < 1e-4);
        CHECK(whiteThrough(gpu, mesh, R"("dispersion":0.5)", "").largest < 1e-4);
    }
}

TEST_CASE("wavelengths become white with the samples, nearly as fast as their number grows") {
    const GpuContext gpu;
    if (!gpu) return;
    std::vector<double> deviations;
    for (const uint32_t samples : {1u, 4u, 16u, 64u, 256u}) {
        const Deviation d = whiteThrough(gpu, "plate", R"("glass":"SF11")", kSpectral + R"(,"spp":)" + std::to_string(samples));
        MESSAGE(samples, " samples: rms ", d.rms, ", largest ", d.largest);
        deviations.push_back(d.rms);
    }
    const double rate = std::log(deviations.front() / deviations.back()) / std::log(256.0);
    MESSAGE("deviation falls as samples to the power of ", -rate);
    CHECK(rate > 0.75);
    CHECK(deviations.back() < 3e-3);
}

TEST_CASE("without a medium that disperses the mode leaves no trace, and with one only in its own kernel") {
    const TemporaryDir dir;
    dir.write("plate.obj", plateObj());
    const auto bake = [&](const std::string& glass, const std::string& render) {
        const auto path = bakeScene(dir, whiteScene("plate", glass, render));
        std::ifstream file(path, std::ios::binary);
        return std::string(std::istreambuf_iterator<char>(file), {});
    };
    const auto has = [](const std::string& bytes, const char* text) { return bytes.find(text) != std::string::npos; };
    const std::string plain = bake(R"("ior":1.5)", "");
    CHECK(plain == bake(R"("ior":1.5)", kSpectral));
    CHECK_FALSE(has(plain, "SPECTRUM"));
    CHECK(has(plain, R"("dispersion":{"included":false)"));
    const std::string rgb = bake(R"("glass":"BK7")", ""), spectral = bake(R"("glass":"BK7")", kSpectral);
    CHECK_FALSE(has(rgb, "SPECTRUM"));
    CHECK(has(spectral, "SPECTRUM"));
    CHECK(has(rgb, R"("dispersion":{"included":true)"));
    CHECK(has(spectral, R"("spectral":{"included":true)"));

    minirtc::EffectSet none, all;
    includeAll(all);
    CHECK_FALSE(all.has(minirtc::Effect::spectral));
    CHECK(minirtc::compileKernel("whitted", none).glsl.find("#define EFFECT_DISPERSION") == std::string::npos);
    CHECK(minirtc::compileKernel("whitted", all).waits == 3);
}

TEST_CASE("a spectrum that is none is no part of a valid blob") {
    const auto broken = [](const std::function<void(minirt_vec4*, minirt_kernel*)>& edit) {
        const TemporaryDir dir;
        dir.write("plate.obj", plateObj());
        return change(bakeScene(dir, whiteScene("plate", R"("glass":"F2")", kSpectral)), [&](minirt_blob& blob) {
            edit(const_cast<minirt_vec4*>(blob.spectrum), const_cast<minirt_kernel*>(blob.kernels));
        });
    };
    CHECK(broken([](minirt_vec4*, minirt_kernel*) {}).empty());
    CHECK(broken([](minirt_vec4* rows, minirt_kernel*) { rows[7].w = 0; }) == "entry 7 of the spectrum has no wavelength");
    CHECK(broken([](minirt_vec4* rows, minirt_kernel*) { rows[7].y = INFINITY; }) ==
          "the spectrum holds a number that is not finite");
    const TemporaryDir dir;
    dir.write("plate.obj", plateObj());
    CHECK(change(bakeScene(dir, whiteScene("plate", R"("glass":"F2")", "")), [](minirt_blob& blob) {
              const_cast<minirt_kernel*>(blob.kernels)->bindings |= 1u << MINIRT_BINDING_SPECTRUM;
          }) == "kernel 0 reads a spectrum that is not there");
}

TEST_CASE("a gem 64 deep has numbers in every pixel and room for every ray, and cutting its work into pieces changes nothing") {
    const GpuContext gpu;
    if (!gpu) return;
    for (const std::string& mode : {std::string(), kSpectral}) {
        for (const int depth : {0, 1, 2, 64}) {
            const TemporaryDir dir;
            writeObj(samples::brilliantCut(), dir.path() / "gem.obj");
            const auto blob =
                bakeScene(dir, R"({"camera":{"position":[0.4,3,2],"target":[0,0,0],"vfov":40},"background":{"color":[0.6,0.8,1]},
                "lights":[{"type":"point","position":[3,5,2],"intensity":[20,20,20]}],
                "materials":{"g":{"model":"pbr","roughness":0,"transmission":1,"glass":"diamond"},"f":{"model":"phong"}},
                "objects":[{"mesh":"gem.obj","material":"g"},{"rectangle":{"origin":[-4,-1,4],"u":[8,0,0],"v":[0,0,-8]},"material":"f"}],
                "render":{"size":[24,24],"maxDepth":)" +
                                   std::to_string(depth) + mode + "}}");
            const Picture whole = LoadedScene(gpu, blob).render();
            if (depth != 2) continue;
            const GpuContext hasty;
            test::setStepBudget(hasty.get(), 60);
            const Picture pieces = LoadedScene(hasty, blob).render();
            CHECK(pieces.stats.resumed_dispatches > 0);
            CHECK(pieces == whole);
        }
    }
}

TEST_CASE("shadows through glass of light that has not parted are those of one index") {
    const GpuContext gpu;
    if (!gpu) return;
    const auto floorUnder = [&](const std::string& glass) {
        const TemporaryDir dir;
        dir.write("plate.obj", plateObj());
        return renderScene(gpu, dir,
                           R"({"camera":{"position":[0,3,0],"target":[0,0,-0.1],"vfov":40},
            "lights":[{"type":"point","position":[1,9,1],"intensity":[90,80,70]}],
            "materials":{"g":{"model":"pbr","roughness":0,"transmission":1,)" +
                               glass + R"(},"f":{"model":"phong"}},
            "objects":[{"mesh":"plate.obj","rotate":[90,0,0],"translate":[0,5,0],"material":"g"},
                       {"rectangle":{"origin":[-4,0,4],"u":[8,0,0],"v":[0,0,-8]},"material":"f"}],"render":{"size":[8,8]}})");
    };
    const Picture plain = floorUnder(R"("ior":)" + json(indexOf(*findGlass("SF11"), minirtc::kLineD)));
    CHECK(plain == floorUnder(R"("glass":"SF11")"));
    CHECK(plain.at(4, 4).r > 0.1f);
}
