// What the validator lets through is safe to render; everything else is refused by name. Needs no device.
#include <doctest/doctest.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>

#include "blob_file.hpp"
#include "commands.hpp"
#include "support.hpp"

using test::Blob;

namespace {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

std::vector<char> bake(const test::TemporaryDir& dir, const std::string& json,
                       minirtc::LayoutChoice layout = minirtc::LayoutChoice::quantised, bool onlyDefault = false) {
    static minirtc::KernelCompiler compiler(0);
    minirtc::BakeOptions options;
    options.compiler = &compiler;
    options.onlyDefault = onlyDefault;
    options.scene = dir.write("scene.json", json).string();
    options.output = (dir.path() / "scene.mrt").string();
    options.layout = layout;
    options.quiet = true;
    minirtc::bake(options);
    std::ifstream file(options.output, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

const char* kMinimal = R"({"background":{"color":[1,1,1]},"materials":{"m":{"model":"phong"}},
    "objects":[{"rectangle":{"origin":[0,0,-3],"u":[1,0,0],"v":[0,1,0]},"material":"m"}]})";

/// Something in every section.
std::vector<char> richBlob(minirtc::LayoutChoice layout = minirtc::LayoutChoice::quantised) {
    const test::TemporaryDir dir;
    std::string tga(18, '\0');
    tga[2] = 2, tga[12] = 2, tga[14] = 2, tga[16] = 24, tga[17] = 0x20;
    dir.write("image.tga", tga + std::string(12, '\x7f'));
    dir.write("fan.obj",
              "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0.5\nv -1 0.5 0\nv -1 -1 0.2\nv 0 -1 0\nvt 0 0\nvt 1 0\nvt 0 1\n"
              "f 1/1 2/2 3/3\nf 1/1 3/2 4/3\nf 1/1 4/2 5/3\nf 1/1 5/2 6/3\nf 1/1 6/2 7/3\n");
    return bake(dir, R"({"background":{"image":"image.tga"},"lights":[{"type":"point","position":[0,3,0]}],
        "materials":{"painted":{"model":"pbr","baseColor":"image.tga"},"a":{"model":"phong"},"b":{"model":"phong","diffuse":0.5},
                     "tiles":{"model":"checker","a":"a","b":"b"}},
        "objects":[{"mesh":"fan.obj","material":"painted","smooth":true,"instances":[{},{"translate":[3,0,0]},{"translate":[0,3,0]}]},
                   {"rectangle":{"origin":[0,0,-3],"u":[1,0,0],"v":[0,1,0]},"material":"tiles"},
                   {"sphere":{"center":[0,0,-8]},"material":"a"}]})",
                layout);
}

/// A blob whose kernel says that it picks lights, so that the tables are there: 2 triangles that shine, a spot, 1 environment of 2 x 2 cells.
std::vector<char> pickingBlob() {
    using namespace minirtc;
    const test::TemporaryDir dir;
    std::string tga(18, '\0');
    tga[2] = 2, tga[12] = 2, tga[14] = 2, tga[16] = 24, tga[17] = 0x20;
    dir.write("image.tga", tga + std::string(12, '\x7f'));
    Diagnostics diagnostics;
    const Scene scene =
        loadScene(dir.write("scene.json", R"({"background":{"image":"image.tga"},"render":{"integrator":"path","filter":"tent"},
        "lights":[{"type":"rectangle","u":[1,0,0],"v":[0,1,0]},{"type":"spot","position":[0,3,0],"direction":[0,-2,0]}],
        "materials":{"m":{"model":"pbr","emissiveTexture":"image.tga","baseColor":"image.tga","normalTexture":"image.tga",
                          "metallicRoughnessTexture":"image.tga","textureWrap":"mirror","emissive":[1,1,1]}},
        "camera":{"aperture":0.1,"focusDistance":2},
        "objects":[{"rectangle":{"origin":[0,0,-3],"u":[1,0,0],"v":[0,1,0]},"material":"m"}]})"),
                  diagnostics);
    const Geometry geometry = flatten(scene, diagnostics);
    const Bvh bvh = buildBvh(geometry, 1);
    const EncodedNodes nodes = encodeNodes(bvh, geometry, LayoutChoice::quantised);
    const Volumes volumes = analyseVolumes(scene, geometry, diagnostics);
    const EffectSet effects = analyseEffects(scene, geometry, volumes, false, scene.render.tracesPaths());
    std::vector<Kernel> kernels = {compileKernel("whitted", effects)};
    kernels[0].bindings |= 1u << MINIRT_BINDING_EMITTERS | 1u << MINIRT_BINDING_ENVIRONMENT;
    const std::vector<uint8_t> blob = assembleBlob({scene, geometry, bvh, nodes, volumes, effects, kernels});
    return {blob.begin(), blob.end()};
}

