// The emulated HDAPI keeps its rules: each of them can be broken, and is then noticed.
#include "haptics/hdapi/hdapi_support.hpp"
#include "support/catch.hpp"

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

/// A callback of the vendor's kind, made of a function.
template <void (*Act)(HdWorld&, unsigned)>
unsigned in_tick(void* handle) noexcept {
  Act(HdWorld::here(), *static_cast<unsigned*>(handle));
  return HdCode::callback_continue;
}

/// What one callback that does this leaves on the stack, the newest.
template <void (*Act)(HdWorld&, unsigned)>
unsigned error_of() {
  HdWorld world;
  world.plug("one", press_and_hold());
  unsigned handle = world.init_device(nullptr);
  world.set_capability(HdCode::force_output, true);
  const unsigned long schedule =
      world.schedule_asynchronous(EmulatedHd::callback<&in_tick<Act>>, &handle, HdCode::default_priority);
  world.start_scheduler();
  world.tick();
  const unsigned code = world.get_error().errorCode;
  world.stop_scheduler();
  world.unschedule(schedule);
  CHECK(world.violations() == (code >= 0x400 || code == HdCode::exceeded_max_force));
  return code;
}

void right(HdWorld& world, unsigned device) {
  const double force[3] = {0, 1, 0};
  world.begin_frame(device);
  world.set_doublev(HdCode::current_force, force);
  world.end_frame(device);
}
void nested(HdWorld& world, unsigned device) {
  world.begin_frame(device);
  world.begin_frame(device);
  world.end_frame(device);
}
void twice(HdWorld& world, unsigned device) {
  right(world, device);
  world.begin_frame(device);
}
void left_open(HdWorld& world, unsigned device) { world.begin_frame(device); }
void not_begun(HdWorld& world, unsigned device) { world.end_frame(device); }
void outside(HdWorld& world, unsigned device) {
  const double force[3] = {0, 1, 0};
  world.make_current_device(device);
  world.set_doublev(HdCode::current_force, force);
}
void too_strong(HdWorld& world, unsigned device) {
  const double force[3] = {0, 38, 0};
  world.begin_frame(device);
  world.set_doublev(HdCode::current_force, force);
  world.end_frame(device);
}
void wrong_handle(HdWorld& world, unsigned device) { world.make_current_device(device + 1); }
void wrong_name(HdWorld& world, unsigned) {
  double value;
  world.get_doublev(1, &value);
}

}  // namespace

TEST_CASE("what breaks a rule of frames is the vendor's error", "[hd_world]") {
  CHECK(error_of<right>() == HdCode::success);
  CHECK(error_of<nested>() == HdCode::illegal_begin);
  CHECK(error_of<twice>() == HdCode::illegal_begin);
  CHECK(error_of<left_open>() == HdCode::frame_error);
  CHECK(error_of<not_begun>() == HdCode::illegal_end);
  CHECK(error_of<outside>() == HdCode::frame_error);
  CHECK(error_of<too_strong>() == HdCode::exceeded_max_force);
  CHECK(error_of<wrong_handle>() == HdCode::bad_handle);
  CHECK(error_of<wrong_name>() == HdCode::invalid_enum);
}

TEST_CASE("the last force persists, a frame without one sends zero, motors are off until enabled",
          "[hd_world]") {
  HdWorld world;
  auto& phantom = world.plug("one", press_and_hold());
  const unsigned device = world.init_device("one");
  const double force[3] = {1, 2, 3};
  const auto frame = [&](bool with_force) {
    phantom.framed = false;
    world.begin_frame(device);
    if (with_force) world.set_doublev(HdCode::current_force, force);
    world.end_frame(device);
  };
  frame(true);
  CHECK(world.motors(phantom) == Eigen::Vector3d::Zero());
  world.set_capability(HdCode::force_output, true);
  frame(true);
  CHECK(world.motors(phantom) == Eigen::Vector3d(1, 2, 3));
  world.run(3);
  CHECK(world.motors(phantom) == Eigen::Vector3d(1, 2, 3));
  frame(false);
  CHECK(world.motors(phantom) == Eigen::Vector3d::Zero());
}

TEST_CASE("while the scheduler runs a device is nobody's but the callbacks'", "[hd_world]") {
  HdWorld world;
  world.plug("one", press_and_hold());
  unsigned device = world.init_device("one");
  world.start_scheduler();  // before its callbacks
  CHECK(world.violations() == 1);
  world.start_scheduler();
  CHECK(world.violations() == 2);
  while (world.get_error().errorCode != HdCode::success) continue;
  double values[6];
  world.make_current_device(device);
  world.begin_frame(device);
  world.get_doublev(HdCode::current_position, values);
  world.set_scheduler_rate(500);
  CHECK(world.violations() == 6);
  CHECK(world.get_error().errorCode == HdCode::invalid_operation);
  world.stop_scheduler();
  world.stop_scheduler();
  CHECK(world.violations() == 7);
  world.schedule_synchronous(EmulatedHd::callback<&in_tick<right>>, &device, HdCode::default_priority);
  world.unschedule(77);
  CHECK(world.violations() == 9);
}

