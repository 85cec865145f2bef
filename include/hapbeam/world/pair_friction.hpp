// SPDX-License-Identifier: MIT
// Coulomb friction of a pair: the law of the other contacts (friction_law.hpp), and what it makes of the pair's equations.
//
//   f = λ n + t,   t = T(e),   e = e₀ + t₁ Δs₁ - t₂ Δs₂ - Δ(∂h/∂f) across n       t₁, t₂: r' of the true curves, Δ: since the last equilibrium
//
// The places are nearest to each other, λ n · tᵢ = 0.  With S = ∂T/∂e, m = ∂T/∂λ and δ(∂h/∂f) = H δn an increment of f turns n by
//
//   δn = G (δf - S (t₁ δs₁ - t₂ δs₂) - m δλ),   G = (λ - S H)⁻¹,   δλ = δf · n + t · δn
//
// What sticks has the t of the last answer; what the law has it more is taken from δf in that.
// H = R between rods, and large where a body is flat: H δn is how the rod goes over it.  H G is symmetric.
// A body that has turned has taken all of the last equilibrium along.
// All but m is symmetric, and that T goes along with the places.  Both are of rank one a pair or a place, and put in after the symmetric equations
// are solved (pair_bounds.hpp).
// Real-time: noexcept, no allocation, O(1).   Source: derived here from the stationarity of V - f · (w - ∂h/∂f) + ∫T·de.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <hapbeam/fem/contact/friction_law.hpp>

namespace hapbeam::detail {

/// The rougher rod decides, as in MuJoCo and in discrete elastic rods.
inline Friction friction_of(const Friction& a, const Friction& b) noexcept {
  return {(std::max)(a.sticking, b.sticking), (std::max)(a.sliding, b.sliding)};
}

class PairFriction {
 public:
  using Vector = VectorOf<double, 3>;
  enum class Start {
    none,      ///< it has begun
    goes_on,   ///< as in the last equilibrium
    waits,     ///< without friction until the next equilibrium
    sticks,    ///< whatever it did in the last equilibrium
    has_slid,  ///< from where it has waited
  };
  using Plane = VectorOf<double, 2>;  // across n, along the axes of the pair
  using Matrix = Eigen::Matrix<double, 2, 2>;

  /// @param stiffest  of the skin [N/m]   @param length  of the shorter rod [m]
  void take(const Friction& friction, double reach, double stiffest, double length) noexcept {
    state_.sticking = friction.sticking, state_.sliding = friction.sliding;
    reach_ = reach, stiffest_ = stiffest, length_ = length;
    start_ = Start::goes_on;
  }
  bool none() const noexcept { return !(state_.sticking > 0); }
  /// A step begins, or anew, where only what has not rubbed yet waits.   @return whether another way than it went on
  bool begin(Start start = Start::goes_on) noexcept {
    const bool is_new = state_.known && !state_.slides && state_.skin.isZero(0);
    start_ = start == Start::waits && !is_new ? Start::goes_on : start;
    return start == Start::sticks ? state_.slides : start_ == Start::waits;
  }
  /// What follows is without friction until there is an equilibrium.
  void let_go() noexcept {
    state_.let_go();
    start_ = Start::goes_on;
  }

  /// Whether it slides, or has slid, freely since the last equilibrium.
  bool is_free() const noexcept {
    return none() || !state_.known || start_ == Start::waits || start_ == Start::has_slid;
  }
  /// Whether look() begins it.
  bool begins() const noexcept { return start_ != Start::none && start_ != Start::waits; }
  /// To be called then, where a body has turned.   @param turn  (vector &)
  template <class Turn>
  void carry(Turn&& turn) noexcept {
    turn(state_.normal), turn(state_.along), turn(state_.axis), turn(state_.off), turn(state_.skin),
        turn(state_.force);
  }

