#include "solids.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "colours.hpp"

namespace phantom {

namespace {

using Vector = Eigen::Vector3d;

Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Each channel but the last.
template <typename Change>
ImU32 changed(ImU32 colour, const Change& change) {
  ImU32 result = colour & IM_COL32_A_MASK;
  for (const int shift : {IM_COL32_R_SHIFT, IM_COL32_G_SHIFT, IM_COL32_B_SHIFT}) {
    const double value = change(static_cast<double>((colour >> shift) & 0xff));
    result |= static_cast<ImU32>(std::clamp(value, 0.0, 255.0)) << shift;
  }
  return result;
}

}  // namespace

std::pair<double, double> Solids::turn(int k) {
  const double angle = 2 * 3.141592653589793 * k / sides;
  return {std::cos(angle), std::sin(angle)};
}

/// A lamp over the left shoulder of who looks: what is matt and a little that shines (Blinn and Phong).
ImU32 Solids::lit(ImU32 colour, const Vector& normal, const Vector& at) const {
  const Vector lamp = (-0.45 * camera_.right() + 0.75 * camera_.up() + 0.5 * camera_.toward()).normalized();
  const double matt = std::max(0.0, normal.dot(lamp)),
               shine = std::pow(std::max(0.0, normal.dot((lamp + camera_.sight(at)).normalized())), 24);
  return changed(colour,
                 [&](double c) { return c * (0.5 + 0.6 * matt) + 0.45 * shine * (255 - c) + 14 * matt; });
}

void Solids::tube(const Ring& a, const Ring& b, ImU32 colour) {
  const Vector middle = (a.middle + b.middle) / 2, sight = camera_.sight(middle);
  const Vector ups[] = {a.across, b.across},
               sides_of[] = {cross(a.tangent, a.across), cross(b.tangent, b.across)};
  const auto normal = [&](int end, double k_cos, double k_sin) {
    return Vector(k_cos * ups[end] + k_sin * sides_of[end]);
  };
  const auto looks = [&](int k) {
    const double angle = 2 * 3.141592653589793 * (k + 0.5) / sides;
    return (normal(0, std::cos(angle), std::sin(angle)) + normal(1, std::cos(angle), std::sin(angle)))
               .dot(sight) > 0;
  };
  begin(middle);
  Solid& piece = solids_.back();
  piece.from = camera_(a.middle), piece.to = camera_(b.middle);
  piece.width = static_cast<float>((a.radius + b.radius) * camera_.pixels(middle)) + ImGui::GetFontSize() / 7;
  for (int k = 0; k < sides; ++k) {
    if (!looks(k)) continue;
    const auto [c0, s0] = turn(k);
    const auto [c1, s1] = turn(k + 1);
    const Vector n0 = normal(0, c0, s0), n1 = normal(0, c1, s1), m0 = normal(1, c0, s0),
                 m1 = normal(1, c1, s1);
    faces_.push_back({{camera_(a.middle + a.radius * n0), camera_(a.middle + a.radius * n1),
                       camera_(b.middle + b.radius * m1), camera_(b.middle + b.radius * m0)},
                      lit(colour, (n0 + n1 + m0 + m1).normalized(), middle),
                      0});
  }
  end();
}

void Solids::cap(const Ring& ring, double side, ImU32 colour) {
  const Vector normal = side * ring.tangent, beside = cross(ring.tangent, ring.across);
  if (normal.dot(camera_.sight(ring.middle)) <= 0) return;
  begin(ring.middle + 0.01 * ring.radius * normal);
  const ImU32 shade = lit(colour, normal, ring.middle);
  const auto rim = [&](int k) {
    const auto [c, s] = turn(k);
    return camera_(ring.middle + ring.radius * (c * ring.across + s * beside));
  };
  for (int k = 0; k < sides; ++k)
    faces_.push_back({{camera_(ring.middle), rim(k), rim(k + 1), rim(k + 1)}, shade, 2u});
  end();
}

void Solids::ball(const Vector& middle, double radius, ImU32 colour) {
  begin(middle);
  solids_.back().radius = radius, solids_.back().colour = colour;
}

void Solids::block(const Vector& middle, const Eigen::Matrix3d& half, ImU32 colour) {
  begin(middle);
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) {
      const Vector out = side * half.col(axis), u = half.col((axis + 1) % 3), v = half.col((axis + 2) % 3);
      const Vector face = middle + out;
      if (out.dot(camera_.sight(face)) <= 0) continue;
      faces_.push_back(
          {{camera_(face - u - v), camera_(face + u - v), camera_(face + u + v), camera_(face - u + v)},
           lit(colour, out.normalized(), face),
           15u});
    }
  end();
}

/// Brightest where it looks at the lamp.
void Solids::paint_ball(ImDrawList& list, const Solid& ball) const {
  constexpr int rim = 48;
  const ImVec2 middle = camera_(ball.middle),
               white = ImGui::GetDrawListSharedData() ? ImGui::GetFontTexUvWhitePixel() : ImVec2{};
  const auto radius = static_cast<float>(ball.radius * camera_.pixels(ball.middle));
  const ImU32 bright = changed(ball.colour, [](double c) { return c + 0.55 * (255 - c); }),
              dark = changed(ball.colour, [](double c) { return 0.72 * c; });
  list.PrimReserve(3 * rim, rim + 1);
  const auto first = static_cast<unsigned>(list._VtxCurrentIdx);
  list.PrimWriteVtx({middle.x - 0.35f * radius, middle.y - 0.4f * radius}, white, bright);
  for (int k = 0; k < rim; ++k) {
    const float angle = 2 * 3.14159265f * static_cast<float>(k) / rim;
    list.PrimWriteVtx({middle.x + radius * std::cos(angle), middle.y + radius * std::sin(angle)}, white,
                      dark);
  }
  for (unsigned k = 0; k < rim; ++k)
    for (const unsigned i : {0u, 1 + k, 1 + (k + 1) % rim})
      list.PrimWriteIdx(static_cast<ImDrawIdx>(first + i));
  list.AddCircle(middle, radius, colour::ink, 0, ImGui::GetFontSize() / 9);
}

void Solids::paint(ImDrawList& list) {
  std::sort(solids_.begin(), solids_.end(),
            [](const Solid& a, const Solid& b) { return a.nearness < b.nearness; });
  const float thin = ImGui::GetFontSize() / 14;
  for (const Solid& solid : solids_) {
    if (solid.radius > 0) paint_ball(list, solid);
    if (solid.width > 0) list.AddLine(solid.from, solid.to, colour::ink, solid.width);
    // Without anti-aliasing, whose seams would show; the outline smooths the edge.
    const ImDrawListFlags flags = list.Flags;
    list.Flags &= ~ImDrawListFlags_AntiAliasedFill;
    for (std::size_t i = solid.first; i < solid.end; ++i)
      list.AddConvexPolyFilled(faces_[i].corners, 4, faces_[i].colour);
    list.Flags = flags;
    for (std::size_t i = solid.first; i < solid.end; ++i)
      for (unsigned k = 0; k < 4; ++k)
        if (faces_[i].edges & (1u << k))
          list.AddLine(faces_[i].corners[k], faces_[i].corners[(k + 1) % 4], colour::ink, thin);
  }
}

}  // namespace phantom
