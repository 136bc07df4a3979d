#include "kernel.hpp"

#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <glslang/SPIRV/GlslangToSpv.h>

#include <algorithm>
#include <exception>
#include <future>
#include <initializer_list>
#include <memory>
#include <mutex>
#include <spirv-tools/libspirv.hpp>
#include <spirv-tools/optimizer.hpp>

#include "error.hpp"
#include "levers.hpp"
#include "parallel.hpp"
#include "shader_library.hpp"

namespace minirtc {
namespace {

constexpr auto kVulkan = glslang::EShTargetVulkan_1_1;
constexpr auto kSpirv = glslang::EShTargetSpv_1_3;
constexpr auto kToolsEnvironment = SPV_ENV_VULKAN_1_1;

// clang-format off
/// The order in which the parts of a kernel build on each other.
const std::vector<std::string> kParts = {
    "common/language.glsl",
    "layout",
    "common/device_class.glsl",
    "common/extremes.glsl",
    "common/neighbours.glsl",
    "common/numerics.glsl",
    "common/pixel.glsl",
    "common/patterns.glsl",
    "bsdf/optics.glsl",
    "levers/fresnel.glsl",
    "bsdf/medium.glsl",
    "bsdf/dispersion.glsl",
    "sampling/random.glsl",
    "media/volumes.glsl",
    "traverse/box.glsl",
    "traverse/grid_box.glsl",
    "levers/double_begin.glsl",
    "traverse/triangle.glsl",
    "levers/intersection.glsl",
    "traverse/sphere.glsl",
    "levers/double_end.glsl",
    "common/frame.glsl",
    "levers/ray_offset.glsl",
    "common/fetch.glsl",
    "traverse/nodes.glsl",
    "effects/images.glsl",
    "effects/background.glsl",
    "effects/textures.glsl",
    "common/materials.glsl",
    "effects/alpha.glsl",
    "effects/primitives.glsl",
    "traverse/stack.glsl",
    "effects/profile.glsl",
    "traverse/traverse.glsl",
    "common/suspend.glsl",
    "effects/smooth_normals.glsl",
    "effects/surface_maps.glsl",
    "effects/checker.glsl",
    "effects/nesting.glsl",
    "effects/media.glsl",
    "effects/dispersion.glsl",
    "common/surface.glsl",
    "effects/lights.glsl",
    "effects/scatter.glsl",
    "effects/shadows.glsl",
    "effects/emission.glsl",
    "common/encounter.glsl",
};
// clang-format on

/// What Whitted's tracer has beyond them.
const std::vector<std::string> kWhittedParts = {"whitted/walk.glsl", "levers/weak_rays.glsl", "whitted/own_list.glsl",
                                                "whitted/tree.glsl"};

/// The same where lanes share the tree.
const std::vector<std::string> kSharedParts = {"whitted/walk.glsl", "levers/weak_rays.glsl", "whitted/shared_work.glsl",
                                               "whitted/tree.glsl"};

/// What the path tracers have beyond them.
const std::vector<std::string> kPathParts = {
    "sampling/warp.glsl",       "sampling/cells.glsl",        "bsdf/microfacet.glsl",
    "effects/lens.glsl",        "effects/microfacets.glsl",   "effects/rough_transmission.glsl",
    "path/bsdf.glsl",           "effects/light_picking.glsl", "effects/environment_light.glsl",
    "effects/area_lights.glsl", "path/lights.glsl",           "sampling/filter.glsl",
    "path/path.glsl",           "path/vertex.glsl",           "path/queues.glsl",
};

const std::string kHeader = R"(#version 460
#extension GL_GOOGLE_cpp_style_line_directive : require
#extension GL_EXT_control_flow_attributes : require
#extension GL_KHR_shader_subgroup_ballot : require
#define MINIRT_UINT uint
#define minirt_vec4 vec4
#define minirt_uvec4 uvec4
)";

[[noreturn]] void failInternally(const std::string& name, const std::string& stage, const std::string& log) {
    throw Error("kernel '" + name + "' did not " + stage + ":\n" + log,
                "this is a defect of minirtc; please report it with the scene");
}

/// glslang keeps global state from its first use to the end of the process.
void initialiseGlslang() {
    static std::once_flag once;
    std::call_once(once, [] { glslang::InitializeProcess(); });
}

struct Compiled {
    std::vector<uint32_t> spirv;
    uint32_t bindings = 0;
};

Compiled compileGlsl(const std::string& name, const std::string& source) {
    initialiseGlslang();
    glslang::TShader shader(EShLangCompute);
    const char* text = source.c_str();
    shader.setStrings(&text, 1);
    shader.setEnvInput(glslang::EShSourceGlsl, EShLangCompute, glslang::EShClientVulkan, 100);
    shader.setEnvClient(glslang::EShClientVulkan, kVulkan);
    shader.setEnvTarget(glslang::EShTargetSpv, kSpirv);
    const auto messages = static_cast<EShMessages>(EShMsgSpvRules | EShMsgVulkanRules);
    if (!shader.parse(GetDefaultResources(), 460, false, messages)) failInternally(name, "compile", shader.getInfoLog());
    glslang::TProgram program;
    program.addShader(&shader);
    if (!program.link(messages) || !program.buildReflection(EShReflectionAllBlockVariables)) {
        failInternally(name, "link", program.getInfoLog());
    }
    Compiled result;
    const auto note = [&](const glslang::TObjectReflection& object) {
        if (object.getBinding() >= 0) result.bindings |= 1u << object.getBinding();
    };
    for (int i = 0; i < program.getNumUniformVariables(); ++i) note(program.getUniform(i));
    for (int i = 0; i < program.getNumBufferBlocks(); ++i) note(program.getBufferBlock(i));
    for (int i = 0; i < program.getNumUniformBlocks(); ++i) note(program.getUniformBlock(i));
    glslang::SpvOptions options;
    options.disableOptimizer = true;  // SPIRV-Tools does it below
    glslang::GlslangToSpv(*program.getIntermediate(EShLangCompute), result.spirv, &options);
    return result;
}

std::vector<uint32_t> optimise(const std::string& name, const std::vector<uint32_t>& spirv) {
    std::string log;
    const auto consume = [&](spv_message_level_t, const char*, const spv_position_t&, const char* message) {
        log += std::string(message) + "\n";
    };
    spvtools::Optimizer optimizer(kToolsEnvironment);
    optimizer.SetMessageConsumer(consume);
    optimizer.RegisterPerformancePasses();
    optimizer.RegisterPass(spvtools::CreateLoopUnrollPass(true));  // loops marked so; drivers that count loops do not count these
    optimizer.RegisterPerformancePasses();
    optimizer.RegisterPass(spvtools::CreateStripDebugInfoPass());
    std::vector<uint32_t> optimised;
    if (!optimizer.Run(spirv.data(), spirv.size(), &optimised)) failInternally(name, "optimise", log);
    spvtools::SpirvTools tools(kToolsEnvironment);
    tools.SetMessageConsumer(consume);
    if (!tools.Validate(optimised)) failInternally(name, "validate", log);
    return optimised;
}

Kernel compileSource(const KernelJob& job, const std::string& source) {
    Compiled compiled = compileGlsl(job.name, source);
    Kernel kernel;
    kernel.name = job.name;
    kernel.glsl = source;
    kernel.bindings = compiled.bindings;
    kernel.spirv = optimise(job.name, compiled.spirv);
    // One a level of depth, and a dispersed ray's further channels.
    kernel.waits = job.name.rfind("whitted", 0) == 0 && job.effects.splits() ? job.effects.channels() : 0;
    return kernel;
}

}  // namespace

