// A device of the runtime whose failures are exceptions with a sentence for people.
#pragma once
#include <minirt.h>

#include <memory>
#include <string>

/// Owns a minirt_context with all that belongs to it.
class Device {
public:
    /// `name`: number or part of the name, "": the best. Throws std::runtime_error.
    explicit Device(const std::string& name, bool validation = false);
    ~Device() { minirt_destroy(context_); }
    Device(const Device&) = delete;
    Device& operator=(const Device&) = delete;

    /// The same device once more, for another thread.
    std::unique_ptr<Device> another() const { return std::make_unique<Device>(name_); }

    /// Loads a blob; the scene lives as long as the device. Throws std::runtime_error that names the file.
    minirt_scene* load(const std::string& path);

    /// Throws unless `result` is MINIRT_OK; `where` is the file that the message starts with.
    void require(minirt_result result, const std::string& where) const;

    minirt_device_info info() const;

    /// For calls of the runtime; the Device owns it.
    minirt_context* context() const { return context_; }

private:
    static void keepMessage(void* self, minirt_log_level level, const char* message);

    std::string name_;
    minirt_context* context_ = nullptr;
    std::string error_;  // the last one; the context that failed to open has none to ask
};