struct Forgery {
    const char* what;
    minirt_result result;
    const char* message;  // a part of it
    std::function<void(Blob&)> forge;
};

void checkForgeries(const std::vector<char>& bytes, const std::vector<Forgery>& forgeries) {
    for (const Forgery& forgery : forgeries) {
        INFO(forgery.what);
        Blob blob(bytes);
        forgery.forge(blob);
        blob.seal();
        std::string message;
        CHECK(blob.validate(&message) == forgery.result);
        INFO(message);
        CHECK(message.find(forgery.message) != std::string::npos);
    }
}

minirt_scene_desc& sceneOf(Blob& blob) {
    return *blob.contents<minirt_scene_desc>("SCENE");
}
minirt_scene_rows& rowsOf(Blob& blob) {
    return *blob.contents<minirt_scene_rows>("ROWS");
}
minirt_kernel& kernelOf(Blob& blob) {
    return *blob.contents<minirt_kernel>("KERNELS");
}

minirt_uvec4& emitterOf(Blob& blob, uint32_t i) {
    return blob.contents<minirt_pick>("EMITTERS")[i].entry;
}
minirt_uvec4& cellOf(Blob& blob, uint32_t i) {
    return blob.contents<minirt_pick>("ENVIRON")[i].entry;
}
minirt_material& materialOf(Blob& blob, uint32_t i) {
    return blob.contents<minirt_material>("MATERIAL")[i];
}

/// Word of the reference of a child in quantised nodes.
uint32_t& childOf(Blob& blob, uint32_t node, int child) {
    return blob.contents<uint32_t>("NODES")[node * 8 + 3 + 4 * child];
}

float asFloat(uint32_t bits) {
    float value;
    std::memcpy(&value, &bits, sizeof value);
    return value;
}

/// The first inner node below the root, and which child of the root it is.
uint32_t innerChild(Blob& blob, int* which) {
    for (*which = 0; *which < 2; ++*which)
        if (!(childOf(blob, 0, *which) & MINIRT_LEAF)) return childOf(blob, 0, *which);
    throw std::runtime_error("the tree is too small");
}

uint32_t materialCount(Blob& blob) {
    return static_cast<uint32_t>(blob.section("MATERIAL").size / sizeof(minirt_material));
}

minirt_material& checkerOf(Blob& blob) {
    minirt_material* materials = blob.contents<minirt_material>("MATERIAL");
    while (!(materials->options.x & MINIRT_MATERIAL_CHECKER)) ++materials;
    return *materials;
}

uint64_t countOf(Blob& blob, const char* tag, size_t stride) {
    return blob.section(tag).size / stride;
}

}  // namespace

TEST_CASE("baked blobs are valid in both node layouts") {
    for (const auto layout : {minirtc::LayoutChoice::quantised, minirtc::LayoutChoice::floating}) {
        Blob blob(richBlob(layout));
        std::string message;
        CHECK(blob.validate(&message) == MINIRT_OK);
        CHECK(message.empty());
        for (const char* tag : {"SCENE", "ROWS", "NODES", "PRIMS", "NORMALS", "UVS", "MATERIAL", "LIGHTS", "IMAGES", "TEXELS",
                                "KERNELS", "SPIRV", "EXPLAIN"})
            CHECK(blob.section(tag).size > 0);
        blob.seal();
        CHECK(blob.validate() == MINIRT_OK);
    }
}

TEST_CASE("every strict prefix of a blob is refused") {
    const test::TemporaryDir dir;
    Blob blob(bake(dir, kMinimal));
    REQUIRE(blob.validate() == MINIRT_OK);
    for (size_t size = 0; size < blob.size(); ++size) {
        const minirt_result expected = size < MINIRT_SIGNATURE_SIZE ? MINIRT_ERROR_NOT_A_BLOB : MINIRT_ERROR_TRUNCATED;
        if (blob.validate(size) != expected) {
            INFO(size);
            REQUIRE(blob.validate(size) == expected);
        }
    }
}

