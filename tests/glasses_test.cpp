// Indices of refraction against catalogues and papers, their curves, and white light as wavelengths.
#include "glasses.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "error.hpp"
#include "spectrum.hpp"
#include "support.hpp"

using namespace minirtc;

namespace {

/// Catalogue values: n_F, n_d, n_C and the Abbe number; 0 where the source gives none.
struct Known {
    const char* name;
    double f, d, c, abbe;
    double allowed = 1.1e-5;
};

const Known kKnown[] = {
    {"BK7", 1.52238, 1.51680, 1.51432, 64.17},     // SCHOTT data sheet
    {"F2", 1.63208, 1.62004, 1.61503, 36.37},      // SCHOTT data sheet
    {"SF11", 1.80645, 1.78472, 1.77599, 25.76},    // SCHOTT data sheet
    {"N-SF11", 1.80651, 1.78472, 1.77596, 25.68},  // SCHOTT data sheet
    {"N-SF66", 1.95459, 1.92286, 1.91039, 20.88},  // SCHOTT data sheet
    {"fused_silica", 1.46313, 1.45846, 1.45637, 67.82},
    {"diamond", 2.43555, 2.41748, 2.40990, 55.28, 2e-5},
    {"water", 1.33749, 1.33340, 1.33151, 55.7},
    {"ice", 1.3137, 1.3098, 1.3079, 53, 1e-4},  // from a table of four decimals
    {"ethanol", 0, 1.36168, 0, 0},
    {"sapphire", 0, 1.76817, 0, 72.3},
    {"cubic_zirconia", 0, 2.1588, 0, 33.5, 1e-4},
};

/// What the loader makes of a pbr material with these members.
Material load(const std::string& members) {
    const test::TemporaryDir dir;
    const auto path =
        dir.write("s.json", R"({"background":{"color":[1,1,1]},"materials":{"m":{"model":"pbr","roughness":0,"transmission":1,)" +
                                members + R"(}},"objects":[{"sphere":{},"material":"m"}]})");
    Diagnostics diagnostics;
    return loadScene(path, diagnostics).materials[0];
}

std::string mistake(const std::string& members) {
    try {
        load(members);
    } catch (const Error& error) {
        const std::string text = error.what();
        return text.substr(text.find(": ") + 2);
    }
    return "none";
}

}  // namespace

TEST_CASE("glasses have the indices and the Abbe numbers of the catalogues") {
    for (const Known& known : kKnown) {
        CAPTURE(std::string(known.name));
        const Glass* glass = findGlass(known.name);
        REQUIRE(glass);
        const double f = indexOf(*glass, kLineF), d = indexOf(*glass, kLineD), c = indexOf(*glass, kLineC);
        CHECK(std::abs(d - known.d) <= known.allowed);
        if (known.f > 0) CHECK(std::abs(f - known.f) <= known.allowed);
        if (known.c > 0) CHECK(std::abs(c - known.c) <= known.allowed);
        if (known.abbe > 0) CHECK((d - 1) / (f - c) == doctest::Approx(known.abbe).epsilon(0.002));
        const Dispersion dispersion = disperse(*glass);
        CHECK(dispersion.channels == glm::dvec3(c, d, f));
    }
    CHECK(std::size(kKnown) == glassNames().size());
}

TEST_CASE("curves follow their formulas within 1e-5 over the visible spectrum, in float too") {
    double worst = 0;
    for (const std::string& name : glassNames()) {
        const Glass& glass = *findGlass(name);
        const IndexCurve curve = disperse(glass).curve;
        double error = 0, inFloat = 0;
        for (int i = 0; i <= 4000; ++i) {
            const double wavelength = kVisibleFrom + (kVisibleTo - kVisibleFrom) * i / 4000;
            error = std::max(error, std::abs(indexOn(curve, wavelength) - indexOf(glass, wavelength)));
            float sum = 0;
            const auto c = static_cast<float>(1 / (wavelength * wavelength));
            for (size_t k = curve.size(); k-- > 1;) sum = sum * c + static_cast<float>(curve[k]);
            sum += static_cast<float>(curve[0]) / c;
            inFloat = std::max(inFloat, std::abs(sum - indexOf(glass, wavelength)));
        }
        MESSAGE(name, ": ", error, ", in float ", inFloat);
        worst = std::max(worst, inFloat);
    }
    CHECK(worst < 1e-5);
}

TEST_CASE("KHR_materials_dispersion has the index and the Abbe number that it was given") {
    for (const double ior : {1.5, 2.42, 0.75}) {
        for (const double abbe : {20.0, 64.0}) {
            const Dispersion d = disperse(ior, 20 / abbe);
            for (const double nm : {380.0, 450.0, 587.6, 700.0, 780.0})
                CHECK(indexOn(d.curve, nm / 1000) ==
                      doctest::Approx(ior + (ior - 1) / abbe * (523655 / (nm * nm) - 1.5168)).epsilon(1e-12));
            CHECK(indexOn(d.curve, kLineD) == doctest::Approx(ior).epsilon(1e-5));
            CHECK((ior - 1) / (indexOn(d.curve, kLineF) - indexOn(d.curve, kLineC)) == doctest::Approx(abbe).epsilon(1e-3));
            CHECK((ior - 1) / (d.channels.b - d.channels.r) == doctest::Approx(abbe).epsilon(1e-12));
            CHECK(d.channels.g == ior);
            CHECK(d.channels.b - ior == doctest::Approx((ior - 1) * 0.025 * 20 / abbe).epsilon(1e-12));
        }
    }
}

