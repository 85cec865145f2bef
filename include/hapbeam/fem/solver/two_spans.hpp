// Both spans of a beam under one tension, condensed to the node between them.
//
// Under a tension N all elements of a span, which are equally long, have one stiffness, linear in N.  Seen from its inner
// end a span is a stiffness S in w and φ = lθ there; one more element makes of it
//
//   S' = K22 - K21 (K11 + S)⁻¹ K12
//
// This is rational in S and linear in its Plücker coordinates σ : σS : σ det S: a step is a product with a constant sparse
// matrix and has no division.  A displacement that the outer support holds is an infinite S, σ = 0, and needs no case of its
// own.  With K11 = H + c, K12 = -H T⁻¹, T⁻¹ = [1 τ; 0 1], H = [rr -r; -r h], c on φ alone and D = det H the step is
//
//   σ' = σ + (h a + 2r b + rr e)/D + d                          S = [a b; b e]/σ - c,  det(S + c) = D d/σ
//   a' = a + rr d,   b' = b + τa + r d,   e' = e + 2τb + τ²a + h d + 2c σ',   d' = d + 2c a'/D
//
// All terms are positive where N is not negative, so that nothing cancels: the stiffness at the inner node is exact to a few
// last places whatever the number of elements, in float as in double.  With Taylor polynomials in N for numbers the same
// steps give its derivatives.  Both spans run side by side, in two lanes of one register, each from its own support inward.
//
// Lengths are in units of the beam's L, forces of EI/L², so that tension is ν = N L²/EI.
// Real-time: noexcept, no allocation after construction; 63 multiply-adds a pair of elements with derivatives.
// Source: condensation as in Golub and Van Loan, Matrix Computations, 4.5.1; Riccati recursions are linear on Lagrangian
// planes: Bittanti, Laub and Willems, The Riccati Equation, 1991, ch. 3.
#pragma once

#include <algorithm>
#include <limits>

#include <hapbeam/element/element.hpp>
#include <hapbeam/fem/solver/per_node.hpp>
#include <hapbeam/fem/solver/taylor.hpp>
#include <hapbeam/support.hpp>

namespace hapbeam::detail {

template <class Element, typename Scalar, int Elements, int MaxElements>
class TwoSpans {
  /// One value of the left span, one of the right.
  using Lanes = Eigen::Array<Scalar, 2, 1>;

 public:
  TwoSpans(int elements, Support left, Support right) : rows_(elements), supports_{left, right} {
    // Of one element of length 1: EI = 1 without tension, and a unit of tension alone.
    const auto terms = [](Scalar bending, Scalar stretch) {
      const auto k = Element::respond(ElementProperties<Scalar>(1, 1, bending),
                                      Deformation<Scalar>(stretch, Scalar(0), Scalar(0)))
                         .k;
      return Terms{k.rr, k.r1, k.t11, k.t12};
    };
    bent_ = terms(1, 0);
    taut_ = terms(0, 1);
    const Scalar bent = bent_.t11 + bent_.t12, taut = taut_.t11 + taut_.t12;
    turning_ = bent * taut_.rr + taut * bent_.rr - 4 * bent_.r * taut_.r;
    turning_taut_ = taut * taut_.rr - 2 * taut_.r * taut_.r;
    for (int side = 0; side < 2; ++side) {
      const bool w = fixes_w(supports_[side]), theta = fixes_theta(supports_[side]);
      yields_[side] = !w && !theta;
      holds_w_[side] = w && !theta;
      holds_theta_[side] = theta && !w;
      holds_both_[side] = w && theta;
    }
  }

  /// Puts the inner node where the contact is.  A side may have no element; its support is then at the node.
  /// @param left, right  elements of either side   @param s  [L] of the node   @param lever  [L] from it to the contact
  void set(int left, int right, Scalar s, Scalar lever) noexcept {
    count_[0] = left;
    count_[1] = right;
    length_ = {left > 0 ? s / Scalar(left) : Scalar(1), right > 0 ? (1 - s) / Scalar(right) : Scalar(1)};
    inverse_length_ = 1 / length_;
    lever_ = lever;
    turns_ = (left > 0 || !fixes_theta(supports_[0])) && (right > 0 || !fixes_theta(supports_[1]));
  }

  /// Force at the contact over its displacement k(ν), and its derivatives.  ½ k' d² is by how much the slope makes the beam
  /// longer than its chord [L].
  Taylor<Scalar> stiffness(Scalar tension) const noexcept {
    const Lanes square = length_ * length_;
    const auto element = under(Taylor<Lanes>{tension * square, square, Lanes::Zero()});
    return join(element, condense(element, [](auto&&...) {})).stiffness;
  }

