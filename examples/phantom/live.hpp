// The body of a model: its loop, and what that tells in the words of Body.
#pragma once

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "any_model.hpp"
#include "couple.hpp"
#include "force_bound.hpp"
#include "heard.hpp"
#include "rest.hpp"
#include "scene.hpp"
#include <hapbeam/haptics/servo/servo_many.hpp>

namespace phantom {

/// Where the centreline is at rest [m].
inline Eigen::Vector3d at_rest(const hapbeam::Centreline<double>& rest, double place) {
  return {place, height_at(rest, place), 0};
}
inline Eigen::Vector3d at_rest(const hapbeam::Centreline<double, 3>& rest, double place) {
  return rest.position(place);
}

/// @param place  [m] along the beam, that is to be pressed
template <int D>
hapbeam::ServoOptions servo_options(const Options& options, const hapbeam::Centreline<double, D>& rest,
                                    double place) {
  hapbeam::ServoOptions servo;
  servo.placement = placement(at_rest(rest, place), options);
  servo.avatar_radius = options.radius;
  servo.friction = hapbeam::Friction(options.friction, options.friction);
  return servo;
}

template <typename Model>
auto rest_of(const Model& model) {
  return model.shape();
}
template <typename Model>
hapbeam::Centreline<double> rest_of(const hapbeam::BeamArray<Model>& array) {
  return array.rest(0);
}

template <int D>
void show(const hapbeam::ServoPicture<double, D>& picture, DrawnBody& body) noexcept {
  body.beams[0].shape = picture.shape();
}
/// Those that are not pressed are at rest.
inline void show(const hapbeam::ArrayPicture<double>& picture, DrawnBody& body) noexcept {
  for (int i = 0; i < picture.size(); ++i)
    body.beams[static_cast<std::size_t>(picture.beam(i))].shape = picture.shape(i);
}

/// @tparam Loop  of one hand, or of two: OneHand | BothHands
template <typename Loop>
class Live final : public Body {
  using Model = typename Loop::Model;
  static constexpr int dimension = hapbeam::dimension_of<Model>;

 public:
  Live(std::unique_ptr<Model> model, Parts parts)
      : parts_(std::move(parts)),
        rest_(rest_of(*model)),
        servo_options_(servo_options(parts_.options, rest_.shape(), parts_.options.place)),
        loop_(std::move(model), parts_, servo_options_),
        heard_(loop_.model(), parts_.options),
        mesh_error_(parts_),
        bound_(parts_) {
    for (int i = 0; i < parts_.options.beams; ++i)
      drawn_.beams.push_back({rest(), -parts_.options.pitch * i});
  }

  Eigen::Vector3d tick(const hapbeam::DeviceState& state) noexcept override {
    const hapbeam::ServoRecord* const second = loop_.second();
    const double before = record().dissipated, others = second ? second->dissipated : 0;
    const Eigen::Vector3d force = loop_.tick(state);
    dissipated_ += taken(record(), before) + (second ? taken(*second, others) : 0);
    if constexpr (dimension == 3) deepest_ = std::max(deepest_, depth(record()));
    if (record().pressing && record().ticks % 8 == 0)
      if (const auto peak = strain_of(loop_.model()); peak.strain > peak_.strain) peak_ = peak;
    bound_.tick(record(), [this] { return mesh_error_(loop_.model()); });
    return force;
  }
  const hapbeam::ServoRecord& record() const noexcept override { return loop_.servo().record(); }
  const hapbeam::ServoRecord* second() const noexcept override { return loop_.second(); }
  void reset() noexcept override {
    loop_.reset();
    deepest_ = 0;
    peak_ = {0, 0};
    dissipated_ = 0;
  }
  const DrawnBody& drawn() noexcept override {
    for (DrawnBeam& beam : drawn_.beams) beam.shape = rest();
    show(loop_.servo().picture(), drawn_);
    return drawn_;
  }
  Shape rest() const noexcept override { return rest_.shape(); }
  const hapbeam::Placement& placement() const noexcept override { return servo_options_.placement; }
  double depth(const hapbeam::ServoRecord& r) const noexcept override {
    const Options& o = parts_.options;
    // How far it is pushed in, or pulled.
    if (holds_end(o.avatar)) return along_end(o) * (r.avatar.x() - at_rest(rest_.shape(), 0).x());
    if (!r.pressing) return 0;
    if constexpr (dimension == 2) return height_at(rest_.shape(), r.press.s) - r.press.d;
    // Along the normal; the device's axes are the scene's.
    else if (const double force = r.force.norm(); force > 0) {
      const double at_rest = r.force.dot(rest_.shape().position(r.press.s)) / force;
      if (o.avatar == Avatar::needle) return at_rest - r.press.d;
      return at_rest - r.force.dot(r.avatar) / force + reach_of(o);
    }
    return 0;
  }
  double deepest() const noexcept override { return dimension == 3 ? deepest_ : record().max_press; }
  hapbeam::PeakStrain<double> peak() const noexcept override { return peak_; }
  double force_error() const noexcept override { return bound_.relative(); }
  double moved() const noexcept override { return heard_.moved(loop_.model()); }
  int hear(std::vector<float>& samples) override { return heard_.read(samples); }
  double dissipated() const noexcept override { return dissipated_; }
  const hapbeam::TickTimes& times() const noexcept override { return loop_.servo().times(); }
  std::uint64_t full_answers() const noexcept override {
    return parts_.full_answers ? parts_.full_answers->load() : 0;
  }
  const Options& options() const noexcept override { return parts_.options; }
  const Slender& slender() const noexcept override { return parts_.slender; }
  const Trained* trained() const noexcept override { return parts_.trained.get(); }

 private:
  /// By friction in a tick: a touch that has begun anew counts from zero [J].
  static double taken(const hapbeam::ServoRecord& record, double before) noexcept {
    return record.dissipated < before ? record.dissipated : record.dissipated - before;
  }
  Parts parts_;
  hapbeam::ServoPicture<double, dimension> rest_;
  hapbeam::ServoOptions servo_options_;
  Loop loop_;
  Heard<Model> heard_;
  MeshError<Model> mesh_error_;
  ForceBound bound_;
  DrawnBody drawn_;
  double deepest_ = 0;  // [m] of a rod
  hapbeam::PeakStrain<double> peak_{0, 0};
  double dissipated_ = 0;  // [J]
};

/// @tparam Loop  OneHand | BothHands
template <template <typename> class Loop, typename Model>
std::unique_ptr<Body> couple(std::unique_ptr<Model> model, Parts parts) {
  return std::make_unique<Live<Loop<Model>>>(std::move(model), std::move(parts));
}

}  // namespace phantom
