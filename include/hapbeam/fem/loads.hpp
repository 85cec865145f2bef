// Dead loads as forces at fixed points, ready for a mesh whose nodes move.
//
// A distributed load becomes the consistent nodal forces and moments of the uniform mesh (thesis eq. 3.31), once;
// point loads stay where they are.  Each is then given to whichever element holds it.  On the uniform mesh that is the
// consistent load itself; where the mesh has moved it is statically exact and off by O(l⁴) in the deflection.
// Offline, may allocate and throw; the result is plain data.
#pragma once

#include <array>
#include <cmath>
#include <vector>

#include <hapbeam/beam.hpp>
#include <hapbeam/element/hermite.hpp>

namespace hapbeam {

/// A dead force at a point of the beam.
template <typename Scalar>
struct PointForce {
  Scalar s;           ///< [m]
  Scalar axial;       ///< [N]
  Scalar transverse;  ///< [N]
  Scalar moment;      ///< [N·m]
};

namespace detail {

/// Five-point Gauss rule on [0, 1]: exact to degree nine.
inline constexpr std::array<double, 5> gauss_points = {0.046910077030668003601, 0.23076534494715845448, 0.5,
                                                       0.76923465505284154552, 0.95308992296933199640};
inline constexpr std::array<double, 5> gauss_weights = {0.11846344252809454376, 0.23931433524968323402,
                                                        0.28444444444444444444, 0.23931433524968323402,
                                                        0.11846344252809454376};

inline double sample(const DistributedLoad& load, const char* field, double s) {
  return load ? finite(field, load(s), "N/m") : 0;
}

}  // namespace detail

/// All dead loads of a beam as point forces, in order of s.
/// @throws std::invalid_argument where a distributed load is not finite.
template <typename Scalar>
std::vector<PointForce<Scalar>> point_forces(const Beam& beam, int elements) {
  std::vector<PointForce<Scalar>> forces;
  const auto push = [&forces](double s, double axial, double transverse, double moment) {
    forces.push_back({Scalar(s), Scalar(axial), Scalar(transverse), Scalar(moment)});
  };
  if (beam.transverse() || beam.axial()) {
    const double h = beam.length() / elements;
    Vector6<double> left = Vector6<double>::Zero();
    for (int e = 0; e < elements; ++e) {
      Vector6<double> f = Vector6<double>::Zero();
      for (std::size_t k = 0; k < detail::gauss_points.size(); ++k) {
        const double t = detail::gauss_points[k], weight = h * detail::gauss_weights[k];
        const double axial = detail::sample(beam.axial(), "axial load", (e + t) * h);
        const double transverse = detail::sample(beam.transverse(), "transverse load", (e + t) * h);
        f += ShapeFunctions<double>(t, h).nodal_forces(weight * axial, weight * transverse, 0);
      }
      left.head<3>() += f.head<3>();
      push(e * h, left[0], left[1], left[2]);
      left.head<3>() = f.tail<3>();
    }
    push(beam.length(), left[0], left[1], left[2]);
  }
  for (const PointLoad& load : beam.point_loads()) push(load.s, load.axial, load.transverse, load.moment);
  return forces;
}

}  // namespace hapbeam
