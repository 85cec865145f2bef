// SPDX-License-Identifier: MIT
// Stiffness of a rod whose section changes along it.
//
// An element within one part takes the stiffnesses at its Gauss points.  One in which a part ends takes at each point the mean
// compliance of the stretch of the element that the point stands for, which is what a step does to a bending moment; EA is of the
// mean compliance everywhere, because the tension is what is even.
// Allocates and throws at construction; all else is noexcept and allocation-free, O(parts).
// Between the knots of its table a part is a cubic: what it leaves falls with the fourth power of a 64th of the part.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <hapbeam/element/rod/rod_properties.hpp>
#include <hapbeam/rod.hpp>

namespace hapbeam {

template <typename Scalar>
class RodProfile {
 public:
  /// @throws std::invalid_argument where a section of the rod makes no sense
  [[gnu::cold]] explicit RodProfile(const Rod& rod) {
    double from = 0;
    if (rod.parts().empty()) add(0, rod.length(), [&rod](double) { return rod.stiffness(); });
    for (const RodPart& part : rod.parts()) {
      add(from, part.end, [&](double s) { return rod.stiffness(part, s); });
      from = part.end;
    }
    constant_ = rod.parts().empty();
  }

  /// Whether all of the rod has one section.
  bool constant() const noexcept { return constant_; }
  /// Whether it changes without a step.
  bool smooth() const noexcept { return parts_.size() == 1; }
  /// Whether it bends the same about both axes everywhere.
  bool round() const noexcept { return round_; }

  /// Stiffness of the section at s [m].
  RodStiffness at(Scalar s) const noexcept {
    const double x = s;
    const Values k = parts_[detail::part_with(parts_, x)].at(x);
    return {k[0], k[1], k[2], k[3]};
  }

  /// Gives an element its stiffnesses.   @param from,to  arc positions of its ends [m]
  void apply(Scalar from, Scalar to, RodProperties<Scalar>& p) const noexcept {
    const detail::GaussRule& rule = detail::gauss_rule(p.number);
    const double a = from, l = to - a;
    const std::size_t first = detail::part_with(parts_, a),
                      last = detail::part_with(parts_, a + l * (1 - 1e-12));
    double begin = a, stretching = 0, twisting = 0;  // compliances
    p.soft[0] = p.soft[1] = 0;
    for (int g = 0; g < p.number; ++g) {
      const double end = begin + rule.weight[g] * l;
      const Values k = first == last ? parts_[first].at(a + rule.x[g] * l) : mean(first, last, begin, end);
      stretching += rule.weight[g] / k[0], twisting += rule.weight[g] / k[3];
      p.points[g].bending1 = static_cast<Scalar>(k[1]);
      p.points[g].bending2 = static_cast<Scalar>(k[2]);
      p.points[g].torsion = static_cast<Scalar>(k[3]);
      // Against a turn about one axis of the section it moves along the other.
      p.soft[0] += static_cast<Scalar>(rule.weight[g]) / p.points[g].bending2;
      p.soft[1] += static_cast<Scalar>(rule.weight[g]) / p.points[g].bending1;
      begin = end;
    }
    p.axial = static_cast<Scalar>(1 / stretching);
    p.torsion = static_cast<Scalar>(1 / twisting);
  }

 private:
  static constexpr std::size_t cells = 64;
  using Values = std::array<double, 4>;  // EA, EI1, EI2, GJ

  struct Part {
    double from, end;
    std::array<Values, cells + 1> knots;

    /// Cubic through the four knots beside s; parabolas where a part ends.
    Values at(double s) const noexcept {
      const double x = std::clamp((s - from) / (end - from), 0.0, 1.0) * cells;
      const std::size_t k = (std::min)(static_cast<std::size_t>(x), cells - 1);
      const double t = x - static_cast<double>(k), u = 1 - t;
      Values value;
      for (std::size_t q = 0; q < value.size(); ++q) {
        const double b = knots[k][q], c = knots[k + 1][q], rise = c - b,
                     before = k > 0 ? (c - knots[k - 1][q]) / 2 : 0,
                     after = k + 2 <= cells ? (knots[k + 2][q] - b) / 2 : 0,
                     left = k > 0 ? before : 2 * rise - after,
                     right = k + 2 <= cells ? after : 2 * rise - before;
        value[q] = b + t * rise + t * u * (u * (left - rise) - t * (right - rise));
      }
      return value;
    }
  };

  template <class StiffnessAt>
  [[gnu::cold]] void add(double from, double end, StiffnessAt&& stiffness_at) {
    Part part{from, end, {}};
    for (std::size_t k = 0; k <= cells; ++k) {
      // Just within the part: where it ends its function may already be that of the next.
      const double x = std::clamp(static_cast<double>(k) / cells, 1e-12, 1 - 1e-12);
      const RodStiffness at = stiffness_at(from + x * (end - from));
      part.knots[k] = {at.axial, at.bending1, at.bending2, at.torsion};
      round_ = round_ && std::abs(at.bending1 - at.bending2) <= 1e-12 * at.bending1;
    }
    parts_.push_back(part);
  }

  /// Of the mean compliance between two places.
  Values mean(std::size_t first, std::size_t last, double begin, double end) const noexcept {
    Values compliance{};
    for (std::size_t k = first; k <= last; ++k) {
      const double a = (std::max)(begin, parts_[k].from), b = (std::min)(end, parts_[k].end);
      if (!(b > a)) continue;
      const Values value = parts_[k].at((a + b) / 2);
      for (std::size_t q = 0; q < value.size(); ++q) compliance[q] += (b - a) / ((end - begin) * value[q]);
    }
    for (double& c : compliance) c = 1 / c;
    return compliance;
  }

  std::vector<Part> parts_;
  bool constant_ = true, round_ = true;
};

}  // namespace hapbeam
