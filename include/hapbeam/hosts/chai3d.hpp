// SPDX-License-Identifier: MIT
// A beam as an object of CHAI3D's scene graph: tools touch it, and cameras draw it.
//
//   auto* ruler = new Chai3dBeam<FemModel<>>(model, 0.005);   // the world deletes it; the model has to live longer
//   ruler->setLocalPos(0, -0.15, 0);
//   world->addChild(ruler);                                   // from here on as any object: tool->computeInteractionForces()
//
// Units are m and N. In its own frame the beam lies along y, from its left end at the origin; w is along z. Motion of the tool along x
// has no effect.  The force is that of Touch (placed_touch.hpp), without a coupling. One tool presses the beam, the first whose haptic
// point comes; another one feels nothing.
// Haptic thread: computeInteractions(). Graphics thread: renderSceneGraph(). Neither waits, and hapbeam allocates in neither.
//
// For CHAI3D 3.3.0.  HAPBEAM_CHAI3D_HEADER is the header to include, <chai3d.h> unless it was defined before.
#pragma once

#ifndef HAPBEAM_CHAI3D_HEADER
#define HAPBEAM_CHAI3D_HEADER <chai3d.h>
#endif
#include HAPBEAM_CHAI3D_HEADER

#include <cmath>
#include <string>

#include <hapbeam/haptics/servo/placement.hpp>
#include <hapbeam/hosts/placed_touch.hpp>

namespace hapbeam {

template <typename Model>
class Chai3dBeam : public chai3d::cGenericObject {
 public:
  /// @param model   kept by reference, and pressed by this object alone
  /// @param avatar_radius  [m] as the tool's setRadius()   Allocates.   @throws std::invalid_argument as Touch
  Chai3dBeam(Model& model, double avatar_radius)
      : touch_(model, avatar_radius, x_toward_user({0, 0})),
        radius_(avatar_radius),
        thickness_(model.thickness()) {}

  std::string getClassName() override { return "hapbeam::Chai3dBeam"; }

  /// felt() is the result of the last tick, for the haptic thread.  picture() is the newest picture, for the graphics thread.
  PlacedTouch<Model>& touch() noexcept { return touch_; }

 protected:
  chai3d::cVector3d computeOtherInteractions(const chai3d::cVector3d& position, const chai3d::cVector3d&,
                                             const unsigned int tool,
                                             chai3d::cInteractionRecorder& recorder) override {
    if (tool_ == nobody) tool_ = tool;
    if (tool_ != tool) return {0, 0, 0};
    const chai3d::cVector3d force = host(touch_.tick({position.x(), position.y(), position.z()}));
    const auto& felt = touch_.felt();
    if (felt.pressing && is_answer(felt.status)) {
      const Vector2<double> across = felt.contact.normal.template cast<double>();
      const chai3d::cVector3d normal = host(touch_.placement().device_force_of_beam(across));
      chai3d::cInteractionEvent event;
      event.m_object = this;
      event.m_isInside = true;
      event.m_localPos = position;
      event.m_localNormal = normal;
      event.m_localForce = force;
      event.m_localSurfacePos = position - radius_ * normal;
      recorder.m_interactions.push_back(event);
    }
    return force;
  }

  /// As a band, as thick as the beam, in the colour of its material.
  void render(chai3d::cRenderOptions& options) override {
    if (options.m_render_transparent_front_faces_only || options.m_render_transparent_back_faces_only) return;
    const auto shape = touch_.picture().shape();
    glDisable(GL_LIGHTING);
    m_material->m_diffuse.render();
    glBegin(GL_TRIANGLE_STRIP);
    for (int k = 0; k <= drawn_pieces; ++k) {
      const auto s = shape.length() * static_cast<typename Model::Scalar>(k) / drawn_pieces;
      const auto moved = shape.at(s);
      const double theta = moved.theta, y = s + moved.u, z = moved.w;
      for (const double half : {thickness_ / 2, -thickness_ / 2})
        glVertex3d(0, y + half * std::sin(theta), z + half * std::cos(theta));
    }
    glEnd();
    glEnable(GL_LIGHTING);
  }

 private:
  static chai3d::cVector3d host(const Eigen::Vector3d& v) { return {v[0], v[1], v[2]}; }

  static constexpr int drawn_pieces = 128;
  static constexpr unsigned nobody = ~0u;

  PlacedTouch<Model> touch_;
  double radius_, thickness_;  // [m]
  unsigned tool_ = nobody;
};

}  // namespace hapbeam
