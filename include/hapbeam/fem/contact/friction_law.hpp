// SPDX-License-Identifier: MIT
// Coulomb friction within a push: backward Euler over the tick, as a potential of which Newton's method finds the minimum.
//
//   e  = e₀ + slip                      shear of the avatar's skin, e₀ carried along from the tick before;  slip: friction.hpp
//   sticks:  T = k e + b (e - e₀)                                while |T| <= μₛ N
//   slides:  T = B ê,  ê = e/|e|,  B = μ N                       and then the skin is sheared by what T shears it
//
// T is the tangential force on the beam.  With the avatar held, -slip is how the touched point of the beam moves along the surface, so T
// is work-conjugate to it, and a force field of its own for each mode:  ∂T/∂e = k + b,  or (B/l)(1 - d dᵀ), with d and l what ê and |e|
// were thought to be.  That is symmetric.  After each linear solve d turns to the direction of T, and l becomes d · e: Newton's method for
// d × e = 0, which has no kink where the slip turns back.  N in B is that of the iteration before (friction_bound.hpp): what is not
// symmetric about Coulomb's law is left to the iteration.  Whether the contact sticks or slides is decided where an equilibrium of the one was
// found (settled()), so that Newton's method meets no kink.
// Real-time: noexcept, no allocation, O(1).   Source: return mapping, Simo and Laursen 1992; given bounds, Nečas and others 1980;
// direction and force as unknowns of their own, Chan, Golub and Mulet 1999.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include <hapbeam/fem/contact/friction_bound.hpp>
#include <hapbeam/friction.hpp>

namespace hapbeam::detail {

template <typename Scalar, int D>
class FrictionLaw {
 public:
  using Vector = VectorOf<Scalar, D>;
  using Matrix = Eigen::Matrix<Scalar, D, D>;
  using Place = FrictionPlace<Scalar, D>;
  using State = FrictionState<Scalar, D>;

  /// Force and direction are as exact as that, in units of the bound.  In space the tolerance of an equilibrium leaves more of a short slip.
  static constexpr Scalar exact =
      (std::max)(Scalar(D == 2 ? 1e-6 : 2e-4), 8 * std::numeric_limits<Scalar>::epsilon());
  /// Where that was not reached within most_tries equilibria, an error that large is no answer any more.
  static constexpr Scalar loose = Scalar(0.1);
  /// Linear solves in which an equilibrium that is near is found.  In space the bound follows within them.
  static constexpr int most_solves = D == 2 ? 6 : 16;

  /// @param first  where the two would touch before the beam yields: where a touch begins
  /// @param stretch  |dr/ds| of the beam there: within a tick it hardly changes
  /// @param alone  whether no other contact has a share in the normal force
  /// @param reach  [m] from the avatar's axis to the centreline   @param stiffest  [N/m] that the scalar allows
  /// @param hurry  [m] a long way for a tick   @param normal_force  [N] of the last tick
  void begin(const FrictionState<Scalar, D>& state, bool alone, const Place& first, Scalar stretch,
             Scalar reach, Scalar stiffest, Scalar hurry, Scalar normal_force) noexcept {
    known_ = state.known;
    before_ = state.known ? Place(state) : first;
    stretch_ = stretch, reach_ = reach;
    skin_ = state.skin;
    stiffness_ = (std::min)(state.stiffness, stiffest);
    damping_ = (std::min)(state.damping, stiffest);
    sticking_ = state.sticking, sliding_ = state.sliding;
    bound_.begin(sliding_, normal_force, state.gain, D == 2 && alone);
    now_ = first;
    shear();
    // A hand that hurries slides: what stuck to it would be torn along.
    far_shear_ = sheared_;
    const Scalar carried = norm(sheared_ - carried_);
    const bool hurries = carried > hurry;
    const bool goes_on = (state.slides || hurries) && bound_.next() > 0;
    // In its first tick a contact slides without friction to where the touch begins.
    mode_ = !known_ ? Mode::falls : goes_on ? Mode::slides : Mode::sticks;
    if (slides() && state.slides) bound_.go_on(state.rise);
    if (slides()) aim(sheared_, (std::max)(norm(sheared_), state.slip));
    last_force_ = state.slides ? state.force : Vector(Vector::Zero());
    if (falls()) bound_.set(0);
    slid_ = slides(), stuck_ = !slides();
    tries_ = 0;
  }

  /// Where this is a copy of that of another place: it has come along with that.
  void begin_beside(const Place& here) noexcept {
    for (Vector* way : {&before_.normal, &before_.along}) {
      const Scalar out = way->dot(now_.normal);
      *way = out * here.normal + here.carried(*way - out * now_.normal, now_);
    }
    before_.s += here.s - now_.s, before_.ahead += here.ahead - now_.ahead;
    now_ = here;
    tries_ = 0;
  }

