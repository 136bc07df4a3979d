#include <doctest/doctest.h>

#include <cmath>

#include "geometry.hpp"
#include "scene.hpp"
#include "support.hpp"

using namespace minirtc;

namespace {

/// Loads scene texts from a folder with a small mesh in it.
class Loader {
public:
    Loader() {
        dir_.write("one.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
        dir_.write("bad.obj", "v 0 0 x\n");
        dir_.write("notes.txt", "not an image");
        std::string tga(18, '\0');  // one texel of 24 bits
        tga[2] = 2, tga[12] = tga[14] = 1, tga[16] = 24;
        dir_.write("a.tga", tga + "\x40\x80\xc0");
        dir_.write("b.tga", tga + "\x80\x80\xff");
        dir_.write("black.tga", tga + std::string(3, '\0'));
    }

    Scene load(const std::string& text) { return loadScene(dir_.write("s.json", text), diagnostics); }

    /// The error without the folder's name, or "".
    std::string error(const std::string& text) {
        try {
            load(text);
        } catch (const Error& error) {
            return strip(error.what());
        }
        return "";
    }

    std::string strip(std::string message) const {
        const std::string prefix = dir_.path().string() + "/";
        for (size_t at = message.find(prefix); at != std::string::npos; at = message.find(prefix))
            message.erase(at, prefix.size());
        return message;
    }

    Diagnostics diagnostics;

private:
    test::TemporaryDir dir_;
};

const std::string kBall = R"("materials":{"m":{"model":"phong"}},"objects":[{"sphere":{"radius":1},"material":"m"}])";

/// A scene with one ball and `more` in a line of its own.
std::string with(const std::string& more) {
    return "{" + kBall + ",\n" + more + "}";
}

/// A scene of one ball whose material is `body`, which stands in a line of its own.
std::string material(const std::string& body) {
    return "{\"objects\":[{\"sphere\":{},\"material\":\"m\"}],\"materials\":{\"m\":\n" + body + "}}";
}

/// A scene with one white material and the object `body` in a line of its own.
std::string object(const std::string& body) {
    return "{\"materials\":{\"white\":{\"model\":\"phong\"}},\"objects\":[\n" + body + "]}";
}

struct Bad {
    std::string scene;
    std::string message;
};

void checkAll(const std::vector<Bad>& table) {
    Loader loader;
    for (const Bad& bad : table) {
        CAPTURE(bad.scene);
        CHECK(loader.error(bad.scene) == bad.message);
    }
}

}  // namespace

TEST_CASE("a scene without anything but a shape takes every default") {
    Loader loader;
    const Scene scene = loader.load("{" + kBall + "} // comments are fine\n");
    CHECK(scene.objects.size() == 1);
    CHECK(scene.objects[0].name == "sphere 1");
    CHECK(scene.objects[0].location.line == 1);
    CHECK(scene.camera.vfov == 60);
    CHECK(scene.render.maxDepth == 20);
    CHECK(scene.render.spp == 1);
    CHECK(scene.render.width == 1024);
    CHECK(scene.background.image == kNone);
    REQUIRE(loader.diagnostics.warnings.size() == 1);
    CHECK(loader.strip(loader.diagnostics.warnings[0]) ==
          "s.json: warning: nothing shines; add 'lights' or a 'background', or the picture stays black");
}

TEST_CASE("syntax errors name line and column") {
    checkAll({
        {"",
         "s.json:1:1: not valid JSON: syntax error while parsing value - unexpected end of input, expected '[', '{', or a "
         "literal; "
         "check commas, quotes and brackets here and just before"},
        {"{\n \"camera\" 1}",
         "s.json:2:12: not valid JSON: syntax error while parsing object separator - unexpected number literal, "
         "expected ':'; check commas, quotes and brackets here and just before"},
        {"{\"a\":1,\n\n  \"b\\\"\":2,\n  \"a\":3}", "s.json:4:3: the key 'a' is given twice; remove it here or in line 1"},
        {"{\"camera\":{\"vfov\":\n  1e999}}", "s.json:2:3: the number 1e999 is too large; give a finite number"},
        {std::string(65, '['), "s.json:1:65: the brackets nest too deeply; a scene needs 6 levels"},
        {"[1]", "s.json:1:1: the scene is an array; give an object"},
        {"\xff\xfe{", "s.json: the file is UTF-16; save it as UTF-8 or ASCII"},
    });
    Loader loader;
    CHECK(loader.error("{\"a\":NaN}").substr(0, 26) == "s.json:1:6: not valid JSON");
}

TEST_CASE("unknown keys name the nearest known key") {
    checkAll({
        {with("\"camra\":{}"), "s.json:2:1: the scene has no key 'camra'; did you mean 'camera'?"},
        {with("\"camera\":{\"fov\":3}"), "s.json:2:11: the camera has no key 'fov'; did you mean 'vfov'?"},
        {with("\"render\":{\"xyzzyx\":3}"),
         "s.json:2:11: the render section has no key 'xyzzyx'; known here: integrator, integrators, "
         "maxDepth, spp, size, shadows, dispersionMode, filter, accuracy"},
        {with("\"render\":{\"accuracy\":{\n\"fresnl\":\"none\"}}"),
         "s.json:3:1: the accuracy section has no key 'fresnl'; did you mean 'fresnel'?"},
        {with("\"render\":{\"accuracy\":{\"fresnel\":\n\"shlick\"}}"),
         "s.json:3:1: 'fresnel' is 'shlick'; did you mean 'schlick'?"},
        {with("\"render\":{\"accuracy\":{\"weak_rays\":\n\"roulete\"}}"),
         "s.json:3:1: 'weak_rays' is 'roulete'; did you mean 'roulette'?"},
        {with("\"render\":{\"accuracy\":{\"fresnel\":1}}"), "s.json:2:33: 'fresnel' is a number; give a string"},
        {with("\"render\":{\"accuracy\":7}"), "s.json:2:22: the accuracy section is a number; give an object"},
        {material("{\"model\":\"phong\",\"difuse\":1}"),
         "s.json:2:18: the material 'm' has no key 'difuse'; did you mean 'diffuse'?"},
        {object("{\"sphere\":{},\"scale\":2,\"material\":\"white\"}"),
         "s.json:2:14: a sphere object has no key 'scale'; known here: sphere, material, priority"},
    });
}

TEST_CASE("bad cameras backgrounds and render sections are refused") {
    checkAll({
        {with("\"camera\":{\"position\":[0,0]}"), "s.json:2:22: 'position' has 2 entries; give an array of 3 numbers"},
        {with("\"camera\":{\"position\":[0,\"a\",0]}"), "s.json:2:25: 'position[1]' is a string; give a finite number"},
        {with("\"camera\":{\"position\":[0,0,1e39]}"), "s.json:2:27: 'position[2]' is 1e+39; single precision ends at 3.4e38"},
        {with("\"camera\":{\"position\":7}"), "s.json:2:22: 'position' is a number; give an array of 3 numbers"},
        {with("\"camera\":{\"position\":[1,2,3],\"target\":[1,2,3]}"),
         "s.json:2:39: the camera's position and target are the same point; move one of them"},
        {with("\"camera\":{\"up\":[0,0,-2]}"),
         "s.json:2:16: the camera's 'up' is parallel to the view; give another 'up', such as [0, 0, 1]"},
        {with("\"camera\":{\"up\":[0,0,0]}"), "s.json:2:16: the camera's 'up' has no length; give a direction such as [0, 1, 0]"},
        {with("\"camera\":{\"vfov\":0}"), "s.json:2:18: 'vfov' is 0; give a number over 0 and under 180"},
        {with("\"camera\":{\"vfov\":180}"), "s.json:2:18: 'vfov' is 180; give a number over 0 and under 180"},
        {with("\"camera\":{\"vfov\":true}"), "s.json:2:18: 'vfov' is true or false; give a number over 0 and under 180"},
        {with("\"camera\":{\"aperture\":-1}"), "s.json:2:22: 'aperture' is -1; give a number at least 0"},
        {with("\"camera\":{\"focusDistance\":0}"), "s.json:2:27: 'focusDistance' is 0; give a number over 0"},
        {with("\"background\":{\"image\":\"no.png\"}"),
         "s.json:2:23: there is no file 'no.png'; paths are relative to the scene file's folder"},
        {with("\"background\":{\"image\":\".\"}"), "s.json:2:23: '.' is a folder; paths are relative to the scene file's folder"},
        {with("\"background\":{\"image\":\"notes.txt\"}"),
         "notes.txt: the image cannot be read (unknown image type); give a .jpg, .png, .bmp, .tga, .hdr or .exr file"},
        {with("\"background\":{\"color\":[0,0,-1]}"), "s.json:2:28: 'color[2]' is -1; give a number at least 0"},
        {with("\"background\":{\"color\":[0,0,1],\"image\":\"a\"}"),
         "s.json:2:23: the background has both 'image' and 'color'; keep one of them"},
        {with("\"render\":{\"size\":[0,4]}"),
         "s.json:2:19: this is no size of a picture; give [width, height] in whole pixels from 1 to 16384"},
        {with("\"render\":{\"size\":[4,16385]}"),
         "s.json:2:21: this is no size of a picture; give [width, height] in whole pixels from 1 to 16384"},
        {with("\"render\":{\"spp\":0}"), "s.json:2:17: 'spp' is 0; give a whole number from 1 to 65536"},
        {with("\"render\":{\"spp\":1.5}"), "s.json:2:17: 'spp' is 1.5; give a whole number from 1 to 65536"},
        {with("\"render\":{\"maxDepth\":256}"), "s.json:2:22: 'maxDepth' is 256; give a whole number from 0 to 255"},
        {with("\"render\":{\"integrators\":[]}"), "s.json:2:25: 'integrators' is empty; name one or leave it out"},
        {with("\"render\":{\"integrators\":[\"path\",\"whited\"]}"),
         "s.json:2:33: there is no integrator 'whited'; did you mean 'whitted'?"},
        {with("\"render\":{\"integrators\":[\"path\"],\"integrator\":\"whitted\"}"),
         "s.json:2:47: 'integrator' is none of 'integrators'; add it there or name another one"},
        {with("\"render\":{\"filter\":\"lanczos\"}"), "s.json:2:20: 'filter' is 'lanczos'; known here: box, tent, gaussian"},
        {with("\"render\":{\"integrator\":\"whited\"}"), "s.json:2:24: 'integrator' is 'whited'; did you mean 'whitted'?"},
        {with("\"nesting\":\"orderd\""), "s.json:2:11: 'nesting' is 'orderd'; did you mean 'ordered'?"},
    });
}

TEST_CASE("bad lights are refused") {
    checkAll({
        {with("\"lights\":[{}]"), "s.json:2:11: a light has no 'type'; add it"},
        {with("\"lights\":[{\"type\":\"spot\"}]"), "s.json:2:11: a spot light has no 'position'; add it"},
        {with("\"lights\":[{\"type\":\"spot\",\"position\":[0,0,0]}]"), "s.json:2:11: a spot light has no 'direction'; add it"},
        {with("\"lights\":[{\"type\":\"spot\",\"position\":[0,0,0],\"direction\":[0,0,1],\"outerConeAngle\":91}]"),
         "s.json:2:82: 'outerConeAngle' is 91; give a number over 0 and at most 90"},
        {with("\"lights\":[{\"type\":\"spot\",\"position\":[0,0,0],\"direction\":[0,0,1],\"innerConeAngle\":-1}]"),
         "s.json:2:82: 'innerConeAngle' is -1; give a number at least 0 and at most 90"},
        {with("\"lights\":[{\"type\":\"spot\",\"position\":[0,0,0],\"direction\":[0,0,1],\"innerConeAngle\":46}]"),
         "s.json:2:82: the inner cone is wider than the outer one; make 'outerConeAngle' (its default is 45) at least as wide"},
        {with("\"lights\":[{\"type\":\"rectangle\",\"u\":[1,0,0],\"v\":[0,0,0]}]"),
         "s.json:2:11: the light has no area; 'u' and 'v' must differ in direction"},
        {with("\"lights\":[{\"type\":\"rectangle\",\"u\":[1,0,0],\"v\":[0,1,0],\"radiance\":[1,-1,1]}]"),
         "s.json:2:69: 'radiance[1]' is -1; give a number at least 0"},
        {with("\"lights\":[{\"type\":\"sphere\",\"radius\":0}]"), "s.json:2:37: 'radius' is 0; give a number over 0"},
        {with("\"lights\":[{\"type\":\"sphere\",\"u\":[1,0,0]}]"),
         "s.json:2:28: a sphere light has no key 'u'; known here: type, radiance, center, radius"},
        {with("\"lights\":[{\"type\":\"pont\"}]"), "s.json:2:19: 'type' is 'pont'; did you mean 'point'?"},
        {with("\"lights\":[{\"type\":\"point\"}]"), "s.json:2:11: a point light has no 'position'; add it"},
        {with("\"lights\":[{\"type\":\"directional\",\"direction\":[0,0,0]}]"),
         "s.json:2:45: 'direction' has no length; give the way the light travels"},
        {with("\"lights\":[{\"type\":\"directional\",\"intensity\":[0,0,0]}]"),
         "s.json:2:33: a directional light has no key 'intensity'; known here: type, direction, irradiance"},
        {with("\"lights\":{}"), "s.json:2:10: 'lights' is an object; give an array"},
    });
}

TEST_CASE("bad materials are refused") {
    checkAll({
        {material("{}"), "s.json:2:1: the material 'm' has no 'model'; add \"model\": \"phong\", \"pbr\" or \"checker\""},
        {material("{\"model\":\"fong\"}"), "s.json:2:10: 'model' is 'fong'; did you mean 'phong'?"},
        {material("{\"model\":\"phong\",\"ior\":0}"), "s.json:2:24: 'ior' is 0; give a number over 0"},
        {material("{\"model\":\"phong\",\"ior\":1e-60}"), "s.json:2:24: 'ior' is 1e-60; give a number over 0"},
        {material("{\"model\":\"pbr\",\"baseColor\":[1,1,2]}"),
         "s.json:2:33: 'baseColor[2]' is 2; give a number at least 0 and at most 1"},
        {material("{\"model\":\"pbr\",\"transmission\":1}"),
         "s.json:2:31: the integrator 'whitted' cannot draw transmission with roughness over 0; set 'roughness' to 0 (its "
         "default is "
         "0.5), or draw with \"integrator\": \"path\""},
        {material("{\"model\":\"pbr\",\"metallic\":1,\"roughness\":0.2}"),
         "s.json:2:41: the integrator 'whitted' cannot draw metallic with roughness over 0; set 'roughness' to 0 (its default is "
         "0.5), or draw with \"integrator\": \"path\""},
        {material("{\"model\":\"pbr\",\"transmission\":1,\"thin\":true}"),
         "s.json:2:40: a thin sheet cannot be rough; set 'roughness' to 0 (its default is 0.5)"},
        {material("{\"model\":\"pbr\",\"transmission\":1,\"roughness\":0,\"alphaMode\":\"blend\"}"),
         "s.json:2:59: what transmits fills a volume, whose surface cannot have holes; leave 'alphaMode' out, or add \"thin\": "
         "true"},
        {material("{\"model\":\"pbr\",\"emissive\":[0,-1,0]}"), "s.json:2:30: 'emissive[1]' is -1; give a number at least 0"},
        {material("{\"model\":\"pbr\",\"alpha\":2}"), "s.json:2:24: 'alpha' is 2; give a number at least 0 and at most 1"},
        {material("{\"model\":\"pbr\",\"textureWrap\":\"mirrored\"}"),
         "s.json:2:30: 'textureWrap' is 'mirrored'; did you mean 'mirror'?"},
        {material("{\"model\":\"pbr\",\"alphaMode\":\"masked\"}"), "s.json:2:28: 'alphaMode' is 'masked'; did you mean 'mask'?"},
        {material("{\"model\":\"pbr\",\"normalTexture\":\"n.png\"}"),
         "s.json:2:32: there is no file 'n.png'; paths are relative to the scene file's folder"},
        {material("{\"model\":\"pbr\",\"glass\":\"window\"}"),
         "s.json:2:24: there is no glass 'window'; known here: bk7, f2, sf11, n-sf11, n-sf66, fused_silica, diamond, sapphire, "
         "cubic_zirconia, water, ice, ethanol"},
        {material("{\"model\":\"pbr\",\"glass\":\"F2\",\"ior\":1.6}"),
         "s.json:2:35: 'ior' stands beside 'glass', which brings its own; keep one of them"},
        {material("{\"model\":\"checker\",\"a\":\"n\",\"b\":\"m\"}"), "s.json:2:24: there is no material 'n'; known here: m"},
        {material("{\"model\":\"checker\",\"a\":\"m\",\"b\":\"m\"}"),
         "s.json:2:24: 'm' is a checker itself; name a phong or pbr material"},
        {material("{\"model\":\"checker\",\"a\":\"m\"}"), "s.json:2:1: the material 'm' has no 'b'; add it"},
        {material("7"), "s.json:2:1: the material 'm' is a number; give an object"},
    });
}

TEST_CASE("bad objects are refused") {
    checkAll({
        {"{}", "s.json:1:1: the scene has no 'objects'; add it"},
        {"{\"objects\":[]}", "s.json:1:12: there is nothing to render; add an object to 'objects'"},
        {object("{}"), "s.json:2:1: an object has no shape; add 'mesh', 'sphere' or 'rectangle'"},
        {object("{\"spere\":{}}"), "s.json:2:2: an object has no key 'spere'; did you mean 'sphere'?"},
        {object("{\"mesh\":\"two.obj\"}"),
         "s.json:2:9: there is no file 'two.obj'; paths are relative to the scene file's folder"},
        {object("{\"mesh\":\"bad.obj\"}"), "bad.obj:1: 'x' is not a finite number; repair the line"},
        {object("{\"mesh\":\"one.obj\",\"material\":\"whit\"}"),
         "s.json:2:30: there is no material 'whit'; did you mean 'white'?"},
        {object("{\"mesh\":\"one.obj\",\"sphere\":{}}"),
         "s.json:2:1: an object has more than one shape; split it into one object a shape"},
        {object("{\"mesh\":\"one.obj\",\"scale\":0}"), "s.json:2:27: 'scale' is zero; no axis may be scaled to nothing"},
        {object("{\"mesh\":\"one.obj\",\"scale\":[1,0,1]}"), "s.json:2:27: 'scale' is zero; no axis may be scaled to nothing"},
        {object("{\"mesh\":\"one.obj\",\"scale\":\"2\"}"),
         "s.json:2:27: 'scale' is a string; give a number or an array of 3 numbers"},
        {object("{\"mesh\":\"one.obj\",\"smooth\":1}"), "s.json:2:28: 'smooth' is a number; give true or false"},
        {object("{\"mesh\":\"one.obj\",\"instances\":[]}"),
         "s.json:2:31: 'instances' is empty; give one transform or leave it out"},
        {object("{\"mesh\":\"one.obj\",\"scale\":2,\"instances\":[{}]}"),
         "s.json:2:27: an object with 'instances' has 'scale' of its own; move it into each instance"},
        {object("{\"sphere\":{\"radius\":0},\"material\":\"white\"}"), "s.json:2:21: 'radius' is 0; give a number over 0"},
        {object("{\"sphere\":{}}"), "s.json:2:1: a sphere object has no 'material'; add it"},
        {object("{\"sphere\":{},\"material\":null}"), "s.json:2:25: only a mesh brings a material of its own; name a material"},
        {object("{\"rectangle\":{\"u\":[1,0,0],\"v\":[2,0,0]},\"material\":\"white\"}"),
         "s.json:2:14: the rectangle has no area; 'u' and 'v' must differ in direction"},
        {"{\"materials\":{\"m\":{\"model\":\"pbr\",\"normalTexture\":\"a.tga\"}},\"objects\":[{\"sphere\":{},\"material\":\"m\"}]"
         "}",
         "s.json:1:95: a texture on a sphere is not in this version; use a plain colour or a mesh"},
        {object("{\"rectangle\":{\"u\":[1,0,0]},\"material\":\"white\"}"), "s.json:2:14: a rectangle has no 'v'; add it"},
        {object("{\"sphere\":{},\"material\":\"white\",\"priority\":0.5}"),
         "s.json:2:44: 'priority' is not whole; give a whole number"},
    });
    Diagnostics diagnostics;
    CHECK_THROWS_WITH_AS(loadScene("no-such-scene.json", diagnostics),
                         "no-such-scene.json: the file cannot be opened; check that it exists and may be read", Error);
}

TEST_CASE("phong materials become weights") {
    Loader loader;
    const Scene scene = loader.load(R"({"materials":{
"gem":{"model":"phong","diffuse":0.5,"specular":2,"reflect":0.1,"refract":0.8,"color":[0.6,0.7,0.8],"shininess":125,"ior":1.5},
"ice":{"model":"phong","diffuse":0,"reflect":0.25,"refract":0.5,"fresnel":true},
"floor":{"model":"checker","a":"white","b":"black","scale":2},"white":{"model":"phong"},"black":{"model":"phong","diffuse":0}},
"objects":[{"sphere":{},"material":"floor"}]})");
    REQUIRE(scene.materials.size() == 5);
    const Material& gem = scene.materials[0];
    CHECK(gem.name == "gem");
    CHECK(gem.diffuse == 0.5f * glm::vec3(0.6f, 0.7f, 0.8f));
    CHECK(gem.specular == 2.0f * glm::vec3(0.6f, 0.7f, 0.8f));
    CHECK(gem.reflect == glm::vec3(0.1f));
    CHECK(gem.transmit == glm::vec3(0.8f));
    CHECK(gem.shininess == 125);
    CHECK(gem.ior == 1.5f);
    CHECK_FALSE(gem.fresnel);
    CHECK(scene.materials[1].fresnel);
    CHECK(scene.materials[1].reflect == glm::vec3(0.75f));
    CHECK(scene.materials[1].transmit == glm::vec3(0.75f));
    CHECK(scene.materials[2].checker);
    CHECK(scene.materials[2].checkerA == 3);
    CHECK(scene.materials[2].checkerB == 4);
    CHECK(scene.materials[2].checkerScale == 2);
}

