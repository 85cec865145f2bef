// CHAI3D 3.3.0 as far as hapbeam and its page use it: names, types and what a call does, stated anew from its reference.
//
//   a node hands a tool's position and velocity on in its own frame, adds up the forces, and turns them back; here frames are
//   only moved;  a tool has one haptic point, with a number of its own;  a world deletes its children
//
// What OpenGL is asked to draw is counted, and its points are kept.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "haptics/hosts/pressing_hand.hpp"

enum DrawnBy : unsigned { GL_TRIANGLE_STRIP = 5, GL_LIGHTING = 0x0B50 };

namespace hapbeam::testing {
struct Drawing {
  struct Point {
    double x, y, z;
  };
  std::vector<Point> points;
  bool open = false;
};
inline thread_local Drawing drawing;
}  // namespace hapbeam::testing

inline void glEnable(unsigned) {}
inline void glDisable(unsigned) {}
inline void glBegin(unsigned) { hapbeam::testing::drawing = {{}, true}; }
inline void glEnd() { hapbeam::testing::drawing.open = false; }
inline void glVertex3d(double x, double y, double z) {
  hapbeam::testing::drawing.points.push_back({x, y, z});
}

namespace chai3d {

class cVector3d {
 public:
  cVector3d() = default;
  cVector3d(double x, double y, double z) : v_{x, y, z} {}
  double x() const { return v_[0]; }
  double y() const { return v_[1]; }
  double z() const { return v_[2]; }

 private:
  double v_[3] = {0, 0, 0};
};
inline cVector3d operator+(const cVector3d& a, const cVector3d& b) {
  return {a.x() + b.x(), a.y() + b.y(), a.z() + b.z()};
}
inline cVector3d operator-(const cVector3d& a, const cVector3d& b) {
  return {a.x() - b.x(), a.y() - b.y(), a.z() - b.z()};
}
inline cVector3d operator*(double k, const cVector3d& a) { return {k * a.x(), k * a.y(), k * a.z()}; }

struct cRenderOptions {
  bool m_render_transparent_front_faces_only = false, m_render_transparent_back_faces_only = false;
};

struct cColorf {
  void render() const {}
};
struct cMaterial {
  cColorf m_diffuse;
};

class cGenericObject;
struct cInteractionEvent {
  cGenericObject* m_object;
  bool m_isInside;
  cVector3d m_localPos, m_localNormal, m_localForce, m_localSurfacePos;
};
struct cInteractionRecorder {
  std::vector<cInteractionEvent> m_interactions;
};

class cGenericObject {
 public:
  virtual ~cGenericObject() {
    for (cGenericObject* child : children_) delete child;
  }
  virtual std::string getClassName() { return "GenericObject"; }
  void addChild(cGenericObject* child) { children_.push_back(child); }
  void setLocalPos(double x, double y, double z) { position_ = {x, y, z}; }

  virtual cVector3d computeInteractions(const cVector3d& position, const cVector3d& velocity,
                                        const unsigned int tool, cInteractionRecorder& recorder) {
    const cVector3d local = position - position_;
    cVector3d force = computeOtherInteractions(local, velocity, tool, recorder);
    for (cGenericObject* child : children_)
      force = force + child->computeInteractions(local, velocity, tool, recorder);
    return force;
  }
  virtual void renderSceneGraph(cRenderOptions& options) {
    render(options);
    for (cGenericObject* child : children_) child->renderSceneGraph(options);
  }

  std::shared_ptr<cMaterial> m_material = std::make_shared<cMaterial>();

 protected:
  virtual void render(cRenderOptions&) {}
  virtual cVector3d computeOtherInteractions(const cVector3d&, const cVector3d&, const unsigned int,
                                             cInteractionRecorder&) {
    return {};
  }

 private:
  std::vector<cGenericObject*> children_;
  cVector3d position_;
};
class cWorld : public cGenericObject {};

class cPrecisionClock {
 public:
  void start(bool = false) { from_ = hapbeam::testing::pressing_hand.time; }
  double getCurrentTimeSeconds() const { return hapbeam::testing::pressing_hand.time - from_; }

 private:
  double from_ = 0;
};

struct cGenericHapticDevice {};
using cGenericHapticDevicePtr = std::shared_ptr<cGenericHapticDevice>;
class cHapticDeviceHandler {
 public:
  bool getDevice(cGenericHapticDevicePtr& device, unsigned int = 0) {
    device = std::make_shared<cGenericHapticDevice>();
    return true;
  }
};

class cToolCursor : public cGenericObject {
 public:
  explicit cToolCursor(cWorld* world) : world_(world) {}
  void setHapticDevice(cGenericHapticDevicePtr) {}
  void setRadius(double) {}
  bool start() { return true; }
  bool stop() { return true; }
  void updateFromDevice() {
    hapbeam::testing::pressing_hand.time += 5e-4;
    position_ = {0, 0, hapbeam::testing::pressing_hand.height()};
    velocity_ = {0, 0, hapbeam::testing::pressing_hand.climb()};
  }
  void computeInteractionForces() {
    cInteractionRecorder recorder;
    force_ = world_->computeInteractions(position_, velocity_, 0, recorder);
  }
  bool applyToDevice() {
    hapbeam::testing::pressing_hand.feel(force_.z());
    return true;
  }
  cVector3d getDeviceGlobalPos() const { return position_; }
  cVector3d getDeviceGlobalLinVel() const { return velocity_; }
  cVector3d getDeviceGlobalForce() const { return force_; }
  void setDeviceGlobalForce(cVector3d force) { force_ = force; }

 private:
  cWorld* world_;
  cVector3d position_, velocity_, force_;
};

}  // namespace chai3d
