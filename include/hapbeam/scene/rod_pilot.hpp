// SPDX-License-Identifier: MIT
// Pushes by which candidates for a rod are judged: lines of increasing depth, at five places and to several sides.
//
// As pilot.hpp has it in the plane.  The reference is TwistedRod, or RoundRod where nobody holds the twist, with as many elements as
// it takes until half of them give the same force to a twentieth of the tolerated error, or with 256.  A rod that rests straight is
// pushed along three directions across it, from a hundredth of the depth on; another along eight, from a thousandth on.
// A bent rod gives way to one side many times as much as to another, and the relative error of its force peaks near the stiffest
// side, in a range of angles that is the narrower the more the stiffnesses differ.  With C the compliance across the rod,
//
//   F = d/(nᵀC n),   n ~ C^(-½) m:   δF/F = -mᵀ C^(-½) δC C^(-½) m        for unit m
//
// is a plain quadratic form of m.  So m is spread evenly, and n follows: directions are close where the rod is stiff.  Of a form
// with one sign, four of them and their opposites meet 0.85 of the largest value at least, which is the margin of choose().
// Offline: allocates, throws std::invalid_argument where the scene asks for pushes that no model answers.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <hapbeam/scene/rod_model.hpp>
#include <hapbeam/scene/rod_scene.hpp>

namespace hapbeam {

class RodPilot {
  using Vector3 = VectorOf<double, 3>;

 public:
  explicit RodPilot(const RodScene& scene) : floor_(scene.check().force_floor) {
    const double length = scene.rod.length();
    const Range<double> range = PressRange<double>(scene.rod).range();
    const double left = range.s_min > 0 ? scene.s_min : length,
                 right = range.s_max < length ? length - scene.s_max : length;
    if (holds_twist(scene.rod.left()) || holds_twist(scene.rod.right()))
      search<TwistedRod>(scene, (std::min)(left, right));
    else search<RoundRod>(scene, (std::min)(left, right));
  }

  /// Largest relative error of the force; infinite where a push is not answered with ok.
  template <class Model>
  double error(Model& model) const {
    double most = 0;
    for (const Line& line : lines_) {
      model.reset();
      for (std::size_t k = 0; k < line.depths.size(); ++k) {
        const Response<double> response = go(model, line, k);
        if (response.status != Status::ok) return std::numeric_limits<double>::infinity();
        most = (std::max)(most, std::abs(response.force - line.forces[k]) /
                                    (std::max)((std::max)(std::abs(line.forces[k]), floor_),
                                               (std::numeric_limits<double>::min)()));
      }
    }
    return most;
  }

  int elements() const noexcept { return elements_; }       ///< of the reference
  double own_error() const noexcept { return own_error_; }  ///< of half as many elements

 private:
  struct Line {
    double s;
    Vector3 normal;
    double home;                 // n · r at rest [m]
    std::vector<double> depths;  // n · r [m], from rest outward
    std::vector<double> forces;  // [N] of the reference
  };

  /// On to the next depth, as a hand goes.
  template <class Model>
  static Response<double> go(Model& model, const Line& line, std::size_t k) {
    const double from = k > 0 ? line.depths[k - 1] : line.home, to = line.depths[k];
    for (const double share : {0.25, 0.5, 0.75})
      (void)model.push({line.s, from + share * (to - from), line.normal});
    return model.push({line.s, to, line.normal});
  }

  /// @param beside  [m] from the nearest push to a support
  template <class Element>
  void search(const RodScene& scene, double beside) {
    FemModel<Element> resting(scene.rod, 64);
    place(scene, resting);
    // Four elements at least between a support and the nearest push, or half as many would be no other mesh there.
    for (elements_ = 32; elements_ < 256 && elements_ * beside < 4 * scene.rod.length();) elements_ *= 2;
    for (;; elements_ *= 2) {
      FemModel<Element> coarse(scene.rod, elements_ / 2), reference(scene.rod, elements_);
      answer(reference, scene.depth);
      const double apart = error(coarse);
      own_error_ = apart / 3;
      if (apart <= scene.force_error / 20 || elements_ >= 256) return;
    }
  }

