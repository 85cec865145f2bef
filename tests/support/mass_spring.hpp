// The method people reach for: a chain of masses, springs and dampers, stepped explicitly (thesis eq. 2.3–2.5).
//
//   m xi'' = -c xi' + Σ g + f      v += Δt/m (…), x += Δt v   (symplectic Euler: of explicit steps the most forgiving)
//
// Masses move in the plane.  Neighbours are joined by springs EA/l; across, the middle one of three is drawn onto the line
// of the others by EI/l³ times (1, -2, 1), the difference quotient of bending.  Both ends are hinged.
// A step is stable while Δt ω < 2, and the fastest ω of the chain is 2√(k/m) of its springs, or 4√(EI/ml³) of bending.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include <hapbeam/beam.hpp>
#include <hapbeam/centreline.hpp>

namespace hapbeam::testing {

class MassSpringChain {
 public:
  /// @param pieces  between the masses, two or more   @param mass [kg] of the whole beam   @param damping c [N·s/m] of a mass
  MassSpringChain(const Beam& beam, int pieces, double mass, double damping)
      : l_(beam.length() / pieces),
        k_(beam.axial_stiffness() / l_),
        b_(beam.bending_stiffness() / (l_ * l_ * l_)),
        m_(mass / pieces),
        c_(damping),
        x_(static_cast<std::size_t>(pieces) + 1),
        v_(x_.size(), Vector2<double>::Zero()),
        f_(v_) {
    for (std::size_t i = 0; i < x_.size(); ++i) x_[i] = {l_ * static_cast<double>(i), 0};
  }

  double mass() const { return m_; }     ///< μ of one [kg]
  double spring() const { return k_; }   ///< K between two [N/m]
  double bending() const { return b_; }  ///< EI/l³ [N/m]
  std::size_t middle() const { return x_.size() / 2; }
  Vector2<double>& position(std::size_t i) { return x_[i]; }

  /// Eq. 2.2: K_c = μ/(π Δt)², turned about: the step for which this chain's spring is just allowed [s].
  double critical_step() const { return std::sqrt(m_ / k_) / 3.141592653589793; }
  /// The largest step that is stable without damping: 2/ω of the stiffer of both kinds [s].
  double largest_step() const { return std::sqrt(m_ / std::max(k_, 4 * b_)); }

  /// One step in which mass `held` is led to w.   @return force that holds it there [N]
  double step(double dt, std::size_t held, double w) {
    const std::size_t n = x_.size();
    for (std::size_t i = 0; i < n; ++i) f_[i] = -c_ * v_[i];
    for (std::size_t i = 0; i + 1 < n; ++i) {
      const Vector2<double> d = x_[i + 1] - x_[i];
      const double length = d.norm();
      const Vector2<double> pull = d * (k_ * (length - l_) / length);
      f_[i] += pull;
      f_[i + 1] -= pull;
    }
    for (std::size_t i = 1; i + 1 < n; ++i) {
      const double bend = b_ * (x_[i - 1].y() - 2 * x_[i].y() + x_[i + 1].y());
      f_[i - 1].y() -= bend;
      f_[i].y() += 2 * bend;
      f_[i + 1].y() -= bend;
    }
    const double force = -f_[held].y();
    for (std::size_t i = 1; i + 1 < n; ++i) {
      v_[i] += dt / m_ * f_[i];
      if (i == held) v_[i].y() = 0;
      x_[i] += dt * v_[i];
    }
    x_[held].y() = w;
    return force;
  }
  /// ½ m v² of all [J]
  double kinetic_energy() const {
    double sum = 0;
    for (const auto& v : v_) sum += v.squaredNorm();
    return m_ / 2 * sum;
  }

 private:
  double l_, k_, b_, m_, c_;
  std::vector<Vector2<double>> x_, v_, f_;  // [m], [m/s], [N]
};

}  // namespace hapbeam::testing
