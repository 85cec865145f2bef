// SPDX-License-Identifier: MIT
// AnyTouchSeveral of a model: TouchSeveral, whose constructor takes lists that a program writes out, of numbers that are known when it runs.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <memory>
#include <utility>
#include <vector>

#include "any_model.hpp"
#include "space.hpp"

namespace hapbeam::python {

template <class Model>
class TouchSeveralOf final : public AnyTouchSeveral {
  static constexpr int D = dimension_of<Model>;
  using Vector = VectorOf<double, D>;

 public:
  TouchSeveralOf(Model& model, std::initializer_list<RoundAvatar> avatars,
                 std::initializer_list<Prop<D>> props)
      : touch_(model, avatars, props) {}

  FeltSeveral tick(const std::vector<Place>& positions) override {
    std::vector<Vector> all;
    for (const Place& position : positions) {
      if constexpr (D == 2) all.push_back(flat(position));
      else all.push_back(position);
    }
    const auto felt = touch_.tick(all.data(), static_cast<int>(all.size()));
    FeltSeveral result{D, felt.status, {}};
    for (const auto& place : felt) result.places.push_back(spatial(place));
    return result;
  }
  void reset() noexcept override { touch_.reset(); }
  void soften(int avatar, double stiffness, double damping) override {
    touch_.soften(avatar, stiffness, damping);
  }
  int dimension() const noexcept override { return D; }

 private:
  TouchSeveral<Model> touch_;
};

template <class T, class Use, std::size_t... I>
auto with_list_of(const std::vector<T>& all, Use&& use, std::index_sequence<I...>) {
  return use(std::initializer_list<T>{all[I]...});
}

/// use(list) with a list of what is in `all`, or of the first Most of them where there are more.
template <std::size_t Most, class T, class Use>
auto with_list(const std::vector<T>& all, Use&& use) {
  if constexpr (Most > 0)
    if (all.size() < Most) return with_list<Most - 1>(all, std::forward<Use>(use));
  return with_list_of(all, std::forward<Use>(use), std::make_index_sequence<Most>());
}

/// @throws as TouchSeveral, and NotOffered for props of another space
template <class Model>
std::unique_ptr<AnyTouchSeveral> touch_several_of(Model& model, const Bodies& bodies) {
  constexpr int D = dimension_of<Model>;
  // One more than there is room for is enough for TouchSeveral to reject them.
  constexpr std::size_t most = Model::contacts + 1;
  if (D == 2 ? !bodies.in_space.empty() : !bodies.in_plane.empty())
    throw NotOffered(D == 2 ? "TouchSeveral: a beam in the plane takes Prop, not RodProp"
                            : "TouchSeveral: a rod takes RodProp, not Prop");
  const auto& props = [&]() -> auto& {
    if constexpr (D == 2) return bodies.in_plane;
    else return bodies.in_space;
  }
  ();
  return with_list<most>(bodies.avatars, [&](std::initializer_list<RoundAvatar> avatars) {
    return with_list<most>(props, [&](std::initializer_list<Prop<D>> list) {
      return std::unique_ptr<AnyTouchSeveral>(std::make_unique<TouchSeveralOf<Model>>(model, avatars, list));
    });
  });
}

}  // namespace hapbeam::python
