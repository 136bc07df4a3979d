#include <doctest/doctest.h>

#include <algorithm>
#include <functional>
#include <string>

#include "exact.hpp"
#include "glsl.hpp"
#include "random.hpp"
#include "shader_library.hpp"
#include "shader_source.hpp"
#include "statistics.hpp"

using glm::dvec2;
using glm::dvec3;
using glm::uvec2;
using glm::vec2;
using glm::vec3;
using test::exact;
using test::exact3;
using test::Random;
using test::sidakLevel;
using test::SphereGrid;
using test::SquareCounts;

namespace {

constexpr int kSamples = 1000000;
constexpr double kTurn = 6.283185307179586;
constexpr float kLast = 1 - 0x1p-24f;  // the greatest number that unitReal gives

/// A point of the square as unitReal makes its coordinates.
vec2 point(Random& random) {
    const float x = f32::unitReal(static_cast<uint32_t>(random.uniform() * 0x1p32));
    return {x, f32::unitReal(static_cast<uint32_t>(random.uniform() * 0x1p32))};
}

/// Sobol's sequence as his paper builds it: direction numbers by the recurrence of a primitive polynomial, one XOR a bit of the index.
uvec2 sobolByDirections(uint32_t index) {
    uint32_t m = 1;
    uvec2 result(0);
    for (int bit = 0; bit < 32; ++bit) {
        if (index >> bit & 1) {
            result.x ^= 0x80000000u >> bit;  // dimension 1: van der Corput
            result.y ^= m << (31 - bit);     // dimension 2: polynomial x + 1
        }
        m = m << 1 ^ m;
    }
    return result;
}

uint32_t reversed(uint32_t x) {
    uint32_t result = 0;
    for (int bit = 0; bit < 32; ++bit) result |= (x >> bit & 1) << (31 - bit);
    return result;
}

/// Whether each of the elementary boxes of area 1 / count holds one of the first `count` = 2^k points.
bool isNet(const std::vector<uvec2>& points, int k) {
    for (int rows = 0; rows <= k; ++rows) {
        std::vector<bool> taken(size_t{1} << k);
        for (uint32_t i = 0; i < 1u << k; ++i) {
            const uint64_t row = static_cast<uint64_t>(points[i].y) >> (32 - rows);
            const uint64_t column = static_cast<uint64_t>(points[i].x) >> (32 - (k - rows));
            const size_t box = row << (k - rows) | column;
            if (taken[box]) return false;
            taken[box] = true;
        }
    }
    return true;
}

/// L2 star discrepancy (Warnock 1972).
double starDiscrepancy(const std::vector<dvec2>& p) {
    const auto n = static_cast<double>(p.size());
    double single = 0;
    double pairs = 0;
    for (const dvec2& a : p) {
        single += (1 - a.x * a.x) * (1 - a.y * a.y) / 4;
        for (const dvec2& b : p) pairs += (1 - std::max(a.x, b.x)) * (1 - std::max(a.y, b.y));
    }
    return std::sqrt(1.0 / 9 - 2 / n * single + pairs / (n * n));
}

using Source = std::function<vec2(uint32_t pixel, uint32_t sampleIndex, uint32_t pair)>;

const Source kRandom = [](uint32_t pixel, uint32_t i, uint32_t pair) { return f32::randomPair(uvec2(pixel, 7), i, 0, pair); };
const Source kSobol = [](uint32_t pixel, uint32_t i, uint32_t pair) { return f32::sobolPair(uvec2(pixel, 7), i, 0, pair); };

/// Root mean square error over 64 pixels of the mean of `count` samples of a smooth integrand over `pairs` pairs of dimensions.
double meanError(const Source& source, uint32_t count, uint32_t pairs) {
    double sum2 = 0;
    for (uint32_t pixel = 0; pixel < 64; ++pixel) {
        double sum = 0;
        for (uint32_t i = 0; i < count; ++i) {
            double f = 1;
            for (uint32_t pair = 0; pair < pairs; ++pair) {
                const dvec2 u(source(pixel, i, pair));
                f *= std::exp(-u.x * u.y) * (1 + u.x * u.x);
            }
            sum += f;
        }
        // The integral over a pair: of (1 + x^2) (1 - exp(-x)) / x over x.
        static const double kIntegral = [] {
            double integral = 0;
            for (int k = 0; k < 100000; ++k) {
                const double x = (k + 0.5) / 100000;
                integral += (1 + x * x) * -std::expm1(-x) / x / 100000;
            }
            return integral;
        }();
        const double error = sum / count - std::pow(kIntegral, pairs);
        sum2 += error * error;
    }
    return std::sqrt(sum2 / 64);
}

double pUniform2D(const std::function<vec2(uint32_t)>& pointAt, uint32_t count) {
    SquareCounts counts;
    for (uint32_t i = 0; i < count; ++i) {
        const vec2 u = pointAt(i);
        counts.add(u.x, u.y);
    }
    return counts.pUniform();
}

/// p-value of the correlation of two coordinates that are uniform and independent.
double pUncorrelated(const std::function<vec2(uint32_t)>& pointAt, uint32_t count) {
    double sum = 0;
    for (uint32_t i = 0; i < count; ++i) {
        const dvec2 u(pointAt(i));
        sum += (u.x - 0.5) * (u.y - 0.5) * 12;
    }
    return std::erfc(std::abs(sum) / std::sqrt(2.0 * count));
}

}  // namespace