TEST_CASE("pbr materials become weights") {
    Loader loader;
    const Scene scene = loader.load(R"({"materials":{
"matte":{"model":"pbr","baseColor":[0.2,0.4,0.8],"emissive":[1,2,3]},
"mirror":{"model":"pbr","baseColor":[0.2,0.4,0.8],"metallic":1,"roughness":0},
"glass":{"model":"pbr","baseColor":[0.2,0.4,0.8],"transmission":1,"roughness":0,"ior":0.75}},
"objects":[{"sphere":{},"material":"matte"}]})");
    const glm::vec3 base(0.2f, 0.4f, 0.8f);
    const Material &matte = scene.materials[0], &mirror = scene.materials[1], &glass = scene.materials[2];
    CHECK(glm::length(matte.diffuse - base / 3.14159265f) < 1e-7f);
    CHECK(matte.reflect == glm::vec3(0));
    CHECK(matte.transmit == glm::vec3(0));
    CHECK(matte.emission == glm::vec3(1, 2, 3));
    CHECK(mirror.diffuse == glm::vec3(0));
    CHECK(mirror.reflect == base);
    CHECK_FALSE(mirror.fresnel);
    CHECK(glass.diffuse == glm::vec3(0));
    CHECK(glass.reflect == glm::vec3(1));
    CHECK(glass.transmit == base);
    CHECK(glass.fresnel);
    CHECK(glass.ior == 0.75f);
}

