#include "run_window.hpp"

#include <GLFW/glfw3.h>
#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdio>
#include <exception>
#include <imgui.h>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "../ending.hpp"
#include "../recording.hpp"
#include "../report.hpp"
#include "../scene_file.hpp"
#include "../scenes.hpp"
#include "../sound_file.hpp"
#include "colours.hpp"
#include "controls.hpp"
#include "panels.hpp"
#include "running.hpp"
#include "strokes.hpp"
#include "training.hpp"

namespace phantom {

namespace {

/// [s] simulated from one picture to the next; a tour ends each change before it begins the next.
double picture_time(const Options& options) {
  return options.tour > 0 ? Relay::approach + Relay::handover + 0.05 : 0.05;
}

/// Where the i-th screenshot goes.
std::string frame(const Options& options, int i) {
  if (options.frames == 1) return options.screenshot;
  char number[16];
  std::snprintf(number, sizeof number, "_%03d", i);
  std::string file = options.screenshot;
  const std::size_t dot = file.rfind('.');
  return file.insert(dot == std::string::npos ? file.size() : dot, number);
}

constexpr ImGuiWindowFlags fixed = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                                   ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse |
                                   ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoBringToFrontOnFocus;

class Window {
 public:
  Window(Display& display, const Options& options, std::shared_ptr<const Trained> trained)
      : display_(display), first_(options), file_(std::move(trained)) {
    if (!options.record.empty()) recording_.emplace(options.record);
    if (!options.sound.empty()) sound_.emplace(options.sound);
    running_ = std::make_unique<Running>(options, file_);
    if (!simulated()) running_->start();
  }

  /// On to the time of the next picture.
  void go_on() {
    if (simulated()) running_->session().run(picture_time(first_));
    take_trained();
    update();
  }

  /// @return false where the window is to be closed
  bool draw() {
    if (!display_.begin_picture()) return false;
    go_on();
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    const float unit = ImGui::GetFontSize(), gap = 0.5f * unit, column = 20 * unit;
    const float below = std::max(0.34f * size.y, 11 * unit);
    ImGui::SetNextWindowPos({0, 0});
    ImGui::SetNextWindowSize(size);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {gap, gap});
    ImGui::Begin("phantom", nullptr, fixed);
    draw_scene({gap, gap}, {size.x - column - gap, size.y - below - gap}, unit);
    draw_panels(*ImGui::GetWindowDrawList(),
                {running_->history(), running_->curves(), running_->curve_place(), running_->curve_step(),
                 running_->curve_depth(), pressed(running_->options())},
                {gap, size.y - below}, {size.x - gap, size.y - gap});
    ImGui::SetCursorPos({size.x - column, gap});
    ImGui::BeginChild("controls", {column - gap, size.y - below - 2 * gap});
    const Wish wish = draw_controls(*running_, is_named_scene(first_) ? nullptr : &first_, note());
    ImGui::EndChild();
    ImGui::End();
    ImGui::PopStyleVar();
    if (wish.change) change(wish.options);
    if (wish.play) running_->play();
    if (wish.save) save();
    return true;
  }

  /// The next scene, model and coupling of a tour, in a window of another size now and then.
  void tour(int step) {
    constexpr const char* scenes[] = {"thesis", "ruler", "needle",   "strip", "string",
                                      "arch",   "probe", "catheter", "knot"};
    constexpr ElementChoice elements[] = {ElementChoice::linear, ElementChoice::corotational,
                                          ElementChoice::stability_functions, ElementChoice::reduced,
                                          ElementChoice::full};
    Options options = first_;
    // Two changes under the hand that presses, then another scene.
    set_scene(options, scenes[step / 3 % 8]);
    settle(options, 0, options.beam.length);
    if (!options.beam.in_space()) options.element = elements[step % 5];
    else if (step % 2 == 1 && options.avatar == Avatar::ball) options.element = ElementChoice::twisted_rod;
    options.elements = 4 << step / 25 % 3;
    // What is stiffer than the device can render throws the hand about without a coupling.
    const bool soft = options.scene == "strip" || options.scene == "string";
    options.coupling = soft && step % 4 == 1 ? CouplingChoice::direct : CouplingChoice::virtual_coupling;
    change(options);
    if (step % 3 == 1) running_->pull({0.01, -0.02, 0});
    if (step % 10 == 0) display_.resize(400 + 20 * (step / 10 % 10), 300 + 15 * (step / 10 % 7));
  }

