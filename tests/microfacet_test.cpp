#include <doctest/doctest.h>

#include <algorithm>
#include <functional>
#include <string>

#include "random.hpp"
#include "shader_source.hpp"
#include "statistics.hpp"

using glm::dvec2;
using glm::dvec3;
using glm::uvec2;
using glm::vec2;
using glm::vec3;
using test::Random;
using test::sidakLevel;
using test::SphereGrid;
using test::SquareCounts;

namespace {

constexpr int kSamples = 1000000;
constexpr float kLast = 1 - 0x1p-24f;  // the greatest number that unitReal gives

/// The unit direction with the given z. The turn keeps horizons off the edges of bins, where quadrature would miss slivers.
dvec3 leaving(double z, double turn = 0.1037) {
    const double r = std::sqrt((1 - z) * (1 + z));
    return {r * std::cos(turn * 6.283185307179586), r * std::sin(turn * 6.283185307179586), z};
}

dvec3 upwards(Random& random) {
    return leaving(random.uniform(), random.uniform());
}

float unit(Random& random) {
    return f32::unitReal(static_cast<uint32_t>(random.uniform() * 0x1p32));
}

/// The direction seen from the other side of the surface.
dvec3 flipped(const dvec3& w) {
    return {w.x, w.y, -w.z};
}

f32::MetallicRoughness single(const f64::MetallicRoughness& m) {
    return {vec3(m.baseColor), static_cast<float>(m.metallic), static_cast<float>(m.alpha), static_cast<float>(m.dielectricF0)};
}

f64::MetallicRoughness material(const dvec3& baseColor, double metallic, double alpha, double f0 = 0.04) {
    return {baseColor, metallic, alpha, f0};
}

const f64::MetallicRoughness kMaterials[] = {
    material(dvec3(1), 1, 0.05),
    material(dvec3(1, 0.7, 0.3), 1, 0.4),
    material(dvec3(0.9, 0.7, 0.2), 1, 1),
    material(dvec3(0.8, 0.5, 0.1), 0, 0.1),
    material(dvec3(1), 0, 1),
    material(dvec3(0.6), 0.5, 0.25, 0.08),
};

const double kEtas[] = {1 / 2.42, 1 / 1.5, 0.97, 1.01, 1.5, 2.42};

/// Directional albedos of a GGX surface without compensation.
struct Albedos {
    double whole = 0;  // reflectance 1
    double rise = 0;   // reflectance (1 - c)^5
};

/// By the midpoint rule over visible normals, closer at the steep ones, where light is lost. Shares no code with the fits.
Albedos ggxAlbedos(double alpha, double mu, int n) {
    const dvec3 wo = leaving(mu, 0);
    Albedos sum;
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            const double t = (j + 0.5) / n;
            // Half of the azimuths: the other half is its mirror image.
            const dvec3 h = f64::sampleVisibleNormal(alpha, wo, dvec2((i + 0.5) / n / 2, 1 - t * t));
            const double c = glm::dot(wo, h);
            const dvec3 wi = h * (2 * c) - wo;
            if (wi.z <= 0) continue;
            const double lambdaO = (std::sqrt(1 + alpha * alpha * (1 / (wo.z * wo.z) - 1)) - 1) / 2;
            const double lambdaI = (std::sqrt(1 + alpha * alpha * (1 / (wi.z * wi.z) - 1)) - 1) / 2;
            const double weight = 2 * t * (1 + lambdaO) / (1 + lambdaO + lambdaI);
            sum.whole += weight;
            sum.rise += weight * std::pow(1 - c, 5);
        }
    }
    return {sum.whole / (n * n), sum.rise / (n * n)};
}

/// Mean over the hemisphere under the cosine of a function of the cosine, which varies over scales from alpha to 1.
template <class Function>
auto hemisphereMean(double alpha, Function&& function) {
    const double range = std::log1p(1 / alpha);
    const int n = 400;
    auto sum = function(1.0) * 0.0;
    double all = 0;
    for (int i = 0; i < n; ++i) {
        const double scale = range * (i + 0.5) / n;
        const double mu = alpha * std::expm1(scale);
        const double weight = mu * std::exp(scale);
        sum += function(mu) * weight;
        all += weight;
    }
    return sum / all;
}

