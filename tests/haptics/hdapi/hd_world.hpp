// A world with haptic devices in it, behind the functions of HDAPI: simulated arms in simulated hands, one
// scheduler, one stack of errors, and the rules that the real one has.
//
//   - One servo thread calls all callbacks, once a tick, the highest priority first; while it runs, a call of
//     a device from anywhere else is an error.  In lock step a test's tick() is that thread.
//   - A frame belongs to one device, once a tick.  Beginning it makes the device current and its force zero,
//     ending it commits the force.  Nesting, ending what did not begin, and leaving one open are errors.
//   - The last force persists when nothing new is sent, the last torque too.  Motors are off until force output is enabled.
//   - A device reads three axes or six, and drives three or six.  Torque, in mN·m, is an error where it drives three.
//   - Errors are one stack for all, the newest first, each with the handle of its device.
//   - A device that was unplugged has a dead handle for ever; it is initialised anew after it was disabled.
//   - Encoders are reset wherever a device may be called.  A device with an inkwell or automatic calibration is
//     calibrated by the servo loop alone: its status is asked within a frame, and updated outside of one.
//     Elsewhere the status stays "needs update", nothing is updated, and no error says so.
//
// What breaks a rule is also counted (violations()), because an adapter that reacts well to its own mistake
// hides it. Nothing in a tick allocates.
#pragma once

#include <array>
#include <atomic>
#include <condition_variable>
#include <cstring>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include <hapbeam/haptics/device/virtual_phantom.hpp>

namespace hapbeam::testing {

/// HDAPI's numbers, as the public reference gives them.
struct HdCode {
  static constexpr unsigned current_position = 0x2050, current_velocity = 0x2051, current_force = 0x2700,
                            motor_temperature = 0x2605, device_model_type = 0x2501, usable_workspace = 0x2551,
                            nominal_max_force = 0x2603, nominal_max_continuous_force = 0x2604,
                            nominal_max_stiffness = 0x2602, current_transform = 0x2052,
                            current_torque = 0x2701, input_dof = 0x2553, output_dof = 0x2554,
                            nominal_max_torque = 0x2622, nominal_max_continuous_torque = 0x2623,
                            nominal_max_torque_stiffness = 0x2620, force_output = 0x4000,
                            calibration_ok = 0x5000, calibration_needs_update = 0x5001,
                            calibration_needs_manual_input = 0x5002, calibration_style = 0x2555,
                            calibration_encoder_reset = 1, calibration_auto = 2, calibration_inkwell = 4,
                            callback_done = 0, callback_continue = 1, invalid_handle = 0xffffffff;
  static constexpr unsigned short default_priority = 32767;
  static constexpr unsigned success = 0, invalid_enum = 0x100, invalid_value = 0x101,
                            invalid_operation = 0x102, bad_handle = 0x104, warm_motors = 0x200,
                            exceeded_max_force = 0x201, exceeded_max_force_impulse = 0x202,
                            exceeded_max_velocity = 0x203, force_error = 0x204, device_fault = 0x300,
                            already_initiated = 0x301, comm_error = 0x302, comm_config_error = 0x303,
                            timer_error = 0x304, illegal_begin = 0x400, illegal_end = 0x401,
                            frame_error = 0x402, invalid_priority = 0x500, scheduler_full = 0x501;
};

class HdWorld : public HdCode {
 public:
  struct Error {
    unsigned errorCode;
    int internalErrorCode;
    unsigned hHD;
  };
  using Callback = unsigned (*)(void*);
  enum class Time { lock_step, real };

