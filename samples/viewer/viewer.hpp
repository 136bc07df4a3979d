// The loop of the viewer: input, camera, picture, window.
#pragma once
#include <chrono>
#include <string>

#include "key_script.hpp"
#include "progressive_view.hpp"
#include "window.hpp"

struct ViewerDesc {
    std::string name;        // in the title and in the names of saved pictures
    Size size;               // of the window, in pixels
    std::string screenshot;  // PNG to write of the finished picture before the loop ends; "": go on until closed
    uint32_t samples = 256;  // a pixel, of a finished picture
    KeyScript script;        // plays first
};

class Stopwatch {
public:
    double seconds() const { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count(); }
    /// Gives the seconds so far.
    double restart();

private:
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

class Viewer {
public:
    /// Opens the window. Throws std::runtime_error.
    Viewer(const ViewerDesc& desc, Device& device, minirt_scene* scene);

    /// Returns when the window is closed or the screenshot is written. Throws std::runtime_error.
    void run();

private:
    bool moveCamera(double seconds);
    void preview(Size size);
    void refine();
    void show();
    void save(const std::string& path);
    std::string freeName() const;

    ViewerDesc desc_;
    Window window_;
    ProgressiveView view_;
    CameraController camera_;
    Size shown_;
    Stopwatch frame_;
    Stopwatch rest_;     // since the last preview
    Stopwatch refresh_;  // since the last picture
};