  /// @return the exit status
  int close(ReportFile& report, bool cut_short, const hapbeam::TickTimes& pictures) {
    running_->session().stop();
    update();
    const int status =
        finish(running_->session(), recording_ ? &*recording_ : nullptr, sound_ ? &*sound_ : nullptr,
               running_->lost(), report, cut_short, pictures.period().summary());
    return std::max(status, status_);
  }

  /// A screenshot shows what happens at its time, however busy the machine: then time is simulated.
  bool simulated() const { return first_.lock_step || !first_.screenshot.empty(); }

 private:
  void update() {
    if (sound_) sound_->take(running_->session().body());
    running_->update([this](const Tick& tick) {
      if (recording_) recording_->write(tick);
    });
  }

  static Pressed pressed(const Options& options) {
    if (options.element == ElementChoice::with_mass) return Pressed::with_mass;
    return options.beams > 1 || holds_end(options.avatar) ? Pressed::way : Pressed::beam;
  }

  void draw_scene(const ImVec2& low, const ImVec2& high, float unit) {
    ImGui::SetCursorPos(low);
    ImGui::InvisibleButton("scene", {high.x - low.x, high.y - low.y});
    Drawing& drawing = running_->drawing();
    const bool hovered = ImGui::IsItemHovered(), in_space = running_->options().beam.in_space();
    drawing.look(hovered);
    if (ImGui::IsItemActive()) {
      if (!held_) wanted_ = running_->target();
      wanted_ = running_->pull(drawing.device_position(ImGui::GetIO().MousePos, wanted_));
      held_ = true;
    } else if (held_) {
      // In space the hand stays: it has to be led around the rod.
      if (!in_space) running_->lift();
      held_ = false;
    }
    keys(in_space && hovered && !ImGui::GetIO().KeyCtrl ? static_cast<double>(ImGui::GetIO().MouseWheel) : 0);
    drawing.draw(*ImGui::GetWindowDrawList(), running_->session().picture(), running_->target(), low, high,
                 unit);
    if (!running_->pulled() && running_->session().device().simulated()) hint(low, high, drawing.hint());
  }

  /// Until it has been done.
  static void hint(const ImVec2& low, const ImVec2& high, const char* text) {
    const ImVec2 size = ImGui::CalcTextSize(text);
    label(*ImGui::GetWindowDrawList(), {(low.x + high.x - size.x) / 2, low.y + 0.5f * size.y}, colour::faint,
          text);
  }

  /// A tenth of a metre in a second; the wheel's notches are of 4 mm.
  void keys(double notches) {
    const double step = 0.1 * static_cast<double>(ImGui::GetIO().DeltaTime);
    const auto pressed = [this](int more, int less) {
      return display_.pressed(more) - display_.pressed(less);
    };
    const Eigen::Vector3d way = running_->drawing().device_way(
        {pressed(GLFW_KEY_RIGHT, GLFW_KEY_LEFT) * step, pressed(GLFW_KEY_UP, GLFW_KEY_DOWN) * step,
         pressed(GLFW_KEY_PAGE_DOWN, GLFW_KEY_PAGE_UP) * step - 0.004 * notches});
    if (!way.isZero(0)) {
      if (!led_ && !held_) wanted_ = running_->target();
      led_ = true;
      wanted_ = running_->pull(wanted_ + way);
    } else if (led_ && (held_ || !running_->pulled())) {
      led_ = false;
    }
    if (display_.pressed(GLFW_KEY_SPACE)) running_->lift(), led_ = false;
  }

