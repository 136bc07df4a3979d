// The scene as the user wrote it, parsed and checked: the value that the JSON stage returns and the others read.
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "error.hpp"

namespace minirtc {

constexpr uint32_t kNone = 0xffffffffu;

enum class ColorSpace { srgb, linear };  // of 8-bit files; .hdr and .exr are linear always

/// Linear RGBA image, row 0 at the top, `width * height` texels.
struct Image {
    std::string name;  // path as given, for messages
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<glm::vec4> texels;
    ColorSpace space = ColorSpace::srgb;  // that its file was read as
    bool isFloat = false;                 // from a file that holds floats, whose space does not matter
};

struct Camera {
    glm::dvec3 position{0, 0, 0};
    glm::dvec3 target{0, 0, -1};
    glm::dvec3 up{0, 1, 0};
    double vfov = 60.0;     // degrees
    double aperture = 0.0;  // diameter of the lens in metres
    double focusDistance = 1.0;
};

/// Constant radiance, or an equirectangular panorama times `strength`.
struct Background {
    glm::vec3 color{0};
    uint32_t image = kNone;  // index into Scene::images
    float strength = 1.0f;
    float rotation = 0.0f;  // degrees about +Y
};

enum class LightType : uint32_t { point = 0, directional = 1, spot = 2 };

/// A light without size. Lights that have one are objects with a material that shines.
struct Light {
    LightType type = LightType::point;
    glm::dvec3 position{0};          // point, spot
    glm::dvec3 direction{0, -1, 0};  // directional, spot: the way the light travels, any length but 0
    glm::vec3 intensity{1};          // W/sr, or irradiance in W/m^2 of a directional light
    double innerCone = 0;            // spot: degrees from its axis up to which it is full,
    double outerCone = 45;           // and from which on it is dark
    bool inverseSquare = true;       // false: "falloff":"none", the seeds' lights
};

/// Cosines of a spot's inner and outer cone as the runtime gets them.
struct SpotCosines {
    float inner, outer;
};
SpotCosines spotCosines(const Light& spot);

/// Index of refraction as a sum of powers of c = 1 / wavelength^2 in 1/um^2: of c^-1, 1, c, c^2, c^3 and c^4.
using IndexCurve = std::array<double, 6>;

/// A medium's index of refraction where it depends on the wavelength.
struct Dispersion {
    glm::dvec3 channels{1};  // red, green and blue by themselves
    IndexCurve curve{};
};

/// The inside of an object that transmits.
struct Medium {
    glm::vec3 absorption{0};               // sigma in 1/m; light keeps exp(-sigma * d) of itself over a distance d
    float inscatter = 0;                   // 0 to 1: share of the light taken away that comes back as the medium's own
    std::optional<Dispersion> dispersion;  // absent: `ior` for all wavelengths
};

/// Whether a surface has holes: none; where alpha is under the cutoff; with a share of 1 - alpha of all light that meets it.
enum class AlphaMode { opaque, mask, blend };

/// How textures go on beyond their rim.
enum class Wrap { repeat, mirror, clamp };

/// What light does at a surface of a pbr material in the path tracers (glTF 2.0's terms).
struct Physical {
    glm::vec3 baseColor{1};
    float metallic = 0;
    float roughness = 0.5f;
    float transmission = 0;
};

/// What light does at a surface: the weights that the Whitted kernel uses, and what path tracers know beyond them. `phong`, `pbr` and
/// .mtl materials all become this.
struct Material {
    std::string name;
    glm::vec3 diffuse{0};   // Lambert weight: radiance per irradiance (a pbr base colour over pi; a phong diffuse * colour)
    glm::vec3 specular{0};  // Phong highlight weight
    float shininess = 1.0f;
    glm::vec3 reflect{0};   // weight of the mirror ray
    glm::vec3 transmit{0};  // weight of the refracted ray
    float ior = 1.0f;
    bool fresnel = false;      // exact Fresnel splits: mirror ray reflect * F, refracted ray transmit * (1 - F)
    bool thin = false;         // a sheet of glass: both of its sides in one surface, nothing inside
    Medium medium;             // what a closed object of this material is filled with
    bool clearShadows = true;  // shadow rays pass what transmits, tinted
    glm::vec3 emission{0};
    bool doubleSided = false;          // emission on the back too
    std::optional<Physical> physical;  // absent: the path tracers go by the weights
    AlphaMode alphaMode = AlphaMode::opaque;
    float alpha = 1.0f;  // times the alpha of `diffuseTexture`
    float alphaCutoff = 0.5f;
    uint32_t diffuseTexture = kNone;  // index into Scene::images; multiplies `diffuse` and the base colour
    uint32_t surfaceTexture = kNone;  // green multiplies roughness, blue multiplies metallic
    uint32_t normalTexture = kNone;
    uint32_t emissionTexture = kNone;  // multiplies `emission`
    float normalScale = 1.0f;
    Wrap wrap = Wrap::repeat;  // of all its textures
    bool checker = false;      // a checker of the materials `checkerA` and `checkerB`; the rest is unused
    uint32_t checkerA = kNone;
    uint32_t checkerB = kNone;
    float checkerScale = 1.0f;  // metres
};

/// Indices into a Mesh's arrays; kNone where the file gives no normal or texture coordinate.
struct Corner {
    uint32_t position = 0;
    uint32_t normal = kNone;
    uint32_t uv = kNone;
};

struct Face {
    std::array<Corner, 3> corners;
    uint32_t material = kNone;  // index into Mesh::materials
    int line = 0;               // of the OBJ file, 0 if unknown
};

/// One OBJ file, triangulated, untransformed.
struct Mesh {
    std::string path;
    std::vector<glm::dvec3> positions;
    std::vector<glm::vec3> normals;
    std::vector<glm::vec2> uvs;
    std::vector<Face> faces;
    std::vector<uint32_t> materials;  // mesh-local .mtl material -> index into Scene::materials
};

struct Sphere {
    glm::dvec3 center{0};
    double radius = 1.0;
};

/// The parallelogram origin + s*u + t*v with s, t in [0,1]; its front is the side of cross(u, v).
struct Rectangle {
    glm::dvec3 origin{0};
    glm::dvec3 u{1, 0, 0};
    glm::dvec3 v{0, 1, 0};
};

/// Applied to a mesh as scale, then rotation about X, then Y, then Z (degrees), then translation.
struct Transform {
    glm::dvec3 scale{1};
    glm::dvec3 rotate{0};
    glm::dvec3 translate{0};
};

enum class ShapeType { mesh, sphere, rectangle };

struct Object {
    std::string name;         // for messages: the mesh's path or the shape's kind and number
    SourceLocation location;  // in the scene file
    ShapeType shape = ShapeType::mesh;
    uint32_t mesh = kNone;  // index into Scene::meshes
    Sphere sphere;
    Rectangle rectangle;
    uint32_t material = kNone;                                     // index into Scene::materials; kNone: the mesh's own .mtl
    std::vector<Transform> instances = std::vector<Transform>(1);  // each instance becomes a copy in the blob
    std::optional<bool> smooth;                                    // absent: smooth exactly where the OBJ gives normals
    int priority = 0;  // of two volumes that overlap, the higher one displaces the other
};

/// How volumes that overlap share space: by one order for every ray, or by the order in which each ray meets them (Ray Tracing Gems
/// ch. 11).
enum class Nesting { ordered, parity };

/// Whether shadow rays pass through what transmits: all of it, none of it, or physical glass only.
enum class Shadows { byModel, transmissive, opaque };

/// How light of different wavelengths parts where it refracts: as three channels with an index each, or as wavelengths, some a sample.
enum class DispersionMode { rgb, spectral };

enum class Integrator : uint32_t { whitted = 0, path = 1, wavefront = 2, whittedShared = 3 };

/// Whether an integrator follows trees of rays; the others trace paths.
inline bool followsTrees(Integrator integrator) {
    return integrator == Integrator::whitted || integrator == Integrator::whittedShared;
}

/// How much the samples of a pixel count by where they lie.
enum class Filter : uint32_t { box = 0, tent = 1, gaussian = 2 };

/// Settings of accuracy levers (levers.hpp) that were asked for, by the name of the lever.
using LeverSettings = std::map<std::string, std::string>;

struct RenderDefaults {
    Integrator integrator = Integrator::whitted;
    std::vector<Integrator> integrators = {Integrator::whitted, Integrator::path, Integrator::wavefront};  // that the blob is for
    bool integratorsGiven = false;  // by the scene file: then it is an error if one of them cannot draw the scene
    Filter filter = Filter::box;
    uint32_t maxDepth = 20;  // bounces after the camera ray
    uint32_t spp = 1;
    uint32_t width = 1024;
    uint32_t height = 768;
    Shadows shadows = Shadows::byModel;
    DispersionMode dispersionMode = DispersionMode::rgb;
    LeverSettings accuracy;

