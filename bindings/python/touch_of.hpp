// SPDX-License-Identifier: MIT
// AnyTouch, AnyServo, AnyGrip and AnyArray of a model.
#pragma once

#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

#include "any_model.hpp"
#include "space.hpp"
#include <hapbeam/haptics/held/grip.hpp>
#include <hapbeam/many/touch_many.hpp>

namespace hapbeam::python {

/// One avatar on a model.
template <class Model>
class TouchOf final : public AnyTouch {
  static constexpr int D = dimension_of<Model>;

 public:
  TouchOf(Model& model, double avatar_radius, const Friction& friction)
      : touch_(model, avatar_radius, friction) {}

  Felt tick(const Place& position, const Place& shaft) noexcept override {
    if constexpr (D == 2) return {D, spatial(touch_.tick(flat(position)))};
    else return {D, touch_.tick(position, shaft)};
  }
  void reset() noexcept override { touch_.reset(); }
  void soften(double stiffness, double damping) override { touch_.soften(stiffness, damping); }
  bool pressing() const noexcept override { return touch_.pressing(); }
  bool resting() const noexcept override { return touch_.resting(); }
  int dimension() const noexcept override { return D; }

 private:
  Touch<Model> touch_;
};

/// @tparam Pressed  a model, or a Grip of one
template <class Pressed>
class ServoOf final : public AnyServo {
 public:
  template <class... More>
  ServoOf(Pressed& pressed, const DeviceInfo& device, const ServoOptions& options, const More&... coupling)
      : servo_(pressed, device, options, coupling...) {}

  Eigen::Vector3d tick(const DeviceState& state) noexcept override { return servo_.tick(state); }
  Wrench tick(const OrientedState& state) override {
    if constexpr (dimension_of<Pressed> == 3) return servo_.tick(state);
    else throw NotOffered("tick(): a beam in the plane takes no orientation");
  }
  Eigen::Vector3d tick(const Eigen::Vector3d& position, const Eigen::Vector3d& velocity,
                       double dt) noexcept override {
    return servo_.tick(position, velocity, dt);
  }
  void reset() noexcept override { servo_.reset(); }
  const ServoRecord& record() const noexcept override { return servo_.record(); }
  CouplingFigures coupling() const noexcept override {
    if constexpr (std::is_same_v<typename CouplingOf<Pressed>::Type, GripCoupling>)
      return servo_.coupling().place();
    else return servo_.coupling().figures();
  }
  int dimension() const noexcept override { return dimension_of<Pressed>; }

 private:
  Servo<Pressed> servo_;
};

/// An end of a rod in the hand.
template <class Model>
class GripOf final : public AnyGrip {
 public:
  GripOf(Model& model, RodSide side) : grip_(model, side) {}
  void hold(bool held) noexcept override { held ? grip_.take() : grip_.let_go(); }
  bool held() const noexcept override { return grip_.held(); }
  std::unique_ptr<AnyServo> servo(const DeviceInfo& device, const ServoOptions& options) override {
    return std::make_unique<ServoOf<Grip<Model>>>(grip_, device, options);
  }

 private:
  Grip<Model> grip_;
};

template <class Model>
class ArrayTouchOf final : public AnyArrayTouch {
  using Array = BeamArray<Model>;

 public:
  ArrayTouchOf(const Array& array, double avatar_radius) : touch_(array, avatar_radius) {}

  Felt tick(const Place& position, const Place&) noexcept override {
    const ArrayTouchResult<double> felt = touch_.tick(flat(position));
    return {2, spatial(felt), felt.beam, felt.complete};
  }
  void reset() noexcept override { touch_.reset(); }
  void soften(double, double) override { throw NotOffered("soften(): an array has no friction"); }
  bool pressing() const noexcept override { return touch_.pressing(); }
  bool resting() const noexcept override { return !touch_.pressing(); }
  int dimension() const noexcept override { return 2; }
  int size() const noexcept override { return touch_.array().size(); }
  std::vector<TouchedBeam> touches() const override {
    std::vector<TouchedBeam> all;
    for (const auto& touch : touch_.touches()) all.push_back({touch.beam, spatial(touch.force)});
    return all;
  }
  Place position(int beam, double s) const noexcept override {
    return spatial(touch_.array().frame(beam).place(touch_.shape(beam).position(s)));
  }
  double length(int beam) const noexcept override { return touch_.shape(beam).length(); }

 private:
  Touch<Array> touch_;
};

template <class Model>
class ArrayOf final : public AnyArray {
 public:
  ArrayOf(const std::vector<Model>& kinds, const std::vector<BeamPlace>& places, int most_touched)
      : array_(kinds, places, most_touched) {}
  int size() const noexcept override { return array_.size(); }
  std::unique_ptr<AnyArrayTouch> touch(double avatar_radius) const override {
    return std::make_unique<ArrayTouchOf<Model>>(array_, avatar_radius);
  }

 private:
  BeamArray<Model> array_;
};

}  // namespace hapbeam::python
