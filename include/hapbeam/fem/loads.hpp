// SPDX-License-Identifier: MIT
// Dead loads as forces at fixed points of a beam or rod.
//
// A distributed load becomes the consistent nodal forces of the mesh (thesis eq. 3.31); point loads stay where they are.
//
// A distributed load also gives a node its first moment.  Forces stay dead while their arms, which lie along the beam, turn with it: in the plane
//
//   ∫f u + q w ds = Σ f u + q w + p (cos θ - 1) - q_arm sin θ         for one element and even loads p = ± f l²/12
//
// (Euler and Maclaurin's formula: an error of O(l⁵) an element.)  Moderate rotation has -p θ²/2 for the first and -q_arm θ for the second.
// Building the list is offline, and may allocate and throw; all else is noexcept and allocation-free.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include <hapbeam/beam.hpp>
#include <hapbeam/centreline.hpp>
#include <hapbeam/fem/mesh.hpp>

namespace hapbeam {

/// A dead force at a point of a beam or rod, and the moments of what it stands for.
template <typename Scalar, int D = 2>
struct PointForce {
  Scalar s;                   ///< [m]
  VectorOf<Scalar, D> force;  ///< [N] along u and w, or in space
  VectorOf<Scalar, D>
      arm;  ///< [N·m] its first moment about s: does work on the tangent, in the plane on (cos θ - 1, -sin θ)
  Scalar moment = 0;  ///< [N·m] in the plane: does work on θ
};

namespace detail {

/// Five-point Gauss rule on [0, 1]: exact to degree nine.
inline constexpr std::array<double, 5> gauss_points = {0.046910077030668003601, 0.23076534494715845448, 0.5,
                                                       0.76923465505284154552, 0.95308992296933199640};
inline constexpr std::array<double, 5> gauss_weights = {0.11846344252809454376, 0.23931433524968323402,
                                                        0.28444444444444444444, 0.23931433524968323402,
                                                        0.11846344252809454376};

/// EI/L² over the unit round-off of the model's scalar: beside a larger force no digit is left of what bends the beam.
template <typename Scalar>
class LargestLoad {
 public:
  /// @param bending  EI [N·m²]   @param length  L [m]
  LargestLoad(double bending, double length) noexcept
      : length_(length),
        force_(bending / (length * length) / static_cast<double>(std::numeric_limits<Scalar>::epsilon())) {}

  /// @throws std::invalid_argument unless it is finite and no larger   @return the value
  double force(const char* field, double value) const { return check(field, value, force_, "N"); }
  double moment(const char* field, double value) const {
    return check(field, value, force_ * length_, "N·m");
  }
  double distributed(const char* field, double value) const {
    return check(field, value, force_ / length_, "N/m");
  }

 private:
  static double check(const char* field, double value, double most, const char* unit) {
    if (std::abs(finite(field, value, unit)) <= most) return value;
    reject(field, value, unit,
           ("at most " + number(most) + " " + unit + " in size: beyond it the model's scalar holds no answer")
               .c_str());
  }

  double length_, force_;  // [m, N]
};

}  // namespace detail

/// The dead loads of a beam or rod, in order of s.
template <typename Scalar, int D = 2>
class DeadLoads {
  using Force = PointForce<Scalar, D>;
  using Vector = VectorOf<double, D>;

 public:
  /// @throws std::invalid_argument where a load is not finite, or larger than LargestLoad says
  DeadLoads(const Beam& beam, int elements) {
    const detail::LargestLoad<Scalar> largest(beam.bending_stiffness(), beam.length());
    const auto sample = [&](const DistributedLoad& load, const char* field, double s) {
      return load ? largest.distributed(field, load(s)) : 0;
    };
    if (beam.transverse() || beam.axial())
      spread(lay_mesh<Scalar>(beam, beam.point_loads(), elements), [&](double s) {
        return Vector(sample(beam.axial(), "axial load", s), sample(beam.transverse(), "transverse load", s));
      });
    for (const PointLoad& load : beam.point_loads())
      add(load.s,
          Vector(largest.force("point load axial", load.axial),
                 largest.force("point load transverse", load.transverse)),
          largest.moment("point load moment", load.moment));
  }
  /// @param body  Rod   @param bending  its smallest [N·m²]
  template <class Body>
  [[gnu::cold]] DeadLoads(const Body& body, int elements, double bending) {
    const detail::LargestLoad<Scalar> largest(bending, body.length());
    if (const auto load = body.load())
      spread(lay_mesh<Scalar>(body, body.forces(), elements), [&](double s) {
        const Vector f = load(s);
        for (int c = 0; c < D; ++c) (void)largest.distributed("load", f[c]);
        return f;
      });
    for (const auto& force : body.forces()) {
      for (int c = 0; c < D; ++c) (void)largest.force("force", force.force[c]);
      add(force.s, force.force, 0);
    }
  }

