// What is drawn of what the hand touches, and where in it a cursor leads the hand.
#pragma once

#include <imgui.h>
#include <memory>

#include "../body.hpp"
#include "../session.hpp"

namespace phantom {

/// What stays the same while one scene runs: how the beam rests, how it is looked at, the largest strain so far.
class Drawing {
 public:
  virtual ~Drawing() = default;

  /// @param target  [m] device axes: where the hand wants to be   @param unit  [pixel] height of a line of text
  virtual void draw(ImDrawList& list, const Session::Picture& picture, const Eigen::Vector3d& target,
                    const ImVec2& low, const ImVec2& high, float unit) = 0;
  /// What a cursor points at, in the device's axes [m].  After draw().
  /// @param target  in space as near as this to who looks   [m] device axes
  virtual Eigen::Vector3d device_position(const ImVec2& cursor, const Eigen::Vector3d& target) const = 0;
  /// The way of a hand in the device's axes.  @param way  [m] of the device, to the right, up, and toward who looks
  virtual Eigen::Vector3d device_way(const Eigen::Vector3d& way) const = 0;
  /// Takes what a mouse and its wheel do to the view.  @param hovered  it is over the drawing
  virtual void look(bool hovered) = 0;
  /// A row of the column on the right: how it is drawn.
  virtual void choose() = 0;
  /// How the hand is led.
  virtual const char* help() const {
    return "Press the mouse in the drawing and pull. Arrow keys move the hand, space lifts it.";
  }
  virtual const char* hint() const { return "hold the mouse button here and pull"; }
};

/// @param body  one that has not run
std::unique_ptr<Drawing> make_drawing(const Body& body, const hapbeam::DeviceInfo& device);

}  // namespace phantom
