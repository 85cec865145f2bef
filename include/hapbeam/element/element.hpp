// SPDX-License-Identifier: MIT
// The contract of an element: strain energy V(d), residual and tangent of six degrees of freedom.
//
//   d = [u1, w1, θ1, u2, w2, θ2]  [m, m, rad, m, m, rad]   θ = -dw/dx
//
//   expression                 type     promise
//   ------------------------   ------   -------------------------------------------------------
//   E::energy(p, d)            S        V(d) [J]
//   E::residual(p, d, r)       void     r = ∂V/∂d, overwritten [N, N, N·m, N, N, N·m]
//   E::tangent(p, d, r, K)     S        V, r as above and K = ∂r/∂d, symmetric, both triangles, overwritten
//   E::name()                  const char*
//   E::any_rotation            bool, optional, true: valid at finite rotation
//   E::tapers                  bool, optional, true: takes beams whose section changes or that shear, p.taper11 and the like
//   E::membrane_feels_slope    bool, optional, true: ε contains ½ w'², so an axial load on the element bends it
//   E::ExactUnderTension       type, optional, E itself: a prismatic element without load solves the equations of moderate rotation
//                              exactly, so that any number of elements gives the same answers.  A class derived from E does not
//                              have it: there the name is E's, not its own
//   E::Abreast                 type, optional, E itself: E::respond(p, d) takes detail::Pack<S> for S, too, so that a few elements are
//                              computed side by side
//   E::respond(p, d, tension)  CoreResponse<S>, optional, beside E::Abreast: the element's tension is an unknown of its own, an OwnTension<S>
//
// with p an ElementProperties<S>.  An element is stateless: static functions, templated on the scalar S.
// Real-time: no allocation, noexcept, O(1).
#pragma once

#include <iterator>
#include <type_traits>

#include <Eigen/Core>

#include <hapbeam/force_model.hpp>

namespace hapbeam {

template <typename Scalar>
using Vector6 = Eigen::Matrix<Scalar, 6, 1>;
template <typename Scalar>
using Matrix6 = Eigen::Matrix<Scalar, 6, 6>;

/// Length and stiffness of an element.  Quotients are stored, because a division in a tick is slow.
template <typename Scalar>
struct ElementProperties {
  ElementProperties() = default;
  /// @param element_length l [m]   @param EA [N]   @param EI [N·m²]
  ElementProperties(Scalar element_length, Scalar EA, Scalar EI) noexcept
      : length(element_length),
        inverse_length(1 / element_length),
        axial_stiffness(EA),
        axial_per_length(EA * inverse_length),
        bending_per_length3(EI * inverse_length * inverse_length * inverse_length) {}

  Scalar length = 0;               ///< l [m]
  Scalar inverse_length = 0;       ///< 1/l [1/m]
  Scalar axial_stiffness = 0;      ///< EA [N]
  Scalar axial_per_length = 0;     ///< EA/l [N/m]
  Scalar bending_per_length3 = 0;  ///< EI/l³ [N/m]
  Scalar natural_a = 0;            ///< l times the rotation of end 1 against the chord that bends nothing [m]
  Scalar natural_b = 0;            ///< the same at end 2 [m]
  Scalar natural_stretch = 0;      ///< the natural shape's chord less l [m]
  /// What a section that changes, or shears, adds to 4, 2 and 4 EI/l³, for Tapered alone [N/m].
  Scalar taper11 = 0, taper12 = 0, taper22 = 0;
};

/// Strains of one element in coordinates that a rigid translation does not change.
template <typename S>
struct Deformation {
  S stretch;  ///< u2 - u1, less that of the natural shape [m]
  S rise;     ///< w2 - w1 [m]
  S a;        ///< l θ1 + rise: minus the slope against the chord at node 1, times l [m]
  S b;        ///< l θ2 + rise: the same at node 2 [m]
  S chord =
      S(0);  ///< 1 where it is seen along the chord, which turns and is as long as the element is stretched

  Deformation(const ElementProperties<S>& p, const Vector6<S>& d) noexcept
      : stretch(d[3] - d[0] - p.natural_stretch),
        rise(d[4] - d[1]),
        a(p.length * d[2] + rise),
        b(p.length * d[5] + rise) {}