TEST_CASE("the tail of chi-squared is that of tables") {
    CHECK(test::chiSquaredTail(3.841458820694124, 1) == doctest::Approx(0.05).epsilon(1e-10));
    CHECK(test::chiSquaredTail(2, 2) == doctest::Approx(std::exp(-1.0)).epsilon(1e-12));
    CHECK(test::chiSquaredTail(40, 2) == doctest::Approx(std::exp(-20.0)).epsilon(1e-10));
    CHECK(test::chiSquaredTail(124.342, 100) == doctest::Approx(0.05).epsilon(1e-4));
    CHECK(test::chiSquaredTail(13174.19, 12799) == doctest::Approx(0.01).epsilon(5e-3));  // by Wilson and Hilferty
}

TEST_CASE("the tails of Student's t are those of tables") {
    CHECK(test::studentTail(12.706204736432095, 1) == doctest::Approx(0.05).epsilon(1e-10));
    CHECK(test::studentTail(1, 1) == doctest::Approx(0.5).epsilon(1e-12));
    CHECK(test::studentTail(-2.0422724563012373, 30) == doctest::Approx(0.05).epsilon(1e-10));
    CHECK(test::studentTail(4, 2) == doctest::Approx(1 - 4 / std::sqrt(18.0)).epsilon(1e-12));
    CHECK(test::studentTail(4.891638475698931, 1e6) == doctest::Approx(1e-6).epsilon(1e-4));  // nearly the normal one
    CHECK(test::welchP({1, 2, 3, 4}, {1, 2, 3, 4}) == 1);
    CHECK(test::welchP({1, 2, 3, 4, 5}, {3, 4, 5, 6, 7}) == doctest::Approx(0.0805).epsilon(1e-3));  // t = -2, 8 degrees
}

TEST_CASE("the files are GLSL as well") {
    std::string source = "#version 460\n#extension GL_EXT_control_flow_attributes : require\n";
    source += "#define MINIRT_FILTER_TENT 1u\n#define MINIRT_FILTER_GAUSSIAN 2u\n";
    for (const char* part :
         {"common/language.glsl", "common/neighbours.glsl", "common/numerics.glsl", "bsdf/optics.glsl", "sampling/random.glsl",
          "sampling/warp.glsl", "sampling/cells.glsl", "sampling/filter.glsl", "bsdf/microfacet.glsl"}) {
        source += minirtc::shaderLibrary().at(part);
    }
    source += "void main() {}\n";
    const test::ParsedGlsl glsl = test::parseGlsl(source);
    INFO(glsl.shader->getInfoLog());
    CHECK(glsl.parsed);
}