TEST_CASE("every change of one byte is refused") {
    const test::TemporaryDir dir;
    const auto checkChanges = [](Blob& blob, size_t from, size_t to) {
        for (size_t i = from; i < to; ++i)
            for (const uint8_t change : {0x01, 0x80, 0xff}) {
                blob.data()[i] ^= change;
                if (blob.validate() == MINIRT_OK) {
                    INFO(i);
                    REQUIRE(blob.validate() != MINIRT_OK);
                }
                blob.data()[i] ^= change;
            }
        CHECK(blob.validate() == MINIRT_OK);
    };
    // All of a blob with one kernel, as the work is the square of the size; and all but the code of one with the kernels of every integrator.
    Blob small(bake(dir, kMinimal, minirtc::LayoutChoice::quantised, true));
    checkChanges(small, 0, small.size());
    Blob whole(bake(dir, kMinimal));
    const minirt_blob_section code = whole.section("SPIRV");
    CHECK(whole.section("KERNELS").size > small.section("KERNELS").size);
    checkChanges(whole, 0, code.offset);
    checkChanges(whole, code.offset + code.size, whole.size());
}

TEST_CASE("headers and tables that lie are refused by name") {
    const test::TemporaryDir dir;
    checkForgeries(
        bake(dir, kMinimal),
        {
            {"signature", MINIRT_ERROR_NOT_A_BLOB, "signature", [](Blob& b) { b.header().signature[0] = 'x'; }},
            {"version", MINIRT_ERROR_VERSION, "bake the scene again", [](Blob& b) { b.header().version++; }},
            {"byte order", MINIRT_ERROR_VERSION, "byte order", [](Blob& b) { b.header().endian = 0x04030201u; }},
            {"too long", MINIRT_ERROR_TRUNCATED, "header says", [](Blob& b) { b.header().total_size += 256; }},
            {"too short", MINIRT_ERROR_TRUNCATED, "header says", [](Blob& b) { b.header().total_size -= 256; }},
            {"no sections", MINIRT_ERROR_CORRUPT, "sections", [](Blob& b) { b.header().section_count = 0; }},
            {"many sections", MINIRT_ERROR_CORRUPT, "sections",
             [](Blob& b) { b.header().section_count = MINIRT_MAX_SECTIONS + 1; }},
            {"a section fewer", MINIRT_ERROR_TRUNCATED, "bytes of sections", [](Blob& b) { b.header().section_count--; }},
            {"offset outside", MINIRT_ERROR_SECTION_OUT_OF_BOUNDS, "section 2",
             [](Blob& b) { b.table()[2].offset = b.size() + 256; }},
            {"offset that wraps", MINIRT_ERROR_SECTION_OUT_OF_BOUNDS, "section 1",
             [](Blob& b) { b.table()[1].offset = ~uint64_t{0} - 255; }},
            {"overlap", MINIRT_ERROR_SECTION_OUT_OF_BOUNDS, "section 1",
             [](Blob& b) { b.table()[1].offset = b.table()[0].offset; }},
            {"size outside", MINIRT_ERROR_SECTION_OUT_OF_BOUNDS, "section 0", [](Blob& b) { b.table()[0].size = b.size(); }},
            {"size that wraps", MINIRT_ERROR_SECTION_OUT_OF_BOUNDS, "section 0",
             [](Blob& b) { b.table()[0].size = ~uint64_t{0}; }},
            {"size that wraps when aligned", MINIRT_ERROR_SECTION_OUT_OF_BOUNDS, "section 0",
             [](Blob& b) { b.table()[0].size = ~uint64_t{0} - 100; }},
            {"a missing section", MINIRT_ERROR_SECTION_MISSING, "PRIMS", [](Blob& b) { b.section("PRIMS").tag[0] = 'X'; }},
            {"an odd size", MINIRT_ERROR_CORRUPT, "size", [](Blob& b) { b.section("NODES").size -= 4; }},
            {"an empty section", MINIRT_ERROR_SECTION_OUT_OF_BOUNDS, "section", [](Blob& b) { b.section("MATERIAL").size = 0; }},
        });
    Blob blob(bake(dir, kMinimal));
    CHECK(minirt_validate(nullptr, 100, nullptr, nullptr) == MINIRT_ERROR_INVALID_ARGUMENT);
    CHECK(minirt_validate(blob.data() + 1, blob.size() - 1, nullptr, nullptr) == MINIRT_ERROR_INVALID_ARGUMENT);
    CHECK(minirt_validate(blob.data(), blob.size(), nullptr, nullptr) == MINIRT_OK);
}

