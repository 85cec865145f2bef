// SPDX-License-Identifier: MIT
// Coulomb friction of a pair, and what it makes of the pair's equations.
//
//   f = λ n + t,   t = T(e),   e = e₀ + t₁ Δs₁ - t₂ Δs₂ - Δ(∂h/∂f) across n       t₁, t₂: r' of the true curves, Δ: since the last equilibrium
//
// The places are nearest to each other, λ n · tᵢ = 0.  With S = ∂T/∂e, m = ∂T/∂λ and δ(∂h/∂f) = H δn an increment of f turns n by
//
//   δn = G (δf - S (t₁ δs₁ - t₂ δs₂) - m δλ),   G = (λ - S H)⁻¹,   δλ = δf · n + t · δn
//
// Sticks: T = k e while that is within the bound B = μλ.  Slides: T = B d, S = B/l (1 - d dᵀ).  T and e of the last answer say which, before each linear solve:
// t + q (e - t/k) has the size B + q l and the direction d.  Any stiffness q leads to the same; one of the rods, as contacts feel it, does so soonest, or where
// that leads nowhere as two answers differ: along itself a rod is far stiffer.
// Two that stick on one stiff rod push each other above their bounds: of all that stuck only those begin to slide that are nearly as many times above as the one
// that is most.
// What sticks has the t of the last answer; what the law has it more is taken from δf in that.
// H = R between rods, and large where a body is flat: H δn is how the rod goes over it.  H G is symmetric.
// A body that has turned has taken all of the last equilibrium along.
// All but m is symmetric, and that T goes along with the places.  Both are of rank one a pair or a place, and put in after the symmetric equations
// are solved (pair_bounds.hpp).
// Real-time: noexcept, no allocation, O(1).   Source: derived here from the stationarity of V - f · (w - ∂h/∂f) + ∫T·de;  T: Alart and Curnier, Comput.
// Methods Appl. Mech. Eng. 92 (1991).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <hapbeam/friction.hpp>

namespace hapbeam::detail {

/// The rougher rod decides, as in MuJoCo and in discrete elastic rods.
inline Friction friction_of(const Friction& a, const Friction& b) noexcept {
  return {(std::max)(a.sticking, b.sticking), (std::max)(a.sliding, b.sliding)};
}

/// How a pair is taken to rub until a solve tells more.
struct RubGuess {
  double scale;  // of q
  /// What has not rubbed yet, which slips freely, and what is known of q then.
  enum { slips, sticks, learns } at_first;
};

class PairFriction {
 public:
  using Vector = VectorOf<double, 3>;
  using Plane = VectorOf<double, 2>;  // across n, along the axes of the pair
  using Matrix = Eigen::Matrix<double, 2, 2>;

  /// @param stiffness  k of the skin   @param element  of what rods give way by [N/m]
  void take(const Friction& friction, double reach, double stiffness, double element) noexcept {
    state_.sticking = friction.sticking, state_.sliding = friction.sliding;
    reach_ = reach, stiffness_ = stiffness, element_ = element;
    begin();
  }
  bool none() const noexcept { return !(state_.sticking > 0); }
  /// A step begins, or anew.   @param guess  another where one has led nowhere
  void begin(const RubGuess& guess = {1, RubGuess::slips}) noexcept { mode_ = Mode::begins, guess_ = guess; }
  /// No friction until there is an equilibrium.
  void let_go() noexcept { state_.let_go(), begin(); }

  /// Whether it slides freely in the next linear solve: until a first equilibrium, and in the first solve of what has not rubbed yet.
  bool is_free() const noexcept {
    const bool is_new = !state_.slides && state_.skin.isZero(0);
    return none() || !state_.known || (is_new && begins() && guess_.at_first != RubGuess::sticks);
  }
  /// Whether look() begins it.
  bool begins() const noexcept { return mode_ == Mode::begins; }
  /// To be called then, where a body has turned.   @param turn  (vector &)
  template <class Turn>
  void carry(Turn&& turn) noexcept {
    turn(state_.normal), turn(state_.along), turn(state_.axis), turn(state_.off), turn(state_.skin),
        turn(state_.force);
  }