TEST_CASE("the hash is pcg4d and reals are multiples of 2^-24 below 1") {
    // By a straightforward implementation in another language.
    CHECK(f32::hashBits(glm::uvec4(0)) == glm::uvec4(0xf02f829u, 0x2d568769u, 0x32b0c43bu, 0xd32548eau));
    CHECK(f32::hashBits(glm::uvec4(1, 2, 3, 4)) == glm::uvec4(0x3622cd16u, 0xf11471d8u, 0xe1109b3fu, 0x2b94c2fu));
    CHECK(f32::hashBits(glm::uvec4(0xffffffffu, 1919, 1079, 65535)) ==
          glm::uvec4(0x1159c7b1u, 0x6080da07u, 0xd17f21bau, 0x99b9875u));
    CHECK(f32::unitReal(0xffffffffu) == kLast);
    CHECK(f32::unitReal(0xffu) == 0);
    CHECK(f32::unitReal(0x100u) == 0x1p-24f);
    int differ = 0;
    for (uint32_t i = 0; i < 100000; ++i) {
        const uvec2 pixel(i % 317, i / 317);
        differ += dvec2(f32::randomPair(pixel, i, 3, 5)) != f64::randomPair(pixel, i, 3, 5);
        differ += dvec2(f32::sobolPair(pixel, i, 3, 5)) != f64::sobolPair(pixel, i, 3, 5);
    }
    CHECK(differ == 0);
}

TEST_CASE("random numbers are uniform and independent of their neighbours") {
    // Pixels of a picture 1000 wide, or the samples of a pixel.
    const auto inPicture = [](uint32_t i) { return uvec2(i % 1000, i / 1000); };
    const struct {
        std::string name;
        std::function<vec2(uint32_t)> pointAt;
    } cases[] = {
        {"over pixels", [&](uint32_t i) { return f32::randomPair(inPicture(i), 0, 0, 0); }},
        {"over samples", [&](uint32_t i) { return f32::randomPair(uvec2(123, 456), i, 2, 1); }},
        {"over bounces and dimensions", [&](uint32_t i) { return f32::randomPair(uvec2(5, 6), 7, i % 1000, i / 1000); }},
        {"pixel, next pixel",
         [&](uint32_t i) {
             return vec2(f32::randomPair(inPicture(i), 1, 0, 0).x, f32::randomPair(inPicture(i) + uvec2(1, 0), 1, 0, 0).x);
         }},
        {"pixel, pixel below",
         [&](uint32_t i) {
             return vec2(f32::randomPair(inPicture(i), 1, 1, 0).y, f32::randomPair(inPicture(i) + uvec2(0, 1), 1, 1, 0).y);
         }},
        {"sample, next sample",
         [&](uint32_t i) { return vec2(f32::randomPair(inPicture(i), 4, 0, 0).x, f32::randomPair(inPicture(i), 5, 0, 0).x); }},
        {"bounce, next bounce",
         [&](uint32_t i) { return vec2(f32::randomPair(inPicture(i), 0, 1, 3).y, f32::randomPair(inPicture(i), 0, 2, 3).x); }},
        {"dimension, next dimension",
         [&](uint32_t i) { return vec2(f32::randomPair(inPicture(i), 0, 1, 0).x, f32::randomPair(inPicture(i), 0, 1, 1).x); }},
        {"low bits",
         [&](uint32_t i) {
             const glm::uvec4 bits = f32::hashBits(glm::uvec4(inPicture(i), 0, 0));
             return vec2(f32::unitReal(bits.z << 24 | (bits.x & 0xff) << 16), f32::unitReal(bits.w << 20));
         }},
        {"Sobol over pixels", [&](uint32_t i) { return f32::sobolPair(inPicture(i), 0, 0, 0); }},
        {"Sobol pixel, next pixel",
         [&](uint32_t i) {
             return vec2(f32::sobolPair(inPicture(i), 3, 0, 0).x, f32::sobolPair(inPicture(i) + uvec2(1, 0), 3, 0, 0).x);
         }},
        {"Sobol pair, next pair, over pixels",
         [&](uint32_t i) { return vec2(f32::sobolPair(inPicture(i), 9, 1, 0).x, f32::sobolPair(inPicture(i), 9, 1, 1).x); }},
        {"Sobol sample, next sample, over pixels",
         [&](uint32_t i) { return vec2(f32::sobolPair(inPicture(i), 8, 1, 0).x, f32::sobolPair(inPicture(i), 11, 1, 0).y); }},
    };
    const double level = sidakLevel(2 * static_cast<int>(std::size(cases)));
    double least = 1;
    for (const auto& c : cases) {
        INFO(c.name);
        const double p = pUniform2D(c.pointAt, kSamples);
        const double pCorrelation = pUncorrelated(c.pointAt, kSamples);
        MESSAGE(c.name, ": p ", p, ", of the correlation ", pCorrelation);
        CHECK(p > level);
        CHECK(pCorrelation > level);
        least = std::min({least, p, pCorrelation});
    }
    MESSAGE("least of ", std::size(cases), " and as many p-values ", least, ", level ", level);
}

