#include "generate.hpp"

#include "aquarium.hpp"
#include "board.hpp"
#include "cornell.hpp"
#include "decanter.hpp"
#include "fish.hpp"
#include "foliage.hpp"
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

/// A mesh with a material of its own, which its picture of the same name colours.
void writeTextured(const Mesh& mesh, const Picture& picture, const std::string& rest, const std::filesystem::path& folder,
                   const std::string& name) {
    writeObj(mesh, folder / (name + ".obj"), name);
    writeText(folder / (name + ".mtl"), "newmtl " + name + "\nKd 1 1 1\n" + rest + "map_Kd " + name + ".png\n");
    writePng(picture, folder / (name + ".png"));
}

void writeStones(const std::filesystem::path& folder) {
    writeObj(brilliantCut(), folder / "brilliant.obj");
    writeObj(stepCut(1, 1), folder / "asscher.obj");
    writeObj(stepCut(1.4, 1), folder / "emerald.obj");
    writeObj(prism(3, 1, 2), folder / "prism.obj");
    writeObj(pebble(4), folder / "pebble.obj");
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
    writeTextured(vase(), porcelain(1024, 1024), "Ks 0.3 0.3 0.3\nNs 120\n", folder, "vase");
    const std::string polish = "Ks 1 1 1\nNs 200\nNi 1.5\nillum 5\n";
    writeTextured(board({1.2, 0.04, 0.8}, 0.004), wood(1536, 1024), polish, folder, "table");
}

void writeAquarium(const std::filesystem::path& folder) {
    const Aquarium shape;
    writeObj(tank(shape), folder / "tank.obj");
    writeObj(tankWater(shape), folder / "tank_water.obj");
    writeObj(seaGrass(), folder / "sea_grass.obj");
    writeTextured(tankSand(shape), sandGrains(512, 512), "", folder, "sand");
    const std::string scales = "Ks 0.25 0.25 0.25\nNs 40\n";
    writeTextured(fish(Species::clownfish, 0.35), fishSkin(Species::clownfish, 512), scales, folder, "clownfish");
    writeTextured(fish(Species::tang, -0.3), fishSkin(Species::tang, 512), scales, folder, "tang");
    writeTextured(fish(Species::butterflyfish, 0.2), fishSkin(Species::butterflyfish, 512), scales, folder, "butterflyfish");
}

void writeCornellBox(const std::filesystem::path& folder) {
    writeObj(cornellRoom(), folder / "cornell_room.obj");
    writeObj(cornellLeft(), folder / "cornell_left.obj");
    writeObj(cornellRight(), folder / "cornell_right.obj");
    writeObj(cornellShortBlock(), folder / "cornell_short.obj");
    writeObj(cornellTallBlock(), folder / "cornell_tall.obj");
}

void writeFoliage(const std::filesystem::path& folder) {
    writeObj(shrubStems(), folder / "shrub_stems.obj");
    writeObj(shrubLeaves(), folder / "shrub_leaves.obj");
    writeObj(meadow(7, 9000), folder / "meadow.obj");
    writePng(leafCard(512), folder / "leaf.png");
    writePng(grassCard(512), folder / "grass.png");
}

void writeProduct(const std::filesystem::path& folder) {
    writeObj(decanter(), folder / "decanter.obj");
    writeObj(decanterFilling(), folder / "liqueur.obj");
    writeObj(decanterStopper(), folder / "stopper.obj");
    writeObj(sweep(3, 2, 1, 2.5), folder / "sweep.obj");
    writeLinearPng(brushedNormals(256, 1024), folder / "brushed_normals.png");
    writeLinearPng(brushedSurface(256, 256), folder / "brushed_surface.png");
    writeHdr(softBoxes(1024, 512), folder / "soft_boxes.hdr");
}

}  // namespace

void generate(const std::filesystem::path& folder) {
    std::filesystem::create_directories(folder);
    writeStones(folder);
    writeVessels(folder);
    writeAquarium(folder);
    writeCornellBox(folder);
    writeFoliage(folder);
    writeProduct(folder);
    writeObj(torusKnot(TorusKnot{}), folder / "knot.obj");
    writeObj(icosphere(4), folder / "sphere.obj");
    writeHdr(eveningSky(1024, 512), folder / "sky.hdr");
    writeHdr(noonSky(1024, 512), folder / "noon.hdr");
    writeHdr(studio(1024, 512), folder / "studio.hdr");
    writeHdr(bar(1024, 512), folder / "bar.hdr");
    for (const auto& [name, text] : sceneFiles()) writeText(folder / name, text);
}

}  // namespace samples
