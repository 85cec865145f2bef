// What is left of the beam's good answers when it gives none.
//
// Keeps the tangent of the last good response through ticks in which the model ran out of its budget, for
// max_continued of them, and through ticks that missed the beam though the tangent still had a force there:
// there the tangent was too flat and the point from which the beam is pressed was taken too far out.  (Where the beam is gone
// the coupling forgets it.)
// Any other failure ends the contact.
// Real-time: no allocation, noexcept, wait-free, O(1).
#pragma once

#include <hapbeam/contact/touch.hpp>
#include <hapbeam/force_model.hpp>
#include <hapbeam/haptics/stability/contact_tangent.hpp>

namespace hapbeam {

class LastResponse {
 public:
  /// Ticks in a row that go on without an answer.
  static constexpr int max_continued = 20;
  /// Ticks in a row that may miss the beam.
  static constexpr int max_missed = 3;

  const ContactTangent& tangent() const noexcept { return tangent_; }
  /// The last response was none, or missed the beam, and the tangent stands for it.
  bool continued() const noexcept { return (continued_ > 0 || missed_ > 0) && tangent_.known(); }

  void forget() noexcept {
    tangent_.forget();
    continued_ = missed_ = 0;
  }

  /// @param touch  the beam's answer   @param place [m] from where it was pressed
  template <typename Scalar>
  void learn(const TouchResult<Scalar>& touch, const Vector2<double>& place) noexcept {
    const Vector2<double> force = touch.force.template cast<double>();
    if (touch.status == Status::iteration_limit && continued_ < max_continued) {
      ++continued_;
    } else if (!is_answer(touch.status)) {
      forget();
    } else if (touch.pressing && force.squaredNorm() > 0) {
      tangent_.learn(place, force, static_cast<double>(touch.contact.depth));
      continued_ = missed_ = 0;
    } else if (tangent_.known()) {
      continued_ = 0;
      if (++missed_ > max_missed) forget();
      else tangent_.steepen();
    }
  }

 private:
  ContactTangent tangent_;
  int continued_ = 0, missed_ = 0;
};

}  // namespace hapbeam
