// minirt-render: a blob to a picture file.
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>

#include "../common/command_line.hpp"
#include "../common/device.hpp"
#include "../common/picture_file.hpp"
#include "../cost/probe.hpp"

namespace {

struct Options {
    std::string blob;
    std::string output;
    std::string size;
    std::string samples;  // A:B
    std::string region;   // X,Y,WxH
    std::string device;
    std::string stats;
    uint32_t spp = 0;
    int maxDepth = -1;
    float cutoff = -1;  // below 0: the scene's
    minirt_integrator integrator = MINIRT_INTEGRATOR_SCENE;
    uint32_t lightSampling = MINIRT_LIGHT_SAMPLING_MIS;
    uint32_t seed = 0;
    float clamp = 0;        // 0: none
    double timeBudget = 0;  // seconds, 0: none
    double budgetMs = 0;    // of the device's time, 0: none
    bool validation = false;
};

void addOptions(CLI::App& app, Options& o) {
    app.footer(
        "Examples:\n  minirt-render still_life.mrt -o still_life.png\n  minirt-render still_life.mrt -o still_life.exr --size "
        "640x480 --spp 16");
    app.add_option("blob", o.blob, "Blob that minirtc baked (.mrt)")->required();
    app.add_option("-o,--output", o.output, "Picture to write (.png .exr .hdr .pfm)")->required();
    app.add_option("--size", o.size, "WIDTHxHEIGHT (default: the scene's)");
    app.add_option("--spp", o.spp, "Samples a pixel (default: the scene's)")->check(CLI::Range(1u, 1u << 24));
    app.add_option("--max-depth", o.maxDepth, "Bounces after the camera ray (default: the scene's)")->check(CLI::Range(0, 255));
    app.add_option("--cutoff", o.cutoff,
                   "Of Whitted's tracer: rays are weak that carry no more than this share of the light; 0: none is (default: the "
                   "scene's)")
        ->check(CLI::Range(0.0f, 1.0f));
    const std::map<std::string, minirt_integrator> integrators = {{"whitted", MINIRT_INTEGRATOR_WHITTED},
                                                                  {"path", MINIRT_INTEGRATOR_PATH},
                                                                  {"wavefront", MINIRT_INTEGRATOR_WAVEFRONT},
                                                                  {"whitted_shared", MINIRT_INTEGRATOR_WHITTED_SHARED}};
    app.add_option_function<std::string>(
           "--integrator", [&o, integrators](const std::string& name) { o.integrator = integrators.at(name); },
           "How to render (default: the scene's)")
        ->check(CLI::IsMember(integrators));
    const std::map<std::string, uint32_t> samplings = {{"mis", MINIRT_LIGHT_SAMPLING_MIS},
                                                       {"balance", MINIRT_LIGHT_SAMPLING_MIS_BALANCE},
                                                       {"lights", MINIRT_LIGHT_SAMPLING_LIGHTS},
                                                       {"surfaces", MINIRT_LIGHT_SAMPLING_SURFACES}};
    app.add_option_function<std::string>(
           "--light-sampling", [&o, samplings](const std::string& name) { o.lightSampling = samplings.at(name); },
           "How path tracers find light: pick lights and follow surfaces, weighed by the power (mis) or the balance heuristic, "
           "or one "
           "of both alone (default: mis)")
        ->check(CLI::IsMember(samplings));
    app.add_option("--seed", o.seed,
                   "Each number gives noise of its own, of path tracers and of weak_rays=roulette (default: 0)");
    app.add_option("--clamp", o.clamp,
                   "Of path tracers: most that one sample may add to a pixel, which darkens (default: no limit)")
        ->check(CLI::PositiveNumber);
    CLI::Option* const budget =
        app.add_option("--budget-ms", o.budgetMs,
                       "Choose samples, depth, cut-off or light sampling and integrator for the least error within so much of "
                       "the device's "
                       "time, from measurements that take some multiples of it, and say what was given up")
            ->check(CLI::PositiveNumber);
    for (const char* chosen : {"--spp", "--max-depth", "--cutoff", "--integrator", "--light-sampling"})
        budget->excludes(app.get_option(chosen));
    app.add_option("--samples", o.samples, "Render samples A up to, not including, B: A:B");
    budget->excludes(app.get_option("--samples"));
    app.add_option("--region", o.region, "Render only this part: X,Y,WIDTHxHEIGHT");
    app.add_option("--device", o.device, "Number or part of the name of a device from `minirtc devices`");
    app.add_option("--time-budget", o.timeBudget, "Stop after this many seconds with the samples that are there")
        ->check(CLI::PositiveNumber);
    app.add_option("--stats", o.stats, "Write figures as JSON");
    app.add_flag("--validation", o.validation, "Check every Vulkan call with the Khronos validation layer");
}

void checkOption(bool good, const char* what) {
    if (!good) throw UsageError(what);
}

minirt_render_desc renderDesc(const Options& o) {
    minirt_render_desc desc = {};
    int used = 0;
    const auto whole = [&](const std::string& text) {
        return used == static_cast<int>(text.size()) && text.find('-') == std::string::npos;
    };
    if (!o.size.empty()) parseSize(o.size, desc.width, desc.height);
    desc.samples = o.spp;
    if (!o.samples.empty()) {
        uint32_t end = 0;
        checkOption(std::sscanf(o.samples.c_str(), "%u:%u%n", &desc.first_sample, &end, &used) == 2 && whole(o.samples) &&
                        end > desc.first_sample,
                    "--samples: give A:B with A < B, such as 0:16");
        desc.samples = end - desc.first_sample;
    }
    minirt_region& r = desc.region;
    if (!o.region.empty())
        checkOption(
            std::sscanf(o.region.c_str(), "%u,%u,%ux%u%n", &r.x, &r.y, &r.width, &r.height, &used) == 4 && whole(o.region),
            "--region: give X,Y,WIDTHxHEIGHT, such as 0,0,64x64");
    desc.max_depth = static_cast<uint32_t>(o.maxDepth + 1);
    desc.integrator = o.integrator;
    desc.light_sampling = o.lightSampling;
    desc.seed = o.seed;
    desc.clamp = o.clamp;
    if (o.cutoff >= 0) desc.throughput_cutoff = o.cutoff > 0 ? o.cutoff : -1.0f;  // the runtime's 0 is the scene's
    return desc;
}

/// On a terminal, a bar for what takes over a second.
class ProgressBar {
public:
    explicit ProgressBar(double secondsAllowed) : allowed_(secondsAllowed) {}

