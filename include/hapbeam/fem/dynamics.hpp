// SPDX-License-Identifier: MIT
// The dynamics of a beam in the plane: its inertia, as a step of time sees it, a spring to where it would be without force, and
// the step.
//
//   Π = V + ½ c |q - q~|²          |·|² = qᵀ M q,   q: place and unit tangent (x, y, cos θ, -sin θ) of each node
//
// In these unknowns the consistent mass of the cubic is constant.  That of sections that turn, ρI, is left out: the first frequency between hinges is
// (πh/L)²/24 of itself too high, h: height.
//
// A step is the trapezoidal rule to a part G of it, then the second backward difference:
//
//   minimise V(x) + ½ c |q(x) - q~|²       twice, with one c:  M c (q - q~) is the inertia, and the air's drag M α v
//
// Of second order, L-stable, and monotone in energy in all that was tried.  A stage has velocity and acceleration by the place that it finds:
//
//   v = v~ + r (q - q^),   a = c (q - q^),   r² = c
//
// Allocates and throws at construction; all else is noexcept and allocation-free, O(n).
// Source: derived here; consistent mass, Archer 1963; the step, Bank and others, IEEE Trans. CAD 4, 1985; Hosea and Shampine, Appl.
// Numer. Math. 20, 1996.
#pragma once

#include <array>

#include <hapbeam/angle.hpp>
#include <hapbeam/beam.hpp>
#include <hapbeam/centreline.hpp>
#include <hapbeam/element/element.hpp>
#include <hapbeam/fem/rod/rod_lanes.hpp>
#include <hapbeam/fem/solver/per_node.hpp>
#include <hapbeam/unroll.hpp>

namespace hapbeam::detail {

/// Place [m] and unit tangent of a node.
template <typename S>
using Placed = Eigen::Matrix<S, 4, 1>;

template <typename S>
Placed<S> placed(const CentrelineNode<S>& node) noexcept {
  const Vector2<S> along = direction(-node.theta);
  return Placed<S>(node.s + node.u, node.w, along.x(), along.y());
}

template <typename S, int Elements, int MaxElements>
class Inertia {
  using Values = PerNode<Placed<S>, Elements, MaxElements>;

 public:
  /// @param at  (i) -> arc position of node i [m]   @throws std::invalid_argument where the beam has no density
  template <class At>
  Inertia(const Beam& beam, int elements, At&& at)
      : masses_(elements), blocks_(elements), ghost_(elements), at_(elements), seen_(elements) {
    for (int e = 0; e < elements; ++e) {
      const double from = static_cast<double>(at(e)), l = static_cast<double>(at(e + 1)) - from;
      Eigen::Matrix4d sum = Eigen::Matrix4d::Zero();
      // Exact where the mass is even or tapers linearly.
      constexpr std::array<double, 4> x{0.0694318442029737124, 0.330009478207571868, 0.669990521792428132,
                                        0.930568155797026288},
          w{0.173927422568726929, 0.326072577431273071, 0.326072577431273071, 0.173927422568726929};
      for (std::size_t g = 0; g < x.size(); ++g) {
        const double t = x[g], u = 1 - t;
        const Eigen::Vector4d h(u * u * (1 + 2 * t), l * t * u * u, t * t * (3 - 2 * t), -l * t * t * u);
        const double mass = beam.mass_per_length(from + t * l);
        if (!(mass > 0))
          reject("density", mass, "kg/m³", "known for a beam that moves: Material{young, density}");
        sum += w[g] * l * mass * h * h.transpose();
      }
      masses_[e] = sum.template cast<S>();
    }
    set_rate(1);
  }

  /// @param c [1/s²]
  void set_rate(S c) noexcept {
    if (c == rate_) return;
    rate_ = c;
    const int last = blocks_.size() - 1;
    const auto of_both = [](S place, S tangent) { return Placed<S>(place, place, tangent, tangent); };
    for (int i = 0; i <= last; ++i) {
      Eigen::Matrix<S, 2, 2> own = Eigen::Matrix<S, 2, 2>::Zero(), next = own, before = own;
      if (i > 0) {
        own += c * masses_[i - 1].template bottomRightCorner<2, 2>();
        before = c * masses_[i - 1].template bottomLeftCorner<2, 2>();
      }
      if (i < last) {
        own += c * masses_[i].template topLeftCorner<2, 2>();
        next = c * masses_[i].template topRightCorner<2, 2>();
      }
      const auto block = [&](const auto& M) {
        return Block{of_both(M(0, 0), M(1, 1)), of_both(M(0, 1), M(1, 0))};
      };
      blocks_[i] = {block(own), block(next), block(before)};
    }
  }
  Values& ghost() noexcept { return ghost_; }
  const Values& ghost() const noexcept { return ghost_; }
  /// What increments are measured by, beside the strain energy [J].
  S scale() const noexcept { return scale_; }
  void set_scale(S energy) noexcept { scale_ = energy; }

