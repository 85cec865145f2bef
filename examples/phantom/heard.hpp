// What is heard of a model: of one with mass the velocity of its free right end, or the force on its right support.
#pragma once

#include <cstddef>
#include <vector>

#include "options.hpp"
#include <hapbeam/force_model.hpp>
#include <hapbeam/haptics/servo/sound.hpp>

namespace phantom {

template <typename Model, bool = hapbeam::has_mass<Model>>
struct Heard {
  Heard(Model&, const Options&) {}
  double moved(const Model&) const noexcept { return 0; }
  int read(std::vector<float>&) { return 0; }
};

template <typename Model>
class Heard<Model, true> {
 public:
  /// @param model  kept by reference, at rest
  Heard(Model& model, const Options& options)
      : free_(options.beam.right == hapbeam::Support::free),
        place_(free_ ? model.shape().length() : options.place),
        rest_(model.shape().at(place_).w),
        sound_(model, {free_ ? hapbeam::SoundSource::velocity : hapbeam::SoundSource::right_support,
                       model.shape().length(), rate}) {}

  /// Of the free end, or of the place that is to be pressed [m].
  double moved(const Model& model) const noexcept { return model.shape().at(place_).w - rest_; }
  int read(std::vector<float>& samples) {
    const std::size_t before = samples.size();
    samples.resize(before + sound_.waiting());
    (void)sound_.read(samples.data() + before, static_cast<int>(samples.size() - before));
    return rate;
  }

 private:
  static constexpr int rate = 48000;  // [Hz]
  bool free_;
  double place_, rest_;  // [m]
  hapbeam::Sound<Model> sound_;
};

}  // namespace phantom
