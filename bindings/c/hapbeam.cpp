// SPDX-License-Identifier: MIT
// The C interface: one object for each model that a program in C can name, and no exception across the border.
#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include "border.hpp"
#include "described.hpp"
#include "touch_of.hpp"
#include <hapbeam/hapbeam.hpp>
#include <hapbeam/haptics/device/known_devices.hpp>
#ifdef HAPBEAM_C_HAS_MODEL_FILES
#include <hapbeam/rom/file/model_file.hpp>
#endif

using namespace hapbeam;
using border::created;
using border::described;
using border::guarded;
using border::no_strain;
using border::text;
using border::touch_of;

namespace {

const hapbeam_touch& some(const hapbeam_touch* touch) {
  if (!touch) throw std::invalid_argument("touch = null: must be one that was created");
  return *touch;
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

hapbeam_contact contact_of(const TouchResult<double>& felt) noexcept {
  return {{felt.force.x(), felt.force.y()},
          {felt.friction.x(), felt.friction.y()},
          felt.press.s,
          felt.press.d,
          felt.dissipated,
          felt.pressing,
          felt.sliding,
          static_cast<int>(felt.status)};
}

double write_strain(const PeakStrain<double>& peak, double* s) noexcept {
  if (s) *s = peak.s;
  return peak.strain;
}

constexpr double pi = 3.141592653589793;

}  // namespace

const char* hapbeam_status_name(int status) {
  return status >= -4 && status <= 2 ? name(static_cast<Status>(status)) : "unknown";
}

const char* hapbeam_loop_name(int loop) {
  return loop >= HAPBEAM_LOOP_FREE && loop <= HAPBEAM_LOOP_DEVICE ? name(static_cast<LoopStatus>(loop))
                                                                  : "unknown";
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
                                    double avatar_radius, const hapbeam_friction* friction, char* message) {
  return created(message, [&] {
    using border::beam_of;
    const Friction rough = border::friction_of(friction);
    if (!(elements >= 2 && elements <= 4096)) detail::reject("elements", elements, "", "2 to 4096");
    switch (kinematics) {
      case HAPBEAM_LINEAR: return touch_of(FemModel<Linear>(beam_of(beam), elements), avatar_radius, rough);
      case HAPBEAM_VON_KARMAN: return touch_of(FemModel<>(beam_of(beam), elements), avatar_radius, rough);
      case HAPBEAM_COROTATIONAL:
        return touch_of(FemModel<Corotational<>>(beam_of(beam), elements), avatar_radius, rough);
      default: break;
    }
    detail::reject("kinematics", kinematics, "", "HAPBEAM_LINEAR, VON_KARMAN or COROTATIONAL");
  });
}

hapbeam_touch* hapbeam_touch_load(const char* path, double avatar_radius, char* message) {
  return created(message, [&]() -> std::unique_ptr<hapbeam_touch> {
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
  if (touch) return contact_of(touch->tick({x, w}));
  hapbeam_contact nothing{};
  nothing.status = HAPBEAM_INVALID_REQUEST;
  return nothing;
}

int hapbeam_touch_ticks(hapbeam_touch* touch, const double* x_w, int count, hapbeam_contact* felt) {
  if (!touch || !x_w || !felt) return 0;
  for (int i = 0; i < count; ++i) felt[i] = contact_of(touch->tick({x_w[2 * i], x_w[2 * i + 1]}));
  return (std::max)(count, 0);
}

int hapbeam_touch_presses(hapbeam_touch* touch, const double* s_d, int count, hapbeam_response* responses) {
  if (!touch || !s_d || !responses) return 0;
  for (int i = 0; i < count; ++i) {
    const Response<double> response = touch->press({s_d[2 * i], s_d[2 * i + 1]});
    responses[i] = {response.force, static_cast<int>(response.status)};
  }
  return (std::max)(count, 0);
}

void hapbeam_touch_reset(hapbeam_touch* touch) {
  if (touch) touch->reset();
}

int hapbeam_touch_shape(const hapbeam_touch* touch, double* x_w, int count) {
  return touch ? write_shape(touch->shape(), x_w, count) : 0;
}

double hapbeam_touch_peak_strain(const hapbeam_touch* touch, double* s) {
  return write_strain(touch ? touch->peak_strain() : no_strain, s);
}

int hapbeam_known_device(const char* name, hapbeam_device* device, char* message) {
  return guarded(message, [&] {
    const hapbeam_device known = described(known_device(text("name", name)));
    if (device) *device = known;
    return 1;
  });
}

hapbeam_servo* hapbeam_servo_create(const hapbeam_touch* touch, const hapbeam_device* device, double x,
                                    double w, double scale, char* message) {
  return created(message, [&] {
    ServoOptions options;
    options.placement = Placement::in_plane({x, w}, scale);
    return some(touch).servo(border::device_of(device), options);
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

int hapbeam_servo_loop(const hapbeam_servo* servo) {
  return static_cast<int>(servo ? servo->loop() : LoopStatus::no_answer);
}

double hapbeam_servo_peak_strain(const hapbeam_servo* servo, double* s) {
  return write_strain(servo ? servo->peak_strain() : no_strain, s);
}

void hapbeam_servo_reset(hapbeam_servo* servo) {
  if (servo) servo->reset();
}

int hapbeam_servo_shape(hapbeam_servo* servo, double* x_w, int count) {
  return servo ? write_shape(servo->shape(), x_w, count) : 0;
}
