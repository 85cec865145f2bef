// What contender() makes, for the files that compile it.
#pragma once

#include <memory>

#include "closed_form_model.hpp"
#include "contender.hpp"
#include "mass_spring.hpp"
#include "sparse_assemblers.hpp"
#include "touch_scenes.hpp"
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/element/linear.hpp>
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/fem/solver/dense.hpp>
#include <hapbeam/rom/trained/galerkin_model.hpp>
#include <hapbeam/rom/trained/pod_model.hpp>

namespace hapbeam::benchmarks {

template <class Model>
class Touched final : public Contender {
 public:
  template <class... Arguments>
  explicit Touched(const Arguments&... arguments) : model_(arguments...), touch_(model_, avatar_radius) {}
  Touched(const Touched&) = delete;
  TouchResult<double> tick(const Vector2<double>& position) noexcept override {
    return touch_.tick(position);
  }
  void reset() noexcept override { touch_.reset(); }

 private:
  Model model_;
  Touch<Model> touch_;
};

/// It has a contact of its own.
template <>
class Touched<MassSpring> final : public Contender {
 public:
  template <class... Arguments>
  explicit Touched(const Arguments&... arguments) : chain_(arguments...) {}
  TouchResult<double> tick(const Vector2<double>& position) noexcept override {
    return chain_.tick(position);
  }
  void reset() noexcept override { chain_.reset(); }

 private:
  MassSpring chain_;
};

template <class Model, class... Arguments>
std::unique_ptr<Contender> contender(const Arguments&... arguments) {
  return std::make_unique<Touched<Model>>(arguments...);
}

}  // namespace hapbeam::benchmarks
