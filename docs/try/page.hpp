// A scene of the page: its models, each under an avatar of its own, and the hand, which is coupled to one of them.
//
// Compiled for the browser (exports.cpp) and for this machine (native.cpp), which have to feel the same forces.
#pragma once

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "scenes.hpp"
#include <hapbeam/contact/touch_in_motion.hpp>
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/fem/dynamic_model.hpp>
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/fem/force_error.hpp>
#include <hapbeam/haptics/servo/sound.hpp>
#include <hapbeam/haptics/stability/coupling.hpp>
#include <hapbeam/rom/trained/galerkin_model.hpp>
#include <hapbeam/rom/trained/pod_model.hpp>
#include <hapbeam/rom/training/train.hpp>

namespace page {

using namespace hapbeam;

inline constexpr double period = 1e-3;  // [s]

/// In the order of the page's list.
enum Model { von_karman_8, von_karman_16, corotational_8, corotational_16, pod, galerkin, with_mass, models };

/// What a tick was, in numbers for the page.
struct Tick {
  double hand_x, hand_w, avatar_x, avatar_w;  ///< [m]
  double force_x, force_w;                    ///< [N] on the hand
  double depth;     ///< [m] that the avatar has come since it met the beam, along the normal there
  double pressing;  ///< 1 or 0
  double status;    ///< hapbeam::Status
};

/// A model that is touched.
struct Touched {
  virtual ~Touched() = default;
  virtual TouchResult<double> touch(const Point& avatar) noexcept = 0;
  virtual CoupledForce<double> couple(const Point& hand) noexcept = 0;
  virtual void reset() noexcept = 0;
  virtual Centreline<double> shape() const noexcept = 0;
  /// Largest error of the last force [N], as the model states it; not a number where it states none.
  virtual double bound() noexcept { return std::numeric_limits<double>::quiet_NaN(); }
  /// The oldest samples that have not been heard.   @return how many
  virtual int hear(float*, int) noexcept { return 0; }
};

template <class Model>
class TouchedModel : public Touched {
 public:
  TouchedModel(Model model, const Scene& scene)
      : model_(std::move(model)),
        touch_(model_, scene.radius),
        coupling_({scene.stiffness, 2e-3 * scene.stiffness}) {}
  TouchResult<double> touch(const Point& avatar) noexcept override { return touch_.tick(avatar); }
  CoupledForce<double> couple(const Point& hand) noexcept override {
    return coupling_.tick(touch_, hand, period);
  }
  void reset() noexcept override { touch_.reset(), coupling_.reset(); }
  Centreline<double> shape() const noexcept override { return model_.shape(); }

 protected:
  Model model_;

 private:
  Touch<Model> touch_;
  VirtualCoupling coupling_;
};

/// One that bounds what its mesh leaves in the force.
template <class Element>
class Meshed final : public TouchedModel<FemModel<Element>> {
 public:
  Meshed(const Scene& scene, int elements)
      : TouchedModel<FemModel<Element>>(FemModel<Element>(scene.beam, elements), scene),
        force_error_(scene.beam, elements) {}
  double bound() noexcept override { return force_error_(this->model_); }

 private:
  ForceError<Element> force_error_;
};

/// One that swings, in parts of a tick of 42 µs, which are heard: the velocity at a place of it.
class Swinging final : public Touched {
 public:
  using Model = DynamicModel<>;
  explicit Swinging(const Scene& scene)
      : model_(scene.beam, scene.stretched() ? 16 : 8, 24),
        touch_(model_, scene.radius),
        coupling_({scene.stiffness, 2e-3 * scene.stiffness}),
        sound_(model_, {SoundSource::velocity,
                        (scene.beam.right() == Support::free ? 1 : 0.83) * scene.beam.length()}),
        stiffness_(scene.stiffness) {}
  /// Through a spring ten times as stiff: with mass no place is prescribed.
  TouchResult<double> touch(const Point& avatar) noexcept override {
    return touch_.tick(avatar, period, 10 * stiffness_, 0.02 * stiffness_);
  }
  CoupledForce<double> couple(const Point& hand) noexcept override {
    return coupling_.tick(touch_, hand, period);
  }
  void reset() noexcept override {
    touch_.reset(), coupling_.reset();
    float before[512];
    while (hear(before, 512) > 0) {
    }
  }
  Centreline<double> shape() const noexcept override { return model_.shape(); }
  int hear(float* samples, int most) noexcept override {
    return sound_.read(samples, (std::min)(most, static_cast<int>(sound_.waiting())));
  }