  /// To be called where rods have moved.   @param normal  n   @param off  o [m]   @param along  r' of both true curves   @param force  λ [N]
  void look(const Vector& normal, const Vector& off, const std::array<double, 2>& s,
            const std::array<Vector, 2>& along, double force) noexcept {
    Law::Place place;
    place.s = s[0], place.place = s[1];
    place.normal = -normal, place.off = off;
    place.along = along[0], place.axis = along[1];
    if (start_ == Start::waits) return;
    if (begins()) {
      law_.begin(state_, true, place, 1, reach_, stiffest_, start_ == Start::has_slid ? 0 : length_ / 1000,
                 last_);
      if (start_ == Start::sticks && law_.slides()) (void)law_.turn();
      felt_ = state_.force, turned_ = 0, start_ = Start::none;
    }
    tangents_ = along, felt_ -= normal.dot(felt_) * normal;
    law_.look(place, force);
  }
  /// Whether it is more than a place that slides without friction.
  bool acts() const noexcept { return !none() && start_ == Start::none && !law_.falls(); }
  /// T, on the first rod [N].  A skin that sticks is so stiff that its T says more of what increments have left than of the answer.
  const Vector& force() const noexcept { return law_.slides() ? law_.force() : felt_; }

  /// Puts in its own entries.   @param axes  of the pair   @param bends  H   @param row  of its equations   @param force  λ [N]
  template <class Equations>
  void add(const std::array<Vector, 3>& axes, const Matrix& bends, double force, int row,
           Equations& dense) noexcept {
    const auto in_plane = [&](const Vector& v) { return Plane(v.dot(axes[1]), v.dot(axes[2])); };
    const auto tangent = law_.tangent();
    stiff_ << in_plane(tangent * axes[1]), in_plane(tangent * axes[2]);
    bends_ = bends;
    invert(force);
    follows_ = in_plane(law_.by_normal_force()), acts_ = in_plane(this->force());
    lacks_ = in_plane(law_.force() - this->force());
    along_ = {in_plane(tangents_[0]), in_plane(-tangents_[1])};
    const Plane lacking = turns_ * lacks_, moved = bends_ * lacking;
    const Matrix yields = bends_ * turns_;
    negative_ = negative_of(yields);
    for (int c = 0; c < 2; ++c) {
      dense[row + 1 + c] += moved[c];
      for (int d = 0; d <= c; ++d) dense(row + 1 + c, row + 1 + d) += yields(c, d);
    }
    for (std::size_t i = 0; i < 2; ++i) {
      const int here = row + 3 + static_cast<int>(i);
      const Plane turned = turns_.transpose() * along_[i], stuck = stiff_ * turned;
      dense[here] -= force * along_[i].dot(lacking);
      for (int c = 0; c < 2; ++c) dense(here, row + 1 + c) -= force * turned[c];
      for (std::size_t j = 0; j <= i; ++j)
        dense(here, row + 3 + static_cast<int>(j)) += force * stuck.dot(along_[j]);
    }
  }
  /// How many eigenvalues are negative.
  static int negative_of(const Matrix& A) noexcept { return determinant(A) < 0 ? 1 : A.trace() < 0 ? 2 : 0; }
  /// Of those that add() has put in.
  int negative() const noexcept { return negative_; }

  /// Whether the bound follows λ.
  bool slides() const noexcept { return follows_[0] != 0 || follows_[1] != 0; }
  /// The entries of δλ in the equations of δf across n and of both places.   @param force  λ [N]
  std::array<double, 4> column(double force) const noexcept {
    const Plane turned = turns_ * follows_, moved = bends_ * turned;
    return {-moved[0], -moved[1], force * along_[0].dot(turned), force * along_[1].dot(turned)};
  }
  /// δλ as of δf along the axes.
  std::array<double, 3> row() const noexcept {
    const Plane turned = turns_.transpose() * acts_;
    const double over = 1 / (1 + turned.dot(follows_));
    return {over, over * turned[0], over * turned[1]};
  }
  /// δλ and δn of an answer.   @param axes  of the pair   @param u  δf along those, δs
  std::array<double, 3> increment(const std::array<Vector, 3>& axes, const std::array<double, 5>& u,
                                  double force) noexcept {
    const Plane aside(u[1], u[2]), rest = aside - lacks_ - stiff_ * (along_[0] * u[3] + along_[1] * u[4]),
                                   turned = turns_.transpose() * acts_;
    const double more = (u[0] + turned.dot(rest)) / (1 + turned.dot(follows_));
    const Plane turn = turns_ * (rest - follows_ * more);
    // The force less its part along the normal, which turns.
    const Plane T = acts_ + aside - (force + more) * turn;
    felt_ = T[0] * axes[1] + T[1] * axes[2] - T.dot(turn) * axes[0];
    return {more, turn[0], turn[1]};
  }

