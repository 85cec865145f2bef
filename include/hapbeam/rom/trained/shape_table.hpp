// SPDX-License-Identifier: MIT
// The deformed shape of a trained model: POD modes, and their coefficients on a grid of presses.
//
// At the contact w‴ jumps, so that shapes at fixed places are not smooth in s.  In the snapshots the contact is always the same node,
// and the others share both sides evenly.  Displacements are made dimensionless:
//
//   w/d,   θ h/d,   u h/d²,    h the length of the node's side of the beam
//
// Real-time: noexcept, no allocation, O(modes (grid + nodes)).
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

#include <hapbeam/centreline.hpp>
#include <hapbeam/rom/trained/coordinates.hpp>
#include <hapbeam/rom/trained/lagrange.hpp>

namespace hapbeam {

/// Nodes that move with the contact, and the lengths that free their displacements of units.
template <typename Scalar>
class ContactFrame {
 public:
  /// @param contact_node 0 to segments   @param segments one or more
  ContactFrame(const BeamData<Scalar>& beam, int segments, int contact_node) noexcept
      : segments_(segments),
        contact_node_(contact_node),
        length_(beam.length),
        left_held_(fixes_w(beam.left)),
        right_held_(fixes_w(beam.right)) {}

  int segments() const noexcept { return segments_; }
  int contact_node() const noexcept { return contact_node_; }
  Scalar length() const noexcept { return length_; }

  /// Arc position of the contact's node for a contact at s: s, but at least a thousandth of the length away from an
  /// end, unless it is that end's node.
  Scalar contact(Scalar s) const noexcept {
    const Scalar least = length_ / 1000;
    const Scalar low = contact_node_ == 0 ? Scalar(0) : least;
    const Scalar high = contact_node_ == segments_ ? length_ : length_ - least;
    return (std::min)((std::max)(s, low), high);
  }
  /// Arc position of node i for a contact at s [m].  Where the contact's node cannot follow, the others do.
  Scalar position(int i, Scalar s) const noexcept {
    if (i == contact_node_) return contact(s);
    if (i < contact_node_) return Scalar(i) * left_spacing(s);
    return i == segments_ ? length_ : length_ - Scalar(segments_ - i) * right_spacing(s);
  }
  /// Between the nodes on one side of the contact [m].
  Scalar left_spacing(Scalar s) const noexcept { return (std::max)(s, contact(s)) / Scalar(contact_node_); }
  Scalar right_spacing(Scalar s) const noexcept {
    return (length_ - (std::min)(s, contact(s))) / Scalar(segments_ - contact_node_);
  }
  /// h of node i [m]: the length of its side.  A side whose end yields bends no more sharply when it gets short.
  Scalar side(int i, Scalar s) const noexcept {
    const Scalar left = left_held_ && contact_node_ > 0 ? s : length_;
    const Scalar right = right_held_ && contact_node_ < segments_ ? length_ - s : length_;
    return i < contact_node_ ? left : i > contact_node_ ? right : left * right / length_;
  }

 private:
  int segments_, contact_node_;
  Scalar length_;
  bool left_held_, right_held_;
};

/// The stored shapes.
template <typename Scalar>
struct ShapeData {
  int segments = 0;
  int contact_node = 0;
  int modes = 0;
  std::vector<Scalar> basis;         ///< mode by mode, its (u, w, θ) node by node, freed of units
  std::vector<Scalar> coefficients;  ///< grid point by grid point, its modes
  std::vector<Scalar> rest;  ///< (u, w, θ) of the untouched beam at segments + 1 even nodes [m, m, rad]
};

/// The shape of the last press.  The contact's node and its neighbours, which is where contact looks, come with the press;
/// the others at the first call that reads them.  What was trained stays with the model, which passes it in.
template <typename Scalar>
class ShapeTable {
 public:
  using Node = CentrelineNode<Scalar>;

  /// What makes the node at the contact and its neighbours: (u, w, θ) of the one before, u of its own, (u, w, θ) of the one
  /// after, freed of units; the last is the model's own.
  static constexpr int near_size = 8, own = 7;

  /// Allocates.  @param data  sizes that fit each other, as check() in model_data.hpp sees to
  /// @param positions, others  sizes of the grid
  [[gnu::cold]] ShapeTable(const BeamData<Scalar>& beam, const ShapeData<Scalar>& data, int positions,
                           int others)
      : frame_(beam, data.segments, data.contact_node),
        positions_(positions),
        others_(others),
        weights_(index(positions + others)),
        work_(index((others + 1) * data.modes) + data.rest.size()),
        nodes_(static_cast<std::size_t>(data.segments) + 1) {
    reset(data);
  }

  /// @param point  of the grid   @param nearby  out, near_size numbers
  [[gnu::cold]] static void tabulate(const ShapeData<Scalar>& data, int point, Scalar* nearby) noexcept {
    const int rows = 3 * (data.segments + 1), middle = 3 * data.contact_node;
    std::fill_n(nearby, near_size, Scalar(0));
    for (int mode = 0; mode < data.modes; ++mode) {
      const Scalar share = data.coefficients[static_cast<std::size_t>(point * data.modes + mode)];
      const Scalar* basis = data.basis.data() + mode * rows + middle;
      nearby[3] += share * basis[0];
      for (int k = 0; k < 3; ++k) {
        if (middle > 0) nearby[k] += share * basis[k - 3];
        if (middle + 3 < rows) nearby[4 + k] += share * basis[k + 3];
      }
    }
  }

