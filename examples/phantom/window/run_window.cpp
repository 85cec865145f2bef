#include "run_window.hpp"

#include <GLFW/glfw3.h>
#include <chrono>
#include <cstdio>
#include <exception>
#include <imgui.h>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>

#include "../recording.hpp"
#include "../scenes.hpp"
#include "controls.hpp"
#include "panels.hpp"
#include "running.hpp"

namespace phantom {

namespace {

constexpr double picture_time = 0.05;  // [s] simulated from one picture to the next

constexpr ImGuiWindowFlags fixed = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize |
                                   ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoCollapse |
                                   ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoBringToFrontOnFocus;

class Window {
 public:
  Window(Display& display, const Options& options, const Trained* trained)
      : display_(display), first_(options), trained_(trained) {
    if (!options.record.empty()) recording_.emplace(options.record);
    running_ = std::make_unique<Running>(options, trained);
    begin();
  }

  /// @return false where the window is to be closed
  bool draw() {
    if (!display_.begin_picture()) return false;
    if (simulated()) running_->session().run(picture_time);
    running_->update([this](const Tick& tick) {
      if (recording_) recording_->write(tick);
    });
    const ImVec2 size = ImGui::GetIO().DisplaySize;
    const float unit = ImGui::GetFontSize(), gap = 0.5f * unit, column = 20 * unit;
    const float below = std::max(0.34f * size.y, 11 * unit);
    ImGui::SetNextWindowPos({0, 0});
    ImGui::SetNextWindowSize(size);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {gap, gap});
    ImGui::Begin("phantom", nullptr, fixed);
    draw_scene({gap, gap}, {size.x - column - gap, size.y - below - gap}, unit);
    draw_panels(
        *ImGui::GetWindowDrawList(),
        {running_->history(), running_->curves(), "", running_->curve_place(), running_->curve_depth()},
        {gap, size.y - below}, {size.x - gap, size.y - gap});
    ImGui::SetCursorPos({size.x - column, gap});
    ImGui::BeginChild("controls", {column - gap, size.y - below - 2 * gap});
    const Wish wish = draw_controls(*running_, trained_ ? &first_ : nullptr, note_);
    ImGui::EndChild();
    ImGui::End();
    ImGui::PopStyleVar();
    if (wish.switches) switch_to(wish.options, wish.trained ? trained_ : nullptr);
    return true;
  }

  /// The next scene, model and coupling of a tour, in a window of another size now and then.
  void tour(int step) {
    constexpr const char* scenes[] = {"thesis", "ruler", "strip", "string", "arch"};
    constexpr ElementChoice elements[] = {ElementChoice::linear, ElementChoice::corotational,
                                          ElementChoice::assumed_strain, ElementChoice::reduced,
                                          ElementChoice::full};
    Options options = first_;
    set_scene(options, scenes[step % 5]);
    settle(options, 0, options.beam.length);
    options.element = elements[step / 5 % 5];
    options.elements = 4 << step / 25 % 3;
    options.coupling = step % 2 ? CouplingChoice::direct : CouplingChoice::virtual_coupling;
    switch_to(options, nullptr);
    if (step % 3 == 0) running_->pull({0.01, -0.02});
    if (step % 10 == 0) display_.resize(800 + 50 * (step / 10 % 10), 500 + 30 * (step / 10 % 7));
  }

  void close() {
    running_->session().stop();
    running_->update([this](const Tick& tick) {
      if (recording_) recording_->write(tick);
    });
    if (recording_) recording_->close();
  }

 private:
  void draw_scene(const ImVec2& low, const ImVec2& high, float unit) {
    ImGui::SetCursorPos(low);
    ImGui::InvisibleButton("scene", {high.x - low.x, high.y - low.y});
    SceneDrawing& drawing = running_->drawing();
    if (ImGui::IsItemActive()) running_->pull(drawing.device_position(ImGui::GetIO().MousePos)), held_ = true;
    else if (held_) running_->lift(), held_ = false;
    arrows();
    drawing.draw(*ImGui::GetWindowDrawList(), running_->session().picture(), running_->target(), low, high,
                 unit);
  }

  /// A tenth of a metre in a second.
  void arrows() {
    const double step = 0.1 * static_cast<double>(ImGui::GetIO().DeltaTime);
    const Point way((display_.pressed(GLFW_KEY_RIGHT) - display_.pressed(GLFW_KEY_LEFT)) * step,
                    (display_.pressed(GLFW_KEY_UP) - display_.pressed(GLFW_KEY_DOWN)) * step);
    if (way.x() != 0 || way.y() != 0) {
      if (!led_) wanted_ = running_->target(), led_ = true;
      running_->pull(wanted_ += way);
    } else if (led_ && (held_ || !running_->pulled())) {
      led_ = false;
    }
    if (display_.pressed(GLFW_KEY_SPACE)) running_->lift(), led_ = false;
  }

  /// The next one is built while this one runs; where it cannot be, this one goes on.
  void switch_to(const Options& options, const Trained* trained) {
    try {
      auto next = std::make_unique<Running>(options, trained);
      close_recording();
      running_->session().stop();
      running_ = std::move(next);
      begin();
      led_ = held_ = false;
    } catch (const std::exception& error) {
      note_ = error.what();
    }
  }
  /// A screenshot shows what happens at its time, however busy the machine: then time is simulated.
  bool simulated() const { return !first_.screenshot.empty(); }
  void begin() {
    if (!simulated()) running_->start();
  }
  void close_recording() {
    if (!recording_) return;
    close();
    recording_.reset();
    note_ = "The recording has ended with the switch.";
  }

  Display& display_;
  const Options first_;
  const Trained* trained_;
  std::optional<Recording> recording_;
  std::unique_ptr<Running> running_;
  std::string note_;
  Point wanted_{0, 0};
  bool held_ = false;  // by the mouse
  bool led_ = false;   // by the arrow keys
};

}  // namespace

void run_window(Display& display, const Options& options, const Trained* trained,
                const volatile std::sig_atomic_t& interrupted) {
  Window window(display, options, trained);
  const auto begin = std::chrono::steady_clock::now();
  bool pictured = false;
  for (int pictures = 0; !interrupted; ++pictures) {
    std::chrono::duration<double> passed = std::chrono::steady_clock::now() - begin;
    if (!options.screenshot.empty()) passed = std::chrono::duration<double>(picture_time * pictures);
    if (options.timed && passed.count() >= options.duration) break;
    if (options.tour > 0 && pictures >= options.tour) break;
    if (options.tour > 0) window.tour(pictures);
    if (!window.draw()) break;
    const bool now = !pictured && !options.screenshot.empty() && passed.count() >= options.at;
    if (!display.end_picture(now ? options.screenshot : ""))
      throw std::runtime_error(options.screenshot + ": the screenshot cannot be written");
    pictured = pictured || now;
    if (now && !options.timed) break;
  }
  window.close();
}

}  // namespace phantom
