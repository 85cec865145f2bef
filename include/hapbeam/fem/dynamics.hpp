// SPDX-License-Identifier: MIT
// The dynamics of a beam in the plane: its inertia, as a step of time sees it, a spring to where it would be without force, and
// the step.
//
//   Π = V + ½ c |q - q~|²          |·|² = qᵀ M q,   q: place and unit tangent (x, y, cos θ, -sin θ) of each node
//
// A step is the trapezoidal rule to a part G of it, then the second backward difference:
//
//   minimise V(x) + ½ c |q(x) - q~|²       twice, with one c:  M c (q - q~) is the inertia, and the air's drag M α v
//
// Of second order, L-stable, and monotone in energy in all that was tried with 50 steps or more in a period of the first mode.  A stage has velocity and acceleration by the place that it finds:
//
//   v = v~ + r (q - q^),   a = c (q - q^),   r² = c
//
// Allocates and throws at construction; all else is noexcept and allocation-free, O(n).
// Source: derived here; the step, Bank and others, IEEE Trans. CAD 4, 1985; Hosea and Shampine, Appl.
// Numer. Math. 20, 1996.
#pragma once

#include <type_traits>

#include <hapbeam/angle.hpp>
#include <hapbeam/beam.hpp>
#include <hapbeam/centreline.hpp>
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/fem/mass_blocks.hpp>
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
class Inertia : public MassBlocks<S, 2, Elements, MaxElements> {
  using Base = MassBlocks<S, 2, Elements, MaxElements>;
  using Base::blocks_, Base::ghost_, Base::masses_, typename Base::Block;

 public:
  using typename Base::Values;

  template <class At>
  Inertia(const Beam& beam, int elements, At&& at)
      : Base(beam, elements, at), at_(elements), seen_(elements) {}

