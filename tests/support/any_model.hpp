// A ForceModel of any type behind one interface, so that a suite of laws is compiled once and not for each model.
//
//   AnyModel<double> model(FemModel<>(beam, 8));        AnyPushedModel for one that takes push() and release()
//
// The contract is checked on the model itself, when it is put in.
#pragma once

#include <memory>
#include <type_traits>
#include <utility>

#include <hapbeam/force_model.hpp>
#include <hapbeam/friction.hpp>

namespace hapbeam::testing {

template <typename ScalarType>
class AnyModel {
 public:
  using Scalar = ScalarType;

  template <class Model, std::enable_if_t<!std::is_base_of_v<AnyModel, Model>, int> = 0>
  explicit AnyModel(Model model) : held_(std::make_unique<Held<Model>>(std::move(model))) {
    static_assert(is_force_model<Model>);
  }

  Response<Scalar> press(const Press<Scalar>& press) noexcept { return held_->press(press); }
  Centreline<Scalar> shape() const noexcept { return held_->shape(); }
  Range<Scalar> range() const noexcept { return held_->range(); }
  Scalar thickness() const noexcept { return held_->thickness(); }
  void reset() noexcept { held_->reset(); }

 protected:
  struct Holder {
    virtual ~Holder() = default;
    virtual Response<Scalar> press(const Press<Scalar>&) noexcept = 0;
    virtual Status push(Obstacle<Scalar>*, int) noexcept = 0;
    virtual Centreline<Scalar> shape() const noexcept = 0;
    virtual Range<Scalar> range() const noexcept = 0;
    virtual Scalar thickness() const noexcept = 0;
    virtual void reset() noexcept = 0;
    virtual Status release() noexcept = 0;
  };

  template <class Model>
  struct Held final : Holder {
    explicit Held(Model&& moved) : model(std::move(moved)) {}
    Response<Scalar> press(const Press<Scalar>& press) noexcept override { return model.press(press); }
    Status push([[maybe_unused]] Obstacle<Scalar>* all, [[maybe_unused]] int count) noexcept override {
      if constexpr (takes_push<Model>) return model.push(all, count);
      else return Status::invalid_request;
    }
    Centreline<Scalar> shape() const noexcept override { return model.shape(); }
    Range<Scalar> range() const noexcept override { return model.range(); }
    Scalar thickness() const noexcept override { return model.thickness(); }
    void reset() noexcept override { model.reset(); }
    Status release() noexcept override {
      if constexpr (takes_push<Model>) return model.release();
      else return Status::invalid_request;
    }
    Model model;
  };

  std::unique_ptr<Holder> held_;
};

template <typename Scalar>
class AnyPushedModel : public AnyModel<Scalar> {
 public:
  static constexpr int contacts = 1;

  template <class Model, std::enable_if_t<!std::is_base_of_v<AnyModel<Scalar>, Model>, int> = 0>
  explicit AnyPushedModel(Model model) : AnyModel<Scalar>(std::move(model)) {
    static_assert(takes_push<Model>);
  }
  Status push(Obstacle<Scalar>* all, int count) noexcept { return this->held_->push(all, count); }
  Status release() noexcept { return this->held_->release(); }
};

/// The one of the two that Model goes into.
template <class Model>
using AnyOf = std::conditional_t<takes_push<Model>, AnyPushedModel<typename Model::Scalar>,
                                 AnyModel<typename Model::Scalar>>;

}  // namespace hapbeam::testing