TEST_CASE("each coordinate alone is uniform over 4096 bins") {
    const double level = sidakLevel(4);
    for (uint32_t k = 0; k < 4; ++k) {
        std::vector<double> counts(4096);
        for (uint32_t i = 0; i < kSamples; ++i) {
            const glm::uvec4 bits = f32::hashBits(glm::uvec4(i % 1000, i / 1000, 16, 3u << 16));
            const uint32_t word = k == 0 ? bits.x : k == 1 ? bits.y : k == 2 ? bits.z : bits.w;
            counts[word >> 20] += 1;
        }
        CHECK(test::chiSquaredP(counts, std::vector<double>(4096, kSamples / 4096.0)) > level);
    }
}

TEST_CASE("Sobol's points are those of his direction numbers, bit for bit") {
    int wrong = 0;
    Random random(5);
    for (uint32_t i = 0; i < 200000; ++i) {
        const uint32_t index = i < 100000 ? i : static_cast<uint32_t>(random.uniform() * 0x1p32);
        wrong += f32::sobolBits(index) != sobolByDirections(index);
        const uint32_t seed = static_cast<uint32_t>(random.uniform() * 0x1p32);
        wrong += f32::owenScramble(index, seed) != reversed(f32::scrambleUpwards(reversed(index), seed));
    }
    CHECK(wrong == 0);
    // The short way that skips reversals gives what the definition gives.
    for (uint32_t i = 0; i < 10000; ++i) {
        const glm::uvec4 seed = f32::hashBits(glm::uvec4(i, 3, 0x50b01e57u, 2u << 16 | 4u));
        const uvec2 plain = sobolByDirections(f32::owenScramble(i % 777, seed.x));
        wrong += f32::sobolPairBits(uvec2(i, 3), i % 777, 2, 4) !=
                 uvec2(f32::owenScramble(plain.x, seed.y), f32::owenScramble(plain.y, seed.z));
    }
    CHECK(wrong == 0);
}

TEST_CASE("scrambling is nested: a bit changes no bit above it, and always itself") {
    Random random(6);
    int wrong = 0;
    std::vector<double> flips(32);
    for (int i = 0; i < 100000; ++i) {
        const auto x = static_cast<uint32_t>(random.uniform() * 0x1p32);
        const auto seed = static_cast<uint32_t>(random.uniform() * 0x1p32);
        const uint32_t scrambled = f32::owenScramble(x, seed);
        const uint32_t bit = random.index(32);
        const uint32_t changed = scrambled ^ f32::owenScramble(x ^ 1u << bit, seed);
        wrong += changed >> bit != 1u;
        for (int b = 0; b < 32; ++b) flips[b] += (scrambled ^ x) >> b & 1;
    }
    CHECK(wrong == 0);
    double worst = 0;
    for (const double f : flips) worst = std::max(worst, std::abs(f - 50000) / std::sqrt(25000));
    MESSAGE("share of flips of a bit: at most ", worst, " sigma from 1/2");
    CHECK(std::erfc(worst / std::sqrt(2.0)) > sidakLevel(32));
}

TEST_CASE("the first 2^k samples of each pixel and pair are a net") {
    int broken = 0;
    for (uint32_t seed = 0; seed < 40; ++seed) {
        std::vector<uvec2> bits;
        std::vector<uvec2> reals;
        for (uint32_t i = 0; i < 4096; ++i) {
            bits.push_back(f32::sobolPairBits(uvec2(seed * 31, seed), i, seed % 5, seed / 5));
            const vec2 u = f32::sobolPair(uvec2(seed * 31, seed), i, seed % 5, seed / 5);
            reals.emplace_back(dvec2(u) * 0x1p32);
        }
        for (int k = 0; k <= 12; ++k) broken += !isNet(bits, k) + !isNet(reals, k);
    }
    CHECK(broken == 0);
}