TEST_CASE("pbr materials keep what only path tracers know") {
    Loader loader;
    const Scene scene = loader.load(R"({"render":{"integrator":"path"},"materials":{
"plain":{"model":"pbr"},
"all":{"model":"pbr","baseColor":"a.tga","metallic":0.75,"roughness":0.25,"metallicRoughnessTexture":"a.tga","normalTexture":"b.tga",
  "normalScale":-2,"emissive":[1,2,3],"emissiveTexture":"a.tga","doubleSided":true,"alpha":0.5,"alphaMode":"mask","alphaCutoff":0.125,
  "textureWrap":"clamp"},
"frosted":{"model":"pbr","transmission":1,"roughness":0.3},
"pane":{"model":"pbr","transmission":0.5,"roughness":0,"thin":true,"alphaMode":"blend","textureWrap":"mirror"},
"phong":{"model":"phong"}},"objects":[{"sphere":{},"material":"plain"}],"background":{"image":"a.tga"}})");
    const Material &plain = scene.materials[0], &all = scene.materials[1], &pane = scene.materials[3];
    REQUIRE(plain.physical.has_value());
    CHECK(plain.physical->roughness == 0.5f);
    CHECK(plain.alphaMode == AlphaMode::opaque);
    CHECK_FALSE(plain.doubleSided);
    CHECK(plain.wrap == Wrap::repeat);
    CHECK_FALSE(isTextured(plain));
    CHECK(all.physical->baseColor == glm::vec3(1));
    CHECK(all.physical->metallic == 0.75f);
    CHECK(all.physical->roughness == 0.25f);
    CHECK(isTextured(all));
    REQUIRE(scene.images.size() == 3);  // a as colour and as data, b as data
    CHECK(all.diffuseTexture == scene.background.image);
    CHECK(all.emissionTexture == all.diffuseTexture);
    CHECK(scene.images[all.diffuseTexture].space == ColorSpace::srgb);
    CHECK(scene.images[all.surfaceTexture].space == ColorSpace::linear);
    CHECK(scene.images[all.surfaceTexture].name == scene.images[all.diffuseTexture].name);
    CHECK(scene.images[all.normalTexture].space == ColorSpace::linear);
    CHECK(all.normalScale == -2);
    CHECK(all.emission == glm::vec3(1, 2, 3));
    CHECK(all.doubleSided);
    CHECK(all.alpha == 0.5f);
    CHECK(all.alphaMode == AlphaMode::mask);
    CHECK(all.alphaCutoff == 0.125f);
    CHECK(all.wrap == Wrap::clamp);
    CHECK(scene.materials[2].physical->transmission == 1);
    CHECK(scene.materials[2].physical->roughness == 0.3f);
    CHECK(pane.alphaMode == AlphaMode::blend);
    CHECK(pane.wrap == Wrap::mirror);
    CHECK_FALSE(scene.materials[4].physical.has_value());
}

