// A window of GLFW with OpenGL 3 and Dear ImGui in it.
#pragma once

#include <memory>
#include <string>

struct GLFWwindow;

namespace phantom {

class Display {
 public:
  /// @param zoom  of window and text, beside what the system asks for
  /// @param why  out: where it is null, one line that says what is missing
  static std::unique_ptr<Display> open(double zoom, std::string& why);
  ~Display();
  Display(const Display&) = delete;
  Display& operator=(const Display&) = delete;

  bool begin_picture();  ///< false where the window is to be closed
  /// @param at_once     without waiting for the time of the next picture
  /// @param screenshot  file to write the picture to, or empty   @return whether that could be done
  bool end_picture(bool at_once, const std::string& screenshot);
  void resize(int width, int height);
  bool pressed(int key) const;  ///< GLFW's number

 private:
  Display(GLFWwindow* window, float zoom);
  bool write_png(const std::string& path) const;

  GLFWwindow* window_;
};

}  // namespace phantom