  /// What a test may set while no tick runs, and read.
  struct Device {
    Device(const char* called, const HandPath& path, const VirtualPhantomOptions& options, int reads,
           int drives)
        : name(called), arm(path, options), axes_read(reads), axes_driven(drives) {}
    std::string name;
    VirtualPhantom<> arm;
    int axes_read, axes_driven;                                                // 3 or 6
    double peak_torque = 170, continuous_torque = 48, torque_stiffness = 500;  // [mN·m], [mN·m/rad]
    bool tells_axes = true;                                                    // else that is an error
    double transform_by = 1;  // times what it reads of its orientation
    Eigen::Matrix3d orientation = Eigen::Matrix3d::Identity(), seen_orientation = orientation;
    Eigen::Vector3d staged_torque{0, 0, 0}, committed_torque{0, 0, 0};  // [mN·m]
    int torques = 0;                                                    // sent
    bool plugged = true, has_sensor = true, has_readings = true;
    double temperature = 0, peak = 37.5, top_speed = 5;  // of the hottest motor; [N]; [m/s]
    unsigned calibration = calibration_ok, styles = calibration_encoder_reset, init_error = success,
             enable_error = success;
    int resets = 0, updates = 0;         // of encoders; of what calibrates itself
    Eigen::Vector3d misplaced{0, 0, 0};  // [mm] added to what it reads until it is calibrated

    unsigned handle = invalid_handle;
    bool dead = false, enabled = false, open = false, framed = false;
    Eigen::Vector3d position, velocity;            // [mm], [mm/s] as of the tick
    Eigen::Vector3d seen_position, seen_velocity;  // as of the frame
    Eigen::Vector3d staged, committed;             // [N]
    Eigen::Vector3d motors() const {
      return plugged && enabled ? committed : Eigen::Vector3d(Eigen::Vector3d::Zero());
    }
  };

  /// The middle of the usable workspace in the vendor's axes [mm], for all devices.
  static inline const Eigen::Vector3d middle{0, 33.5, -12};
  /// What usable workspaces measure [mm].
  static inline const Eigen::Vector3d extent{381, 267, 191};

  explicit HdWorld(Time kind = Time::lock_step) : time_kind_(kind) { here_ = this; }
  ~HdWorld() { here_ = nullptr; }
  static HdWorld& here() noexcept { return *here_; }

  Device& plug(const char* name, const HandPath& path) {
    devices_.push_back(std::make_unique<Device>(name, path, VirtualPhantomOptions(), 3, 3));
    return *devices_.back();
  }
  /// One that reads how its stylus is turned.   @param drives  3, or 6 where it renders torque as well
  Device& plug_turning(const char* name, const HandPath& path, int drives) {
    VirtualPhantomOptions options;
    options.gimbal.present = true, options.gimbal.peak_torque = 10;  // its world says what is too much
    devices_.push_back(std::make_unique<Device>(name, path, options, 6, drives));
    return *devices_.back();
  }
  void unplug(Device& device) {
    const Lock lock(mutex_);
    device.plugged = false;
    device.dead = true;
    device.enabled = false;
    device.committed.setZero(), device.committed_torque.setZero();
  }
  void plug(Device& device) {
    const Lock lock(mutex_);
    device.plugged = true;
  }
  /// An error from nowhere; of a device, or of none that is named.
  void raise(unsigned code, const Device* device = nullptr) {
    const Lock lock(mutex_);
    push(code, device ? device->handle : invalid_handle);
  }
  /// What is sent to the motors [N].
  Eigen::Vector3d motors(const Device& device) {
    const Lock lock(mutex_);
    return device.motors();
  }

  Eigen::Vector3d torque(const Device& device) {  // [N·m]
    const Lock lock(mutex_);
    return torque_of(device);
  }

