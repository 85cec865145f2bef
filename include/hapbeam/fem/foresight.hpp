// Extrapolated initial guess of a lasting press: each node moves as in the push before.
//
//   x₊ = x + r (x - x₋) + e ∂x/∂s        e = s₊ - s - r (s - s₋)
//
// x are place and rotation of a node, in space place, tangent and director; s is where it is along the beam, for the mesh follows the contact, and r is the hand's step in units of the
// step before.  From there the error is of second order in the step, and Newton's method takes one solve less; nor is the shape carried over to the
// mesh by its cubics.  A hand that turns aside or hurries has nothing foreseen.
// Allocates at construction.  Real-time: all else is noexcept and allocation-free, O(elements).
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

#include <hapbeam/centreline.hpp>
#include <hapbeam/fem/contact_mesh.hpp>
#include <hapbeam/force_model.hpp>

namespace hapbeam::detail {

/// Where a hand is: both ends of a capsule's axis [m].
template <typename Scalar>
VectorOf<Scalar, 6> hand_of(const Capsule<Scalar>& capsule) noexcept {
  VectorOf<Scalar, 6> ends;
  ends << capsule.axis.tip, capsule.axis.at(1);
  return ends;
}

/// @tparam Request  Capsule
template <class System, class Request>
class Foresight {
  using Scalar = typename System::Scalar;
  using Mesh = typename System::Mesh;
  using Hand = decltype(hand_of(std::declval<const Request&>()));

 public:
  explicit Foresight(const System& system) : before_(system.elements()), mesh_(system.mesh()) {}

  /// To be called before each push, which moves the system.  @param mesh  of this push   @param request  of it
  /// @return whether the system is where the beam will be about, on that mesh; else it has not moved
  bool go_on(System& system, const Mesh& mesh, const Request& request) noexcept {
    const Hand hand = hand_of(request), step = hand - hand_;
    const Scalar ratio = step.dot(step_) / step_.squaredNorm();
    const bool straight_on = std::abs(ratio) < fastest &&
                             (step - ratio * step_).squaredNorm() <= aside * aside * step.squaredNorm();
    const bool same_node = mesh.node() == system.mesh().node() && mesh.node() == mesh_.node();
    const bool goes_on = known_ > 1 && straight_on && same_node;
    hand_ = hand;
    step_ = step;
    mesh_ = system.mesh();
    forth_ = ratio > 0;
    if (goes_on) system.go_on(before_, mesh, ratio);
    else system.keep(before_);
    return goes_on;
  }
  /// Whether a hand that goes on does not turn back.
  bool forth() const noexcept { return forth_; }
  /// To be called after each push.  @param found  whether it was answered on the branch on which the beam was
  void know(bool found) noexcept { known_ = found ? (std::min)(known_ + 1, 2) : 0; }
  /// Back to where the system was before go_on().  @param force  of then [N]
  void go_back(System& system, Scalar force) noexcept {
    system.go_back(mesh_, before_, force);
    forget();
  }
  void forget() noexcept { known_ = 0; }
  /// Where the system was before the push.
  const typename System::State& before() const noexcept { return before_; }
  const Mesh& mesh() const noexcept { return mesh_; }
  /// To where the system was before the push.
  void begin_again(System& system) const noexcept { system.set_state(mesh_, before_); }

 private:
  static constexpr Scalar fastest = 2,
                          aside = Scalar(0.1);  // of a step, in units of the one before and of itself

  typename System::State before_;
  Mesh mesh_;                                       // of before_
  Hand hand_ = Hand::Zero(), step_ = Hand::Zero();  // of the last push [m]
  bool forth_ = false;
  int known_ = 0;  // pushes without a break, as far as they matter
};

}  // namespace hapbeam::detail
