// SPDX-License-Identifier: MIT
// Largest difference of two models: a climb from the worst presses of a sample.
//
// The error of an interpolation has a local maximum, a hill, between any four nodes of its grid, and a sample hardly hits them.
// From the worst presses steps go up and down in position and depth, by fractions of the distance to the nearer end and of the depth, and
// are shortened where none increases the error.
// Offline: allocates; throws TrainingError where the full model does not answer.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <hapbeam/body/inner_contact.hpp>
#include <hapbeam/force_model.hpp>
#include <hapbeam/rom/training/training_plan.hpp>

namespace hapbeam {

struct PressError {
  double s;      ///< [m]
  double depth;  ///< [m] |d|
  double force;  ///< relative
  double shape;  ///< largest |Δw| along the beam over the largest |w|
  double d;      ///< [m]
};

namespace detail {

/// Compares two models press by press, each from rest.
template <class Fast, class Full>
class PressComparison {
 public:
  /// @param range  of the presses: s_min, s_max and depth alone
  template <typename R>
  PressComparison(const Fast& fast, const Full& full, const Range<R>& range)
      : fast_(fast),
        full_(full),
        rest_(full),
        s_min_(close_to(range.s_min, full.range().s_min, length())),
        s_max_(close_to(range.s_max, full.range().s_max, length())),
        depth_(range.depth) {
    rest_.reset();
  }

  double s_min() const noexcept { return s_min_; }
  double s_max() const noexcept { return s_max_; }
  double length() const noexcept { return rest_.shape().length(); }
  /// w of the untouched beam [m].
  double rest(double s) const noexcept { return rest_.shape().at(s).w; }
  /// Where dead loads bend the beam, shallower presses are judged by the force of this depth from rest [m].
  double least() const noexcept { return depth_ / 1000; }
  /// From rest to the end of the range [m].
  double reach(double s, bool up) const noexcept { return deepest(s) + (up ? -rest(s) : rest(s)); }

  /// Whether two presses are about as deep.  The error at rest is the same on both sides.
  bool alike(const PressError& a, const PressError& b) const noexcept {
    const double ratio = (a.d - rest(a.s)) / (b.d - rest(b.s));
    const double size = rest(a.s) == 0 ? std::abs(ratio) : ratio;
    return size > 0.8 && size < 1.25;
  }

  /// The press at s by e from the untouched beam, or the nearest in range that both scalars represent and that finite
  /// elements do not press through a straight tip (FemModel::press).
  PressError operator()(double s, double e) {
    S at = static_cast<S>(std::clamp(off_tips(s), s_min_, s_max_));
    // In float an edge of the range may be rounded to the number beyond it.
    if (at > s_max_) at = std::nextafter(at, S(0));
    if (at < s_min_) at = std::nextafter(at, (std::numeric_limits<S>::max)());
    const double most = deepest(at);
    S d = static_cast<S>(std::clamp(rest(static_cast<double>(at)) + e, -most, most));
    if (std::abs(static_cast<double>(d)) > most) d = std::nextafter(d, S(0));
    return compare(at, d);
  }

 private:
  using S = typename Fast::Scalar;

  /// An edge of the range; the full model's, if they differ by round-off.
  static double close_to(double edge, double known, double unit) noexcept {
    return std::abs(edge - known) <= 1e-6 * unit ? known : edge;
  }
  /// Largest |d| in range [m].
  double deepest(double s) const noexcept { return close_to(depth_, full_.range().depth_at(s), depth_); }

  /// To the end itself or to the foot of the tip, whichever is nearer.
  double off_tips(double s) const noexcept {
    const double L = length(), tip = detail::shortest_element<double>(L);
    if (s > 0 && s < tip) return s < tip / 2 ? 0 : tip;
    if (s < L && s > L - tip) return s > L - tip / 2 ? L : L - tip;
    return s;
  }

  PressError compare(S s, S d) {
    PressError error{s, std::abs(d), 0, 0, d};
    full_.reset(), fast_.reset();
    const double wanted = press_for_training(full_, error.s, error.d);
    const double found = fast_.press({s, d}).force;
    const double w = rest(error.s), e = std::abs(error.d - w), least = w == 0 ? 0 : this->least();
    error.force = std::abs(found - wanted) / (std::abs(wanted) * (e < least ? least / e : 1));
    double off = 0, size = error.depth;
    for (const CentrelineNode<S>& node : fast_.shape()) {
      const double height = full_.shape().at(node.s).w;
      off = (std::max)(off, std::abs(node.w - height));
      size = (std::max)(size, std::abs(height));
    }
    error.shape = off / size;
    return error;
  }

