// Arrays to stroke, and the same beams touched one by one: no hierarchy, no pool, a model for each.
#pragma once

#include <cmath>
#include <memory>
#include <vector>

#include <hapbeam/beam.hpp>
#include <hapbeam/contact/touch.hpp>
#include <hapbeam/many/beam_array.hpp>

namespace hapbeam::testing {

/// Of nylon, 2 mm thick, clamped at its foot.
inline Beam bristle(double length = 0.06) {
  return {length, Section::circle(0.002), Material{3e9}, Support::clamped, Support::free};
}

/// Between two hinges, 1 mm thick.
inline Beam wire() { return {0.3, Section::circle(0.001), Material{2e11}, Support::pinned, Support::pinned}; }

/// Feet along x, tips up, as far apart as pitch [m]; kinds take turns.
inline std::vector<BeamPlace> row(int count, double pitch, int kinds = 1) {
  std::vector<BeamPlace> places;
  for (int i = 0; i < count; ++i) places.push_back({{pitch * i, 0}, std::acos(-1.0) / 2, i % kinds});
  return places;
}

template <typename Model>
class OneByOne {
 public:
  OneByOne(const BeamArray<Model>& array, double radius) : array_(array) {
    for (int i = 0; i < array.size(); ++i) {
      models_.push_back(std::make_unique<Model>(array.kind(array.kind_of(i)).model));
      touches_.push_back(std::make_unique<Touch<Model>>(*models_.back(), radius));
    }
  }

  TouchResult<double> tick(int beam, const Vector2<double>& hand) {
    return touches_[static_cast<std::size_t>(beam)]->tick(array_.frame(beam).local(hand));
  }

 private:
  const BeamArray<Model>& array_;
  std::vector<std::unique_ptr<Model>> models_;
  std::vector<std::unique_ptr<Touch<Model>>> touches_;
};

}  // namespace hapbeam::testing
