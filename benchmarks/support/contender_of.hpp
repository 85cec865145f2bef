// What contender() makes, for the files that compile it.
#pragma once

#include <memory>

#include "assembled_by.hpp"
#include "closed_form_model.hpp"
#include "contender.hpp"
#include "crisfield.hpp"
#include "dense_assembler.hpp"
#include "mass_spring.hpp"
#include "sparse_assemblers.hpp"
#include "touch_scenes.hpp"
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/element/linear.hpp>
#include <hapbeam/element/rod.hpp>
#include <hapbeam/element/twisted_rod.hpp>
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/fem/rod_system.hpp>
#include <hapbeam/rom/trained/galerkin_model.hpp>
#include <hapbeam/rom/trained/pod_model.hpp>

namespace hapbeam::benchmarks {

template <class Model>
class Touched final : public Contender<dimension_of<Model>> {
  static constexpr int D = dimension_of<Model>;

 public:
  template <class... Arguments>
  explicit Touched(const Arguments&... arguments) : model_(arguments...), touch_(model_, radius_in<D>) {}
  Touched(const Touched&) = delete;
  TouchResult<double, D> tick(const VectorOf<double, D>& position) noexcept override {
    return touch_.tick(position);
  }
  void reset() noexcept override { touch_.reset(); }

 private:
  Model model_;
  Touch<Model> touch_;
};

/// What has a contact of its own.
template <class Chain>
class TouchedChain : public Contender<dimension_of<Chain>> {
  static constexpr int D = dimension_of<Chain>;

 public:
  template <class... Arguments>
  explicit TouchedChain(const Arguments&... arguments) : chain_(arguments...) {}
  TouchResult<double, D> tick(const VectorOf<double, D>& position) noexcept override {
    return chain_.tick(position);
  }
  void reset() noexcept override { chain_.reset(); }

 private:
  Chain chain_;
};
template <int D>
class Touched<MassSpring<D>> final : public TouchedChain<MassSpring<D>> {
  using TouchedChain<MassSpring<D>>::TouchedChain;
};

template <class Model, class... Arguments>
std::unique_ptr<Contender<dimension_of<Model>>> contender(const Arguments&... arguments) {
  return std::make_unique<Touched<Model>>(arguments...);
}

}  // namespace hapbeam::benchmarks