  /// Lock step: one tick, with the callbacks where the scheduler has been started.
  void tick() noexcept {
    now_ += std::chrono::nanoseconds(1'000'000'000 / rate_);
    {
      const Lock lock(mutex_);
      for (auto& device : devices_) device->framed = false;
    }
    step(0, true);
    const Lock lock(mutex_);
    for (auto& device : devices_) check(*device);
  }
  void run(int ticks) noexcept {
    for (int i = 0; i < ticks; ++i) tick();
  }
  /// The next tick comes some periods late: the arms move on under the last force.
  void be_late(int periods) noexcept {
    for (int i = 0; i < periods; ++i) {
      now_ += std::chrono::nanoseconds(1'000'000'000 / rate_);
      step(0, false);
    }
  }
  std::chrono::nanoseconds now() const noexcept { return now_; }

  /// Rules broken by the caller, and the last of them.
  int violations() const noexcept { return violations_; }
  std::string last_violation() const { return last_violation_; }
  std::size_t errors_left() {
    const Lock lock(mutex_);
    return errors_;
  }
  bool started() const noexcept { return started_; }
  int callbacks() {
    const Lock lock(mutex_);
    int count = 0;
    for (const Slot& slot : slots_) count += slot.callback != nullptr;
    return count;
  }
  std::string history;  ///< the calls of the lifecycle, in their order
  int starts = 0, slots_allowed = most_slots;

  // --- what the API calls; the vendor's names ---

  unsigned init_device(const char* name) noexcept {
    const Lock lock(mutex_);
    note("init ");
    if (!device_call("init_device")) return invalid_handle;
    Device* device = name ? nullptr : devices_.empty() ? nullptr : devices_.front().get();
    for (auto& candidate : devices_)
      if (name && candidate->name == name) device = candidate.get();
    if (!device || !device->plugged) return push(comm_error, invalid_handle), invalid_handle;
    if (device->init_error != success) return push(device->init_error, invalid_handle), invalid_handle;
    if (device->handle != invalid_handle) return push(already_initiated, device->handle), invalid_handle;
    device->handle = ++last_handle_;
    device->dead = device->enabled = device->open = false;
    device->committed.setZero();
    return current_ = device->handle;
  }
  void disable_device(unsigned handle) noexcept {
    const Lock lock(mutex_);
    note("disable_device ");
    Device* device = device_call("disable_device") ? find(handle) : nullptr;
    if (!device) return;
    device->handle = invalid_handle;
    device->enabled = false;
    if (current_ == handle) current_ = invalid_handle;
  }
  void make_current_device(unsigned handle) noexcept {
    const Lock lock(mutex_);
    if (device_call("make_current_device") && find(handle)) current_ = handle;
  }
  unsigned get_current_device() noexcept {
    const Lock lock(mutex_);
    return current_;
  }
  void begin_frame(unsigned handle) noexcept {
    const Lock lock(mutex_);
    Device* device = device_call("begin_frame") ? find(handle) : nullptr;
    if (!device) return;
    current_ = handle;
    if (device->open || device->framed) return broken("a second frame", illegal_begin, handle);
    device->open = device->framed = true;
    device->staged.setZero();
    if (device->dead) return push(comm_error, handle);
    device->seen_position = device->position + device->misplaced;
    device->seen_velocity = device->velocity;
    device->seen_orientation = device->orientation;
  }
  void end_frame(unsigned handle) noexcept {
    const Lock lock(mutex_);
    Device* device = device_call("end_frame") ? find(handle) : nullptr;
    if (!device) return;
    if (!device->open) return broken("a frame that did not begin", illegal_end, handle);
    device->open = false;
    if (device->dead) return push(comm_error, handle);
    device->committed = device->staged;
    if (device->committed.norm() > device->peak * (1 + 1e-12)) {
      device->committed.setZero();
      broken("a force beyond the peak", exceeded_max_force, handle);
    }
    device->committed_torque = device->staged_torque;
    if (device->committed_torque.norm() > device->peak_torque * (1 + 1e-12)) {
      device->committed_torque.setZero();
      broken("a torque beyond the peak", exceeded_max_force, handle);
    }
  }
  void set_capability(unsigned name, bool on) noexcept {
    const Lock lock(mutex_);
    if (name == force_output) note(on ? "enable_force " : "disable_force ");
    Device* device = device_call("enable or disable") ? find(current_) : nullptr;
    if (!device) return;
    if (name != force_output) return push(invalid_enum, current_);
    if (on && device->enable_error != success) return push(device->enable_error, current_);
    device->enabled = on && !device->dead;
    if (!on) device->committed.setZero(), device->committed_torque.setZero();
  }
  void get_integerv(unsigned name, int* values) noexcept {
    const Lock lock(mutex_);
    Device* device = device_call("get_integerv") ? find(current_) : nullptr;
    if (!device) return;
    if (name == calibration_style) *values = static_cast<int>(device->styles);
    else if (name == input_dof && device->tells_axes) *values = device->axes_read;
    else if (name == output_dof && device->tells_axes) *values = device->axes_driven;
    else push(invalid_enum, current_);
  }
  void get_doublev(unsigned name, double* values) noexcept {
    const Lock lock(mutex_);
    Device* device = device_call("get_doublev") ? find(current_) : nullptr;
    if (!device) return;
    const auto give = [&](const Eigen::Vector3d& v) {
      if (!device->has_readings) return;
      std::memcpy(values, v.data(), 3 * sizeof(double));
    };
    switch (name) {
      case current_position: return give(device->seen_position);
      case current_velocity: return give(device->seen_velocity);
      case current_transform:
        if (!device->has_readings) return;
        for (int column = 0; column < 4; ++column)
          for (int row = 0; row < 4; ++row)
            values[4 * column + row] = row == 3 ? column == 3
                                       : column == 3
                                           ? device->seen_position[row]
                                           : device->transform_by * device->seen_orientation(row, column);
        return;
      case nominal_max_torque:
        return device->axes_driven == 6 ? void(*values = device->peak_torque) : push(invalid_enum, current_);
      case nominal_max_continuous_torque:
        return device->axes_driven == 6 ? void(*values = device->continuous_torque)
                                        : push(invalid_enum, current_);
      case nominal_max_torque_stiffness:
        return device->axes_driven == 6 ? void(*values = device->torque_stiffness)
                                        : push(invalid_enum, current_);
      case nominal_max_force: *values = device->peak; return;
      case nominal_max_continuous_force: *values = 6.2; return;
      case nominal_max_stiffness: *values = 3.5; return;
      case usable_workspace:
        for (int i = 0; i < 3; ++i)
          values[i] = middle[i] - extent[i] / 2, values[i + 3] = middle[i] + extent[i] / 2;
        return;
      case motor_temperature:
        if (!device->has_sensor) return push(invalid_enum, current_);
        for (int i = 0; i < 6; ++i) values[i] = i == 4 ? device->temperature : 0.1;
        return;
      default: push(invalid_enum, current_);
    }
  }
  void set_doublev(unsigned name, const double* values) noexcept {
    const Lock lock(mutex_);
    Device* device = device_call("set_doublev") ? find(current_) : nullptr;
    if (!device) return;
    if (name != current_force && name != current_torque) return push(invalid_enum, current_);
    if (!device->open) return broken("a force outside a frame", frame_error, current_);
    if (name == current_torque && device->axes_driven != 6)
      return broken("a torque to a device that renders none", invalid_operation, current_);
    (name == current_force ? device->staged : device->staged_torque) = {values[0], values[1], values[2]};
    device->torques += name == current_torque;
  }
  const char* get_string(unsigned name) noexcept {
    const Lock lock(mutex_);
    if (!device_call("get_string") || !find(current_)) return nullptr;
    return name == device_model_type ? "emulated Phantom" : nullptr;
  }
  Error get_error() noexcept {
    const Lock lock(mutex_);
    return errors_ > 0 ? stack_[--errors_] : Error{success, 0, invalid_handle};
  }
  unsigned check_calibration() noexcept {
    const Lock lock(mutex_);
    if (!in_callback()) note("check_calibration ");
    Device* device = device_call("check_calibration") ? find(current_) : nullptr;
    if (!device) return calibration_needs_manual_input;
    if (!calibrates_itself(*device) || (in_callback() && device->open)) return device->calibration;
    unheard("calibration is checked within a frame of the servo loop");
    return calibration_needs_update;
  }
  void update_calibration(unsigned style) noexcept {
    const Lock lock(mutex_);
    if (!in_callback()) note("update_calibration ");
    Device* device = device_call("update_calibration") ? find(current_) : nullptr;
    if (!device) return;
    if (!(style & device->styles) || (style & (style - 1))) return push(invalid_value, current_);
    if (style == calibration_encoder_reset) {
      ++device->resets;
    } else {
      if (!in_callback() || device->open)
        return unheard("calibration is updated in the servo loop, outside of a frame");
      if (device->calibration == calibration_needs_manual_input) return;
      ++device->updates;
    }
    device->calibration = calibration_ok;
    device->misplaced.setZero();
  }

  void set_scheduler_rate(unsigned long rate) noexcept {
    const Lock lock(mutex_);
    if (started_) return broken("a new rate while the scheduler runs", invalid_operation, current_);
    if (rate != 500 && rate != 1000) return push(invalid_value, current_);
    rate_ = static_cast<int>(rate);
  }
  unsigned long schedule_asynchronous(Callback callback, void* data, unsigned short priority) noexcept {
    const Lock lock(mutex_);
    note("schedule ");
    int used = 0;
    Slot* free = nullptr;
    for (Slot& slot : slots_) slot.callback ? static_cast<void>(++used) : static_cast<void>(free = &slot);
    if (used >= slots_allowed || !free) return push(scheduler_full, invalid_handle), invalid_handle;
    *free = {callback, data, priority, ++last_schedule_};
    return free->id;
  }
  void unschedule(unsigned long id) noexcept {
    const Lock lock(mutex_);
    note("unschedule ");
    for (Slot& slot : slots_)
      if (slot.callback && slot.id == id) {
        slot = {};
        return;
      }
    broken("unscheduling what is not scheduled", invalid_operation, current_);
  }
  void schedule_synchronous(Callback callback, void* data, unsigned short priority) noexcept {
    std::unique_lock<std::mutex> lock(mutex_);
    if (!started_ || in_callback())
      return broken("a synchronous callback without a servo thread to wait for", invalid_operation, current_);
    synchronous_ = {callback, data, priority, ++last_schedule_};
    if (time_kind_ == Time::lock_step) {
      lock.unlock();
      return tick();
    }
    served_.wait(lock, [this] { return !synchronous_.callback; });
  }
  void start_scheduler() noexcept {
    const Lock lock(mutex_);
    note("start_scheduler ");
    if (started_.exchange(true)) return broken("the scheduler runs already", invalid_operation, current_);
    ++starts;
    bool any = false;
    for (const Slot& slot : slots_) any |= slot.callback != nullptr;
    if (!any) broken("the scheduler was started before its callbacks existed", invalid_operation, current_);
    if (time_kind_ == Time::lock_step) return;
    thread_ = std::thread([this] {
      auto deadline = std::chrono::steady_clock::now();
      while (started_) {
        tick();
        std::this_thread::sleep_until(deadline += std::chrono::microseconds(1'000'000 / rate_));
      }
    });
  }
  void stop_scheduler() noexcept {
    {
      const Lock lock(mutex_);
      note("stop_scheduler ");
      if (!started_.exchange(false) || in_callback())
        return broken("the scheduler does not run, or is stopped by itself", invalid_operation, current_);
    }
    if (thread_.joinable()) thread_.join();
  }

 private:
  using Lock = std::lock_guard<std::mutex>;
  static constexpr int most_slots = 8;

  /// What an arm calls, with an orientation or without.
  template <class Plain, class Turned>
  struct Both {
    const Plain& plain;
    const Turned& turned;
    Eigen::Vector3d operator()(const DeviceState& state) noexcept { return plain(state); }
    Wrench operator()(const OrientedState& state) noexcept { return turned(state); }
  };
  static Eigen::Vector3d torque_of(const Device& device) {
    return device.plugged && device.enabled ? Eigen::Vector3d(device.committed_torque * 1e-3)
                                            : Eigen::Vector3d(Eigen::Vector3d::Zero());
  }

  struct Slot {
    Callback callback = nullptr;
    void* data = nullptr;
    unsigned short priority = 0;
    unsigned long id = 0;
  };

  /// The devices move on one period under what the callbacks send: each is read before any callback, and its
  /// motors after all of them.
  void step(std::size_t i, bool with_callbacks) noexcept {
    if (i == devices_.size()) {
      if (with_callbacks && started_) call_all();
      return;
    }
    Device& device = *devices_[i];
    const auto ask = [&](const DeviceState& state) noexcept -> Eigen::Vector3d {
      {
        const Lock lock(mutex_);
        device.position = state.position * 1e3 + middle;
        device.velocity = state.velocity * 1e3;
      }
      step(i + 1, with_callbacks);
      const Lock lock(mutex_);
      return device.motors();
    };
    const auto turned = [&](const OrientedState& state) noexcept -> Wrench {
      {
        const Lock lock(mutex_);
        device.orientation = state.orientation;
      }
      const Eigen::Vector3d force = ask(state);
      const Lock lock(mutex_);
      return {force, torque_of(device)};
    };
    Both<decltype(ask), decltype(turned)> servo{ask, turned};
    for (int k = 0; k < 1000 / rate_; ++k) device.arm.step(servo), with_callbacks = false;
  }

  void call_all() noexcept {
    std::array<Slot, most_slots + 1> order;
    std::size_t count = 0;
    bool synchronous = false;
    {
      const Lock lock(mutex_);
      for (const Slot& slot : slots_)
        if (slot.callback) order[count++] = slot;
      if (synchronous_.callback) synchronous = true, order[count++] = synchronous_;
    }
    // By priority, the older first among equals.
    for (std::size_t a = 1; a < count; ++a)
      for (std::size_t b = a;
           b > 0 && (order[b].priority > order[b - 1].priority ||
                     (order[b].priority == order[b - 1].priority && order[b].id < order[b - 1].id));
           --b)
        std::swap(order[b], order[b - 1]);
    for (std::size_t k = 0; k < count; ++k) {
      servo_thread_.store(std::this_thread::get_id());
      const unsigned answer = order[k].callback(order[k].data);
      servo_thread_.store(std::thread::id());
      const Lock lock(mutex_);
      for (auto& device : devices_)
        if (device->open) {
          device->open = false;
          broken("a frame left open", frame_error, device->handle);
        }
      if (answer == callback_continue) continue;
      for (Slot& slot : slots_)
        if (slot.id == order[k].id) slot = {};
    }
    if (!synchronous) return;
    const Lock lock(mutex_);
    synchronous_ = {};
    served_.notify_all();
  }

  /// What the device itself finds after a tick.
  void check(Device& device) noexcept {
    if (device.handle == invalid_handle || device.dead || !device.enabled) return;
    if (device.velocity.norm() > device.top_speed * 1e3) push(exceeded_max_velocity, device.handle);
  }

  bool in_callback() const noexcept { return servo_thread_.load() == std::this_thread::get_id(); }
  bool device_call(const char* what) noexcept {
    if (!started_ || in_callback()) return true;
    broken(what, invalid_operation, current_);
    return false;
  }
  Device* find(unsigned handle) noexcept {
    for (auto& device : devices_)
      if (handle != invalid_handle && device->handle == handle) return device.get();
    push(bad_handle, handle);
    return nullptr;
  }
  void push(unsigned code, unsigned handle) noexcept {
    if (errors_ == stack_.size()) {
      std::move(stack_.begin() + 1, stack_.end(), stack_.begin());
      --errors_;
    }
    stack_[errors_++] = {code, 0, handle};
  }
  void broken(const char* rule, unsigned code, unsigned handle) noexcept {
    ++violations_;
    last_violation_ = rule;
    push(code, handle);
  }
  /// What breaks a rule and is no error to the vendor's functions, which do nothing then.
  void unheard(const char* rule) noexcept {
    ++violations_;
    last_violation_ = rule;
  }
  static bool calibrates_itself(const Device& device) noexcept {
    return (device.styles & (calibration_auto | calibration_inkwell)) != 0;
  }
  /// The lifecycle's calls come from outside a tick, but for switching forces off.
  void note(const char* call) noexcept {
    if (!in_callback() || std::strcmp(call, "disable_force ") != 0) history += call;
  }

  static inline HdWorld* here_ = nullptr;

  const Time time_kind_;
  std::mutex mutex_;
  std::condition_variable served_;
  std::vector<std::unique_ptr<Device>> devices_;
  std::array<Error, 64> stack_{};
  std::size_t errors_ = 0;
  std::array<Slot, most_slots> slots_{};
  Slot synchronous_{};
  unsigned current_ = invalid_handle, last_handle_ = 40;
  unsigned long last_schedule_ = 0;
  std::atomic<int> rate_{1000}, violations_{0};
  const char* last_violation_ = "";
  std::atomic<bool> started_{false};
  std::atomic<std::thread::id> servo_thread_{};
  std::chrono::nanoseconds now_{0};
  std::thread thread_;
};

}  // namespace hapbeam::testing