TEST_CASE("Sobol's means converge faster than random ones") {
    for (const uint32_t pairs : {1u, 2u}) {
        const double randomFew = meanError(kRandom, 64, pairs);
        const double randomMany = meanError(kRandom, 4096, pairs);
        const double sobolFew = meanError(kSobol, 64, pairs);
        const double sobolMany = meanError(kSobol, 4096, pairs);
        const double randomRate = std::log2(randomFew / randomMany) / 6;
        const double sobolRate = std::log2(sobolFew / sobolMany) / 6;
        MESSAGE(pairs, " pairs, error at 64 and 4096 samples: random ", randomFew, " ", randomMany, " (rate ", randomRate,
                "), Sobol ", sobolFew, " ", sobolMany, " (rate ", sobolRate, ")");
        CHECK(randomRate == doctest::Approx(0.5).epsilon(0.2));
        if (pairs == 1) CHECK(sobolRate > 1.3);  // 1.5 in theory, less logarithms
        CHECK(sobolMany < randomMany * (pairs == 1 ? 0.02 : 0.5));
    }
    double ratio = 0;
    for (uint32_t pixel = 0; pixel < 8; ++pixel) {
        std::vector<dvec2> sobol;
        std::vector<dvec2> random;
        for (uint32_t i = 0; i < 1024; ++i) {
            sobol.emplace_back(kSobol(pixel, i, 0));
            random.emplace_back(kRandom(pixel, i, 0));
        }
        ratio = std::max(ratio, starDiscrepancy(sobol) / starDiscrepancy(random));
    }
    MESSAGE("L2 star discrepancy of 1024 points over that of random ones: at most ", ratio);
    CHECK(ratio < 0.2);
}

TEST_CASE("cosines and sines of turns") {
    double worst = 0;
    double worst64 = 0;
    for (int i = 0; i <= 1 << 16; ++i) {
        const double u = i / 65536.0;
        const dvec2 right(std::cos(u * kTurn), std::sin(u * kTurn));
        worst = std::max(worst, glm::length(dvec2(f32::cosSinTurns(static_cast<float>(u))) - right));
        worst64 = std::max(worst64, glm::length(f64::cosSinTurns(u) - right));
    }
    MESSAGE("error in float ", worst, ", in double ", worst64);
    CHECK(worst < 1.5e-7);
    CHECK(worst64 < 3e-9);
}

