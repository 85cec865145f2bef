// SPDX-License-Identifier: MIT
// Condensation of the nodes of a chain, from one of its ends on, with the forces of contacts as columns.
//
// The front has the first node and the last one that is known; with the next piece that one is condensed.
// Real-time: noexcept, no allocation, O(contacts²) a node.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include <hapbeam/body/contact_on_node.hpp>
#include <hapbeam/element/element.hpp>

namespace hapbeam::detail {

/// @tparam Most  contacts, and nodes that are condensed
template <typename S, int Most>
class NodeFront {
  static constexpr int node = 3, both = 2 * node, all = 3 * node, columns = Most + 1;
  static constexpr int front_gradient = both + Most, gradient = all + Most;
  using Vector3 = VectorOf<S, 3>;

 public:
  using Forces = std::array<S, Most>;

  /// The first piece.
  void begin(const Vector6<S>& r, const Matrix6<S>& K) noexcept {
    front_.setZero();
    front_.template leftCols<both>() = K, front_.col(front_gradient) = r;
    residual_.fill(0);
    for (Forces& row : yields_) row.fill(0);
    change_ = longer_ = 0;
    negative_ = condensed_ = 0;
  }
  /// A contact.   @param first  whether it is on the first node, else on the last one   @param k  its number
  void touch(bool first, int k, const InnerContact<S>& contact, const GapChange<S>& gap) noexcept {
    const int from = first ? 0 : node;
    const Vector2<S> t(-contact.normal.y(), contact.normal.x());
    residual_[of(k)] = -contact.gap;
    front_.template block<node, 1>(from, both + k) -= gap.by;
    front_.template block<node, 1>(from, front_gradient) -=
        contact.force * gap.by + contact.friction.dot(t) * gap.slides;
    front_.template block<node, node>(from, from) +=
        contact.friction_stiffness * gap.slides * gap.slides.transpose() - contact.force * gap.twice;
  }
  /// The last node, with the next piece.
  void condense(const Vector6<S>& r, const Matrix6<S>& K) noexcept {
    Chain A = Chain::Zero();  // of that node, the first one, and the next one
    const auto block = [&A](int i, int j) { return A.template block<node, node>(i, j); };
    const auto front = [this](int i, int j) { return front_.template block<node, node>(i, j); };
    const auto piece = [&K](int i, int j) { return K.template block<node, node>(i, j); };
    block(0, 0) = front(node, node) + piece(0, 0), block(0, node) = front(node, 0);
    block(node, 0) = front(0, node), block(node, node) = front(0, 0);
    block(0, both) = piece(0, node), block(both, 0) = piece(node, 0), block(both, both) = piece(node, node);
    A.template block<node, columns>(0, all) = front_.template block<node, columns>(node, both);
    A.template block<node, columns>(node, all) = front_.template block<node, columns>(0, both);
    A.col(gradient).template head<node>() += r.template head<node>();
    A.col(gradient).template tail<node>() = r.template tail<node>();
    for (int u = 0; u < node; ++u) eliminate(u, A);
    rows_[of(condensed_++)] = A.template topRows<node>();
    front_.template leftCols<both>() = A.template block<both, both>(node, node);
    front_.template rightCols<columns>() = A.template block<both, columns>(node, all);
  }

  Vector6<S> residual() const noexcept { return front_.col(front_gradient); }
  Matrix6<S> tangent() const noexcept { return front_.template leftCols<both>(); }
  /// Of contact k.
  Vector6<S> column(int k) const noexcept { return front_.col(both + k); }
  S residual(int k) const noexcept { return residual_[of(k)]; }
  S yields(int k, int other) const noexcept {
    return yields_[of((std::min)(k, other))][of((std::max)(k, other))];
  }
  /// What condensed nodes change Π by [J].
  S change() const noexcept { return change_; }
  /// The square of their increments in the norm of the tangent [J].
  S longer() const noexcept { return longer_; }
  int negative_pivots() const noexcept { return negative_; }
  /// Increment of a node that was condensed.   @param i  how many before it   @param first, next  those of the nodes left then
  Vector3 recover(int i, const Vector3& first, const Vector3& next, const Forces& forces) const noexcept {
    const auto& A = rows_[of(i)];
    Vector3 sum = A.col(gradient);
    sum += A.template middleCols<node>(node) * first + A.template middleCols<node>(both) * next;
    for (int k = 0; k < Most; ++k) sum += forces[of(k)] * A.col(all + k);
    Vector3 x;
    for (int u = node - 1; u >= 0; --u) {
      for (int j = u + 1; j < node; ++j) sum[u] += A(u, j) * x[j];
      x[u] = -sum[u] / A(u, u);
    }
    return x;
  }

 private:
  using Chain = Eigen::Matrix<S, all, all + columns>;
  static constexpr std::size_t of(int i) noexcept { return static_cast<std::size_t>(i); }

  void eliminate(int u, Chain& A) noexcept {
    const S over = 1 / A(u, u);
    if (over < 0) ++negative_;
    for (int i = u + 1; i < all; ++i) {
      const S factor = A(u, i) * over;
      for (int j = u + 1; j <= gradient; ++j) A(i, j) -= factor * A(u, j);
    }
    for (int k = 0; k < Most; ++k) {
      const S factor = A(u, all + k) * over;
      residual_[of(k)] -= factor * A(u, gradient);
      for (int j = k; j < Most; ++j) yields_[of(k)][of(j)] -= factor * A(u, all + j);
    }
    const S by = A(u, gradient) * A(u, gradient) * over;
    change_ -= by / 2, longer_ += std::abs(by);
  }

  Eigen::Matrix<S, both, both + columns> front_;
  std::array<Eigen::Matrix<S, node, all + columns>, Most> rows_;
  std::array<Forces, Most> yields_;
  Forces residual_;
  S change_ = 0, longer_ = 0;
  int negative_ = 0, condensed_ = 0;
};

}  // namespace hapbeam::detail
