// Lit solids of a scene in space, painted from the farthest to the nearest: a tube in short pieces, a ball, a block.
//
// Each is convex: its faces that look away are left out, and solids are sorted by their middles.  That is right where they do not
// pass through one another, and needs no buffer of depths.
#pragma once

#include <imgui.h>
#include <utility>
#include <vector>

#include "camera.hpp"

namespace phantom {

/// A cut across a tube.
struct Ring {
  Eigen::Vector3d middle, tangent, across;  ///< [m]; unit and perpendicular
  double radius;                            ///< [m]
};

class Solids {
 public:
  explicit Solids(const Camera& camera) : camera_(camera) {}

  /// A piece of a tube between two cuts.
  void tube(const Ring& a, const Ring& b, ImU32 colour);
  /// The flat end of a tube.  @param side  1: it looks along the tangent, -1: against it
  void cap(const Ring& end, double side, ImU32 colour);
  void ball(const Eigen::Vector3d& middle, double radius, ImU32 colour);
  /// @param half  [m] columns: from its middle to three of its faces
  void block(const Eigen::Vector3d& middle, const Eigen::Matrix3d& half, ImU32 colour);

  void paint(ImDrawList& list);

 private:
  struct Face {
    ImVec2 corners[4];
    ImU32 colour;
    unsigned edges;  // bit i: the edge from corner i to the next is drawn as an outline
  };
  struct Solid {
    double nearness;
    std::size_t first, end;  // faces, or a ball where there are none
    Eigen::Vector3d middle;
    double radius;
    ImU32 colour;
    ImVec2 from, to;  // of a piece of a tube: a line behind it is its outline
    float width;      // [pixel]
  };

  static constexpr int sides = 14;
  static std::pair<double, double> turn(int k);  // cosine and sine
  ImU32 lit(ImU32 colour, const Eigen::Vector3d& normal, const Eigen::Vector3d& at) const;
  void begin(const Eigen::Vector3d& middle) {
    solids_.push_back({camera_.nearness(middle), faces_.size(), faces_.size(), middle, 0, 0, {}, {}, 0});
  }
  void end() { solids_.back().end = faces_.size(); }
  void paint_ball(ImDrawList& list, const Solid& ball) const;

  const Camera& camera_;
  std::vector<Solid> solids_;
  std::vector<Face> faces_;
};

}  // namespace phantom
