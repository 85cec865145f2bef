// A rod in space: lit, over a floor with its shadows, seen through a camera that turns about it.
//
// Depth is to be judged by three things: the shadow of rod and avatar on the floor straight below them, the line from the avatar
// down to its shadow, and the distance of avatar and rod in figures.  All lengths are true to scale.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "../scene.hpp"
#include "drawing.hpp"
#include "rod_line.hpp"
#include "solids.hpp"
#include "strokes.hpp"

namespace phantom {

class SpaceDrawing final : public Drawing {
 public:
  /// @param body  of a rod, one that has not run
  SpaceDrawing(const Body& body, const hapbeam::DeviceInfo& device);

  void draw(ImDrawList& list, const Session::Picture& picture, const Eigen::Vector3d& target,
            const ImVec2& low, const ImVec2& high, float unit) override;
  Eigen::Vector3d device_position(const ImVec2& cursor, const Eigen::Vector3d& target) const override;
  Eigen::Vector3d device_way(const Eigen::Vector3d& way) const override;
  void look(bool hovered) override;
  void choose() override;
  const char* help() const override;
  const char* hint() const override;

 private:
  using Vector = Eigen::Vector3d;
  void aim(const ImVec2& low, const ImVec2& high);
  void draw_floor(ImDrawList& list, float unit) const;
  void draw_shadow(ImDrawList& list, const RodLine& rod, float unit) const;
  void draw_shadow(ImDrawList& list, const Vector& avatar, float unit) const;
  void draw_rod(Solids& solids, const RodLine& rod) const;
  void draw_ends(Solids& solids) const;
  void draw_hanging(ImDrawList& list, float unit) const;
  void draw_hand(ImDrawList& list, const hapbeam::ServoRecord& record, const Vector& target,
                 float unit) const;
  void draw_arm(ImDrawList& list, const hapbeam::ServoRecord& record, float unit) const;  ///< and its force
  /// Where words at a place are farthest from the rod.   @param beside  [pixel] that they keep from the place
  ImVec2 clear_of_rod(const ImVec2& at, float beside, const std::string& words, float unit) const;
  void draw_legend(ImDrawList& list, const ImVec2& low, const ImVec2& high, float unit) const;
  Vector on_floor(const Vector& p) const { return {p.x(), floor_, p.z()}; }

  Options options_;
  RodLine line_;
  std::optional<RodLine> needle_;  // that the hand holds
  std::vector<hapbeam::RigidBody> vessel_;
  double ball_;  // [m] radius of the avatar, or of what holds the needle
  hapbeam::Placement placement_;
  Vector workspace_;             // [m] scene, half of it
  Vector low_, high_;            // [m] of what is looked at
  double floor_ = 0, size_ = 1;  // [m]
  double square_;                // [m] on the floor
  double largest_strain_ = least_strain;
  bool orbits_ = false;
  Camera camera_;
};

}  // namespace phantom
