// The images that a blob holds.
#pragma once
#include "effects.hpp"
#include "minirt.h"

namespace minirtc {

/// Which images the blob holds, and where: images that no included effect reads stay out. One that wraps in several ways is several images
/// over the same texels.
class ImagePlan {
public:
    struct Place {
        uint32_t image;  // of the scene
        uint32_t flags;  // MINIRT_IMAGE_
    };

    ImagePlan(const Scene& scene, const EffectSet& effects);

    const std::vector<Place>& places() const { return places_; }
    /// Indices into places(), or kNone.
    uint32_t background() const { return background_; }
    uint32_t diffuse(const Material& m) const { return textures_ ? find(m.diffuseTexture, m) : kNone; }
    uint32_t surface(const Material& m) const { return surfaces_ ? find(m.surfaceTexture, m) : kNone; }
    uint32_t normal(const Material& m) const { return normals_ ? find(m.normalTexture, m) : kNone; }
    uint32_t emission(const Material& m) const { return emissions_ ? find(m.emissionTexture, m) : kNone; }

private:
    uint32_t find(uint32_t image, const Material& m) const;
    void add(uint32_t image, uint32_t flags);

    bool textures_, surfaces_, normals_, emissions_;  // which of a material's are read
    std::vector<Place> places_;
    uint32_t background_ = kNone;
};

/// Sections "IMAGES" and "TEXELS".
struct EncodedImages {
    std::vector<minirt_image> images;
    std::vector<uint16_t> texels;
};
EncodedImages encodeImages(const Scene& scene, const ImagePlan& plan);

}  // namespace minirtc
