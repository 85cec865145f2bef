#include "controls.hpp"

#include <cstdio>
#include <imgui.h>
#include <limits>

#include "../scenes.hpp"

namespace phantom {

namespace {

constexpr const char* scene_labels[] = {"thesis", "ruler", "strip", "string", "arch"};
constexpr ElementChoice elements[] = {ElementChoice::linear, ElementChoice::full, ElementChoice::reduced,
                                      ElementChoice::assumed_strain, ElementChoice::corotational};
constexpr const char* element_labels[] = {"linear", "von Karman, full", "von Karman, reduced",
                                          "von Karman, assumed strain", "corotational"};

void caption(const char* text) {
  ImGui::PushTextWrapPos(0);
  ImGui::TextDisabled("%s", text);
  ImGui::PopTextWrapPos();
}

bool begin_choice(const char* title, const char* id, const char* chosen) {
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(title);
  ImGui::SameLine(5.2f * ImGui::GetFontSize());
  ImGui::SetNextItemWidth(-1);
  return ImGui::BeginCombo(id, chosen);
}

void choose_scene(const Running& running, Wish& wish) {
  const std::string now = running.options().scene.empty() ? "your own" : running.options().scene;
  if (!begin_choice("scene", "##scene", now.c_str())) return;
  for (const char* label : scene_labels)
    if (ImGui::Selectable(label, now == label)) {
      Options& o = wish.options;
      set_scene(o, label);
      settle(o, 0, o.beam.length);
      wish.switches = true, wish.trained = false;
    }
  ImGui::EndCombo();
}

void choose_model(const Running& running, const Options* file, Wish& wish) {
  const char* now = running.trained() ? running.trained()->kind
                                      : element_labels[static_cast<int>(running.options().element)];
  if (begin_choice("model", "##model", now)) {
    for (int i = 0; i < 5 && (!running.trained() || running.options().guarded || file == nullptr); ++i)
      if (ImGui::Selectable(element_labels[i],
                            !running.trained() && running.options().element == elements[i]))
        wish.options.element = elements[i], wish.switches = true, wish.trained = false;
    if (file && ImGui::Selectable("trained (--model)", running.trained() != nullptr))
      wish.options = *file, wish.switches = wish.trained = true;
    ImGui::EndCombo();
  }
  if (running.trained()) return;
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted("elements");
  ImGui::SameLine(5.2f * ImGui::GetFontSize());
  constexpr int counts[] = {4, 8, 16, 64};
  for (const int count : counts) {
    char label[8];
    std::snprintf(label, sizeof label, "%d", count);
    if (ImGui::RadioButton(label, running.options().elements == count))
      wish.options.elements = count, wish.switches = true;
    if (count != 64) ImGui::SameLine(0, 0.35f * ImGui::GetFontSize());
  }
}

void choose_coupling(const Running& running, Wish& wish) {
  const Options& o = running.options();
  char now[60];
  if (o.coupling == CouplingChoice::direct) std::snprintf(now, sizeof now, "direct");
  else std::snprintf(now, sizeof now, "virtual, %.3g N/mm", o.stiffness / 1e3);
  if (!begin_choice("coupling", "##coupling", now)) return;
  if (ImGui::Selectable("virtual: what the device can render", o.coupling != CouplingChoice::direct)) {
    wish.options.coupling = CouplingChoice::virtual_coupling, wish.switches = true;
    wish.options.stiffness = wish.options.damping = std::numeric_limits<double>::quiet_NaN();
  }
  if (ImGui::Selectable("direct: the hand presses the beam itself", o.coupling == CouplingChoice::direct))
    wish.options.coupling = CouplingChoice::direct, wish.switches = true;
  ImGui::EndCombo();
}

void choose_exaggeration(SceneDrawing& drawing) {
  char now[40];
  std::snprintf(now, sizeof now, "%g times", drawing.exaggeration);
  if (!begin_choice("drawn", "##exaggeration", now)) return;
  for (const double x : {1.0, 2.0, 5.0, 10.0, 20.0, 50.0}) {
    std::snprintf(now, sizeof now, x == 1 ? "true to scale" : "displacements %g times", x);
    if (ImGui::Selectable(now, drawing.exaggeration == x)) drawing.exaggeration = x;
  }
  ImGui::EndCombo();
}

void show_state(Running& running) {
  const hapbeam::ServoRecord& r = running.session().picture().record;
  const hapbeam::TickTimes& times = running.session().times();
  ImGui::PushFont(ImGui::GetIO().Fonts->Fonts[1]);
  ImGui::Text("%.2f N", r.force.norm());
  ImGui::PopFont();
  ImGui::PushTextWrapPos(0);
  ImGui::TextUnformatted(in_words(r));
  // As high with one line as with two, so that what is below stays.
  const float line = ImGui::GetTextLineHeightWithSpacing();
  if (ImGui::CalcTextSize(in_words(r), nullptr, false, ImGui::GetContentRegionAvail().x).y < 1.5f * line)
    ImGui::Dummy({0, line - ImGui::GetStyle().ItemSpacing.y});
  ImGui::Separator();
  ImGui::Text("energy generated: %.2g J%s", r.energy_generated, r.energy_generated > 0 ? "" : " (passive)");
  ImGui::Text("force cut: %llu ticks   motors: %.0f %%", static_cast<unsigned long long>(r.saturated_ticks),
              100 * r.heat);
  ImGui::Text("tick p99: %.1f us   missed: %llu", times.compute().quantile(0.99) * 1e6,
              static_cast<unsigned long long>(running.session().counts().missed_ticks));
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

Wish draw_controls(Running& running, const Options* file, const std::string& note) {
  Wish wish{false, running.options(), running.trained() != nullptr};
  show_state(running);
  ImGui::Separator();
  choose_scene(running, wish);
  choose_model(running, file, wish);
  choose_coupling(running, wish);
  choose_exaggeration(running.drawing());
  ImGui::Spacing();
  if (ImGui::Button("play the script", {-1, 0})) wish.switches = true;
  caption(running.pulled()
              ? "Press the mouse in the drawing and pull; arrow keys move the hand, space lifts it."
              : "A script leads the hand. Press the mouse in the drawing, and pull: the hand is yours.");
  if (*feels(running.options().scene)) {
    ImGui::Separator();
    ImGui::PushTextWrapPos(0);
    ImGui::Text("To feel: %s.", feels(running.options().scene));
    ImGui::PopTextWrapPos();
  }
  if (!note.empty()) {
    ImGui::Separator();
    ImGui::PushTextWrapPos(0);
    ImGui::TextUnformatted(note.c_str());
    ImGui::PopTextWrapPos();
  }
  return wish;
}

}  // namespace phantom
