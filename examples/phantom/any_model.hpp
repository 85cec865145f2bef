// A model and its touch behind one type, so that one servo and one body are compiled for all that bend in a plane, and one for all in space:
// most of the time that a further model took.
//
// Allocates and throws at construction, and where it is touched.   Real-time: as the model; a tick makes one virtual call.
#pragma once

#include <memory>
#include <optional>
#include <utility>

#include "coupling.hpp"
#include "force_bound.hpp"
#include <hapbeam/haptics/servo/servo.hpp>
#include <hapbeam/internal_forces.hpp>

namespace phantom {

/// Largest strain; 0 where the model does not tell.
template <typename Model>
hapbeam::PeakStrain<double> strain_of(const Model& model) noexcept {
  if constexpr (hapbeam::has_internal_forces<Model>) return hapbeam::peak_strain(model);
  else return {0, 0};
}

/// @tparam Asked  its shape costs more than its force, and is computed for who looks
template <int D, bool Asked>
class AnyModel {
 public:
  using Scalar = double;
  static constexpr int dimension = D;
  using Vector = hapbeam::VectorOf<double, D>;

  template <typename Model>
  AnyModel(std::unique_ptr<Model> model, const Parts& parts)
      : of_(std::make_unique<Of<Model>>(std::move(model), parts)) {}

  hapbeam::Centreline<double, D> shape() const noexcept { return of_->shape(); }
  hapbeam::PeakStrain<double> peak_strain() const noexcept { return of_->peak_strain(); }
  double force_error() noexcept { return of_->force_error(); }

 private:
  friend class hapbeam::Touch<AnyModel>;

  struct Any {
    virtual ~Any() = default;
    virtual hapbeam::Centreline<double, D> shape() const noexcept = 0;
    virtual hapbeam::PeakStrain<double> peak_strain() const noexcept = 0;
    virtual double force_error() noexcept = 0;
    virtual void begin(double radius, const hapbeam::Friction& friction) = 0;
    virtual void reset() noexcept = 0;
    virtual hapbeam::CoupledForce<double, D> lead(Coupling& coupling, const Vector& hand,
                                                  double dt) noexcept = 0;
  };
  template <typename Model>
  class Of final : public Any {
   public:
    Of(std::unique_ptr<Model> model, const Parts& parts) : model_(std::move(model)), mesh_error_(parts) {}

    hapbeam::Centreline<double, D> shape() const noexcept override { return model_->shape(); }
    hapbeam::PeakStrain<double> peak_strain() const noexcept override { return strain_of(*model_); }
    double force_error() noexcept override { return mesh_error_(*model_); }
    void begin(double radius, const hapbeam::Friction& friction) override {
      touched_.emplace(*model_, radius, friction);
    }
    void reset() noexcept override { touched_->touch.reset(); }
    hapbeam::CoupledForce<double, D> lead(Coupling& coupling, const Vector& hand,
                                          double dt) noexcept override {
      return coupling.tick(touched_->touch, hand, dt);
    }

   private:
    struct Touched {
      Touched(Model& model, double radius, const hapbeam::Friction& friction)
          : touch(hapbeam::detail::make_touch(model, radius, friction)) {}
      hapbeam::Touch<Model> touch;
    };

    std::unique_ptr<Model> model_;
    MeshError<Model> mesh_error_;
    std::optional<Touched> touched_;
  };

  std::unique_ptr<Any> of_;
};

template <int D, bool Asked>
hapbeam::PeakStrain<double> strain_of(const AnyModel<D, Asked>& model) noexcept {
  return model.peak_strain();
}
template <int D, bool Asked>
struct MeshError<AnyModel<D, Asked>> {
  explicit MeshError(const Parts&) {}
  double operator()(AnyModel<D, Asked>& model) noexcept { return model.force_error(); }
};

}  // namespace phantom

namespace hapbeam {

template <int D, bool Asked>
class Touch<phantom::AnyModel<D, Asked>> {
  using Model = phantom::AnyModel<D, Asked>;

 public:
  using Scalar = double;
  static constexpr int dimension = D;

  Touch(Model& model, double radius, const Friction& friction) : model_(*model.of_) {
    model_.begin(radius, friction);
  }
  void reset() noexcept { model_.reset(); }
  [[nodiscard]] CoupledForce<double, D> lead(phantom::Coupling& coupling, const VectorOf<double, D>& hand,
                                             double dt) noexcept {
    return model_.lead(coupling, hand, dt);
  }

 private:
  typename Model::Any& model_;
};

template <int D, bool Asked>
struct Drawn<phantom::AnyModel<D, Asked>> {
  using Picture = ServoPicture<double, D>;
  static constexpr bool for_who_looks = Asked;
  static auto of(const phantom::AnyModel<D, Asked>& model,
                 const Touch<phantom::AnyModel<D, Asked>>&) noexcept {
    return model.shape();
  }
};

}  // namespace hapbeam