/// Directional albedo without a sampler: the single reflections from `once`, which are subtracted from the BSDF to leave a function of
/// wi.z alone. wi is on the side of wo, where they are dim.
dvec3 quadratureAlbedo(const f64::MetallicRoughness& m, const dvec3& wo, const Albedos& once) {
    const dvec3 f0 = f64::metallicRoughnessF0(m);
    const auto rest = [&](double mu) {
        const double sine = std::sqrt((1 - mu) * (1 + mu)) / std::max(std::hypot(wo.x, wo.y), 1e-300);
        const dvec3 wi = wo.z < 1 ? dvec3(wo.x * sine, wo.y * sine, mu) : leaving(mu);
        const dvec3 h = glm::normalize(wo + wi);
        const dvec3 fresnel = f0 + (dvec3(1) - f0) * f64::schlickRise(glm::dot(wo, h));
        const dvec3 single = fresnel * (f64::ggxDensity(m.alpha, h) * f64::smithVisibility(m.alpha, wo, wi));
        return (f64::evalMetallicRoughness(m, wo, wi) - single) * 3.141592653589793;
    };
    return f0 * (once.whole - once.rise) + dvec3(once.rise) + hemisphereMean(m.alpha, rest);
}

/// Directional albedo by its sampler, both lobes of which are asked at each of 2^13 points.
dvec3 albedo(const f64::MetallicRoughness& m, const dvec3& wo) {
    const double share = f64::mirroredShare(m, wo);
    constexpr int kCount = 1 << 13;
    dvec3 sum(0);
    for (int i = 0; i < kCount; ++i) {
        const dvec2 u((i + 0.5) / kCount, glm::fract((i + 0.5) * 0.6180339887498949));
        sum += f64::sampleMetallicRoughness(m, wo, u, 0).weight * share;
        sum += f64::sampleMetallicRoughness(m, wo, u, static_cast<double>(kLast)).weight * (1 - share);
    }
    return sum / static_cast<double>(kCount);
}

/// Share of the energy that leaves a rough dielectric: radiance times eta^2 where it is transmitted. Over 2^14 points of a Kronecker lattice
/// by the powers of the root of x^4 = x + 1 (Roberts 2018).
double dielectricEnergy(double alpha, double eta, const dvec3& wo) {
    constexpr int kCount = 1 << 14;
    double sum = 0;
    for (int i = 0; i < kCount; ++i) {
        const dvec3 k = glm::fract(dvec3(0.8191725133961645, 0.6710436067037893, 0.5497004779019703) * (i + 0.5));
        const f64::BsdfSample sample = f64::sampleDielectric(alpha, eta, wo, dvec2(k), k.z);
        sum += sample.weight.x * (sample.wi.z < 0 ? eta * eta : 1);
    }
    return sum / kCount;
}

/// 1e6 samples, drawn in float, against a density in double.
struct Goodness {
    double p;
    double integral;
    double drawn;  // share of samples that gave a direction
};

Goodness judge(const SphereGrid& grid, const std::function<bool(const vec2&, float, dvec3&)>& draw,
               const std::function<double(const dvec3&)>& pdf, uint64_t seed) {
    Random random(seed);
    SquareCounts counts;
    int drawn = 0;
    for (int i = 0; i < kSamples; ++i) {
        const vec2 u(unit(random), unit(random));
        dvec3 w;
        if (draw(u, unit(random), w)) {
            grid.count(counts, glm::normalize(w));
            ++drawn;
        } else {
            counts.addOutside();
        }
    }
    const std::vector<double> shares = grid.shares(pdf);
    return {counts.p(shares), std::accumulate(shares.begin(), shares.end(), 0.0), static_cast<double>(drawn) / kSamples};
}

bool finite(const vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z) && v.x >= 0 && v.y >= 0 && v.z >= 0;
}

}  // namespace

TEST_CASE("the projected area of the microfacets is that of the surface") {
    for (const double alpha : {1e-3, 0.01, 0.1, 0.5, 1.0}) {
        // Over t with tan(theta) = alpha t / (1 - t).
        double area = 0;
        double seen = 0;
        const double mu = 0.3;
        const int n = 2000;
        for (int i = 0; i < n; ++i) {
            const double t = (i + 0.5) / n;
            const double tangent = alpha * t / (1 - t);
            const double z = 1 / std::sqrt(1 + tangent * tangent);
            const double dw = tangent * z * z * z * alpha / ((1 - t) * (1 - t)) / n;  // sin(theta) d theta
            area += f64::ggxDensity(alpha, leaving(z)) * z * dw * 6.283185307179586;
            for (int j = 0; j < 64; ++j) {
                const dvec3 h = leaving(z, (j + 0.5) / 64);
                const double facing = std::max(glm::dot(h, leaving(mu, 0)), 0.0);
                seen += f64::smithG1(alpha, leaving(mu, 0)) * f64::ggxDensity(alpha, h) * facing * dw * 6.283185307179586 / 64;
            }
        }
        CHECK(area == doctest::Approx(1).epsilon(1e-5));
        CHECK(seen == doctest::Approx(mu).epsilon(1e-3));  // Heitz 2014, equation 19
    }
}

