#include "window.hpp"

#include <GLFW/glfw3.h>

#include <stdexcept>
#include <utility>

namespace {

[[noreturn]] void fail() {
    const char* reason = nullptr;
    glfwGetError(&reason);
    const std::string message =
        std::string("no window: ") + (reason ? reason : "unknown reason") + "; is there a display with OpenGL?";
    glfwTerminate();
    throw std::runtime_error(message);
}

}  // namespace

Window::Window(const std::string& title, Size size) {
    if (!glfwInit()) fail();
    glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_FALSE);
    handle_ = glfwCreateWindow(static_cast<int>(size.width), static_cast<int>(size.height), title.c_str(), nullptr, nullptr);
    if (!handle_) fail();
    glfwSetWindowUserPointer(handle_, this);
    glfwSetKeyCallback(handle_, onKey);
    glfwSetCursorPosCallback(handle_, onCursor);
    glfwSetWindowRefreshCallback(handle_, onRefresh);
    glfwMakeContextCurrent(handle_);
    glfwSwapInterval(1);
    glGenTextures(1, &texture_);
    glBindTexture(GL_TEXTURE_2D, texture_);
    for (GLenum filter : {GL_TEXTURE_MIN_FILTER, GL_TEXTURE_MAG_FILTER}) glTexParameteri(GL_TEXTURE_2D, filter, GL_NEAREST);
    glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
    glPixelStorei(GL_PACK_ALIGNMENT, 1);
    glEnable(GL_TEXTURE_2D);
}

Window::~Window() {
    glfwDestroyWindow(handle_);
    glfwTerminate();
}

Size Window::size() const {
    int width = 0;
    int height = 0;
    glfwGetFramebufferSize(handle_, &width, &height);
    return {static_cast<uint32_t>(width), static_cast<uint32_t>(height)};
}

bool Window::shouldClose() const {
    return glfwWindowShouldClose(handle_);
}

void Window::setTitle(const std::string& title) {
    glfwSetWindowTitle(handle_, title.c_str());
}

void Window::poll(double seconds) {
    if (seconds > 0)
        glfwWaitEventsTimeout(seconds);
    else
        glfwPollEvents();
}

Motion Window::motion() const {
    const auto isDown = [&](int key) { return glfwGetKey(handle_, key) == GLFW_PRESS; };
    return motionOf(
        [&](char key) { return key == '+' ? isDown(GLFW_KEY_LEFT_SHIFT) || isDown(GLFW_KEY_RIGHT_SHIFT) : isDown(key); });
}

Window::Drag Window::takeDrag() {
    return std::exchange(drag_, {});
}

bool Window::takeSaveRequest() {
    return std::exchange(saveRequested_, false);
}

void Window::show(const Picture& picture) {
    std::vector<uint8_t> bytes;
    bytes.reserve(picture.rgba.size() / 4 * 3);
    for (size_t i = 0; i < picture.rgba.size(); i += 4)
        for (size_t k = 0; k < 3; ++k) bytes.push_back(srgbByte(picture.rgba[i + k]));
    const auto width = static_cast<GLsizei>(picture.width);
    const auto height = static_cast<GLsizei>(picture.height);
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGB8, width, height, 0, GL_RGB, GL_UNSIGNED_BYTE, bytes.data());
    draw();
    glfwSwapBuffers(handle_);
}

Image8 Window::pixels() const {
    draw();
    const Size s = size();
    std::vector<uint8_t> bottomUp(size_t{s.width} * s.height * 3);
    glReadPixels(0, 0, static_cast<GLsizei>(s.width), static_cast<GLsizei>(s.height), GL_RGB, GL_UNSIGNED_BYTE, bottomUp.data());
    Image8 image{s.width, s.height, {}};
    image.rgb.reserve(bottomUp.size());
    const auto row = static_cast<std::ptrdiff_t>(s.width) * 3;
    for (auto end = bottomUp.end(); end != bottomUp.begin(); end -= row) image.rgb.insert(image.rgb.end(), end - row, end);
    return image;
}

void Window::draw() const {
    const Size s = size();
    glViewport(0, 0, static_cast<GLsizei>(s.width), static_cast<GLsizei>(s.height));
    glBegin(GL_TRIANGLE_STRIP);
    for (int corner = 0; corner < 4; ++corner) {
        const auto x = static_cast<float>(corner % 2);
        const auto y = corner < 2 ? 0.0f : 1.0f;
        glTexCoord2f(x, 1 - y);
        glVertex2f(2 * x - 1, 2 * y - 1);
    }
    glEnd();
}

Window& Window::of(GLFWwindow* handle) {
    return *static_cast<Window*>(glfwGetWindowUserPointer(handle));
}

void Window::onKey(GLFWwindow* handle, int key, int, int action, int) {
    if (action != GLFW_PRESS) return;
    if (key == GLFW_KEY_ESCAPE) glfwSetWindowShouldClose(handle, GLFW_TRUE);
    if (key == GLFW_KEY_P || key == GLFW_KEY_F12) of(handle).saveRequested_ = true;
}

void Window::onCursor(GLFWwindow* handle, double x, double y) {
    Window& window = of(handle);
    int width = 0;
    int height = 0;
    glfwGetWindowSize(handle, &width, &height);
    if (glfwGetMouseButton(handle, GLFW_MOUSE_BUTTON_LEFT) == GLFW_PRESS && height > 0) {
        window.drag_.right += (x - window.cursorX_) / height;
        window.drag_.down += (y - window.cursorY_) / height;
    }
    window.cursorX_ = x;
    window.cursorY_ = y;
}

void Window::onRefresh(GLFWwindow* handle) {
    of(handle).draw();
    glfwSwapBuffers(handle);
}