TEST_CASE("lights with size become objects that shine") {
    Loader loader;
    const Scene scene = loader.load("{" + kBall + R"(,"lights":[{"type":"rectangle","origin":[1,2,3],"u":[1,0,0],"v":[0,0,2],
"radiance":[4,5,6]},{"type":"spot","position":[1,2,3],"direction":[0,-2,0],"intensity":[7,8,9],"innerConeAngle":20,"falloff":"none"},
{"type":"sphere","center":[3,2,1],"radius":0.5},{"type":"rectangle","u":[1,0,0],"v":[0,1,0]}]})");
    REQUIRE(scene.objects.size() == 4);
    CHECK(scene.objects[0].name == "sphere 1");
    CHECK(scene.objects[1].name == "rectangle light 1");
    CHECK(scene.objects[2].name == "sphere light 1");
    CHECK(scene.objects[3].name == "rectangle light 2");
    CHECK(scene.objects[1].rectangle.origin == glm::dvec3(1, 2, 3));
    CHECK(scene.objects[1].rectangle.v == glm::dvec3(0, 0, 2));
    CHECK(scene.objects[1].location.line == 1);
    CHECK(scene.objects[2].location.line == 3);
    CHECK(scene.objects[2].sphere.center == glm::dvec3(3, 2, 1));
    CHECK(scene.objects[2].sphere.radius == 0.5);
    const Material &glow = scene.materials[scene.objects[1].material], &round = scene.materials[scene.objects[2].material];
    CHECK(glow.emission == glm::vec3(4, 5, 6));
    CHECK(glow.name == "rectangle light 1");
    CHECK(glow.diffuse == glm::vec3(0));
    REQUIRE(glow.physical.has_value());
    CHECK(glow.physical->baseColor == glm::vec3(0));
    CHECK(glow.ior == 1);
    CHECK(round.emission == glm::vec3(1));
    REQUIRE(scene.lights.size() == 1);
    CHECK(scene.lights[0].type == LightType::spot);
    CHECK(scene.lights[0].intensity == glm::vec3(7, 8, 9));
    CHECK(scene.lights[0].innerCone == 20);
    CHECK(scene.lights[0].outerCone == 45);
    CHECK_FALSE(scene.lights[0].inverseSquare);
    const SpotCosines cosines = spotCosines(scene.lights[0]);
    CHECK(cosines.inner == doctest::Approx(std::cos(glm::radians(20.0))));
    CHECK(cosines.outer == doctest::Approx(std::sqrt(0.5)));
}