TEST_CASE("visible normals follow their density") {
    const struct {
        double alpha;
        double mu;
        double focus;
    } cases[] = {{1, 1, 1}, {1, 0.3, 1}, {0.5, 0.02, 2}, {0.2, 0.7, 2}, {0.05, 0.3, 3}, {0.01, 0.9, 4}, {0.01, 0.001, 4}};
    const double level = sidakLevel(static_cast<int>(std::size(cases)));
    uint64_t seed = 1;
    for (const auto& c : cases) {
        const dvec3 wo = leaving(c.mu);
        const Goodness good = judge(
            SphereGrid(dvec3(0, 0, 1), c.focus),
            [&](const vec2& u, float, dvec3& h) {
                h = dvec3(f32::sampleVisibleNormal(static_cast<float>(c.alpha), vec3(wo), u));
                return true;
            },
            [&](const dvec3& h) { return f64::visibleNormalPdf(c.alpha, wo, h); }, seed++);
        MESSAGE("alpha ", c.alpha, ", cos ", c.mu, ": p ", good.p, ", integral ", good.integral);
        CHECK(good.p > level);
        CHECK(std::abs(good.integral - 1) < 1e-3);
    }
}

TEST_CASE("samples of metallic-roughness follow their density") {
    const struct {
        f64::MetallicRoughness m;
        double mu;
        double focus;
    } cases[] = {{kMaterials[0], 0.8, 3}, {kMaterials[1], 0.5, 1}, {kMaterials[2], 0.1, 1},
                 {kMaterials[3], 0.6, 2}, {kMaterials[4], 1, 1},   {kMaterials[5], 0.2, 1}};
    const double level = sidakLevel(static_cast<int>(std::size(cases)));
    uint64_t seed = 20;
    for (const auto& c : cases) {
        const dvec3 wo = leaving(c.mu);
        const dvec3 axis = c.focus > 1 ? dvec3(-wo.x, -wo.y, wo.z) : dvec3(0, 0, 1);
        const f32::MetallicRoughness m = single(c.m);
        const Goodness good = judge(
            SphereGrid(axis, c.focus),
            [&](const vec2& u, float lobe, dvec3& wi) {
                const f32::BsdfSample sample = f32::sampleMetallicRoughness(m, vec3(wo), u, lobe);
                wi = dvec3(sample.wi);
                return sample.pdf > 0;
            },
            [&](const dvec3& wi) { return f64::pdfMetallicRoughness(c.m, wo, wi); }, seed++);
        MESSAGE("alpha ", c.m.alpha, ", metallic ", c.m.metallic, ", cos ", c.mu, ": p ", good.p, ", integral ", good.integral,
                ", drawn ", good.drawn);
        CHECK(good.p > level);
        CHECK(good.integral < 1 + 1e-3);
        CHECK(std::abs(good.integral - good.drawn) < 3e-3);
    }
}

TEST_CASE("samples of a rough dielectric follow their density") {
    const struct {
        double alpha;
        double eta;
        double mu;
    } cases[] = {{0.5, 1.5, 0.8},  {1, 1.5, 0.2},        {0.2, 1 / 1.5, 0.9}, {0.3, 1 / 1.5, 0.4},
                 {0.6, 2.42, 0.5}, {0.8, 1 / 2.42, 0.7}, {0.5, 1.1, 0.6}};
    const double level = sidakLevel(static_cast<int>(std::size(cases)));
    uint64_t seed = 40;
    for (const auto& c : cases) {
        const dvec3 wo = leaving(c.mu);
        const Goodness good = judge(
            SphereGrid(),
            [&](const vec2& u, float lobe, dvec3& wi) {
                const f32::BsdfSample sample =
                    f32::sampleDielectric(static_cast<float>(c.alpha), static_cast<float>(c.eta), vec3(wo), u, lobe);
                wi = dvec3(sample.wi);
                return sample.pdf > 0;
            },
            [&](const dvec3& wi) { return f64::pdfDielectric(c.alpha, c.eta, wo, wi); }, seed++);
        MESSAGE("alpha ", c.alpha, ", eta ", c.eta, ", cos ", c.mu, ": p ", good.p, ", integral ", good.integral, ", drawn ",
                good.drawn);
        CHECK(good.p > level);
        CHECK(good.integral < 1 + 1e-3);
        CHECK(std::abs(good.integral - good.drawn) < 3e-3);
    }
}