    static int update(void* self, const minirt_progress* progress) { return static_cast<ProgressBar*>(self)->show(*progress); }

    void clear() const {
        if (shown_) std::fprintf(stderr, "\r%60s\r", "");
    }

private:
    int show(const minirt_progress& progress) {
        const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
        if (terminal_ && seconds > 1.0) {
            constexpr int kWidth = 40;
            const int filled = static_cast<int>(progress.fraction * kWidth);
            std::fprintf(stderr, "\r[%-*.*s] %3d %%", kWidth, filled, "########################################",
                         static_cast<int>(progress.fraction * 100));
            shown_ = true;
        }
        return allowed_ > 0 && seconds > allowed_ && progress.samples_done > 0;
    }

    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    double allowed_;
    bool terminal_ = isatty(STDERR_FILENO);
    bool shown_ = false;
};

void writeStats(const std::string& path, const minirt_device_info& device, const minirt_stats& s) {
    nlohmann::ordered_json json;
    json["device"] = device.name;
    json["driver"] = device.driver;
    json["width"] = s.width;
    json["height"] = s.height;
    json["spp"] = s.samples;
    json["wall_ms"] = s.wall_ms;
    json["gpu_ms"] = s.gpu_ms;
    json["pipeline_ms"] = s.pipeline_ms;
    json["load_ms"] = s.load_ms;
    json["upload_ms"] = s.upload_ms;
    json["rays"] = {{"primary", s.primary_rays}, {"shadow", s.shadow_rays}, {"secondary", s.secondary_rays}};
    json["mrays_per_s"] =
        s.gpu_ms > 0 ? static_cast<double>(s.primary_rays + s.shadow_rays + s.secondary_rays) / s.gpu_ms * 1e-3 : 0.0;
    json["dispatches"] = {{"all", s.dispatches}, {"resumed", s.resumed_dispatches}};
    json["counters"] = {{"nan_pixels", s.nan_pixels},
                        {"volume_overflow", s.volume_overflow},
                        {"segment_overflow", s.segment_overflow},
                        {"traversal_cap", s.traversal_cap}};
    const std::string text = json.dump(2) + "\n";
    const std::string problem = writeWhole(path, {text.begin(), text.end()});
    if (!problem.empty()) throw std::runtime_error(problem);
}

/// Puts what --budget-ms chooses into `desc`, and prints it.
void applyBudget(Device& device, const Options& options, const Picture& picture, minirt_render_desc& desc) {
    const cost::ProbedBudget found = cost::probeBudget(device, options.blob, picture.width, picture.height, options.budgetMs);
    const minirt_render_desc chosen = cost::renderDesc(found.levers, found.choice.configuration);
    desc.samples = found.choice.samples;
    desc.max_depth = chosen.max_depth;
    desc.integrator = chosen.integrator;
    desc.light_sampling = chosen.light_sampling;
    desc.throughput_cutoff = chosen.throughput_cutoff;
    std::cout << "Chosen: " << choiceWords(found.levers, found.choice) << "; about " << std::lround(found.choice.ms) << " ms. "
              << givenUpSentence(found.levers, found.choice, found.sceneSamples) << "\n"
              << "Tried " << found.tried << " settings on " << found.width << "x" << found.height << " pixels, in "
              << std::ceil(found.seconds * 10) / 10 << " s with the check at full size.\n";
}

void render(const Options& options) {
    if (!isPictureName(options.output))
        throw UsageError(options.output + ": unknown kind of picture; use .png, .exr, .hdr or .pfm");
    minirt_render_desc desc = renderDesc(options);
    for (const std::string& path : {options.output, options.stats}) {
        const std::string problem = path.empty() ? "" : whyNotWritable(path);
        if (!problem.empty()) throw std::runtime_error(problem);
    }
    Device device(options.device, options.validation);
    minirt_scene* scene = device.load(options.blob);
    minirt_scene_desc sceneDesc;
    minirt_get_scene_desc(scene, &sceneDesc);
    Picture picture;
    picture.width = desc.width ? desc.width : sceneDesc.width;
    picture.height = desc.height ? desc.height : sceneDesc.height;
    picture.rgba.resize(size_t{picture.width} * picture.height * 4);
    if (options.budgetMs > 0) applyBudget(device, options, picture, desc);
    ProgressBar bar(options.timeBudget);
    minirt_stats stats = {};
    desc.progress = ProgressBar::update;
    desc.progress_user = &bar;
    desc.stats = &stats;
    const minirt_result result = minirt_render(scene, &desc, picture.rgba.data());
    bar.clear();
    if (result != MINIRT_CANCELLED)
        device.require(result, options.blob);  // cancelled: the time budget is spent, the samples are fine
    const std::string problem = writePicture(options.output, picture);
    if (!problem.empty()) throw std::runtime_error(problem);
    if (options.budgetMs > 0) std::cout << "Rendered in " << std::lround(stats.gpu_ms) << " ms of the device's time.\n";
    if (!options.stats.empty()) writeStats(options.stats, device.info(), stats);
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app("minirt-render renders a baked scene to a picture file", "minirt-render");
    Options options;
    addOptions(app, options);
    app.failure_message(oneLineFailure);
    CLI11_PARSE(app, argc, argv);
    try {
        render(options);
    } catch (const std::exception& error) {
        std::cerr << error.what() << "\n";
        return 1;
    }
    return 0;
}
