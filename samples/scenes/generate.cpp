#include "generate.hpp"

#include "gems.hpp"
#include "ice.hpp"
#include "knot.hpp"
#include "output.hpp"
#include "picture.hpp"
#include "polyhedron.hpp"
#include "scene_files.hpp"
#include "sphere.hpp"
#include "vessels.hpp"

namespace samples {
namespace {

void writeStones(const std::filesystem::path& folder) {
    writeObj(brilliantCut(), folder / "brilliant.obj");
    writeObj(stepCut(1, 1), folder / "asscher.obj");
    writeObj(stepCut(1.4, 1), folder / "emerald.obj");
    writeObj(prism(3, 1, 2), folder / "prism.obj");
    writeObj(pebble(5), folder / "pebble.obj");
}

void writeVessels(const std::filesystem::path& folder) {
    Tumbler plain;
    Tumbler fluted;
    fluted.flutes = 10;
    writeObj(tumbler(plain), folder / "tumbler.obj");
    writeObj(tumbler(fluted), folder / "tumbler_fluted.obj");
    writeObj(tumblerFilling(plain, 0.052), folder / "whisky.obj");
    writeObj(iceCube(0.027), folder / "ice.obj");
    writeObj(wineGlass(), folder / "wine_glass.obj");
    writeObj(bowl(), folder / "bowl.obj");
    writeObj(vase(), folder / "vase.obj", "vase");
    writeText(folder / "vase.mtl", "newmtl vase\nKd 1 1 1\nKs 0.3 0.3 0.3\nNs 120\nmap_Kd vase.png\n");
    writePng(porcelain(1024, 1024), folder / "vase.png");
}

}  // namespace

void generate(const std::filesystem::path& folder) {
    std::filesystem::create_directories(folder);
    writeStones(folder);
    writeVessels(folder);
    writeObj(torusKnot(TorusKnot{}), folder / "knot.obj");
    writeObj(icosphere(4), folder / "sphere.obj");
    writeHdr(eveningSky(1024, 512), folder / "sky.hdr");
    for (const auto& [name, text] : sceneFiles()) writeText(folder / name, text);
}

}  // namespace samples