  bool empty() const noexcept { return forces_.empty(); }
  const std::vector<Force>& forces() const noexcept { return forces_; }

  /// Calls visit(load) for those from begin to end, the end itself where it is the last, in order of s.   O(log loads)
  template <class Visit>
  void visit(Scalar begin, Scalar end, bool last, Visit&& visit) const noexcept {
    auto load = std::partition_point(forces_.begin(), forces_.end(),
                                     [begin](const Force& force) { return force.s < begin; });
    for (; load != forces_.end() && (load->s < end || last); ++load) visit(*load);
  }
  /// Calls visit(q, start, length) with the mean of the distributed loads [N/m], and the cell of the mesh that they made nodal
  /// forces of: the last one that begins before a place.   @param before  whether a cell that begins at s does   O(log elements)
  template <class Before, class Visit>
  void visit_cell(Before&& before, Visit&& visit) const noexcept {
    if (cells_.empty()) return;
    auto cell = std::partition_point(cells_.begin(), cells_.end(),
                                     [&before](const Cell& each) { return before(each.start); });
    if (cell != cells_.begin()) --cell;
    visit(cell->load, cell->start, cell->length);
  }

 private:
  struct Cell {
    Scalar start, length;  // [m]
    VectorOf<Scalar, D> load;
  };
  /// Behind those at its place.
  void add(double s, const Vector& force, double moment) {
    const Scalar at = static_cast<Scalar>(s);
    std::size_t place = forces_.size();
    while (place > 0 && forces_[place - 1].s > at) --place;
    forces_.insert(
        forces_.begin() + static_cast<std::ptrdiff_t>(place),
        {at, force.template cast<Scalar>(), VectorOf<Scalar, D>::Zero(), static_cast<Scalar>(moment)});
  }
  /// @param load  (s) -> [N/m]
  template <class Load>
  void spread(const std::vector<Scalar>& mesh, Load&& load) {
    Vector force = Vector::Zero(), arm = Vector::Zero();  // of the left node
    const auto push = [&](Scalar node) {
      forces_.push_back({node, force.template cast<Scalar>(), arm.template cast<Scalar>()});
    };
    for (std::size_t e = 0; e + 1 < mesh.size(); ++e) {
      const double from = static_cast<double>(mesh[e]), h = static_cast<double>(mesh[e + 1]) - from;
      Vector next = Vector::Zero(), next_arm = Vector::Zero(), mean = Vector::Zero();
      for (std::size_t k = 0; k < detail::gauss_points.size(); ++k) {
        const double t = detail::gauss_points[k], u = 1 - t;
        const Vector f = detail::gauss_weights[k] * load(from + t * h);
        mean += f;
        for (int c = 0; c < D; ++c) {
          // A planar element has a linear u; -u'' h² t(1 - t)/2 is what that leaves out.
          const bool linear = D == 2 && c == 0;
          force[c] += h * f[c] * (linear ? u : u * u * (1 + 2 * t));
          next[c] += h * f[c] * (linear ? t : t * t * (3 - 2 * t));
          arm[c] += h * h * f[c] * (linear ? t * u / 2 : t * u * u);
          next_arm[c] -= h * h * f[c] * (linear ? t * u / 2 : t * t * u);
        }
      }
      push(mesh[e]);
      force = next, arm = next_arm;
      cells_.push_back({mesh[e], mesh[e + 1] - mesh[e], mean.template cast<Scalar>()});
    }
    push(mesh.back());
  }

  std::vector<Force> forces_;  // in order of s
  std::vector<Cell> cells_;    // of the mesh, where there are distributed loads
};

}  // namespace hapbeam
