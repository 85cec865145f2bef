// SPDX-License-Identifier: MIT
// An element of finite rotation: a local element in a frame that turns with the chord.
//
//   l = |x2 - x1|,  α = angle of the chord (up is positive),  stretch = l - L - that of the natural shape,  θi' = θi + α
//
//   V(d) = V_local(stretch, θ1', θ2')
//   ∂V/∂Δ = N e + (M/l) z                      Δ = (u2 - u1, w2 - w1),  e = (cos α, sin α),  z = (-sin α, cos α)
//   ∂²V/∂Δ² = k_ss eeᵀ + (k_sα/l - M/l²)(ezᵀ + zeᵀ) + (k_αα/l² + N/l) zzᵀ
//
// with N, M the local normal force and the sum of the local moments, k_sα = k_s1 + k_s2 and so on. Residual and tangent
// are the exact derivatives of V. The tangent is therefore symmetric, and rigid motion, several turns included, does no
// work.
// The order in the element's length is that of the local element: two with Linear (the textbooks' element), four with
// VonKarman<AssumedStrain>, whose strain includes that a bent piece is longer than its chord.  VonKarman<StabilityFunctions>
// has no error but that of large rotations against the chord.
// Valid while each end of an element rotates by less than half a turn against its chord.
// Source: Crisfield, Non-linear Finite Element Analysis of Solids and Structures, vol. 1, ch. 7.3; the tangent is
// derived anew.
#pragma once

#include <cmath>
#include <type_traits>

#include <hapbeam/angle.hpp>
#include <hapbeam/centreline.hpp>
#include <hapbeam/element/von_karman.hpp>

namespace hapbeam {

/// @tparam Local  Linear | VonKarman<Membrane> | Tapered<Local>
template <class Local = VonKarman<>>
struct Corotational : ElementFromCore<Corotational<Local>> {
  static_assert(
      responds_to_deformation<Local, double>,
      "a Local element needs static noexcept respond(const ElementProperties<S>&, const Deformation<S>&) -> "
      "CoreResponse<S> and name() -> const char*: see hapbeam/element/corotational.hpp");
  static constexpr bool any_rotation = true;
  using Abreast = std::conditional_t<std::is_same_v<Local, VonKarman<AssumedStrain>> || goes_abreast<Local>,
                                     Corotational, void>;
  static constexpr bool tapers = detail::tapers<Local>;
  static constexpr const char* name() noexcept {
    if constexpr (std::is_same_v<Local, VonKarman<StabilityFunctions>>)
      return "corotational-stability-functions";
    if constexpr (std::is_same_v<Local, Linear>) return "corotational-linear";
    if constexpr (std::is_same_v<Local, VonKarman<FullIntegration>>) return "corotational-full";
    if constexpr (std::is_same_v<Local, VonKarman<ReducedIntegration>>) return "corotational-reduced";
    return "corotational";
  }

  template <typename S>
  [[gnu::always_inline]] static CoreResponse<S> respond(const ElementProperties<S>& p,
                                                        const Vector6<S>& d) noexcept {
    const Chord<S> chord(p, d);
    const CoreResponse<S> q = Local::respond(p, chord.local(p, d));
    return turned(p, chord, q, q.s, S(q.t1 + q.t2));
  }
  /// Nodes that are moved as a linear beam stretch what they turn, by a tension that no load makes and that is missing in N.  Far from an
  /// equilibrium it turns with the chord nevertheless: that keeps the next increment from turning the chord before it is short again.
  template <typename S, class L = Local, std::enable_if_t<has_own_tension<L>, int> = 0>
  [[gnu::always_inline]] static CoreResponse<S> respond(const ElementProperties<S>& p, const Vector6<S>& d,
                                                        OwnTension<S>& tension) noexcept {
    const Chord<S> chord(p, d);
    const CoreResponse<S> q = L::respond(p, chord.local(p, d), tension);
    using detail::larger;
    const S i = 1 / chord.length, c = chord.x * i, s = chord.w * i, both = tension.t1 + tension.t2;
    const CoreResponse<S> core =
        turned(p, chord, q, larger(tension.normal, S(tension.normal + tension.turning * tension.missing)),
               S(q.t1 + q.t2 - tension.lack * both));
    tension.r = tension.s * s + p.length * i * both * c;
    tension.s = tension.s * c - p.length * i * both * s;
    return core;
  }

  /// Change of the chord, x2 - x1 [m], under an increment of the displacements that may be large. The chord turns by
  /// the angle of the increment. Its length is the one at which the normal force is that of the tangent.
  /// Added as vectors, the displacements of a turning chord would stretch it. In a slender beam the forces of that
  /// stretch have nothing to do with the load.
  /// The change is returned, not the chord: a small change keeps its digits.
  /// @param x  increment of d
  template <typename S>
  static Vector2<S> chord_change(const ElementProperties<S>& p, const Vector6<S>& d,
                                 const Vector6<S>& x) noexcept {
    const Turn<S> to(p, d, x);
    const CoreResponse<S> q = Local::respond(p, to.before);
    return lengthened(p, to, S(q.s + q.k.ss * to.extends + q.k.s1 * to.a + q.k.s2 * to.b));
  }
  /// The same where the normal force is known, as that of an unknown is.   @param normal  after the increment [N]
  template <typename S>
  static Vector2<S> chord_change(const ElementProperties<S>& p, const Vector6<S>& d, const Vector6<S>& x,
                                 const S& normal) noexcept {
    return lengthened(p, Turn<S>(p, d, x), normal);
  }

