#include "render_levers.hpp"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace cost {
namespace {

bool belongsTo(const minirt_kernel& kernel, minirt_integrator integrator) {
    if (integrator == MINIRT_INTEGRATOR_WAVEFRONT) return std::strncmp(kernel.name, "wave_", 5) == 0;
    return std::strcmp(kernel.name, integrator == MINIRT_INTEGRATOR_PATH ? "path" : "whitted") == 0;
}

/// A blob in memory, aligned as the validator wants it.
class BlobFile {
public:
    explicit BlobFile(const std::string& path) {
        std::ifstream file(path, std::ios::binary);
        if (!file) throw std::runtime_error(path + ": cannot be opened; does the file exist?");
        const std::vector<char> bytes{std::istreambuf_iterator<char>(file), {}};
        rows_.resize(bytes.size() / sizeof(minirt_vec4) + 1);
        std::memcpy(static_cast<void*>(rows_.data()), bytes.data(), bytes.size());
        minirt_validation validation;
        if (minirt_validate(rows_.data(), bytes.size(), &blob_, &validation))
            throw std::runtime_error(path + ": " + validation.message);
    }
    const minirt_blob& get() const { return blob_; }

private:
    struct alignas(16) Row {
        float values[4];
    };
    std::vector<Row> rows_;
    minirt_blob blob_ = {};
};

std::string counted(uint32_t n, const std::string& thing) {
    return std::to_string(n) + " " + thing + (n == 1 ? "" : "s");
}

/// Settings of a number, of which one is the scene's and the last one the reference's.
Lever numberLever(LeverKind kind, const std::string& name, const std::string& title, std::vector<uint32_t> values, uint32_t own,
                  const std::string& thing) {
    std::sort(values.begin(), values.end());
    values.erase(std::unique(values.begin(), values.end()), values.end());
    Lever lever{kind, name, title, {}, 0, values.size() - 1, true, ""};
    for (uint32_t value : values) {
        if (value == own) lever.initial = lever.settings.size();
        lever.settings.push_back({std::to_string(value), counted(value, thing), static_cast<double>(value)});
    }
    return lever;
}

Lever depthLever(uint32_t depth) {
    constexpr uint32_t kDeepest = 255;
    Lever lever =
        numberLever(LeverKind::depth, "depth", "Bounces",
                    {std::max(depth / 4, 1u), std::max(depth / 2, 1u), depth, std::min(depth * 2, kDeepest)}, depth, "bounce");
    return lever;
}

Lever cutoffLever(double own) {
    Lever lever{LeverKind::cutoff, "cutoff", "Cut-off", {}, 2, 3, false, ""};
    for (double factor : {16.0, 4.0, 1.0, 1.0 / 8}) {
        const int share = static_cast<int>(1 / (own * factor) + 0.5);
        const std::string name = "1/" + std::to_string(share);
        lever.settings.push_back({name, "a cut-off at " + name + " of the light", own * factor});
    }
    return lever;
}

Lever lightLever() {
    return {LeverKind::lightSampling,
            "light_sampling",
            "How light is found",
            {{"surfaces", "light found by surfaces alone", MINIRT_LIGHT_SAMPLING_SURFACES},
             {"lights", "light found by picking lights alone", MINIRT_LIGHT_SAMPLING_LIGHTS},
             {"balance", "both ways to find light, by the balance heuristic", MINIRT_LIGHT_SAMPLING_MIS_BALANCE},
             {"mis", "both ways to find light, by the power heuristic", MINIRT_LIGHT_SAMPLING_MIS}},
            3,
            3,
            false,
            ""};
}

/// The settings of the path tracers end with the one that the device uses by itself.
Lever integratorLever(const BlobFacts& facts, minirt_integrator own) {
    Lever lever{LeverKind::integrator, "integrator", "Integrator", {}, 0, 0, false, ""};
    const auto add = [&](minirt_integrator integrator, const char* name, const char* words) {
        if (facts.has(integrator)) lever.settings.push_back({name, words, static_cast<double>(integrator)});
    };
    if (own == MINIRT_INTEGRATOR_WHITTED) {
        add(own, "whitted", "Whitted's tracer");
        lever.idle =
            "the scene asks for Whitted's tracer, and what path tracers compute is other light, not the same more accurately";
        return lever;
    }
    const auto addPath = [&] { add(MINIRT_INTEGRATOR_PATH, "path", "the path tracer as one kernel"); };
    add(MINIRT_INTEGRATOR_WHITTED, "whitted", "Whitted's tracer");
    if (own == MINIRT_INTEGRATOR_WAVEFRONT) addPath();
    add(MINIRT_INTEGRATOR_WAVEFRONT, "wavefront", "the path tracer as a wavefront");
    if (own == MINIRT_INTEGRATOR_PATH) addPath();
    lever.initial = lever.best = lever.settings.size() - 1;
    if (lever.settings.size() < 2) lever.idle = "the blob holds no other one";
    return lever;
}

}  // namespace

