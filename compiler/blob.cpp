#include "blob.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>

#include "image_plan.hpp"
#include "light_table.hpp"
#include "spectrum.hpp"

namespace minirtc {
namespace {

/// Rays whose throughput falls below this in every channel end: less than half a step of an 8-bit picture.
constexpr float kThroughputCutoff = 1.0f / 512.0f;

minirt_vec4 vec4(const glm::vec3& v, float w = 0) {
    return {v.x, v.y, v.z, w};
}

float asFloat(uint32_t bits) {
    float value;
    std::memcpy(&value, &bits, sizeof value);
    return value;
}

/// The part of `origin` that a pattern with cells of `scale` can see.
glm::vec3 checkerOffset(const glm::dvec3& origin, double scale) {
    return glm::vec3(origin - 2.0 * scale * glm::floor(origin / (2.0 * scale)));
}

uint32_t flagsOf(const Material& m) {
    const auto flag = [](bool set, uint32_t value) { return set ? value : 0u; };
    return flag(m.fresnel, MINIRT_MATERIAL_FRESNEL) | flag(m.checker, MINIRT_MATERIAL_CHECKER) |
           flag(m.thin && m.transmit != glm::vec3(0), MINIRT_MATERIAL_THIN) |
           flag(m.clearShadows, MINIRT_MATERIAL_CLEAR_SHADOWS) | flag(m.physical.has_value(), MINIRT_MATERIAL_PHYSICAL) |
           flag(m.alphaMode == AlphaMode::mask, MINIRT_MATERIAL_ALPHA_MASK) |
           flag(m.alphaMode == AlphaMode::blend, MINIRT_MATERIAL_ALPHA_BLEND) |
           flag(m.doubleSided, MINIRT_MATERIAL_SHINES_BOTH_WAYS);
}

minirt_material encodeMaterial(const Material& m, float pickDensity, const Geometry& geometry, const ImagePlan& images) {
    minirt_material out = {};
    out.diffuse = vec4(m.diffuse, m.shininess);
    out.specular = vec4(m.specular, m.ior);
    out.reflect = vec4(m.reflect);
    out.transmit = vec4(m.transmit, m.alphaMode == AlphaMode::opaque ? 1 : m.alpha);
    out.emission = vec4(m.emission, pickDensity);
    out.checker = vec4(checkerOffset(geometry.origin, m.checkerScale), m.checkerScale);
    out.options = {flagsOf(m), images.diffuse(m), m.checkerA, m.checkerB};
    const Physical physical = m.physical.value_or(Physical{});
    out.base = vec4(physical.baseColor, physical.metallic);
    out.finish = {physical.roughness, physical.transmission, m.normalScale, m.alphaCutoff};
    out.images = {images.surface(m), images.normal(m), images.emission(m), MINIRT_NONE};
    return out;
}

minirt_light encodeLight(const Light& light, const Geometry& geometry) {
    minirt_light out = {};
    out.intensity = vec4(light.intensity);
    if (light.type == LightType::directional) {
        out.position = vec4(glm::vec3(-glm::normalize(light.direction)));
        out.options.x = MINIRT_LIGHT_DIRECTIONAL;
        return out;
    }
    out.position = vec4(glm::vec3(light.position - geometry.origin));
    out.options.x = light.inverseSquare ? MINIRT_LIGHT_INVERSE_SQUARE : 0u;
    if (light.type != LightType::spot) return out;
    const SpotCosines cosines = spotCosines(light);
    out.position.w = cosines.outer, out.intensity.w = cosines.inner;
    out.axis = vec4(glm::vec3(glm::normalize(light.direction)));
    out.options.x |= MINIRT_LIGHT_SPOT;
    return out;
}

minirt_medium encodeMedium(const Material& m) {
    minirt_medium out = {};
    out.absorption = vec4(m.medium.absorption, m.medium.inscatter);
    out.ior = {m.ior, m.ior, m.ior, m.ior};
    out.iorCurve = {0, m.ior, 0, 0};
    if (!m.medium.dispersion) return out;
    const auto& [channels, curve] = *m.medium.dispersion;
    const glm::vec3 rgb(channels);
    out.ior = vec4(rgb, m.ior);
    const auto term = [&c = curve](size_t k) { return static_cast<float>(c[k]); };
    out.iorCurve = {term(0), term(1), term(2), term(3)};
    out.iorCurveEnd = {term(4), term(5), 0, 0};
    return out;
}

/// The surrounding, then what fills each volume.
std::vector<minirt_medium> encodeMedia(const Scene& scene, const Geometry& geometry, const Volumes& volumes) {
    std::vector<minirt_medium> media = {encodeMedium(Material{})};
    for (uint32_t v = 0; v < volumes.count; ++v)
        media.push_back(encodeMedium(scene.materials[geometry.bodies[volumes.order[v]].material]));
    const std::vector<Bounds> bounds = bodyBounds(geometry);
    for (uint32_t v = 0; v < volumes.count; ++v) {
        media[v + 1].boundsMin = vec4(bounds[volumes.order[v]].min);
        media[v + 1].boundsMax = vec4(bounds[volumes.order[v]].max);
    }
    return media;
}

/// The number of each body in the blob.
std::vector<uint32_t> numberBodies(const Volumes& volumes) {
    std::vector<uint32_t> numbers(volumes.order.size());
    for (uint32_t i = 0; i < numbers.size(); ++i) numbers[volumes.order[i]] = i;
    return numbers;
}

std::vector<minirt_vec4> encodePrimitives(const Geometry& geometry, const Bvh& bvh, const Volumes& volumes, bool withCorners) {
    const std::vector<uint32_t> bodyNumbers = numberBodies(volumes);
    std::vector<minirt_vec4> rows;
    rows.reserve(bvh.order.size() * 3);
    for (uint32_t index : bvh.order) {
        const Primitive& primitive = geometry.primitives[index];
        rows.push_back(vec4(primitive.p[0], asFloat(primitive.material | (primitive.isSphere ? MINIRT_PRIMITIVE_SPHERE : 0u))));
        rows.push_back(vec4(primitive.p[1], asFloat(bodyNumbers[primitive.body])));
        rows.push_back(vec4(primitive.p[2], asFloat(withCorners ? primitive.corners : kNone)));
    }
    return rows;
}

/// Of all of them. A ray that starts near them loses less of its place to rounding than one from outside of the scene.
Bounds volumeBounds(const Geometry& geometry, const Volumes& volumes) {
    if (volumes.count == 0) return {glm::vec3(0), glm::vec3(0)};
    const std::vector<Bounds> bodies = bodyBounds(geometry);
    Bounds all;
    for (uint32_t v = 0; v < volumes.count; ++v) {
        const Bounds& one = bodies[volumes.order[v]];
        all.min = glm::min(all.min, one.min), all.max = glm::max(all.max, one.max);
    }
    return all;
}

bool reads(const std::vector<Kernel>& kernels, uint32_t binding) {
    return std::any_of(kernels.begin(), kernels.end(), [&](const Kernel& k) { return k.bindings >> binding & 1u; });
}

uint32_t bitsOf(float value) {
    uint32_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    return bits;
}

/// What path tracers pick lights from, where a kernel does; all empty else.
struct Picks {
    std::vector<minirt_pick> emitters, environment;
    std::vector<float> densities;
    uint32_t columns = 0, rows = 0;
    float probability = 0;  // of the environment
};

Picks makePicks(const BakedScene& baked) {
    const auto& [scene, geometry, bvh, nodes, volumes, effects, kernels] = baked;
    Picks picks;
    picks.densities.assign(scene.materials.size(), 0);
    const bool cells = reads(kernels, MINIRT_BINDING_ENVIRONMENT);
    if (!cells && !reads(kernels, MINIRT_BINDING_EMITTERS)) return picks;
    const EnvironmentCells environment = environmentCells(scene);
    LightTable table = lightTable(scene, geometry, bvh, environment);
    picks.emitters = std::move(table.emitters);
    picks.densities = std::move(table.densities);
    picks.probability = table.environment;
    if (cells || picks.probability > 0) {
        picks.environment = environmentTable(environment);
        picks.columns = environment.columns, picks.rows = environment.rows;
    }
    return picks;
}

minirt_scene_rows encodeRows(const Scene& scene, const Geometry& geometry, const EncodedNodes& nodes, const Volumes& volumes,
                             const ImagePlan& images, const Picks& picks) {
    minirt_scene_rows rows = {};
    rows.gridOrigin = vec4(nodes.gridOrigin);
    rows.gridScale = vec4(nodes.gridScale);
    rows.gridPlanes = vec4(nodes.gridPlanes);
    const bool image = scene.background.image != kNone;
    rows.background =
        vec4(image ? glm::vec3(scene.background.strength) : scene.background.color, scene.background.rotation / 360.0f);
    const Bounds bounds = volumeBounds(geometry, volumes);
    rows.boundsMin = vec4(bounds.min);
    rows.boundsMax = vec4(bounds.max);
    rows.counts = {static_cast<uint32_t>(scene.lights.size()), images.background(), volumes.count,
                   static_cast<uint32_t>(picks.emitters.size())};
    rows.environment = {picks.columns, picks.rows, bitsOf(picks.probability), static_cast<uint32_t>(scene.render.filter)};
    return rows;
}

void copy(double (&to)[3], const glm::dvec3& from) {
    std::copy(&from.x, &from.x + 3, to);
}

minirt_scene_desc encodeScene(const BakedScene& baked) {
    const Scene& scene = baked.scene;
    const Geometry& geometry = baked.geometry;
    minirt_scene_desc desc = {};
    copy(desc.origin, geometry.origin);
    copy(desc.bounds_min, geometry.boundsMin);
    copy(desc.bounds_max, geometry.boundsMax);
    copy(desc.camera.position, scene.camera.position);
    copy(desc.camera.target, scene.camera.target);
    copy(desc.camera.up, scene.camera.up);
    desc.camera.vfov = scene.camera.vfov;
    desc.camera.aperture = scene.camera.aperture;
    desc.camera.focus_distance = scene.camera.focusDistance;
    desc.width = scene.render.width;
    desc.height = scene.render.height;
    desc.samples = scene.render.spp;
    desc.max_depth = scene.render.maxDepth;
    desc.integrator = static_cast<uint32_t>(scene.render.integrator) + MINIRT_INTEGRATOR_WHITTED;
    desc.node_layout = baked.nodes.layout;
    desc.bvh_depth = baked.bvh.depth;
    desc.throughput_cutoff = kThroughputCutoff;
    desc.volume_capacity = baked.effects.has(Effect::nesting) ? baked.effects.volumeCapacity : 0;
    return desc;
}

std::string explain(const BakedScene& baked) {
    const auto& [scene, geometry, bvh, nodes, volumes, effects, kernels] = baked;
    nlohmann::ordered_json json;
    for (size_t i = 0; i < kEffectCount; ++i) {
        json["effects"][effectInfo(static_cast<Effect>(i)).name] = {{"included", effects.choices[i].included},
                                                                    {"reason", effects.choices[i].reason}};
    }
    for (const auto& [lever, setting] : effects.levers) json["levers"][lever] = setting;
    for (uint32_t body : volumes.order) json["objects"].push_back(geometry.bodies[body].name);
    for (const Displacement& pair : volumes.displacements) {
        json["nesting"].push_back(
            {{"above", geometry.bodies[pair.above].name}, {"below", geometry.bodies[pair.below].name}, {"reason", pair.reason}});
    }
    for (const Material& material : scene.materials) json["materials"].push_back(material.name);
    json["bvh"] = {{"nodes", bvh.nodes.size()},
                   {"leaves", bvh.leaves},
                   {"max_depth", bvh.depth},
                   {"sah_cost", bvh.sahCost},
                   {"encoded_sah_cost", nodes.sahCost}};
    return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

/// Collects sections, then lays them out.
class BlobWriter {
public:
    void add(const char* tag, const void* data, size_t size) {
        if (size == 0) return;
        const auto* bytes = static_cast<const uint8_t*>(data);
        sections_.push_back({tag, std::vector<uint8_t>(bytes, bytes + size)});
    }
    template <typename T>
    void add(const char* tag, const std::vector<T>& items) {
        add(tag, items.data(), items.size() * sizeof(T));
    }

    std::vector<uint8_t> finish() const {
        const uint64_t headerSize = align(sizeof(minirt_blob_header) + sections_.size() * sizeof(minirt_blob_section));
        uint64_t size = headerSize;
        for (const Section& section : sections_) size += align(section.bytes.size());
        std::vector<uint8_t> blob(size, 0);
        uint64_t at = headerSize;
        for (size_t i = 0; i < sections_.size(); ++i) {
            const Section& section = sections_[i];
            std::memcpy(blob.data() + at, section.bytes.data(), section.bytes.size());
            minirt_blob_section entry = {};
            std::memset(entry.tag, ' ', sizeof entry.tag);
            std::memcpy(entry.tag, section.tag.data(), section.tag.size());
            entry.offset = at;
            entry.size = section.bytes.size();
            entry.checksum = minirt_checksum(blob.data() + at, align(section.bytes.size()));
            std::memcpy(blob.data() + sizeof(minirt_blob_header) + i * sizeof entry, &entry, sizeof entry);
            at += align(section.bytes.size());
        }
        writeHeader(blob, headerSize);
        return blob;
    }

private:
    struct Section {
        std::string tag;
        std::vector<uint8_t> bytes;
    };

    static uint64_t align(uint64_t size) {
        return (size + MINIRT_SECTION_ALIGNMENT - 1) / MINIRT_SECTION_ALIGNMENT * MINIRT_SECTION_ALIGNMENT;
    }

    void writeHeader(std::vector<uint8_t>& blob, uint64_t headerSize) const {
        minirt_blob_header header = {};
        std::memcpy(header.signature, MINIRT_SIGNATURE, MINIRT_SIGNATURE_SIZE);
        header.version = MINIRT_FORMAT_VERSION;
        header.endian = MINIRT_ENDIAN_MARK;
        header.section_count = static_cast<uint32_t>(sections_.size());
        header.total_size = blob.size();
        std::memcpy(blob.data(), &header, sizeof header);
        header.checksum = minirt_header_checksum(blob.data(), headerSize);
        std::memcpy(blob.data(), &header, sizeof header);
    }

    std::vector<Section> sections_;
};

void addSpectrum(BlobWriter& writer) {
    std::vector<minirt_vec4> rows;
    for (const Wavelength& wave : whiteLight(1u << MINIRT_SPECTRUM_BITS))
        rows.push_back(vec4(glm::vec3(wave.rgb), static_cast<float>(1 / (wave.micrometres * wave.micrometres))));
    writer.add("SPECTRUM", rows);
}

void addKernels(BlobWriter& writer, const std::vector<Kernel>& kernels) {
    std::vector<minirt_kernel> entries;
    std::vector<uint32_t> words;
    for (const Kernel& kernel : kernels) {
        minirt_kernel entry = {};
        kernel.name.copy(entry.name, sizeof entry.name - 1);
        entry.spirv_offset = words.size() * sizeof(uint32_t);
        entry.spirv_size = kernel.spirv.size() * sizeof(uint32_t);
        entry.bindings = kernel.bindings;
        entry.waits = kernel.waits;
        entries.push_back(entry);
        words.insert(words.end(), kernel.spirv.begin(), kernel.spirv.end());
    }
    writer.add("KERNELS", entries);
    writer.add("SPIRV", words);
}

/// True where a kernel asks for texture coordinates.
bool readsUvs(const EffectSet& effects) {
    return effects.has(Effect::textures) || effects.has(Effect::alpha) || effects.has(Effect::surfaceMaps) ||
           effects.has(Effect::normalMaps) || effects.has(Effect::emissionMaps);
}

void addCorners(BlobWriter& writer, const Geometry& geometry, const EffectSet& effects) {
    std::vector<minirt_vec4> normals;
    std::vector<minirt_vec4> uvs;
    for (const CornerAttributes& corners : geometry.corners) {
        for (const glm::vec3& n : corners.normals) normals.push_back(vec4(n));
        const auto& uv = corners.uvs;
        uvs.push_back({uv[0].x, uv[0].y, uv[1].x, uv[1].y});
        uvs.push_back({uv[2].x, uv[2].y, 0, 0});
    }
    if (effects.has(Effect::smoothNormals)) writer.add("NORMALS", normals);
    if (readsUvs(effects)) writer.add("UVS", uvs);
}

}  // namespace

std::vector<uint8_t> assembleBlob(const BakedScene& baked) {
    const auto& [scene, geometry, bvh, nodes, volumes, effects, kernels] = baked;
    const ImagePlan images(scene, effects);
    const Picks picks = makePicks(baked);
    std::vector<minirt_material> materials;
    for (size_t i = 0; i < scene.materials.size(); ++i)
        materials.push_back(encodeMaterial(scene.materials[i], picks.densities[i], geometry, images));
    std::vector<minirt_light> lights;
    for (const Light& light : scene.lights) lights.push_back(encodeLight(light, geometry));
    const bool withCorners = !geometry.corners.empty() && (effects.has(Effect::smoothNormals) || readsUvs(effects));
    const minirt_scene_desc desc = encodeScene(baked);
    const minirt_scene_rows rows = encodeRows(scene, geometry, nodes, volumes, images, picks);

    BlobWriter writer;
    writer.add("SCENE", &desc, sizeof desc);
    writer.add("ROWS", &rows, sizeof rows);
    writer.add("NODES", nodes.words);
    writer.add("PRIMS", encodePrimitives(geometry, bvh, volumes, withCorners));
    addCorners(writer, geometry, effects);
    writer.add("MATERIAL", materials);
    writer.add("LIGHTS", lights);
    if (reads(kernels, MINIRT_BINDING_MEDIA)) writer.add("MEDIA", encodeMedia(scene, geometry, volumes));
    if (effects.has(Effect::spectral)) addSpectrum(writer);
    writer.add("EMITTERS", picks.emitters);
    writer.add("ENVIRON", picks.environment);
    const EncodedImages encoded = encodeImages(scene, images);
    writer.add("IMAGES", encoded.images);
    writer.add("TEXELS", encoded.texels);
    addKernels(writer, kernels);
    const std::string text = explain(baked);
    writer.add("EXPLAIN", text.data(), text.size());
    return writer.finish();
}

}  // namespace minirtc