  Fast fast_;
  Full full_, rest_;
  double s_min_, s_max_, depth_;
};

/// The unit of steps along the beam [m].
inline double to_the_end(double s, double L) noexcept { return (std::max)((std::min)(s, L - s), L / 50); }

/// Climbs from a press to the local maximum of the error.
template <class Comparison>
PressError climb(Comparison& comparison, PressError top) {
  const double L = comparison.length();
  // A hill of sixteen positions is a third of the distance to the end wide, one of twelve depths two thirds of the depth.
  for (double step = 0.1; step > 0.01; step /= 2) {
    for (bool higher = true; higher;) {
      higher = false;
      const double e = top.d - comparison.rest(top.s);
      const double by = step * to_the_end(top.s, L);
      for (const auto& [s, part] : {std::pair{top.s - by, 1.0},
                                    {top.s + by, 1.0},
                                    {top.s, 1 - 2 * step},
                                    {top.s, 1 / (1 - 2 * step)}}) {
        const PressError next = comparison(s, part * e);
        if (!(next.force > top.force * (1 + 1e-3))) continue;
        top = next;
        higher = true;
        break;
      }
    }
  }
  return top;
}

/// Largest relative error of the force that climbs from the worst of these presses find.
template <class Comparison>
double worst_error(Comparison& comparison, std::vector<PressError> presses, int climbs) {
  const auto worse = [](const PressError& a, const PressError& b) { return a.force > b.force; };
  std::sort(presses.begin(), presses.end(), worse);
  double most = presses.empty() ? 0 : presses.front().force;
  std::vector<PressError> begun;
  for (const PressError& press : presses) {
    // Those on the same hill lead to the same top.
    const auto same = [&](const PressError& other) {
      return std::abs(press.s - other.s) < 0.05 * to_the_end(press.s, comparison.length()) &&
             comparison.alike(press, other);
    };
    if (std::any_of(begun.begin(), begun.end(), same)) continue;
    begun.push_back(press);
    most = (std::max)(most, climb(comparison, press).force);
    if (static_cast<int>(begun.size()) == climbs) break;
  }
  return most;
}

/// Presses of which a random sample has few: very shallow ones along both edges of the range. With dead loads also the
/// shallowest that are judged, along the whole range, because there the error does not vanish with the depth.
template <class Comparison>
void add_shallow_presses(Comparison& comparison, std::vector<PressError>& presses) {
  const double low = comparison.s_min(), high = comparison.s_max();
  for (const double s : {low, high})
    for (int k = 0; k < 9; ++k)
      for (const bool up : {true, false})
        presses.push_back(comparison(s, (up ? 1 : -1) * comparison.reach(s, up) * std::pow(10, -k / 2.0)));
  for (int k = 0; k < 128; ++k) {
    const double s = low + (high - low) * k / 127;
    if (comparison.rest(s) != 0)
      presses.push_back(comparison(s, k % 2 ? comparison.least() : -comparison.least()));
  }
}

template <class Full>
using Refined = decltype(std::declval<const Full&>().refined());

/// Largest relative error of a full model's force on a range, against one with twice its elements. With an order of two
/// or more, the error of that one is at most a third of the difference. Zero for a model without refined().
template <class Full, typename R>
double own_error(const Full& full, const Range<R>& range, const std::vector<PressError>& sample) {
  if constexpr (offers<Refined, Full>) {
    PressComparison<Full, Full> comparison(full, full.refined(), range);
    std::vector<PressError> presses;
    // The corners of the range come first, and its edges in the first of each ten.
    for (std::size_t k = 0; k < sample.size(); k += k < 10 ? 1 : 17)
      presses.push_back(comparison(sample[k].s, sample[k].d - comparison.rest(sample[k].s)));
    return 4.0 / 3 * worst_error(comparison, std::move(presses), 3);
  }
  return 0;
}

}  // namespace detail
}  // namespace hapbeam