  /// To be called where an equilibrium was found, after look().   @param axes  of its last equations   @return whether it is one of Coulomb's law, too
  bool settled(const std::array<Vector, 3>& axes, double force) noexcept {
    constexpr int most = 3;
    if (start_ == Start::waits) return start_ = Start::has_slid, false;
    if (acts() && !is_exact(axes, force) && turned_++ < most) return false;
    if (law_.settled(force)) return true;
    turned_ = 0;
    return false;
  }
  /// To be called where that is kept.   @return what it has dissipated [J]
  double leave(double force) noexcept {
    const double before = state_.dissipated;
    const Vector off = state_.off;
    law_.leave(state_, force);
    gone_ = state_.off - off;
    if (acts() && !law_.slides()) {
      const double most = state_.sticking * force, size = std::sqrt(felt_.squaredNorm());
      state_.force = size > most ? Vector(felt_ * (most / size)) : felt_;
    }
    last_ = force;
    start_ = Start::goes_on;
    return state_.dissipated - before;
  }
  /// Of the last equilibrium: T, no more than its share of λ [N].
  const Vector& kept() const noexcept { return state_.force; }
  bool slid() const noexcept { return state_.slides; }
  /// How o has changed in the last step [m].
  const Vector& gone() const noexcept { return gone_; }
  /// Energy of the skin [J].
  double stored() const noexcept {
    return state_.known ? (std::min)(state_.stiffness, stiffest_) / 2 * state_.skin.squaredNorm() : 0.0;
  }

 private:
  using Law = FrictionLaw<double, 3>;

  static double determinant(const Matrix& A) noexcept { return A(0, 0) * A(1, 1) - A(0, 1) * A(1, 0); }
  /// Where slips are short T changes by more than increments tell, and not below round-off.  What sticks has to be known to stick.
  bool is_exact(const std::array<Vector, 3>& axes, double force) const noexcept {
    constexpr double exact = 1e-7;
    const Vector &acts = law_.force(), off = acts - felt_;
    const double off1 = off.dot(axes[1]), off2 = off.dot(axes[2]);
    if (law_.slides()) return off1 * off1 + off2 * off2 <= exact * exact * force * force;
    const double most = state_.sticking * force * state_.sticking * force;
    return (acts.squaredNorm() > most) == (felt_.squaredNorm() > most);
  }
  /// G, which has a pole where the slip of a step is about μR.
  void invert(double force) noexcept {
    constexpr double least = 1e-6, aside = 1.01;
    const Matrix product = stiff_ * bends_;
    Matrix of = force * Matrix::Identity() - product;
    for (double more = aside; std::abs(determinant(of)) < least * force * force; more *= aside)
      of = force * Matrix::Identity() - more * product;
    turns_ << of(1, 1), -of(0, 1), -of(1, 0), of(0, 0);
    turns_ /= determinant(of);
  }

  FrictionState<double, 3> state_;
  Law law_;
  double reach_ = 0, stiffest_ = 0, length_ = 0, last_ = 0;  // [m], [N/m], [m], λ of the last equilibrium [N]
  Matrix stiff_ = Matrix::Zero(), bends_ = stiff_, turns_ = stiff_;     // S, H and G
  Plane follows_ = Plane::Zero(), acts_ = follows_, lacks_ = follows_;  // m, t, and what the law has it more
  std::array<Plane, 2> along_{follows_, follows_};                      // t₁, -t₂
  Vector felt_ = Vector::Zero();                                        // T of the last answer
  Vector gone_ = Vector::Zero();
  std::array<Vector, 2> tangents_;  // r'
  int negative_ = 0, turned_ = 0;
  Start start_ = Start::goes_on;
};

}  // namespace hapbeam::detail