 private:
  Model model_;
  Touch<Model> touch_;
  VirtualCoupling coupling_;
  Sound<Model> sound_;
  double stiffness_;
};

template <class Model>
std::unique_ptr<Touched> touched(Model model, const Scene& scene) {
  return std::make_unique<TouchedModel<Model>>(std::move(model), scene);
}

/// The avatar comes down to a place.   @param height [m] from where
inline void come_down(Touched& beam, const Point& avatar, double height) {
  constexpr int ticks = 60;
  beam.reset();
  for (int k = ticks; k > 0; --k) (void)beam.touch(avatar + Point(0, height * k / ticks));
}

/// The force there, once it has settled.
inline Point settled(Touched& beam, const Point& avatar, double height) {
  constexpr int apart = 20, most = 400;
  come_down(beam, avatar, height);
  Point before = Point::Zero();
  for (int k = 1; k <= most; ++k) {
    const Point force = beam.touch(avatar).force;
    if (k % apart != 0) continue;
    if (k > apart && (force - before).norm() <= 1e-6 * force.norm()) break;
    before = force;
  }
  return before;
}

class Page {
 public:
  explicit Page(Scene scene) : scene_(std::move(scene)) {
    const Beam& beam = scene_.beam;
    models_[von_karman_8] = std::make_unique<Meshed<VonKarman<>>>(scene_, 8);
    models_[von_karman_16] = std::make_unique<Meshed<VonKarman<>>>(scene_, 16);
    models_[corotational_8] = std::make_unique<Meshed<Corotational<>>>(scene_, 8);
    models_[corotational_16] = std::make_unique<Meshed<Corotational<>>>(scene_, 16);
    if (scene_.rise == 0) models_[with_mass] = std::make_unique<Swinging>(scene_);
    if (beam.straight() && beam.right() == Support::pinned) {
      const auto full = full_model<Corotational<>>(beam, 128);
      const TrainingPlan plan = TrainingPlan::anywhere(beam, 2.5 * scene_.depth);
      models_[pod] = touched(PodModel<>(train_pod(take_snapshots(beam, full, plan))), scene_);
      models_[galerkin] =
          touched(GalerkinModel<>(train_galerkin(take_snapshots_at_tensions(beam, full, plan))), scene_);
    }
    const auto reference = touched(full_model<Corotational<>>(beam, 256), scene_);
    for (const Point& stop : stops()) truth_.push_back(settled(*reference, stop, height()));
    for (int k = 0; k < 1000; ++k) {
      const double t = k * period, in = 0.1 + 0.45 * (1 - std::cos(4 * pi * t));
      const double x = (scene_.from + scene_.to + (scene_.to - scene_.from) * std::sin(2 * pi * t)) / 2;
      stroke_.emplace_back(x, scene_.top(x) - in * scene_.depth);
    }
  }

  const Scene& scene() const { return scene_; }
  bool has(int model) const { return models_[at(model)] != nullptr; }
  /// Puts a model under the hand, untouched.
  void choose(int model) { model_ = at(model), models_[model_]->reset(), begun_.reset(); }
  /// Puts the hand somewhere, touching nothing until its next tick.
  void place(const Point& hand) { hand_ = hand, choose(static_cast<int>(model_)); }
  /// The demonstration begins anew.
  void rewind() { time_ = 0; }

  /// A tick of the hand on its way to where the pointer is: a new place each 8 ms or 16 ms, from which a millisecond makes a path.
  const Tick& go(const Point& pointer) {
    const Point way = 0.08 * (pointer - hand_);
    const double most = 0.01 * scene_.beam.length(), length = way.norm();
    hand_ += length > most ? Point(way * (most / length)) : way;
    return tick();
  }
  const Tick& demonstrate() {
    const Point hand = scene_.demonstration(time_ * period).position.head<2>();
    if (time_ == 0) place(hand);
    hand_ = hand;
    time_ = time_ < demonstration() ? time_ + 1 : 1;
    return tick();
  }
  int demonstration() const { return static_cast<int>(scene_.demonstration.duration() / period); }