  /// To be called where rods have moved.   @param normal  n   @param off  o [m]   @param along  r' of both true curves   @param force  λ [N]
  void look(const Vector& normal, const Vector& off, const std::array<double, 2>& s,
            const std::array<Vector, 2>& along, double force) noexcept {
    now_.s = s[0], now_.place = s[1], now_.normal = -normal, now_.off = off;
    now_.along = along[0], now_.axis = along[1], tangents_ = along;
    constexpr double more = 1e-6;  // of a bound, is round-off
    const bool first = begins(), free = is_free();
    if (first) {
      before_ = state_.known ? state_ : now_;
      answers_ = 0, learned_ = 0;
      felt_ = state_.force, most_ = state_.slides ? state_.sliding : state_.sticking;
    }
    const bool stuck = mode_ == Mode::sticks;
    exceeds_ = 0;
    if (mode_ = Mode::free; free) return acts_on_.setZero(), void();
    felt_ -= normal.dot(felt_) * normal;
    shear_ = now_.carried(state_.skin, before_) + now_.slip(before_, 1, reach_);
    bound_ = most_ * (std::max)(force, 0.0);
    if (guess_.at_first == RubGuess::learns) learn();
    const double lends = (std::max)(guess_.scale * element_, learned_);
    const Vector more_shear = lends * (shear_ - felt_ / stiffness_), lent = felt_ + more_shear;
    const double size = std::sqrt(lent.squaredNorm()), felt = std::sqrt(felt_.squaredNorm());
    // What slid goes on as far.
    const bool goes_on = first && state_.slides && felt > 0;
    off_ = more_shear.squaredNorm();
    if (!goes_on && !(size > (1 + more) * bound_)) return stick();
    if (stuck && guess_.at_first != RubGuess::sticks) exceeds_ = size / bound_;
    mode_ = Mode::slides;
    way_ = goes_on ? Vector(felt_ / felt) : Vector(lent / size);
    const double slip = goes_on ? state_.slip : (size - bound_) / lends;
    aside_ = bound_ < stiffness_ * slip ? bound_ / slip : stiffness_;
    acts_on_ = bound_ * way_;
    off_ = (felt_ - acts_on_).squaredNorm();
  }
  /// So many times its bound it is, where it stuck and begins to slide, and not all are taken to stick.
  double exceeds() const noexcept { return exceeds_; }
  /// It sticks in the next solve.
  void stick() noexcept { mode_ = Mode::sticks, acts_on_ = felt_, lacks_on_ = stiffness_ * shear_ - felt_; }
  /// Whether it is more than a place that slides without friction.
  bool acts() const noexcept { return !none() && (mode_ == Mode::sticks || mode_ == Mode::slides); }
  /// T, on the first rod [N].  A skin that sticks is so stiff that its T says more of what increments have left than of the answer.
  const Vector& force() const noexcept { return acts_on_; }

