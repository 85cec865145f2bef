// SPDX-License-Identifier: MIT
// AnyFem of a FemModel.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "model_of.hpp"
#include "several_of.hpp"
#include <hapbeam/fem/force_error.hpp>

namespace hapbeam::python {

/// What a FemModel is touched by, besides one avatar and a Servo.
enum class Also { nothing, arrays, grips };

template <class Model, Also also = Also::nothing>
class FemOf final : public ModelOf<Model, AnyFem> {
  using Base = ModelOf<Model, AnyFem>;
  using Base::D;
  using Base::model_;
  using Base::several;

 public:
  using Body = typename Model::Body;
  FemOf(const char* kind, const Body& body, int elements) : Base(kind, body, elements), body_(body) {}

  int contacts() const noexcept override { return Model::contacts; }
  int elements() const noexcept override { return model_.elements(); }

  Response<double> push(const Push<double, 3>& push) override {
    if constexpr (D == 3) return model_.push(push);
    else if constexpr (takes_push<Model>) return model_.push(Push<double>{push.s, push.d, flat(push.normal)});
    else throw NotOffered("push(): of a rod, or of Element.Corotational; this model has press()");
  }
  HeldEnd<double> hold(RodSide side, const RodPose& pose) override {
    if constexpr (D == 3 && !several) return model_.hold(side, pose);
    else throw NotOffered("hold(): of a rod with contacts = 1");
  }
  Status release() noexcept override { return model_.release(); }

  void internal_forces(double s, double* out) const noexcept override {
    write(model_.internal_forces(s), out);
  }
  PeakStrain<double> peak_strain() const noexcept override { return hapbeam::peak_strain(model_); }
  double strain_energy() const noexcept override { return model_.strain_energy(); }
  double force_error() override {
    if (!force_error_) force_error_.emplace(body_, elements());
    return (*force_error_)(model_);
  }
  Solved rest() const noexcept override { return solved(model_.rest()); }
  Solved report() const noexcept override { return solved(model_.report()); }

  std::unique_ptr<AnyTouchSeveral> touch_several(const Bodies& bodies) override {
    if constexpr (several) return touch_several_of(model_, bodies);
    else throw NotOffered("TouchSeveral: of a model with contacts > 1; Touch takes this one");
  }
  std::unique_ptr<AnyGrip> grip(RodSide side) override {
    if constexpr (also == Also::grips) return std::make_unique<GripOf<Model>>(model_, side);
    else throw NotOffered("Grip: of a rod with contacts = 1");
  }
  std::unique_ptr<AnyArray> array(const std::vector<const AnyFem*>& kinds,
                                  const std::vector<BeamPlace>& places, int most_touched) const override {
    if constexpr (also == Also::arrays) {
      std::vector<Model> models;
      for (const AnyFem* kind : kinds) {
        const auto* same = dynamic_cast<const FemOf*>(kind);
        if (!same) throw NotOffered("BeamArray: of models of the same elements");
        models.push_back(same->model_);
      }
      return std::make_unique<ArrayOf<Model>>(models, places, most_touched);
    } else {
      throw NotOffered("BeamArray: of beams of Element.VonKarman or Element.Corotational");
    }
  }

 private:
  static void write(const InternalForces<double, 2>& cut, double* out) noexcept {
    for (const double x : {cut.normal, cut.shear, cut.moment, cut.axial_strain, cut.surface_strain})
      *out++ = x;
  }
  static void write(const InternalForces<double, 3>& cut, double* out) noexcept {
    for (const double x : {cut.normal, cut.shear1, cut.shear2, cut.moment1, cut.moment2, cut.torsion,
                           cut.axial_strain, cut.surface_strain})
      *out++ = x;
  }
  template <class Report>
  static Solved solved(const Report& report) noexcept {
    return {report.status, report.solves, report.steps, report.error};
  }

  Body body_;
  std::optional<ForceError<typename Model::ElementType>> force_error_;
};

}  // namespace hapbeam::python
