// SPDX-License-Identifier: MIT
// The contract that every beam model fulfils, and the small types that cross it.
//
// A ForceModel answers one question: the centreline is displaced by d at arc position s; which force and which shape
// result? Contact, haptics, tests and charts are written against this file, never against a particular model.
//
//   expression           type                   promise
//   ------------------   --------------------   ---------------------------------------------------------
//   typename M::Scalar   float or double
//   m.press(p)           Response<Scalar>       noexcept, no allocation, bounded work, finite force
//   m.shape()            Centreline<Scalar>     noexcept; view of the last press, valid until the next call
//   m.range()            Range<Scalar>          noexcept; where press() answers with Status::ok
//   m.thickness()        Scalar [m]             noexcept; what contact adds on either side of the centreline
//   m.reset()            void                   noexcept; back to the shape that the beam has untouched
//
// A model of finite rotation says at how many places it may be touched, `static constexpr int contacts`, and offers two more, which contact then
// calls instead of press() and reset():
//
//   m.push(o, n)         Status                 of n Obstacle<Scalar, dimension>, in and out; promises as press()
//   m.release()          Status                 noexcept, bounded; without contact the beam goes from its present shape to
//                                               equilibrium.  That may be another equilibrium than before (snapped),
//                                               and may take several calls (iteration_limit)
//
// A model in space has `static constexpr int dimension = 3`. It has no press(). Its shape() is a Centreline<Scalar, 3>.
// Its push() takes a Push<Scalar, 3>, too.
//
// A model with mass has no press(). It goes on by a time, with a hand that holds an avatar by its coupling:
//
//   m.step(dt, h)        Pushed<Scalar>         of a Coupled<Scalar>; promises as press(); dt [s]; in space as push()
//   m.energy()           with sum() [J]         noexcept; of motion, strain and loads
//
// A model whose shape costs more than its force may offer a part of the shape, for a lasting contact:
//
//   m.part(s0, s1)       CentrelinePart<Scalar> noexcept; the pieces of shape() that hold arc positions s0 to s1, both
//                                               pieces of a node at either; valid until the next call
//
// Cost of shape() and part(): FemModel has its nodes from the press, O(1) and O(log n). Trained models have the two
// pieces beside the contact from it, and compute all others on demand, O(modes (grid + nodes)).
// After a press with ok a centreline of moderate rotation does not turn back: x = s + u increases along it.
// A model states the bound on its work: FemModel solves at most solver.max_solves (48) linear systems a call.
//
// No allocation, no exception, no dependency but the standard library.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <type_traits>
#include <utility>

#include <hapbeam/centreline.hpp>
#include <hapbeam/rod_centreline.hpp>