TEST_CASE("samplers follow their densities") {
    const vec3 p(1, 2, 3);
    const vec3 center(2.5f, 1, 4);
    const double centerDistance = glm::length(dvec3(center) - dvec3(p));
    const dvec3 axis = (dvec3(center) - dvec3(p)) / centerDistance;
    const SphereGrid upright;
    const auto direction = [](const SphereGrid& grid, SquareCounts& counts, const vec3& w) {
        grid.count(counts, glm::normalize(dvec3(w)));
    };
    const auto cone = [](SquareCounts& counts, const dvec3& w, double height) {
        const double turn = std::atan2(w.y, w.x) / kTurn;
        counts.add((w.x * w.x + w.y * w.y) / (1 + w.z) / height, turn < 0 ? turn + 1 : turn);
    };
    const auto sphereCone = [&](SquareCounts& counts, const vec2& u, double share) {
        const auto radius = static_cast<float>(centerDistance * share);
        const dvec3 w = glm::normalize(dvec3(f32::sampleSphereLight(p, center, radius, u).wi));
        const f64::Basis basis = f64::basisAround(axis);
        const double sine = radius / centerDistance;
        cone(counts, f64::intoBasis(basis, w), sine * sine / (1 + std::sqrt(1 - sine * sine)));
    };
    // Height below the pole and longitude over a cell; -Y is mirrored up, where heights are exact.
    const auto cell = [](SquareCounts& counts, const vec2& u, uvec2 at, uvec2 size) {
        const dvec3 w(f32::directionInCell(at.x, at.y, size.x, size.y, 0.3f, u));
        const bool lower = at.y >= (size.y + 1) / 2;
        const double row = lower ? size.y - 1 - at.y : at.y;
        const double height = (w.x * w.x + w.z * w.z) / (1 + std::abs(w.y));
        const double down = (lower ? -w.y : w.y) > 0 ? height : 2 - height;
        const auto edge = [&](double k) { return 2 * std::pow(std::sin(kTurn / 4 * k / size.y), 2); };
        const double turn = std::atan2(w.z, w.x) / kTurn + 0.5 + 0.3f;
        const double across = (turn - std::floor(turn)) * size.x - at.x;
        if (std::abs(across - 0.5) > 0.51) return counts.addOutside();
        counts.add((down - edge(row)) / (edge(row + 1) - edge(row)), across);
    };
    const auto tent = [](double x) { return x < 0 ? (1 + x) * (1 + x) / 2 : 1 - (1 - x) * (1 - x) / 2; };
    const std::vector<double> flat;
    const struct {
        std::string name;
        std::function<void(SquareCounts&, const vec2&)> add;
        std::vector<double> shares;  // empty: uniform
    } cases[] = {
        {"concentric disk",
         [](SquareCounts& counts, const vec2& u) {
             const dvec2 q(f32::concentricDisk(u));
             const double turn = std::atan2(q.y, q.x) / kTurn;
             counts.add(glm::dot(q, q), turn < 0 ? turn + 1 : turn);
         },
         flat},
        {"cosine hemisphere", [&](SquareCounts& counts, const vec2& u) { direction(upright, counts, f32::cosineHemisphere(u)); },
         upright.shares([](const dvec3& w) { return f64::cosineHemispherePdf(w.z); })},
        {"sphere", [&](SquareCounts& counts, const vec2& u) { direction(upright, counts, f32::uniformSphere(u)); },
         upright.shares([](const dvec3&) { return f64::uniformSpherePdf(); })},
        {"wide cone", [&](SquareCounts& counts, const vec2& u) { cone(counts, dvec3(f32::uniformCone(u, 0.7f)), 0.7f); }, flat},
        {"cone of 1e-8", [&](SquareCounts& counts, const vec2& u) { cone(counts, dvec3(f32::uniformCone(u, 1e-8f)), 1e-8f); },
         flat},
        {"triangle",
         [](SquareCounts& counts, const vec2& u) {
             const dvec2 b(f32::uniformTriangle(u));
             counts.add((b.x + b.y) * (b.x + b.y), b.y / (b.x + b.y));
         },
         flat},
        {"near sphere", [&](SquareCounts& counts, const vec2& u) { sphereCone(counts, u, 0.99); }, flat},
        {"sphere of half", [&](SquareCounts& counts, const vec2& u) { sphereCone(counts, u, 0.5); }, flat},
        {"far sphere", [&](SquareCounts& counts, const vec2& u) { sphereCone(counts, u, 1e-3); }, flat},
        {"sphere from inside",
         [&](SquareCounts& counts, const vec2& u) { direction(upright, counts, f32::sampleSphereLight(p, center, 4, u).wi); },
         upright.shares([](const dvec3&) { return f64::uniformSpherePdf(); })},
        {"all directions as one cell",
         [&](SquareCounts& counts, const vec2& u) {
             cell(counts, u, {0, 0}, {1, 1});
         },
         flat},
        {"cell across the horizon",
         [&](SquareCounts& counts, const vec2& u) {
             cell(counts, u, {3, 1}, {5, 3});
         },
         flat},
        {"cell at the upper pole",
         [&](SquareCounts& counts, const vec2& u) {
             cell(counts, u, {7, 0}, {16, 512});
         },
         flat},
        {"cell at the lower pole",
         [&](SquareCounts& counts, const vec2& u) {
             cell(counts, u, {0, 511}, {16, 512});
         },
         flat},
        {"tent filter",
         [&](SquareCounts& counts, const vec2& u) {
             const vec2 q = f32::filterOffset(u, MINIRT_FILTER_TENT);
             counts.add(tent(q.x), tent(q.y));
         },
         flat},
        {"gaussian filter",
         [](SquareCounts& counts, const vec2& u) {
             const dvec2 q(f32::filterOffset(u, MINIRT_FILTER_GAUSSIAN));
             const double turn = std::atan2(q.y, q.x) / kTurn;
             counts.add((1 - std::exp(-2 * glm::dot(q, q))) / (1 - std::exp(-4.5)), turn < 0 ? turn + 1 : turn);
         },
         flat},
    };
    const double level = sidakLevel(static_cast<int>(std::size(cases)));
    uint64_t seed = 100;
    for (const auto& c : cases) {
        INFO(c.name);
        Random random(seed++);
        SquareCounts counts;
        for (int i = 0; i < kSamples; ++i) c.add(counts, point(random));
        const double integral = std::accumulate(c.shares.begin(), c.shares.end(), c.shares.empty() ? 1.0 : 0.0);
        const double result = c.shares.empty() ? counts.pUniform() : counts.p(c.shares);
        MESSAGE(c.name, ": p ", result, ", integral of the density ", integral);
        CHECK(result > level);
        CHECK(std::abs(integral - 1) < 1e-3);
    }
    // The densities of cones are flat: their value is one over the solid angle.
    CHECK(f64::uniformConePdf(0.7) * kTurn * 0.7 == doctest::Approx(1).epsilon(1e-12));
    for (uint32_t rows : {1u, 2u, 3u, 512u}) {
        double heights = 0;
        for (uint32_t row = 0; row < rows; ++row) heights += f64::cellHeight(row, rows);
        CHECK(heights == doctest::Approx(2).epsilon(1e-6));
        CHECK(f64::cellPdf(0, 4, rows) * f64::cellHeight(0, rows) * kTurn / 4 == doctest::Approx(1).epsilon(1e-12));
    }
    CHECK(f64::uniformConePdf(2) == doctest::Approx(f64::uniformSpherePdf()).epsilon(1e-12));
}

