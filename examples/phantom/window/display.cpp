#include "display.hpp"

#include <GLFW/glfw3.h>
#include <chrono>
#include <cstddef>
#include <imgui.h>
#include <imgui_impl_glfw.h>
#include <imgui_impl_opengl3.h>
#include <thread>
#include <vector>

#include "support/stb.hpp"

namespace phantom {

namespace {

std::string last_error() {
  const char* text = nullptr;
  glfwGetError(&text);
  return text ? text : "GLFW does not say why";
}

/// One to read and a large one.  DejaVu where it is installed; ImGui's own, which has one size, elsewhere.
void load_font(float scale) {
  ImFontAtlas& fonts = *ImGui::GetIO().Fonts;
  for (const char* path :
       {"/usr/share/fonts/truetype/dejavu/DejaVuSans.ttf", "/usr/share/fonts/TTF/DejaVuSans.ttf"})
    if (std::FILE* file = std::fopen(path, "rb")) {
      std::fclose(file);
      if (fonts.AddFontFromFileTTF(path, 14 * scale) && fonts.AddFontFromFileTTF(path, 26 * scale)) return;
    }
  ImFontConfig config;
  config.SizePixels = 13 * scale;
  fonts.AddFontDefault(&config);
  config.SizePixels = 26 * scale;
  fonts.AddFontDefault(&config);
}

}  // namespace

std::unique_ptr<Display> Display::open(double zoom, std::string& why) {
  if (!glfwInit()) {
    why = last_error();
    return nullptr;
  }
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 2);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
  glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
  const int width = static_cast<int>(1280 * zoom), height = static_cast<int>(720 * zoom);
  if (GLFWwindow* window = glfwCreateWindow(width, height, "hapbeam", nullptr, nullptr))
    return std::unique_ptr<Display>(new Display(window, static_cast<float>(zoom)));
  why = last_error();
  glfwTerminate();
  return nullptr;
}

Display::Display(GLFWwindow* window, float zoom) : window_(window) {
  glfwMakeContextCurrent(window_);
  glfwSwapInterval(1);
  glfwSetWindowSizeLimits(window_, 800, 500, GLFW_DONT_CARE, GLFW_DONT_CARE);
  // A key that was pressed and let go between two pictures counts, too.
  glfwSetInputMode(window_, GLFW_STICKY_KEYS, GLFW_TRUE);
  ImGui::CreateContext();
  ImGui::GetIO().IniFilename = nullptr;
  ImGui::StyleColorsLight();
  float scale = 1, unused = 1;
  glfwGetWindowContentScale(window_, &scale, &unused);
  scale *= zoom;
  // White on pale grey is not seen without an edge.
  ImGui::GetStyle().FrameBorderSize = scale;
  ImGui::GetStyle().ScaleAllSizes(scale);
  load_font(scale);
  ImGui_ImplGlfw_InitForOpenGL(window_, true);
  ImGui_ImplOpenGL3_Init("#version 150");
}

Display::~Display() {
  ImGui_ImplOpenGL3_Shutdown();
  ImGui_ImplGlfw_Shutdown();
  ImGui::DestroyContext();
  glfwDestroyWindow(window_);
  glfwTerminate();
}

bool Display::begin_picture() {
  glfwPollEvents();
  if (glfwWindowShouldClose(window_)) return false;
  ImGui_ImplOpenGL3_NewFrame();
  ImGui_ImplGlfw_NewFrame();
  ImGui::NewFrame();
  return true;
}

bool Display::end_picture(bool at_once, const std::string& screenshot) {
  // Where the display does not wait for its next picture, as a virtual one, this does.
  static auto last = std::chrono::steady_clock::now();
  ImGui::Render();
  int width = 0, height = 0;
  glfwGetFramebufferSize(window_, &width, &height);
  glViewport(0, 0, width, height);
  glClearColor(0.93f, 0.93f, 0.92f, 1);
  glClear(GL_COLOR_BUFFER_BIT);
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  const bool written = screenshot.empty() || write_png(screenshot);
  glfwSwapBuffers(window_);
  if (!at_once) std::this_thread::sleep_until(last + std::chrono::milliseconds(16));
  last = std::chrono::steady_clock::now();
  return written;
}

bool Display::write_png(const std::string& path) const {
  int width = 0, height = 0;
  glfwGetFramebufferSize(window_, &width, &height);
  std::vector<unsigned char> pixels(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, pixels.data());
  stbi_flip_vertically_on_write(1);
  return stbi_write_png(path.c_str(), width, height, 3, pixels.data(), 3 * width) != 0;
}

void Display::resize(int width, int height) { glfwSetWindowSize(window_, width, height); }

bool Display::pressed(int key) const { return glfwGetKey(window_, key) == GLFW_PRESS; }

}  // namespace phantom
