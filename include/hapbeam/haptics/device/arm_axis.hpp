// SPDX-License-Identifier: MIT
// A simulated arm: the mechanics of one of its axes in a hand.
//
//   m x'' = F + k (p - x) + c (p' - x') - b x' - friction
//
// m is the apparent mass of arm and grip, b the arm's viscous damping. k and c are spring and damper of the hand, which
// pulls toward p(t). F is the device's force, held over the interval. Coulomb friction f opposes x'; at x' = 0 it holds
// the arm against any force up to f.
// There is no time stepping: between two changes of the sign of x' the solution is a power series in time, summed to round-off, and
// the arm stops or breaks away at its roots. The motion does not depend on how an interval is divided. There are no end stops.
// Real-time: no allocation, noexcept, wait-free, bounded by max_events and by duration / longest_piece().
#pragma once

#include <algorithm>
#include <cmath>

namespace hapbeam {

namespace detail {

/// A power series in time from the beginning of an interval, for example [m], [m/s], … or [N], [N/s], ….
template <int Terms>
struct TimeSeries {
  double c[Terms] = {};

  double operator()(double t) const noexcept {
    double sum = c[Terms - 1];
    for (int n = Terms - 2; n >= 0; --n) sum = sum * t + c[n];
    return sum;
  }
  TimeSeries<Terms - 1> slope() const noexcept {
    TimeSeries<Terms - 1> derivative;
    for (int n = 1; n < Terms; ++n) derivative.c[n - 1] = n * c[n];
    return derivative;
  }
  TimeSeries operator*(double factor) const noexcept {
    TimeSeries product = *this;
    for (double& term : product.c) term *= factor;
    return product;
  }
};

/// The last time at which f >= 0 gives way to f < 0, bracketed by f(low) >= 0 > f(high); on the side f < 0.
template <typename Function>
double bisect(const Function& f, double low, double high) noexcept {
  for (int i = 0; i < 64; ++i) {
    const double middle = low + (high - low) / 2;
    if (!(low < middle && middle < high)) break;
    (f(middle) < 0 ? high : low) = middle;
  }
  return high;
}

/// When a series that starts at zero or above falls below zero, on the side below; `duration` where it does
/// not.  A dip between two ends that are both above is found where it is deeper than 1e-12 (m/s or N), far above round-off.
template <int Terms>
double first_below_zero(const TimeSeries<Terms>& f, double duration) noexcept {
  if (f(duration) < 0) return bisect(f, 0, duration);
  const auto slope = f.slope();
  if (slope(0) < 0 && slope(duration) > 0) {
    const double lowest = bisect(slope * -1, 0, duration);
    if (f(lowest) < -1e-12) return bisect(f, 0, lowest);
  }
  return duration;
}

}  // namespace detail

/// What one axis consists of; all finite, mass positive, the rest not negative.
struct ArmAxisParameters {
  double mass;       ///< m [kg] arm and grip
  double damping;    ///< b + c [N·s/m] arm and hand
  double stiffness;  ///< k [N/m] of the hand
  double friction;   ///< f [N] of the arm
};

class ArmAxis {
 public:
  /// What drives the axis, F + k p(t) + c p'(t), from the beginning of an interval [N, N/s, N/s², N/s³].
  using Drive = detail::TimeSeries<4>;

  /// More stops and starts than this within one interval and piece, and the arm rests until its end.
  static constexpr int max_events = 16;

  explicit ArmAxis(const ArmAxisParameters& parameters) noexcept : p_(parameters) {}

  double position() const noexcept { return x_; }  ///< [m]
  double velocity() const noexcept { return v_; }  ///< [m/s]

  /// Puts the arm somewhere, at rest.  @param position [m]
  void place(double position) noexcept { x_ = position, v_ = 0; }

  /// The longest time over which the power series below is summed to round-off [s]: 0.5^16 / 16! < 1e-18.
  double longest_piece() const noexcept {
    return 0.5 / (p_.damping / p_.mass + std::sqrt(p_.stiffness / p_.mass));
  }