namespace hapbeam {

/// How a computation ended.  Negative: the answer is not the requested one and must not be trusted.
/// Positive: the answer holds, for a request that was moved into the model's range or continued from there.
enum class Status : std::int8_t {
  ok = 0,
  /// The request lies outside range(). Force and shape are those of the nearest request inside it, or continue from
  /// there as the model states, without a smaller force.
  out_of_range = 1,
  /// The equilibrium of the beam has ended or become unstable. Force and shape are those of the stable one to which the beam has jumped.
  snapped = 2,
  /// s or d is not finite, or s lies off the beam (s < 0 or s > L): force 0, the state is kept.
  invalid_request = -1,
  /// The iteration budget ended with the estimated next increment above the tolerance. In press() and push() the force
  /// is that of the last equilibrium on the way, which may be the last answer. The next call continues from there.
  iteration_limit = -2,
  /// A pivot of the tangent is below round-off: |p| <= eps |k| with k its diagonal entry.  The last good state is kept.
  singular = -3,
  /// A displacement or force is NaN or infinite.  The last good state is kept.
  non_finite = -4,
};

/// True where force and shape may be used: ok, or a positive status.
constexpr bool is_answer(Status status) noexcept { return static_cast<int>(status) >= 0; }

/// One is worse than another: failures before answers that were moved into range, those before ok.
constexpr bool worse(Status a, Status b) noexcept {
  const auto rank = [](Status s) { return is_answer(s) ? static_cast<int>(s) : 100 - static_cast<int>(s); };
  return rank(a) > rank(b);
}

constexpr const char* name(Status status) noexcept {
  switch (status) {
    case Status::ok: return "ok";
    case Status::out_of_range: return "out_of_range";
    case Status::snapped: return "snapped";
    case Status::invalid_request: return "invalid_request";
    case Status::iteration_limit: return "iteration_limit";
    case Status::singular: return "singular";
    case Status::non_finite: return "non_finite";
  }
  return "unknown";
}

/// A prescribed transverse displacement of the centreline.
template <typename Scalar>
struct Press {
  Scalar s;  ///< [m] arc position along the undeformed beam, 0 at the left end
  Scalar d;  ///< [m] displacement w(s) from the x axis; either sign
};

/// A frictionless plane that the centreline touches at one point: there its displacement along n is d, and the force
/// acts along n.
/// @tparam D  of the space in which the model bends: 2 | 3
template <typename Scalar, int D = 2>
struct Push {
  Scalar s;                    ///< [m] arc position of the point
  Scalar d;                    ///< [m] n · (u, w) at s; in space n · r
  VectorOf<Scalar, D> normal;  ///< n, unit
};

/// A frictionless circle that the centreline touches at one point, which is part of the answer.
template <typename Scalar>
struct Circle {
  Scalar s;                                          ///< [m] arc position beside which the point is sought
  Vector2<Scalar> centre = Vector2<Scalar>::Zero();  ///< [m]
  Scalar reach;  ///< [m] radius of the circle, from its centre to the centreline
  Scalar side;   ///< of the centreline on which the centre lies: +1 left of its direction, -1
};

/// A frictionless capsule, or a sphere, that the centreline of a rod touches at one point, which is part of the answer.
template <typename Scalar>
struct Capsule {
  Scalar s;            ///< [m] arc position beside which the point is sought
  Shaft<Scalar> axis;  ///< of the capsule; a sphere's is a point
  Scalar reach;        ///< [m] from the axis to the centreline
  /// About from the centreline to the axis, unit: from where the capsule has come.
  VectorOf<Scalar, 3> normal{0, 0, 0};
};

template <typename Scalar>
bool is_finite(const Circle<Scalar>& circle) noexcept {
  return circle.centre.allFinite() && std::isfinite(circle.reach);
}
template <typename Scalar>
bool is_finite(const Capsule<Scalar>& capsule) noexcept {
  return capsule.axis.tip.allFinite() && capsule.axis.way.allFinite() && capsule.normal.allFinite() &&
         std::isfinite(capsule.reach);
}

/// The result of a press.
template <typename Scalar>
struct Response {
  Scalar force;   ///< [N] force on the beam along the direction of d; the hand feels -force.  Always finite.
  Status status;  ///< whether force belongs to the request
};

/// The result of a push by a circle or a capsule, and where they touch.
template <typename Scalar, int D = 2>
struct Pushed {
  Scalar force;   ///< [N] on the beam along the normal; negative where the circle pushes.  Always finite.
  Status status;  ///< as Response::status
  bool past_end = false;  ///< they touch at an end of the beam, which the centre has passed
  Scalar s = 0;           ///< [m] arc position of the point
  VectorOf<Scalar, D> point = VectorOf<Scalar, D>::Zero();   ///< [m] of the centreline
  VectorOf<Scalar, D> normal = VectorOf<Scalar, D>::Zero();  ///< unit, from there to the centre
};

namespace detail {

/// What contact asks of a model that can be pushed: the point of contact is found by the model.
template <typename Scalar, int D>
using RoundOf = std::conditional_t<D == 2, Circle<Scalar>, Capsule<Scalar>>;

}  // namespace detail

template <typename Scalar, int D = 2>
struct FrictionState;

/// A hand that holds an avatar by its coupling, a spring and a damper.
template <typename Scalar, int D = 2>
struct Coupled {
  detail::RoundOf<Scalar, D> hand;               ///< where the avatar would be without the beam
  Scalar stiffness = 1000;                       ///< K [N/m], positive
  Scalar damping = 0;                            ///< B [N·s/m], not negative
  FrictionState<Scalar, D>* friction = nullptr;  ///< of the avatar (friction.hpp), in and out; null: none
};

/// What a body does to a beam that it touches.
enum class ObstacleKind : std::int8_t {
  round,    ///< a round body pushes it away, wherever they touch
  stop,     ///< one place of the beam goes no farther than d along a direction
  support,  ///< one place of the beam is held at d along a direction, pushed and pulled
};

/// One of several bodies that may touch a beam, and its contact in a push.
template <typename Scalar, int D = 2>
struct Obstacle {
  ObstacleKind kind = ObstacleKind::round;
  detail::RoundOf<Scalar, D> round{};  ///< with s where they touched, or are nearest
  /// Of a stop or a support; its normal points out of the beam to the stop.
  Push<Scalar, D> place{0, 0, VectorOf<Scalar, D>::Zero()};
  int body = 0;           ///< round obstacles of one body have the same number: it touches at as many places
  bool valid = false;     ///< there is one
  bool touching = false;  ///< in: in the push before;  out: now
  Pushed<Scalar, D> pushed{0, Status::ok};  ///< in: of the push before;  out: no force where they are apart
  FrictionState<Scalar, D>* friction = nullptr;  ///< of a round one (friction.hpp), null: without
};

template <typename Scalar, int D>
bool is_finite(const Obstacle<Scalar, D>& obstacle) noexcept {
  if (obstacle.kind == ObstacleKind::round)
    return is_finite(obstacle.round) && std::isfinite(obstacle.round.s);
  const Push<Scalar, D>& place = obstacle.place;
  return std::isfinite(place.s) && std::isfinite(place.d) && place.normal.allFinite();
}

/// The result of holding an end of a rod.
template <typename Scalar>
struct HeldEnd {
  VectorOf<Scalar, 3> force;   ///< [N] on the rod; the hand feels -force.  Always finite.
  VectorOf<Scalar, 3> moment;  ///< [N·m] on the rod, about the end
  Status status;
};

/// A damper beside the springs of an end: B/T as a part of their stiffness, with ticks of length T.
struct HoldDamper {
  double place = 0, turning = 0;  ///< 0 to 1, 1 excluded; 0: none
  double period = 1;              ///< T [s]
};

/// Where a model answers with Status::ok: s_min <= s <= s_max and |d| <= depth_at(s).
template <typename Scalar>
struct Range {
  Scalar s_min;          ///< [m]
  Scalar s_max;          ///< [m]
  Scalar depth;          ///< [m] largest |d| anywhere
  Scalar slope;          ///< [-] largest |d| over the distance to a support that holds w
  Scalar left_support;   ///< [m] arc position of that support, -infinity if the left end moves across
  Scalar right_support;  ///< [m] the same at the right, or +infinity

