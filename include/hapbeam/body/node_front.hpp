// SPDX-License-Identifier: MIT
// Contacts on the nodes of a chain, and condensation of these, from one of its ends on, with the forces of contacts as columns.
//
// The front has the first node and the last one that is known; with the next piece that one is condensed.
//
// A contact acts on a node of a beam, or so far from it along an arc with the curvature that the beam has there.
//
// D of a circle is that of the foot of its centre: with D(s) along the curve, D' = n · r', D'' = |t|²/D + n · r'',
//
//   D* = D - D'²/2D'',     ∂D* = ∂D - D' ∂D'/D'',     ∂²D* = ∂²D - ∂D' ∂D'ᵀ/D''         ∂: by u, w, θ of the node
//
// so that the place s needs no unknown: it goes to that foot, by -(D' + ∂D' Δ)/D''.
// Real-time: noexcept, no allocation, O(contacts²) a node.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include <hapbeam/angle.hpp>
#include <hapbeam/body/inner_contact.hpp>
#include <hapbeam/centreline.hpp>
#include <hapbeam/element/element.hpp>

namespace hapbeam::detail {

/// How the gap of a contact changes with u, w, θ of its node.
template <typename S>
struct GapChange {
  VectorOf<S, 3> by;
  Eigen::Matrix<S, 3, 3> twice;
  VectorOf<S, 3> slides;  ///< of its place along the surface
};

template <bool Turns, typename S>
struct ContactOnNode {
  using Vector = Vector2<S>;
  using Contact = InnerContact<S>;

  int node = 0;
  S arm = 0;                                   ///< from it [m]
  S slope = 0, bend = 1;                       ///< D' [-], D'' [1/m]
  VectorOf<S, 3> by = VectorOf<S, 3>::Zero();  ///< ∂D'

  /// Where a contact is.   @param curvature  of the arc, to its left [1/m]   @param most  which its place goes [m]
  GapChange<S> look(Contact& contact, const CentrelineNode<S>& at, S curvature, S most) noexcept {
    const S bow = curvature * arm * arm / 2, theta = at.theta - curvature * arm;
    const Vector along = tangent_of(at.theta), left = left_of(along);
    contact.was = at.s + arm;
    contact.moved = Vector(at.u, at.w) + arm * (along - Vector(1, 0)) + bow * left;
    contact.theta = theta;
    contact.place = Vector(contact.was, 0) + contact.moved;
    contact.tangent = tangent_of(theta);

    const Vector turns = Turns ? Vector(bow * along - arm * left) : Vector(0, -arm),
                 turns_twice = Turns ? Vector(-bow * left - arm * along) : Vector(0, 0);
    Eigen::Matrix<S, 2, 3> J;
    J << 1, 0, turns.x(), 0, 1, turns.y();
    GapChange<S> gap;
    const bool round = contact.kind == Contact::Kind::round;
    bool is_plane = false;
    const S distance =
        round ? contact.look_at_circle(contact.was, is_plane) : contact.normal.dot(contact.moved);
    contact.gap = distance - contact.reach;
    const Vector n = contact.normal, t(-n.y(), n.x());
    gap.by = J.transpose() * n, gap.slides = J.transpose() * t;
    gap.twice.setZero();
    gap.twice(2, 2) = n.dot(turns_twice);
    if (!round) return gap;
    if (is_plane) {
      slope = contact.tangent.dot(contact.place - contact.centre) / contact.tangent.squaredNorm();
      by.setZero(), bend = 1;
      return gap;
    }
    gap.twice += gap.slides * gap.slides.transpose() / distance;
    if (!contact.moves) return gap;
    const S across = t.dot(contact.tangent), turn = n.dot(left_of(contact.tangent));
    slope = n.dot(contact.tangent), by = across / distance * gap.slides;
    by[2] -= turn;
    // Where the curve is as sharp as the circle, the distance has no minimum.
    bend = across * across / distance + curvature * turn;
    if (!(bend * distance > blunt)) bend = blunt / distance;
    const S way = goes(VectorOf<S, 3>::Zero(), most);
    contact.gap += way * (slope + way * bend / 2);
    gap.by += way * by, gap.twice -= by * by.transpose() / bend;
    return gap;
  }
  /// How far its place goes where the node is moved [m].
  S goes(const VectorOf<S, 3>& moved, S most) const noexcept {
    return std::clamp(S(-(slope + by.dot(moved)) / bend), -most, most);
  }

 private:
  static constexpr S blunt = S(0.05);  // least D'', of that of a straight curve

  static Vector tangent_of(S theta) noexcept { return Turns ? direction(S(-theta)) : Vector(1, -theta); }
  static Vector left_of(const Vector& tangent) noexcept {
    return Turns ? Vector(-tangent.y(), tangent.x()) : Vector(0, 1);
  }
};

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