  /// To be called once: unit tangents stand for those of the curve, which is longer than the beam where that is drawn.
  /// @param rest  nodes
  template <class Nodes>
  void draw(const Nodes& rest) noexcept {
    for (int e = 0; e + 1 < rest.size(); ++e) {
      const auto &a = rest.data()[e], &b = rest.data()[e + 1];
      const ElementProperties<S> p(b.s - a.s, 1, 1);
      const auto is = Corotational<>::deformation(p, Vector6<S>{a.u, a.w, a.theta, b.u, b.w, b.theta});
      const S i = 1 / p.length, bent = (2 * is.a * is.a - is.a * is.b + 2 * is.b * is.b) * (i * i / 30),
              drawn = (1 + i * is.stretch) * (1 + bent);
      const VectorOf<S, 4> by(1, drawn, 1, drawn);
      masses_[e] = (by.asDiagonal() * masses_[e] * by.asDiagonal()).eval();
    }
    this->rate_ = 0, this->set_rate(1);
  }
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
    this->each_product([this](int i) HAPBEAM_INLINED { return Placed<S>(at_[i] - ghost_[i]); },
                       [&](int i, const Placed<S>& off, const Placed<S>& force) HAPBEAM_INLINED {
                         const Placed<S>& at = at_[i];
                         const S along = at[2] * force[2] + at[3] * force[3],
                                 aside = at[3] * force[2] - at[2] * force[3];
                         seen_[i] = {{force[0], force[1]}, aside, blocks_[i].own.own[2] - along};
                         sum += force.cwiseProduct(off);
                       });
    return sum.sum() / 2;
  }
  /// c M (q - q~) of node i, as they lie: along x and w [N], and moment [N·m].
  template <class Nodes>
  VectorOf<S, 3> force(const Nodes& nodes, int i) const noexcept {
    const Placed<S> sum = this->product(i, [&](int k) { return Placed<S>(placed(nodes[k]) - ghost_[k]); });
    const Placed<S> at = placed(nodes[i]);
    return {sum[0], sum[1], at[3] * sum[2] - at[2] * sum[3]};
  }
  /// Adds to residual and tangent of elements what is their first nodes', and what couples both, as read by BlockTridiagonal::add_pairs().
  /// @param of  (f) -> f(e) of an element, or of those that are computed side by side
  template <class Of, class Residual, class Tangent>
  [[gnu::always_inline]] void add(Of&& of, Residual& r, Tangent& K) const noexcept {
    add_node(of, r, K);
    using Number = std::decay_t<decltype(r[0])>;
    const auto turn = [&](int k, int sign, int by) HAPBEAM_INLINED {
      return Number(of([&](int e) HAPBEAM_INLINED { return S(sign) * at_[e + by][k]; }));
    };
    const auto next = [&](auto member, int k) HAPBEAM_INLINED {
      return Number(of([&](int e) HAPBEAM_INLINED { return (blocks_[e].next.*member)[k]; }));
    };
    const Number ax = turn(3, 1, 0), ay = turn(2, -1, 0), bx = turn(3, 1, 1), by = turn(2, -1, 1);
    const Number own = next(&std::decay_t<decltype(blocks_[0].next)>::own, 0),
                 mine = next(&std::decay_t<decltype(blocks_[0].next)>::other, 0),
                 its = next(&std::decay_t<decltype(blocks_[0].next)>::other, 2);
    K(0, 3) += own, K(1, 4) += own;
    K(0, 5) += mine * bx, K(1, 5) += mine * by;
    K(2, 3) += its * ax, K(2, 4) += its * ay;
    K(2, 5) += next(&std::decay_t<decltype(blocks_[0].next)>::own, 2) * (ax * bx + ay * by);
  }
  /// What is one node's.   @param of  (f) -> f(i)
  template <class Of, class Residual, class Tangent>
  [[gnu::always_inline]] void add_node(Of&& of, Residual& r, Tangent& K) const noexcept {
    using Number = std::decay_t<decltype(r[0])>;
    const auto find = [&](auto&& f) HAPBEAM_INLINED { return Number(of(f)); };
    const Number own = find([this](int i) { return blocks_[i].own.own[0]; }),
                 other = find([this](int i) { return blocks_[i].own.other[0]; });
    r[0] += find([this](int i) { return seen_[i].force[0]; });
    r[1] += find([this](int i) { return seen_[i].force[1]; });
    r[2] += find([this](int i) { return seen_[i].moment; });
    K(0, 0) += own, K(1, 1) += own;
    K(2, 0) += other * find([this](int i) { return at_[i][3]; });
    K(2, 1) -= other * find([this](int i) { return at_[i][2]; });
    K(2, 2) += find([this](int i) { return seen_[i].stiffness; });
  }

 private:
  /// A node as it lies.
  struct Seen {
    Vector2<S> force;  ///< c M (q - q~) on its place [N],
    S moment;          ///< and on θ [N·m]
    S stiffness;       ///< by θ [N·m]
  };
  Values at_;  // q
  PerNode<Seen, Elements, MaxElements> seen_;
};

/// Ends of a beam in the plane: nothing leads them.
template <class Chain>
struct NoLedEnds {
  using S = typename Chain::Scalar;
  void stay(Chain&) noexcept {}
  void begin(S) noexcept {}
  void aim(Chain&, S, S, S) noexcept {}
  void settle(Chain&, S) noexcept {}
  void stop(Chain&) noexcept {}
};

}  // namespace hapbeam::detail

namespace hapbeam {

/// @tparam Size  of what a node has: MassBlocks
template <typename S, int Elements, int MaxElements, int Size = 4>
class TrBdf2 {
 public:
  using Placed = Eigen::Matrix<S, Size, 1>;
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
  /// @param v  (i) -> velocity of node i, of place and tangent
  template <class Velocity>
  void throw_at(Velocity&& v) noexcept {
    for (int i = 0; i < now_.size(); ++i) {
      const auto thrown = v(i);
      now_[i].v.template head<std::decay_t<decltype(thrown)>::RowsAtCompileTime>() = thrown;
    }
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
