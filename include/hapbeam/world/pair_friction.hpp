// SPDX-License-Identifier: MIT
// Coulomb friction of a pair: the law of the other contacts (friction_law.hpp), and what it makes of the pair's equations.
//
//   f = λ n + t,   t = T(e),   e = e₀ + t₁ Δs₁ - t₂ Δs₂ - R Δn across n       t₁, t₂: r' of the true curves, Δ: since the last equilibrium
//
// The places are nearest to each other, λ n · tᵢ = 0.  With S = ∂T/∂e and m = ∂T/∂λ an increment of f turns n by
//
//   δn = G (δf - S (t₁ δs₁ - t₂ δs₂) - m δλ),   G = (λ - R S)⁻¹,   δλ = δf · n + t · δn
//
// All but m is symmetric, and that T goes along with the places.  Both are of rank one a pair or a place, and put in after the symmetric equations
// are solved (pair_bounds.hpp).
// Real-time: noexcept, no allocation, O(1).   Source: derived here from the stationarity of V - f · (w - R n) + ∫T·de.
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
    goes_on,  ///< as in the last equilibrium
    sticks,   ///< whatever it did there
  };
  using Plane = std::array<double, 2>;  // across n, along the axes of the pair

  /// @param stiffest  of the skin [N/m]   @param length  of the shorter rod [m]
  void take(const Friction& friction, double reach, double stiffest, double length) noexcept {
    state_.sticking = friction.sticking, state_.sliding = friction.sliding;
    reach_ = reach, stiffest_ = stiffest, length_ = length;
    begin();
  }
  bool none() const noexcept { return !(state_.sticking > 0); }
  /// A step begins.
  void begin(Start start = Start::goes_on) noexcept { begins_ = true, start_ = start; }
  /// What follows is without friction until there is an equilibrium.
  void let_go() noexcept {
    state_.let_go();
    begin();
  }

  /// To be called where rods have moved.   @param normal  n   @param along  r' of both true curves   @param force  λ [N]
  void look(const Vector& normal, const std::array<double, 2>& s, const std::array<Vector, 2>& along,
            double force) noexcept {
    Law::Place place;
    place.s = s[0], place.place = s[1];
    place.normal = -normal;
    place.along = along[0], place.axis = along[1];
    if (begins_) {
      law_.begin(state_, true, place, 1, reach_, stiffest_, length_ / 1000, last_);
      if (start_ == Start::sticks && law_.slides()) (void)law_.turn();
      felt_ = state_.force, turned_ = 0;
    }
    begins_ = false;
    tangents_ = along;
    law_.look(place, force);
  }
  /// Whether it is more than a place that slides without friction.
  bool acts() const noexcept { return !none() && !begins_ && !law_.falls(); }
  /// T, on the first rod [N].  A skin that sticks is so stiff that its T says more of what increments have left than of the answer.
  const Vector& force() const noexcept { return law_.slides() ? law_.force() : felt_; }

  /// Puts in its own entries.   @param axes  of the pair   @param row  of its equations   @param force  λ [N]
  template <class Equations>
  void add(const std::array<Vector, 3>& axes, double force, int row, Equations& dense) noexcept {
    const auto in_plane = [&](const Vector& v) { return Plane{v.dot(axes[1]), v.dot(axes[2])}; };
    const auto tangent = law_.tangent();
    const Plane first = in_plane(tangent * axes[1]), second = in_plane(tangent * axes[2]);
    stiff_ = {first[0], second[0], second[1]};
    invert(force);
    follows_ = in_plane(law_.by_normal_force()), acts_ = in_plane(this->force());
    lacks_ = in_plane(law_.force() - this->force());
    const Plane lacking = times(turns_, lacks_);
    along_ = {in_plane(tangents_[0]), in_plane(-tangents_[1])};
    for (int c = 0; c < 2; ++c) {
      dense[row + 1 + c] += reach_ * lacking[static_cast<std::size_t>(c)];
      for (int d = 0; d <= c; ++d)
        dense(row + 1 + c, row + 1 + d) += reach_ * turns_[static_cast<std::size_t>(c + d)];
    }
    for (std::size_t i = 0; i < 2; ++i) {
      const int here = row + 3 + static_cast<int>(i);
      const Plane turned = times(turns_, along_[i]), stuck = times(stiff_, turned);
      dense[here] -= force * dot(along_[i], lacking);
      for (int c = 0; c < 2; ++c) dense(here, row + 1 + c) -= force * turned[static_cast<std::size_t>(c)];
      for (std::size_t j = 0; j <= i; ++j)
        dense(here, row + 3 + static_cast<int>(j)) += force * dot(stuck, along_[j]);
    }
  }
  /// How many of the eigenvalues that add() has put in are negative.
  int negative() const noexcept { return negative_; }

  /// Whether the bound follows λ.
  bool slides() const noexcept { return follows_[0] != 0 || follows_[1] != 0; }
  /// The entries of δλ in the equations of δf across n and of both places.   @param force  λ [N]
  std::array<double, 4> column(double force) const noexcept {
    const Plane turned = times(turns_, follows_);
    return {-reach_ * turned[0], -reach_ * turned[1], force * dot(along_[0], turned),
            force * dot(along_[1], turned)};
  }
  /// δλ as of δf along the axes.
  std::array<double, 3> row() const noexcept {
    const Plane turned = times(turns_, acts_);
    const double over = 1 / (1 + dot(acts_, times(turns_, follows_)));
    return {over, over * turned[0], over * turned[1]};
  }
  /// δλ and λ δn of an answer.   @param axes  of the pair   @param u  δf along those, δs
  std::array<double, 3> increment(const std::array<Vector, 3>& axes, const std::array<double, 5>& u,
                                  double force) noexcept {
    Plane rest{u[1] - lacks_[0], u[2] - lacks_[1]};
    for (std::size_t i = 0; i < 2; ++i) {
      const Plane stuck = times(stiff_, along_[i]);
      rest[0] -= stuck[0] * u[3 + i], rest[1] -= stuck[1] * u[3 + i];
    }
    const double more = (u[0] + dot(acts_, times(turns_, rest))) / (1 + dot(acts_, times(turns_, follows_)));
    const Plane turn = times(turns_, {rest[0] - follows_[0] * more, rest[1] - follows_[1] * more});
    // The force less its part along the normal, which turns.
    const double next = force + more;
    const Plane T{acts_[0] + u[1] - next * turn[0], acts_[1] + u[2] - next * turn[1]};
    felt_ = T[0] * axes[1] + T[1] * axes[2] - dot(T, turn) * axes[0];
    return {more, force * turn[0], force * turn[1]};
  }

  /// To be called where an equilibrium was found, after look().   @param axes  of its last equations   @return whether it is one of Coulomb's law, too
  bool settled(const std::array<Vector, 3>& axes, double force) noexcept {
    constexpr int most = 3;
    if (acts() && !is_exact(axes, force) && turned_++ < most) return false;
    if (law_.settled(force)) return true;
    turned_ = 0;
    return false;
  }
  /// To be called where that is kept.   @return what it has dissipated [J]
  double leave(double force) noexcept {
    const double before = state_.dissipated;
    law_.leave(state_, force);
    if (acts() && !law_.slides()) {
      const double most = state_.sticking * force, size = std::sqrt(felt_.squaredNorm());
      state_.force = size > most ? Vector(felt_ * (most / size)) : felt_;
    }
    last_ = force;
    begin();
    return state_.dissipated - before;
  }
  /// Of the last equilibrium: T, no more than its share of λ [N].
  const Vector& kept() const noexcept { return state_.force; }
  bool slid() const noexcept { return state_.slides; }
  /// Energy of the skin [J].
  double stored() const noexcept {
    return state_.known ? (std::min)(state_.stiffness, stiffest_) / 2 * state_.skin.squaredNorm() : 0.0;
  }

 private:
  using Law = FrictionLaw<double, 3>;
  using Symmetric = std::array<double, 3>;

  /// Where slips are short T changes by more than increments tell, and not below round-off.  What sticks has to be known to stick.
  bool is_exact(const std::array<Vector, 3>& axes, double force) const noexcept {
    constexpr double exact = 1e-7;
    const Vector &acts = law_.force(), off = acts - felt_;
    const double off1 = off.dot(axes[1]), off2 = off.dot(axes[2]);
    if (law_.slides()) return off1 * off1 + off2 * off2 <= exact * exact * force * force;
    const double most = state_.sticking * force * state_.sticking * force;
    return (acts.squaredNorm() > most) == (felt_.squaredNorm() > most);
  }

  static double dot(const Plane& a, const Plane& b) noexcept { return a[0] * b[0] + a[1] * b[1]; }
  static Plane times(const Symmetric& A, const Plane& v) noexcept {
    return {A[0] * v[0] + A[1] * v[1], A[1] * v[0] + A[2] * v[1]};
  }
  /// G, which has a pole where the slip of a step is about μR.
  void invert(double force) noexcept {
    constexpr double least = 1e-6, aside = 1.01;
    double a, b, c, det;
    for (double more = reach_;; more *= aside) {
      a = force - more * stiff_[0], b = -more * stiff_[1], c = force - more * stiff_[2];
      det = a * c - b * b;
      if (!(std::abs(det) < least * force * force)) break;
    }
    turns_ = {c / det, -b / det, a / det};
    negative_ = det < 0 ? 1 : a + c < 0 ? 2 : 0;
  }

  FrictionState<double, 3> state_;
  Law law_;
  double reach_ = 0, stiffest_ = 0, length_ = 0, last_ = 0;  // [m], [N/m], [m], λ of the last equilibrium [N]
  Symmetric stiff_{}, turns_{};                              // S and G
  Plane follows_{}, acts_{}, lacks_{};                       // m, t, and what the law has it more
  std::array<Plane, 2> along_{};                             // t₁, -t₂
  std::array<Vector, 2> tangents_;                           // r'
  Vector felt_;                                              // T of the last answer
  int negative_ = 0, turned_ = 0;
  Start start_ = Start::goes_on;
  bool begins_ = true;
};

}  // namespace hapbeam::detail