std::string composeKernel(const std::string& name, const EffectSet& effects) {
    std::string source = kHeader;
    for (size_t i = 0; i < kEffectCount; ++i) {
        const auto effect = static_cast<Effect>(i);
        if (effects.has(effect)) source += std::string("#define ") + effectInfo(effect).define + "\n";
    }
    if (effects.profile) source += "#define EFFECT_PROFILE\n";
    for (const std::string& define : definesOf(effects.levers)) source += "#define " + define + "\n";
    source += "#define VOLUME_CAPACITY " + std::to_string(effects.volumeCapacity) + "\n";
    std::vector<std::string> parts = kParts;
    if (name.rfind("rays", 0) == 0) parts.push_back("common/query.glsl");
    const std::vector<std::string>& further = name == "whitted"          ? kWhittedParts
                                              : name == "whitted_shared" ? kSharedParts
                                                                         : kPathParts;
    parts.insert(parts.end(), further.begin(), further.end());
    parts.push_back("kernels/" + name + ".comp");
    for (const std::string& part : parts) source += "#line 1 \"" + part + "\"\n" + shaderLibrary().at(part) + "\n";
    return source;
}

std::vector<std::string> kernelsOf(Integrator integrator, const EffectSet& effects) {
    if (integrator == Integrator::whitted) return {"whitted"};
    if (integrator == Integrator::whittedShared) return {"whitted_shared"};
    if (integrator == Integrator::path) return {"path"};
    std::vector<std::string> names = {"wave_generate", "wave_closest", "wave_hit", "wave_accumulate"};
    const auto any = [&](std::initializer_list<Effect> wanted) {
        return std::any_of(wanted.begin(), wanted.end(), [&](Effect effect) { return effects.has(effect); });
    };
    if (any({Effect::environmentLight, Effect::nesting, Effect::inscatter})) names.push_back("wave_miss");
    if (any({Effect::pointLights, Effect::directionalLights, Effect::spotLights, Effect::areaLights, Effect::environmentLight}))
        names.push_back("wave_shadow");
    return names;
}

Kernel compileKernel(const std::string& name, const EffectSet& effects) {
    return compileSource({name, effects}, composeKernel(name, effects));
}

std::vector<Kernel> KernelCompiler::compile(const std::vector<KernelJob>& jobs) {
    struct Fresh {
        const KernelJob* job;
        const std::string* source;
        std::promise<Kernel> kernel;
    };
    std::vector<Fresh> fresh;
    std::vector<std::shared_future<Kernel>> wanted;
    for (const KernelJob& job : jobs) {
        std::string source = composeKernel(job.name, job.effects);
        const std::lock_guard<std::mutex> lock(mutex_);
        const auto [slot, isNew] = compiled_.try_emplace(std::move(source));
        if (isNew) {
            fresh.push_back({&job, &slot->first, {}});
            slot->second = fresh.back().kernel.get_future().share();
        }
        wanted.push_back(slot->second);
    }
    ThreadPool(threads_).parallelFor(fresh.size(), [&](size_t i) {
        try {
            fresh[i].kernel.set_value(compileSource(*fresh[i].job, *fresh[i].source));
        } catch (...) {
            fresh[i].kernel.set_exception(std::current_exception());
        }
    });
    std::vector<Kernel> kernels;
    kernels.reserve(wanted.size());
    for (const std::shared_future<Kernel>& kernel : wanted) kernels.push_back(kernel.get());
    return kernels;
}

}  // namespace minirtc