TEST_CASE("hierarchies that would never end or lead outside are refused by name") {
    const std::vector<char> bytes = richBlob();
    const minirt_result corrupt = MINIRT_ERROR_CORRUPT;
    checkForgeries(
        bytes,
        {
            {"the root as its own child", corrupt, "node 0 has no valid child", [](Blob& b) { childOf(b, 0, 0) = 0; }},
            {"a cycle", corrupt, "has no valid child",
             [](Blob& b) {
                 int which;
                 childOf(b, innerChild(b, &which), 0) = 0;
             }},
            {"a child of two parents", corrupt, "has no valid child",
             [](Blob& b) {
                 int which;
                 childOf(b, 0, 1 - which) = innerChild(b, &which);
             }},
            {"a node without parent", corrupt, "has no parent",
             [](Blob& b) {
                 int which;
                 innerChild(b, &which);
                 childOf(b, 0, which) = MINIRT_LEAF;
             }},
            {"a child outside", corrupt, "no valid child", [](Blob& b) { childOf(b, 0, 0) = 1000000; }},
            {"a leaf outside", corrupt, "leaf", [](Blob& b) { childOf(b, 0, 0) = MINIRT_LEAF | 1000000u << 3; }},
            {"a leaf over the end", corrupt, "leaf",
             [](Blob& b) { childOf(b, 0, 0) = MINIRT_LEAF | static_cast<uint32_t>(countOf(b, "PRIMS", 48) - 1) << 3 | 1; }},
            {"the reference that means none", corrupt, "leaf", [](Blob& b) { childOf(b, 0, 0) = 0xffffffffu; }},
            {"deeper than stated", corrupt, "deeper", [](Blob& b) { sceneOf(b).bvh_depth = 1; }},
            {"no depth", corrupt, "depth 0", [](Blob& b) { sceneOf(b).bvh_depth = 0; }},
            {"a depth of 65", corrupt, "depth 65", [](Blob& b) { sceneOf(b).bvh_depth = 65; }},
            {"another layout", corrupt, "layout 2", [](Blob& b) { sceneOf(b).node_layout = 2; }},
        });
    checkForgeries(richBlob(minirtc::LayoutChoice::floating),
                   {
                       {"a box that is not a number", corrupt, "box", [](Blob& b) { b.contents<float>("NODES")[1] = kNan; }},
                       {"an endless box", corrupt, "box", [](Blob& b) { b.contents<float>("NODES")[12] = kInfinity; }},
                       {"a cycle", corrupt, "no valid child", [](Blob& b) { b.contents<uint32_t>("NODES")[3] = 0; }},
                   });
}

