// The stack cases of nested volumes on the shader's own source, and reciprocity of ordered nesting.
#include <doctest/doctest.h>

#include <algorithm>
#include <random>
#include <string>
#include <vector>

#include "volume_source.hpp"

namespace {

using glm::uint;

// Glass, whisky, ice: each displaces those before it.
const std::string kNames = ".gwi";

/// Ordered here means w < g < i: the glass displaces the whisky that laps over its wall, and the ice displaces both.
uint rankOf(char name) {
    return static_cast<uint>(std::string(".wgi").find(name));
}
uint mediumOf(char name) {
    return static_cast<uint>(kNames.find(name));
}

/// A ray on its way through surfaces, by one of the two methods.
struct Ray {
    bool ordered;
    bool counted = false;
    nine::VolumeList list{};
    std::vector<char> inside{};  // crossed and not yet left, for the side that the ray comes from

    char nameOf(uint medium) const { return (ordered ? std::string(".wgi") : kNames)[medium]; }
    char medium() const { return nameOf(ordered ? nine::orderedMedium(list) : nine::stackedMedium(list)); }

    /// "g>w", "[]" for a hidden surface, "R w" for a ray that stays in w.
    std::string meet(char volume, bool reflect) {
        const auto open = std::find(inside.begin(), inside.end(), volume);
        return meet(volume, reflect, open == inside.end());
    }

    std::string meet(char volume, bool reflect, bool entering) {
        const nine::Crossing crossing =
            ordered ? nine::crossOrdered(list, rankOf(volume), entering, counted) : nine::crossStacked(list, mediumOf(volume));
        CHECK_FALSE(crossing.overflow);
        list = reflect ? crossing.reflected : crossing.transmitted;
        if (!reflect) {
            const auto open = std::find(inside.begin(), inside.end(), volume);
            if (entering) inside.push_back(volume);
            if (!entering && open != inside.end()) inside.erase(open);
        }
        if (crossing.from == crossing.to) return "[]";
        return reflect ? std::string("R ") + nameOf(crossing.from)
                       : std::string(1, nameOf(crossing.from)) + ">" + nameOf(crossing.to);
    }

    /// "g wR g" and the like; what each hit does, joined by blanks.
    std::string path(const std::string& hits) {
        std::string result;
        for (size_t i = 0; i < hits.size(); ++i) {
            if (hits[i] == ' ' || hits[i] == 'R') continue;
            const bool reflect = i + 1 < hits.size() && hits[i + 1] == 'R';
            result += (result.empty() ? "" : " ") + meet(hits[i], reflect);
        }
        return result;
    }

    size_t depth() const {
        return 1 +
               static_cast<size_t>(std::count_if(std::begin(list.entry), std::end(list.entry), [](uint e) { return e != 0; }));
    }
};

std::string parity(const std::string& hits) {
    return Ray{false}.path(hits);
}
std::string ordered(const std::string& hits) {
    return Ray{true}.path(hits);
}

}  // namespace

TEST_CASE("parity stack: cases 1 to 7, what follows what") {
    CHECK(parity("g g") == ".>g g>.");
    CHECK(parity("g w g w") == ".>g g>w [] w>.");
    CHECK(parity("w g w g") == ".>w w>g [] g>.");
    CHECK(parity("g w g g w g") == ".>g g>w [] w>g [] g>.");
    CHECK(parity("w i i w") == ".>w w>i i>w w>.");
    CHECK(parity("i w i w") == ".>i i>w [] w>.");
    CHECK(parity("w i w i") == ".>w w>i [] i>.");
    Ray ray{false};
    ray.path("g w g g w g");
    CHECK(ray.depth() == 1);
    CHECK(ray.medium() == '.');
}

TEST_CASE("ordered list: cases 1 to 7, and 6 agrees with 7") {
    CHECK(ordered("g g") == ".>g g>.");
    CHECK(ordered("g w g w") == ".>g [] g>w w>.");
    CHECK(ordered("w g w g") == ".>w w>g [] g>.");
    CHECK(ordered("g w g g w g") == ".>g [] g>w w>g [] g>.");
    CHECK(ordered("w i i w") == ".>w w>i i>w w>.");
    // Ice half in whisky, from above and from below: the same three media, in opposite order.
    CHECK(ordered("i w i w") == ".>i [] i>w w>.");
    CHECK(ordered("w i w i") == ".>w w>i [] i>.");
}

TEST_CASE("cases 8 to 11: a reflected ray is where it was") {
    for (const bool isOrdered : {false, true}) {
        CAPTURE(isOrdered);
        Ray first{isOrdered};
        CHECK(first.path("gR") == "R .");
        CHECK(first.medium() == '.');
        CHECK(first.depth() == 1);
        CHECK(first.path("g g") == ".>g g>.");
        Ray inner{isOrdered};
        CHECK(inner.path("g gR") == ".>g R g");
        CHECK(inner.medium() == 'g');
        CHECK(inner.depth() == 2);
        CHECK(inner.path("g") == "g>.");
    }
    Ray wall{false};
    CHECK(wall.path("g wR") == ".>g R g");
    CHECK(wall.medium() == 'g');
    CHECK(wall.path("g") == "g>.");
    CHECK(parity("g w g wR g w g") == ".>g g>w [] R w w>g [] g>.");
    CHECK(ordered("g w g wR g w g") == ".>g [] g>w R w w>g [] g>.");
}