TEST_CASE("a blob is for the integrators that can draw its scene unless the scene says which") {
    const std::string rough = R"("materials":{"m":{"model":"pbr","metallic":1}},"objects":[{"sphere":{},"material":"m"}],)";
    const std::string matte = R"("materials":{"m":{"model":"pbr"}},"objects":[{"sphere":{},"material":"m"}],)";
    using List = std::vector<Integrator>;
    const auto render = [](const std::string& scene, const std::string& keys) {
        Loader loader;
        return loader.load("{" + scene + R"("render":{)" + keys + "}}").render;
    };
    CHECK(render(matte, "").integrators == List{Integrator::whitted, Integrator::path, Integrator::wavefront});
    CHECK(render(matte, "").integrator == Integrator::whitted);
    CHECK(render(matte, R"("integrator":"wavefront")").integrator == Integrator::wavefront);
    CHECK(render(matte, R"("integrator":"path")").integrators.size() == 3);
    CHECK(render(rough, R"("integrator":"path")").integrators == List{Integrator::path, Integrator::wavefront});
    CHECK(render(rough, R"("integrators":["wavefront","path","path"])").integrators ==
          List{Integrator::path, Integrator::wavefront});
    CHECK(render(rough, R"("integrators":["wavefront","path"])").integrator == Integrator::path);
    CHECK(render(matte, R"("integrators":["whitted"])").integrators == List{Integrator::whitted});
    CHECK_FALSE(render(matte, R"("integrators":["whitted"])").tracesPaths());
    CHECK(render(matte, R"("filter":"gaussian")").filter == Filter::gaussian);
    Loader loader;
    CHECK(
        loader.error("{" + rough + R"("render":{}})") ==
        "s.json:1:45: the integrator 'whitted' cannot draw metallic with roughness over 0; set 'roughness' to 0 (its default is "
        "0.5), or draw with \"integrator\": \"path\"");
    CHECK(
        loader.error("{" + rough + R"("render":{"integrator":"path","integrators":["path","whitted"]}})") ==
        "s.json:1:45: the integrator 'whitted' cannot draw metallic with roughness over 0; set 'roughness' to 0 (its default is "
        "0.5), or leave it out of 'integrators'");
    CHECK(loader.error(R"({"materials":{"m":{"model":"pbr","metallic":1,"roughness":0,
"baseColor":"a.tga"}},"objects":[{"sphere":{},"material":"m"}]})") ==
          "s.json:2:13: the integrator 'whitted' cannot draw a texture on metal or glass; give 'baseColor' as [r, g, b], or draw "
          "with \"integrator\": \"path\"");
}

