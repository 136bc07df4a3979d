// A window that shows pictures and collects keys and drags. GLFW, with OpenGL only to put pixels on the screen.
#pragma once
#include <string>
#include <vector>

#include "camera_controller.hpp"
#include "progressive_view.hpp"

struct GLFWwindow;

/// width * height * 3 bytes, top row first.
struct Image8 {
    uint32_t width = 0;
    uint32_t height = 0;
    std::vector<uint8_t> rgb;
};

class Window {
public:
    /// Throws std::runtime_error where there is no display.
    Window(const std::string& title, Size size);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    /// In pixels; 0x0 while minimised.
    Size size() const;
    bool shouldClose() const;
    void setTitle(const std::string& title);

    /// Handles what happened; waits up to `seconds` for something to happen.
    void poll(double seconds);
    Motion motion() const;
    /// The drag since the last call, in window heights.
    struct Drag {
        double right = 0;
        double down = 0;
    };
    Drag takeDrag();
    /// True once for each press of P or F12.
    bool takeSaveRequest();

    /// Fills the window with a linear picture as sRGB.
    void show(const Picture& picture);
    /// What the window shows.
    Image8 pixels() const;

private:
    static void onKey(GLFWwindow* handle, int key, int scancode, int action, int modifiers);
    static void onCursor(GLFWwindow* handle, double x, double y);
    static void onRefresh(GLFWwindow* handle);
    static Window& of(GLFWwindow* handle);

    void draw() const;

    GLFWwindow* handle_ = nullptr;
    unsigned texture_ = 0;
    double cursorX_ = 0;
    double cursorY_ = 0;
    Drag drag_;
    bool saveRequested_ = false;
};