TEST_CASE("both ways through a surface are the same") {
    Random random(60);
    double worst = 0;
    double worst32 = 0;
    double worstTransmitted = 0;
    int transmitted = 0;
    const auto differ = [](double a, double b) { return std::abs(a - b) / std::max({std::abs(a), std::abs(b), 1e-12}); };
    for (int i = 0; i < 200000; ++i) {
        const dvec3 wo = upwards(random);
        const dvec3 wi = upwards(random);
        f64::MetallicRoughness m = kMaterials[random.index(static_cast<uint32_t>(std::size(kMaterials)))];
        m.alpha = std::pow(10.0, random.uniform(-3, 0));
        const dvec3 there = f64::evalMetallicRoughness(m, wo, wi);
        const dvec3 back = f64::evalMetallicRoughness(m, wi, wo);
        worst = std::max({worst, differ(there.x, back.x), differ(there.y, back.y), differ(there.z, back.z)});
        worst32 = std::max(worst32, differ(f32::evalMetallicRoughness(single(m), vec3(wo), vec3(wi)).x,
                                           f32::evalMetallicRoughness(single(m), vec3(wi), vec3(wo)).x));
        const double eta = kEtas[random.index(static_cast<uint32_t>(std::size(kEtas)))];
        worst = std::max(worst, differ(f64::evalDielectric(m.alpha, eta, wo, wi), f64::evalDielectric(m.alpha, eta, wi, wo)));
        const double below = f64::evalDielectric(m.alpha, eta, wo, flipped(wi));
        const double above = f64::evalDielectric(m.alpha, 1 / eta, wi, flipped(wo));
        if (below == 0 && above == 0) continue;
        ++transmitted;
        worstTransmitted = std::max(worstTransmitted, differ(below * eta * eta, above));
    }
    MESSAGE("reflection differs by ", worst, " (float ", worst32, "), transmission by ", worstTransmitted, " over ", transmitted,
            " pairs");
    CHECK(worst < 1e-9);
    CHECK(worst32 < 1e-5);
    CHECK(worstTransmitted < 1e-7);
    CHECK(transmitted > 30000);
}

TEST_CASE("the fits of what GGX loses are as good as they say, each from its side") {
    struct Error {
        double least = 1;
        double most = -1;
        void add(double e) {
            least = std::min(least, e);
            most = std::max(most, e);
        }
    };
    Error loss, rise, meanLoss, meanRise;
    double greatest = 0;
    for (const double roughness : {1e-3, 0.0317, 0.07, 0.13, 0.2, 0.28, 0.37, 0.45, 0.55, 0.65, 0.75, 0.87, 0.95, 1.0}) {
        const double alpha = f64::ggxAlpha(roughness);
        double most = 0;
        for (const double mu :
             {1e-6, 1e-4, 1e-3, 0.004, 0.01, 0.02, 0.035, 0.06, 0.1, 0.16, 0.25, 0.37, 0.5, 0.65, 0.8, 0.93, 1.0}) {
            const Albedos right = ggxAlbedos(alpha, mu, 256);
            greatest = std::max(greatest, 1 - right.whole);
            loss.add(f64::ggxLoss(alpha, mu) - (1 - right.whole));
            rise.add(f64::ggxRise(alpha, mu) - right.rise);
            most = std::max(most, f64::ggxLoss(alpha, mu));
        }
        const double mean = hemisphereMean(alpha, [&](double mu) { return f64::ggxLoss(alpha, mu); });
        meanLoss.add((f64::ggxMeanLoss(alpha) / mean - 1) * most);
        meanRise.add(f64::ggxMeanRise(alpha) - hemisphereMean(alpha, [&](double mu) { return f64::ggxRise(alpha, mu); }));
    }
    MESSAGE("greatest loss ", greatest, "; fits off: loss ", loss.least, " to ", loss.most, ", rise ", rise.least, " to ",
            rise.most, ", mean loss (by what it takes) ", meanLoss.least, " to ", meanLoss.most, ", mean rise ", meanRise.least,
            " to ", meanRise.most);
    CHECK(loss.least > -0.0041);
    CHECK(loss.most < 1e-4);
    CHECK(rise.least > -7e-5);
    CHECK(rise.most < 0.0045);
    CHECK(meanLoss.least > -2e-5);
    CHECK(meanLoss.most < 7e-4);
    CHECK(meanRise.least > -9e-5);
    CHECK(meanRise.most < 1e-5);
}