  Scalar depth_at(Scalar s) const noexcept {
    return (std::min)(depth, slope * (std::min)(s - left_support, right_support - s));
  }

  /// The nearest request inside: s first, then d.
  Press<Scalar> nearest(const Press<Scalar>& press) const noexcept {
    const Scalar s = std::clamp(press.s, s_min, s_max), limit = depth_at(s);
    return {s, std::clamp(press.d, -limit, limit)};
  }
};

namespace detail {

// Signatures alone, to be called with null pointers: what takes them is offered.
template <typename M, typename S = typename M::Scalar, int D = dimension_of<M>>
auto as_model(M* m, const M* seen)
    -> std::bool_constant<noexcept(m->reset()) && noexcept(seen->shape()) && noexcept(
                              seen->range()) && noexcept(seen->thickness()) &&
                          std::is_same_v<decltype(seen->shape()), Centreline<S, D>> &&
                          std::is_same_v<decltype(seen->range()), Range<S>> &&
                          std::is_same_v<decltype(seen->thickness()), S>>;
template <typename>
std::false_type as_model(...);

template <typename M>
auto as_pressed(M* m, const Press<typename M::Scalar>* p)
    -> std::bool_constant<dimension_of<M> == 2 && noexcept(m->press(*p)) &&
                          std::is_same_v<decltype(m->press(*p)), Response<typename M::Scalar>>>;
template <typename>
std::false_type as_pressed(...);

template <typename M>
auto as_pushed(M* m, const Push<typename M::Scalar, 3>* p)
    -> std::bool_constant<dimension_of<M> == 3 && noexcept(m->push(*p)) && noexcept(m->release()) &&
                          std::is_same_v<decltype(m->push(*p)), Response<typename M::Scalar>>>;
template <typename>
std::false_type as_pushed(...);

/// Whether Call<M…> names a type: that of an expression which M offers, or std::enable_if_t of noexcept calls.
template <template <class...> class Call, typename Void, class... M>
inline constexpr bool is_offered = false;
template <template <class...> class Call, class... M>
inline constexpr bool is_offered<Call, std::void_t<Call<M...>>, M...> = true;
template <template <class...> class Call, class... M>
inline constexpr bool offers = is_offered<Call, void, M...>;

template <typename M>
using PushObstacles = std::enable_if_t<noexcept(std::declval<M&>().release())&& noexcept(
    std::declval<M&>().push(std::declval<Obstacle<typename M::Scalar, dimension_of<M>>*>(), 0))>;
template <typename M>
using Part =
    std::enable_if_t<noexcept(std::declval<const M&>().part(typename M::Scalar(), typename M::Scalar()))>;
template <typename M>
using StepWithHand = std::enable_if_t<noexcept(std::declval<M&>().step(
    typename M::Scalar(), std::declval<const Coupled<typename M::Scalar, dimension_of<M>>&>()))>;

template <typename M>
using ManyContacts = std::enable_if_t<(M::contacts > 1)>;
/// True where several bodies can push M at once.
template <typename M>
inline constexpr bool takes_several = offers<PushObstacles, M>&& offers<ManyContacts, M>;

}  // namespace detail

/// The pieces of the model's shape that hold arc positions s0 to s1.
template <typename M>
CentrelinePart<typename M::Scalar> part_of(const M& model, typename M::Scalar s0,
                                           typename M::Scalar s1) noexcept {
  if constexpr (detail::offers<detail::Part, M>) return model.part(s0, s1);
  else return part_of(model.shape(), s0, s1);
}

/// True where bodies can push M along any direction, noexcept included; M::contacts says how many at once.
template <typename M>
inline constexpr bool takes_push = detail::offers<detail::PushObstacles, M>;

/// True where M has mass, noexcept included.
template <typename M>
inline constexpr bool has_mass = detail::offers<detail::StepWithHand, M>;

/// True where M fulfils the contract above, every noexcept included.
template <typename M>
inline constexpr bool is_force_model = decltype(detail::as_model<M>(nullptr, nullptr))::value &&
                                       (decltype(detail::as_pressed<M>(nullptr, nullptr))::value ||
                                        decltype(detail::as_pushed<M>(nullptr, nullptr))::value);

}  // namespace hapbeam