TEST_CASE("directions are of unit length and points in range, in the corners as well") {
    Random random(7);
    double worst = 0;
    bool inside = true;
    for (int i = 0; i < 100000; ++i) {
        vec2 u = point(random);
        if (i % 3 == 0) u.x = i % 2 == 0 ? 0 : kLast;
        if (i % 5 == 0) u.y = i % 4 < 2 ? 0 : kLast;
        const auto height = static_cast<float>(std::pow(10.0, random.uniform(-12, 0.3)));
        for (const vec3& w : {f32::cosineHemisphere(u), f32::uniformSphere(u), f32::uniformCone(u, height)}) {
            worst = std::max(worst, std::abs(glm::length(dvec3(w)) - 1));
        }
        const vec2 disk = f32::concentricDisk(u);
        const vec2 b = f32::uniformTriangle(u);
        inside = inside && glm::length(dvec2(disk)) <= 1 + 2e-7 && f32::cosineHemisphere(u).z >= 0;
        inside = inside && b.x >= 0 && b.y >= 0 && b.x + b.y <= 1;
    }
    MESSAGE("length off by ", worst);
    CHECK(worst < 4e-7);
    CHECK(inside);
}

TEST_CASE("bases are orthonormal and right-handed") {
    Random random(8);
    double worst = 0;
    double worstRoundTrip = 0;
    for (int i = 0; i < 200000; ++i) {
        vec3 n(random.direction());
        if (i % 4 == 0) n = glm::normalize(vec3(n.x * 1e-4f, n.y * 1e-4f, i % 8 == 0 ? -1.0f : 1.0f));
        if (i < 4) n = vec3(0, 0, i % 2 == 0 ? -1 : 1);
        const f32::Basis basis = f32::basisAround(n);
        const dvec3 t(basis.t);
        const dvec3 b(basis.b);
        worst = std::max({worst, std::abs(glm::dot(t, b)), std::abs(glm::dot(t, dvec3(n))), std::abs(glm::dot(b, dvec3(n))),
                          std::abs(glm::length(t) - 1), std::abs(glm::length(b) - 1), glm::length(glm::cross(t, b) - dvec3(n))});
        const vec3 v(random.direction());
        worstRoundTrip = std::max(worstRoundTrip, glm::length(dvec3(f32::fromBasis(basis, f32::intoBasis(basis, v))) - dvec3(v)));
    }
    MESSAGE("bases off by ", worst, ", there and back ", worstRoundTrip);
    CHECK(worst < 5e-7);
    CHECK(worstRoundTrip < 1e-6);
}

TEST_CASE("densities of sphere lights are exact for near, small and far spheres") {
    double worst = 0;
    for (double share = 1e-15; share < 1; share *= 1.7) {
        const auto radius = static_cast<float>(share * 3);
        const exact sine = static_cast<exact>(radius) / 3;
        const exact height = sine * sine / (1 + std::sqrt((1 - sine) * (1 + sine)));
        const double right = static_cast<double>(1 / (2 * 3.14159265358979323846L * height));
        const float pdf = f32::sphereLightPdf(vec3(0), vec3(0, -3, 0), radius);
        CHECK(f32::sampleSphereLight(vec3(0), vec3(0, -3, 0), radius, vec2(0.3f)).pdf == pdf);
        worst = std::max(worst, std::abs(pdf / right - 1));
    }
    CHECK(std::isfinite(f32::sphereLightPdf(vec3(0), vec3(0, 0, 1), 1e-18f)));
    CHECK(f32::sphereLightPdf(vec3(0), vec3(0, 0, 1), 1.0f) == f32::uniformSpherePdf());  // on the surface
    CHECK(f32::sphereLightPdf(vec3(0), vec3(0, 0, 0), 1.0f) == f32::uniformSpherePdf());
    MESSAGE("relative error of the density ", worst);
    CHECK(worst < 1e-6);
}