  /// Place and unit tangent of each node, as they lie now.
  template <class Nodes>
  const Values& find(const Nodes& nodes) noexcept {
    for_each_abreast<S>(static_cast<int>(nodes.size()) - 1, [&](const auto& here) HAPBEAM_INLINED {
      using Wide = typename std::decay_t<decltype(here)>::Wide;
      Wide cosine, sine;
      cos_and_sin(Wide(gather(here, [&](int i) { return nodes.data()[i].theta; })), cosine, sine);
      HAPBEAM_UNROLL
      for (int k = 0; k < Wide::size; ++k) {
        const auto& node = nodes.data()[here.of[k]];
        at_[here.of[k]] = {node.s + node.u, node.w, cosine[k], -sine[k]};
      }
    });
    return at_;
  }
  /// To be called where the nodes have moved.   @return ½ c |q - q~|² [J]
  template <class Nodes>
  S look(const Nodes& nodes) noexcept {
    find(nodes);
    Placed<S> sum = Placed<S>::Zero();
    each_product([this](int i) HAPBEAM_INLINED { return Placed<S>(at_[i] - ghost_[i]); },
                 [&](int i, const Placed<S>& off, const Placed<S>& force) HAPBEAM_INLINED {
                   const Placed<S>& at = at_[i];
                   const S along = at[2] * force[2] + at[3] * force[3],
                           aside = at[3] * force[2] - at[2] * force[3];
                   seen_[i] = {{force[0], force[1]}, aside, blocks_[i].own.own[2] - along};
                   sum += force.cwiseProduct(off);
                 });
    return sum.sum() / 2;
  }
  /// Adds to an element's residual and tangent what is its first node's, the last one's its second's, too, and what couples both: as read by
  /// BlockTridiagonal::add().
  [[gnu::always_inline]] void add(int e, Vector6<S>& r, Matrix6<S>& K) const noexcept {
    const auto turns = [this](int i) HAPBEAM_INLINED { return Vector2<S>(at_[i][3], -at_[i][2]); };
    const Vector2<S> a = turns(e), b = turns(e + 1);
    const auto add_node = [&](int i, int at, const Vector2<S>& turn) HAPBEAM_INLINED {
      const Seen& seen = seen_[i];
      const Block& own = blocks_[i].own;
      r[at] += seen.force[0], r[at + 1] += seen.force[1], r[at + 2] += seen.moment;
      K(at, at) += own.own[0], K(at + 1, at + 1) += own.own[0];
      K(at + 2, at) += own.other[0] * turn[0], K(at + 2, at + 1) += own.other[0] * turn[1];
      K(at + 2, at + 2) += seen.stiffness;
    };
    add_node(e, 0, a);
    if (e + 2 == blocks_.size()) add_node(e + 1, 3, b);
    const Block& next = blocks_[e].next;
    K(0, 3) += next.own[0], K(1, 4) += next.own[0];
    K(0, 5) += next.other[0] * b[0], K(1, 5) += next.other[0] * b[1];
    K(2, 3) += next.other[2] * a[0], K(2, 4) += next.other[2] * a[1];
    K(2, 5) += next.own[2] * a.dot(b);
  }
  /// ½ |v|² [J].   @param v  (i) -> Placed of node i
  template <class V>
  S energy(V&& v) const noexcept {
    Placed<S> sum = Placed<S>::Zero();
    each_product(
        v, [&](int, const Placed<S>& x, const Placed<S>& by) HAPBEAM_INLINED { sum += by.cwiseProduct(x); });
    return sum.sum() / (2 * rate_);
  }

 private:
  /// Of c M, alike along x and y: what place and tangent of a node feel of themselves, and of each other.
  struct Block {
    Placed<S> own = Placed<S>::Zero(), other = Placed<S>::Zero();
    [[gnu::always_inline]] Placed<S> operator*(const Placed<S>& off) const noexcept {
      return own.cwiseProduct(off) + other.cwiseProduct(Placed<S>(off[2], off[3], off[0], off[1]));
    }
  };
  /// Of a node, with the next one and the one before.
  struct Blocks {
    Block own, next, before;
  };
  /// Calls use(i, x, c M x) for each node.   @param of  (i) -> x of node i
  template <class Of, class Use>
  [[gnu::always_inline]] void each_product(Of&& of, Use&& use) const noexcept {
    const int last = blocks_.size() - 1;
    Placed<S> before = Placed<S>::Zero(), here = of(0);
    for (int i = 0; i <= last; ++i) {
      const Placed<S> next = i < last ? Placed<S>(of(i + 1)) : here;  // the last one has no block of it
      const Blocks& to = blocks_[i];
      use(i, here, Placed<S>(to.own * here + to.next * next + to.before * before));
      before = here, here = next;
    }
  }

  /// A node as it lies.
  struct Seen {
    Vector2<S> force;  ///< c M (q - q~) on its place [N],
    S moment;          ///< and on θ [N·m]
    S stiffness;       ///< by θ [N·m]
  };
  PerNode<Eigen::Matrix<S, 4, 4>, Elements, MaxElements>
      masses_;  // of places and tangents, a component [kg], [kg·m], [kg·m²]
  PerNode<Blocks, Elements, MaxElements> blocks_;
  Values ghost_, at_;  // q~, q
  PerNode<Seen, Elements, MaxElements> seen_;
  S rate_ = 0, scale_ = 0;
};

}  // namespace hapbeam::detail