  /// The hand goes on as it went.  So does what slid, though the beam may go farther than the hand: over a peg by twice its way.
  void go_on() noexcept {
    if (slides() && !last_force_.isZero(0)) direction_ = last_force_;
  }
  /// To be called where the beam has moved.
  void look(const Place& now) noexcept {
    now_ = now;
    shear();
    act();
  }
  /// T [N]
  const Vector& force() const noexcept { return force_; }
  /// ∂T/∂e [N/m], across the normal.
  Matrix tangent() const noexcept {
    Matrix t = Matrix::Identity() - now_.normal * now_.normal.transpose();
    if (!slides()) return (stiffness_ + damping_) * t;
    const Vector d = across(direction_);
    return aside(bound_.next()) * (t - d * d.transpose());
  }
  /// In a plane that is a number.
  Scalar stiffness() const noexcept { return slides() ? Scalar(0) : stiffness_ + damping_; }
  /// [J]
  Scalar potential() const noexcept {
    if (!slides())
      return (stiffness_ + damping_) / 2 * sheared_.squaredNorm() - damping_ * carried_.dot(sheared_);
    return (force_.dot(sheared_) + bound_.next() * across(direction_).dot(sheared_)) / 2;
  }

  /// To be called after each linear solve.  @param normal_force  of it [N]
  void feel(Scalar normal_force) noexcept {
    bound_.use();
    if (mode_ == Mode::slides) bound_.follow(normal_force);
  }

  /// The beam falls.  What slides does that without friction, and the touch begins anew where it arrives; what sticks goes along.
  void fall() noexcept {
    if (!slides()) return;
    mode_ = Mode::falls;
    bound_.set(0);
  }

  /// To be called where an equilibrium was found, after look().  @param normal_force  of it [N]
  /// @return whether it is one of Coulomb's law, too; else one has to be found anew
  bool settled(Scalar normal_force) noexcept {
    const Vector elastic = (stiffness_ + damping_) * sheared_ - damping_ * carried_;
    const Scalar size = norm(elastic), most = sliding_ * (std::max)(normal_force, Scalar(0));
    // What pulls while it sticks may press where it slides.
    const bool pulls = !(normal_force > 0);
    if (falls() || ++tries_ > most_tries) return true;
    if (pulls && (slides() ? !(bound_.used() > 0) : !(size > 0))) return true;
    torn_ = false;
    // What pulls has no friction.  With that of the last tick, or with none, it may press.
    if (pulls && slides()) {
      torn_ = true;
      bound_.leap(bound_.before() < bound_.used() ? bound_.before() : Scalar(0), true);
      aim(far_shear_, norm(far_shear_));
      return false;
    }
    if (!slides()) {
      if (!pulls && size <= (1 + exact) * sticking_ * normal_force) return true;
      mode_ = Mode::slides, slid_ = true;
      torn_ = pulls || size > 2 * sticking_ * normal_force;
      // From afar the last bound says more than what sticks there.
      bound_.leap(torn_ && bound_.before() > 0 ? bound_.before() : most, torn_);
      aim(elastic, norm(far_shear_));
      return false;
    }
    const Vector d = across(direction_);
    // One that has stopped sticks.  With one coefficient for both that makes no difference.  What a bound stops that was too large slides on.
    const Scalar stopped = sticking_ > sliding_ ? 1 + exact : 1 - exact;
    if (d.dot(elastic) < (std::min)(bound_.used(), most) * stopped) {
      mode_ = Mode::sticks;
      return false;
    }
    bound_.see(normal_force);
    const Scalar off = (elastic * (most / size) - acting()).norm();
    if (off <= exact * most) return true;
    bound_.approach(most);
    return false;
  }

  /// Whether it sticks, and by more than it can.  @param normal_force  of an equilibrium, after look() [N]
  bool holds_too_much(Scalar normal_force) const noexcept {
    return !slides() &&
           !(force_.squaredNorm() <= squared((1 + exact) * sticking_ * (std::max)(normal_force, Scalar(0))));
  }
  bool slides() const noexcept { return mode_ != Mode::sticks; }
  /// T of an equilibrium, after look() [N]
  Vector acting() const noexcept { return slides() ? force_at(bound_.used()) : force_; }
  /// What it can hold as it begins to slide, by the last tick [N].
  Scalar last_bound() const noexcept { return bound_.before(); }
  /// Whether it slides without friction.
  bool falls() const noexcept { return mode_ == Mode::falls; }
  /// To be called where no equilibrium is near.  A hand that pushes a beam along itself has no end of force while it sticks, and a beam that
  /// hardly slides has none while it slides: each way is tried once.
  /// Without friction it is tried most_tries times at most.
  /// @return whether there is another way to try; else it slides
  bool turn() noexcept {
    torn_ = true;
    // A bound that follows what Newton's method is far from leads it astray.  In space that has taken too many solves for another try.
    const bool may_hold = D == 2 && mode_ == Mode::slides && !bound_.held();
    bound_.start(true);
    if (may_hold) {
      bound_.hold();
      return true;
    }
    if (mode_ == Mode::slides && !stuck_) {
      mode_ = Mode::sticks, stuck_ = true;
      return true;
    }
    // What sticks where no other way leads may be found from where it slides without friction.
    const bool freely = D == 2 && !falls() && stuck_ && bound_.used() > 0 && ++tries_ < most_tries,
               another = !slides() && !slid_;
    if (!slides()) mode_ = Mode::slides;
    slid_ = true;
    bound_.set(falls() || freely ? Scalar(0) : bound_.before());
    aim(far_shear_, norm(far_shear_));
    return another || freely;
  }
  /// Whether what was found is far: the way from there is long, and leads from the state before the push.
  bool torn() const noexcept { return torn_; }