TEST_CASE("sampled points lie on the sphere, at the distance that is told") {
    Random random(9);
    double worst = 0;
    for (int i = 0; i < 200000; ++i) {
        const vec3 p(random.inCube(2));
        const vec3 center(random.inCube(2));
        const auto radius = static_cast<float>(std::pow(10.0, random.uniform(-3, 1)));
        vec2 u = point(random);
        if (i % 7 == 0) u.x = i % 2 == 0 ? 0 : kLast;
        const f32::SphereLightSample light = f32::sampleSphereLight(p, center, radius, u);
        const exact3 hit = exact3(p) + exact3(light.wi) * static_cast<exact>(light.distance);
        const auto off = static_cast<double>(glm::length(hit - exact3(center)) - static_cast<exact>(radius));
        const double scale = std::max(glm::length(dvec3(center) - dvec3(p)), static_cast<double>(radius));
        worst = std::max(worst, std::abs(off) / scale);
        CHECK(light.distance >= 0);
    }
    MESSAGE("off the sphere by ", worst, " of its distance or radius");
    CHECK(worst < 1e-6);
}

TEST_CASE("weights of two techniques add up to 1 and survive 0 and infinity") {
    Random random(10);
    const float infinity = std::numeric_limits<float>::infinity();
    double worst = 0;
    for (int i = 0; i < 100000; ++i) {
        const auto a = static_cast<float>(std::pow(10.0, random.uniform(-30, 30)));
        const auto b = static_cast<float>(a * std::pow(10.0, random.uniform(-3, 3)));
        worst = std::max(worst, std::abs(f32::balanceWeight(a, b) - 1 / (1 + static_cast<double>(b) / a)));
        const double ratio = static_cast<double>(b) / a;
        worst = std::max(worst, std::abs(f32::powerWeight(a, b) - 1 / (1 + ratio * ratio)));
        worst = std::max(worst, std::abs(f32::powerWeight(a, b) + static_cast<double>(f32::powerWeight(b, a)) - 1));
    }
    CHECK(worst < 2e-7);
    for (const auto weight : {f32::balanceWeight, f32::powerWeight}) {
        CHECK(weight(0, 0) == 0);
        CHECK(weight(0, 1) == 0);
        CHECK(weight(1, 0) == 1);
        CHECK(weight(0, infinity) == 0);
        CHECK(weight(infinity, 0) == 1);
        CHECK(weight(infinity, 1) == 1);
        CHECK(weight(1, infinity) < 1e-30f);
        CHECK(weight(infinity, infinity) == 0.5f);
        CHECK(weight(3e38f, 3e38f) == 0.5f);
        CHECK(weight(1e-40f, 0) == 1);
        CHECK(weight(2, 2) == 0.5f);
    }
    CHECK(f32::directionPdf(2, 3, 0.5f) == 36);
    CHECK(f32::directionPdf(2, 3, 0) == 0);
}

TEST_CASE("float agrees with double") {
    Random random(11);
    double worst = 0;
    for (int i = 0; i < 100000; ++i) {
        const vec2 u = point(random);
        const vec3 n(random.direction());
        worst = std::max(worst, glm::length(dvec3(f32::cosineHemisphere(u)) - f64::cosineHemisphere(dvec2(u))));
        worst = std::max(worst, glm::length(dvec3(f32::uniformSphere(u)) - f64::uniformSphere(dvec2(u))));
        worst = std::max(worst, glm::length(dvec3(f32::uniformCone(u, 0.25f)) - f64::uniformCone(dvec2(u), 0.25)));
        worst = std::max(worst, glm::length(dvec2(f32::uniformTriangle(u)) - f64::uniformTriangle(dvec2(u))));
        worst = std::max(worst, glm::length(dvec3(f32::basisAround(n).t) - f64::basisAround(dvec3(n)).t));
    }
    MESSAGE("differ by ", worst);
    CHECK(worst < 1e-6);
}
