// Both spans of a beam under one tension, condensed to the node between them.
//
// Each span is condensed from its own support inward (span_recursion.hpp), both side by side in two lanes of one register.  They
// meet at the inner node, whose stiffness is the sum of both.  The shape is laid from there outward.
// Lengths are in units of the beam's L, forces of EI/L², so that tension is ν = N L²/EI.
// Real-time: noexcept, no allocation after construction, O(n).
#pragma once

#include <algorithm>
#include <type_traits>

#include <hapbeam/fem/solver/per_node.hpp>
#include <hapbeam/fem/solver/span_recursion.hpp>
#include <hapbeam/fem/solver/taylor.hpp>
#include <hapbeam/support.hpp>

namespace hapbeam::detail {

template <class Element, typename Scalar, int Elements, int MaxElements>
class TwoSpans {
  using Pair = Lanes<Scalar>;  // of the left and of the right span
  using Recursion = SpanRecursion<Element, Scalar>;
  template <class T>
  using Under = TensionedElement<T>;
  template <class T>
  using Span = SpanStiffness<T>;

 public:
  TwoSpans(int elements, Support left, Support right) : rows_(elements), supports_{left, right} {
    const auto where = [&](bool w, bool theta) {
      const auto is = [&](Support s) { return Scalar(fixes_w(s) == w && fixes_theta(s) == theta); };
      return Pair(is(left), is(right));
    };
    yields_ = where(false, false);
    holds_w_ = where(true, false);
    holds_theta_ = where(false, true);
    holds_both_ = where(true, true);
  }

  /// Puts the inner node where the contact is.  A side may have no element; its support is then at the node.
  /// @param left, right  elements of either side   @param s  [L] of the node   @param lever  [L] from it to the contact
  void set(int left, int right, Scalar s, Scalar lever) noexcept {
    count_[0] = left;
    count_[1] = right;
    length_ = Pair(left > 0 ? s / Scalar(left) : Scalar(1), right > 0 ? (1 - s) / Scalar(right) : Scalar(1));
    inverse_length_ = inverse(length_);
    lever_ = lever;
    turns_ = (left > 0 || !fixes_theta(supports_[0])) && (right > 0 || !fixes_theta(supports_[1]));
  }

  /// Force at the contact over its displacement k(ν), and its derivatives.  ½ k' d² is by how much the slope makes the beam
  /// longer than its chord [L].
  Taylor<Scalar> stiffness(Scalar tension) const noexcept {
    const Pair square = length_ * length_;
    const auto element = recursion_.under(Taylor<Pair>{Pair::both(tension) * square, square, Pair::both(0)});
    return join(element, condense(element, [](auto&&...) {})).stiffness;
  }

  /// The shape in which the contact is displaced by d.
  /// @param flexibility  EI/(EA L²)   @param d [L]   @param length  L [m]
  /// @param visit  (node, distance, u, w, θ) for all nodes, from the inner one outward: distance and u [m] from those of the
  ///               inner node, w [m]   @return k(ν)
  template <class Visit>
  Scalar lay(Scalar tension, Scalar flexibility, Scalar d, Scalar length, Visit&& visit) noexcept {
    const auto k = recursion_.under(Pair(Pair::both(tension) * length_ * length_));
    int row = 0;
    const auto condensed = condense(k, [&](const Span<Pair>& x, const Pair& sigma) {
      const Pair i = inverse(sigma);
      rows_[row++] = {add_product(add_product(x.sigma, k.rr_D, x.e), k.r_D, x.b) * i,
                      add_product(add_product(Pair(k.shear_D * x.sigma), k.r_D, x.e), k.t12_D, x.b) * i,
                      add_product(Pair(k.rr_D * x.b), k.r_D, x.a) * -i,
                      (x.sigma - k.r_D * x.b - k.t12_D * x.a) * i};
    });
    const auto joint = join(k, condensed);
    const Scalar theta = joint.turn * d, at_node = d + lever_ * theta;
    visit(count_[0], Scalar(0), Scalar(0), at_node * length, theta);
    const Pair mirror(1, -1), unit = Pair::both(length), two = Pair::both(2);
    const Pair turn = mirror * inverse_length_, along = -(mirror * unit * length_), to_right = mirror * unit;
    const Pair stretch = length_ * Pair::both(tension * flexibility), half = inverse_length_ / two;
    const auto& taut = recursion_.taut();
    const Pair r2 = two * taut.r, t2 = two * taut.t12;
    Pair w = Pair::both(at_node), phi = mirror * length_ * Pair::both(theta), shortened = Pair::both(0);
    const int least = (std::min)(count_[0], count_[1]), most = (std::max)(count_[0], count_[1]);
    const auto outward = [&](int j, auto&& place) {
      const Row& x = rows_[most - j];
      const Pair outer = add_product(Pair(x.ww * w), x.wp, phi),
                 turned = add_product(Pair(x.pw * w), x.pp, phi), rise = w - outer;
      const Pair by_rise = rise * add_product(Pair(taut.rr * rise), r2, phi + turned);
      const Pair by_turn = add_product(Pair(phi * phi), turned, turned) * taut.t11;
      shortened = add_product(Pair(shortened - stretch), half,
                              add_product(Pair(by_rise + by_turn), t2, Pair(phi * turned)));
      w = outer;
      phi = turned;
      const Pair distance = along * Pair::both(Scalar(j)), u = to_right * shortened, up = unit * w,
                 angle = turn * phi;
      place(0, count_[0] - j, distance, u, up, angle);
      place(1, count_[0] + j, distance, u, up, angle);
    };
    const int longer = count_[1] > count_[0] ? 1 : 0;
    for (int j = 1; j <= least; ++j)
      outward(j, [&](int i, int node, const Pair& distance, const Pair& u, const Pair& up,
                     const Pair& angle) { visit(node, distance[i], u[i], up[i], angle[i]); });
    for (int j = least + 1; j <= most; ++j)
      outward(j,
              [&](int i, int node, const Pair& distance, const Pair& u, const Pair& up, const Pair& angle) {
                if (i == longer) visit(node, distance[i], u[i], up[i], angle[i]);
              });
    return joint.stiffness;
  }

