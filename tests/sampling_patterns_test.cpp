#include <doctest/doctest.h>

#include <algorithm>
#include <set>

#include "random.hpp"
#include "shader_source.hpp"

using glm::vec2;
using glm::vec3;

TEST_CASE("groups that take turns are all there once, and each half has a part of every quarter of the grid") {
    for (uint32_t groups : {1u, 2u, 3u, 63u, 64u, 127u, 128u, 129u, 191u, 192u, 1000u, 4095u, 4096u, 14400u, 32401u})
        for (uint32_t most : {1u, 32u}) {
            CAPTURE(groups);
            CAPTURE(most);
            std::set<uint32_t> all;
            std::vector<uint32_t> ofFirst(4, 0);  // in quarters of the grid
            for (uint32_t i = 0; i < groups; ++i) {
                const uint32_t group = f32::interleaved(i, groups, most);
                all.insert(group);
                if (i < (groups + 1) / 2 && group < groups) ofFirst[group * 4 / groups]++;
            }
            CHECK(all.size() == groups);
            CHECK(*all.rbegin() == groups - 1);
            if (groups >= 64)
                for (uint32_t count : ofFirst) CHECK(std::abs(int(count) - int(groups / 8)) <= int(groups / 32 + 1));
        }
    CHECK(f32::interleaved(1, 4096, 1) == 2);
    CHECK(f32::interleaved(1, 4096, 32) == 1);
    CHECK(f32::interleaved(32, 4096, 32) == 64);
    CHECK(f32::interleaved(2048, 4096, 32) == 32);
}

TEST_CASE("the pixels of a group in Morton order are each a different one of its block") {
    std::set<std::pair<uint32_t, uint32_t>> pixels;
    for (uint32_t lane = 0; lane < 64; ++lane) pixels.insert({f32::everySecondBit(lane), f32::everySecondBit(lane >> 1)});
    CHECK(pixels.size() == 64);
    CHECK(std::all_of(pixels.begin(), pixels.end(), [](const auto& p) { return p.first < 8 && p.second < 8; }));
    CHECK(f32::everySecondBit(0x5555u) == 0xffu);
    CHECK(f32::everySecondBit(0xaaaau) == 0u);
}

TEST_CASE("the first sample is the centre and the others follow the R2 sequence inside of the pixel") {
    CHECK(f32::pixelSample(0) == vec2(0.5f));
    const long double plastic = 1.32471795724474602596L;
    double worst = 0;
    bool inside = true;
    for (uint32_t i = 0; i < 1000000; ++i) {
        const vec2 sample = f32::pixelSample(i);
        inside = inside && sample.x >= 0 && sample.x < 1 && sample.y >= 0 && sample.y < 1;
        const long double x = 0.5L + i / plastic;
        const long double y = 0.5L + i / (plastic * plastic);
        const double dx = std::abs(static_cast<double>(x - std::floor(x)) - sample.x);
        const double dy = std::abs(static_cast<double>(y - std::floor(y)) - sample.y);
        worst = std::max({worst, std::min(dx, 1 - dx), std::min(dy, 1 - dy)});
    }
    CHECK(inside);
    CHECK(worst < 3e-4);  // the step is rounded to 2^-32, a million times
}

TEST_CASE("checker cells alternate across zero and follow the two axes across the normal") {
    const vec3 up(0, 1, 0);
    CHECK(f32::inEvenCell(vec3(0.5f, 9, 0.5f), up, 1));
    CHECK_FALSE(f32::inEvenCell(vec3(-0.5f, 9, 0.5f), up, 1));
    CHECK(f32::inEvenCell(vec3(-0.5f, 9, -0.5f), up, 1));
    CHECK_FALSE(f32::inEvenCell(vec3(1.5f, 9, 0.5f), up, 1));
    CHECK(f32::inEvenCell(vec3(1.5f, 9, 0.5f), up, 2));
    CHECK_FALSE(f32::inEvenCell(vec3(9, 0.5f, -0.5f), vec3(-1, 0, 0), 1));
    CHECK_FALSE(f32::inEvenCell(vec3(0.5f, -0.5f, 9), vec3(0, 0, 1), 1));
    test::Random random(1);
    int wrong = 0;
    for (int i = 0; i < 100000; ++i) {
        const vec3 p(random.inCube(1e4));
        const auto x = static_cast<int64_t>(std::floor(p.x / 0.25f));
        const auto z = static_cast<int64_t>(std::floor(p.z / 0.25f));
        wrong += f32::inEvenCell(p, up, 0.25f) != ((x + z) % 2 == 0);
    }
    CHECK(wrong == 0);
}

TEST_CASE("texels wrap around, are mirrored or stop at the rim") {
    int wrong = 0;
    for (int size = 1; size <= 4100; size += size < 70 ? 1 : 13) {
        for (const int i : {-size, -size - 1, -1, 0, 1, size - 1, size, size + 1, 2 * size, 7 * size - 1, 7 * size}) {
            const int turn = ((i % (2 * size)) + 2 * size) % (2 * size);
            wrong += f32::wrapTexel(i, size, f32::WRAP_REPEAT) != ((i % size) + size) % size;
            wrong += f32::wrapTexel(i, size, f32::WRAP_CLAMP) != std::clamp(i, 0, size - 1);
            wrong += f32::wrapTexel(i, size, f32::WRAP_MIRROR) != std::min(turn, 2 * size - 1 - turn);
        }
    }
    CHECK(wrong == 0);
}

TEST_CASE("texture coordinates come back to their image") {
    for (const float u : {0.0f, 0.25f, 1.0f, 1.75f, 2.0f, 3.5f, -0.25f, -1.5f, 1000.125f}) {
        CAPTURE(u);
        CHECK(f32::wrapCoordinate(u, f32::WRAP_REPEAT) == u - std::floor(u));
        CHECK(f32::wrapCoordinate(u, f32::WRAP_CLAMP) == std::clamp(u, 0.0f, 1.0f));
        // On the image and its mirror image, the place is the same as that of the triangle wave.
        const float at = f32::wrapCoordinate(u, f32::WRAP_MIRROR);
        CHECK(at >= 0);
        CHECK(at <= 2);
        CHECK(std::min(at, 2 - at) == std::abs(u - 2 * std::round(u / 2)));
    }
}