TEST_CASE("numbers and references that no renderer may meet are refused by name") {
    const minirt_result corrupt = MINIRT_ERROR_CORRUPT;
    using Vec4 = minirt_vec4;
    checkForgeries(
        richBlob(),
        {
            {"vertex", corrupt, "primitive 1 ", [](Blob& b) { b.contents<Vec4>("PRIMS")[4].y = kNan; }},
            {"material of a primitive", corrupt, "no material",
             [](Blob& b) { b.contents<Vec4>("PRIMS")[0].w = asFloat(materialCount(b)); }},
            {"corners of a primitive", corrupt, "no corners", [](Blob& b) { b.contents<Vec4>("PRIMS")[2].w = asFloat(1000000); }},
            {"normals that are gone", corrupt, "corners that are not there", [](Blob& b) { b.section("NORMALS").tag[0] = 'X'; }},
            {"texture coordinates that are gone", corrupt, "corners that are not there",
             [](Blob& b) { b.section("UVS").tag[0] = 'X'; }},
            {"endless waiting segments", corrupt, "kernel 0", [](Blob& b) { kernelOf(b).waits = 65; }},
            {"normal", corrupt, "normal", [](Blob& b) { b.contents<float>("NORMALS")[5] = kInfinity; }},
            {"texture coordinate", corrupt, "texture coordinate", [](Blob& b) { b.contents<float>("UVS")[3] = kNan; }},
            {"material", corrupt, "material 0", [](Blob& b) { b.contents<minirt_material>("MATERIAL")[0].transmit.y = kNan; }},
            {"image of a material", corrupt, "no image",
             [](Blob& b) { b.contents<minirt_material>("MATERIAL")[0].options.y = 77; }},
            {"checker of nothing", corrupt, "checker", [](Blob& b) { checkerOf(b).options.z = 1000; }},
            {"checker of itself", corrupt, "checker",
             [](Blob& b) {
                 checkerOf(b).options.w = static_cast<uint32_t>(&checkerOf(b) - b.contents<minirt_material>("MATERIAL"));
             }},
            {"checker without cells", corrupt, "checker", [](Blob& b) { checkerOf(b).checker.w = 0; }},
            {"light", corrupt, "light", [](Blob& b) { b.contents<minirt_light>("LIGHTS")[0].intensity.z = kInfinity; }},
            {"number of lights", corrupt, "2 lights", [](Blob& b) { rowsOf(b).counts.x = 2; }},
            {"background image", corrupt, "background image 9", [](Blob& b) { rowsOf(b).counts.y = 9; }},
            {"image without size", corrupt, "image 0", [](Blob& b) { b.contents<minirt_image>("IMAGES")[0].extent.x = 0; }},
            {"image over the texels", corrupt, "image 0",
             [](Blob& b) { b.contents<minirt_image>("IMAGES")[0].extent.y = 0xffffffffu; }},
            {"image beyond the texels", corrupt, "image 0",
             [](Blob& b) { b.contents<minirt_image>("IMAGES")[0].extent.z = 0xffffffffu; }},
            {"image scale", corrupt, "image 0", [](Blob& b) { b.contents<minirt_image>("IMAGES")[0].scale.x = kNan; }},
            {"texel", corrupt, "texel", [](Blob& b) { b.contents<uint16_t>("TEXELS")[6] = 0x7c00; }},
            {"grid", corrupt, "grid", [](Blob& b) { rowsOf(b).gridScale.y = 0; }},
            {"rows", corrupt, "rows", [](Blob& b) { rowsOf(b).background.w = kNan; }},
            {"origin", corrupt, "not finite", [](Blob& b) { sceneOf(b).origin[2] = static_cast<double>(kInfinity); }},
            {"camera", corrupt, "not finite", [](Blob& b) { sceneOf(b).camera.vfov = static_cast<double>(kNan); }},
            {"cutoff", corrupt, "not finite", [](Blob& b) { sceneOf(b).throughput_cutoff = -1; }},
            {"width", corrupt, "out of range", [](Blob& b) { sceneOf(b).width = 0; }},
            {"height", corrupt, "out of range", [](Blob& b) { sceneOf(b).height = 16385; }},
            {"samples", corrupt, "out of range", [](Blob& b) { sceneOf(b).samples = 0; }},
            {"depth", corrupt, "out of range", [](Blob& b) { sceneOf(b).max_depth = 256; }},
            {"no integrator", corrupt, "integrator 0", [](Blob& b) { sceneOf(b).integrator = 0; }},
            {"another integrator", corrupt, "integrator 5", [](Blob& b) { sceneOf(b).integrator = 5; }},
        });
}

TEST_CASE("kernels that are none are refused by name") {
    const test::TemporaryDir dir;
    const minirt_result corrupt = MINIRT_ERROR_CORRUPT;
    checkForgeries(
        bake(dir, kMinimal),
        {
            {"offset outside", corrupt, "kernel 0", [](Blob& b) { kernelOf(b).spirv_offset = b.size() & ~uint64_t{3}; }},
            {"size outside", corrupt, "kernel 0", [](Blob& b) { kernelOf(b).spirv_size += 1u << 30; }},
            {"size that wraps", corrupt, "kernel 0", [](Blob& b) { kernelOf(b).spirv_size = ~uint64_t{3}; }},
            {"odd size", corrupt, "kernel 0", [](Blob& b) { kernelOf(b).spirv_size -= 2; }},
            {"no code", corrupt, "kernel 0", [](Blob& b) { kernelOf(b).spirv_size = 0; }},
            {"endless name", corrupt, "kernel 0", [](Blob& b) { std::memset(kernelOf(b).name, 'a', sizeof kernelOf(b).name); }},
            {"other bindings", corrupt, "kernel 0", [](Blob& b) { kernelOf(b).bindings |= 1u << MINIRT_BINDING_COUNT; }},
            {"not SPIR-V", corrupt, "not SPIR-V", [](Blob& b) { b.contents<uint32_t>("SPIRV")[0] = 0x07230204u; }},
        });
}

