// SPDX-License-Identifier: MIT
// The inertia of a beam in the plane as a step of time (motion/tr_bdf2.hpp) sees it: a spring to where it would be without force.
//
//   Π = V + ½ c |q - q~|²          |·|² = qᵀ M q,   q: place and unit tangent (x, y, cos θ, -sin θ) of each node
//
// What a chain calls is virtual: whatever makes one compiles it, and a chain that only may move with one does not.
// Allocates and throws at construction; all else is noexcept and allocation-free, O(n).
#pragma once

#include <type_traits>

#include <hapbeam/angle.hpp>
#include <hapbeam/beam.hpp>
#include <hapbeam/centreline.hpp>
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/fem/mass_blocks.hpp>
#include <hapbeam/fem/rod/rod_lanes.hpp>
#include <hapbeam/fem/solver/per_node.hpp>
#include <hapbeam/vectors.hpp>

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
  using Nodes = PerNode<CentrelineNode<S>, Elements, MaxElements>;
  using Lanes = Pack<S>;

 public:
  using typename Base::Values;

  template <class At>
  Inertia(const Beam& beam, int elements, At&& at)
      : Base(beam, elements, at), at_(elements), seen_(elements) {}

  /// To be called once: unit tangents stand for those of the curve, which is longer than the beam where that is drawn.
  /// @param rest  nodes
  void draw(const Nodes& rest) noexcept {
    for (int e = 0; e + 1 < static_cast<int>(rest.size()); ++e) {
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
  virtual S look(const Nodes& nodes) noexcept {
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
  VectorOf<S, 3> force(const Nodes& nodes, int i) const noexcept {
    const Placed<S> sum = this->product(i, [&](int k) { return Placed<S>(placed(nodes[k]) - ghost_[k]); });
    const Placed<S> at = placed(nodes[i]);
    return {sum[0], sum[1], at[3] * sum[2] - at[2] * sum[3]};
  }
  /// Adds to residual and tangent of elements what is their first nodes', and what couples both, as read by BlockTridiagonal::add_pairs().
  /// @param first  place of the first of those that are computed side by side
  virtual void add(int first, Vector6<Lanes>& r, Matrix6<Lanes>& K) const noexcept {
    Abreast<S> elements;
    PairOrder{blocks_.size() - 1}.elements_from(first, elements.of);
    const auto of = [&elements](auto&& f) HAPBEAM_INLINED { return gather(elements, f); };
    add_element(of, r, K);
  }
  /// What is the last node's.
  virtual void add_last(VectorOf<S, 3>& r, Eigen::Matrix<S, 3, 3>& K) const noexcept {
    add_node([last = blocks_.size() - 1](auto&& f) { return f(last); }, r, K);
  }

  /// c M of u, w and θ of all nodes, as they lie.  Allocates.
  [[gnu::cold]] Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic> matrix() const {
    const int last = blocks_.size() - 1;
    Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic> M = decltype(M)::Zero(3 * (last + 1), 3 * (last + 1));
    for (int e = 0; e <= last; ++e) {
      const auto of = [e](auto&& f) { return f(e); };
      Vector6<S> none = Vector6<S>::Zero();
      Matrix6<S> m = Matrix6<S>::Zero();
      e < last ? add_element(of, none, m) : add_node(of, none, m);
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
          M(3 * e + i, 3 * e + j) += m((std::max)(i, j), (std::min)(i, j));
          if (e < last) M(3 * e + i, 3 * e + 3 + j) = M(3 * e + 3 + j, 3 * e + i) = m(i, 3 + j);
        }
    }
    return M;
  }

 private:
  /// What is an element's, but for its second node.   @param of  (f) -> f(e)
  template <class Of, class Residual, class Tangent>
  [[gnu::always_inline]] void add_element(Of&& of, Residual& r, Tangent& K) const noexcept {
    using Number = std::decay_t<decltype(r[0])>;
    add_node(of, r, K);
    const auto turn = [&](int k, int sign, int by) HAPBEAM_INLINED {
      return Number(of([&](int e) HAPBEAM_INLINED { return S(sign) * at_[e + by][k]; }));
    };
    const auto next = [&](auto member, int k) HAPBEAM_INLINED {
      return Number(of([&](int e) HAPBEAM_INLINED { return (blocks_[e].next.*member)[k]; }));
    };
    const Number ax = turn(3, 1, 0), ay = turn(2, -1, 0), bx = turn(3, 1, 1), by = turn(2, -1, 1);
    const Number own = next(&Block::own, 0), mine = next(&Block::other, 0), its = next(&Block::other, 2);
    K(0, 3) += own, K(1, 4) += own;
    K(0, 5) += mine * bx, K(1, 5) += mine * by;
    K(2, 3) += its * ax, K(2, 4) += its * ay;
    K(2, 5) += next(&Block::own, 2) * (ax * bx + ay * by);
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