  /// The shape in which the contact is displaced by d.  @param d [L]   @param flexibility  EI/(EA L²)
  /// @param visit  (node, u, w, θ) for all nodes, from the inner one outward: u [L] against that of the inner node, w [L]
  /// @return k(ν)
  template <class Visit>
  Scalar lay(Scalar tension, Scalar flexibility, Scalar d, Visit&& visit) noexcept {
    const auto k = under(Lanes(tension * length_ * length_));
    int row = 0;
    const auto condensed = condense(k, [&](const Span<Lanes>& x, const Lanes& sigma) {
      const Lanes i = 1 / sigma;
      rows_[row++] = {(x.sigma + k.rr_D * x.e + k.r_D * x.b) * i,
                      (k.shear_D * x.sigma + k.r_D * x.e + k.t12_D * x.b) * i,
                      (k.rr_D * x.b + k.r_D * x.a) * -i, (x.sigma - k.r_D * x.b - k.t12_D * x.a) * i};
    });
    const auto joint = join(k, condensed);
    const Scalar theta = joint.turn * d, at_node = d + lever_ * theta;
    visit(count_[0], Scalar(0), at_node, theta);
    const Lanes mirror(1, -1), turn = mirror * inverse_length_, stretch = length_ * (tension * flexibility),
                               half = inverse_length_ / 2;
    Lanes w = Lanes::Constant(at_node), phi = mirror * length_ * theta, shortened = Lanes::Zero();
    const int most = std::max(count_[0], count_[1]);
    for (int j = 1; j <= most; ++j) {
      const Row& x = rows_[most - j];
      const Lanes outer = x.ww * w + x.wp * phi, turned = x.pw * w + x.pp * phi, rise = w - outer;
      shortened += half * (rise * (taut_.rr * rise + 2 * taut_.r * (phi + turned)) +
                           taut_.t11 * (phi * phi + turned * turned) + 2 * taut_.t12 * phi * turned) -
                   stretch;
      w = outer;
      phi = turned;
      const Lanes angle = turn * phi;
      if (j <= count_[0]) visit(count_[0] - j, shortened[0], w[0], angle[0]);
      if (j <= count_[1]) visit(count_[0] + j, -shortened[1], w[1], angle[1]);
    }
    return joint.stiffness;
  }

 private:
  /// An element's tangent in (rise, lθ1, lθ2).
  struct Terms {
    Scalar rr, r, t11, t12;
  };
  /// An element of length and EI 1 under tension, as above.
  template <class T>
  struct Under {
    T rr, r, h, tau, c, c2, D, i_D;
    T h_D, r_D, r2_D, rr_D, t12_D, shear_D, c2_D;  // over D; shear: r (h - t12)
  };
  /// σ and so on of either span.
  template <class T>
  struct Span {
    T sigma, a, b, e, d;
  };
  /// (w, φ) of a node by those of the next one inward.
  struct Row {
    Lanes ww, wp, pw, pp;
  };
  template <class T>
  struct Joint {
    T stiffness, turn;  // force and θ of the inner node, by d
  };

  static constexpr Scalar large = Scalar(1e12);  // of a σ that is brought back to 1

  [[gnu::always_inline]] static Lanes linear(Scalar a, Scalar b, const Lanes& x) noexcept {
    return a + b * x;
  }
  [[gnu::always_inline]] static Taylor<Lanes> linear(Scalar a, Scalar b, const Taylor<Lanes>& x) noexcept {
    return {a + b * x.c0, b * x.c1, b * x.c2};
  }
  static void constant(const Lanes& a, Lanes& x) noexcept { x = a; }
  static void constant(const Lanes& a, Taylor<Lanes>& x) noexcept { x = {a, Lanes::Zero(), Lanes::Zero()}; }
  static Scalar side(const Lanes& x, int i) noexcept { return x[i]; }
  static Taylor<Scalar> side(const Taylor<Lanes>& x, int i) noexcept { return {x.c0[i], x.c1[i], x.c2[i]}; }

  /// @param n  tension times l²
  template <class T>
  [[gnu::always_inline]] Under<T> under(const T& n) const noexcept {
    Under<T> k;
    k.rr = linear(bent_.rr, taut_.rr, n);
    k.r = linear(bent_.r, taut_.r, n);
    const T t12 = linear(bent_.t12, taut_.t12, n), r2 = k.r + k.r, i = inverse(k.rr);
    k.tau = r2 * i;
    k.h = k.tau * k.r - t12;
    k.c = n * linear(turning_, turning_taut_, n) * i;  // t11 + t12 - τr, whose parts without tension cancel
    k.c2 = k.c + k.c;
    k.D = k.r * k.r - k.rr * t12;
    k.i_D = inverse(k.D);
    k.h_D = k.h * k.i_D;
    k.r_D = k.r * k.i_D;
    k.r2_D = k.r_D + k.r_D;
    k.rr_D = k.rr * k.i_D;
    k.t12_D = t12 * k.i_D;
    k.shear_D = k.r_D * (k.h - t12);
    k.c2_D = k.c2 * k.i_D;
    return k;
  }

