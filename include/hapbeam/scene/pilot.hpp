// SPDX-License-Identifier: MIT
// Presses and pushes by which candidates are judged: a few lines of increasing depth, answered by a reference whose error is known.
//
// The reference is Corotational<>, with as many elements as it takes until half of them give the same force to a twentieth of the
// tolerated error, or with 512.  Lines stand at both ends of the range and between, closer toward supports, where every method is at its
// worst.
// The error is relative to the force.  A straight beam is pressed from a hundredth of the depth on.  One that dead loads or nature bend is
// pressed from a thousandth on, at many more places: a model that has it rest elsewhere errs by a force that does not vanish with the depth.
// Offline: allocates, throws std::invalid_argument where the scene asks for presses that no model answers.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <hapbeam/element/corotational.hpp>
#include <hapbeam/rom/trained/coordinates.hpp>
#include <hapbeam/rom/training/training_plan.hpp>
#include <hapbeam/scene/scene.hpp>

namespace hapbeam {

namespace detail {

/// Presses at one place, from rest outward.
struct PressLine {
  static constexpr const char *body = "beam", *motion = "press";
  double s;
  std::vector<double> depths;  // d [m]
  std::vector<double> forces;  // [N] of the reference

  template <class Model>
  Response<double> go(Model& model, std::size_t k) const {
    return model.press({s, depths[k]});
  }
};

/// @tparam Line  as PressLine
template <class Line>
class PilotOf {
 public:
  /// Largest relative error of the force; infinite where a press is not answered with ok.
  template <class Model>
  double error(Model& model) const {
    double most = 0;
    for (const Line& line : lines_) most = (std::max)(most, error(model, line));
    return most;
  }
  /// The same at one place.
  template <class Model>
  double error_at(Model& model, double s) const {
    double most = 0;
    for (const Line& line : lines_)
      if (line.s == s) most = (std::max)(most, error(model, line));
    return most;
  }
  int elements() const noexcept { return elements_; }       ///< of the reference
  double own_error() const noexcept { return own_error_; }  ///< of half as many elements: more than its own

 protected:
  explicit PilotOf(double force_floor) noexcept : floor_(force_floor) {}

  /// Refines a reference until it is known well enough, and keeps its answers.
  /// @param rest  of any mesh   @param most  elements   @param model_of  elements -> model
  template <class S, class Model, class ModelOf>
  void refine(const S& scene, const Model& rest, int most, ModelOf&& model_of) {
    const Range<double> range = rest.range();
    const double length = rest.shape().length(),
                 beside = (std::min)(range.s_min > 0 ? scene.s_min : length,
                                     range.s_max < length ? length - scene.s_max : length);
    // Four elements at least between a support and the nearest line, or half as many would be no other mesh there.
    for (elements_ = 32; elements_ < most && elements_ * beside < 4 * length;) elements_ *= 2;
    for (;; elements_ *= 2) {
      auto coarse = model_of(elements_ / 2), reference = model_of(elements_);
      answer(reference, scene.depth);
      const double apart = error(coarse);
      own_error_ = apart / 3;
      if (apart <= scene.force_error / 20 || elements_ >= most) return;
    }
  }

  std::vector<Line> lines_;

 private:
  template <class Model>
  double error(Model& model, const Line& line) const {
    constexpr double least = (std::numeric_limits<double>::min)();
    model.reset();
    double most = 0;
    for (std::size_t k = 0; k < line.depths.size(); ++k) {
      const Response<double> response = line.go(model, k);
      if (response.status != Status::ok) return std::numeric_limits<double>::infinity();
      most = (std::max)(most, std::abs(response.force - line.forces[k]) /
                                  (std::max)({std::abs(line.forces[k]), floor_, least}));
    }
    return most;
  }

  template <class Reference>
  void answer(Reference& reference, double depth) {
    for (Line& line : lines_) {
      line.forces.clear();
      reference.reset();
      for (std::size_t k = 0; k < line.depths.size(); ++k) {
        const Response<double> response = line.go(reference, k);
        if (response.status != Status::ok)
          refuse("depth = %g m: must be one that a %s answers everywhere; at s = %g m a %s to %g m is %s",
                 depth, Line::body, line.s, Line::motion, line.depths[k], name(response.status));
        line.forces.push_back(response.force);
      }
    }
  }

