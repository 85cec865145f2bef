// SPDX-License-Identifier: MIT
// Both ends of a rod in its equations: what they hold is prescribed, in their own axes, and their springs are added.
//
// A clamped end has one unknown, how much longer r' becomes.  Any other end has those of place and of r' along the axes of what holds them; the twist
// of a joint is less what the director turns by with r'.
// Real-time: noexcept, no allocation, O(1).
#pragma once

#include <cstddef>

#include <hapbeam/fem/rod/rod_end.hpp>

namespace hapbeam::detail {

/// @tparam Unknowns  of a node: 6, or 7 with φ
template <typename Scalar, int Unknowns>
class RodEnds {
  static constexpr bool has_twist = Unknowns == 7;
  using Vector3 = VectorOf<Scalar, 3>;
  using Matrix = Eigen::Matrix<Scalar, 3, 3>;
  using Increment = VectorOf<Scalar, Unknowns>;
  using Block = Eigen::Matrix<Scalar, Unknowns, Unknowns>;

 public:
  /// @param nodes  of the natural shape
  template <class Nodes>
  RodEnds(const Rod& rod, const Nodes& nodes)
      : last_(nodes.size() - 1), ends_{{rod.left(), nodes[0]}, {rod.right(), nodes[last_]}} {}

  RodEnd<Scalar>& operator[](std::size_t k) noexcept { return ends_[k]; }
  const RodEnd<Scalar>& operator[](std::size_t k) const noexcept { return ends_[k]; }
  int node(std::size_t k) const noexcept { return k == 0 ? 0 : last_; }
  /// Whether a node is an end that holds something.
  bool has(int node) const noexcept {
    return (node == 0 && !ends_[0].is_free()) || (node == last_ && !ends_[1].is_free());
  }

  /// A path begins where the ends are.
  template <class Nodes>
  void begin_path(const Nodes& nodes) noexcept {
    for (std::size_t k = 0; k < 2; ++k) ends_[k].begin(nodes[node(k)]);
  }
  void set_target(Scalar t) noexcept {
    for (auto& end : ends_) end.set_target(t);
  }
  /// Whether increments lead to where they belong.
  template <class Nodes>
  bool follow(const Nodes& nodes) const noexcept {
    return ends_[0].follows(nodes[0]) && ends_[1].follows(nodes[last_]);
  }
  /// Puts them exactly there.
  template <class Nodes>
  void correct(Nodes& nodes) const noexcept {
    for (std::size_t k = 0; k < 2; ++k) ends_[k].correct(nodes[node(k)]);
  }
  /// Shares out what the chain misses of a held right end.  A left end that is not held moves all of it.
  template <class Nodes>
  void close_chain(Nodes& nodes, Scalar length) const noexcept {
    const Vector3 miss = ends_[1].miss(nodes[last_]);
    const bool left = ends_[0].is_anchored();
    for (auto& to : nodes) to.r += left ? Vector3(miss * (to.s / length)) : miss;
  }

  /// Calls visit(node, tangent, residual) for what springs make of an end's node.   @return their energy [J]
  template <class Nodes, class Visit>
  Scalar visit_springs(const Nodes& nodes, Visit&& visit) const noexcept {
    Scalar energy = 0;
    for (std::size_t k = 0; k < 2; ++k) {
      if (!ends_[k].has_springs()) continue;
      Increment r = Increment::Zero();
      Block K = Block::Zero();
      energy += ends_[k].add_springs(nodes[node(k)], r, K);
      visit(node(k), K, r);
    }
    return energy;
  }