namespace hapbeam {

template <typename S, int Elements, int MaxElements>
class TrBdf2 {
 public:
  using Placed = detail::Placed<S>;
  /// How one node moves.
  struct State {
    Placed q = Placed::Zero(), v = Placed::Zero(), a = Placed::Zero();
  };
  using States = detail::PerNode<State, Elements, MaxElements>;
  static constexpr int stages = 2;

  explicit TrBdf2(int elements) : now_(elements), between_(elements), before_(elements), from_(elements) {}

  /// Of node i, at the end of the last step.
  const State& operator[](int i) const noexcept { return now_[i]; }

  /// @param dt [s]   @param drag  α of the air [1/s]
  void begin(S dt, S drag) noexcept {
    span_ = follows_ ? length(1) : S(0);
    dt_ = dt, drag_ = drag;
    for (int i = 0; i < now_.size(); ++i) before_[i] = now_[i];
  }
  void take_back() noexcept {
    for (int i = 0; i < now_.size(); ++i) now_[i] = before_[i];
    follows_ = false;
  }
  /// Without velocity.   @param q  (i) -> where node i is
  template <class Where>
  void stop(Where&& q) noexcept {
    for (int i = 0; i < now_.size(); ++i) now_[i] = {}, now_[i].q = q(i);
    follows_ = false;
  }
  /// Where it was before the last step, with the acceleration behind it.
  void start_again() noexcept {
    for (int i = 0; i < now_.size(); ++i) now_[i].q = before_[i].q, now_[i].v = before_[i].v;
    follows_ = false;
  }
  /// How long a stage is [s].
  S length(int stage) const noexcept { return (stage == 0 ? G : 1 - G) * dt_; }
  /// Where it ends, of the step.
  static constexpr S end(int stage) noexcept { return stage == 0 ? G : S(1); }

  /// Sets c and q~ of a stage.
  template <class Inertia>
  void aim(int stage, Inertia& inertia) noexcept {
    const S r = rate(), c = r * r, all = c + drag_ * r;
    inertia.set_rate(all);
    for (int i = 0; i < now_.size(); ++i) {
      from_[i] = from(stage, i);
      inertia.ghost()[i] = from_[i].place - drag_ / all * from_[i].velocity;
    }
  }
  /// Of node i, where a stage begins.
  const State& start(int stage, int i) const noexcept { return stage == 0 ? now_[i] : between_[i]; }
  /// How long a stage is in units of the one before; 0 where there is none, after a start.
  S onward(int stage) const noexcept {
    return stage == 1 ? length(1) / length(0) : span_ > 0 ? length(0) / span_ : S(0);
  }
  /// Where a node is about at the end of a stage: its acceleration goes on as over the one before.
  Placed foreseen(int stage, int i) const noexcept {
    const State &x = start(stage, i), &before = start(1 - stage, i);
    const S h = length(stage);
    return x.q + h * (x.v + h / 2 * (x.a + onward(stage) / 3 * (x.a - before.a)));
  }
  /// r of both stages, by which they have their rates [1/s].
  S rate() const noexcept { return 2 / (G * dt_); }
  /// Of what changes by a rate: where a stage counts the change from, by r, to have the rate at its end.
  /// @param x, rate  at the beginning of the step   @param y  at the end of the first stage
  template <class X>
  static X counted_from(int stage, const X& x, const X& rate, const X& y, S r) noexcept {
    return stage == 0 ? X(x + rate / r) : X(new_ * y - old_ * x);
  }
  /// To be called where the stage has been solved.
  void know(int stage, int i, const Placed& q) noexcept {
    const S r = rate();
    const Placed faster = r * (q - from_[i].place);
    State& to = stage == 0 ? between_[i] : now_[i];
    to.q = q, to.v = from_[i].velocity + faster, to.a = r * faster;
    follows_ = stage == 1;
  }

 private:
  static constexpr S G = S(0.585786437626904951);  // 2 - √2: both stages have one c
  static constexpr S new_ = 1 / (G * (2 - G)), old_ = (1 - G) * (1 - G) * new_;
  struct From {
    Placed place = Placed::Zero(), velocity = Placed::Zero();  // q^, v~
  };
  From from(int stage, int i) const noexcept {
    const State &x = now_[i], &y = between_[i];
    const S half = 1 / rate();
    if (stage == 0) {
      const Placed velocity = x.v + half * x.a;
      return {x.q + half * (x.v + velocity), velocity};
    }
    const Placed velocity = new_ * y.v - old_ * x.v;
    return {new_ * y.q - old_ * x.q + half * velocity, velocity};
  }

  States now_, between_, before_;
  detail::PerNode<From, Elements, MaxElements> from_;
  S dt_ = 0, drag_ = 0, span_ = 0;  // the last: of the stage before a step, 0: none
  bool follows_ = false;            // on such a stage
};

}  // namespace hapbeam