TEST_CASE("a blob that lights are picked from holds all that it should") {
    Blob blob(pickingBlob());
    std::string message;
    CHECK(blob.validate(&message) == MINIRT_OK);
    CHECK(message.empty());
    const minirt_scene_rows& rows = rowsOf(blob);
    CHECK(rows.counts.x == 1);
    CHECK(rows.counts.w == 2 + 2 + 1 + 1);
    CHECK(countOf(blob, "EMITTERS", sizeof(minirt_pick)) == rows.counts.w);
    CHECK(rows.environment.x == 2);
    CHECK(rows.environment.y == 2);
    CHECK(rows.environment.z == emitterOf(blob, 5).w);
    CHECK(rows.environment.w == MINIRT_FILTER_TENT);
    CHECK(emitterOf(blob, 4).x == MINIRT_EMITTER_LIGHT);
    CHECK(emitterOf(blob, 5).x == MINIRT_EMITTER_ENVIRONMENT);
    CHECK(sceneOf(blob).camera.aperture == 0.1);
    CHECK(sceneOf(blob).camera.focus_distance == 2);
    CHECK(sceneOf(blob).integrator == MINIRT_INTEGRATOR_PATH);

    // The panorama and two spaces of a mirrored texture: base colour and emission are one image, roughness and normals another.
    CHECK(countOf(blob, "IMAGES", sizeof(minirt_image)) == 3);
    CHECK(countOf(blob, "TEXELS", 8) == 8);  // the panorama shares the texels of the base colour
    const minirt_image* images = blob.contents<minirt_image>("IMAGES");
    const minirt_material& m = materialOf(blob, 0);
    CHECK(rows.counts.y == 0);
    CHECK(m.options.y == 1);
    CHECK(m.images.x == 2);
    CHECK(m.images.y == 2);
    CHECK(m.images.z == 1);
    CHECK(images[0].extent.w == 0);
    CHECK(images[1].extent.w == (MINIRT_IMAGE_MIRROR_U | MINIRT_IMAGE_MIRROR_V));
    CHECK(images[1].extent.z == images[0].extent.z);
    CHECK(images[2].extent.z != images[0].extent.z);
    CHECK(m.options.x == (MINIRT_MATERIAL_PHYSICAL | MINIRT_MATERIAL_CLEAR_SHADOWS));
    CHECK(m.emission.w > 0);
    CHECK(m.finish.x == 0.5f);
    CHECK(m.transmit.w == 1);

    const minirt_light& spot = blob.contents<minirt_light>("LIGHTS")[0];
    CHECK(spot.options.x == (MINIRT_LIGHT_SPOT | MINIRT_LIGHT_INVERSE_SQUARE));
    CHECK(spot.axis.y == -1);
    CHECK(spot.position.w == doctest::Approx(std::sqrt(0.5)));
    CHECK(spot.intensity.w == 1);
}

