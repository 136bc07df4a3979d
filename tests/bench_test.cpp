// What minirt-bench can get wrong: its statistics, its rays, its judgement. Nothing here is timed.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>

#include "agreement.hpp"
#include "commands.hpp"
#include "embree_rays.hpp"
#include "embree_tree.hpp"
#include "kernel_statistics.hpp"
#include "meshes.hpp"
#include "ray_sets.hpp"
#include "scaling.hpp"
#include "support.hpp"
#include "timing.hpp"

using namespace bench;

namespace {

/// Two triangles that make the square [-1,1]^2 at y = 0, front up.
const Triangles kSquare = {{glm::vec3(-1, 0, -1), glm::vec3(-1, 0, 1), glm::vec3(1, 0, 1)},
                           {glm::vec3(-1, 0, -1), glm::vec3(1, 0, 1), glm::vec3(1, 0, -1)}};

/// `count` rays from above onto one point of the square, and their hits.
struct Downward {
    std::vector<Ray> rays;
    std::vector<Hit> hits;
    explicit Downward(size_t count)
        : rays(count, {glm::vec3(0.5f, 3, 0), 0, glm::vec3(0, -1, 0), kRayEnd}), hits(count, {3, 1}) {}
};

bool same(const std::vector<Ray>& a, const std::vector<Ray>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Ray)) == 0;
}

}  // namespace

TEST_CASE("contenders take turns, and the first round does not count") {
    std::string turns;
    double ms = 0;
    const std::vector<Contender> contenders = {{"a", [&] { return turns += 'a', ms += 1; }},
                                               {"b", [&] { return turns += 'b', 50.0; }}};
    const std::vector<Times> times = takeTurns(contenders, 2);
    CHECK(turns == "ababab");
    CHECK(times[0].ms == std::vector<double>{2, 3});
    CHECK(times[1].ms == std::vector<double>{50, 50});
    const Spread ratio = ratioTo(times[1].ms, times[0].ms);
    CHECK(ratio.median == doctest::Approx(0.5 * (50.0 / 3 + 25)));
}

TEST_CASE("primary rays go through the centres of all pixels, in tiles") {
    const Surroundings around = {glm::vec3(1, 2, 3), 5};
    const std::vector<Ray> rays = primaryRays(around, 32, 16);
    REQUIRE(rays.size() == 32 * 16);
    glm::dvec3 sum(0);
    for (const Ray& ray : rays) {
        CHECK(glm::length(ray.direction) == doctest::Approx(1).epsilon(1e-6));
        CHECK(ray.origin == rays[0].origin);
        sum += glm::dvec3(ray.direction);
    }
    const glm::vec3 forward = glm::normalize(around.center - rays[0].origin);
    CHECK(glm::length(glm::vec3(glm::normalize(sum)) - forward) < 1e-6f);
    // Ray 8 lies below ray 0, ray 64 to the right of ray 7: neighbours are one pixel apart.
    const auto apart = [&](size_t i, size_t k) { return glm::length(rays[i].direction - rays[k].direction); };
    CHECK(apart(0, 8) == doctest::Approx(apart(0, 1)).epsilon(0.2));
    CHECK(apart(7, 64) == doctest::Approx(apart(6, 7)).epsilon(0.2));
    // The vertical field of view is 0.9: the first and the last row are 15/16 of it apart on the image plane.
    const auto slope = [&](size_t i) {
        const glm::vec3 d = rays[i].direction / glm::dot(rays[i].direction, forward);
        return d.y - forward.y;
    };
    const float up = std::sqrt(1 - forward.y * forward.y);
    CHECK((slope(0) - slope(4 * 64 + 56)) / up == doctest::Approx(2 * std::tan(0.45) * 15 / 16).epsilon(1e-4));
}