  double floor_;
  int elements_ = 0;
  double own_error_ = 0;
};

}  // namespace detail

class Pilot : public detail::PilotOf<detail::PressLine> {
 public:
  using Reference = FullModel<Corotational<>>;

  explicit Pilot(const Scene& scene) : PilotOf(scene.check().force_floor) {
    const Reference rest(scene.beam, 32);
    place(scene, rest);
    refine(scene, rest, 512, [&](int n) { return Reference(scene.beam, n); });
  }

  /// Both ends of the range and its middle [m].
  std::vector<double> places() const {
    return {lines_.front().s, lines_[main_lines_ / 2].s, lines_[main_lines_ - 1].s};
  }

 private:
  void place(const Scene& scene, const Reference& rest) {
    check_depth(scene, rest);
    const PositionCoordinate<double> coordinate(BeamData<double>::of(scene.beam));
    const double low = coordinate(scene.s_min), high = coordinate(scene.s_max);
    bool flat = scene.beam.arcs().empty();
    for (const CentrelineNode<double>& node : rest.shape()) flat = flat && node.w == 0;
    // Twenty presses for two powers of ten: evenly where thin beams answer as strings, in the logarithm.
    const auto lines_at = [&](double s, int deepest, int shallowest) {
      const double w = rest.shape().at(s).w;
      for (const double sign : {1.0, -1.0}) {
        if (flat && sign < 0) continue;
        detail::PressLine line{s, {}, {}};
        const double depth = (std::min)(scene.depth, 0.999 * rest.range().depth_at(s) - sign * w);
        for (int k = shallowest; k >= deepest; --k)
          line.depths.push_back(w + sign * depth * std::pow(10.0, -k / 10.0));
        lines_.push_back(line);
      }
    };
    // Uneven, lest they meet the nodes of an interpolation.
    for (const double along : {0.0, 0.11, 0.23, 0.36, 0.52, 0.67, 0.78, 0.91, 1.0}) {
      if (scene.one_place() && along > 0) break;
      lines_at(along == 0   ? scene.s_min
               : along == 1 ? scene.s_max
                            : coordinate.inverse(low + (high - low) * along),
               0, flat ? 20 : 30);
    }
    main_lines_ = lines_.size();
    for (int k = 1; k <= 40 && !flat && !scene.one_place(); ++k) {
      const double along = std::fmod(0.618033988749895 * k, 1.0);
      lines_at(scene.s_min + (scene.s_max - scene.s_min) * along, 30, 30);
    }
  }

  /// @throws std::invalid_argument unless presses to either side of rest are answered: somewhere to all of the depth, and beside
  /// a support to nine tenths at least of what is answered there of a beam that rests straight
  static void check_depth(const Scene& scene, const Reference& rest) {
    struct Place {
      double s, w, depth;  // [m] the last: the deepest press, from rest at w, that is answered to either side
    };
    constexpr double infinity = std::numeric_limits<double>::infinity();
    Place deepest{0, 0, -infinity}, corner{0, 0, infinity};
    for (int k = 0; k <= 64; ++k) {
      const double s = scene.s_min + (scene.s_max - scene.s_min) * k / 64, w = std::abs(rest.shape().at(s).w),
                   straight = rest.range().depth_at(s), depth = straight - w;
      if (depth > deepest.depth) deepest = {s, w, depth};
      if (depth < (std::min)(scene.depth, 0.9 * straight) && depth < corner.depth) corner = {s, w, depth};
    }
    const Place& limit = scene.depth > deepest.depth ? deepest : corner;
    if (scene.depth <= limit.depth) return;
    if (limit.depth > 0)
      detail::refuse(
          "depth = %g m: must be at most %.4g m, the deepest press that is answered to both "
          "sides of rest, %.4g m aside, at s = %.4g m",
          scene.depth, 0.999 * limit.depth, limit.w, limit.s);
    detail::refuse(
        "depth = %g m: must be of presses that are answered; this beam hangs %.4g m deep at "
        "rest at s = %.4g m, which is deeper than those",
        scene.depth, limit.w, limit.s);
  }

  std::size_t main_lines_ = 0;  // of those the ones that go all the way down
};

}  // namespace hapbeam