  /// After all else is in the assembler's system.
  template <class Nodes, class Rows, class Assembler>
  void hold(const Nodes& nodes, Rows& rows, Assembler& assembler) noexcept {
    for (std::size_t k = 0; k < 2; ++k) {
      const auto& at = nodes[node(k)];
      if (ends_[k].is_free()) continue;
      if (is_clamped(k)) {
        prescribed_[k] = ends_[k].template way<Increment>(at);
        assembler.clamp(node(k), ends_[k].direction(), prescribed_[k]);
      } else {
        hold_part(k, at, assembler);
      }
      rows.visit_node(node(k), [&](auto&& b, Scalar& residual) { hold_row(k, at, b, residual); });
    }
  }
  /// Of a node for which has() is true, from the assembler's answer: r, r' and φ in space.
  template <class Node>
  Increment increment(const Increment& answer, int i, const Node& at) const noexcept {
    const std::size_t k = i == 0 ? 0 : 1;
    Increment x = prescribed_[k];
    if (is_clamped(k)) {
      x.template segment<3>(3) += answer[5] * ends_[k].direction();
      return x;
    }
    x += answer;
    const Matrix *const R = ends_[k].place_axes(), *const T = ends_[k].tangent_axes();
    const auto turn = [&x](int from, const Matrix& Q) {
      const Vector3 v(x[from], x[from + 1], x[from + 2]);
      for (int c = 0; c < 3; ++c) x[from + c] = Q(c, 0) * v[0] + Q(c, 1) * v[1] + Q(c, 2) * v[2];
    };
    if (R) turn(0, *R);
    if (T) turn(3, *T);
    if constexpr (has_twist)
      if (ends_[k].is_joint()) x[6] -= ends_[k].arm(at).dot(x.template segment<3>(3));
    return x;
  }

 private:
  /// The same of a row of the system, of what that has of an end's node.   @param b  in and out   @param residual  in and out
  template <class Part, class Node>
  void hold_row(std::size_t k, const Node& at, Part&& b, Scalar& residual) const noexcept {
    const auto dot = [&b](int from, const auto& v) {
      return v[0] * b[from] + v[1] * b[from + 1] + v[2] * b[from + 2];
    };
    if (is_clamped(k)) {
      const Scalar along = dot(3, ends_[k].direction());
      residual += b.dot(prescribed_[k]);
      b.setZero();
      b[5] = along;
      return;
    }
    if constexpr (has_twist)
      if (ends_[k].is_joint()) {
        const Vector3 arm = ends_[k].arm(at);
        for (int c = 0; c < 3; ++c) b[3 + c] -= b[6] * arm[c];
      }
    const auto turn = [&b, &dot](int from, const Matrix& Q) {
      const Vector3 turned(dot(from, Q.col(0)), dot(from, Q.col(1)), dot(from, Q.col(2)));
      for (int c = 0; c < 3; ++c) b[from + c] = turned[c];
    };
    if (const Matrix* const R = ends_[k].place_axes()) turn(0, *R);
    if (const Matrix* const T = ends_[k].tangent_axes()) turn(3, *T);
    ends_[k].template visit<has_twist>(at, [&](int component, Scalar increment) {
      residual += b[component] * increment;
      b[component] = 0;
    });
  }
  /// The same of an end that is not clamped.  Not inlined by intent: few rods have one, and factor() is long.
  template <class Assembler, class Node>
  [[gnu::noinline]] void hold_part(std::size_t k, const Node& at, Assembler& assembler) noexcept {
    const int i = node(k);
    if constexpr (has_twist)
      if (ends_[k].is_joint()) {
        Block K = Block::Zero();
        K.template block<3, 3>(3, 3) = assembler.residual(i, 6) * ends_[k].bow(at);
        assembler.add_at(i, K, Increment::Zero());
        assembler.template lean<6, 3>(i, ends_[k].arm(at));
      }
    const Matrix *const R = ends_[k].place_axes(), *const T = ends_[k].tangent_axes();
    if (R) assembler.template turn<0>(i, *R);
    if (T) assembler.template turn<3>(i, *T);
    prescribed_[k].setZero();
    ends_[k].template visit<has_twist>(at, [&](int component, Scalar increment) {
      prescribed_[k][component] = increment;
      assembler.prescribe(i, component, increment);
    });
  }
  bool is_clamped(std::size_t k) const noexcept { return ends_[k].template is_clamped<has_twist>(); }

  int last_;
  RodEnd<Scalar> ends_[2];
  Increment prescribed_[2] = {Increment::Zero(), Increment::Zero()};
};

}  // namespace hapbeam::detail
