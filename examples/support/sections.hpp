// The sections of a beam's or a rod's options, wherever it is cut.
#pragma once

#include <type_traits>
#include <vector>

#include "beam_options.hpp"

namespace cli {

/// [m]
struct Cut {
  double width, height;
};

/// @param part  of the options   @param from [m] where it begins
inline Cut cut_in(const SectionPart& part, double from, double s) {
  const double t = (s - from) / (part.end - from);
  return {part.width + t * (part.end_width - part.width), part.height + t * (part.end_height - part.height)};
}

/// @param s [m] from the left end
inline Cut cut_at(const BeamOptions& o, double s) {
  double from = 0;
  for (const SectionPart& part : o.parts) {
    if (s <= part.end) return cut_in(part, from, s);
    from = part.end;
  }
  return {o.width, o.height};
}

/// @tparam Section  hapbeam::Section | hapbeam::RodSection
template <class Section>
Section section_of(const BeamOptions& o, const Cut& cut) {
  if (o.round) return Section::circle(cut.height);
  // The first axis of a rod's section points up, where it leaves its left end.
  if constexpr (std::is_same_v<Section, hapbeam::RodSection>)
    return Section::rectangle(cut.height, cut.width);
  else return Section::rectangle(cut.width, cut.height);
}

/// @tparam Part  hapbeam::BeamPart | hapbeam::RodPart
template <class Part, class Section>
std::vector<Part> parts_of(const BeamOptions& o) {
  std::vector<Part> parts;
  double from = 0;
  for (const SectionPart& part : o.parts) {
    parts.emplace_back(part.end,
                       [o, part, from](double s) { return section_of<Section>(o, cut_in(part, from, s)); });
    from = part.end;
  }
  return parts;
}

}  // namespace cli
