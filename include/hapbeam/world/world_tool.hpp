// SPDX-License-Identifier: MIT
// One rod of a World in the hand, in the words of a model: what Grip holds.
//
//   World<TwistedRod> world({{tool, 16}, {wire, 16}});          // tool's left end on coupling.support(), its right end free
//   WorldTool<TwistedRod> held(world, 0);
//   Grip<WorldTool<TwistedRod>> grip(held, RodSide::left);
//   ServoLoop loop(device, grip, options);
//
// Real-time: as World; one tick() a hold().
#pragma once

#include <hapbeam/world/world.hpp>

namespace hapbeam {

template <class Element>
class WorldTool {
 public:
  using Scalar = double;
  static constexpr int dimension = 3;

  /// @param world  kept by reference   @param rod  of it
  WorldTool(World<Element>& world, int rod) noexcept : world_(world), rod_(rod) {}

  /// Takes an end there, and all of the world with it.
  HeldEnd<double> hold(RodSide side, const RodPose& pose) noexcept {
    const Status placed = world_.hold(rod_, side, pose);
    if (placed == Status::ok) (void)world_.tick();
    HeldEnd<double> held = world_.held(rod_, side);
    if (placed != Status::ok) held.status = placed;
    return held;
  }
  /// All of the world goes back to rest.
  void reset() noexcept { world_.reset(); }
  Centreline<double, 3> shape() const noexcept { return world_.shape(rod_); }
  /// Of all rods and their springs [J].
  double strain_energy() const noexcept { return world_.strain_energy(); }

 private:
  World<Element>& world_;
  int rod_;
};

}  // namespace hapbeam