TEST_CASE("what a scene asks for in vain gives a warning") {
    const auto warnings = [](const std::string& more) {
        Loader loader;
        loader.load(with(more));
        std::string all;
        for (const std::string& warning : loader.diagnostics.warnings) all += loader.strip(warning) + "\n";
        return all;
    };
    const std::string sun = R"("lights":[{"type":"directional","direction":[0,-1,0]}])";
    const std::string lamp = R"("lights":[{"type":"sphere","center":[0,5,0]}])";
    const std::string dark = "s.json: warning: nothing shines; add 'lights' or a 'background', or the picture stays black\n";
    CHECK(warnings(sun).empty());
    CHECK(warnings(R"("render":{"integrator":"path"})") == dark);
    CHECK(warnings(R"("lights":[{"type":"point","position":[0,3,0],"intensity":[0,0,0]}])") == dark);
    CHECK(warnings(R"("background":{"image":"black.tga"})") == dark);
    CHECK(warnings(R"("background":{"image":"a.tga","strength":0})") == dark);
    CHECK(warnings(R"("background":{"image":"a.tga"})").empty());
    CHECK(warnings(lamp) ==
          "s.json: warning: lights with size are seen by the integrator 'whitted', but light nothing; add a point, spot or "
          "directional light or \"integrator\": \"path\"\n");
    CHECK(warnings(lamp + R"(,"render":{"integrator":"path"},"camera":{"aperture":0.1})").empty());
    CHECK(warnings(sun + R"(,"camera":{"aperture":0.1})") ==
          "s.json: warning: 'aperture' has no effect with the integrator 'whitted'; add \"integrator\": \"path\"\n");
}

