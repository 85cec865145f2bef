// A small diagram: frame, rounded axes with figures, lines.  Everything in pixels is in units of the text's height.
#pragma once

#include <functional>
#include <imgui.h>
#include <string>
#include <vector>

namespace phantom {

class Plot {
 public:
  struct Axis {
    double from, to;
    std::string unit;    ///< beside the last figure
    double factor = 1;   ///< of what is written to what is given
    bool times = false;  ///< given as the decimal logarithm of microseconds
  };

  struct Key {
    const char* text;
    ImU32 colour;  ///< of the dash before it
  };

  /// Draws the frame, and the keys between title and axes.  @param low, high  [pixel] of all of it, title included
  Plot(ImDrawList& list, const char* title, const ImVec2& low, const ImVec2& high, const Axis& x,
       const Axis& y, const std::vector<Key>& keys = {});
  ~Plot() { list_.PopClipRect(); }
  Plot(const Plot&) = delete;
  Plot& operator=(const Plot&) = delete;

  /// @param count  of points   @param x, y  of the i-th
  void line(std::size_t count, const std::function<double(std::size_t)>& x,
            const std::function<double(std::size_t)>& y, ImU32 colour, float width);
  /// From the lower edge.
  void bar(double from, double to, double height, ImU32 colour);
  void point(double x, double y, ImU32 colour);
  void upright(double x, ImU32 colour, const char* text);
  float pixel_x(double x) const;
  float pixel_y(double y) const;

 private:
  void frame();
  float draw_keys(const std::vector<Key>& keys, const ImVec2& low, float right);  ///< [pixel] where they end

  ImDrawList& list_;
  ImVec2 low_, high_;  // [pixel] of what is inside the axes
  Axis x_, y_;
  float unit_;
};

/// A figure to end an axis with: the next of 1, 1.5, 2, 3, 5, 10, … that is not less.
double rounded_end(double x);

}  // namespace phantom
