// SPDX-License-Identifier: MIT
// The C interface: one object for each model that a program in C can name, and no exception across the border.
#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include "border.hpp"
#include <hapbeam/hapbeam.hpp>
#include <hapbeam/haptics/device/known_devices.hpp>
#ifdef HAPBEAM_C_HAS_MODEL_FILES
#include <hapbeam/rom/file/model_file.hpp>
#endif

using namespace hapbeam;
using border::guarded;
using border::text;

struct hapbeam_servo {
  virtual ~hapbeam_servo() = default;
  virtual int tick(const Eigen::Vector3d& position, const Eigen::Vector3d& velocity, double dt,
                   Eigen::Vector3d& force) noexcept = 0;
  virtual void reset() noexcept = 0;
  virtual Centreline<double> shape() noexcept = 0;
};

struct hapbeam_touch {
  virtual ~hapbeam_touch() = default;
  virtual TouchResult<double> tick(const Vector2<double>& hand) noexcept = 0;
  virtual void reset() noexcept = 0;
  virtual Centreline<double> shape() const noexcept = 0;
  virtual PeakStrain<double> peak_strain() const noexcept = 0;
  virtual std::unique_ptr<hapbeam_servo> servo(const DeviceInfo& device, ServoOptions options) const = 0;
};

namespace {

template <class Model>
class ServoOf final : public hapbeam_servo {
 public:
  ServoOf(const Model& model, const DeviceInfo& device, const ServoOptions& options)
      : model_(model), servo_(model_, device, options) {}
  int tick(const Eigen::Vector3d& position, const Eigen::Vector3d& velocity, double dt,
           Eigen::Vector3d& force) noexcept override {
    force = servo_.tick(position, velocity, dt);
    return static_cast<int>(servo_.record().model);
  }
  void reset() noexcept override { servo_.reset(); }
  Centreline<double> shape() noexcept override { return servo_.picture().shape(); }

 private:
  Model model_;
  Servo<Model> servo_;
};

template <class Model>
class TouchOf final : public hapbeam_touch {
 public:
  TouchOf(Model model, double avatar_radius)
      : untouched_(std::move(model)),
        model_(untouched_),
        radius_(avatar_radius),
        touch_(model_, avatar_radius) {}
  TouchResult<double> tick(const Vector2<double>& hand) noexcept override { return touch_.tick(hand); }
  void reset() noexcept override { touch_.reset(); }
  Centreline<double> shape() const noexcept override { return model_.shape(); }
  PeakStrain<double> peak_strain() const noexcept override {
    if constexpr (has_internal_forces<Model>) return hapbeam::peak_strain(model_);
    else return {-1, 0};
  }
  std::unique_ptr<hapbeam_servo> servo(const DeviceInfo& device, ServoOptions options) const override {
    options.avatar_radius = radius_;
    return std::make_unique<ServoOf<Model>>(untouched_, device, options);
  }

 private:
  Model untouched_, model_;
  double radius_;
  Touch<Model> touch_;
};

template <class Model>
std::unique_ptr<hapbeam_touch> touch_of(Model model, double avatar_radius) {
  return std::make_unique<TouchOf<Model>>(std::move(model), avatar_radius);
}

Support support(const char* end, int value) {
  if (!(value >= HAPBEAM_FREE && value <= HAPBEAM_GUIDED))
    detail::reject(end, value, "", "HAPBEAM_FREE, CLAMPED, PINNED, ROLLER or GUIDED");
  return static_cast<Support>(value);
}

const hapbeam_touch& some(const hapbeam_touch* touch) {
  if (!touch) throw std::invalid_argument("touch = null: must be one that was created");
  return *touch;
}

Beam beam_of(const hapbeam_beam* b) {
  if (!b) throw std::invalid_argument("beam = null: must be a description of one");
  Beam beam(b->length, b->axial_stiffness, b->bending_stiffness, b->thickness, support("left", b->left),
            support("right", b->right));
  if (b->transverse_load != 0) beam.transverse(b->transverse_load);
  if (b->axial_load != 0) beam.axial(b->axial_load);
  return beam;
}

int write_shape(const Centreline<double>& line, double* x_w, int count) noexcept {
  if (!x_w || count < 2) return 0;
  for (int i = 0; i < count; ++i) {
    const double s = std::min(line.length() * i / (count - 1), line.length());
    const Vector2<double> at = line.position(s);
    std::copy(at.data(), at.data() + 2, x_w + 2 * i);
  }
  return count;
}

hapbeam_beam described(double length, const Section& section, double young, int left, int right) noexcept {
  return {length, young * section.area, young * section.inertia, section.thickness, 0, 0, left, right};
}

constexpr double pi = 3.141592653589793;

}  // namespace

