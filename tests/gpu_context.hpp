// A device to test on, watched by the validation layer.
#pragma once
#include <string>
#include <vector>

#include "minirt.h"

namespace test {

/// A context with the validation layer (synchronisation checks included) where it is installed. Whatever the layer or the runtime
/// says fails the running case, at the latest when the object goes. Without a device the case is skipped and the object false.
class GpuContext {
public:
    explicit GpuContext(int validation = 1);
    ~GpuContext();
    GpuContext(const GpuContext&) = delete;
    GpuContext& operator=(const GpuContext&) = delete;

    explicit operator bool() const { return context_ != nullptr; }
    minirt_context* get() const { return context_; }
    /// Whose kernels count every pass of every loop. A GPU's count those of outer loops.
    bool isCpu() const;
    /// What was said since the last call. For cases that provoke an error: the case judges it then.
    std::vector<std::string> takeMessages();

private:
    minirt_context* context_ = nullptr;
    std::vector<std::string> messages_;
};

/// A log callback that appends to the std::vector<std::string> at `messages`; that the layer is missing is not worth a word.
void collectMessage(void* messages, minirt_log_level level, const char* message);

}  // namespace test