TEST_CASE("white furnace: no surface gains, and white metal and white plastic send all light back") {
    double most = 0;
    double leastMetal = 1;
    double leastPlastic = 1;
    double meanMetal = 0;
    double meanPlastic = 0;
    const int alphas = 33;
    const int cosines = 12;
    for (int i = 0; i < alphas; ++i) {
        const double alpha = f64::ggxAlpha(i / (alphas - 1.0));
        std::vector<double> mus;
        for (int j = 0; j < cosines; ++j) mus.push_back((j + 0.5) / cosines);
        // Where rough surfaces lose at grazing angles: from a thousandth to 30 times alpha.
        for (int j = 0; j < cosines; ++j) mus.push_back(std::min(alpha * 1e-3 * std::pow(3e4, j / (cosines - 1.0)), 1.0));
        for (size_t j = 0; j < mus.size(); ++j) {
            const dvec3 wo = leaving(mus[j]);
            const Albedos once = ggxAlbedos(alpha, wo.z, 256);
            for (const double metallic : {0.0, 0.5, 1.0}) {
                for (const double f0 : {0.0, 0.04, 0.2}) {
                    if (metallic == 1 && f0 > 0) continue;  // nothing is left of the coat
                    const dvec3 back = quadratureAlbedo(material(dvec3(1, 0.5, 0), metallic, alpha, f0), wo, once);
                    most = std::max({most, back.x, back.y, back.z});
                    if (metallic == 1) leastMetal = std::min(leastMetal, back.x);
                    if (metallic == 0) leastPlastic = std::min(leastPlastic, back.x);  // a half metal is no white one
                    if (j >= static_cast<size_t>(cosines)) continue;
                    const double weight = 2 * mus[j] / (cosines * alphas);
                    if (metallic == 1) meanMetal += back.x * weight;
                    if (metallic == 0 && f0 == 0.04) meanPlastic += back.x * weight;
                }
            }
        }
    }
    MESSAGE("albedo at most 1 + ", most - 1, "; of white metal at least ", leastMetal, ", in the mean ", meanMetal,
            "; of white under a coat at least ", leastPlastic, ", in the mean ", meanPlastic);
    CHECK(most < 1 + 1e-4);
    CHECK(leastMetal > 0.995);
    CHECK(leastPlastic > 0.995);
    CHECK(meanMetal > 0.9985);
    CHECK(meanPlastic > 0.9995);
}

TEST_CASE("white furnace by sampling") {
    double worstMetal = 0;
    double worstPlastic = 0;
    double bare = 1;
    double most = 0;
    for (const double roughness : {1e-3, 0.03, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0}) {
        const double alpha = f64::ggxAlpha(roughness);
        for (const double mu : {0.001, 0.01, 0.05, 0.1, 0.2, 0.35, 0.5, 0.7, 0.85, 1.0}) {
            const dvec3 wo = leaving(mu);
            const double metal = albedo(material(dvec3(1), 1, alpha), wo).x;
            const double plastic = albedo(material(dvec3(1), 0, alpha), wo).x;
            worstMetal = std::max(worstMetal, std::abs(metal - 1));
            worstPlastic = std::max(worstPlastic, std::abs(plastic - 1));
            bare = std::min(bare, 1 - f64::ggxLoss(alpha, mu));
            const dvec3 gold = albedo(material(dvec3(1, 0.7, 0.3), 1, alpha), wo);
            const dvec3 half = albedo(material(dvec3(1, 0.8, 0.2), 0.5, alpha, 0.08), wo);
            most = std::max({most, metal, plastic, gold.x, gold.y, gold.z, half.x, half.y, half.z});
        }
    }
    MESSAGE("|albedo - 1| of white metal ", worstMetal, ", of white plastic ", worstPlastic,
            "; without compensation metal falls to ", bare, "; greatest albedo ", most);
    CHECK(worstMetal < 1e-2);  // noise of what is lost at grazing angles
    CHECK(worstPlastic < 6e-3);
    CHECK(most < 1 + 2e-3);
}

