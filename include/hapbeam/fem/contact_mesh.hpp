// SPDX-License-Identifier: MIT
// Where a beam in closed form is drawn: nodes shared out evenly, one at the contact among them.
//
// Real-time: noexcept, no allocation, O(1).
#pragma once

#include <algorithm>
#include <cmath>

namespace hapbeam {

template <typename Scalar>
class ContactMesh {
 public:
  /// Evenly.  @param elements two or more   @param length [m]
  ContactMesh(int elements, Scalar length) noexcept
      : elements_(elements),
        node_(elements / 2),
        length_(length),
        s_(length * Scalar(elements / 2) / Scalar(elements)) {}

  /// With a node at s, the nearest one; the others share the parts on both sides evenly.  Node 0 or n is taken only where s is exactly that end.
  ContactMesh at(Scalar s) const noexcept {
    ContactMesh mesh(elements_, length_);
    mesh.s_ = std::clamp(s, Scalar(0), length_);
    mesh.node_ = s <= 0         ? 0
                 : s >= length_ ? elements_
                                : std::clamp(static_cast<int>(std::lround(s / length_ * Scalar(elements_))),
                                             1, elements_ - 1);
    return mesh;
  }

  int elements() const noexcept { return elements_; }
  int node() const noexcept { return node_; }  ///< the node at s()
  Scalar s() const noexcept { return s_; }     ///< [m]

  /// Arc position of node i [m].
  Scalar position(int i) const noexcept {
    if (i == node_) return s_;
    if (i < node_) return s_ * Scalar(i) / Scalar(node_);
    if (i == elements_) return length_;
    return s_ + (length_ - s_) * Scalar(i - node_) / Scalar(elements_ - node_);
  }

 private:
  int elements_, node_;
  Scalar length_, s_;
};

}  // namespace hapbeam
