// Pictures of the path tracer against closed forms, and against itself by other means.
#include <doctest/doctest.h>

#include <cmath>

#include "scene_text.hpp"
#include "statistics.hpp"

using glm::dvec3;
using namespace test;

TEST_CASE("probe") {
    GpuContext gpu;
    if (!gpu) return;
    const TemporaryDir dir;
    for (const char* object : {R"({"mesh":"/work/wt/shared/scenes/real/reference/common/meshes/sphere.obj","material":"m"})",
                         R"({"mesh":"/work/wt/shared/scenes/real/reference/common/meshes/sphere.obj","material":"m","smooth":false})",
                         R"({"sphere":{},"material":"m"})"})
        for (const char* m : {R"({"model":"pbr","ior":1})", R"({"model":"phong"})"}) {
            const LoadedScene scene(gpu, bakeScene(dir, std::string(R"({"camera":{"position":[-4,0,0],"target":[0,0,0],"up":[0,0,1],"vfov":34},"render":{"integrator":"path","size":[48,48],"maxDepth":0},
          "lights":[{"type":"rectangle","origin":[-3,-2,7.73],"u":[-2,0,-3.4641],"v":[0,4,0],"radiance":[10,10,10]}],"materials":{"m":)") + m + R"(},"objects":[)" + object + "]}"));
            for (int s = 0; s < 4; ++s) {
                minirt_render_desc desc = {};
                desc.samples = 64;
                desc.light_sampling = static_cast<decltype(desc.light_sampling)>(s);
                const Picture p = scene.render(desc);
                double sum = 0;
                for (uint32_t i = 0; i < 48 * 48; ++i) sum += double(p.rgba[4 * i]);
                MESSAGE(object, " ", m, " ", s, ": ", sum / 2304);
            }
        }
}