TEST_CASE("the furnace does not depend on the sampler") {
    // The midpoint rule over the projected hemisphere, which knows nothing of lobes.
    for (const auto& m : {kMaterials[1], kMaterials[2], kMaterials[4], kMaterials[5]}) {
        for (const double mu : {0.1, 0.6, 1.0}) {
            const int n = 400;
            double sum = 0;
            for (int i = 0; i < n; ++i) {
                for (int j = 0; j < n; ++j) {
                    const double z = std::sqrt((i + 0.5) / n);
                    sum += f64::evalMetallicRoughness(m, leaving(mu), leaving(z, (j + 0.5) / n)).y * 3.141592653589793 / (n * n);
                }
            }
            CHECK(albedo(m, leaving(mu)).y == doctest::Approx(sum).epsilon(2e-3));
        }
    }
}

TEST_CASE("glTF's own mixture of base and coat gives back more than all light") {
    const dvec3 wo = leaving(0.02);
    const double alpha = 0.01;
    double base = 0;
    const int n = 300;
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            const dvec3 wi = leaving(std::sqrt((i + 0.5) / n), (j + 0.5) / n);
            base += (1 - (0.04 + 0.96 * f64::schlickRise(glm::dot(wo, glm::normalize(wo + wi))))) / (n * n);
        }
    }
    const Albedos coat = ggxAlbedos(alpha, wo.z, 256);
    const double mixture = base + 0.04 * (coat.whole - coat.rise) + coat.rise;
    MESSAGE("albedo of glTF's mixture, white, at cos 0.02: ", mixture, "; ours ", albedo(material(dvec3(1), 0, alpha), wo).x);
    CHECK(mixture > 1.5);
}

TEST_CASE("a lossless rough dielectric gains nothing and loses what meets a second microfacet") {
    double most = 0;
    double heaviest = 0;
    for (const double alpha : {1e-6, 0.01, 0.1, 0.25, 0.5, 1.0}) {
        double least = 1;
        double average = 0;
        int count = 0;
        for (const double eta : {1 / 2.42, 1 / 1.5, 1.5, 2.42}) {
            for (const double mu : {0.01, 0.1, 0.3, 0.6, 1.0}) {
                const double energy = dielectricEnergy(alpha, eta, leaving(mu));
                most = std::max(most, energy);
                least = std::min(least, energy);
                average += energy;
                ++count;
            }
        }
        MESSAGE("alpha ", alpha, ": loses ", 1 - average / count, " on average, at most ", 1 - least);
        if (alpha < 1e-5) CHECK(least > 1 - 1e-3);
    }
    Random random(70);
    for (int i = 0; i < 100000; ++i) {
        const double eta = kEtas[random.index(static_cast<uint32_t>(std::size(kEtas)))];
        const f64::BsdfSample sample = f64::sampleDielectric(std::pow(10.0, random.uniform(-6, 0)), eta, upwards(random),
                                                             dvec2(random.uniform(), random.uniform()), random.uniform());
        heaviest = std::max(heaviest, sample.weight.x * (sample.wi.z < 0 ? eta * eta : 1));
    }
    MESSAGE("greatest energy ", most, ", heaviest sample ", heaviest);
    CHECK(most < 1 + 1e-3);
    CHECK(heaviest < 1 + 1e-9);
}

TEST_CASE("the weight of a sample is f cos over its density") {
    Random random(80);
    double worst = 0;
    double worstPdf = 0;
    double worst32 = 0;
    int refracted = 0;
    for (int i = 0; i < 200000; ++i) {
        const dvec3 wo = upwards(random);
        const dvec2 u(random.uniform(), random.uniform());
        const double lobe = random.uniform();
        f64::MetallicRoughness m = kMaterials[random.index(static_cast<uint32_t>(std::size(kMaterials)))];
        m.alpha = std::pow(10.0, random.uniform(-2, 0));
        const f64::BsdfSample reflected = f64::sampleMetallicRoughness(m, wo, u, lobe);
        if (reflected.pdf > 0) {
            const dvec3 right = f64::evalMetallicRoughness(m, wo, reflected.wi) *
                                (reflected.wi.z / f64::pdfMetallicRoughness(m, wo, reflected.wi));
            worst = std::max(worst, glm::length(reflected.weight - right));
        }
        const double eta = kEtas[random.index(static_cast<uint32_t>(std::size(kEtas)))];
        const f64::BsdfSample sample = f64::sampleDielectric(m.alpha, eta, wo, u, lobe);
        if (sample.pdf <= 0) continue;
        refracted += sample.wi.z < 0;
        const double pdf = f64::pdfDielectric(m.alpha, eta, wo, sample.wi);
        worstPdf = std::max(worstPdf, std::abs(pdf / sample.pdf - 1));
        worst = std::max(
            worst,
            std::abs(f64::evalDielectric(m.alpha, eta, wo, sample.wi) * std::abs(sample.wi.z) / pdf / sample.weight.x - 1));
        const f32::MetallicRoughness m32 = single(m);
        const f32::BsdfSample sample32 = f32::sampleMetallicRoughness(m32, vec3(wo), vec2(u), static_cast<float>(lobe));
        if (sample32.pdf <= 0) continue;
        const vec3 f = f32::evalMetallicRoughness(m32, vec3(wo), sample32.wi);
        const double right = static_cast<double>(f.x) * sample32.wi.z / f32::pdfMetallicRoughness(m32, vec3(wo), sample32.wi);
        worst32 = std::max(worst32, std::abs(right - sample32.weight.x) / std::max(1.0, right));
    }
    MESSAGE("weights differ by ", worst, ", densities by ", worstPdf, ", in float ", worst32);
    CHECK(worst < 1e-6);
    CHECK(worstPdf < 1e-6);
    CHECK(worst32 < 1e-6);
    CHECK(refracted > 50000);
}