 private:
  /// (w, φ) of a node by those of the next one inward.
  struct Row {
    Pair ww, wp, pw, pp;
  };
  template <class T>
  struct Joint {
    T stiffness, turn;  // force and θ of the inner node, by d
  };

  static void constant(const Pair& a, Pair& x) noexcept { x = a; }
  static void constant(const Pair& a, Taylor<Pair>& x) noexcept { x = {a, Pair::both(0), Pair::both(0)}; }
  static Pair swapped(const Pair& x) noexcept { return x.swapped(); }
  static Taylor<Pair> swapped(const Taylor<Pair>& x) noexcept {
    return {x.c0.swapped(), x.c1.swapped(), x.c2.swapped()};
  }
  static Scalar sum(const Pair& x) noexcept { return x[0] + x[1]; }
  static Taylor<Scalar> sum(const Taylor<Pair>& x) noexcept { return {sum(x.c0), sum(x.c1), sum(x.c2)}; }
  static Scalar difference(const Pair& x) noexcept { return x[0] - x[1]; }
  static Taylor<Scalar> difference(const Taylor<Pair>& x) noexcept {
    return {difference(x.c0), difference(x.c1), difference(x.c2)};
  }
  static Scalar product(const Pair& x) noexcept { return x[0] * x[1]; }
  static Taylor<Scalar> product(const Taylor<Pair>& x) noexcept {
    return Taylor<Scalar>{x.c0[0], x.c1[0], x.c2[0]} * Taylor<Scalar>{x.c0[1], x.c1[1], x.c2[1]};
  }

  /// Both spans as their supports hold them, without an element.
  template <class T>
  [[gnu::always_inline]] Span<T> supported(const Under<T>& k) const noexcept {
    Span<T> x;
    constant(yields_, x.sigma);
    constant(holds_w_, x.a);
    constant(Pair::both(0), x.b);
    constant(holds_theta_, x.e);
    x.e = x.e + scaled(yields_, k.c);
    x.d = scaled(holds_both_, k.i_D) + scaled(holds_w_, T(k.c * k.i_D));
    return x;
  }

  /// All elements of both; the longer side begins alone.
  template <class T, class Visit>
  [[gnu::always_inline]] Span<T> condense(const Under<T>& k, Visit&& visit) const noexcept {
    const Span<T> start = supported(k);
    const int least = (std::min)(count_[0], count_[1]), most = (std::max)(count_[0], count_[1]);
    const int wait = least > 0 ? most - least : 0;
    Span<T> x = start;
    if (wait > 0) {
      x = Recursion::add(k, start, wait, visit);
      const Scalar left = count_[0] > count_[1] ? 1 : 0;
      const Pair on(left, 1 - left), anew = on.swapped();
      const auto mix = [&](const T& a, const T& b) { return T(scaled(on, a) + scaled(anew, b)); };
      x = {mix(x.sigma, start.sigma), mix(x.a, start.a), mix(x.b, start.b), mix(x.e, start.e),
           mix(x.d, start.d)};
    }
    return Recursion::add(k, x, most - wait, visit);
  }

  /// Both meet at the inner node, where S, in w and θ, is the sum of both: for either the other's σ is the denominator.
  template <class T>
  [[gnu::always_inline]] auto join(const Under<T>& k, const Span<T>& x) const noexcept {
    const Pair there(Scalar(count_[0] > 0), Scalar(count_[1] > 0));
    const Pair i1 = there * inverse_length_, i2 = i1 * i1, i3 = i1 * i2, i4 = i2 * i2;
    // φ/l is θ on the left and -θ on the right.
    const T a = scaled(i3, x.a), b = scaled(i2, x.b), e = scaled(i1, T(x.e - k.c * x.sigma)),
            d = scaled(i4, T(x.d * k.D - k.c * x.a)), other = swapped(x.sigma);
    const auto det = sum(T(add_product(add_product(T(d * other), a, swapped(e)), b, swapped(b))));
    const auto stiff = sum(T(a * other)), across = difference(T(b * other));
    using R = std::decay_t<decltype(stiff)>;
    if (!turns_) return Joint<R>{R(stiff * inverse(product(x.sigma))), stiff - stiff};
    R turning = sum(T(e * other)), slide = across;
    if (lever_ != 0) {
      slide = across + scaled(lever_, stiff);
      turning = turning + scaled(lever_, R(across + slide));
    }
    const R by = inverse(turning);
    return Joint<R>{det * by, scaled(Scalar(-1), R(slide * by))};
  }

  PerNode<Row, Elements, MaxElements> rows_;
  Recursion recursion_;
  Support supports_[2];
  Pair yields_, holds_w_, holds_theta_, holds_both_;  // 1 or 0
  Pair length_ = Pair::both(1), inverse_length_ = Pair::both(1);
  Scalar lever_ = 0;
  int count_[2] = {0, 0};
  bool turns_ = true;
};

}  // namespace hapbeam::detail