TEST_CASE("shadow rays start on the side that the ray came from and end in the light") {
    const Downward down(20000);
    const SecondaryRays secondary = secondaryRays(kSquare, down.rays, down.hits, 1, 1);
    const Surroundings around = surroundingsOf(kSquare);
    const glm::vec3 light = around.center + around.radius * glm::vec3(2, 3, 1);
    REQUIRE(secondary.shadow.size() == down.rays.size());
    glm::dvec3 sum(0);
    for (const Ray& ray : secondary.shadow) {
        CHECK(ray.origin.y > 0);
        const glm::vec3 end = ray.origin + ray.tMax * ray.direction - light;
        CHECK(std::max({std::abs(end.x), std::abs(end.y), std::abs(end.z)}) <= 0.25f * around.radius * 1.0001f);
        sum += glm::dvec3(end);
    }
    // Uniform over the cube: the mean is off its middle by no more than 5 standard errors.
    const double error = 0.5 * around.radius / std::sqrt(12.0 * static_cast<double>(down.rays.size()));
    for (int axis = 0; axis < 3; ++axis) CHECK(std::abs(sum[axis] / static_cast<double>(down.rays.size())) < 5 * error);
}

TEST_CASE("diffuse rays are cosine-weighted") {
    const Downward down(50000);
    const SecondaryRays secondary = secondaryRays(kSquare, down.rays, down.hits, 2, 3);
    const auto n = static_cast<double>(secondary.diffuse.size());
    REQUIRE(n == 100000);
    double cosine = 0, square = 0, x = 0, z = 0;
    for (const Ray& ray : secondary.diffuse) {
        const double c = static_cast<double>(ray.direction.y);
        CHECK(c >= 0);
        cosine += c / n, square += c * c / n;
        x += static_cast<double>(ray.direction.x) / n, z += static_cast<double>(ray.direction.z) / n;
    }
    // Of the density cos / pi the means of cos and cos^2 are 2/3 and 1/2; of x and z 0 with a variance of 1/4.
    CHECK(std::abs(cosine - 2.0 / 3) < 5 * std::sqrt((0.5 - 4.0 / 9) / n));
    CHECK(std::abs(square - 0.5) < 5 * std::sqrt((1.0 / 3 - 0.25) / n));
    CHECK(std::abs(x) < 5 * 0.5 / std::sqrt(n));
    CHECK(std::abs(z) < 5 * 0.5 / std::sqrt(n));
}

TEST_CASE("secondary rays are the same for the same seed, whatever the others hit") {
    const Downward down(100);
    const SecondaryRays first = secondaryRays(kSquare, down.rays, down.hits, 2, 5);
    CHECK(same(first.diffuse, secondaryRays(kSquare, down.rays, down.hits, 2, 5).diffuse));
    CHECK_FALSE(same(first.diffuse, secondaryRays(kSquare, down.rays, down.hits, 2, 6).diffuse));
    Downward without(100);
    without.hits[0].primitive = kNoHit;
    const SecondaryRays rest = secondaryRays(kSquare, without.rays, without.hits, 2, 5);
    REQUIRE(rest.diffuse.size() == 198);
    CHECK(std::memcmp(&rest.diffuse[0], &first.diffuse[1], sizeof(Ray)) == 0);
    CHECK(std::memcmp(&rest.shadow[197], &first.shadow[199], sizeof(Ray)) == 0);
}

TEST_CASE("shuffling keeps every ray once and leaves few in place") {
    std::vector<Ray> rays(1000, {glm::vec3(0), 0, glm::vec3(0, 0, 1), 0});
    for (size_t i = 0; i < rays.size(); ++i) rays[i].tMax = static_cast<float>(i);
    const std::vector<Ray> mixed = shuffled(rays, 1);
    std::vector<float> numbers;
    size_t inPlace = 0;
    for (size_t i = 0; i < mixed.size(); ++i) numbers.push_back(mixed[i].tMax), inPlace += mixed[i].tMax == rays[i].tMax;
    CHECK(inPlace < 10);
    std::sort(numbers.begin(), numbers.end());
    for (size_t i = 0; i < numbers.size(); ++i) CHECK(numbers[i] == rays[i].tMax);
}

