#include "image_plan.hpp"

#include <glm/gtc/packing.hpp>
#include <map>

namespace minirtc {
namespace {

constexpr float kLargestHalf = 65504.0f;

uint32_t flagsOf(Wrap wrap) {
    if (wrap == Wrap::repeat) return MINIRT_IMAGE_REPEAT_V;
    return wrap == Wrap::mirror ? MINIRT_IMAGE_MIRROR_U | MINIRT_IMAGE_MIRROR_V : MINIRT_IMAGE_CLAMP_U;
}

/// Appends the image's texels as half floats; values beyond their range share a factor.
minirt_image encodeImage(const Image& image, std::vector<uint16_t>& texels) {
    float largest = 0;
    for (const glm::vec4& texel : image.texels) largest = std::max({largest, texel.x, texel.y, texel.z});
    const float scale = largest > kLargestHalf ? largest / kLargestHalf : 1.0f;
    const auto first = static_cast<uint32_t>(texels.size() / 4);
    texels.reserve(texels.size() + image.texels.size() * 4);
    for (const glm::vec4& texel : image.texels) {
        for (int k = 0; k < 4; ++k) texels.push_back(glm::packHalf1x16(k < 3 ? texel[k] / scale : texel[k]));
    }
    return {{image.width, image.height, first, 0}, {scale, 0, 0, 0}};
}

}  // namespace

ImagePlan::ImagePlan(const Scene& scene, const EffectSet& effects)
    : textures_(effects.has(Effect::textures) || effects.has(Effect::alpha)),
      surfaces_(effects.has(Effect::surfaceMaps)),
      normals_(effects.has(Effect::normalMaps)),
      emissions_(effects.has(Effect::emissionMaps)) {
    if (effects.has(Effect::backgroundImage) && scene.background.image != kNone) {
        background_ = 0;
        add(scene.background.image, 0);
    }
    for (const Material& m : scene.materials) {
        if (textures_) add(m.diffuseTexture, flagsOf(m.wrap));
        if (surfaces_) add(m.surfaceTexture, flagsOf(m.wrap));
        if (normals_) add(m.normalTexture, flagsOf(m.wrap));
        if (emissions_) add(m.emissionTexture, flagsOf(m.wrap));
    }
}

uint32_t ImagePlan::find(uint32_t image, const Material& m) const {
    for (uint32_t i = 0; i < places_.size(); ++i)
        if (places_[i].image == image && places_[i].flags == flagsOf(m.wrap)) return i;
    return kNone;
}

void ImagePlan::add(uint32_t image, uint32_t flags) {
    const auto same = [&](const Place& place) { return place.image == image && place.flags == flags; };
    if (image != kNone && std::none_of(places_.begin(), places_.end(), same)) places_.push_back({image, flags});
}

EncodedImages encodeImages(const Scene& scene, const ImagePlan& plan) {
    EncodedImages out;
    std::map<uint32_t, minirt_image> encoded;  // by the scene's image
    for (const ImagePlan::Place& place : plan.places()) {
        if (encoded.count(place.image) == 0) encoded[place.image] = encodeImage(scene.images[place.image], out.texels);
        out.images.push_back(encoded[place.image]);
        out.images.back().extent.w = place.flags;
    }
    return out;
}

}  // namespace minirtc