TEST_CASE("errors are one stack, the newest first, each with its device", "[hd_world]") {
  HdWorld world;
  auto& one = world.plug("one", press_and_hold());
  auto& two = world.plug("two", press_and_hold());
  world.init_device("one");
  world.init_device("two");
  CHECK(one.handle != two.handle);
  world.raise(HdCode::warm_motors, &one);
  world.raise(HdCode::comm_error, &two);
  world.raise(HdCode::timer_error);
  const auto first = world.get_error(), second = world.get_error(), third = world.get_error();
  CHECK((first.errorCode == HdCode::timer_error && first.hHD == HdCode::invalid_handle));
  CHECK((second.errorCode == HdCode::comm_error && second.hHD == two.handle));
  CHECK((third.errorCode == HdCode::warm_motors && third.hHD == one.handle));
  CHECK(world.get_error().errorCode == HdCode::success);
}

TEST_CASE("callbacks go by priority, then by age, and one that is done is called no more", "[hd_world]") {
  HdWorld world;
  world.plug("one", press_and_hold());
  struct Call {
    std::string* order;
    char mark;
    static unsigned go_on(void* self) noexcept {
      static_cast<Call*>(self)->order->push_back(static_cast<Call*>(self)->mark);
      return HdCode::callback_continue;
    }
    static unsigned once(void* self) noexcept { return go_on(self), HdCode::callback_done; }
  };
  std::string order;
  Call a{&order, 'a'}, b{&order, 'b'}, c{&order, 'c'}, d{&order, 'd'};
  const unsigned long of_a = world.schedule_asynchronous(&Call::go_on, &a, 10);
  world.schedule_asynchronous(&Call::go_on, &b, 20);
  world.schedule_asynchronous(&Call::once, &c, 20);
  world.start_scheduler();
  world.tick();
  CHECK(order == "bca");
  order.clear();
  world.schedule_synchronous(&Call::once, &d, 15);
  CHECK(order == "bda");
  order.clear();
  world.unschedule(of_a);
  world.tick();
  CHECK(order == "b");
  world.stop_scheduler();
  world.tick();
  CHECK(order == "b");
}

TEST_CASE(
    "a device with an inkwell is calibrated in the servo loop alone: asked within a frame, updated outside",
    "[hd_world]") {
  struct Calibrates {
    unsigned device, style;
    bool in_frame;
    unsigned outside = 0, inside = 0;
    static unsigned run(void* self) noexcept {
      auto& c = *static_cast<Calibrates*>(self);
      HdWorld& world = HdWorld::here();
      world.make_current_device(c.device);
      c.outside = world.check_calibration();
      world.begin_frame(c.device);
      c.inside = world.check_calibration();
      if (c.in_frame) world.update_calibration(c.style);
      world.end_frame(c.device);
      if (!c.in_frame) world.update_calibration(c.style);
      return HdCode::callback_continue;
    }
  };
  const unsigned style = GENERATE(as<unsigned>(), HdCode::calibration_auto, HdCode::calibration_inkwell);
  const bool in_frame = GENERATE(false, true);
  HdWorld world;
  auto& phantom = world.plug("one", press_and_hold());
  phantom.styles = style;
  phantom.calibration = HdCode::calibration_needs_update;
  Calibrates calibrates{world.init_device("one"), style, in_frame};
  world.update_calibration(style);
  CHECK(world.check_calibration() == HdCode::calibration_needs_update);
  CHECK(world.violations() == 2);
  world.schedule_asynchronous(&Calibrates::run, &calibrates, HdCode::default_priority);
  world.start_scheduler();
  world.tick();
  CHECK(calibrates.inside == HdCode::calibration_needs_update);
  CHECK(phantom.updates == !in_frame);
  world.tick();
  CHECK(calibrates.inside == (in_frame ? HdCode::calibration_needs_update : HdCode::calibration_ok));
  CHECK(calibrates.outside == HdCode::calibration_needs_update);
  CHECK(world.violations() == 2 + (in_frame ? 4 : 2));
  world.update_calibration(HdCode::calibration_encoder_reset);
  world.stop_scheduler();
  // No error told of any of it.
  CHECK(world.get_error().errorCode == HdCode::invalid_operation);  // the last, from outside of a callback
  CHECK(world.get_error().errorCode == HdCode::success);
  // A stylus that is not in the inkwell cannot be updated away.
  phantom.calibration = HdCode::calibration_needs_manual_input;
  calibrates.in_frame = false;
  world.start_scheduler();
  world.run(2);
  CHECK(calibrates.inside == HdCode::calibration_needs_manual_input);
  world.stop_scheduler();
}