  /// Seen along the chord, which does not rise.
  Deformation(S stretch_, S a_, S b_) noexcept : stretch(stretch_), rise(0), a(a_), b(b_), chord(1) {}
};

/// Symmetric second derivatives in the coordinates (stretch, rise, lθ1, lθ2) [N/m].
template <typename S>
struct CoreTangent {
  S ss, sr, s1, s2, rr, r1, r2, t11, t12, t22;
};

/// Energy and its derivatives in the coordinates (stretch, rise, lθ1, lθ2): the core of a residual and a tangent.
template <typename S>
struct CoreResponse {
  S energy;          ///< [J]
  S s, r, t1, t2;    ///< [N]
  CoreTangent<S> k;  ///< [N/m]
};

/// The tension of an element as an unknown of its own, N: its energy V(d) is that of Π(d, N) where ∂Π/∂N = 0.  Condensed in the tangent,
/// N follows the nodes by Newton's method, one evaluation an iteration:
///   ΔN = missing + s Δstretch + r Δrise + t1 Δ(lθ1) + t2 Δ(lθ2)
template <typename S>
struct OwnTension {
  S normal = 0;    ///< N [N]
  S missing;       ///< by which it is off where the nodes are [N]
  S lack;          ///< the same as a stretch, ∂Π/∂N [m]
  S s, r, t1, t2;  ///< how it follows them [N/m]
  S turning = 1;   ///< share of what is missing that turns with the chord, 0: near an equilibrium
};

namespace detail {

/// l² times the mean of w'² in the natural shape, (2 a0² - a0 b0 + 2 b0²)/15 [m²].
template <typename S>
[[gnu::always_inline]] inline S natural_mean_square(const ElementProperties<S>& p) noexcept {
  const S &a = p.natural_a, &b = p.natural_b;
  return (2 * (a * a + b * b) - a * b) * S(1. / 15);
}

/// Residual from its core: ∂V/∂(stretch, rise, lθ1, lθ2) [N].
template <typename S>
[[gnu::always_inline]] inline void expand(const ElementProperties<S>& p, S s, S r, S t1, S t2,
                                          Vector6<S>& residual) noexcept {
  residual = Vector6<S>(-s, -r, p.length * t1, s, r, p.length * t2);
}

/// Six by six from its core: node 1 enters stretch and rise with -1, node 2 with +1, rotations with l.
template <typename S>
[[gnu::always_inline]] inline void expand(const ElementProperties<S>& p, const CoreTangent<S>& c,
                                          Matrix6<S>& K) noexcept {
  const S l = p.length, ll = l * l;
  const S s1 = l * c.s1, s2 = l * c.s2, r1 = l * c.r1, r2 = l * c.r2;
  // Entry by entry, which stays in registers: an array that is copied goes through memory.  Eigen's comma initializer would check
  // what cannot fail, and is not inlined.
  const auto put = [&K](int i, int j, S value) { K.coeffRef(i, j) = K.coeffRef(j, i) = value; };
  put(0, 0, c.ss), put(1, 0, c.sr), put(2, 0, -s1), put(3, 0, -c.ss), put(4, 0, -c.sr), put(5, 0, -s2);
  put(1, 1, c.rr), put(2, 1, -r1), put(3, 1, -c.sr), put(4, 1, -c.rr), put(5, 1, -r2);
  put(2, 2, ll * c.t11), put(3, 2, s1), put(4, 2, r1), put(5, 2, ll * c.t12);
  put(3, 3, c.ss), put(4, 3, c.sr), put(5, 3, s2);
  put(4, 4, c.rr), put(5, 4, r2);
  put(5, 5, ll * c.t22);
}

/// Whether Op<E> is a type, and a true one.
template <template <class...> class Op, class E, bool Valid = offers<Op, E>>
inline constexpr bool is_true = false;
template <template <class...> class Op, class E>
inline constexpr bool is_true<Op, E, true> = Op<E>::value;

template <class T>
T some() noexcept;
template <class E, typename S, typename P = const ElementProperties<S>&, typename D = const Vector6<S>&>
using Contract = std::enable_if_t<noexcept(E::energy(some<P>(), some<D>()))&& noexcept(E::residual(
                                      some<P>(), some<D>(),
                                      some<Vector6<S>&>()))&& noexcept(E::tangent(some<P>(), some<D>(),
                                                                                  some<Vector6<S>&>(),
                                                                                  some<Matrix6<S>&>())),
                                  decltype(E::name())>;
template <class L, typename S, typename P = const ElementProperties<S>&, typename D = const Deformation<S>&>
using Responds =
    std::enable_if_t<noexcept(L::respond(some<P>(), some<D>())) &&
                     std::is_same_v<decltype(L::respond(some<P>(), some<D>())), CoreResponse<S>> &&
                     std::is_convertible_v<decltype(L::name()), const char*>>;
template <class E, typename S, class Of>
using RespondsWithTension =
    decltype(E::respond(some<const ElementProperties<S>&>(), some<const Of&>(), some<OwnTension<S>&>()));
template <class E>
using TurnsFar = std::bool_constant<E::any_rotation>;
template <class E>
using GoesAbreast = std::is_same<typename E::Abreast, E>;
template <class E>
using TakesTaper = std::bool_constant<E::tapers>;
template <class E>
using FeelsSlope = std::bool_constant<E::membrane_feels_slope>;
template <class E>
using IsExact = std::is_same<typename E::ExactUnderTension, E>;
template <class E>
using Contacts = std::integral_constant<int, E::contacts>;

template <class E>
inline constexpr bool tapers = is_true<TakesTaper, E>;
template <class E>
inline constexpr bool membrane_feels_slope = is_true<FeelsSlope, E>;

template <class E>
constexpr int most_contacts() noexcept {
  if constexpr (offers<Contacts, E>) return E::contacts;
  else return 1;
}

}  // namespace detail

/// True where L has what an element needs of its membrane policy, and an element of finite rotation of its local element:
///   `L::respond(const ElementProperties<S>&, const Deformation<S>&) noexcept -> CoreResponse<S>`,   `L::name() -> const char*`
template <typename L, typename S>
inline constexpr bool responds_to_deformation = detail::offers<detail::Responds, L, S>;

/// Functions that run once an element and iteration are [[gnu::always_inline]], here and in the elements. Without it
/// g++ -O2 calls them, their results go through memory and take a quarter of the tick.
///
/// Base class of an element E with
///   `E::respond(p, d) -> CoreResponse<S>`,   of the displacements d or of the Deformation that they make.
/// It derives energy, residual and tangent of the contract above. E inherits from ElementFromCore<E>.
template <class E>
struct ElementFromCore {
  template <typename S>
  static S energy(const ElementProperties<S>& p, const Vector6<S>& d) noexcept {
    return core(p, d).energy;
  }
  template <typename S>
  static void residual(const ElementProperties<S>& p, const Vector6<S>& d, Vector6<S>& r) noexcept {
    const CoreResponse<S> c = core(p, d);
    detail::expand(p, c.s, c.r, c.t1, c.t2, r);
  }
  template <typename S>
  [[gnu::always_inline]] static S tangent(const ElementProperties<S>& p, const Vector6<S>& d, Vector6<S>& r,
                                          Matrix6<S>& K) noexcept {
    return tangent(p, core(p, d), r, K);
  }
  /// The same from what respond() has answered.
  template <typename S>
  [[gnu::always_inline]] static S tangent(const ElementProperties<S>& p, const CoreResponse<S>& c,
                                          Vector6<S>& r, Matrix6<S>& K) noexcept {
    detail::expand(p, c.s, c.r, c.t1, c.t2, r);
    detail::expand(p, c.k, K);
    return c.energy;
  }

