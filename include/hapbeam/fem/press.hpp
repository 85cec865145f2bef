// SPDX-License-Identifier: MIT
// A press of a finite-element beam, or a push of a rod: where it is answered, at which place the mesh of a beam takes the contact, and how an answer
// continues the last one.
//
// From a support that holds its place across a press keeps a distance.  Moderate rotation: |d| up to a tenth of the length and half of the
// distance to such a support.  Finite rotation: where the ends hold the beam along its axis, as far beyond what its length allows; where it can
// slide, 0.3 of the length and of the distance, the deepest that one call reaches from rest.  A push of a rod has no limit of depth.
//
// A push at a given place along a given direction is the press of the thesis, and what leads it in tests and choosers.  The place lies within an element
// of a mesh that stays.  An answer continues the last one, or says that it does not (contact/continuation.hpp).  The work of a push that has led
// from n₋ · u(s₋) = d₋ to n · u(s) = d is, by trapezoids,
//
//   W = ½ F₋ (d - n · u₋(s)) + ½ F (n₋ · u(s₋) - d₋)
//
// Allocates at the construction of PlacePush.  Real-time: all else is noexcept and allocation-free, PressRange O(1); a push takes at most the linear
// solves of AllDisplacements.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include <hapbeam/beam.hpp>
#include <hapbeam/body/inner_contact.hpp>
#include <hapbeam/element/element.hpp>
#include <hapbeam/fem/contact/continuation.hpp>
#include <hapbeam/force_model.hpp>
#include <hapbeam/support.hpp>

namespace hapbeam {

namespace detail {

/// Whether nothing rigid holds the place of an end.
constexpr bool yields(Support support) noexcept { return !fixes_w(support); }
inline bool yields(const RodSupport& support) noexcept {
  return !std::isinf(support.place1) && !std::isinf(support.place2) && !std::isinf(support.along);
}

template <class Element, class System>
class PlacePush {
  using Scalar = typename System::Scalar;
  static constexpr int dimension = dimension_of<Element>;
  using Request = Push<Scalar, dimension>;

 public:
  explicit PlacePush(const System& system) : before_(system.elements()) {}

  /// To be called where something else moves the beam.
  void forget() noexcept { continuation_.forget(); }

  /// @param way  AllDisplacements, which settles the system
  template <class Way>
  Response<Scalar> push(Way& way, const Request& request) noexcept {
    // A straight beam has one shape for each press.
    if (way.single_valued_) {
      continuation_.forget();
      return answer(way, request);
    }
    System& system = way.system_;
    if (!(last_.normal.dot(request.normal) > 0)) continuation_.forget();
    const Request from = last_;
    Request next;
    Scalar force = 0, ahead = 0, reached = 0;
    bool stays = false;  // at its place, along its direction
    const auto go = [&](Scalar t) {
      next = between(from, request, t);
      system.keep(before_), force = system.linear_reaction();
      stays = continuation_.known() && next.s == last_.s && next.normal == last_.normal;
      ahead = next.d - (stays ? last_.d : system.displacement(next.s, next.normal));
      const Response<Scalar> found = answer(way, next);
      reached = found.force;
      return found.status;
    };
    const auto judge = [&] {
      const Scalar behind = stays ? ahead : system.displacement(last_.s, last_.normal) - last_.d;
      const Scalar before = force * ahead, now = reached * behind;
      return continuation_.judge({system.foreseen_potential(), (before + now) / 2,
                                  std::abs(before) + std::abs(now), std::abs(now - before), system.strain(),
                                  system.length(), std::abs(ahead) + std::abs(next.s - last_.s)},
                                 [&] { return farthest(system.view(before_), system.centreline()); });
    };
    const auto keep = [&](Status status) {
      if (!is_answer(status)) return continuation_.forget();
      continuation_.know(system.foreseen_potential());
      last_ = next;
    };
    const auto back = [&] {
      system.go_back(before_, force);
      system.draw();
    };
    const Status status = continuation_.follow(go, judge, keep, back);
    return {reached, status};
  }

 private:
  template <class Way>
  static Response<Scalar> answer(Way& way, const Request& request) noexcept {
    System& system = way.system_;
    const Scalar last = system.linear_reaction(), s = request.s;
    if (way.single_valued_ && std::abs(request.d - system.displacement(way.rest_state_, s, request.normal)) <
                                  std::abs(request.d - system.displacement(s, request.normal)))
      way.to_rest();
    const Response<Scalar> found = way.settle(last, 1, [&] { system.set_goal(request, last); });
    system.draw();
    return found;
  }

  typename System::State before_;
  Request last_{0, 0, VectorOf<Scalar, dimension>::Zero()};  // answered
  Continuation<Scalar> continuation_;
};

}  // namespace detail

template <typename Scalar>
class PressRange {
 public:
  /// @param body  Beam | Rod   @param turns  whether its elements are of finite rotation
  template <class Body>
  explicit PressRange(const Body& body, [[maybe_unused]] bool turns = true) noexcept
      : length_(static_cast<Scalar>(body.length())),
        shortest_(detail::shortest_element<Scalar>(length_)),
        yields_{detail::yields(body.left()), detail::yields(body.right())} {
    if constexpr (std::is_same_v<Body, Beam>) {
      const bool held[] = {fixes_u(body.left()), fixes_u(body.right())};
      for (int k = 0; k < 2; ++k) guided_[k] = yields_[k] && held[k];
      depth_ = length_ / 10, slope_ = Scalar(0.5);
      if (turns && held[0] && held[1]) {
        // How high a beam of this length can stand between its ends, over half the length.
        const auto span = (body.length() + body.right_place().u - body.left_place().u) / body.length();
        const Scalar sag = static_cast<Scalar>(std::sqrt((std::max)(0.0, 1 - span * span)));
        depth_ += sag * length_ / 2, slope_ += sag;
      } else if (turns) {
        depth_ = Scalar(0.3) * length_, slope_ = Scalar(0.3);
      }
    }
  }

  /// Whether neither end moves across.
  bool holds_both() const noexcept { return !yields_[0] && !yields_[1]; }
  Scalar length() const noexcept { return length_; }
  /// Whether s is a place on the beam.
  bool on_beam(Scalar s) const noexcept { return std::isfinite(s) && s >= 0 && s <= length_; }

  Range<Scalar> range() const noexcept {
    return {yields_[0] ? Scalar(0) : shortest_,
            yields_[1] ? length_ : length_ - shortest_,
            depth_,
            slope_,
            yields_[0] ? -infinity : Scalar(0),
            yields_[1] ? infinity : length_};
  }

  /// Where the node of a contact at s goes: s, or the end beside which an element would be too short for round-off.
  Scalar node(Scalar s) const noexcept {
    return s < shortest_ && yields_[0] ? Scalar(0) : length_ - s < shortest_ && yields_[1] ? length_ : s;
  }
  /// Whether a node there is an end that slides along a wall.
  bool on_wall(Scalar node) const noexcept {
    return (node == 0 && guided_[0]) || (node == length_ && guided_[1]);
  }

 private:
  static constexpr Scalar infinity = std::numeric_limits<Scalar>::infinity();
  Scalar length_, shortest_, depth_ = infinity, slope_ = infinity;
  bool yields_[2], guided_[2] = {false, false};
};

}  // namespace hapbeam
