// SPDX-License-Identifier: MIT
// What one thread draws while another one ticks: the newest record and the shape of the model.
//
// Allocates at construction.  Real-time: all else is noexcept and allocation-free, O(nodes).
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include <hapbeam/contact/touch.hpp>
#include <hapbeam/haptics/servo/servo_record.hpp>
#include <hapbeam/haptics/stability/coupling.hpp>

namespace hapbeam {

/// What is drawn: the record and the centreline of one tick.
/// @tparam D  of the space in which the beam bends: 2 | 3
template <typename Scalar, int D = 2>
class ServoPicture {
  using Shape = Centreline<Scalar, D>;
  using Node = typename Shape::Node;

 public:
  /// @param shape  as many nodes as it has, and `room` at least, are kept in later ones
  explicit ServoPicture(const Shape& shape)
      : nodes_((std::max)(room, static_cast<std::size_t>(shape.size()))) {
    take(shape);
  }

  ServoRecord record;
  Shape shape() const noexcept {
    if constexpr (D == 2) return {nodes_.data(), size_, any_rotation_};
    else return {nodes_.data(), size_};
  }

  void take(const Shape& shape) noexcept {
    size_ = copy(shape, nodes_.data(), static_cast<int>(nodes_.size()));
    if constexpr (D == 2) any_rotation_ = shape.any_rotation();
  }
  void take(const ServoPicture& other) noexcept { take(other.shape()); }

  /// Of a shape with more nodes than there is room for, every second one is taken, or third, …, and the last.
  /// @param most  two or more   @return how many
  static int copy(const Shape& shape, Node* nodes, int most) noexcept {
    const int last = shape.size() - 1, step = 1 + (last - 1) / (most - 1);
    int size = 0;
    for (int i = 0; i < last; i += step) nodes[size++] = shape[i];
    nodes[size++] = shape[last];
    return size;
  }

 private:
  static constexpr std::size_t room = 513;  // models that hand over to others change their number of nodes

  std::vector<Node> nodes_;
  int size_ = 0;
  bool any_rotation_ = false;  // of a planar one
};

/// What is drawn of a model: its shape.  Arrays have another (servo_many.hpp).
template <typename Model>
struct Drawn {
  using Picture = ServoPicture<typename Model::Scalar, detail::dimension_of_touch<Touch<Model>>>;
  static constexpr bool for_who_looks =
      detail::offers<detail::Part, Model>;  ///< it costs more than the force
  static auto of(const Model& model, const Touch<Model>&) noexcept { return model.shape(); }
};

}  // namespace hapbeam
