// Work over closed paths of the contact.  A hand that comes back to where it was must have got back what it gave, or the
// model feeds the loop.
//
// The frictionless contact does the work F (dd - w' ds) = F (dd + θ ds), w' the slope at the contact.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "support/random.hpp"
#include "support/thesis_beam.hpp"
#include <hapbeam/force_model.hpp>

namespace hapbeam::testing {

/// What a hand feels that presses at a place: across the beam, and the rotation there.
struct Feel {
  double force, theta;  // [N], [rad]
};

/// How a model of the library feels, from rest on; where it does not answer with ok the force is infinite.
template <class Model>
auto feel_of(Model& model) {
  model.reset();
  return [&model](const Press<double>& press) -> Feel {
    const Response<double> response = model.press(press);
    constexpr double none = std::numeric_limits<double>::infinity();
    return {response.status == Status::ok ? response.force : none, model.shape().at(press.s).theta};
  };
}

/// A loop of sines over 6 to 94 % of the thesis' beam and 1 to 49 mm.
class ClosedPath {
 public:
  explicit ClosedPath(std::uint64_t seed) {
    Random random(seed);
    for (int k = 0; k < 6; ++k) phase_[k] = random(3.14), size_[k] = random(0.3, 1.0);
  }
  /// @param t  in [0, 2π)
  Press<double> operator()(double t) const {
    return {thesis_length * (0.5 + 0.44 * wave(0, t)), 0.025 + 0.024 * wave(3, t)};
  }
  static constexpr int steps = 4000;

  /// Work of the hand in each of the steps.  Trapezium rule on a periodic smooth integrand: it converges faster than any
  /// power.   @param feel  Press -> Feel   @param visit  (work since the beginning [J])
  template <class Feeling, class Visit>
  void go_round(Feeling&& feel, Visit&& visit) const {
    const double h = 2 * std::acos(-1.0) / steps, e = 1e-4;
    double work = 0;
    for (int k = 0; k < steps; ++k) {
      const double t = k * h;
      const Press<double> ahead = (*this)(t + e), behind = (*this)(t - e);
      const Feel felt = feel((*this)(t));
      work += h * felt.force * ((ahead.d - behind.d) + felt.theta * (ahead.s - behind.s)) / (2 * e);
      visit(work);
    }
  }

 private:
  double wave(int first, double t) const {  // in [-1, 1]
    double sum = 0, all = 0;
    for (int k = 0; k < 3; ++k) {
      sum += size_[first + k] * std::sin((k + 1) * t + phase_[first + k]);
      all += size_[first + k];
    }
    return sum / all;
  }
  double phase_[6], size_[6];
};

/// Work over a closed path, over the most that was stored on the way.
template <class Feeling>
double gain(Feeling&& feel, std::uint64_t seed) {
  double work = 0, least = 0, most = 0;
  ClosedPath(seed).go_round(feel, [&](double now) {
    work = now;
    least = std::min(least, work), most = std::max(most, work);
  });
  return std::isfinite(work) ? std::abs(work) / (most - least) : std::numeric_limits<double>::infinity();
}

}  // namespace hapbeam::testing
