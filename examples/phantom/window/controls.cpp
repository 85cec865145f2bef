#include "controls.hpp"

#include <cmath>
#include <cstdio>
#include <imgui.h>
#include <limits>
#include <string>

#include "../scenes.hpp"
#include "strokes.hpp"

namespace phantom {

namespace {

constexpr const char* scene_labels[] = {"thesis", "ruler", "strip",       "string", "arch",     "comb",
                                        "needle", "hook",  "fishing-rod", "probe",  "catheter", "knot"};
constexpr const char* element_labels[] = {
    "linear",  "von Karman, full",    "von Karman, reduced", "von Karman", "corotational",
    "tapered", "round rod, no twist", "twisted rod",         "with mass"};

void caption(const char* text) {
  ImGui::PushTextWrapPos(0);
  ImGui::TextUnformatted(text);
  ImGui::PopTextWrapPos();
}

/// As high as the choice of elements, which it takes the place of.
void trained_range(const Trained& trained) {
  ImGui::AlignTextToFramePadding();
  ImGui::Text("%d modes, to %.3g mm, error %.0e", trained.modes, trained.depth * 1e3,
              trained.errors.force_bound);
}

/// A beam that is no scene's has the name of its file, or none.
const char* name_of(const Options& options) {
  if (!options.scene.empty()) return options.scene.c_str();
  return options.model.empty() ? "your own" : options.model.c_str();
}

void choose_scene(Running& running, const Options* own, Wish& wish) {
  const Options& felt = running.options();
  if (!begin_choice("scene", "##scene", name_of(felt))) return;
  Options& o = wish.options;
  for (const char* label : scene_labels)
    if (ImGui::Selectable(label, felt.scene == label)) {
      set_scene(o, label);
      o.model.clear(), o.guarded = false, o.model_choice = ModelChoice::finite_elements;
      settle(o, 0, o.beam.length);
      wish.change = true;
    }
  if (own && ImGui::Selectable(name_of(*own), name_of(felt) == std::string(name_of(*own))))
    o = *own, wish.change = true;
  ImGui::EndCombo();
}

void choose_elements(const Options& felt, Wish& wish) {
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted("elements");
  ImGui::SameLine(4.6f * ImGui::GetFontSize());
  constexpr int counts[] = {4, 8, 16, 64};
  for (const int count : counts) {
    char label[8];
    std::snprintf(label, sizeof label, "%d", count);
    if (ImGui::RadioButton(label, felt.elements == count)) wish.options.elements = count, wish.change = true;
    if (count != 64) ImGui::SameLine(0, 0.35f * ImGui::GetFontSize());
  }
}

void choose_model(Running& running, const Options* own, Wish& wish) {
  const Options& felt = running.options();
  const bool elements_answer = felt.model_choice == ModelChoice::finite_elements;
  const auto label_of = [&](ModelChoice choice) {
    if (!felt.model.empty()) return choice == ModelChoice::pod ? "POD, of the file" : "Galerkin, of the file";
    return choice == ModelChoice::pod ? "POD, trained here" : "Galerkin, trained here";
  };
  const char* now =
      elements_answer ? element_labels[static_cast<int>(felt.element)] : label_of(felt.model_choice);
  if (begin_choice("model", "##model", now)) {
    for (int i = 0; i < 9; ++i)
      if (bends_in_space(element_choices[i]) == felt.beam.in_space() &&
          ImGui::Selectable(element_labels[i], elements_answer && felt.element == element_choices[i])) {
        wish.options.element = element_choices[i], wish.options.model_choice = ModelChoice::finite_elements;
        wish.options.guarded = false;
        wish.change = true;
      }
    if (!felt.beam.in_space())
      for (const ModelChoice choice : {ModelChoice::pod, ModelChoice::galerkin}) {
        // A file holds one model, and not the beam's section, which training another would take.
        if (!felt.model.empty() && own->model_choice != choice) continue;
        if (ImGui::Selectable(label_of(choice), felt.model_choice == choice)) {
          if (!felt.model.empty()) wish.options.guarded = own->guarded;
          wish.options.model_choice = choice, wish.change = true;
        }
      }
    ImGui::EndCombo();
  }
  if (elements_answer) choose_elements(felt, wish);
  else trained_range(*running.session().body().trained());
}

void choose_coupling(Running& running, Wish& wish) {
  const Options& felt = running.options();
  const bool direct = felt.coupling == CouplingChoice::direct;
  char now[60];
  if (direct) std::snprintf(now, sizeof now, "direct");
  else std::snprintf(now, sizeof now, "virtual, %.3g N/mm", felt.stiffness / 1e3);
  if (!begin_choice("coupling", "##coupling", now)) return;
  if (ImGui::Selectable("virtual: what the device can render", !direct)) {
    wish.options.coupling = CouplingChoice::virtual_coupling, wish.change = true;
    wish.options.stiffness = wish.options.damping = std::numeric_limits<double>::quiet_NaN();
  }
  if (ImGui::Selectable("direct: the hand presses the beam itself", direct))
    wish.options.coupling = CouplingChoice::direct, wish.change = true;
  ImGui::EndCombo();
}

void choose_device(Running& running, Wish& wish) {
  const bool simulated = running.session().device().simulated();
  if (!begin_choice("device", "##device", simulated ? "virtual Phantom" : "Phantom")) return;
  if (ImGui::Selectable("virtual Phantom, led by the mouse", simulated))
    wish.options.device = DeviceChoice::simulated, wish.change = true;
  if (ImGui::Selectable("Phantom, its arm in its inkwell or reset position now", !simulated))
    wish.options.device = DeviceChoice::phantom, wish.change = true;
  ImGui::EndCombo();
}

/// Beside the force: how far it may be off.
void force_error(double relative) {
  if (std::isnan(relative)) return;
  ImGui::SameLine();
  if (relative < 1) ImGui::Text("± %.2g %%", 100 * relative);
  else ImGui::TextUnformatted("± 100 % or more");  // infinite where a finer mesh has no such shape
}

void show_state(Running& running) {
  const Session::Picture picture = running.session().picture();
  const hapbeam::ServoRecord& r = picture.record;
  const hapbeam::TickTimes& times = running.session().body().times();
  ImGui::PushFont(ImGui::GetIO().Fonts->Fonts[1]);
  ImGui::Text("%.2f N", r.force.norm());
  ImGui::PopFont();
  force_error(running.session().body().force_error());
  if (picture.second) {
    ImGui::SameLine();
    ImGui::TextUnformatted("on the first hand");
  }
  ImGui::PushTextWrapPos(0);
  const Device& device = running.session().device();
  const char* state =
      asks(device) ? in_words(r)
      : is_running(device.status())
          ? "The arm does not know where it is: put the stylus into its inkwell, or move it about."
          : name(device.status());
  ImGui::TextUnformatted(state);
  // As high with one line as with two, so that what is below stays.
  const float line = ImGui::GetTextLineHeightWithSpacing();
  if (ImGui::CalcTextSize(state, nullptr, false, ImGui::GetContentRegionAvail().x).y < 1.5f * line)
    ImGui::Dummy({0, line - ImGui::GetStyle().ItemSpacing.y});
  ImGui::Separator();
  // What one hand has received the other one may have given.
  if (picture.second)
    ImGui::Text("energy received: %.2g J, second %.2g J", r.energy_generated,
                picture.second->energy_generated);
  else
    // Less is round-off of a rod that is led through the air.
    ImGui::Text("energy generated: %.2g J%s", r.energy_generated > 1e-15 ? r.energy_generated : 0,
                r.energy_generated > 1e-15 ? "" : " (passive)");
  if (const double friction = running.options().friction; friction > 0) {
    if (r.pressing)
      ImGui::Text("friction: %s, %.2f N   took: %.3g mJ", r.sliding ? "slides" : "sticks", r.friction.norm(),
                  1e3 * r.dissipated);
    else ImGui::Text("friction: coefficient %.3g", friction);
  }
  ImGui::Text("force cut: %llu ticks   motors: %.0f %%", static_cast<unsigned long long>(r.saturated_ticks),
              100 * r.heat);
  ImGui::Text("tick p99: %.1f µs   missed: %llu", times.compute().quantile(0.99) * 1e6,
              static_cast<unsigned long long>(device.counts().missed_ticks));
  ImGui::PopTextWrapPos();
}

}  // namespace

const char* in_words(const hapbeam::ServoRecord& r) {
  using hapbeam::LoopStatus;
  if (r.model == hapbeam::Status::snapped) return "The beam has snapped through.";
  switch (r.status) {
    case LoopStatus::free: return "The hand touches nothing.";
    case LoopStatus::touching: return "Touching: this is what the beam does.";
    case LoopStatus::out_of_range: return "Beyond what the model knows: it answers for the nearest press.";
    case LoopStatus::engaging: return "The force is coming in.";
    case LoopStatus::limited: return "The device's limit is felt, not the beam.";
    case LoopStatus::continued: return "No answer in time: the last force goes on along its tangent.";
    case LoopStatus::no_answer: return "The model has no answer: the force is zero.";
    case LoopStatus::device: return "The device begins anew.";
  }
  return "";
}

Wish draw_controls(Running& running, const Options* own, const std::string& note) {
  Wish wish{false, running.asked()};
  show_state(running);
  ImGui::Separator();
  choose_scene(running, own, wish);
  choose_model(running, own, wish);
  choose_coupling(running, wish);
  choose_device(running, wish);
  running.drawing().choose();
  ImGui::Spacing();
  const float half = (ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ItemSpacing.x) / 2;
  if (ImGui::Button("play the script", {half, 0})) wish.play = true;
  ImGui::SameLine();
  if (ImGui::Button("save the scene", {half, 0})) wish.save = true;
  caption(!running.session().device().simulated() ? "The hand is yours, on the device."
          : running.pulled()                      ? running.drawing().help()
                             : "A script leads the hand, until you press the mouse in the drawing and pull.");
  if (running.options().model.empty()) ImGui::Separator();
  ImGui::PushTextWrapPos(0);
  if (const Options& felt = running.options(); !felt.feels.empty())
    ImGui::Text("To feel: %s.", felt.feels.c_str());
  else if (felt.model.empty()) ImGui::TextUnformatted(cli::describe(felt.beam).c_str());
  if (const double friction = running.options().friction; friction > 0)
    ImGui::Text("With friction it sticks until it is pulled aside by %.3g of what presses it.", friction);
  ImGui::PopTextWrapPos();
  if (!note.empty()) {
    ImGui::Separator();
    ImGui::PushTextWrapPos(0);
    ImGui::TextUnformatted(note.c_str());
    ImGui::PopTextWrapPos();
  }
  return wish;
}

}  // namespace phantom
