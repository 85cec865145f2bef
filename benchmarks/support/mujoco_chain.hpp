// A rod as users of MuJoCo make one: a chain of capsules on joints with springs, stepped once a tick, under a ball.
//
// As good as such a chain gets at 1 ms: each joint is three hinges, two across with EI/l and one along with GJ/l (a ball joint has
// one stiffness for both), the clamp's are twice as stiff, as half a link is behind it.  A steel rod's own inertia would make it
// explode.  So each hinge has an armature that takes it two steps to swing a radian, and critical damping: the force at rest is the
// same, and comes soon.  The ball is a mocap body, its contact as hard as the solver takes it.
// Needs libmujoco, which is Debian's libmujoco-dev, and is never fetched.
#pragma once

#include <cstddef>
#include <cstdio>
#include <cstring>
#include <memory>
#include <mujoco/mujoco.h>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <hapbeam/contact/touch.hpp>
#include <hapbeam/rod.hpp>

namespace hapbeam::benchmarks {

class MujocoChain {
  using Vector = VectorOf<double, 3>;

 public:
  static constexpr int dimension = 3;

  /// @param mass_per_length [kg/m]
  MujocoChain(const Rod& rod, int links, double radius, double mass_per_length) {
    const std::string text = description(rod, links, radius, mass_per_length);
    const auto files = std::make_unique<mjVFS>();
    mj_defaultVFS(files.get());
    mj_makeEmptyFileVFS(files.get(), "chain.xml", static_cast<int>(text.size()));
    std::memcpy(files->filedata[0], text.data(), text.size());
    char error[500] = "";
    model_.reset(mj_loadXML("chain.xml", files.get(), error, sizeof error));
    mj_deleteVFS(files.get());
    if (!model_) throw std::runtime_error(error);
    data_.reset(mj_makeData(model_.get()));
    avatar_ = mj_name2id(model_.get(), mjOBJ_GEOM, "avatar");
    // Dead loads, and the shape to which they bend it.
    applied_.assign(6 * static_cast<std::size_t>(model_->nbody), 0);
    const double link = rod.length() / links;
    if (const RodLoad load = rod.load())
      for (int i = 0; i < links; ++i) {
        const Vector force = link * load((i + 0.5) * link);
        for (int k = 0; k < 3; ++k)
          applied_[6 * static_cast<std::size_t>(first_link + i) + static_cast<std::size_t>(k)] = force[k];
      }
    rest_.assign(model_->qpos0, model_->qpos0 + model_->nq);
    reset();
    double fastest = 1;  // [rad/s]
    for (int k = 0; k < 1000 && fastest > 1e-9; ++k) {
      mj_step(model_.get(), data_.get());
      fastest = Eigen::Map<const Eigen::VectorXd>(data_->qvel, model_->nv).cwiseAbs().maxCoeff();
    }
    rest_.assign(data_->qpos, data_->qpos + model_->nq);
    reset();
  }

  void reset() noexcept {
    mj_resetData(model_.get(), data_.get());
    std::memcpy(data_->qpos, rest_.data(), rest_.size() * sizeof(mjtNum));
    std::memcpy(data_->xfrc_applied, applied_.data(), applied_.size() * sizeof(mjtNum));
  }

  [[nodiscard]] TouchResult<double, 3> tick(const Vector& position) noexcept {
    for (int k = 0; k < 3; ++k) data_->mocap_pos[k] = position[k];
    mj_step(model_.get(), data_.get());
    TouchResult<double, 3> result;
    for (int i = 0; i < data_->ncon; ++i) {
      mjtNum force[6];
      mj_contactForce(model_.get(), data_.get(), i, force);
      const mjContact& contact = data_->contact[i];
      const double side = contact.geom1 == avatar_ ? -1 : 1;  // the normal goes from the first to the second
      result.force += side * force[0] * Vector(contact.frame[0], contact.frame[1], contact.frame[2]);
    }
    result.pressing = result.force.squaredNorm() > 0;
    if (!result.force.allFinite()) result.force.setZero(), result.status = Status::non_finite;
    return result;
  }

