// SOFA's ForceFeedback as far as hapbeam uses it: names, types and what a call does, stated anew from its reference.
#pragma once

#include <array>

using SReal = double;
#define SOFA_TEMPLATE(Class, Parameter) Class<Parameter>
#define SOFA_CLASS(Class, Base) using Inherits = Base

namespace sofa::type {
using Vec3 = std::array<SReal, 3>;
class Transform {
 public:
  explicit Transform(const Vec3& origin) : origin_(origin) {}
  const Vec3& getOrigin() const { return origin_; }

 private:
  Vec3 origin_;
};
class SpatialVector {
 public:
  void setForce(const Vec3& f) { force_ = f; }
  void setTorque(const Vec3& t) { torque_ = t; }
  const Vec3& getForce() const { return force_; }
  const Vec3& getTorque() const { return torque_; }

 private:
  Vec3 force_{}, torque_{};
};
}  // namespace sofa::type

namespace sofa::component::haptics {
class ForceFeedback {
 public:
  virtual ~ForceFeedback() = default;
  virtual void computeForce(SReal x, SReal y, SReal z, SReal u, SReal v, SReal w, SReal q, SReal& fx,
                            SReal& fy, SReal& fz) = 0;
  virtual void computeWrench(const type::Transform& tool, const type::SpatialVector& velocity,
                             type::SpatialVector& wrench) = 0;
};
}  // namespace sofa::component::haptics
