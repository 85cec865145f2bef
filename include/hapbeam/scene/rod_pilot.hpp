// Pushes by which candidates for a rod are judged: lines of increasing depth, at five places and to several sides.
//
// As pilot.hpp has it in the plane.  The reference is TwistedRod, or RoundRod where nobody holds the twist, with as many elements as
// it takes until half of them give the same force to a twentieth of the tolerated error, or with 256.  A rod that rests straight is
// pushed along three directions across it, from a hundredth of the depth on; another along six, from a thousandth on.
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
    const Range<double> range = RodRange<double>(scene.rod).range();
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
    place(scene, FemModel<Element>(scene.rod, 64).shape());
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

  void place(const RodScene& scene, const Centreline<double, 3>& rest) {
    const bool straight = scene.rod.straight();
    // Uneven, lest they meet what is symmetric.
    for (const double along : {0.0, 0.23, 0.52, 0.78, 1.0}) {
      if (scene.one_place() && along > 0) break;
      const double s = scene.s_min + (scene.s_max - scene.s_min) * along;
      const Vector3 d3 = detail::unit(rest.at(s).tangent),
                    d1 = detail::across(rest[rest.segment_at(s)].director, d3),
                    d2 = detail::cross3<double>(d3, d1);
      const int sides = straight ? 3 : 6, steps = straight ? 8 : 12;
      for (int side = 0; side < sides; ++side) {
        const double angle = 0.04 + side * (straight ? 0.75 : 1.05);
        const double cosine = std::cos(angle), sine = std::sin(angle);
        const Vector3 normal = cosine * d1 + sine * d2;
        const double home = normal.dot(rest.at(s).r);
        Line line{s, normal, home, {}, {}};
        for (int k = steps; k >= 0; --k)
          line.depths.push_back(home + scene.depth_at(s, cosine, sine) * std::pow(10.0, -k / 4.0));
        lines_.push_back(line);
      }
    }
  }

  double floor_;
  std::vector<Line> lines_;
  int elements_ = 0;
  double own_error_ = 0;
};

}  // namespace hapbeam
