// SPDX-License-Identifier: MIT
// From snapshots to the numbers of a model: POD of the shapes, and what is interpolated of the force.
//
//   #include <hapbeam/rom/trained/pod_model.hpp>, <…/train.hpp>, <…/validate.hpp>
//   const Beam beam(…);
//   const auto full = full_model(beam);
//   const auto plan = TrainingPlan::anywhere(beam, 0.05);
//   PodModelData<double> data = train_pod(take_snapshots(beam, full, plan));
//   data.errors = validate(PodModel<>(data), full);
//
// Offline: allocates; throws what the parts throw.
#pragma once

#include <cmath>
#include <limits>
#include <vector>

#include <hapbeam/rom/training/pod.hpp>
#include <hapbeam/rom/training/snapshots.hpp>
#include <hapbeam/rom/training/training_plan.hpp>

namespace hapbeam {

/// Snapshots as the columns of a matrix, their displacements freed of units as in ShapeTable: (u, w, θ) node by node.
inline Eigen::MatrixXd snapshot_matrix(const Snapshots& snapshots) {
  const ContactFrame<double> frame(snapshots.beam, snapshots.plan.segments, snapshots.contact_node);
  Eigen::MatrixXd X(3 * (snapshots.plan.segments + 1), static_cast<Eigen::Index>(snapshots.grid.size()));
  for (Eigen::Index k = 0; k < X.cols(); ++k) {
    const Snapshot& snapshot = snapshots.grid[static_cast<std::size_t>(k)];
    const double unit = snapshots.plan.symmetric ? snapshot.d : snapshots.plan.depth;
    const double s = snapshot.s;
    for (int i = 0; i <= frame.segments(); ++i) {
      const CentrelineNode<double>& node = snapshot.nodes[static_cast<std::size_t>(i)];
      const double side = frame.side(i, s) / unit;
      X.col(k).segment<3>(3 * i) << node.u * side / unit, node.w / unit, node.theta * side;
    }
  }
  return X;
}

namespace detail {

/// What does not depend on the kind of model; the shapes by their POD.
template <class Reducer>
TrainedData<double> trained(const Snapshots& snapshots, const Truncation& truncation) {
  const TrainingPlan& plan = snapshots.plan;
  const Eigen::MatrixXd X = snapshot_matrix(snapshots);
  const Pod<Reducer> pod(X, truncation);
  const Eigen::MatrixXd C = pod.coefficients(X);
  ShapeData<double> shape{plan.segments, snapshots.contact_node, pod.modes(), {}, {}, snapshots.rest_shape};
  shape.basis.assign(pod.basis().data(), pod.basis().data() + pod.basis().size());
  shape.coefficients.assign(C.data(), C.data() + C.size());
  return {snapshots.beam, plan.s_min, plan.s_max, plan.depth, plan.positions, shape, {}};
}

/// scale(s) · 2V/e² at one position from scale(s) · F/e at the same nodes:  2V/e² = 2 ∫₀¹ t K(y(t e)) dt.
/// Panels shrink toward t = 0, where y(t e) bends on the length ρ/e.
template <class Nodes>
std::vector<double> potential(const Lagrange<Nodes>& y, const DepthCoordinate<double>& coordinate,
                              const std::vector<double>& K) {
  std::vector<double> l(K.size()), work(K.size());
  for (std::size_t j = 0; j < K.size(); ++j) {
    const double e = coordinate.inverse(y.node(static_cast<int>(j)));
    double high = 1;
    for (int panel = 0; panel < 60; ++panel) {
      const double low = panel == 59 ? 0 : high * 0.8;
      for (std::size_t g = 0; g < gauss_points.size(); ++g) {
        const double t = low + (high - low) * gauss_points[g];
        y.weights(coordinate(t * e), l.data());
        work[j] += 2 * (high - low) * gauss_weights[g] * t * dot(l.data(), K.data(), y.size());
      }
      high = low;
    }
  }
  return work;
}

template <class Nodes>
void check_nodes(const Snapshots& snapshots) {
  if (snapshots.nodes != Nodes::name())
    refuse("nodes = %s: must be %s, as the model is to have them; take_snapshots<Nodes>() says which",
           snapshots.nodes.c_str(), Nodes::name());
}

/// Between its nodes the interpolant must push back, and harder the deeper: with too few depths it does not.
template <class Nodes>
void check_growth(const Lagrange<Nodes>& y, const DepthCoordinate<double>& coordinate,
                  const std::vector<double>& work, double s) {
  const int n = y.size(), steps = 8 * n;
  std::vector<double> l(work.size()), slopes(work.size());
  y.differentiate(work.data(), 1, slopes.data(), 1);
  double before = -std::numeric_limits<double>::infinity();
  for (int k = 0; k <= steps; ++k) {
    const double at = y.low() + (y.high() - y.low()) * k / steps, e = coordinate.inverse(at);
    y.weights(at, l.data());
    const double value = dot(l.data(), work.data(), n), slope = dot(l.data(), slopes.data(), n),
                 stiffness = value + coordinate.half_log_derivative(e, at) * slope, force = e * stiffness;
    if (!(value > 0 && stiffness > 0 && force > before))
      refuse(
          "depths = %d: must be more, or the plan less deep: at s = %g m the force between them is not "
          "a beam's",
          n, s);
    before = force;
  }
}

}  // namespace detail

/// A PodModel's numbers.   @param truncation  of the shape's modes
/// @throws std::invalid_argument where snapshots have other nodes, or are too few for the depth
template <class Nodes = ChebyshevNodes, class Reducer = Svd>
PodModelData<double> train_pod(const Snapshots& snapshots,
                               const Truncation& truncation = Truncation::error(1e-4)) {
  detail::check_nodes<Nodes>(snapshots);
  const TrainingPlan& plan = snapshots.plan;
  const PositionCoordinate<double> position(snapshots.beam);
  const DepthCoordinate<double> coordinate(snapshots.beam, plan.symmetric);
  const Lagrange<Nodes> y(plan.depths, snapshots.y_low, snapshots.y_high);
  const auto trained = detail::trained<Reducer>(snapshots, truncation);
  PodModelData<double> data{trained, plan.symmetric, plan.depths, y.low(), y.high(), {}, snapshots.rest};
  std::vector<double> K(static_cast<std::size_t>(plan.depths));
  for (auto snapshot = snapshots.grid.begin(); snapshot != snapshots.grid.end();) {
    const double s = snapshot->s;
    for (double& k : K) k = position.scale(s) * snapshot->stiffness, ++snapshot;
    const std::vector<double> row = detail::potential(y, coordinate, K);
    detail::check_growth(y, coordinate, row, s);
    data.potential.insert(data.potential.end(), row.begin(), row.end());
  }
  return data;
}

/// A GalerkinModel's numbers, from snapshots at tensions.   @param truncation  of the shape's modes
template <class Nodes = ChebyshevNodes, class Reducer = Svd>
GalerkinModelData<double> train_galerkin(const Snapshots& snapshots,
                                         const Truncation& truncation = Truncation::error(1e-4)) {
  detail::check_nodes<Nodes>(snapshots);
  const PositionCoordinate<double> position(snapshots.beam);
  GalerkinModelData<double> data{
      detail::trained<Reducer>(snapshots, truncation), snapshots.columns, snapshots.tension, {}};
  for (const Snapshot& snapshot : snapshots.grid)
    data.log_stiffness.push_back(std::log(position.scale(snapshot.s) * snapshot.stiffness));
  return data;
}

}  // namespace hapbeam