  /// What energy, residual and tangent are made of.
  template <typename S>
  [[gnu::always_inline]] static CoreResponse<S> core(const ElementProperties<S>& p,
                                                     const Vector6<S>& d) noexcept {
    if constexpr (responds_to_deformation<E, S>) return E::respond(p, Deformation<S>(p, d));
    else return E::respond(p, d);
  }
  /// The same where its tension is an unknown of its own.
  template <typename S>
  [[gnu::always_inline]] static CoreResponse<S> core(const ElementProperties<S>& p, const Vector6<S>& d,
                                                     OwnTension<S>& tension) noexcept {
    if constexpr (responds_to_deformation<E, S>) return E::respond(p, Deformation<S>(p, d), tension);
    else return E::respond(p, d, tension);
  }
};

/// True where E is declared valid at finite rotation.
template <class E>
inline constexpr bool any_rotation = detail::is_true<detail::TurnsFar, E>;

/// True where a few elements E are computed side by side.
template <class E>
inline constexpr bool goes_abreast = detail::is_true<detail::GoesAbreast, E>;

/// True where E, or a membrane policy, is exact under a tension that is constant along it.
template <class E>
inline constexpr bool exact_under_tension = detail::is_true<detail::IsExact, E>;

/// True where the tension of an element, or of a membrane policy, is an unknown of its own.
template <class E>
inline constexpr bool has_own_tension =
    goes_abreast<E> && (detail::offers<detail::RespondsWithTension, E, double, Deformation<double>> ||
                        detail::offers<detail::RespondsWithTension, E, double, Vector6<double>>);

/// An element of beams that may be touched at several places at once, as FemModel<Several<Corotational<>, 3>>.
/// @tparam Contacts  the most of them
template <class Element, int Contacts>
struct Several : Element {
  static_assert(any_rotation<Element>,
                "Several<Element, Contacts>: Element must be valid at finite rotation");
  static_assert(Contacts >= 1, "Several<Element, Contacts>: Contacts must be 1 or more");
  static constexpr int contacts = Contacts;
  using Abreast = std::conditional_t<goes_abreast<Element>, Several, void>;
};

/// At how many places a beam of such elements may be touched: 1, unless it says so.
template <class E>
inline constexpr int contacts_of = detail::most_contacts<E>();

/// True where E fulfils the contract above for scalar S, every noexcept included.
template <typename E, typename S>
inline constexpr bool is_element = detail::offers<detail::Contract, E, S>;

}  // namespace hapbeam