  /// Puts in its own entries.   @param axes  of the pair   @param bends  H   @param row  of its equations   @param force  λ [N]
  template <class Equations>
  void add(const std::array<Vector, 3>& axes, const Matrix& bends, double force, int row,
           Equations& dense) noexcept {
    const auto in_plane = [&](const Vector& v) { return Plane(v.dot(axes[1]), v.dot(axes[2])); };
    acts_ = in_plane(acts_on_);
    if (mode_ == Mode::sticks) {
      stiff_ = stiffness_ * Matrix::Identity();
      lacks_ = in_plane(lacks_on_), follows_.setZero();
    } else {
      // Round-off along the way would be felt where a body is flat.
      const Plane way = in_plane(way_), aside(-way[1], way[0]);
      stiff_ = aside_ * aside * aside.transpose();
      lacks_ = aside_ * aside.dot(in_plane(shear_)) * aside;
      follows_ = force > 0 ? Plane(most_ * way) : Plane(0, 0);
    }
    bends_ = bends;
    invert(force);
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

  /// To be called where an equilibrium was found, after look().   @return whether it is one of Coulomb's law, too
  bool settled(double force) noexcept {
    constexpr double exact = 1e-7;  // where slips are short T changes by more than increments tell
    if (!acts()) return true;
    if (off_ > exact * exact * force * force) return false;
    if (mode_ == Mode::sticks || !(most_ > state_.sliding)) return true;
    return most_ = state_.sliding, false;
  }
  /// To be called where that is kept.   @return what it has dissipated [J]
  double leave(double force) noexcept {
    const Vector off = state_.off, before = now_.carried(state_.force, before_);
    const bool went_on = state_.slides || state_.sticking > state_.sliding;
    double dissipated = 0;
    state_.slides = mode_ == Mode::slides;
    if (acts()) {
      state_.slip = std::sqrt(shear_.squaredNorm());
      const double most = most_ * (std::max)(force, 0.0), size = std::sqrt(felt_.squaredNorm());
      state_.force = state_.slides ? Vector(most * way_)
                     : size > most ? Vector(felt_ * (most / size))
                                   : felt_;
      state_.skin = state_.slides ? Vector(state_.force / stiffness_) : shear_;
      // The sum of ½ (T before + T) · slip of all contacts is the work of the hands by trapezoids less the energy of the rods, where that is
      // quadratic.  What turns back slides with all of its force.
      const Vector mean =
          went_on && before.dot(state_.force) > 0 ? Vector((before + state_.force) / 2) : state_.force;
      dissipated = mean.dot(shear_ - state_.skin);
    }
    state_.known = true;
    static_cast<Place&>(state_) = now_;
    gone_ = state_.off - off;
    begin();
    return dissipated;
  }
  /// Of the last equilibrium: T, no more than its share of λ [N].
  const Vector& kept() const noexcept { return state_.force; }
  bool slid() const noexcept { return state_.slides; }
  /// How o has changed in the last step [m].
  const Vector& gone() const noexcept { return gone_; }
  /// Energy of the skin [J].
  double stored() const noexcept { return stiffness_ / 2 * state_.skin.squaredNorm(); }

 private:
  using Place = FrictionPlace<double, 3>;
  enum class Mode { begins, free, sticks, slides };

  /// How rods yield to T is what two answers differ by, but for the first, to which the hands have gone.
  void learn() noexcept {
    constexpr double least = 1e-2;  // of the bound
    const Vector more = felt_ - last_.force, moved = shear_ - last_.shear;
    const double square = more.squaredNorm(), yields = -more.dot(moved);
    if (answers_++ > 1 && square > least * least * bound_ * bound_ && yields > 0)
      learned_ = std::clamp(square / yields, learned_, stiffness_);
    last_ = {felt_, shear_};
  }
  static double determinant(const Matrix& A) noexcept { return A(0, 0) * A(1, 1) - A(0, 1) * A(1, 0); }
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
  Mode mode_ = Mode::begins;
  RubGuess guess_{1, RubGuess::slips};
  Place before_, now_;
  double reach_ = 0, stiffness_ = 0, element_ = 0;  // [m], k, of an element [N/m]
  double most_ = 0, bound_ = 0, aside_ = 0, off_ = 0,
         exceeds_ = 0;  // μ, B [N], B/l [N/m], square of what T is off the law [N²]
  Matrix stiff_ = Matrix::Zero(), bends_ = stiff_, turns_ = stiff_;     // S, H and G
  Plane follows_ = Plane::Zero(), acts_ = follows_, lacks_ = follows_;  // m, t, and what the law has it more
  std::array<Plane, 2> along_{follows_, follows_};                      // t₁, -t₂
  Vector felt_ = Vector::Zero();                                        // T of the last answer
  Vector shear_ = felt_, way_ = felt_, acts_on_ = felt_, lacks_on_ = felt_;
  Vector gone_ = Vector::Zero();
  std::array<Vector, 2> tangents_;  // r'
  int negative_ = 0;
  struct {
    Vector force = Vector::Zero(), shear = force;
  } last_;              // answer, and where it led
  int answers_ = 0;     // in this step
  double learned_ = 0;  // q [N/m]
};

}  // namespace hapbeam::detail