TEST_CASE("what fills an object is read as coefficients and black and white are exact") {
    Loader loader;
    const Scene scene = loader.load(R"({"nesting":"parity","render":{"shadows":"opaque"},"materials":{
"clear":{"model":"pbr","transmission":1,"roughness":0,"attenuationColor":[1,0.5,0],"attenuationDistance":2,"inscatter":0.25},
"sheet":{"model":"pbr","transmission":1,"roughness":0,"thin":true}},
"objects":[{"sphere":{},"material":"clear","priority":3},{"rectangle":{"u":[1,0,0],"v":[0,1,0]},"material":"sheet"}]})");
    const Medium& medium = scene.materials[0].medium;
    CHECK(medium.absorption.r == 0);
    CHECK(medium.absorption.g == doctest::Approx(std::log(2.0) / 2));
    CHECK(medium.absorption.b >= 1e29f);
    CHECK(medium.inscatter == 0.25f);
    CHECK(boundsVolume(scene.materials[0]));
    CHECK_FALSE(boundsVolume(scene.materials[1]));
    CHECK_FALSE(scene.materials[0].clearShadows);
    CHECK(scene.nesting == Nesting::parity);
    CHECK(scene.objects[0].priority == 3);
}

TEST_CASE("an opaque material that tells of its inside is warned of, key by key") {
    const auto warnings = [](const std::string& transmission) {
        Loader loader;
        loader.load(R"({"materials":{"milk":{"model":"pbr","roughness":0,"transmission":)" + transmission +
                    R"(,"attenuationColor":[1,0.5,0],"attenuationDistance":2,
"inscatter":0.25,"glass":"water"}},"background":{"color":[1,1,1]},"objects":[{"sphere":{},"material":"milk"}]})");
        for (std::string& warning : loader.diagnostics.warnings) warning = loader.strip(warning);
        return loader.diagnostics.warnings;
    };
    CHECK(warnings("0.1").empty());
    const std::vector<std::string> opaque = warnings("0");
    REQUIRE(opaque.size() == 4);
    CHECK(
        opaque[0] ==
        "s.json:1:87: warning: the material 'milk' is opaque: 'attenuationColor' tells of an inside that it does not have; give "
        "it 'transmission' or leave the key out");
    const char* keys[] = {"'attenuationColor'", "'attenuationDistance'", "'inscatter'", "'glass'"};
    for (size_t i = 0; i < 4; ++i) CHECK(opaque[i].find(keys[i]) != std::string::npos);
}

