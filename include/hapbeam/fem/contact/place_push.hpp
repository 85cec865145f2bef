// SPDX-License-Identifier: MIT
// A push of a beam or rod at a given place along a given direction: the press of the thesis, and what leads it in tests and choosers.
//
// The place lies within an element of a mesh that stays.  An answer continues the last one, or says that it does not (continuation.hpp).  The work of a push that has led
// from n₋ · u(s₋) = d₋ to n · u(s) = d is, by trapezoids,
//
//   W = ½ F₋ (d - n · u₋(s)) + ½ F (n₋ · u(s₋) - d₋)
//
// Allocates at construction.  Real-time: all else is noexcept and allocation-free; a push takes at most the linear solves of AllDisplacements.
#pragma once

#include <cmath>

#include <hapbeam/element/element.hpp>
#include <hapbeam/fem/contact/continuation.hpp>
#include <hapbeam/force_model.hpp>

namespace hapbeam::detail {

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
    using std::abs;
    System& system = way.system_;
    const Scalar last = system.linear_reaction(), s = request.s;
    if (way.single_valued_ && abs(request.d - system.displacement(way.rest_state_, s, request.normal)) <
                                  abs(request.d - system.displacement(s, request.normal)))
      way.to_rest();
    const Response<Scalar> found = way.settle(last, 1, [&] { system.set_goal(request, last); });
    system.draw();
    return found;
  }

  typename System::State before_;
  Request last_{0, 0, VectorOf<Scalar, dimension>::Zero()};  // answered
  Continuation<Scalar> continuation_;
};

}  // namespace hapbeam::detail