TEST_CASE("all is finite at grazing angles, for smooth and rough surfaces and in the corners of the square") {
    Random random(90);
    int bad = 0;
    int outside = 0;
    float heaviest = 0;
    for (int i = 0; i < 400000; ++i) {
        const float alpha = f32::ggxAlpha(static_cast<float>(i % 10 == 0 ? 0 : std::pow(10.0, random.uniform(-3, 0))));
        const auto z = [&] { return random.coin() ? std::pow(10.0, random.uniform(-9, 0)) : random.uniform(); };
        const vec3 wo(leaving(z(), random.uniform()));
        const vec3 wi(i % 4 == 0 ? dvec3(-wo.x, -wo.y, wo.z) : leaving(z(), random.uniform()));
        vec2 u(unit(random), unit(random));
        if (i % 3 == 0) u.x = i % 2 == 0 ? 0 : kLast;
        if (i % 5 == 0) u.y = i % 4 < 2 ? 0 : kLast;
        const float lobe = i % 7 == 0 ? (i % 2 == 0 ? 0 : kLast) : unit(random);
        f32::MetallicRoughness m = single(kMaterials[random.index(static_cast<uint32_t>(std::size(kMaterials)))]);
        m.alpha = alpha;
        if (i % 11 == 0) m.baseColor = vec3(0);
        if (i % 13 == 0) m.dielectricF0 = i % 2 == 0 ? 0.0f : 1.0f;
        const f32::BsdfSample reflected = f32::sampleMetallicRoughness(m, wo, u, lobe);
        const float etas[] = {0.4f, 0.667f, 0.9999f, 0.99989f, 1, 1.00011f, 1.001f, 1.5f, 2.42f};
        const float eta = etas[random.index(9)];
        const f32::BsdfSample passed = f32::sampleDielectric(alpha, eta, wo, u, lobe);
        bad += !finite(f32::evalMetallicRoughness(m, wo, wi)) || !std::isfinite(f32::pdfMetallicRoughness(m, wo, wi));
        for (const vec3& w : {wi, vec3(wi.x, wi.y, -wi.z), -wo, passed.wi}) {
            const float f = f32::evalDielectric(alpha, eta, wo, w);
            const float pdf = f32::pdfDielectric(alpha, eta, wo, w);
            bad += !std::isfinite(f) || !std::isfinite(pdf) || f < 0 || pdf < 0;
        }
        for (const f32::BsdfSample& sample : {reflected, passed}) {
            bad += !finite(sample.weight) || !std::isfinite(sample.pdf) || sample.pdf < 0;
            outside += std::abs(glm::length(dvec3(sample.wi)) - 1) > 5e-7;
        }
        outside += reflected.wi.z < 0;
        heaviest = std::max(heaviest, passed.weight.x * (passed.wi.z < 0 ? eta * eta : 1));
    }
    MESSAGE("heaviest sample of a dielectric in float ", heaviest);
    CHECK(bad == 0);
    CHECK(outside == 0);
    CHECK(heaviest < 1 + 1e-4);
    CHECK(f32::evalMetallicRoughness(single(kMaterials[4]), vec3(0, 0, 1), vec3(0, 0, -1)) == vec3(0));
    CHECK(f32::evalMetallicRoughness(single(kMaterials[4]), vec3(0, 0, -1), vec3(0, 0, 1)) == vec3(0));
    CHECK(f32::pdfMetallicRoughness(single(kMaterials[4]), vec3(1, 0, 0), vec3(0, 0, 1)) == 0);
    CHECK(f32::sampleDielectric(0.5f, 1.5f, vec3(0, 0, -1), vec2(0.5f), 0.5f).weight == vec3(0));
}