const char* hapbeam_status_name(int status) {
  return status >= -4 && status <= 2 ? name(static_cast<Status>(status)) : "unknown";
}

int hapbeam_version() { return HAPBEAM_VERSION; }

// Not Section's own, which throw: what is wrong with a size is said when it is used.
hapbeam_beam hapbeam_rectangle(double length, double width, double height, double young, int left,
                               int right) {
  return described(length, {width * height, width * height * height * height / 12, height}, young, left,
                   right);
}

hapbeam_beam hapbeam_circle(double length, double diameter, double young, int left, int right) {
  const double area = pi * diameter * diameter / 4;
  return described(length, {area, area * diameter * diameter / 16, diameter}, young, left, right);
}

hapbeam_touch* hapbeam_touch_create(const hapbeam_beam* beam, int kinematics, int elements,
                                    double avatar_radius, char* message) {
  return guarded(message, [&] {
    if (!(elements >= 2 && elements <= 4096)) detail::reject("elements", elements, "", "2 to 4096");
    switch (kinematics) {
      case HAPBEAM_LINEAR: return touch_of(FemModel<Linear>(beam_of(beam), elements), avatar_radius);
      case HAPBEAM_VON_KARMAN: return touch_of(FemModel<>(beam_of(beam), elements), avatar_radius);
      case HAPBEAM_COROTATIONAL:
        return touch_of(FemModel<Corotational<>>(beam_of(beam), elements), avatar_radius);
      default: break;
    }
    detail::reject("kinematics", kinematics, "", "HAPBEAM_LINEAR, VON_KARMAN or COROTATIONAL");
  });
}

hapbeam_touch* hapbeam_touch_load(const char* path, double avatar_radius, char* message) {
  return guarded(message, [&]() -> std::unique_ptr<hapbeam_touch> {
    const std::string file = text("path", path);
#ifdef HAPBEAM_C_HAS_MODEL_FILES
    const ModelFileInfo info = describe_model_file(file);
    if (info.kind == "pod") return touch_of(load_model<PodModel<>>(file), avatar_radius);
    return touch_of(load_model<GalerkinModel<>>(file), avatar_radius);
#else
    (void)avatar_radius;
    throw std::runtime_error(file + ": this library was built without model files (HAPBEAM_WITH_JANSSON)");
#endif
  });
}

void hapbeam_touch_destroy(hapbeam_touch* touch) { delete touch; }

hapbeam_contact hapbeam_touch_tick(hapbeam_touch* touch, double x, double w) {
  if (!touch) return {{0, 0}, 0, 0, 0, HAPBEAM_INVALID_REQUEST};
  const TouchResult<double> felt = touch->tick({x, w});
  return {{felt.force.x(), felt.force.y()},
          felt.press.s,
          felt.press.d,
          felt.pressing,
          static_cast<int>(felt.status)};
}

void hapbeam_touch_reset(hapbeam_touch* touch) {
  if (touch) touch->reset();
}

int hapbeam_touch_shape(const hapbeam_touch* touch, double* x_w, int count) {
  return touch ? write_shape(touch->shape(), x_w, count) : 0;
}

double hapbeam_touch_peak_strain(const hapbeam_touch* touch, double* s) {
  const PeakStrain<double> peak = touch ? touch->peak_strain() : PeakStrain<double>{-1, 0};
  if (s) *s = peak.s;
  return peak.strain;
}

hapbeam_servo* hapbeam_servo_create(const hapbeam_touch* touch, const char* device, double period, double x,
                                    double w, double scale, char* message) {
  return guarded(message, [&] {
    DeviceInfo info = known_device(text("device", device));
    info.period = period;
    ServoOptions options;
    options.placement = Placement::in_plane({x, w}, scale);
    return some(touch).servo(info, options);
  });
}

void hapbeam_servo_destroy(hapbeam_servo* servo) { delete servo; }

int hapbeam_servo_tick(hapbeam_servo* servo, const double position[3], const double velocity[3], double dt,
                       double force[3]) {
  Eigen::Vector3d sent(0, 0, 0);
  int status = HAPBEAM_INVALID_REQUEST;
  if (servo && position && velocity)
    status = servo->tick({position[0], position[1], position[2]}, {velocity[0], velocity[1], velocity[2]}, dt,
                         sent);
  if (force) std::copy(sent.data(), sent.data() + 3, force);
  return status;
}

void hapbeam_servo_reset(hapbeam_servo* servo) {
  if (servo) servo->reset();
}

int hapbeam_servo_shape(hapbeam_servo* servo, double* x_w, int count) {
  return servo ? write_shape(servo->shape(), x_w, count) : 0;
}
