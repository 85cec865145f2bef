// The deformed shape of a trained model: POD modes, and their coefficients on a grid of presses.
//
// A fixed mesh would be of little use.  At the contact w''' jumps, and the jump moves with the contact: shapes at fixed
// places are not smooth in s, and interpolating them between 16 positions leaves slopes wrong by a fifth.  Snapshots are
// therefore taken where the contact is always the same node, the others sharing both sides evenly, and freed of units:
//
//   w/d,   θ h/d,   u h/d²,    h the length of the node's side of the beam
//
// Real-time: noexcept, no allocation, O(modes (grid + nodes)).
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include <hapbeam/centreline.hpp>
#include <hapbeam/rom/trained/combine.hpp>
#include <hapbeam/rom/trained/coordinates.hpp>

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

  /// Where the contact's node is for a contact at s: there, or a thousandth of the length away from an end, unless it
  /// is that end's node.
  Scalar contact(Scalar s) const noexcept {
    const Scalar least = length_ / 1000;
    const Scalar low = contact_node_ == 0 ? Scalar(0) : least;
    const Scalar high = contact_node_ == segments_ ? length_ : length_ - least;
    return std::min(std::max(s, low), high);
  }
  /// Arc position of node i for a contact at s [m].  Where the contact's node cannot follow, the others do.
  Scalar position(int i, Scalar s) const noexcept {
    if (i == contact_node_) return contact(s);
    if (i < contact_node_) return Scalar(i) * left_spacing(s);
    return i == segments_ ? length_ : length_ - Scalar(segments_ - i) * right_spacing(s);
  }
  /// Between the nodes on one side of the contact [m].
  Scalar left_spacing(Scalar s) const noexcept { return std::max(s, contact(s)) / Scalar(contact_node_); }
  Scalar right_spacing(Scalar s) const noexcept {
    return (length_ - std::min(s, contact(s))) / Scalar(segments_ - contact_node_);
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

/// What is stored of the shapes.
template <typename Scalar>
struct ShapeData {
  int segments = 0;
  int contact_node = 0;
  int modes = 0;
  std::vector<Scalar> basis;         ///< mode by mode, its (u, w, θ) node by node, freed of units
  std::vector<Scalar> coefficients;  ///< grid point by grid point, its modes
  std::vector<Scalar> rest;  ///< (u, w, θ) of the untouched beam at segments + 1 even nodes [m, m, rad]
};

/// The shape of the last press.  What was trained stays with the model, which passes it in.
template <typename Scalar>
class ShapeTable {
 public:
  using Node = CentrelineNode<Scalar>;

  /// Allocates.  @param data  sizes that fit each other, as check() in model_data.hpp sees to
  [[gnu::cold]] ShapeTable(const BeamData<Scalar>& beam, const ShapeData<Scalar>& data)
      : frame_(beam, data.segments, data.contact_node),
        length_(beam.length),
        work_(data.coefficients.size() + static_cast<std::size_t>(data.modes) + data.rest.size()),
        nodes_(static_cast<std::size_t>(data.segments) + 1) {
    reset(data);
  }

  Centreline<Scalar> centreline() const noexcept { return {nodes_.data(), static_cast<int>(nodes_.size())}; }

  void reset(const ShapeData<Scalar>& data) noexcept {
    const Scalar* rest = data.rest.data();
    for (int i = 0; i <= data.segments; ++i, rest += 3)
      nodes_[static_cast<std::size_t>(i)] = {length_ * Scalar(i) / Scalar(data.segments), rest[0], rest[1],
                                             rest[2]};
    nodes_.back().s = length_;
  }

  /// The shape of a press by d at s.
  /// @param lx, positions, ly, others  interpolation weights along both axes of the grid
  /// @param unit [m]  what w is stored in units of   @param theta  rotation at the contact [rad], or null: by the modes
  void evaluate(const ShapeData<Scalar>& data, Scalar s, Scalar d, Scalar unit, const Scalar* theta,
                const Scalar* lx, int positions, const Scalar* ly, int others) noexcept {
    const int modes = data.modes, rows = 3 * (data.segments + 1);
    Scalar *const row = work_.data(), *const mode = row + rows, *const column = mode + modes;
    detail::combine(data.coefficients.data(), others * modes, others * modes, lx, positions, column);
    detail::combine(column, modes, modes, ly, others, mode);
    detail::combine(data.basis.data(), rows, rows, mode, modes, row);

    const Scalar contact = frame_.contact(s);
    const int middle = frame_.contact_node(), last = frame_.segments();
    if (middle > 0) place(0, middle, s, Scalar(0), frame_.left_spacing(s), unit);
    place(middle, middle + 1, s, contact, Scalar(0), unit);
    if (middle < last) {
      const Scalar spacing = frame_.right_spacing(s);
      place(middle + 1, last + 1, s, std::min(s, contact) + spacing, spacing, unit);
    }
    nodes_.back().s = length_;
    // The contact itself is known better than its modes; where it is too near to an end for its node, the end is straight.
    Node& node = nodes_[static_cast<std::size_t>(middle)];
    if (theta) node.theta = *theta;
    node.w = d - node.theta * (contact - s);
    if (contact < s) straighten(middle + 1, last, node);
    if (contact > s) straighten(0, middle - 1, node);
  }

 private:
  /// Nodes on one side of the contact, or its own: they share their h and are evenly spaced from `start` on.
  [[gnu::noinline]] void place(int first, int end, Scalar s, Scalar start, Scalar spacing,
                               Scalar unit) noexcept {
    const Scalar per_side = unit / frame_.side(first, s);
    const Scalar* row = work_.data() + 3 * first;
    Node* node = nodes_.data() + first;
    for (int i = 0; i < end - first; ++i, row += 3)
      node[i] = {start + spacing * Scalar(i), row[0] * unit * per_side, row[1] * unit, row[2] * per_side};
  }
  /// Rare: the contact is within a thousandth of the length from an end.
  [[gnu::cold]] void straighten(int first, int last, const Node& from) noexcept {
    for (int i = first; i <= last; ++i) {
      Node& node = nodes_[static_cast<std::size_t>(i)];
      node = {node.s, from.u, from.w - from.theta * (node.s - from.s), from.theta};
    }
  }

  ContactFrame<Scalar> frame_;
  Scalar length_;
  std::vector<Scalar> work_;  // displacements of the last shape, freed of units; its modes; these by depth
  std::vector<Node> nodes_;
};

}  // namespace hapbeam