TEST_CASE("cases 12 and 13: a gap is the surrounding, and three volumes nest") {
    for (const bool isOrdered : {false, true}) {
        CAPTURE(isOrdered);
        CHECK(Ray{isOrdered}.path("g g w w") == ".>g g>. .>w w>.");
        Ray deep{isOrdered};
        deep.path("g w i");
        CHECK(deep.depth() == 4);
        CHECK(deep.medium() == 'i');
        deep.path("i w g");
        CHECK(deep.depth() == 1);
        CHECK(deep.medium() == '.');
    }
    CHECK(parity("g w i i w g") == ".>g g>w w>i i>w w>g g>.");
}

TEST_CASE("case 14: a volume that overlaps itself is a union when it is counted, and parity makes it alternate") {
    Ray counted{true, true};
    CHECK(counted.meet('g', false, true) == ".>g");
    CHECK(counted.meet('g', false, true) == "[]");
    CHECK(counted.meet('g', false, false) == "[]");
    CHECK(counted.meet('g', false, false) == "g>.");
    CHECK(counted.depth() == 1);
    CHECK(parity("g g g g") == ".>g g>. .>g g>.");
}

TEST_CASE("case 15: a camera inside of a volume leaves it first") {
    for (const bool isOrdered : {false, true}) {
        Ray camera{isOrdered};
        camera.path("w");  // the ray to the camera
        CHECK(camera.medium() == 'w');
        CHECK(camera.path("w") == "w>.");
    }
}

TEST_CASE("case 16: coincident surfaces, entered before left, are one interface") {
    CHECK(parity("g w g") == ".>g g>w []");
    CHECK(ordered("g w g") == ".>g [] g>w");
}

TEST_CASE("cases 17 and 18: equal indices and skips are told by the media alone") {
    // Two ids are two media whatever their indices; a skip leaves `from` equal to `to` and costs nothing (optics_test shows the bits, media_test the depth).
    CHECK(ordered("g i i g") == ".>g g>i i>g g>.");
}

TEST_CASE("case 20: a list that is full says so and passes the surface over") {
    two::VolumeList stack{}, set{};
    const uint media[] = {1, 2, 3};
    bool stackOverflow[3], setOverflow[3];
    for (int i = 0; i < 3; ++i) {
        const two::Crossing stacked = two::crossStacked(stack, media[i]), inSet = two::crossOrdered(set, media[i], true, false);
        stackOverflow[i] = stacked.overflow, setOverflow[i] = inSet.overflow;
        if (i == 2) {
            CHECK(stacked.from == stacked.to);
            CHECK(inSet.from == inSet.to);
        }
        stack = stacked.transmitted, set = inSet.transmitted;
    }
    CHECK_FALSE((stackOverflow[0] || stackOverflow[1] || setOverflow[0] || setOverflow[1]));
    CHECK((stackOverflow[2] && setOverflow[2]));
    CHECK(two::stackedMedium(stack) == 2);
    CHECK(two::orderedMedium(set) == 2);
    one::VolumeList single{};
    single = one::crossStacked(single, 7).transmitted;
    CHECK(one::stackedMedium(single) == 7);
    CHECK(one::stackedMedium(one::crossStacked(single, 7).transmitted) == 0);
}

TEST_CASE("what rounding made a ray miss is forgotten at the next surface of the volume") {
    Ray ray{true};
    CHECK(ray.meet('g', false, false) == "g>.");  // left without having been entered
    CHECK(ray.depth() == 1);
    CHECK(ray.meet('g', false, true) == ".>g");
    CHECK(ray.meet('g', false, true) == ".>g");  // entered twice
    CHECK(ray.meet('g', false, false) == "g>.");
    CHECK(ray.depth() == 1);
}

