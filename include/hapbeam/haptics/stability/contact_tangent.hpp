// SPDX-License-Identifier: MIT
// Prediction of the force a little deeper: the last valid force, continued along its tangent.
//
//   f(p) = f0 - k n·(p - p0)      never below zero: a beam does not pull
//
// p0 and f0 n are place and force of the last valid response, n is the normal of the contact. The stiffness k
// along n is not taken from the model: it follows from the responses. Contact without friction is conservative, so the work
// done on the beam since it was touched is its energy U. That holds wherever the hand has slid meanwhile, and with any
// dead loads. For a force law f ~ y^q the tangent is
//
//   df/dy = 2q/(q + 1) · f²/2U      1 × f²/2U where the beam is linear, 1.5 × where it is cubic
//
// and k = 1.25 f²/2U is within a fifth of both: Newton's method with this slope divides an error by five each tick.
// Other estimates are worse. A difference of two responses is noise while the hand stands, and has a large error where
// it slides. f/depth ignores the change of stiffness along the beam, a factor of thousands near a support.
// If a response differs from its prediction by more than 40 %, the response is taken and the energy restarts from it.
// Real-time: no allocation, noexcept, wait-free, O(1).
#pragma once

#include <algorithm>
#include <cmath>

#include <hapbeam/centreline.hpp>

namespace hapbeam {

/// @tparam D  of the space in which the beam bends: 2 | 3
template <int D>
class ContactTangent {
  using Vector = VectorOf<double, D>;

 public:
  bool known() const noexcept { return known_; }
  const Vector& normal() const noexcept { return normal_; }  ///< unit; out of the beam when last touched
  double stiffness() const noexcept { return stiffness_; }   ///< k [N/m] along the normal

  double energy() const noexcept { return known_ ? energy_ : 0; }  ///< U [J]

  /// f0 - k n·(p - p0), below zero too where p lies outside; 0 while nothing is known.  @param place [m]   @return [N]
  double force_at(const Vector& place) const noexcept {
    return known_ ? force_ - stiffness_ * normal_.dot(way(place)) : 0;
  }

  /// Places are counted from another point of a body that turns.   @param by [m] from the old one
  void move(const Vector& by) noexcept { place_ += by; }

  /// The beam is touched no more.
  void forget() noexcept { known_ = false, stiffness_ = 0; }

  /// A good response.
  /// @param place [m] from which the beam is pressed   @param force [N] on the hand, finite, not zero
  /// @param depth [m] of the penetration that the first touch ended
  void learn(const Vector& place, const Vector& force, double depth) noexcept {
    const double size = force.norm();
    const Vector normal = force / size;
    if (known_) follow(place, normal, size);
    else energy_ = size * (std::max)(depth, least_depth) / 2;
    known_ = true;
    place_ = place, normal_ = normal, force_ = size;
    set_stiffness(safety * size * size / (2 * energy_));
  }

  /// Something else has moved the beam: another force at the same place.  @param force [N] finite
  void renew(const Vector& force) noexcept {
    const double size = force.norm();
    if (size > 0) normal_ = force / size;
    force_ = size;
    set_stiffness(stiffness_);
  }

  /// Nothing was touched where the tangent had a force: it begins at the surface.
  /// @param place [m] on it   @param normal  unit, out of the beam
  void begin_at(const Vector& place, const Vector& normal) noexcept {
    place_ = place, normal_ = normal, force_ = 0, energy_ = 0;
  }

 private:
  static constexpr double safety = 1.25;      // over f²/2U
  static constexpr double least_ratio = 0.6;  // of response to prediction: 0.8 where linear, 1.2 where cubic
  static constexpr double most_ratio = 1.4;   //
  static constexpr double loud = 1e-3;  // change of the force, over it, from which a response says something
  static constexpr double slide = 0.3;  // the same where the hand slides, which changes the force as well
  static constexpr double most_change = 4;      // of the stiffness in a tick
  static constexpr double most_work = 0.3;      // of the energy, that a trapezoid is taken for
  static constexpr double least_depth = 1e-12;  // [m]
  static constexpr double rigid = 1e12;         // [N/m]

  /// From the last good response to a place [m].
  Vector way(const Vector& place) const noexcept { return place - place_; }

  void follow(const Vector& place, const Vector& normal, double force) noexcept {
    const Vector step = way(place);
    const double deeper = -normal.dot(step), work = (force * deeper - force_ * normal_.dot(step)) / 2;
    const double along = (step + deeper * normal).norm();
    const double expected = stiffness_ * deeper, change = force - force_, ratio = change / expected;
    const bool agrees = ratio > least_ratio && ratio < most_ratio;
    const double noise = along > std::abs(deeper) ? slide : loud;
    const bool quiet = (std::max)(std::abs(expected), std::abs(change)) <= noise * force;
    if ((agrees || quiet) && std::abs(work) <= most_work * energy_) {
      energy_ += work;
    } else {
      // Too stiff is slow, too soft overshoots: up at once, down with care.
      const double factor = agrees       ? 1
                            : ratio > 0  ? (std::max)(safety * ratio, 1 / most_change)
                            : force_ > 0 ? (std::max)(force / force_, 1.0)
                                         : 1;
      energy_ = safety * force * force / (2 * factor * stiffness_);
    }
  }

  /// Keeps energy and stiffness in step.
  void set_stiffness(double stiffness) noexcept {
    stiffness_ = (std::min)(stiffness, rigid);
    energy_ = safety * force_ * force_ / (2 * stiffness_);
  }

  bool known_ = false;
  Vector place_ = Vector::Zero(), normal_ = Vector::UnitY();
  double force_ = 0;      // f0 [N]
  double stiffness_ = 0;  // k [N/m]
  double energy_ = 0;     // U [J]
};

}  // namespace hapbeam
