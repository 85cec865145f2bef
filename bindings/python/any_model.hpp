// SPDX-License-Identifier: MIT
// What Python sees of models and of what presses them: one class each, whatever the elements and the space are.
//
// Places, forces and directions have three components here; in the plane of a beam the third is zero. What a model does not offer throws
// NotOffered, which Python sees as TypeError.  The files that instantiate models (model_of.hpp) know nothing of Python.
// Each object belongs to one thread at a time: Python's side takes the mutex of the model for each call.
#pragma once

#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <vector>

#include <hapbeam/contact/find_contact_near.hpp>
#include <hapbeam/contact/prop.hpp>
#include <hapbeam/contact/touch_several.hpp>
#include <hapbeam/force_model.hpp>
#include <hapbeam/haptics/servo/servo.hpp>
#include <hapbeam/internal_forces.hpp>
#include <hapbeam/many/beam_array.hpp>
#include <hapbeam/rom/trained/model_data.hpp>
#include <hapbeam/support.hpp>

namespace hapbeam::python {

using Place = VectorOf<double, 3>;

/// A model that lacks what was called.
struct NotOffered : std::logic_error {
  using std::logic_error::logic_error;
};

/// A tick of one avatar; of an array of beams also which of them pushes hardest.
struct Felt {
  int dimension = 2;
  TouchResult<double, 3> touch;
  int beam = -1;
  bool complete = true;
};

/// A tick of several bodies.
struct FeltSeveral {
  int dimension = 2;
  Status status = Status::ok;
  std::vector<TouchPlace<double, 3>> places;
};

/// How the search for an equilibrium ended.
struct Solved {
  Status status;
  int solves, steps;
  double error;
};

/// Avatars and props, before the model says in which space they are.
struct Bodies {
  std::vector<RoundAvatar> avatars;
  std::vector<Prop<2>> in_plane;
  std::vector<Prop<3>> in_space;
};

/// The nodes of a shape where the model has them: CentrelineNode<double> or RodNode<double>.
struct Nodes {
  const void* data;
  int size;
};

/// What presses a model, by whose mutex it is called.
class Presser {
 public:
  virtual ~Presser() = default;
  std::recursive_mutex* mutex = nullptr;
};

class AnyTouch : public Presser {
 public:
  /// @param shaft  zero but for a capsule in space
  virtual Felt tick(const Place& position, const Place& shaft) noexcept = 0;
  virtual void reset() noexcept = 0;
  virtual void soften(double stiffness, double damping) = 0;
  virtual bool pressing() const noexcept = 0;
  virtual bool resting() const noexcept = 0;
  virtual int dimension() const noexcept = 0;
};

/// One of the beams of an array that are touched.
struct TouchedBeam {
  int beam;
  Place force;
};

class AnyArrayTouch : public AnyTouch {
 public:
  virtual std::vector<TouchedBeam> touches() const = 0;
  virtual int size() const noexcept = 0;
  /// In the axes of the array.
  virtual Place position(int beam, double s) const noexcept = 0;
  virtual double length(int beam) const noexcept = 0;
};

class AnyArray {
 public:
  virtual ~AnyArray() = default;
  virtual int size() const noexcept = 0;
  virtual std::unique_ptr<AnyArrayTouch> touch(double avatar_radius) const = 0;
  std::recursive_mutex mutex;
};

class AnyTouchSeveral : public Presser {
 public:
  virtual FeltSeveral tick(const std::vector<Place>& positions) = 0;
  virtual void reset() noexcept = 0;
  virtual void soften(int avatar, double stiffness, double damping) = 0;
  virtual int dimension() const noexcept = 0;
};

class AnyServo : public Presser {
 public:
  virtual Eigen::Vector3d tick(const DeviceState& state) noexcept = 0;
  virtual Wrench tick(const OrientedState& state) = 0;
  virtual Eigen::Vector3d tick(const Eigen::Vector3d& position, const Eigen::Vector3d& velocity,
                               double dt) noexcept = 0;
  virtual void reset() noexcept = 0;
  virtual const ServoRecord& record() const noexcept = 0;
  virtual CouplingFigures coupling() const noexcept = 0;
  virtual int dimension() const noexcept = 0;
};

class AnyGrip : public Presser {
 public:
  virtual void hold(bool held) noexcept = 0;
  virtual bool held() const noexcept = 0;
  virtual std::unique_ptr<AnyServo> servo(const DeviceInfo& device, const ServoOptions& options) = 0;
};

class AnyModel {
 public:
  virtual ~AnyModel() = default;
  virtual int dimension() const noexcept = 0;
  virtual std::string kind() const = 0;

  virtual Response<double> press(const Press<double>& press) = 0;
  virtual void reset() noexcept = 0;
  virtual Nodes nodes() const noexcept = 0;
  virtual Place position(double s) const noexcept = 0;
  virtual double length() const noexcept = 0;
  virtual double thickness() const noexcept = 0;
  virtual Range<double> range() const noexcept = 0;

  // What presses the model.  Each keeps it by reference.
  virtual std::unique_ptr<AnyTouch> touch(double avatar_radius, const Friction& friction) = 0;
  /// @param coupling  null: what the device can render
  virtual std::unique_ptr<AnyServo> servo(const DeviceInfo& device, const ServoOptions& options,
                                          const CouplingFigures* coupling) = 0;

  std::recursive_mutex mutex;
};

/// Of finite elements.
class AnyFem : public AnyModel {
 public:
  virtual int contacts() const noexcept = 0;
  virtual int elements() const noexcept = 0;
  virtual Response<double> push(const Push<double, 3>& push) = 0;
  virtual HeldEnd<double> hold(RodSide side, const RodPose& pose) = 0;
  virtual Status release() noexcept = 0;

  /// Of a section: fields of InternalForces<double, D>, in their order.   @param out  as many as they are
  virtual void internal_forces(double s, double* out) const noexcept = 0;
  virtual PeakStrain<double> peak_strain() const noexcept = 0;
  virtual double strain_energy() const noexcept = 0;
  /// Bound on what the mesh leaves in the force of the last answer [N].  @throws as the mesh with four times the elements, which the
  /// first call makes
  virtual double force_error() = 0;
  virtual Solved rest() const noexcept = 0;
  virtual Solved report() const noexcept = 0;

  virtual std::unique_ptr<AnyTouchSeveral> touch_several(const Bodies& bodies) = 0;
  virtual std::unique_ptr<AnyGrip> grip(RodSide side) = 0;
  /// @param kinds  this and others of the same elements
  virtual std::unique_ptr<AnyArray> array(const std::vector<const AnyFem*>& kinds,
                                          const std::vector<BeamPlace>& places, int most_touched) const = 0;
};

/// Trained: a PodModel or a GalerkinModel.
class AnyTrained : public AnyModel {
 public:
  virtual const ErrorReport& errors() const noexcept = 0;
  /// @throws as load_model()
  virtual void save(const std::string& path) const = 0;
};

/// Fields of a section's internal forces, in the order of AnyModel::internal_forces().
inline std::vector<std::string> internal_force_names(int dimension) {
  if (dimension == 2) return {"normal", "shear", "moment", "axial_strain", "surface_strain"};
  return {"normal", "shear1", "shear2", "moment1", "moment2", "torsion", "axial_strain", "surface_strain"};
}

}  // namespace hapbeam::python