  /// What the touch remembers of it.  @param normal_force  [N]
  void leave(FrictionState<Scalar, D>& state, Scalar normal_force) const noexcept {
    const Vector elastic = (stiffness_ + damping_) * sheared_ - damping_ * carried_;
    const Scalar size = norm(elastic),
                 most = (slides() ? sliding_ : sticking_) * (std::max)(normal_force, Scalar(0));
    const bool slid = size > most;
    const Vector before = now_.carried(state.force, before_);
    const bool falls_or_slides = state.slides || sticking_ > sliding_;
    state.force = slid ? Vector(elastic * (most / size)) : elastic;
    state.skin = slid ? Vector((state.force + damping_ * carried_) / (stiffness_ + damping_)) : sheared_;
    state.slip = norm(sheared_);
    // The sum of ½ (T before + T) · slip of all contacts is the work of the hands by trapezoids less the energy of the beam, where that is
    // quadratic, whatever happens within the tick: so it is where T falls at once.  What turns back slides with all of its force.
    const Vector mean =
        falls_or_slides && before.dot(state.force) > 0 ? Vector((before + state.force) / 2) : state.force;
    if (!falls())
      state.dissipated += mean.dot(sheared_ - state.skin) + damping_ * (state.skin - carried_).squaredNorm();
    if (falls()) state.force.setZero(), state.skin.setZero();
    const bool goes_on = state.slides;
    state.known = true;
    state.slides = mode_ == Mode::slides;
    state.rise = goes_on && state.slides ? most - bound_.before() : Scalar(0);
    // Where the tries have ended before the changes: what acted, and what should have.
    state.settled =
        tries_ <= most_tries || falls() || (slides() ? norm(state.force - acting()) <= loose * most : !slid);
    static_cast<Place&>(state) = now_;
    state.gain = bound_.gain();
  }
  /// Energy of the skin of a touch, after leave() [J]
  Scalar held(const State& state) const noexcept { return stiffness_ / 2 * state.skin.squaredNorm(); }

 private:
  static constexpr int most_tries = 8;

  void shear() noexcept {
    carried_ = now_.carried(skin_, before_);
    sheared_ = carried_ + now_.slip(before_, stretch_, reach_);
  }

  static Scalar squared(Scalar x) noexcept { return x * x; }
  static Scalar norm(const Vector& v) noexcept { return std::sqrt(v.squaredNorm()); }
  Vector across(const Vector& v) const noexcept {
    const Vector flat = v - now_.normal * now_.normal.dot(v);
    const Scalar size = norm(flat);
    return size > 0 ? Vector(flat / size) : now_.along;
  }
  void aim(const Vector& direction, Scalar length) noexcept {
    direction_ = direction;
    length_ = (std::max)(length, Scalar(0));
  }
  void act() noexcept {
    if (!slides()) {
      force_ = (stiffness_ + damping_) * sheared_ - damping_ * carried_;
    } else {
      if (D == 3) follow();
      force_ = force_at(bound_.next());
    }
  }
  void lengthen() noexcept { length_ = (std::max)(across(direction_).dot(sheared_), length_ / 8); }
  void follow() noexcept {
    const Vector turned = force_at(bound_.next());
    if (turned.squaredNorm() > 0) direction_ = turned;
    lengthen();
  }
  /// Stiffness across the way of sliding [N/m].
  Scalar aside(Scalar bound) const noexcept {
    const Scalar whole = stiffness_ + damping_;
    return !(bound > 0) ? Scalar(0) : bound < whole * length_ ? bound / length_ : whole;
  }
  Vector force_at(Scalar bound) const noexcept {
    const Vector d = across(direction_);
    return bound * d + aside(bound) * (sheared_ - d * d.dot(sheared_));
  }
  enum class Mode {
    sticks,
    slides,
    falls,  ///< slides without friction
  };
  Mode mode_ = Mode::sticks;
  bool known_ = false, torn_ = false;
  bool slid_ = false, stuck_ = false;  // ways that were tried
  Place before_, now_;
  Vector skin_ = Vector::Zero(), carried_ = Vector::Zero(), sheared_ = Vector::Zero();
  Vector force_ = Vector::Zero(), direction_ = Vector::Zero(), far_shear_ = Vector::Zero();
  Vector last_force_ = Vector::Zero();  // [N] of the tick before, while it slid
  Scalar stretch_ = 1, reach_ = 0, stiffness_ = 0, damping_ = 0, sticking_ = 0, sliding_ = 0, length_ = 1;
  FrictionBound<Scalar, most_solves> bound_;
  int tries_ = 0;
};

}  // namespace hapbeam::detail