bool BlobFacts::has(minirt_integrator integrator) const {
    return std::find(integrators.begin(), integrators.end(), integrator) != integrators.end();
}

BlobFacts readBlobFacts(const std::string& path) {
    const BlobFile file(path);
    BlobFacts facts;
    facts.scene = *file.get().scene;
    for (minirt_integrator integrator : {MINIRT_INTEGRATOR_WHITTED, MINIRT_INTEGRATOR_PATH, MINIRT_INTEGRATOR_WAVEFRONT}) {
        const minirt_kernel* first = file.get().kernels;
        if (std::any_of(first, first + file.get().kernel_count, [&](const minirt_kernel& k) { return belongsTo(k, integrator); }))
            facts.integrators.push_back(integrator);
    }
    return facts;
}

size_t kernelBytes(const std::string& path, minirt_integrator integrator) {
    const BlobFile file(path);
    size_t bytes = 0;
    for (uint64_t i = 0; i < file.get().kernel_count; ++i)
        if (belongsTo(file.get().kernels[i], integrator)) bytes += file.get().kernels[i].spirv_size;
    return bytes;
}

minirt_integrator defaultIntegrator(const BlobFacts& facts, bool cpuDevice) {
    const auto own = static_cast<minirt_integrator>(facts.scene.integrator);
    if (own == MINIRT_INTEGRATOR_WHITTED || own == MINIRT_INTEGRATOR_WHITTED_SHARED) return MINIRT_INTEGRATOR_WHITTED;
    const minirt_integrator faster = cpuDevice ? MINIRT_INTEGRATOR_WAVEFRONT : MINIRT_INTEGRATOR_PATH;
    return facts.has(faster) ? faster : own;
}

std::vector<Lever> renderLevers(const BlobFacts& facts, bool cpuDevice, uint32_t samples) {
    const minirt_integrator own = defaultIntegrator(facts, cpuDevice);
    std::vector<Lever> levers = {integratorLever(facts, own), depthLever(facts.scene.max_depth)};
    if (own == MINIRT_INTEGRATOR_WHITTED)
        levers.push_back(cutoffLever(facts.scene.throughput_cutoff));
    else
        levers.push_back(lightLever());
    levers.push_back(numberLever(LeverKind::samples, "samples", "Samples a pixel",
                                 {std::max(samples / 4, 1u), std::max(samples / 2, 1u), samples, samples * 2, samples * 4},
                                 samples, "sample"));
    return levers;
}

minirt_render_desc renderDesc(const std::vector<Lever>& levers, const Configuration& configuration) {
    minirt_render_desc desc = {};
    for (size_t i = 0; i < levers.size(); ++i) {
        const double value = levers[i].settings[configuration[i]].value;
        const auto whole = static_cast<uint32_t>(value);
        if (levers[i].kind == LeverKind::integrator) desc.integrator = static_cast<minirt_integrator>(whole);
        if (levers[i].kind == LeverKind::depth) desc.max_depth = whole + 1;
        if (levers[i].kind == LeverKind::cutoff) desc.throughput_cutoff = static_cast<float>(value);
        if (levers[i].kind == LeverKind::lightSampling) desc.light_sampling = whole;
        if (levers[i].kind == LeverKind::samples) desc.samples = whole;
    }
    return desc;
}

uint32_t samplesOf(const std::vector<Lever>& levers, const Configuration& configuration) {
    return renderDesc(levers, configuration).samples;
}

}  // namespace cost
