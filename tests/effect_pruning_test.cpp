// What minirtc leaves out of a kernel is not missed, and what it puts in is needed: scenes that call for each effect, alone and beside each other.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <map>
#include <set>

#include "effect_scenes.hpp"
#include "generate.hpp"
#include "render_scene.hpp"
#include "scene_files.hpp"

using namespace minirtc;
using namespace test;

namespace {

BakeOptions with(const std::vector<std::string>& without) {
    BakeOptions options;
    options.choices.without = without;
    options.choices.force = !without.empty();
    return options;
}

BakeOptions withAll() {
    BakeOptions options;
    options.choices.allEffects = true;
    return options;
}

/// The one kernel of a blob.
std::vector<uint32_t> spirvOf(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    const std::vector<uint8_t> bytes(std::istreambuf_iterator<char>(stream), {});
    minirt_blob blob;
    REQUIRE(minirt_validate(bytes.data(), bytes.size(), &blob, nullptr) == MINIRT_OK);
    REQUIRE(blob.kernel_count == 1);
    std::vector<uint32_t> words(blob.kernels[0].spirv_size / 4);
    std::memcpy(words.data(), blob.spirv + blob.kernels[0].spirv_offset, words.size() * 4);
    return words;
}

/// What a kernel declares.
struct Declarations {
    std::set<uint32_t> bindings;
    size_t functions = 0;
};

Declarations declarationsOf(const std::vector<uint32_t>& spirv) {
    constexpr uint32_t kOpFunction = 54, kOpDecorate = 71, kBinding = 33;
    Declarations declared;
    for (size_t i = 5; i < spirv.size() && spirv[i] >> 16; i += spirv[i] >> 16) {
        const uint32_t operation = spirv[i] & 0xffffu;
        declared.functions += operation == kOpFunction;
        if (operation == kOpDecorate && spirv[i + 2] == kBinding) declared.bindings.insert(spirv[i + 3]);
    }
    return declared;
}

/// Whether a kernel with these effects may read a buffer.
bool mayRead(const EffectSet& effects, uint32_t binding) {
    const auto any = [&](std::initializer_list<Effect> readers) {
        return std::any_of(readers.begin(), readers.end(), [&](Effect effect) { return effects.has(effect); });
    };
    const bool uvs = any({Effect::textures, Effect::alpha, Effect::surfaceMaps, Effect::normalMaps, Effect::emissionMaps});
    const bool lights = any({Effect::pointLights, Effect::directionalLights, Effect::spotLights});
    switch (binding) {
        case MINIRT_BINDING_NORMALS:
            return any({Effect::smoothNormals});
        case MINIRT_BINDING_UVS:
            return uvs;
        case MINIRT_BINDING_IMAGES:
        case MINIRT_BINDING_TEXELS:
            return uvs || any({Effect::backgroundImage});
        case MINIRT_BINDING_LIGHTS:
            return lights;
        case MINIRT_BINDING_MEDIA:
            return any({Effect::nesting, Effect::absorption, Effect::inscatter, Effect::dispersion});
        case MINIRT_BINDING_SPECTRUM:
            return any({Effect::spectral});
        case MINIRT_BINDING_EMITTERS:
            return lights || any({Effect::areaLights, Effect::environmentLight});
        case MINIRT_BINDING_ENVIRONMENT:
            return any({Effect::environmentLight});
        default:
            return true;
    }
}

/// No buffer but those of its effects, and no function but main, which holds all others.
void checkHoldsWhatItNeeds(const std::filesystem::path& blob, const EffectSet& effects) {
    const Declarations declared = declarationsOf(spirvOf(blob));
    CHECK(declared.functions == 1);
    for (const uint32_t binding : declared.bindings) {
        CAPTURE(binding);
        CHECK(mayRead(effects, binding));
    }
}

EffectSet calledFor(const std::filesystem::path& scene, const Parts& some) {
    Diagnostics diagnostics;
    const EffectSet effects = factsOf(scene.string(), diagnostics).effects;
    for (const Part& part : some) {
        CAPTURE(namesOf({part}));
        CHECK(effects.has(part.effect));
    }
    return effects;
}

/// Of pixels, the share with a channel that differs by more than a thousandth; and how much channels differ in the mean.
struct Difference {
    double share = 0, mean = 0;
};

Difference differenceOf(const Picture& a, const Picture& b) {
    REQUIRE(a.rgba.size() == b.rgba.size());
    Difference difference;
    for (size_t i = 0; i < a.rgba.size(); i += 4) {
        bool alike = true;
        for (size_t k = i; k < i + 4; ++k) {
            const float apart = std::abs(a.rgba[k] - b.rgba[k]) / (1 + std::abs(b.rgba[k]));
            alike &= apart <= 1e-3f;  // not so of NaN
            difference.mean += static_cast<double>(apart) / static_cast<double>(a.rgba.size());
        }
        difference.share += alike ? 0 : 4.0 / static_cast<double>(a.rgba.size());
    }
    return difference;
}

/// Compares what kernels draw that differ in effects which no scene of theirs calls for.
class Judge {
public:
    explicit Judge(const GpuContext& gpu) : exact_(gpu.isCpu()) {}
    Judge(const Judge&) = delete;
    Judge& operator=(const Judge&) = delete;
    ~Judge() {
        MESSAGE(pictures_, std::string(exact_ ? " pictures compared bit for bit" : " pictures compared"));
        if (!exact_)
            MESSAGE("at most ", 100 * most_.share, " % of the pixels differ by more than a thousandth, and channels by ",
                    most_.mean, " in the mean");
    }

