// What drawings are made of: text that stays legible, dashes, a spring.
#pragma once

#include <imgui.h>
#include <string>

namespace phantom {

/// Text with a rim of paper, so that nothing that it crosses makes it illegible, and all is seen behind it.
void label(ImDrawList& list, ImVec2 at, ImU32 colour, const std::string& line);
/// @param dash  [pixel] as long as the gaps
void dashed(ImDrawList& list, const ImVec2& a, const ImVec2& b, ImU32 colour, float dash);
/// @param unit  [pixel] height of a line of text
void spring(ImDrawList& list, const ImVec2& a, const ImVec2& b, ImU32 colour, float unit);
/// Of the size that arrows of a force have [N].   @return [pixel]
float arrow_length(double force, float unit);
void arrow(ImDrawList& list, const ImVec2& from, const ImVec2& to, ImU32 colour, float unit);
/// The arm's tip and where the hand wants it, as marks in the picture.
void cross(ImDrawList& list, const ImVec2& at, float unit);
/// To the left of the second hand and below it, where the beam is not.   @param radius  [pixel] of its avatar
void name_second(ImDrawList& list, const ImVec2& avatar, float radius, float unit);
/// Of a drawing in which nothing is bent yet, which has no scale.
constexpr double least_strain = 1e-6;
/// A bar of colours with its ends, once there is a strain.   @param right, bottom  [pixel] where it stands   @param largest  strain of its last colour
void strain_bar(ImDrawList& list, float right, float bottom, double largest, float unit);

/// A row of the column on the right: its title, and the list that ImGui::EndCombo() ends where this is true.
bool begin_choice(const char* title, const char* id, const char* chosen);

/// The next of 1, 2, 5, 10, … that is not less.
double rounded_up(double x);
std::string text(const char* format, double value);
std::string metres(double length);

}  // namespace phantom
