// minirt-bench: what minirt's rays, hierarchies and frames cost, beside its peers.
#include <cstdio>
#include <iostream>
#include <thread>

#include "../common/command_line.hpp"
#include "../common/device.hpp"
#include "../common/picture_file.hpp"
#include "report.hpp"

namespace {

using namespace bench;

struct Options {
    std::string scenes;
    std::vector<uint32_t> subdivisions = {0};
    std::vector<uint32_t> knots = {1000, 70000, 1000000};
    std::string json;
    std::string device;
    std::string size;
    std::string layout = "auto";
    std::string bvh = "high";
    RayBenchOptions rays;
    std::vector<std::string> frames;
    std::vector<std::string> effects;
    uint32_t startTriangles = 0;  // 0: no knot is started
    uint32_t samples = 4;
    bool trees = true;
    bool profile = false;
};

const std::map<std::string, minirtc::LayoutChoice> kLayouts = {{"auto", minirtc::LayoutChoice::automatic},
                                                               {"quantised", minirtc::LayoutChoice::quantised},
                                                               {"float", minirtc::LayoutChoice::floating}};

const std::map<std::string, minirtc::BvhQuality> kQualities = {{"fast", minirtc::BvhQuality::fast},
                                                               {"high", minirtc::BvhQuality::high}};

void addOptions(CLI::App& app, Options& o) {
    app.footer(
        "Examples:\n  minirt-bench\n  minirt-bench --scenes meshes --json bench.json\n  minirt-bench --frames still_life.json");
    app.add_option("--scenes", o.scenes, "Folder of OBJ files to trace (default: knots, see below)");
    app.add_option("--subdivide", o.subdivisions,
                   "Trace each mesh of --scenes with its triangles cut into four so many times, for each number given")
        ->delimiter(',')
        ->check(CLI::Range(0u, 6u))
        ->needs("--scenes")
        ->capture_default_str();
    app.add_option("--knots", o.knots, "Without --scenes: triangles of each knot")->delimiter(',')->capture_default_str();
    app.add_option("--frames", o.frames,
                   "Scenes (.json) or blobs (.mrt) to start, load and render; then meshes only where they are asked for");
    app.add_option(
           "--start", o.startTriangles,
           "Start and load a knot of so many triangles (70000 where no number is given), by Whitted's tracer and as paths; "
           "then meshes only where they are asked for")
        ->expected(0, 1)
        ->default_str("70000");
    app.add_option("--effects", o.effects,
                   "Scenes (.json) to render by kernels with the effects that they call for, and with all; then meshes only "
                   "where they are asked for");
    app.add_option("--spp", o.samples, "Samples of such a picture")->check(CLI::Range(1u, 1u << 16))->capture_default_str();
    app.add_option("--json", o.json, "Write all figures as JSON");
    app.add_option("--device", o.device, "Number or part of the name of a device from `minirtc devices`");
    app.add_option("--size", o.size, "Primary rays: WIDTHxHEIGHT (default: 1280x720, on a GPU 1920x1080)");
    app.add_option("--per-hit", o.rays.perHit, "Secondary rays of a kind for each hit (default: 1, on a GPU 8)")
        ->check(CLI::Range(1u, 64u));
    app.add_option("--rounds", o.rays.rounds, "Rounds, in which all take turns")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
    app.add_option("--seed", o.rays.seed, "Of the secondary rays")->capture_default_str();
    app.add_option("--layout", o.layout, "Boxes of the hierarchy")->check(CLI::IsMember(kLayouts))->capture_default_str();
    app.add_option("--bvh", o.bvh, "Building of the hierarchy")->check(CLI::IsMember(kQualities))->capture_default_str();
    app.add_flag("--profile", o.profile,
                 "Count what traversal does for the same rays: node steps, triangle tests, bytes, lanes in use");
    app.add_flag("--alone", o.rays.alone, "Trace by minirt alone");
    app.add_flag("!--no-trees", o.trees, "Leave the building of hierarchies out");
}

/// What suits the device, where the user did not say.
void settle(const CLI::App& app, const minirt_device_info& device, Options& o) {
    o.rays.width = device.is_cpu ? 1280 : 1920;
    o.rays.height = device.is_cpu ? 720 : 1080;
    if (!o.size.empty()) parseSize(o.size, o.rays.width, o.rays.height);
    o.rays.width = (o.rays.width + 7) / 8 * 8;
    o.rays.height = (o.rays.height + 7) / 8 * 8;
    if (app.count("--per-hit") == 0) o.rays.perHit = device.is_cpu ? 1 : 8;
}

/// Counted by another kernel than the one that is timed; null without --profile.
std::unique_ptr<RayKernel> countingKernel(const RayScene& scene, const Options& o, const Device& device) {
    if (!o.profile) return nullptr;
    return std::make_unique<RayKernel>(device.context(), scene, RayKernel::Counting::on);
}

/// The table of the profile, and what the driver tells of the kernel that was timed.
void profileMesh(const RayScene& scene, const Options& o, const std::vector<RaySetResult>& rays, Json& json) {
    const auto make = [&](minirt_context* context) { RayKernel::makePipeline(context, scene); };
    const std::vector<KernelStatistics> statistics = statisticsOf(o.device, make);
    printProfile(rays, statistics);
    json["driver_statistics"] = toJson(statistics);
}

/// Returns whether all hits agree.
bool benchMesh(const Mesh& mesh, const Options& o, const Device& device, DriverPipeline* pipeline, std::vector<MeshRays>& all,
               Json& json) {
    const size_t triangles = mesh.triangles.size();
    const minirtc::Bvh bvh = minirtc::buildBvh(mesh.geometry, 0, kQualities.at(o.bvh));
    const RayScene scene{mesh.scene, mesh.geometry, bvh, kLayouts.at(o.layout)};
    RayKernel kernel(device.context(), scene);
    const std::unique_ptr<RayKernel> counting = countingKernel(scene, o, device);
    const auto perTriangle = [&](uint64_t bytes) { return static_cast<double>(bytes) / static_cast<double>(triangles); };
    std::printf("%s: %zu triangles, %s boxes; bytes a triangle: %.1f in the blob, %.1f on the device\n", mesh.name.c_str(),
                triangles, kernel.layout(), perTriangle(kernel.bytes().blob), perTriangle(kernel.bytes().device));
    const std::vector<RaySetResult> rays = benchRays(mesh, kernel, counting.get(), pipeline, o.rays);
    all.push_back({triangles, rays});
    print(rays);
    json = {{"mesh", mesh.name}, {"triangles", triangles}, {"layout", kernel.layout()}};
    json["bytes_per_triangle"] = {{"blob", perTriangle(kernel.bytes().blob)}, {"device", perTriangle(kernel.bytes().device)}};
    json["rays"] = toJson(rays);
    if (o.profile) profileMesh(scene, o, rays, json);
    if (pipeline) json["driver_structures"] = {{"build_ms", pipeline->buildMs()}, {"bytes", pipeline->structureBytes()}};
    if (o.trees) {
        const std::vector<TreeResult> trees = benchTrees(mesh, o.rays.rounds);
        print(trees);
        json["hierarchies"] = toJson(trees);
    }
    std::fflush(stdout);
    return std::all_of(rays.begin(), rays.end(), [](const RaySetResult& set) { return set.agrees(); });
}

std::unique_ptr<DriverPipeline> openPipeline(const minirt_device_info& device) {
    std::string whyNot;
    std::unique_ptr<DriverPipeline> pipeline = DriverPipeline::open(device.name, whyNot);
    if (!pipeline) std::printf("The driver's ray tracing pipeline is left out: %s\n", whyNot.c_str());
    return pipeline;
}

void writeJson(const std::string& path, const Json& json) {
    const std::string text = json.dump(2) + "\n";
    const std::string problem = writeWhole(path, {text.begin(), text.end()});
    if (!problem.empty()) throw std::runtime_error(problem);
}

/// A small picture on a CPU device, where kernels with all effects take their time.
EffectsOptions effectsOptions(const Options& o, const minirt_device_info& device) {
    EffectsOptions options{o.device, device.is_cpu ? 128u : 1024u, device.is_cpu ? 96u : 768u, o.samples, o.rays.rounds};
    if (!o.size.empty()) parseSize(o.size, options.width, options.height);
    return options;
}

/// Returns whether all hits agree.
bool run(const CLI::App& app, Options& o) {
    const Device device(o.device);
    const minirt_device_info info = device.info();
    settle(app, info, o);
    const unsigned threads = std::thread::hardware_concurrency();
    std::printf("%s (%s), %u processor threads; %u x %u primary rays, %u of each kind a hit, medians of %d rounds\n", info.name,
                info.driver, threads, o.rays.width, o.rays.height, o.rays.perHit, o.rays.rounds);
    const std::unique_ptr<DriverPipeline> pipeline = o.rays.alone ? nullptr : openPipeline(info);
    Json json = {{"device", info.name}, {"driver", info.driver}, {"processor_threads", threads}, {"rounds", o.rays.rounds}};
    json["seed"] = o.rays.seed;
    bool agrees = true;
    std::vector<MeshRays> rays;
    const auto one = [&](const Mesh& mesh) {
        Json entry;
        agrees = benchMesh(mesh, o, device, pipeline.get(), rays, entry) && agrees;
        json["meshes"].push_back(entry);
    };
    const bool otherWork = !o.frames.empty() || !o.effects.empty() || o.startTriangles > 0;
    const bool withKnots = o.scenes.empty() && (!otherWork || app.count("--knots") > 0);
    if (withKnots)
        for (uint32_t triangles : o.knots) one(knotMesh(triangles));
    if (!o.scenes.empty())
        for (const std::filesystem::path& file : objFiles(o.scenes))
            for (uint32_t subdivisions : o.subdivisions) one(loadMesh(file, subdivisions));
    const std::vector<Scaling> scaling = scalingOf(rays);
    if (!scaling.empty()) {
        print(scaling);
        json["scaling"] = toJson(scaling);
    }
    const auto scene = [&](const std::filesystem::path& file, bool pictures) {
        const SceneResult result = benchScene(file, {o.device, o.samples, o.rays.rounds, pictures});
        print(result);
        json["scenes"].push_back(toJson(result));
    };
    if (o.startTriangles) {
        const TemporaryFolder folder;
        for (const char* integrator : {"whitted", "path"})
            scene(writeKnotScene(folder.path(), o.startTriangles, integrator), false);
    }
    for (const std::string& file : o.frames) scene(file, true);
    std::vector<EffectsResult> effects;
    for (const std::string& file : o.effects) {
        effects.push_back(benchEffects(file, effectsOptions(o, info)));
        json["effects"].push_back(toJson(effects.back()));
    }
    if (!effects.empty()) print(effects);
    if (!o.json.empty()) writeJson(o.json, json);
    return agrees;
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app("minirt-bench measures rays, hierarchies and frames beside their peers", "minirt-bench");
    Options options;
    addOptions(app, options);
    app.failure_message(oneLineFailure);
    CLI11_PARSE(app, argc, argv);
    try {
        if (run(app, options)) return 0;
        std::cerr << "minirt-bench: hits differ from those of a peer in more than one ray of 100,000\n";
    } catch (const std::exception& error) {
        std::cerr << error.what() << "\n";
    }
    return 1;
}