TEST_CASE("shadows are clear by the model unless the scene says which") {
    const auto clear = [](const std::string& render) {
        Loader loader;
        const Scene scene = loader.load("{" + render + R"("materials":{"p":{"model":"phong","refract":1},
"g":{"model":"pbr","transmission":1,"roughness":0}},"objects":[{"sphere":{},"material":"p"}]})");
        return std::make_pair(scene.materials[0].clearShadows, scene.materials[1].clearShadows);
    };
    CHECK(clear("") == std::make_pair(false, true));
    CHECK(clear(R"("render":{"shadows":"transmissive"},)") == std::make_pair(true, true));
    CHECK(clear(R"("render":{"shadows":"opaque"},)") == std::make_pair(false, false));
}

TEST_CASE("a mesh that several objects name is loaded once") {
    Loader loader;
    const Scene scene =
        loader.load(object("{\"mesh\":\"one.obj\",\"material\":\"white\"},{\"mesh\":\"./one.obj\"},"
                           "{\"mesh\":\"one.obj\",\"material\":null,\"smooth\":true,\"instances\":[{},{\"scale\":[1,2,3]}]}"));
    CHECK(scene.meshes.size() == 1);
    REQUIRE(scene.objects.size() == 3);
    CHECK(scene.objects[0].material == 0);
    CHECK(scene.objects[1].material == kNone);
    CHECK(scene.objects[2].instances.size() == 2);
    CHECK(scene.objects[2].instances[1].scale == glm::dvec3(1, 2, 3));
    CHECK(scene.objects[2].smooth == true);
    CHECK_FALSE(scene.objects[1].smooth.has_value());
    REQUIRE(scene.meshes[0].materials.size() == 1);
    CHECK(scene.materials[scene.meshes[0].materials[0]].diffuse == glm::vec3(0.5f));
}

TEST_CASE("every prefix of a scene file loads or is refused with its place") {
    Loader loader;
    const std::string text = with("\"camera\":{\"position\":[1,2,3]},\"lights\":[{\"type\":\"point\",\"position\":[0,1.5e1,0]}]");
    for (size_t length = 0; length < text.size(); ++length) {
        CAPTURE(length);
        CHECK(loader.error(text.substr(0, length)).find("s.json:") == 0);
    }
    CHECK(loader.error(text) == "");
}

TEST_CASE("the seed scenes load with the counts of their files") {
    if (!test::haveShared("scenes/seed")) return;
    struct Expected {
        const char* name;
        size_t objects, materials, primitives;
        uint64_t degenerate;
        bool smooth;
    };
    for (const Expected& expected :
         {Expected{"five", 6, 8, 53875, 4, true}, Expected{"gem", 2, 4, 136, 0, false}, Expected{"duck", 2, 4, 510, 0, true},
          Expected{"whisky", 4, 6, 38068, 0, true}, Expected{"whisky_airgap", 4, 6, 22146, 0, true},
          Expected{"whisky_phong", 4, 6, 38068, 0, true}}) {
        CAPTURE(expected.name);
        Diagnostics diagnostics;
        const Scene scene = loadScene(test::sharedDir() / "scenes/seed" / (std::string(expected.name) + ".json"), diagnostics);
        CHECK(scene.objects.size() == expected.objects);
        CHECK(scene.materials.size() == expected.materials);
        CHECK(scene.lights.size() == 3);
        CHECK_FALSE(scene.lights[0].inverseSquare);
        REQUIRE(scene.images.size() == 1);
        CHECK(scene.images[0].width == 7616);
        const Geometry geometry = flatten(scene, diagnostics);
        CHECK(geometry.primitives.size() == expected.primitives);
        CHECK(geometry.degenerateTriangles == expected.degenerate);
        CHECK(geometry.anySmooth == expected.smooth);
        CHECK(geometry.bodies.size() == expected.objects);
    }
}