  /// Keeps the answers of a reference with the lines.
  template <class Reference>
  void answer(Reference& reference, double depth) {
    for (Line& line : lines_) {
      line.forces.clear();
      reference.reset();
      for (std::size_t k = 0; k < line.depths.size(); ++k) {
        const Response<double> response = go(reference, line, k);
        if (response.status != Status::ok)
          throw std::invalid_argument("depth = " + detail::number(depth) +
                                      " m: must be one that a rod answers everywhere; at s = " +
                                      detail::number(line.s) + " m a push is " + name(response.status));
        line.forces.push_back(response.force);
      }
    }
  }

  template <class Model>
  void place(const RodScene& scene, Model& model) {
    const bool straight = scene.rod.straight();
    // Uneven, lest they meet what is symmetric.
    for (const double along : {0.0, 0.23, 0.52, 0.78, 1.0}) {
      if (scene.one_place() && along > 0) break;
      const double s = scene.s_min + (scene.s_max - scene.s_min) * along;
      model.reset();
      const Centreline<double, 3> rest = model.shape();
      const Vector3 r = rest.at(s).r, d3 = detail::unit(rest.at(s).tangent),
                    d1 = detail::across(rest[rest.segment_at(s)].director, d3),
                    d2 = detail::cross3<double>(d3, d1);
      const auto toward = [&](double cosine, double sine, int steps) {
        const Vector3 normal = cosine * d1 + sine * d2;
        const double home = normal.dot(r);
        Line line{s, normal, home, {}, {}};
        for (int k = steps; k >= 0; --k)
          line.depths.push_back(home + scene.depth_at(s, cosine, sine) * std::pow(10.0, -k / 4.0));
        return line;
      };
      if (straight) {
        for (const double angle : {0.04, 0.79, 1.54})
          lines_.push_back(toward(std::cos(angle), std::sin(angle), 8));
        continue;
      }
      const Compliance c = compliance([&](double cosine, double sine) {
        Line shallow = toward(cosine, sine, 8);
        shallow.depths.resize(1);
        model.reset();
        return (shallow.depths[0] - shallow.home) / go(model, shallow, 0).force;
      });
      for (int side = 0; side < 8; ++side) {
        const double angle = 0.04 + side * 0.785, m1 = std::cos(angle), m2 = std::sin(angle);
        const double n1 = (c.c22 + c.root) * m1 - c.c12 * m2, n2 = (c.c11 + c.root) * m2 - c.c12 * m1,
                     size = std::hypot(n1, n2);
        lines_.push_back(toward(n1 / size, n2 / size, 12));
      }
    }
  }

  /// C across the rod, in the axes d1 and d2.
  struct Compliance {
    double c11 = 1, c12 = 0, c22 = 1;  // [m/N]
    double root = 1;                   // of its determinant
  };
  /// @param along  (cosine, sine) -> nᵀC n, where small pushes are answered   @return the same to all sides where they are not
  template <class Along>
  static Compliance compliance(Along&& along) {
    const double half = 0.5, root3 = std::sqrt(3.0);
    const double c0 = along(1, 0), c1 = along(half, root3 / 2), c2 = along(-half, root3 / 2);
    const double c22 = (2 * (c1 + c2) - c0) / 3, c12 = (c1 - c2) / root3, determinant = c0 * c22 - c12 * c12;
    if (!(c0 > 0 && determinant > 0 && std::isfinite(determinant))) return {};
    return {c0, c12, c22, std::sqrt(determinant)};
  }

  double floor_;
  std::vector<Line> lines_;
  int elements_ = 0;
  double own_error_ = 0;
};

}  // namespace hapbeam