  /// In the frame of the chord.
  template <typename S>
  static Deformation<S> deformation(const ElementProperties<S>& p, const Vector6<S>& d) noexcept {
    return Chord<S>(p, d).local(p, d);
  }

 private:
  template <typename S>
  struct Chord {
    S x, w;     // [m]
    S length;   // [m]
    S stretch;  // length - L, without the cancellation [m]
    S angle;    // [rad] up is positive, in the turn in which the nodes are

    [[gnu::always_inline]] Chord(const ElementProperties<S>& p, const Vector6<S>& d) noexcept {
      using detail::angle_near;
      using std::sqrt;
      const S u = d[3] - d[0];
      x = p.length + u;
      w = d[4] - d[1];
      length = sqrt(x * x + w * w);
      stretch = (u * (p.length + x) + w * w) / (length + p.length);
      angle = angle_near(w, x, length, S(-(d[2] + d[5]) / 2));
    }
    Deformation<S> local(const ElementProperties<S>& p, const Vector6<S>& d) const noexcept {
      return {stretch - p.natural_stretch, p.length * (d[2] + angle), p.length * (d[5] + angle)};
    }
  };

  /// A chord, and what an increment does to its element.
  template <typename S>
  struct Turn {
    Chord<S> chord;
    Deformation<S> before;
    S extends, turns;  ///< the chord [m, rad]
    S a, b;            ///< of the deformation [m]

    Turn(const ElementProperties<S>& p, const Vector6<S>& d, const Vector6<S>& x) noexcept
        : chord(p, d), before(chord.local(p, d)) {
      const S i = 1 / chord.length, dx = x[3] - x[0], dw = x[4] - x[1];
      extends = (chord.x * dx + chord.w * dw) * i, turns = (chord.x * dw - chord.w * dx) * i * i;
      a = p.length * (x[2] + turns), b = p.length * (x[5] + turns);
    }
  };

  /// Change of the chord that turns and has then a normal force: N is linear in the stretch, or else it is the unknown.
  template <typename S>
  static Vector2<S> lengthened(const ElementProperties<S>& p, const Turn<S>& to, const S& normal) noexcept {
    using std::cos;
    using std::sin;
    const Deformation<S> after(to.before.stretch + to.extends, to.before.a + to.a, to.before.b + to.b);
    S grows = to.extends;
    if constexpr (has_own_tension<Local>) {
      OwnTension<S> tension;
      tension.normal = normal;
      (void)Local::respond(p, after, tension);
      grows -= tension.lack;
    } else {
      const CoreResponse<S> q = Local::respond(p, after);
      grows += (normal - q.s) / q.k.ss;
    }
    // (l + grows) e(α + turns) - l e(α), with e(α + turns) - e(α) = 2 sin(turns/2) z(α + turns/2)
    const S half = to.turns / 2, middle = to.chord.angle + half, bow = 2 * to.chord.length * sin(half),
            end = middle + half;
    return {grows * cos(end) - bow * sin(middle), grows * sin(end) + bow * cos(middle)};
  }

  /// The core of the local element, q, in the frame that has not turned.   @param normal, turns  force and sum of the moments over L that turn
  template <typename S>
  [[gnu::always_inline]] static CoreResponse<S> turned(const ElementProperties<S>& p, const Chord<S>& chord,
                                                       const CoreResponse<S>& q, const S& normal,
                                                       const S& turns) noexcept {
    const S L = p.length, i = 1 / chord.length, c = chord.x * i, s = chord.w * i;
    // By α: L times the sums over both ends, because the core is in Lθ.
    const S h = L * i, M = h * (q.t1 + q.t2), a1 = h * (q.k.t11 + q.k.t12), a2 = h * (q.k.t12 + q.k.t22);
    const S ez = h * (q.k.s1 + q.k.s2) - h * turns * i, zz = h * (a1 + a2) + normal * i, ss = q.k.ss;
    return {q.energy,
            q.s * c - M * s,
            q.s * s + M * c,
            q.t1,
            q.t2,
            {ss * c * c - 2 * ez * c * s + zz * s * s, (ss - zz) * c * s + ez * (c * c - s * s),
             q.k.s1 * c - a1 * s, q.k.s2 * c - a2 * s, ss * s * s + 2 * ez * c * s + zz * c * c,
             q.k.s1 * s + a1 * c, q.k.s2 * s + a2 * c, q.k.t11, q.k.t12, q.k.t22}};
  }
};

}  // namespace hapbeam