namespace {

using glm::dvec3;

struct Ball {
    dvec3 center;
    double radius, ior;
};

struct Step {
    dvec3 p;
    uint from, to;  // media on the way that the path is walked
};

struct Path {
    std::vector<Step> steps;
    dvec3 p, d;             // where it is at the end, and where it goes
    bool doubtful = false;  // a surface was met within rounding of its rim or of another surface
};

/// The next ball that a ray meets beyond `t` = 0; its `index` is balls.size() where there is none.
struct Meeting {
    double t = 1e300;
    size_t index;
    bool entering = false, doubtful = false;
};

Meeting nextBall(const std::vector<Ball>& balls, const dvec3& p, const dvec3& d) {
    constexpr double kNear = 1e-7;
    Meeting best;
    best.index = balls.size();
    for (size_t i = 0; i < balls.size(); ++i) {
        const dvec3 oc = balls[i].center - p;
        const double b = glm::dot(oc, d), h2 = balls[i].radius * balls[i].radius - glm::dot(oc, oc) + b * b;
        best.doubtful = best.doubtful || std::abs(h2) < kNear;
        if (h2 <= 0) continue;
        for (const double t : {b - std::sqrt(h2), b + std::sqrt(h2)}) {
            if (t < kNear) continue;
            if (std::abs(t - best.t) < kNear) best.doubtful = true;
            if (t < best.t) best.t = t, best.index = i, best.entering = t < b;
        }
    }
    return best;
}

/// Snell's law in vector form, and the mirror direction under total reflection. `n` is against `d`.
dvec3 bend(const dvec3& d, const dvec3& n, double eta, bool& total) {
    const double cosI = -glm::dot(d, n), k = 1 - (1 - cosI * cosI) / (eta * eta);
    total = k < 0;
    return total ? d + 2 * cosI * n : glm::normalize(d / eta + n * (cosI / eta - std::sqrt(k)));
}

/// Follows a ray from outside of all balls until it leaves them; media and boundaries by the shader's list.
Path walk(const std::vector<Ball>& balls, dvec3 p, dvec3 d, bool counted) {
    Path path;
    nine::VolumeList list{};
    for (int step = 0; step < 200; ++step) {
        const Meeting meeting = nextBall(balls, p, d);
        path.doubtful = path.doubtful || meeting.doubtful;
        if (meeting.index == balls.size()) break;
        const Ball& ball = balls[meeting.index];
        p += meeting.t * d;
        const nine::Crossing crossing = nine::crossOrdered(list, static_cast<uint>(meeting.index) + 1, meeting.entering, counted);
        REQUIRE_FALSE(crossing.overflow);
        bool total = false;
        if (crossing.from != crossing.to) {
            const dvec3 out = (p - ball.center) / ball.radius;
            const auto ior = [&](uint medium) { return medium == 0 ? 1.0 : balls[medium - 1].ior; };
            const double cosI = std::abs(glm::dot(d, out)), eta = ior(crossing.to) / ior(crossing.from);
            path.doubtful = path.doubtful || std::abs(1 - (1 - cosI * cosI) / (eta * eta)) < 1e-4;
            d = bend(d, meeting.entering ? out : -out, eta, total);
            path.steps.push_back({p, crossing.from, total ? crossing.from : crossing.to});
        }
        list = total ? crossing.reflected : crossing.transmitted;
    }
    path.p = p, path.d = d;
    path.doubtful = path.doubtful || nine::orderedMedium(list) != 0;  // whispering along a wall for 200 steps
    return path;
}

std::vector<Ball> randomNest(std::mt19937& random) {
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<Ball> balls(std::uniform_int_distribution<size_t>(1, 8)(random));
    for (Ball& ball : balls) {
        for (int i = 0; i < 3; ++i) ball.center[i] = unit(random) - 0.5;
        ball.radius = 0.1 + 0.9 * unit(random);
        ball.ior = 1 + unit(random);
    }
    return balls;
}

}  // namespace

TEST_CASE("ordered nesting is reciprocal: paths through 10,000 random nests of up to 8 balls run back as they came") {
    std::mt19937 random(20);
    std::uniform_real_distribution<double> unit(-1, 1);
    size_t compared = 0, boundaries = 0, doubtful = 0, wrong = 0;
    double worst = 0;
    for (int nest = 0; compared < 10000; ++nest) {
        REQUIRE(nest < 40000);
        const std::vector<Ball> balls = randomNest(random);
        const dvec3 from(5, 3 * unit(random), 3 * unit(random)), to(0, 0.7 * unit(random), 0.7 * unit(random));
        const dvec3 d = glm::normalize(to - from);
        const Path there = walk(balls, from, d, nest % 2 == 0);
        const Path back = walk(balls, there.p + 5.0 * there.d, -there.d, nest % 2 == 0);
        // A path that many reflections make chaotic cannot be walked back in doubles: its end moves far when its start moves little.
        const Path nudged = walk(balls, from + dvec3(0, 1e-12, 1e-12), d, nest % 2 == 0);
        const bool chaotic = glm::length(nudged.p - there.p) > 1e-8 || glm::length(nudged.d - there.d) > 1e-8;
        if (there.doubtful || back.doubtful || there.steps.empty() || chaotic) {
            doubtful += there.steps.empty() ? 0 : 1;
            continue;
        }
        ++compared;
        bool same = there.steps.size() == back.steps.size();
        for (size_t k = 0; same && k < there.steps.size(); ++k) {
            const Step &a = there.steps[k], &b = back.steps[back.steps.size() - 1 - k];
            same = a.from == b.to && a.to == b.from && glm::length(a.p - b.p) < 1e-5;
            worst = std::max(worst, glm::length(a.p - b.p));
        }
        wrong += same ? 0 : 1;
        boundaries += there.steps.size();
    }
    MESSAGE(boundaries, " boundaries on 10000 paths, farthest apart by ", worst, "; ", doubtful,
            " more were too near a rim, or too chaotic, to tell");
    CHECK(wrong == 0);
}
