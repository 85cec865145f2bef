// SPDX-License-Identifier: MIT
// The lowest modes of a beam about its rest, and what they lack.
//
//   K φ = ω² M φ,   φᵀ M φ = 1        K, M: tangent and mass of DynamicModel<> at rest
//
// Offline: allocates and throws.
#pragma once

#include <vector>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

#include <hapbeam/fem/dynamic_model.hpp>
#include <hapbeam/rom/trained/modal_model.hpp>

namespace hapbeam {

/// @param modes  how many   @param elements  of the beam that has them
/// @throws std::invalid_argument where the beam has no density, relaxes, is not held, or has fewer modes, or a mode is overdamped; as DynamicModel
/// @tparam Element  whose cubic the mass has, as of DynamicModel<>
template <class Element = Corotational<VonKarman<AssumedStrain>>>
[[gnu::cold]] Modes modes_of(const Beam& beam, int modes, int elements = 64) {
  const DynamicModel<Element> still(beam, elements);
  if (!(beam.mass_per_length(beam.length() / 2) > 0))
    detail::reject("density", 0, "kg/m³", "known for a beam that moves");
  for (const Relaxation& branch : beam.damping().branches)
    if (branch.share > 0) detail::reject("relaxation share", branch.share, "", "0: modes do not creep");
  BeamSystem<Element, double, Eigen::Dynamic, Eigen::Dynamic> system(beam, elements);
  system.chain().lay(still.shape());
  detail::Inertia<double, Eigen::Dynamic, Eigen::Dynamic> inertia(beam, elements,
                                                                  [&](int i) { return system.node(i).s; });
  const auto& nodes = system.parts().nodes();
  inertia.draw(nodes);
  for (int i = 0; i <= elements; ++i) inertia.ghost()[i] = detail::placed(nodes[i]);
  (void)inertia.look(nodes);

  const int all = 3 * (elements + 1);
  const Eigen::MatrixXd M = inertia.matrix();
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(all, all);
  for (int e = 0; e < elements; ++e) {
    Vector6<double> r;
    Matrix6<double> k;
    (void)Element::tangent(system.parts().properties()[e], system.parts().displacements(e), r, k);
    K.block<6, 6>(3 * e, 3 * e) += k;
  }

  std::vector<int> free;
  const auto held = [&](int k) {
    const Support side = k < 3 ? beam.left() : beam.right();
    return (k < 3 || k >= all - 3) && (k % 3 == 0   ? fixes_u(side)
                                       : k % 3 == 1 ? fixes_w(side)
                                                    : fixes_theta(side));
  };
  for (int k = 0; k < all; ++k)
    if (!held(k)) free.push_back(k);
  const auto size = static_cast<Eigen::Index>(free.size());
  if (modes < 1 || modes > size) detail::refuse("modes = %d: must be 1 to %d", modes, static_cast<int>(size));
  const Eigen::MatrixXd k = K(free, free), m = M(free, free);
  const Eigen::LLT<Eigen::MatrixXd> stiff(k);
  if (stiff.info() != Eigen::Success)
    detail::refuse("supports = %s-%s: must hold the beam, stable at rest, for its modes", name(beam.left()),
                   name(beam.right()));
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> found(k, m);

  Modes result;
  result.thickness = beam.thickness();
  for (int i = 0; i <= elements; ++i) result.rest.push_back(nodes[i]);
  result.frequencies = found.eigenvalues().head(modes).cwiseSqrt();
  result.decays = (beam.damping().drag + beam.damping().viscosity * result.frequencies.array().square()) / 2;
  for (int i = 0; i < modes; ++i)
    if (!(result.decays[i] < result.frequencies[i]))
      detail::refuse("modes = %d: must be at most %d, those beyond are overdamped", modes, i);
  result.shapes = Eigen::MatrixXd::Zero(modes, all);
  Eigen::MatrixXd lacks = Eigen::MatrixXd::Zero(all, all);
  const Eigen::MatrixXd some = found.eigenvectors().leftCols(modes);
  const Eigen::MatrixXd flexible =
      stiff.solve(Eigen::MatrixXd::Identity(size, size)) -
      some * result.frequencies.array().square().inverse().matrix().asDiagonal() * some.transpose();
  for (Eigen::Index j = 0; j < size; ++j) {
    result.shapes.col(free[static_cast<std::size_t>(j)]) = some.row(j).transpose();
    for (Eigen::Index i = 0; i < size; ++i)
      lacks(free[static_cast<std::size_t>(i)], free[static_cast<std::size_t>(j)]) = flexible(i, j);
  }
  for (int e = 0; e < elements; ++e) result.rest_flexibility.push_back(lacks.block<6, 6>(3 * e, 3 * e));
  // Beside the stiffness of what is held its share of the mass.
  const Eigen::MatrixXd off =
      K * result.shapes.transpose() -
      M * result.shapes.transpose() * result.frequencies.array().square().matrix().asDiagonal();
  for (int side = 0; side < 2; ++side) {
    const int first = side == 0 ? 0 : all - 3;
    result.held[side] = still.reaction(side).template head<2>();
    result.holds[side] = off.middleRows<2>(first);
  }
  return result;
}

}  // namespace hapbeam