 private:
  static constexpr double step = 1e-3;  // [s]
  static constexpr int first_link = 2;  // the world and the avatar come before
  struct Free {
    void operator()(mjModel* model) const noexcept { mj_deleteModel(model); }
    void operator()(mjData* data) const noexcept { mj_deleteData(data); }
  };

  static std::string numbers(const Vector& v) {
    char text[100];
    std::snprintf(text, sizeof text, "%.12g %.12g %.12g", v.x(), v.y(), v.z());
    return text;
  }

  /// Nodes of the natural shape and the frames d1, d2, d3 there, in steps that are small beside its curvature.
  static std::vector<std::pair<Vector, Eigen::Matrix3d>> natural(const Rod& rod, int links) {
    constexpr int steps = 1000;
    const double h = rod.length() / links / steps;
    const RodPose& pose = rod.left_pose();
    Eigen::Matrix3d frame;
    frame << pose.director, detail::cross3<double>(pose.along, pose.director), pose.along;
    Vector at = pose.at;
    std::vector<std::pair<Vector, Eigen::Matrix3d>> nodes{{at, frame}};
    for (int i = 0; i < links; ++i) {
      for (int k = 0; k < steps; ++k) {
        const double s = (i * steps + k + 0.5) * h;
        Vector turn = Vector::Zero();
        for (const RodArc& arc : rod.arcs())
          if (s < arc.end) {
            turn = frame * Vector(arc.curvature1, arc.curvature2, arc.twist) * h;
            break;
          }
        const Vector before = frame.col(2);
        // A small rotation, and d1, d2 and d3 made perpendicular again.
        Vector d3 = (before + detail::cross3<double>(turn, before)).normalized();
        const Vector d1 =
            detail::across<double>(frame.col(0) + detail::cross3<double>(turn, frame.col(0)), d3);
        frame << d1, detail::cross3<double>(d3, d1), d3;
        at += h / 2 * (before + d3);
      }
      nodes.emplace_back(at, frame);
    }
    return nodes;
  }

  static std::string description(const Rod& rod, int links, double radius, double mass_per_length) {
    const double link = rod.length() / links, thick = rod.thickness() / 2;
    const auto nodes = natural(rod, links);
    std::string text =
        "<mujoco><compiler inertiafromgeom='true' angle='radian'/><size njmax='100' nconmax='50'/>"
        "<option timestep='0.001' gravity='0 0 0'/>"
        "<default><geom condim='1' solref='0.002 1' solimp='0.9999 0.9999 0.001'/></default><worldbody>"
        "<body mocap='true' pos='0 0 10'><geom name='avatar' type='sphere' contype='2' conaffinity='1' "
        "size='" +
        std::to_string(radius) + "'/></body>";
    for (int i = 0; i < links; ++i) {
      const auto& [at, frame] = nodes[static_cast<std::size_t>(i)];
      const Vector before = i == 0 ? Vector::Zero() : nodes[static_cast<std::size_t>(i - 1)].first;
      text += "<body pos='" + numbers(at - before) + "'>";
      const double stiff[] = {rod.stiffness().bending1, rod.stiffness().bending2, rod.stiffness().torsion};
      for (int k = 0; k < 3; ++k) {
        const double spring = (i == 0 ? 2 : 1) * stiff[k] / link;
        text += "<joint type='hinge' axis='" + numbers(frame.col(k)) + "' stiffness='" +
                std::to_string(spring) + "' armature='" + std::to_string(4 * step * step * spring) +
                "' damping='" + std::to_string(4 * step * spring) + "'/>";
      }
      text += "<geom type='capsule' contype='1' conaffinity='2' size='" + std::to_string(thick) + "' mass='" +
              std::to_string(mass_per_length * link) + "' fromto='0 0 0 " +
              numbers(nodes[static_cast<std::size_t>(i + 1)].first - at) + "'/>";
    }
    for (int i = 0; i < links; ++i) text += "</body>";
    return text + "</worldbody></mujoco>";
  }

  std::unique_ptr<mjModel, Free> model_;
  std::unique_ptr<mjData, Free> data_;
  std::vector<mjtNum> rest_, applied_;
  int avatar_ = -1;
};

}  // namespace hapbeam::benchmarks
