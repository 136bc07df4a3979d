// What a driver says of the kernels that it has compiled (VK_KHR_pipeline_executable_properties): registers, stack, bytes.
#pragma once
#include <functional>
#include <string>
#include <utility>
#include <vector>

struct minirt_context;

namespace bench {

/// Of one kernel, or of one of several programs that the driver made of it: figures by the driver's own names.
struct KernelStatistics {
    std::string program;
    std::vector<std::pair<std::string, double>> figures;
};

/// The largest figure of all programs whose name contains one of `words`; below 0 where the driver gives none.
double largestFigure(const std::vector<KernelStatistics>& statistics, const std::vector<std::string>& words);

/// Of all pipelines that `make` has the runtime make, on the device opened once more. Empty where the device does not tell; `make` is not called then.
std::vector<KernelStatistics> statisticsOf(const std::string& device, const std::function<void(minirt_context*)>& make);

/// Compiles the kernels of the blob's own integrator once more, as the runtime does. Empty where the device does not tell. Throws std::runtime_error.
std::vector<KernelStatistics> kernelStatistics(const std::string& device, const std::string& blob);

}  // namespace bench