TEST_CASE("tables of lights that lead nowhere are refused by name") {
    const minirt_result corrupt = MINIRT_ERROR_CORRUPT;
    checkForgeries(
        pickingBlob(),
        {
            {"number of emitters", corrupt, "7 emitters", [](Blob& b) { rowsOf(b).counts.w = 7; }},
            {"columns", corrupt, "3 columns", [](Blob& b) { rowsOf(b).environment.x = 3; }},
            {"rows that overflow", corrupt, "columns",
             [](Blob& b) { rowsOf(b).environment.x = rowsOf(b).environment.y = 0x80000002u; }},
            {"probability", corrupt, "probability", [](Blob& b) { rowsOf(b).environment.z = 0x7fc00000u; }},
            {"filter", corrupt, "filter", [](Blob& b) { rowsOf(b).environment.w = 3; }},
            {"emitters that are gone", corrupt, "emitters", [](Blob& b) { b.section("EMITTERS").tag[0] = 'X'; }},
            {"emitters that nothing counts", corrupt, "picks emitters that are not there",
             [](Blob& b) { b.section("EMITTERS").tag[0] = 'X', rowsOf(b).counts.w = 0; }},
            {"cells that are gone", corrupt, "columns", [](Blob& b) { b.section("ENVIRON").tag[0] = 'X'; }},
            {"an environment that is gone", corrupt, "emitter 5",
             [](Blob& b) { b.section("ENVIRON").tag[0] = 'X', rowsOf(b).environment.x = rowsOf(b).environment.y = 0; }},
            {"cells that nothing counts", corrupt, "environment that is not there",
             [](Blob& b) {
                 b.section("ENVIRON").tag[0] = 'X', rowsOf(b).environment.x = rowsOf(b).environment.y = 0;
                 emitterOf(b, 5).x = 0;
             }},
            {"a primitive outside", corrupt, "emitter 1", [](Blob& b) { emitterOf(b, 1).x = 4; }},
            {"a light outside", corrupt, "emitter 4", [](Blob& b) { emitterOf(b, 4).x = MINIRT_EMITTER_LIGHT | 1; }},
            {"a second environment", corrupt, "emitter 5", [](Blob& b) { emitterOf(b, 5).x = MINIRT_EMITTER_ENVIRONMENT | 1; }},
            {"of no kind", corrupt, "emitter 0", [](Blob& b) { emitterOf(b, 0).x = 0xc0000000u; }},
            {"alias outside", corrupt, "emitter 2", [](Blob& b) { emitterOf(b, 2).y = 6; }},
            {"probability over 1", corrupt, "emitter 3", [](Blob& b) { emitterOf(b, 3).w = 0x3f800001u; }},
            {"negative probability", corrupt, "emitter 3", [](Blob& b) { emitterOf(b, 3).w = 0xbf000000u; }},
            {"cell's alias outside", corrupt, "cell 1", [](Blob& b) { cellOf(b, 1).y = 4; }},
            {"cell's probability", corrupt, "cell 2", [](Blob& b) { cellOf(b, 2).w = 0x7f800000u; }},
            {"a cell that stands for something", corrupt, "cell 3", [](Blob& b) { cellOf(b, 3).x = 1; }},
            {"image of roughness", corrupt, "material 0 has no image", [](Blob& b) { materialOf(b, 0).images.x = 3; }},
            {"image of normals", corrupt, "material 0 has no image", [](Blob& b) { materialOf(b, 0).images.y = 3; }},
            {"image of emission", corrupt, "material 0 has no image", [](Blob& b) { materialOf(b, 0).images.z = 3; }},
            {"base colour", corrupt, "material 0 ", [](Blob& b) { materialOf(b, 0).base.y = kNan; }},
            {"roughness", corrupt, "material 0 ", [](Blob& b) { materialOf(b, 0).finish.x = kInfinity; }},
            {"density", corrupt, "negative density", [](Blob& b) { materialOf(b, 0).emission.w = -1; }},
            {"axis", corrupt, "light", [](Blob& b) { b.contents<minirt_light>("LIGHTS")[0].axis.x = kNan; }},
            {"wrap", corrupt, "image 1", [](Blob& b) { b.contents<minirt_image>("IMAGES")[1].extent.w = 16; }},
            {"lens", corrupt, "lens", [](Blob& b) { sceneOf(b).camera.aperture = -1; }},
            {"focus", corrupt, "lens", [](Blob& b) { sceneOf(b).camera.focus_distance = 0; }},
        });
}

TEST_CASE("tables with any word changed are refused or still lead only to what is there") {
    const std::vector<char> bytes = pickingBlob();
    for (const char* tag : {"EMITTERS", "ENVIRON"}) {
        Blob blob(bytes);
        const uint64_t words = blob.section(tag).size / 4;
        for (uint64_t i = 0; i < words; ++i) {
            for (const uint32_t value : {0u, 5u, 0x3f800000u, 0x7fffffffu, 0x80000000u, 0xffffffffu}) {
                Blob changed(bytes);
                changed.contents<uint32_t>(tag)[i] = value;
                changed.seal();
                if (changed.validate() != MINIRT_OK) continue;
                const minirt_uvec4& entry = changed.contents<minirt_pick>(tag)[i / 4].entry;
                CHECK(entry.y < words / 4);
                CHECK(asFloat(entry.w) >= 0);
                CHECK(asFloat(entry.w) <= 1);
            }
        }
    }
}