  /// Where it cannot be, all goes on as it was and the note says why.
  void change(const Options& options) {
    try {
      note_.clear();
      training_.reset();
      if (options.device != running_->asked().device) change_device(options);
      else if (options.model_choice == ModelChoice::finite_elements || !options.model.empty())
        running_->change(options, file_);
      else if (const auto& trained = running_->asked_trained(); known(options))
        running_->change(options, trained);
      else training_.emplace(options);
    } catch (const std::exception& error) {
      note_ = error.what();
    }
  }
  /// The model that is wanted is the one there is, of the same beam.
  bool known(const Options& options) const {
    const Options& now = running_->asked();
    return now.model_choice == options.model_choice && same_scene(now, options);
  }
  void save() {
    try {
      note_ = "Saved as " + save_scene(running_->asked()) + ", for --scene.";
    } catch (const std::exception& error) {
      note_ = error.what();
    }
  }
  void take_trained() {
    if (!training_ || !training_->ended()) return;
    try {
      running_->change(training_->options(), training_->result());
    } catch (const std::exception& error) {
      note_ = error.what();
    }
    training_.reset();
  }
  /// The next one is connected while this one runs.
  void change_device(const Options& options) {
    auto next = std::make_unique<Running>(options, running_->asked_trained());
    running_->session().stop();
    update();
    // The next one's clock begins anew.
    if (recording_) {
      if (!recording_->close(running_->lost())) status_ = 1;
      recording_.reset(), note_ = "The recording has ended with the device.";
    }
    running_ = std::move(next);
    running_->start();
  }

  std::string note() const {
    if (training_) {
      char text[60];
      std::snprintf(text, sizeof text, "Training: %.0f %% of the presses.", 100 * training_->done());
      return text;
    }
    const Device& device = running_->session().device();
    const hapbeam::DeviceCounts counts = device.counts();
    if (!note_.empty() || simulated() || device.priority() == hapbeam::RealTime::done ||
        100 * counts.missed_ticks < counts.ticks)
      return note_;
    return std::string("Many ticks are missed: ") + message(device.priority()) + ".";
  }

  Display& display_;
  const Options first_;
  const std::shared_ptr<const Trained> file_;
  std::optional<Recording> recording_;
  std::optional<SoundFile> sound_;
  std::unique_ptr<Running> running_;
  std::optional<Training> training_;
  std::string note_;
  int status_ = 0;  // 1: a recording could not be written
  Eigen::Vector3d wanted_{0, 0, 0};
  bool held_ = false;  // by the mouse
  bool led_ = false;   // by the arrow keys
};

}  // namespace

int run_window(Display& display, const Options& options, std::shared_ptr<const Trained> trained,
               ReportFile& report) {
  Window window(display, options, std::move(trained));
  const auto begin = std::chrono::steady_clock::now();
  hapbeam::TickTimes times(1.0 / 60);
  Ending ending([&](bool cut_short) { return window.close(report, cut_short, times); });
  int taken = 0;
  for (int pictures = 0; !interrupted(); ++pictures) {
    std::chrono::duration<double> passed = std::chrono::steady_clock::now() - begin;
    if (window.simulated()) passed = std::chrono::duration<double>(picture_time(options) * pictures);
    if (options.timed && passed.count() >= options.duration) break;
    if (options.tour > 0 && pictures >= options.tour) break;
    if (options.tour > 0) window.tour(pictures);
    // Who asks for one screenshot does not see the pictures before it; what is laid out anew settles in three, and what swings shows where it was.
    const bool single = !options.screenshot.empty() && options.frames == 1;
    const double before = options.element == ElementChoice::with_mass ? 17.5 : 3.5;
    if (single && passed.count() < options.at - before * picture_time(options)) {
      window.go_on();
      continue;
    }
    times.begin();
    if (!window.draw()) break;
    const bool now = !options.screenshot.empty() && taken < options.frames && passed.count() >= options.at;
    const std::string file = now ? frame(options, taken) : "";
    if (!display.end_picture(window.simulated(), file))
      throw std::runtime_error(file + ": the screenshot cannot be written");
    taken += now;
    if (now && taken == options.frames && !options.timed) break;
  }
  return ending.run(interrupted());
}

}  // namespace phantom