  /// Both spans as their supports hold them, without an element.
  template <class T>
  [[gnu::always_inline]] Span<T> supported(const Under<T>& k) const noexcept {
    Span<T> x;
    constant(yields_, x.sigma);
    constant(holds_w_, x.a);
    constant(Lanes::Zero(), x.b);
    constant(holds_theta_, x.e);
    x.e = x.e + scaled(yields_, k.c);
    x.d = scaled(holds_both_, k.i_D) + scaled(holds_w_, T(k.c * k.i_D));
    return x;
  }

  /// Adds elements to both.  @param visit  (span before, σ after) at each
  template <class T, class Visit>
  [[gnu::always_inline]] static Span<T> add(const Under<T>& element, Span<T> x, int elements,
                                            Visit&& visit) noexcept {
    const Under<T> k = element;
    for (int i = 0; i < elements; ++i) {
      const T b = add_product(x.b, k.tau, x.a), e = add_product(x.e, k.tau, T(x.b + b));
      const T sigma =
          add_product(add_product(add_product(x.sigma, k.h_D, x.a), k.r2_D, x.b), k.rr_D, x.e) + x.d;
      visit(x, value(sigma));
      x.sigma = sigma;
      x.a = add_product(x.a, k.rr, x.d);
      x.b = add_product(b, k.r, x.d);
      x.e = add_product(add_product(e, k.h, x.d), k.c2, sigma);
      x.d = add_product(x.d, k.c2_D, x.a);
      if (value(sigma)[0] > large || value(sigma)[1] > large) {
        const Lanes q = 1 / value(sigma);
        x = {scaled(q, x.sigma), scaled(q, x.a), scaled(q, x.b), scaled(q, x.e), scaled(q, x.d)};
      }
    }
    return x;
  }

  /// All elements of both; the longer side begins alone.
  template <class T, class Visit>
  [[gnu::always_inline]] Span<T> condense(const Under<T>& k, Visit&& visit) const noexcept {
    const Span<T> start = supported(k);
    const int least = std::min(count_[0], count_[1]), most = std::max(count_[0], count_[1]);
    const int wait = least > 0 ? most - least : 0;
    Span<T> x = start;
    if (wait > 0) {
      x = add(k, start, wait, visit);
      const Scalar left = count_[0] > count_[1] ? 1 : 0;
      const Lanes on(left, 1 - left), anew = 1 - on;
      const auto mix = [&](const T& a, const T& b) { return T(scaled(on, a) + scaled(anew, b)); };
      x = {mix(x.sigma, start.sigma), mix(x.a, start.a), mix(x.b, start.b), mix(x.e, start.e),
           mix(x.d, start.d)};
    }
    return add(k, x, most - wait, visit);
  }

  /// Both meet at the inner node.
  template <class T>
  [[gnu::always_inline]] auto join(const Under<T>& k, const Span<T>& x) const noexcept {
    const Lanes there(count_[0] > 0 ? 1 : 0, count_[1] > 0 ? 1 : 0);
    const Lanes i1 = there * inverse_length_, i2 = i1 * i1;
    const T i = inverse(x.sigma), a = x.a * i, b = x.b * i, e = x.e * i - k.c, d = x.d * k.D * i - k.c * a;
    // In w and θ, which is φ/l on the left and -φ/l on the right.
    const T A = scaled(Lanes(i1 * i2), a), B = scaled(i2, b), E = scaled(i1, e),
            det = scaled(Lanes(i2 * i2), d);
    using R = decltype(side(a, 0));
    const R a0 = side(A, 0), a1 = side(A, 1), b0 = side(B, 0), b1 = side(B, 1), e0 = side(E, 0),
            e1 = side(E, 1);
    const R stiff = a0 + a1, across = b0 - b1;
    if (!turns_) return Joint<R>{stiff, stiff - stiff};
    R turning = e0 + e1, slide = across;
    if (lever_ != 0) {
      const R arm = scaled(lever_, stiff);
      turning = turning + scaled(lever_, R(across + across + arm));
      slide = across + arm;
    }
    const R by = inverse(turning), both = b0 * b1;
    return Joint<R>{(side(det, 0) + side(det, 1) + a0 * e1 + a1 * e0 + both + both) * by,
                    scaled(Scalar(-1), R(slide * by))};
  }

  PerNode<Row, Elements, MaxElements> rows_;
  Support supports_[2];
  Terms bent_, taut_;                                  // by bending alone, and by a unit of tension
  Scalar turning_ = 0, turning_taut_ = 0;              // of c
  Lanes yields_, holds_w_, holds_theta_, holds_both_;  // 1 or 0
  Lanes length_ = Lanes::Ones(), inverse_length_ = Lanes::Ones();
  Scalar lever_ = 0;
  int count_[2] = {0, 0};
  bool turns_ = true;
};

}  // namespace hapbeam::detail