  void reset(const ShapeData<Scalar>& data) noexcept {
    const Scalar* rest = data.rest.data();
    for (int i = 0; i <= data.segments; ++i, rest += 3)
      nodes_[index(i)] = {frame_.length() * Scalar(i) / Scalar(data.segments), rest[0], rest[1], rest[2]};
    nodes_.back().s = frame_.length();
    first_ = 0, last_ = data.segments;
  }

  /// The shape of a press by d at s.   O(1)
  /// @param lx, ly  interpolation weights along both axes of the grid
  /// @param unit [m]  what w is stored in units of   @param theta  rotation at the contact [rad], or none: by the modes
  /// @param nearby  interpolated
  void press(Scalar s, Scalar d, Scalar unit, const std::optional<Scalar>& theta, const Scalar* lx,
             const Scalar* ly, const Scalar* nearby) noexcept {
    s_ = s, d_ = d, unit_ = unit;
    theta_ = theta;
    std::copy_n(ly, others_, std::copy_n(lx, positions_, weights_.data()));
    const int middle = frame_.contact_node(), end = frame_.segments();
    first_ = (std::max)(middle - 1, 0), last_ = (std::min)(middle + 1, end);
    if (!theta || frame_.contact(s) != s) {
      last_ = first_ - 1;
      return;
    }
    nodes_[index(middle)] = {s, nearby[3] * unit * (unit / frame_.side(middle, s)), d, *theta};
    if (first_ < middle) place(first_, middle, nearby, frame_.left_spacing(s) * Scalar(first_), Scalar(0));
    if (last_ > middle) place(last_, last_ + 1, nearby + 4, s + frame_.right_spacing(s), Scalar(0));
    nodes_.back().s = frame_.length();
  }

  /// All of it.   O(modes (grid + nodes)) after a press, O(1) from then on
  Centreline<Scalar> all(const ShapeData<Scalar>& data) noexcept {
    if (first_ > 0 || last_ < data.segments) evaluate(data);
    return {nodes_.data(), static_cast<int>(nodes_.size())};
  }
  /// The pieces that hold arc positions s0 to s1.   O(1) beside the contact, elsewhere as all()
  CentrelinePart<Scalar> part(const ShapeData<Scalar>& data, Scalar s0, Scalar s1) noexcept {
    const bool left = first_ == 0 || s0 > nodes_[index(first_)].s,
               right = last_ == data.segments || s1 < nodes_[index(last_)].s;
    if (first_ < last_ && left && right)
      return {{nodes_.data() + first_, last_ - first_ + 1}, first_, data.segments};
    return part_of(all(data), s0, s1);
  }

 private:
  static std::size_t index(int i) noexcept { return static_cast<std::size_t>(i); }

  [[gnu::noinline]] void evaluate(const ShapeData<Scalar>& data) noexcept {
    const int modes = data.modes, rows = 3 * (data.segments + 1);
    Scalar *const row = work_.data(), *const mode = row + rows, *const column = mode + modes;
    detail::combine(data.coefficients.data(), others_ * modes, others_ * modes, weights_.data(), positions_,
                    column);
    detail::combine(column, modes, modes, weights_.data() + positions_, others_, mode);
    detail::combine(data.basis.data(), rows, rows, mode, modes, row);

    const Scalar contact = frame_.contact(s_);
    const int middle = frame_.contact_node(), last = data.segments;
    if (middle > 0) place(0, middle, row, Scalar(0), frame_.left_spacing(s_));
    place(middle, middle + 1, row + 3 * middle, contact, Scalar(0));
    if (middle < last) {
      const Scalar spacing = frame_.right_spacing(s_);
      place(middle + 1, last + 1, row + 3 * middle + 3, (std::min)(s_, contact) + spacing, spacing);
    }
    nodes_.back().s = frame_.length();
    // The contact itself is known better than its modes; where it is too near to an end for its node, the end is straight.
    Node& node = nodes_[index(middle)];
    if (theta_) node.theta = *theta_;
    node.w = d_ - node.theta * (contact - s_);
    if (contact < s_) straighten(middle + 1, last, node);
    if (contact > s_) straighten(0, middle - 1, node);
    first_ = 0, last_ = last;
  }

  /// Nodes on one side of the contact, or its own: they share their h and are evenly spaced from `start` on.
  /// @param row  (u, w, θ) of the first one, then of the others
  void place(int first, int end, const Scalar* row, Scalar start, Scalar spacing) noexcept {
    const Scalar unit = unit_, per_side = unit / frame_.side(first, s_);
    Node* node = nodes_.data() + first;
    for (int i = 0; i < end - first; ++i, row += 3)
      node[i] = {start + spacing * Scalar(i), row[0] * unit * per_side, row[1] * unit, row[2] * per_side};
  }
  /// Rare: the contact is within a thousandth of the length from an end.
  [[gnu::cold]] void straighten(int first, int last, const Node& from) noexcept {
    for (int i = first; i <= last; ++i) {
      Node& node = nodes_[index(i)];
      node = {node.s, from.u, from.w - from.theta * (node.s - from.s), from.theta};
    }
  }

  ContactFrame<Scalar> frame_;
  int positions_, others_;
  std::vector<Scalar> weights_;  // of the last press, along both axes
  std::vector<Scalar> work_;     // displacements of the last shape, freed of units; its modes; these by depth
  std::vector<Node> nodes_;
  int first_ = 0, last_ = 0;  // nodes that are those of the last press; none where last_ < first_
  // The last press.
  Scalar s_ = 0, d_ = 0, unit_ = 1;
  std::optional<Scalar> theta_;  // none: by the modes
};

}  // namespace hapbeam
