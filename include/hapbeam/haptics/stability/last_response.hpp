// SPDX-License-Identifier: MIT
// The last valid response, for ticks in which the model has none.
//
// Keeps the tangent of the last valid response through at most max_continued ticks in which the model exhausted its
// budget. A tick may also miss the beam where the tangent had a force: on a stiff curved surface p may leave the beam
// by more than it was pressed in. The contact of the hand itself then decides.
// Any other failure ends the contact.
// Real-time: no allocation, noexcept, wait-free, O(1).
#pragma once

#include <hapbeam/contact/touch.hpp>
#include <hapbeam/force_model.hpp>
#include <hapbeam/haptics/stability/contact_tangent.hpp>
#include <hapbeam/haptics/stability/in_scene.hpp>

namespace hapbeam {

class LastResponse {
 public:
  /// Successive ticks that are continued without a response.
  static constexpr int max_continued = 20;

  const ContactTangent<3>& tangent() const noexcept { return tangent_; }
  /// The last tick had no response, or missed the beam, and the tangent replaces it.
  bool continued() const noexcept { return (continued_ > 0 || missed_) && tangent_.known(); }

  /// As ContactTangent's.
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
      tangent_.learn(place, force, static_cast<double>(touch.contact.depth));
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
