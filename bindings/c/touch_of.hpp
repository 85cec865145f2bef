// SPDX-License-Identifier: MIT
// The objects behind hapbeam_touch and hapbeam_servo: a model, and what touches it.
#pragma once

#include <memory>
#include <utility>

#include "hapbeam.h"
#include <hapbeam/contact/touch.hpp>
#include <hapbeam/haptics/servo/servo.hpp>
#include <hapbeam/internal_forces.hpp>

static_assert(static_cast<int>(hapbeam::LoopStatus::limited) == HAPBEAM_LOOP_LIMITED &&
              static_cast<int>(hapbeam::LoopStatus::device) == HAPBEAM_LOOP_DEVICE);

struct hapbeam_servo {
  virtual ~hapbeam_servo() = default;
  virtual int tick(const Eigen::Vector3d& position, const Eigen::Vector3d& velocity, double dt,
                   Eigen::Vector3d& force) noexcept = 0;
  virtual hapbeam::LoopStatus loop() const noexcept = 0;
  virtual hapbeam::PeakStrain<double> peak_strain() const noexcept = 0;
  virtual void reset() noexcept = 0;
  virtual hapbeam::Centreline<double> shape() noexcept = 0;
};

struct hapbeam_touch {
  virtual ~hapbeam_touch() = default;
  virtual hapbeam::TouchResult<double> tick(const hapbeam::Vector2<double>& hand) noexcept = 0;
  virtual hapbeam::Response<double> press(const hapbeam::Press<double>& press) noexcept = 0;
  virtual void reset() noexcept = 0;
  virtual hapbeam::Centreline<double> shape() const noexcept = 0;
  virtual hapbeam::PeakStrain<double> peak_strain() const noexcept = 0;
  virtual std::unique_ptr<hapbeam_servo> servo(const hapbeam::DeviceInfo& device,
                                               hapbeam::ServoOptions options) const = 0;
};

namespace hapbeam::border {

inline constexpr PeakStrain<double> no_strain{-1, 0};

template <class Model>
PeakStrain<double> strain_of(const Model& model) noexcept {
  if constexpr (has_internal_forces<Model>) return peak_strain(model);
  else return no_strain;
}

template <class Model>
class ServoOf final : public hapbeam_servo {
 public:
  ServoOf(const Model& model, const DeviceInfo& device, const ServoOptions& options)
      : model_(model), servo_(model_, device, options) {}
  int tick(const Eigen::Vector3d& position, const Eigen::Vector3d& velocity, double dt,
           Eigen::Vector3d& force) noexcept override {
    force = servo_.tick(position, velocity, dt);
    return static_cast<int>(servo_.record().model);
  }
  LoopStatus loop() const noexcept override { return servo_.record().status; }
  PeakStrain<double> peak_strain() const noexcept override { return strain_of(model_); }
  void reset() noexcept override { servo_.reset(); }
  Centreline<double> shape() noexcept override { return servo_.picture().shape(); }

 private:
  Model model_;
  Servo<Model> servo_;
};

template <class Model>
class TouchOf final : public hapbeam_touch {
 public:
  TouchOf(const Model& model, double avatar_radius, const Friction& friction)
      : untouched_(model),
        model_(untouched_),
        radius_(avatar_radius),
        friction_(friction),
        touch_(model_, avatar_radius, friction) {}
  TouchResult<double> tick(const Vector2<double>& hand) noexcept override {
    led(By::avatar);
    return touch_.tick(hand);
  }
  Response<double> press(const Press<double>& press) noexcept override {
    led(By::press);
    return model_.press(press);
  }
  void reset() noexcept override { touch_.reset(); }
  Centreline<double> shape() const noexcept override { return model_.shape(); }
  PeakStrain<double> peak_strain() const noexcept override { return strain_of(model_); }
  std::unique_ptr<hapbeam_servo> servo(const DeviceInfo& device, ServoOptions options) const override {
    options.avatar_radius = radius_;
    options.friction = friction_;
    return std::make_unique<ServoOf<Model>>(untouched_, device, options);
  }

 private:
  enum class By { avatar, press };

  /// The touch knows nothing of presses: where one follows the other the beam begins at rest.
  void led(By by) noexcept {
    if (std::exchange(led_, by) != by) touch_.reset();
  }

  Model untouched_, model_;
  double radius_;
  Friction friction_;
  Touch<Model> touch_;
  By led_ = By::avatar;
};

template <class Model>
std::unique_ptr<hapbeam_touch> touch_of(const Model& model, double avatar_radius,
                                        const Friction& friction = {}) {
  return std::make_unique<TouchOf<Model>>(model, avatar_radius, friction);
}

}  // namespace hapbeam::border