TEST_CASE("nothing bends at an interface of equal indices") {
    const f32::BsdfSample sample = f32::sampleDielectric(0.5f, 1, vec3(0.6f, 0, 0.8f), vec2(0.2f, 0.9f), 0.3f);
    CHECK(sample.wi == vec3(-0.6f, 0, -0.8f));
    CHECK(sample.weight == vec3(1));
    CHECK(sample.pdf == 0);
    CHECK(f32::pdfDielectric(0.5f, 1, vec3(0.6f, 0, 0.8f), vec3(-0.6f, 0, -0.8f)) == 0);
}

TEST_CASE("a very smooth dielectric reflects and refracts as a polished one") {
    Random random(95);
    double worst = 0;
    for (int i = 0; i < 50000; ++i) {
        const vec3 wo(upwards(random));
        if (wo.z < 0.01f) continue;
        const float eta = random.coin() ? 1.5f : 1 / 1.5f;
        const f32::Interface polished = f32::meetInterface(-wo, vec3(0, 0, 1), eta);
        if (std::abs(polished.reflectance - 1) < 0.3f) continue;  // steep near the critical angle
        const f32::BsdfSample sample =
            f32::sampleDielectric(1e-6f, eta, wo, vec2(unit(random), 0.9f * unit(random)), unit(random));
        worst = std::max(worst, glm::length(dvec3(sample.wi) - dvec3(sample.wi.z > 0 ? polished.reflected : polished.refracted)));
    }
    MESSAGE("directions differ by ", worst);
    CHECK(worst < 1e-4);
}

TEST_CASE("float agrees with double") {
    Random random(99);
    for (const double alpha : {1e-3, 1e-2, 0.1, 1.0}) {
        double worst = 0;
        double worstGlass = 0;
        double worstCritical = 0;
        for (int i = 0; i < 50000; ++i) {
            f64::MetallicRoughness m = kMaterials[random.index(static_cast<uint32_t>(std::size(kMaterials)))];
            m.alpha = static_cast<float>(alpha);
            // Made in float: GCC 12 keeps the digits of a vector that is rounded from double and widened again.
            const vec3 wo = f32::uniformCone(vec2(unit(random), unit(random)), 0.99f);
            // Where samples go: near the mirror direction.
            const vec2 u(unit(random), unit(random));
            const f32::BsdfSample sample = f32::sampleMetallicRoughness(single(m), wo, u, unit(random));
            if (sample.pdf > 0) {
                const dvec3 right = f64::evalMetallicRoughness(m, dvec3(wo), dvec3(sample.wi));
                worst = std::max(
                    worst, glm::length(dvec3(f32::evalMetallicRoughness(single(m), wo, sample.wi)) - right) / glm::length(right));
                worst = std::max(worst, std::abs(sample.pdf / f64::pdfMetallicRoughness(m, dvec3(wo), dvec3(sample.wi)) - 1));
            }
            const float eta = random.coin() ? 1.5f : 1 / 1.5f;
            const f32::BsdfSample passed = f32::sampleDielectric(static_cast<float>(alpha), eta, wo, u, unit(random));
            if (passed.pdf <= 0) continue;
            const double f = f64::evalDielectric(m.alpha, eta, dvec3(wo), dvec3(passed.wi));
            if (f <= 0) continue;
            // Fresnel's slope is infinite at the critical angle of the microfacet.
            const dvec3 h = f64::dielectricNormal(eta, dvec3(wo), dvec3(passed.wi));
            const double reflectance = f64::microfacetReflectance(eta, dvec3(wo), h);
            double& worstHere = reflectance > 0.5 && reflectance < 1 ? worstCritical : worstGlass;
            worstHere = std::max(worstHere, std::abs(f32::evalDielectric(static_cast<float>(alpha), eta, wo, passed.wi) / f - 1));
        }
        MESSAGE("alpha ", alpha, ": relative difference ", worst, ", of glass ", worstGlass, ", near the critical angle ",
                worstCritical);
        CHECK(worst < 1e-5 + 1e-6 / alpha);
        CHECK(worstGlass < 1e-5 + 4e-7 / alpha);
        CHECK(worstCritical < 3e-3);
    }
}
