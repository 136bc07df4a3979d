// What tests change inside of the runtime to reach states that its API never shows. Defined in ray_query.cpp, the one file that
// sees the runtime's insides.
#pragma once
#include <cstdint>

struct minirt_context;
struct minirt_scene;

namespace test {

/// The budget of steps a pixel has in a dispatch: of kernels that are specialised from now on.
uint32_t stepBudget(const minirt_context* context);
void setStepBudget(minirt_context* context, uint32_t steps);

/// Specialises kernels from now on as for a GPU: private stacks, scene data in storage buffers, no interleaving. Keeps the budget of steps.
void specialiseAsGpu(minirt_context* context);

/// As if the device took no more bytes in a storage buffer.
void limitStorage(minirt_context* context, uint32_t bytes);

/// Whether kernels read nodes and primitives as texels.
bool fetchesTexels(const minirt_scene* scene);

/// As if the device had memory for so many allocations more. For one context at a time.
void limitAllocations(minirt_context* context, int count);

/// As if the device had no ballots in subgroups.
void denyBallots(minirt_context* context);

/// Lets the kernel whitted_shared run where it would not: on a CPU device, for work that no loop of it is too long for.
void allowSharedTrees(minirt_context* context);

/// As if the device took no more in a texel buffer.
void limitTexels(minirt_context* context, uint32_t texels);

/// As if the device had no doubles.
void takeFloat64(minirt_context* context);

/// As if the driver had reported the loss of the device.
void loseDevice(minirt_context* context);

/// Breaks a rule of Vulkan, about which the validation layer has to complain.
void breakValidation(minirt_context* context);

}  // namespace test