  /// The force that drives the axis while the hand's target goes on a cubic from p0, v0 to p1, v1 [m, m/s].
  /// @param force F [N]   @param hand_damping c [N·s/m]   @param duration [s], positive
  Drive drive(double force, double p0, double v0, double p1, double v1, double hand_damping,
              double duration) const noexcept {
    const double mean = (p1 - p0) / duration;
    const double c[5] = {p0, v0, (3 * mean - 2 * v0 - v1) / duration,
                         (v0 + v1 - 2 * mean) / (duration * duration), 0};
    Drive drive;
    for (int n = 0; n < 4; ++n) drive.c[n] = p_.stiffness * c[n] + hand_damping * (n + 1) * c[n + 1];
    drive.c[0] += force;
    return drive;
  }

  /// Moves the axis.  @param duration [s]
  void advance(const Drive& interval, double duration) noexcept {
    Drive drive = interval;
    for (double done = 0; done < duration;) {
      const double piece = (std::min)(duration - done, longest_piece());
      advance_piece(drive, piece);
      if (done + piece == done) break;
      done += piece;
      drive = later(drive, piece);
    }
  }

 private:
  static constexpr int terms = 18;

  void advance_piece(Drive drive, double duration) noexcept {
    int direction = v_ > 0 ? 1 : v_ < 0 ? -1 : direction_from_rest(drive);
    for (int event = 0; event < max_events; ++event) {
      const double spent = direction == 0 && p_.friction > 0 ? stick(drive, duration, direction)
                                                             : slide(drive, duration, direction);
      if (!(spent < duration)) return;
      duration -= spent;
      drive = later(drive, spent);
    }
    v_ = 0;
  }

  /// The same drive, seen from a later time (Taylor shift).
  static Drive later(const Drive& d, double t) noexcept {
    return {{d(t), d.c[1] + t * (2 * d.c[2] + t * 3 * d.c[3]), d.c[2] + t * 3 * d.c[3], d.c[3]}};
  }

  /// Which way an arm at rest leaves: 0 where friction holds it.
  int direction_from_rest(const Drive& drive) const noexcept {
    const double balance = drive.c[0] - p_.stiffness * x_;
    return balance > p_.friction ? 1 : balance < -p_.friction ? -1 : 0;
  }

  /// Rests until |drive(t) - k x| > f.  @return the time spent [s]; direction is where it leaves to
  double stick(const Drive& drive, double duration, int& direction) const noexcept {
    Drive right = drive * -1, left = drive;
    right.c[0] += p_.stiffness * x_ + p_.friction;
    left.c[0] += p_.friction - p_.stiffness * x_;
    const double to_right = detail::first_below_zero(right, duration);
    const double to_left = detail::first_below_zero(left, duration);
    direction = to_right < to_left ? (right(to_right) < 0) : -(left(to_left) < 0);
    return (std::min)(to_right, to_left);
  }

  /// Moves until x' changes its sign:  x = sum a_n t^n,
  /// a_{n+2} = (r_n - (n + 1) (b + c) a_{n+1} - k a_n) / ((n + 1)(n + 2) m),  r = drive - f sgn x'.
  /// @return the time spent [s]; direction is where it goes from there
  double slide(const Drive& drive, double duration, int& direction) noexcept {
    detail::TimeSeries<terms> x;
    x.c[0] = x_;
    x.c[1] = v_;
    for (int n = 0; n + 2 < terms; ++n) {
      const double force = n == 0 ? drive.c[0] - p_.friction * direction : n < 4 ? drive.c[n] : 0;
      x.c[n + 2] =
          (force - (n + 1) * p_.damping * x.c[n + 1] - p_.stiffness * x.c[n]) / ((n + 1) * (n + 2) * p_.mass);
    }
    const auto v = x.slope();
    const auto forward = v * direction;
    const double spent = p_.friction > 0 ? detail::first_below_zero(forward, duration) : duration;
    const bool stops = p_.friction > 0 && forward(spent) < 0;
    x_ = x(spent), v_ = stops ? 0 : v(spent);
    if (stops) direction = direction_from_rest(later(drive, spent));
    return spent;
  }

  ArmAxisParameters p_;
  double x_ = 0, v_ = 0;
};

}  // namespace hapbeam
