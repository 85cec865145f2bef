// SPDX-License-Identifier: MIT
// The last valid response, for ticks in which the model has none, and the force a little deeper: continued along its tangent.
//
//   f(p) = f0 - k n·(p - p0)      never below zero: a beam does not pull
//
// p0 and f0 n are place and force of the last valid response, n is the normal of the contact.  Contact without friction is conservative,
// so the work done on the beam since it was touched is its energy U, wherever the hand has slid.  For a force law f ~ y^q the tangent is
//
//   df/dy = 2q/(q + 1) · f²/2U      1 × f²/2U where the beam is linear, 1.5 × where it is cubic
//
// and k = 1.25 f²/2U is within a fifth of both: Newton's method with this slope divides an error by five each tick.  A difference of two
// responses is noise while the hand stands; f/depth ignores the change of stiffness along the beam.
// If a response differs from its prediction by more than 40 %, the response is taken and the energy restarts from it.
// Real-time: no allocation, noexcept, wait-free, O(1).
#pragma once

#include <algorithm>
#include <cmath>

#include <Eigen/Core>

#include <hapbeam/centreline.hpp>
#include <hapbeam/contact/touch.hpp>
#include <hapbeam/force_model.hpp>

namespace hapbeam {

namespace detail {

// Vectors of a beam and of the scene: a beam that bends in a plane lies in the scene's x and y.
template <typename Scalar, int D>
Eigen::Vector3d in_scene(const Eigen::Matrix<Scalar, D, 1>& v) noexcept {
  return vector_of<double, 3>([&v](int k) { return k < D ? v[k % D] : 0; });
}

/// What a beam sees of it: in its plane, or all.
template <typename Scalar, int D>
VectorOf<Scalar, D> of_beam(const Eigen::Vector3d& v) noexcept {
  return vector_of<Scalar, D>([&v](int k) { return static_cast<Scalar>(v[k]); });
}

}  // namespace detail

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
    return known_ ? force_ - stiffness_ * normal_.dot(place - place_) : 0;
  }

  /// Places are counted from another point of a body that turns.   @param by [m] from the old one
  void move(const Vector& by) noexcept { place_ += by; }

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
  static constexpr double safety = 1.25;  // over f²/2U
  static constexpr double least_ratio = 0.6,
                          most_ratio = 1.4;  // of response to prediction: linear 0.8, cubic 1.2
  static constexpr double loud = 1e-3;  // change of the force, over it, from which a response says something
  static constexpr double slide = 0.3;  // the same where the hand slides, which changes the force as well
  static constexpr double most_change = 4;      // of the stiffness in a tick
  static constexpr double most_work = 0.3;      // of the energy, that a trapezoid is taken for
  static constexpr double least_depth = 1e-12;  // [m]
  static constexpr double rigid = 1e12;         // [N/m]

  void follow(const Vector& place, const Vector& normal, double force) noexcept {
    const Vector step = place - place_;
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

/// Keeps the tangent of the last valid response through at most max_continued ticks in which the model exhausted its budget.  A tick
/// may also miss the beam where the tangent had a force: on a stiff curved surface p may leave the beam by more than it was pressed in.
/// The contact of the hand itself then decides.  Any other failure ends the contact.
class LastResponse {
 public:
  /// Successive ticks that are continued without a response.
  static constexpr int max_continued = 20;

  const ContactTangent<3>& tangent() const noexcept { return tangent_; }
  /// The last tick had no response, or missed the beam, and the tangent replaces it.
  bool continued() const noexcept { return (continued_ > 0 || missed_) && tangent_.known(); }

  void move(const Eigen::Vector3d& by) noexcept { tangent_.move(by); }
  void forget() noexcept {
    tangent_.forget();
    continued_ = 0, missed_ = false;
  }
  /// Something else has moved the beam since.   @param force [N] on the place of the last response, now
  void renew(const Eigen::Vector3d& force) noexcept {
    if (tangent_.known() && !continued()) tangent_.renew(force);
  }

  /// @param touch  the beam's answer   @param place [m] from where it was pressed
  template <typename Scalar, int D>
  void learn(const TouchResult<Scalar, D>& touch, const Eigen::Vector3d& place) noexcept {
    // Friction is not a matter of the way along the normal.
    const Eigen::Vector3d force = detail::in_scene(VectorOf<Scalar, D>(touch.force - touch.friction));
    if (touch.status == Status::iteration_limit && continued_ < max_continued) {
      ++continued_;
    } else if (!is_answer(touch.status)) {
      forget();
    } else if (touch.pressing && force.squaredNorm() > 0) {
      tangent_.learn(place, force, touch.contact.depth);
      continued_ = 0, missed_ = false;
    } else if (tangent_.known()) {
      continued_ = 0;
      missed_ = true;
    }
  }

  /// Nothing was pressed.  Where the hand itself would touch nothing either, the beam has not been missed: it is gone.
  /// @param contact  of the hand with the beam as it lies now   @param hand [m]
  template <typename Scalar, int D>
  void look_again(const Contact<Scalar, D>& contact, const Eigen::Vector3d& hand) noexcept {
    if (!contact.touching) return forget();
    if (!missed_) return;
    const Eigen::Vector3d normal = detail::in_scene(contact.normal);
    tangent_.begin_at(hand + normal * static_cast<double>(contact.depth), normal);
  }

 private:
  ContactTangent<3> tangent_;
  int continued_ = 0;
  bool missed_ = false;
};

}  // namespace hapbeam
