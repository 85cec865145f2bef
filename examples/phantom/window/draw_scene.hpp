// The beam, its supports, what the hand does and what it feels, as a drawing with a scale.
#pragma once

#include <imgui.h>
#include <string>
#include <vector>

#include "../hand.hpp"
#include "../options.hpp"
#include "../session.hpp"
#include "view.hpp"
#include <hapbeam/haptics/servo/placement.hpp>

namespace phantom {

/// What stays the same while one session runs: how the beam rests, and what is drawn of the largest strain.
class SceneDrawing {
 public:
  /// @param rest  of a session that has not run
  SceneDrawing(const Options& options, const hapbeam::DeviceInfo& device,
               const hapbeam::Centreline<double>& rest);

  /// @param target  [m] device axes: where the hand wants to be   @param unit  [pixel] height of a line of text
  void draw(ImDrawList& list, const Session::Picture& picture, const Point& target, const ImVec2& low,
            const ImVec2& high, float unit);

  /// What a cursor points at, in the device's axes.  After draw().
  Point device_position(const ImVec2& cursor) const;
  bool contains(const ImVec2& cursor) const { return view_.contains(cursor); }

  double exaggeration;  ///< of displacements, to be changed as one likes

 private:
  struct Sample {
    double s, x, w, theta, rest_x, rest_w;
  };

  void fit(const ImVec2& low, const ImVec2& high);
  void sample(const DrawnBeam& beam);
  void draw_axis(ImDrawList& list, double above, float unit) const;
  void draw_workspace(ImDrawList& list, float unit) const;
  double drawn_half(float unit) const;           ///< [m] of the thickness, which can be seen
  void draw_beam(ImDrawList& list, float unit);  ///< with its supports
  void draw_hand(ImDrawList& list, const hapbeam::ServoRecord& record, const Point& target, float unit);
  void draw_legend(ImDrawList& list, float unit) const;

  Options options_;
  hapbeam::Placement placement_;
  Point workspace_;  // [m] scene, half of it
  View view_;
  Across across_{};
  double side_ = 1;
  double largest_strain_;
  double above_ = 0;  // [m] of the axis of the beam that is sampled
  std::vector<Sample> samples_;
  std::vector<double> rest_theta_;
};

/// The exaggeration that shows a scene best.
double default_exaggeration(const Options& options);

}  // namespace phantom
