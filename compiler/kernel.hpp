// From a set of effects to SPIR-V.
#pragma once
#include <cstdint>
#include <future>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "effects.hpp"

namespace minirtc {

struct Kernel {
    std::string name;
    std::string glsl;             // the whole source, as handed to glslang
    std::vector<uint32_t> spirv;  // optimised and validated
    uint32_t bindings = 0;        // bit b: binding b is used
    uint32_t waits = 0;           // minirt_kernel::waits
};

/// The GLSL of a kernel: the files of the shader library that it consists of, behind the defines of its effects.
std::string composeKernel(const std::string& name, const EffectSet& effects);

/// Names of an integrator's kernels: of the wavefront those only whose queues fill under these effects.
std::vector<std::string> kernelsOf(Integrator integrator, const EffectSet& effects);

/// Compiles (glslang), optimises and validates (SPIRV-Tools). A failure is a defect of the project: throws Error with the log.
Kernel compileKernel(const std::string& name, const EffectSet& effects);

struct KernelJob {
    std::string name;
    EffectSet effects;
};

/// Compiles kernels side by side, and what it has compiled before not again. For any number of threads.
class KernelCompiler {
public:
    /// `threads`: 0 for all cores. The kernels do not depend on it.
    explicit KernelCompiler(unsigned threads) : threads_(threads) {}

    /// In the order of the jobs. Throws as compileKernel does.
    std::vector<Kernel> compile(const std::vector<KernelJob>& jobs);

private:
    unsigned threads_;
    std::mutex mutex_;
    std::map<std::string, std::shared_future<Kernel>> compiled_;  // by their source
};

}  // namespace minirtc
