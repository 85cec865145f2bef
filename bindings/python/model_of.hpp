// SPDX-License-Identifier: MIT
// AnyModel of a model.
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "any_model.hpp"
#include "space.hpp"
#include "touch_of.hpp"

namespace hapbeam::python {

/// What all models have.
/// @tparam Base  AnyFem | AnyTrained
template <class Model, class Base>
class ModelOf : public Base {
 protected:
  static constexpr int D = dimension_of<Model>;
  static constexpr bool several = detail::takes_several<Model>;

 public:
  template <class... Args>
  explicit ModelOf(const char* kind, Args&&... args) : model_(std::forward<Args>(args)...), kind_(kind) {}

  int dimension() const noexcept override { return D; }
  std::string kind() const override { return kind_; }

  Response<double> press(const Press<double>& press) override {
    if constexpr (D == 2) return model_.press(press);
    else throw NotOffered("press(): of a beam in the plane; a rod has push()");
  }
  void reset() noexcept override { model_.reset(); }
  Nodes nodes() const noexcept override {
    const auto line = model_.shape();
    return {line.begin(), line.size()};
  }
  Place position(double s) const noexcept override { return spatial(model_.shape().position(s)); }
  double length() const noexcept override { return model_.shape().length(); }
  double thickness() const noexcept override { return model_.thickness(); }
  Range<double> range() const noexcept override { return model_.range(); }

  std::unique_ptr<AnyTouch> touch(double avatar_radius, const Friction& friction) override {
    if constexpr (!several) return std::make_unique<TouchOf<Model>>(model_, avatar_radius, friction);
    else throw NotOffered("Touch: of a model with contacts = 1; TouchSeveral takes this one");
  }
  std::unique_ptr<AnyServo> servo(const DeviceInfo& device, const ServoOptions& options,
                                  const CouplingFigures* coupling) override {
    if constexpr (several) throw NotOffered("Servo: of a model with contacts = 1");
    else if (coupling)
      return std::make_unique<ServoOf<Model>>(model_, device, options, VirtualCoupling(*coupling));
    else return std::make_unique<ServoOf<Model>>(model_, device, options);
  }

 protected:
  Model model_;

 private:
  std::string kind_;
};

}  // namespace hapbeam::python