TEST_CASE("hits agree where both miss or both are near, any hits where both hit") {
    const std::vector<Hit> first = {{1, 0}, {2, 3}, {3, 1}, {0, kNoHit}, {0, kNoHit}};
    const std::vector<Hit> second = {{1.05f, 7}, {2.2f, 3}, {0, kNoHit}, {5, kNoHit}, {1, 2}};
    const Agreement closest = agreement(first, second, false, 0.1f);
    CHECK(closest.rays == 5);
    CHECK(closest.hits == 3);
    CHECK(closest.onlyOne == 2);
    CHECK(closest.distance == 1);
    CHECK_FALSE(closest.good());
    CHECK(agreement(first, second, true, 0.1f).differing() == 2);
    CHECK(agreement({{NAN, 0}}, {{1, 0}}, false, 0.1f).distance == 1);
    Agreement many;
    many.rays = 200000;
    many.onlyOne = 2;
    CHECK(many.good());
    many.distance = 1;
    CHECK_FALSE(many.good());
}

TEST_CASE("scaling is what each keeps of its rays per second from the smallest mesh on") {
    const auto rate = [](double median) { return Spread{median, median, median}; };
    const auto mesh = [&](uint64_t triangles, double own, double peer) {
        RaySetResult set;
        set.rays = "primary";
        set.contenders = {{"minirt", rate(own), rate(1 / own), {}, {}, {}, false},
                          {"other", rate(1), rate(1), {}, {}, {}, false},
                          {"judge", rate(peer), rate(2 / peer), {}, {}, {}, true}};
        return MeshRays{triangles, {set}};
    };
    const std::vector<Scaling> scaling = scalingOf({mesh(500, 10, 30), mesh(100, 40, 60), mesh(900, 5, 10)});
    REQUIRE(scaling.size() == 2);
    CHECK(scaling[0].peer == "judge");
    CHECK(scaling[0].from == 100);
    CHECK(scaling[0].to == 500);
    CHECK(scaling[0].own == doctest::Approx(0.25));
    CHECK(scaling[0].peers == doctest::Approx(0.5));
    CHECK(scaling[0].ratio() == doctest::Approx(0.5));
    CHECK(scaling[1].ratioByProcessor() == doctest::Approx(0.75));
    MeshRays alone = mesh(100, 40, 60);
    alone.sets[0].contenders.resize(2);
    CHECK(scalingOf({alone, mesh(500, 10, 30)}).empty());
}

TEST_CASE("knots have about as many triangles as asked for") {
    for (const uint32_t triangles : {200u, 1000u, 70000u}) {
        const Mesh knot = knotMesh(triangles);
        CHECK(knot.triangles.size() == doctest::Approx(triangles).epsilon(0.03));
        CHECK(knot.triangles.size() == knot.geometry.primitives.size());
    }
}

TEST_CASE("the knot that minirt-bench starts bakes for the integrator that it names") {
    const test::TemporaryDir dir;
    for (const char* integrator : {"whitted", "path"}) {
        minirtc::BakeOptions options;
        options.scene = writeKnotScene(dir.path(), 500, integrator).string();
        options.output = (dir.path() / "knot.mrt").string();
        options.quiet = true;
        options.onlyDefault = true;
        REQUIRE(minirtc::bake(options) == 0);
        std::ifstream file(options.output, std::ios::binary);
        const std::vector<char> blob{std::istreambuf_iterator<char>(file), {}};
        minirt_blob parts;
        REQUIRE(minirt_validate(blob.data(), blob.size(), &parts, nullptr) == MINIRT_OK);
        CHECK(std::string(parts.kernels->name) == integrator);
        CHECK(parts.primitive_count == doctest::Approx(500).epsilon(0.05));
    }
}

TEST_CASE("Embree's hierarchies hold every triangle, and their cost is that of such trees") {
    if (!EmbreeScene::available()) return test::skip("needs Embree 3");
    const Mesh knot = knotMesh(5000);
    const minirtc::Bvh own = minirtc::buildBvh(knot.geometry, 2, minirtc::BvhQuality::fast);
    for (const EmbreeQuality quality : {EmbreeQuality::low, EmbreeQuality::medium, EmbreeQuality::high}) {
        const minirtc::Bvh tree = embreeTree(knot.triangles, quality);
        std::vector<uint32_t> order = tree.order;
        std::sort(order.begin(), order.end());
        order.erase(std::unique(order.begin(), order.end()), order.end());
        CHECK(order.size() == knot.triangles.size());
        CHECK(tree.nodes.size() + 1 == tree.leaves);
        CHECK(tree.sahCost == minirtc::sahCost(tree));
        CHECK(tree.sahCost > 0.9 * own.sahCost);
        CHECK(tree.sahCost < 1.5 * own.sahCost);
    }
}

