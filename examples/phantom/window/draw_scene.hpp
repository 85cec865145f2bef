// A beam in its plane: its supports, what the hand does and what it feels, as a drawing with a scale.
#pragma once

#include <deque>
#include <imgui.h>
#include <string>
#include <vector>

#include "../options.hpp"
#include "drawing.hpp"
#include "view.hpp"

namespace phantom {

class SceneDrawing final : public Drawing {
 public:
  /// @param body  of a beam, one that has not run
  SceneDrawing(const Body& body, const hapbeam::DeviceInfo& device);

  void draw(ImDrawList& list, const Session::Picture& picture, const Eigen::Vector3d& target,
            const ImVec2& low, const ImVec2& high, float unit) override;
  Eigen::Vector3d device_position(const ImVec2& cursor, const Eigen::Vector3d& target) const override;
  Eigen::Vector3d device_way(const Eigen::Vector3d& way) const override { return {way.x(), way.y(), 0}; }
  void look(bool) override {}
  void choose() override;

 private:
  struct Sample {
    double s, x, w, theta, rest_x, rest_w;
  };

  static constexpr int strobed = 16;  // pictures

  void fit(const ImVec2& low, const ImVec2& high);
  double rest_height(double x) const;  ///< [m] of the centreline; beside it, where the nearer end is
  void sample(const DrawnBeam& beam);
  void draw_axis(ImDrawList& list, double above, float unit) const;
  void draw_workspace(ImDrawList& list, float unit) const;
  double drawn_half(float unit) const;                      ///< [m] of the thickness, which can be seen
  Point seen(const Sample& sample) const;                   ///< [m] where it is drawn
  void draw_strobe(ImDrawList& list, float unit);           ///< where what swings was in the last pictures
  void draw_beam(ImDrawList& list, float unit);             ///< with its supports
  Across across(const hapbeam::ServoRecord& record) const;  ///< of the hand that it is of
  void draw_hand(ImDrawList& list, const hapbeam::ServoRecord& record, const Eigen::Vector3d& target,
                 float unit) const;
  /// The second hand, in its own colour, without the cross that the mouse moves.
  void draw_second(ImDrawList& list, const hapbeam::ServoRecord& record, float unit) const;
  void draw_avatar(ImDrawList& list, const hapbeam::ServoRecord& record, const Across& across, ImU32 colour,
                   float unit) const;
  void draw_legend(ImDrawList& list, float unit) const;

  double exaggeration_;  // of displacements
  Options options_;
  hapbeam::Placement placement_;
  Point workspace_;  // [m] scene, half of it
  View view_;
  Across across_{};
  double largest_strain_;
  double above_ = 0;  // [m] of the axis of the beam that is sampled
  std::vector<Sample> samples_;
  std::vector<double> rest_theta_;
  std::deque<std::vector<Point>> strobe_;  // oldest first
};

}  // namespace phantom
