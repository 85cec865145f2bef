// SPDX-License-Identifier: MIT
// What a beam with mass sounds like: samples of its motion, from the parts of its steps, for a file or a sound card.
//
//   DynamicModel<> model(string, 16, 48);            // 48 parts a step: 48 kHz where a step is a millisecond
//   Sound sound(model, {SoundSource::velocity, 0.1});
//   ServoLoop loop(device, model);                   // or model.step(dt): each part is heard
//   sound.read(samples, 256);                        // from one other thread, as that of the sound card
//
// Parts need not be as long as samples are apart: samples lie on the cubic through four values, one or two parts late.  Partials up to a tenth of the
// rate of the parts are heard to 0.4 %.  Time that no step has gone on by is left out.
// Allocates and throws at construction.  In the tick: noexcept, no allocation, wait-free.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include <hapbeam/centreline.hpp>
#include <hapbeam/haptics/servo/exchange.hpp>

namespace hapbeam {

enum class SoundSource : std::int8_t {
  velocity,       ///< across the undeformed beam, of a rod along y, at a place [m/s]: a pickup
  left_support,   ///< force across it on what holds its left end [N]: a bridge
  right_support,  ///< the same of its right end
};

struct SoundOptions {
  SoundSource source = SoundSource::velocity;
  double place = 0;     ///< [m] arc position of the velocity
  double rate = 48000;  ///< [Hz] of samples
  double room = 2;      ///< [s] of samples that wait for the reader at most
};

/// @tparam Model  with mass, and listen(), velocity(s), reaction(end)
template <typename Model>
class Sound {
 public:
  /// @param model  kept by reference: it stays where it is, and is heard by one Sound
  /// @throws std::invalid_argument unless the place is on the beam, the rate 1 Hz to 1 MHz, the room at least a sample and at most an hour
  Sound(Model& model, const SoundOptions& options)
      : model_(model), options_(checked(options, model)), samples_(room(options)) {
    for (int k = 0; k < points; ++k) at_[k] = (k - points) / options_.rate;
    model_.listen(this, [](void* who, const Model& m, Scalar part) noexcept {
      static_cast<Sound*>(who)->hear(m, part);
    });
  }
  ~Sound() { model_.listen(nullptr, nullptr); }
  Sound(const Sound&) = delete;
  Sound& operator=(const Sound&) = delete;

  /// The oldest samples that have not been read, then silence.   @param samples  out, of SI units   @return how many there were
  /// One reader, from any thread: wait-free, O(count).
  int read(float* samples, int count) noexcept {
    float *to = samples, *const end = samples + (std::max)(count, 0);
    const std::size_t taken =
        samples_.take([&to](float x) noexcept { *to++ = x; }, static_cast<std::size_t>(end - to));
    std::fill(to, end, 0.0F);
    missed_ += static_cast<std::uint64_t>(end - to);
    return static_cast<int>(taken);
  }
  // From the reader's thread.
  std::size_t waiting() const noexcept { return samples_.waiting(); }  ///< samples that can be read
  std::uint64_t missed() const noexcept { return missed_; }            ///< silent samples that were read
  std::uint64_t lost() const noexcept { return samples_.lost(); }      ///< that nobody has read in time
  const SoundOptions& options() const noexcept { return options_; }

 private:
  using Scalar = typename Model::Scalar;
  static constexpr int points = 4;

  static const SoundOptions& checked(const SoundOptions& o, const Model& model) {
    const double length = model.shape().length();
    if (!(o.place >= 0 && o.place <= length)) detail::reject("place", o.place, "m", "on the beam");
    if (!(o.rate >= 1 && o.rate <= 1e6)) detail::reject("rate", o.rate, "Hz", "1 to 1e6");
    if (!(o.room * o.rate >= 1 && o.room <= 3600)) detail::reject("room", o.room, "s", "a sample to 3600 s");
    return o;
  }
  static std::size_t room(const SoundOptions& o) {
    return static_cast<std::size_t>(std::ceil(o.room * o.rate));
  }

  double value(const Model& model) const noexcept {
    if (options_.source == SoundSource::velocity)
      return model.velocity(static_cast<Scalar>(options_.place)).y();
    const auto held = model.reaction(options_.source == SoundSource::left_support ? 0 : 1);
    if constexpr (dimension_of<Model> == 3) return -held.force.y();
    else return -held.y();
  }
  /// Times are counted from the second of the last values.
  void hear(const Model& model, double part) noexcept {
    if (!(part > 0)) return;
    for (int k = 0; k + 1 < points; ++k) at_[k] = at_[k + 1], x_[k] = x_[k + 1];
    at_[points - 1] = at_[points - 2] + part, x_[points - 1] = value(model);
    const double from = at_[1];
    for (double& t : at_) t -= from;
    next_ -= from;
    for (; next_ <= at_[2]; next_ += 1 / options_.rate) samples_.add(static_cast<float>(between(next_)));
  }
  /// Lagrange's cubic.
  double between(double t) const noexcept {
    double sum = 0;
    for (int i = 0; i < points; ++i) {
      double product = x_[i];
      for (int j = 0; j < points; ++j)
        if (j != i) product *= (t - at_[j]) / (at_[i] - at_[j]);
      sum += product;
    }
    return sum;
  }

  Model& model_;
  SoundOptions options_;
  Ring<float> samples_;
  double at_[points], x_[points] = {};  // the last values and their times [s]
  double next_ = 0;                     // when the next sample is due [s]
  std::uint64_t missed_ = 0;
};

}  // namespace hapbeam
