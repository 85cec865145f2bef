// What drawings are made of: text that stays legible, dashes, a spring.
#pragma once

#include <imgui.h>
#include <string>

namespace phantom {

/// Text on a patch of paper, so that nothing that it crosses makes it illegible.
void label(ImDrawList& list, ImVec2 at, ImU32 colour, const std::string& line);
/// @param dash  [pixel] as long as the gaps
void dashed(ImDrawList& list, const ImVec2& a, const ImVec2& b, ImU32 colour, float dash);
/// @param unit  [pixel] height of a line of text
void spring(ImDrawList& list, const ImVec2& a, const ImVec2& b, ImU32 colour, float unit);

}  // namespace phantom
