// Extrapolated initial guess where several bodies press a beam (foresight.hpp): the beam moves as in the last push, or as in the one before.
//
// All hands together are one point of a larger space, and a step of that point is compared with its last two. Where two hands are ticked in
// turn, each goes on as in its own last tick, which was the one before the last.
// Allocates at construction.  Real-time: all else is noexcept and allocation-free, O(elements).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include <hapbeam/fem/foresight.hpp>
#include <hapbeam/force_model.hpp>

namespace hapbeam::detail {

/// @tparam Most  obstacles
template <class System, class Obstacle, int Most>
class SeveralForesight {
  using Scalar = typename System::Scalar;
  using State = typename System::State;
  using Mesh = typename System::Mesh;
  static constexpr int size = decltype(hand_of(Obstacle{}.round))::RowsAtCompileTime;
  using Hands = VectorOf<Scalar, size * Most>;
  using Places = std::array<Scalar, Most>;

 public:
  explicit SeveralForesight(const System& system)
      : before_{State(system.elements()), State(system.elements())}, mesh_{system.mesh(), system.mesh()} {}

  /// To be called before each push.   @return whether the hands go on as they went, past the same obstacles
  bool look(const Obstacle* all, int count) noexcept {
    Hands hands = Hands::Zero();
    bool same = count == count_;
    for (int i = 0; i < count; ++i) {
      hands.template segment<size>(size * i) = hand_of(all[i].round);
      same = same && all[i].touching == touching_[of(i)] && all[i].kind == kind_[of(i)];
    }
    count_ = count;
    const Hands step = hands - hands_;
    hands_ = hands;
    like_ = 0;
    for (int k = 1; same && k <= 2 && like_ == 0; ++k) {
      const Hands& then = step_[of(k - 1)];
      ratio_ = step.dot(then) / then.squaredNorm();
      const bool straight_on = std::abs(ratio_) < fastest &&
                               (step - ratio_ * then).squaredNorm() <= aside * aside * step.squaredNorm();
      if (straight_on && known_ > k) like_ = k;
    }
    step_ = {step, step_[0]};
    return like_ > 0;
  }
  /// Whether hands that go on do not turn back.
  bool forth() const noexcept { return ratio_ > 0; }
  /// Where an obstacle will be touched [m].
  Scalar place(int i) const noexcept {
    const Places &from = place_[of(like_)], &to = place_[of(like_ - 1)];
    return place_[0][of(i)] + ratio_ * (to[of(i)] - from[of(i)]);
  }

  /// To be called once in each push, before it moves the system.  @param mesh  of this push
  /// @return whether the system is where the beam will be about, on that mesh; else it has not moved
  bool go_on(System& system, const Mesh& mesh) noexcept {
    bool goes_on = like_ > 0 && same_nodes(mesh, system.mesh());
    for (int k = 0; k < like_; ++k) goes_on = goes_on && same_nodes(mesh, mesh_[of(k)]);
    newest_ = 1 - newest_;
    State &older = before_[of(1 - newest_)],
          &newer = before_[of(newest_)];  // of the last push, and of this one
    mesh_ = {system.mesh(), mesh_[0]};
    if (!goes_on) {
      system.keep(newer);
      return false;
    }
    if (like_ == 1) newer = older;
    else system.carry(newer, older);
    system.go_on(newer, mesh, ratio_);
    return true;
  }
  /// Back to where the system was before go_on().  @param force  of its first contact then [N]
  void go_back(System& system, Scalar force) noexcept {
    system.go_back(mesh_[0], before_[of(newest_)], force);
    forget();
  }
  /// Where the system was before the push.
  const State& before() const noexcept { return before_[of(newest_)]; }
  /// Whether a mesh has as many elements between the same bodies as the one of then.
  bool same_mesh(const Mesh& mesh) const noexcept { return same_nodes(mesh, mesh_[0]); }
  /// To where the system was before the push.
  void begin_again(System& system) const noexcept { system.set_state(mesh_[0], before_[of(newest_)]); }
  /// To be called after each push.  @param found  whether it was answered on the branch on which the beam was
  void know(const Obstacle* all, int count, bool found) noexcept {
    place_ = {place_[0], place_[0], place_[1]};
    for (int i = 0; i < count; ++i) {
      found = found && (known_ == 0 || all[i].touching == touching_[of(i)]);
      touching_[of(i)] = all[i].touching;
      kind_[of(i)] = all[i].kind;
      place_[0][of(i)] = all[i].pushed.s;
    }
    known_ = found ? (std::min)(known_ + 1, 3) : 0;
  }
  void forget() noexcept { known_ = 0; }

 private:
  static constexpr Scalar fastest = 2,
                          aside = Scalar(0.1);  // of a step, in units of the one before and of itself
  static std::size_t of(int i) noexcept { return static_cast<std::size_t>(i); }
  static bool same_nodes(const Mesh& a, const Mesh& b) noexcept {
    bool same = a.count() == b.count();
    for (int k = 0; same && k < a.count(); ++k) same = a.node(k) == b.node(k);
    return same;
  }

  std::array<State, 2> before_;  // the pushes
  std::array<Mesh, 2> mesh_;     // before the last one and the one before
  int newest_ = 0;               // of before_
  Hands hands_ = Hands::Zero();  // in the last push [m]
  std::array<Hands, 2> step_{Hands::Zero(), Hands::Zero()};
  std::array<Places, 3> place_{};  // after the last three pushes
  std::array<bool, Most> touching_{};
  std::array<ObstacleKind, Most> kind_{};
  Scalar ratio_ = 0;
  int count_ = 0, like_ = 0;  // the push that goes on: the last one or the one before; 0: none
  int known_ = 0;             // pushes without a break, as far as they matter
};

}  // namespace hapbeam::detail
