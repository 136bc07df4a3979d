#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "foliage.hpp"
#include "noise.hpp"

namespace samples {
namespace {

/// Colour and cover of a point of a card; x to the right, y up, both in [0,1].
struct Ink {
    glm::dvec3 color;
    double cover;
};

Picture card(int size, const std::function<Ink(const glm::dvec2&)>& at) {
    Picture picture{size, size, {}, {}};
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            const Ink ink = at({(x + 0.5) / size, 1 - (y + 0.5) / size});
            picture.pixels.push_back(glm::vec3(ink.color));
            picture.alpha.push_back(static_cast<float>(ink.cover));
        }
    }
    return picture;
}

/// 1 where `inside` is positive, with an edge as wide as a texel of a card of 512.
double edged(double inside) {
    return glm::smoothstep(-0.001, 0.001, inside);
}

struct Leaflet {
    glm::dvec2 base;
    double angle;  // from upright, to the right
    double length;
};

/// Pairs along the stalk, shorter towards its ends, and one at its tip.
std::vector<Leaflet> leaflets() {
    std::vector<Leaflet> result{{{0.5, 0.70}, 0, 0.29}};
    constexpr int kPairs = 4;
    for (int i = 0; i < kPairs; ++i) {
        const double length = 0.40 - 0.045 * i;
        for (const double side : {-1.0, 1.0})
            result.push_back({{0.5, 0.13 + 0.17 * i + 0.02 * side}, side * (1.05 - 0.1 * i), length});
    }
    return result;
}

/// Along the leaflet from its base, and across it, relative to its length.
glm::dvec2 within(const Leaflet& leaflet, const glm::dvec2& p) {
    const glm::dvec2 ahead{std::sin(leaflet.angle), std::cos(leaflet.angle)}, away = p - leaflet.base;
    return glm::dvec2{glm::dot(away, ahead), away.x * ahead.y - away.y * ahead.x} / leaflet.length;
}

/// Half the width of a pointed leaf at `along`.
double outline(double along) {
    return along <= 0 || along >= 1 ? -0.01 : 0.26 * std::sin(glm::pi<double>() * std::pow(along, 0.75));
}

glm::dvec3 leafColor(const glm::dvec2& q, double shade) {
    const double midrib = 1 - glm::smoothstep(0.010, 0.022, std::abs(q.y));
    const double wave = 0.5 + 0.5 * std::cos(glm::two_pi<double>() * 7 * (q.x - 0.8 * std::abs(q.y)));
    const double vein = 0.5 * glm::smoothstep(0.93, 0.99, wave);
    const glm::dvec3 green = glm::mix(glm::dvec3(0.045, 0.16, 0.022), glm::dvec3(0.13, 0.27, 0.04), shade);
    return glm::mix(green, glm::dvec3(0.30, 0.40, 0.12), std::max(midrib, vein));
}

}  // namespace

Picture leafCard(int size) {
    const std::vector<Leaflet> all = leaflets();
    return card(size, [&](const glm::dvec2& p) {
        Ink ink{{0.07, 0.18, 0.03}, 0};  // around the leaves the same green: filtering blends it in
        const double stalk = edged(0.008 - std::abs(p.x - 0.5)) * edged(0.75 - p.y);
        for (size_t i = 0; i < all.size(); ++i) {
            const glm::dvec2 q = within(all[i], p);
            const double cover = edged((outline(q.x) - std::abs(q.y)) * all[i].length);
            const double shade = 0.65 * lattice({static_cast<int>(i), 3, 9}) + 0.35 * valueNoise({18 * p.x, 18 * p.y, 0.5});
            if (cover >= ink.cover && cover > 0) ink = {leafColor(q, shade), cover};
        }
        return ink.cover >= stalk ? ink : Ink{{0.16, 0.14, 0.06}, stalk};
    });
}

Picture grassCard(int size) {
    constexpr int kBlades = 22;
    return card(size, [&](const glm::dvec2& p) {
        Ink ink{{0.08, 0.17, 0.03}, 0};
        for (int i = 0; i < kBlades; ++i) {
            const auto random = [&](int k) { return lattice({i, 55, k}); };
            const double height = 0.45 + 0.53 * random(0), t = p.y / height;
            const double middle = 0.12 + 0.76 * random(1) + 0.24 * (random(2) - 0.5) * t * t;
            const double cover = t < 1 ? edged(0.020 * (1 - t * t) - std::abs(p.x - middle)) : 0;
            if (cover <= 0 || cover < ink.cover) continue;
            const glm::dvec3 tip = glm::mix(glm::dvec3(0.16, 0.32, 0.05), glm::dvec3(0.36, 0.36, 0.10), random(3) * random(3));
            ink = {glm::mix(glm::dvec3(0.035, 0.08, 0.015), tip, t), cover};
        }
        return ink;
    });
}

}  // namespace samples