TEST_CASE("hierarchies of high quality cost no more than Embree's, within their bytes") {
    if (!EmbreeScene::available()) return test::skip("needs Embree 3");
    std::vector<Mesh> meshes;
    for (const uint32_t triangles : {1000u, 20000u}) meshes.push_back(knotMesh(triangles));
    const std::filesystem::path seeds = test::sharedDir() / "scenes/seed";
    for (const char* name : {"water.obj", "fudanlogo-mesh.obj", "venus-mesh.obj", "glass.obj"})
        if (std::filesystem::exists(seeds / name)) meshes.push_back(loadMesh(seeds / name));
    for (const Mesh& mesh : meshes) {
        CAPTURE(mesh.name);
        const minirtc::Bvh own = minirtc::buildBvh(mesh.geometry, 2);
        CHECK(own.sahCost <= embreeTree(mesh.triangles, EmbreeQuality::high).sahCost);
        CHECK(minirtc::bytesOf(own.order.size(), own.nodes.size()) <=
              minirtc::kBytesEach * static_cast<double>(mesh.triangles.size()));
    }
}

TEST_CASE("a mesh that is subdivided covers what it covered, in triangles of a quarter of the size") {
    const test::TemporaryDir folder;
    const std::filesystem::path file = folder.write("two.obj", "v 0 0 0\nv 4 0 0\nv 4 0 2\nv 0 3 2\nf 1 2 3\nf 1 3 4\n");
    const Triangles coarse = loadMesh(file).triangles;
    const Triangles fine = loadMesh(file, 2).triangles;
    REQUIRE(coarse.size() == 2);
    REQUIRE(fine.size() == 16 * coarse.size());
    const auto area = [](const Triangle& t) { return 0.5f * glm::cross(t[1] - t[0], t[2] - t[0]); };
    for (size_t i = 0; i < coarse.size(); ++i) {
        glm::vec3 sum(0);
        for (size_t k = 0; k < 16; ++k) {
            // Each has its share, and faces the same way.
            CHECK(glm::distance(area(fine[16 * i + k]), area(coarse[i]) / 16.0f) < 1e-5f);
            sum += (fine[16 * i + k][0] + fine[16 * i + k][1] + fine[16 * i + k][2]) / 48.0f;
        }
        CHECK(glm::distance(sum, (coarse[i][0] + coarse[i][1] + coarse[i][2]) / 3.0f) < 1e-5f);
    }
}

TEST_CASE("Embree's packets find what its single rays find") {
    if (!EmbreeScene::available()) return test::skip("needs Embree 3");
    const Mesh knot = knotMesh(2000);
    const std::vector<Ray> rays = primaryRays(surroundingsOf(knot.triangles), 64, 64);
    EmbreeRays embree(knot.triangles, EmbreeScene::Mode::robust);
    embree.setRays({rays.begin(), rays.end() - 3}, true);  // the last packet is not full
    for (const bool anyHit : {false, true}) {
        embree.trace(anyHit, EmbreeRays::Packing::single);
        const std::vector<Hit> single = embree.hits();
        embree.trace(anyHit, EmbreeRays::Packing::eight);
        const Agreement both = agreement(single, embree.hits(), anyHit, 1e-5f);
        CHECK(both.hits > 500);
        CHECK(both.differing() == 0);
    }
}

TEST_CASE("of a driver's statistics the largest counts whose name fits, and none where it tells none") {
    const std::vector<KernelStatistics> told = {{"first", {{"Register Count", 48}, {"Stack Size", 0}}},
                                                {"second", {{"Register Count", 96}, {"Binary Size", 4096}}}};
    CHECK(largestFigure(told, {"egister"}) == 96);
    CHECK(largestFigure(told, {"tack", "cratch"}) == 0);
    CHECK(largestFigure(told, {"cratch"}) < 0);
    CHECK(largestFigure({}, {"egister"}) < 0);
}