    /// The same bits on a processor. A GPU's compiler rounds other code otherwise, and a path that then takes another way is another sample of its
    /// pixel: on an H100 some bits differed, and no pixel by more than a thousandth.
    void check(const Picture& pruned, const Picture& full) {
        ++pictures_;
        if (exact_) {
            CHECK(pruned == full);
            return;
        }
        const Difference difference = differenceOf(pruned, full);
        CHECK(difference.share <= 0.005);
        CHECK(difference.mean <= 5e-4);
        most_ = {std::max(most_.share, difference.share), std::max(most_.mean, difference.mean)};
    }

private:
    bool exact_;
    size_t pictures_ = 0;
    Difference most_;
};

/// Bakes scenes of parts, and draws each by a kernel with what it calls for and by one with every effect.
class PruningTest {
public:
    explicit PruningTest(const GpuContext& gpu) : gpu_(gpu), judge_(gpu) { writeFilesOfParts(dir_); }

    /// Returns the picture that both draw.
    Picture check(const Parts& some, Tracer tracer) {
        const auto pruned = bakeScene(dir_, sceneOf(some, tracer), "pruned", with({}));
        const auto full = bakeScene(dir_, sceneOf(some, tracer), "full", withAll());
        checkHoldsWhatItNeeds(pruned, calledFor(dir_.path() / "pruned.json", some));
        CHECK(spirvOf(pruned).size() < spirvOf(full).size());
        Picture picture = draw(pruned);
        judge_.check(picture, draw(full));
        return picture;
    }

    /// Also that the effect changes the picture, and costs code. Parity is another method of nesting, of less code.
    void checkAlone(const Part& part) {
        const Picture picture = check({part}, tracerOf({part}));
        const auto lacking = bakeScene(dir_, sceneOf({part}, tracerOf({part})), "lacking", with({effectInfo(part.effect).name}));
        if (part.effect != Effect::parity) CHECK(spirvOf(lacking).size() < spirvOf(dir_.path() / "pruned.mrt").size());
        CHECK_FALSE(draw(lacking) == picture);
    }

private:
    Picture draw(const std::filesystem::path& blob) const { return LoadedScene(gpu_, blob).render(); }