TEST_CASE("a glass brings its index and its dispersion, by any spelling of its name") {
    for (const char* name : {"BK7", "bk7", "N-BK7", "nbk7"}) {
        const Material m = load(R"("glass":")" + std::string(name) + "\"");
        CHECK(m.ior == doctest::Approx(1.5168).epsilon(1e-6));
        REQUIRE(m.medium.dispersion);
        CHECK(m.medium.dispersion->channels.b == doctest::Approx(1.52238).epsilon(1e-5));
    }
    CHECK(findGlass("Fused Silica") == findGlass("fused_silica"));
    CHECK(findGlass("n-sf11") != findGlass("sf11"));
    CHECK_FALSE(load(R"("ior":1.5)").medium.dispersion);
    CHECK_FALSE(load(R"("ior":1.5,"dispersion":0)").medium.dispersion);
    CHECK_FALSE(load(R"("ior":1,"dispersion":0.5)").medium.dispersion);  // nothing bends, nothing parts
    CHECK(load(R"("dispersion":0.36)").medium.dispersion->channels.r == doctest::Approx(1.4955));
}

TEST_CASE("mistakes with glasses say what to do") {
    CHECK(mistake(R"("glass":"diamant")") == "there is no glass 'diamant'; did you mean 'diamond'?");
    CHECK(mistake(R"("glass":"BK8")") == "there is no glass 'BK8'; did you mean 'bk7'?");
    CHECK(mistake(R"("glass":"BK7","ior":1.5)") == "'ior' stands beside 'glass', which brings its own; keep one of them");
    CHECK(mistake(R"("dispersion":0,"glass":"BK7")") ==
          "'dispersion' stands beside 'glass', which brings its own; keep one of them");
    CHECK(mistake(R"("dispersion":100)") ==
          "with this 'dispersion' the index of refraction is not over 0 for all visible light; glasses have 0.2 to 1: it is 20 "
          "over the "
          "Abbe number");
}

TEST_CASE("colour matching functions and daylight are the tables of the CIE") {
    glm::dvec3 equal(0), white(0);
    for (size_t i = 0; i < kSpectrumSteps; ++i) {
        equal += colorMatching()[i];
        white += colorMatching()[i] * minirtc::daylight()[i];
    }
    // CIE 15:2004, Colorimetry: the sums of the table from 360 to 830 nm every 1 nm.
    CHECK(equal.x * 5 == doctest::Approx(106.865469).epsilon(1e-4));
    CHECK(equal.y * 5 == doctest::Approx(106.856917).epsilon(1e-5));
    CHECK(equal.z * 5 == doctest::Approx(106.892251).epsilon(4e-4));
    const double sum = white.x + white.y + white.z;
    CHECK(std::abs(white.x / sum - 0.3127) < 5e-5);
    CHECK(std::abs(white.y / sum - 0.3290) < 5e-5);
    const glm::dvec3 rgb = linearSrgb(white / white.y);
    for (int k = 0; k < 3; ++k) CHECK(rgb[k] == doctest::Approx(1).epsilon(2e-4));
}

TEST_CASE("white light is white in the mean, within the visible spectrum, and no wavelength weighs much") {
    for (const size_t count : {size_t{64}, size_t{1024}}) {
        const std::vector<Wavelength> waves = whiteLight(count);
        REQUIRE(waves.size() == count);
        glm::dvec3 mean(0);
        glm::vec3 inFloat(0);
        double largest = 0;
        for (size_t i = 0; i < count; ++i) {
            mean += waves[i].rgb / static_cast<double>(count);
            inFloat += glm::vec3(waves[i].rgb) / static_cast<float>(count);
            largest = std::max({largest, std::abs(waves[i].rgb.r), std::abs(waves[i].rgb.g), std::abs(waves[i].rgb.b)});
            CHECK(waves[i].micrometres >= (i == 0 ? kVisibleFrom : waves[i - 1].micrometres));
            CHECK(waves[i].micrometres <= kVisibleTo);
        }
        for (int k = 0; k < 3; ++k) {
            CHECK(mean[k] == doctest::Approx(1).epsilon(1e-12));
            CHECK(inFloat[k] == doctest::Approx(1).epsilon(1e-5));
        }
        CHECK(largest < 5);
        // Red, green and blue where they belong.
        CHECK(waves[count * 95 / 100].rgb.r > 3);
        CHECK(waves[count / 2].rgb.g > 2);
        CHECK(waves[count / 20].rgb.b > 3);
    }
}
