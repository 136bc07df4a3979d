// A buffer of the device that is filled as the runtime fills its own.
#pragma once
#include <cstddef>
#include <memory>

struct minirt_context;

namespace bench {

class DeviceCopy {
public:
    /// `context` must outlive the object. Throws std::runtime_error.
    DeviceCopy(minirt_context* context, size_t size);
    ~DeviceCopy();
    DeviceCopy(const DeviceCopy&) = delete;
    DeviceCopy& operator=(const DeviceCopy&) = delete;

    /// All of its bytes; on return they are there.
    void write(const void* data);

private:
    struct Insides;
    std::unique_ptr<Insides> insides_;
};

}  // namespace bench