    const GpuContext& gpu_;
    const TemporaryDir dir_;
    Judge judge_;
};

/// Each pair is in a scene that is drawn, or there is a reason why no scene can hold it.
void checkPairs(Tracer tracer) {
    GpuContext gpu;
    if (!gpu) return;
    PruningTest test(gpu);
    std::set<std::pair<Effect, Effect>> drawn;
    for (const Parts& group : groupsOfPairs(tracer)) {
        CAPTURE(namesOf(group));
        test.check(group, tracer);
        for (const Part& a : group)
            for (const Part& b : group) drawn.insert({a.effect, b.effect});
    }
    std::map<std::string, size_t> counts;
    for (const Parts& pair : pairsOf(tracer)) {
        CAPTURE(namesOf(pair));
        const std::string reason = apart(pair[0], pair[1]);
        CHECK((drawn.count({pair[0].effect, pair[1].effect}) > 0) == reason.empty());
        ++counts[reason.empty() ? "drawn" : reason];
    }
    for (const auto& [what, count] : counts) MESSAGE("pairs: ", count, " ", what);
}

/// The same with nothing else in a scene.
void checkEachPair(Tracer tracer) {
    if (!std::getenv("MINIRT_EVERY_PAIR")) return skip("takes ten minutes; set MINIRT_EVERY_PAIR=1 to run it");
    GpuContext gpu;
    if (!gpu) return;
    PruningTest test(gpu);
    for (const Parts& pair : pairsOf(tracer)) {
        CAPTURE(namesOf(pair));
        if (apart(pair[0], pair[1]).empty()) test.check(pair, tracer);
    }
}

/// By a kernel of the scene's own integrator.
Picture drawPrepared(const GpuContext& gpu, const PreparedScene& prepared, const Choices& choices) {
    static KernelCompiler compiler(0);
    const std::vector<Integrator> own = {prepared.scene.render.integrator};
    const Variant variant = chooseVariant(prepared, own, choices);
    const std::vector<uint8_t> blob = finishBlob(prepared, variant, compiler.compile(kernelJobs(variant, own)));
    const TemporaryDir dir;
    minirt_render_desc desc = {};
    desc.width = 32;
    desc.height = 24;
    desc.samples = 1;
    return LoadedScene(gpu, dir.write("sample.mrt", {blob.begin(), blob.end()})).render(desc);
}

}  // namespace

TEST_CASE("there are parts for every effect but a layout") {
    std::set<Effect> effects;
    for (const Part& part : parts()) effects.insert(part.effect);
    CHECK(effects.size() == parts().size());
    CHECK(effects.size() == kEffectCount - 1);
    CHECK(effects.count(Effect::floatNodes) == 0);
}

TEST_CASE("an effect is seen where it is missing, and where it is alone the others are not missed") {
    GpuContext gpu;
    if (!gpu) return;
    PruningTest test(gpu);
    for (const Part& part : parts()) {
        CAPTURE(namesOf({part}));
        test.checkAlone(part);
    }
}

TEST_CASE("in scenes with every pair of effects of Whitted's tracer, the others are not missed") {
    checkPairs(Tracer::whitted);
}

TEST_CASE("in scenes with every pair of effects that needs the path tracer, the others are not missed") {
    checkPairs(Tracer::path);
}

TEST_CASE("in a scene for each pair of effects of Whitted's tracer, the others are not missed") {
    checkEachPair(Tracer::whitted);
}

TEST_CASE("in a scene for each pair of effects that needs the path tracer, the others are not missed") {
    checkEachPair(Tracer::path);
}

TEST_CASE("in every sample scene, effects that it does not call for are not missed") {
    GpuContext gpu;
    if (!gpu) return;
    const TemporaryDir dir;
    samples::generate(dir.path());
    Judge judge(gpu);
    for (const auto& [name, text] : samples::sceneFiles()) {
        CAPTURE(name);
        Diagnostics diagnostics;
        const PreparedScene prepared =
            prepareScene((dir.path() / name).string(), {LayoutChoice::automatic, BvhQuality::fast}, diagnostics);
        judge.check(drawPrepared(gpu, prepared, {}), drawPrepared(gpu, prepared, withAll().choices));
    }
}
