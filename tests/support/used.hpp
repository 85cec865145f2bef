// What many tests use, used once: clang compiles it with the precompiled header that they share, and no unit does again.  What is not a
// template and computes for long is optimised there, where the tests are not.
#pragma once

#include "once.hpp"
#include "support/closed_form.hpp"
#include "support/eigenvalues.hpp"
#include "support/naive_contact.hpp"

namespace hapbeam::testing::precompiled {

// As elements that count do, one by one.
template <class Element, typename Scalar>
void use_element(const ElementProperties<Scalar>& p) {
  Vector6<Scalar> d, r;
  Matrix6<Scalar> K;
  d.setZero();
  static_cast<void>(Element::tangent(p, d, r, K));
  Element::residual(p, d, r);
  static_cast<void>(Element::energy(p, d));
}

template <class Model>
void use_shape(Model& model) {
  using Scalar = typename Model::Scalar;
  const auto line = model.shape();
  const Scalar s = line.length();
  static_cast<void>(line.at(s));
  static_cast<void>(line.curvature(line.node_near(s)));
  static_cast<void>(line.stretch(0));
  model.reset();
}

template <class Model>
void use_touch(Model& model) {
  using Scalar = typename Model::Scalar;
  using Vector = typename Touch<Model>::Vector;
  Touch<Model> touch(model, Scalar(0));
  static_cast<void>(touch.tick(Vector()));
  static_cast<void>(touch.contact_at(Vector()));
  if constexpr (Touch<Model>::dimension == 3) static_cast<void>(touch.tick(Vector(), Vector()));
}

template <class Model, class Body>
void use_full(const Body& body) {
  using Scalar = typename Model::Scalar;
  Model model(body, 8);
  use_shape(model);
  static_cast<void>(model.release());
  static_cast<void>(model.internal_forces(Scalar(0)));
  if constexpr (Model::dimension == 2) static_cast<void>(model.press({}));
  if constexpr (Model::dimension == 3) static_cast<void>(model.hold({}, {}));
  if constexpr (any_rotation<typename Model::ElementType>)
    static_cast<void>(model.push(Push<Scalar, Model::dimension>{}));
  use_touch(model);
}

template <class Model, class Body>
void use_several(const Body& body) {
  Model model(body, 8);
  use_shape(model);
  TouchSeveral<Model> touch(model, {});
  static_cast<void>(touch.tick(nullptr, 0));
}

template <class Model, class Data>
void use_reduced(const Data& data) {
  Model model(data);
  use_shape(model);
  static_cast<void>(model.press({}));
  use_touch(model);
}

// As models of other scalars find their rest in double, and as tests follow a system to where it buckles.
template <class System, class Body>
void use_system(const Body& body) {
  System system(body, 8);
  system.set_goal();
  static_cast<void>(NewtonRaphson{}.solve(system));
}
template <class Element, typename Scalar = double>
using PlanarSystem = BeamSystem<Element, Scalar, Eigen::Dynamic, Eigen::Dynamic>;
template <class Element>
using SpatialSystem = RodSystem<Element, double, Eigen::Dynamic, Eigen::Dynamic>;

inline void used(const Beam& beam, const Rod& rod, const PodModelData<double>& pod,
                 const GalerkinModelData<double>& galerkin) {
  use_element<VonKarman<>, double>({1, 1, 1});
  use_element<VonKarman<>, float>({1, 1, 1});
  use_element<Corotational<>, double>({1, 1, 1});
  use_element<Corotational<>, float>({1, 1, 1});
  use_full<FemModel<>>(beam);
  use_full<FemModel<Linear>>(beam);
  use_full<FemModel<Corotational<>>>(beam);
  use_full<FemModel<VonKarman<>, float>>(beam);
  use_full<FemModel<Corotational<>, float>>(beam);
  use_full<FemModel<RoundRod>>(rod);
  use_full<FemModel<TwistedRod>>(rod);
  use_system<PlanarSystem<VonKarman<>>>(beam);
  use_system<PlanarSystem<Corotational<>>>(beam);
  use_system<PlanarSystem<VonKarman<ReducedIntegration>, float>>(beam);
  use_system<SpatialSystem<RoundRod>>(rod);
  use_system<SpatialSystem<TwistedRod>>(rod);
  use_several<FemModel<Several<Corotational<>, 2>>>(beam);
  use_several<FemModel<Several<RoundRod, 2>>>(rod);
  use_several<FemModel<Several<TwistedRod, 2>>>(rod);
  use_several<FemModel<Several<Corotational<>, 4>>>(beam);
  // Not compiled once: with it comes what its system is made of.
  use_several<FemModel<Several<RoundRod, 4>>>(rod);
  use_reduced<PodModel<>>(pod);
  use_reduced<GalerkinModel<>>(galerkin);
}

}  // namespace hapbeam::testing::precompiled