  /// Largest relative error of the force, at 16 presses; the reference has 256 elements of finite rotation.  Not a number of one that swings.
  double error(int model) {
    if (model == with_mass) return std::numeric_limits<double>::quiet_NaN();
    double worst = 0;
    const auto presses = stops();
    for (std::size_t k = 0; k < presses.size(); ++k) {
      const Point force = settled(*models_[at(model)], presses[k], height());
      const double error = (force - truth_[k]).norm() / truth_[k].norm();
      if (!(error <= worst)) worst = error;
    }
    return worst;
  }
  /// What the model under the hand states of the last tick, relative; not a number where it states nothing.
  double bound() {
    const double force = std::hypot(record_.force_x, record_.force_w);
    return record_.pressing > 0 && force > 0 ? models_[model_]->bound() / force
                                             : std::numeric_limits<double>::quiet_NaN();
  }
  /// So many ticks of an avatar that goes in and out and to and fro, for their time.   @return  sum of the forces
  double stroke(int model, int ticks) {
    Touched& beam = *models_[at(model)];
    come_down(beam, stroke_.front(), height());
    double sum = 0;
    for (int k = 0; k < ticks; ++k)
      sum += beam.touch(stroke_[static_cast<std::size_t>(k) % stroke_.size()]).force.norm();
    return sum;
  }
  /// What has been heard of the model under the hand: 1 is what a press as deep as the scene's, let go, has about.   @return how many samples
  int hear(float* samples, int most) {
    const int count = models_[model_]->hear(samples, most);
    const Beam& beam = scene_.beam;
    const double mass = beam.mass_per_length(beam.length() / 2) * beam.length();
    const auto loud = static_cast<float>(scene_.depth * std::sqrt(2 * scene_.stiffness / mass));
    for (int k = 0; k < count; ++k) samples[k] /= loud;
    return count;
  }

  /// The centreline as points.   @param points  x, w [m] and bending strain of each; room for 160   @return  how many
  int line(double* points) const {
    const Centreline<double> shape = models_[model_]->shape();
    const double natural = scene_.beam.arcs().empty() ? 0 : scene_.beam.arcs().front().curvature;
    const int pieces = 128 / shape.segments();
    int count = 0;
    const auto add = [&](const CubicSegment<double>& b, double t) {
      const double r = 1 - t;
      const Point place =
          r * r * r * b.col(0) + 3 * r * t * (r * b.col(1) + t * b.col(2)) + t * t * t * b.col(3);
      const Point d =
          r * r * (b.col(1) - b.col(0)) + 2 * r * t * (b.col(2) - b.col(1)) + t * t * (b.col(3) - b.col(2));
      const Point dd = r * (b.col(0) - 2 * b.col(1) + b.col(2)) + t * (b.col(1) - 2 * b.col(2) + b.col(3));
      // κ of r(t) with r' = 3 d, r'' = 6 dd, positive where it bends up; θ turns the other way.
      const double speed = d.norm(),
                   curvature = 2 * (d.x() * dd.y() - d.y() * dd.x()) / (3 * speed * speed * speed);
      points[3 * count] = place.x(), points[3 * count + 1] = place.y();
      points[3 * count + 2] = std::abs(curvature + natural) * scene_.beam.thickness() / 2;
      ++count;
    };
    shape.visit_segments([&](int i, const CubicSegment<double>& b) {
      if (i == 0) add(b, 0);
      for (int k = 1; k <= pieces; ++k) add(b, static_cast<double>(k) / pieces);
    });
    return count;
  }

 private:
  static constexpr double pi = 3.141592653589793238462643;
  static std::size_t at(int model) { return static_cast<std::size_t>(std::clamp(model, 0, models - 1)); }

  /// [m] above the deepest press: clear of the beam.
  double height() const { return scene_.depth + scene_.radius; }
  std::vector<Point> stops() const {
    std::vector<Point> all;
    for (int i = 0; i < 4; ++i)
      for (int j = 1; j <= 4; ++j) {
        const double x = scene_.from + (scene_.to - scene_.from) * i / 3;
        all.emplace_back(x, scene_.top(x) - scene_.depth * j / 4);
      }
    return all;
  }

  const Tick& tick() {
    const CoupledForce<double> felt = models_[model_]->couple(hand_);
    const bool pressing = felt.touch.pressing;
    if (pressing && !begun_) begun_ = Begun{felt.avatar, felt.touch.contact.normal};
    if (!pressing && felt.force.isZero(0)) begun_.reset();
    record_ = {hand_.x(),
               hand_.y(),
               felt.avatar.x(),
               felt.avatar.y(),
               felt.force.x(),
               felt.force.y(),
               begun_ ? (begun_->avatar - felt.avatar).dot(begun_->normal) : 0,
               pressing ? 1.0 : 0.0,
               static_cast<double>(static_cast<int>(felt.touch.status))};
    return record_;
  }

  struct Begun {
    Point avatar, normal;
  };

  Scene scene_;
  std::array<std::unique_ptr<Touched>, models> models_;
  std::vector<Point> truth_, stroke_;
  std::size_t model_ = 0;
  Point hand_ = Point::Zero();
  int time_ = 0;
  std::optional<Begun> begun_;
  Tick record_{};
};

}  // namespace page