    bool uses(Integrator one) const { return std::find(integrators.begin(), integrators.end(), one) != integrators.end(); }
    bool tracesPaths() const { return uses(Integrator::path) || uses(Integrator::wavefront); }
};

struct Scene {
    std::string path;
    Camera camera;
    Background background;
    std::vector<Light> lights;
    std::vector<Image> images;
    std::vector<Material> materials;
    std::vector<Mesh> meshes;
    std::vector<Object> objects;
    Nesting nesting = Nesting::ordered;
    RenderDefaults render;
};

/// True where faces of this material bound a volume: light goes in and comes out.
bool boundsVolume(const Material& material);

/// True where texture coordinates matter; a checker's are its two materials'.
bool isTextured(const Material& material);

/// Whitted's kernel cannot draw `what`, which stands at `location`: throws Error where the scene asks for that kernel, else leaves it out.
void leaveWhittedOut(Scene& scene, const SourceLocation& location, const std::string& what, const std::string& hint);

/// Parses and checks a scene file and all that it names (OBJ, MTL, images). Throws Error with file, line, column and what to do.
Scene loadScene(const std::filesystem::path& path, Diagnostics& diagnostics);

/// Reads a triangulated mesh. Materials of its .mtl are appended to `scene.materials`, their textures to `scene.images`,
/// but only where `wantMaterials`. Throws Error.
Mesh loadObj(const std::filesystem::path& path, bool wantMaterials, Scene& scene, Diagnostics& diagnostics);

/// The index in `scene.images` of an image file, read when it is not there yet in this space. Throws Error.
uint32_t addImage(Scene& scene, const std::filesystem::path& path, ColorSpace space);

/// Reads .jpg .png .bmp .tga (8 bit, `space`), .hdr and .exr (linear). Throws Error.
Image loadImage(const std::filesystem::path& path, ColorSpace space);

}  // namespace minirtc
