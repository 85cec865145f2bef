// SPDX-License-Identifier: MIT
// Many beams in one plane: hair, a brush, grass, the strings of a harp.
//
//   BeamArray brush(FemModel<>(bristle, 8), places);   // all alike; or a list of kinds
//   Touch touch(brush, 0.005);                         // one hand: many/touch_many.hpp
//   const auto felt = touch.tick(hand);                // the sum of what all beams do to it
//
// Beams are of a few kinds. Each kind is one undeformed model; a beam adds only its place. A beam requires a model of
// its own while it is touched, and the touch holds a fixed number of them.
// Immutable after construction, which allocates and throws.  All else is noexcept and allocation-free.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numeric>
#include <vector>

#include <hapbeam/check.hpp>
#include <hapbeam/contact/bounding_volumes.hpp>
#include <hapbeam/contact/box.hpp>
#include <hapbeam/force_model.hpp>

namespace hapbeam {

/// Where one beam of an array lies.
struct BeamPlace {
  Vector2<double> origin{0, 0};  ///< [m] of its left end, s = 0, w = 0, in the plane of the array
  double angle = 0;              ///< [rad] of its x axis, counterclockwise from the array's
  int kind = 0;                  ///< which of the array's models
};

namespace detail {

/// The axes of one beam in those of the array.
template <typename Scalar>
struct BeamFrame {
  Vector2<Scalar> origin, along;  // [m], unit

  Vector2<Scalar> local(const Vector2<Scalar>& place) const noexcept {
    const Scalar x = place.x() - origin.x(), y = place.y() - origin.y();
    return {along.x() * x + along.y() * y, along.x() * y - along.y() * x};
  }
  /// Of a direction or force.
  Vector2<Scalar> turned(const Vector2<Scalar>& v) const noexcept {
    return {along.x() * v.x() - along.y() * v.y(), along.y() * v.x() + along.x() * v.y()};
  }
  Vector2<Scalar> place(const Vector2<Scalar>& local) const noexcept { return origin + turned(local); }
};

/// Step of an avatar from one place to another, in a tick.
template <typename Scalar>
struct Step {
  Vector2<Scalar> from, to;  // [m]
  Scalar radius;             // [m] of the avatar

  /// Whether it can touch what lies in the box: it is there at the end, or has crossed it on the way.
  bool meets(const Box<Scalar>& box) const noexcept {
    return box.distance_squared(to) <= radius * radius || box.meets(from, to);
  }
};

/// A hierarchy over fixed boxes, which are halved along the longer side of the box around their centres.  A leaf holds four to
/// eight, so a tree takes 8 to 16 numbers a leaf and no pointers.
template <typename Scalar>
class SortedBoxes {
 public:
  using Bounds = Box<Scalar>;

  /// Allocates.  @param boxes  one or more   @param order  out: their indices as the tree has sorted them
  [[gnu::cold]] SortedBoxes(const std::vector<Bounds>& boxes, std::vector<std::int32_t>& order)
      : tree_(leaves_for(boxes.size())) {
    tree_.resize(static_cast<int>(boxes.size()));
    order.resize(boxes.size());
    std::iota(order.begin(), order.end(), 0);
    halve(boxes, order, 0, tree_.leaves());
    for (int leaf = 0; leaf < tree_.leaves(); ++leaf)
      for (int i = tree_.first(leaf); i < tree_.first(leaf + 1); ++i)
        tree_.leaf(leaf).include(boxes[static_cast<std::size_t>(order[static_cast<std::size_t>(i)])]);
    tree_.join();
  }

  const Bounds& root() const noexcept { return tree_.root(); }
  std::size_t bytes() const noexcept { return tree_.bytes(); }

  /// Calls look(i) for the boxes of each leaf that a step meets, near leaves first, while look(i) returns true. i
  /// counts in the tree's order.   Real-time: noexcept, no allocation.
  template <class Look>
  void visit(const Step<Scalar>& step, Look&& look) const noexcept {
    constexpr Scalar most = (std::numeric_limits<Scalar>::max)();
    tree_.visit(
        [&step](const Bounds& box) {
          return step.meets(box) ? box.distance_squared(step.to) : std::numeric_limits<Scalar>::infinity();
        },
        [] { return most; }, look);
  }

 private:
  static int leaves_for(std::size_t size) noexcept {
    int leaves = 1;
    while (static_cast<std::size_t>(8 * leaves) < size) leaves *= 2;
    return leaves;
  }
  /// @param low, high  leaves
  void halve(const std::vector<Bounds>& boxes, std::vector<std::int32_t>& order, int low, int high) const {
    if (high - low == 1) return;
    const auto centre = [&boxes](std::int32_t i, int k) {  // twice as far out as it is
      return boxes[static_cast<std::size_t>(i)].low[k] + boxes[static_cast<std::size_t>(i)].high[k];
    };
    const auto at = [&](int leaf) { return order.begin() + tree_.first(leaf); };
    Bounds centres;
    for (auto i = at(low); i != at(high); ++i) centres.include(Vector2<Scalar>(centre(*i, 0), centre(*i, 1)));
    const int middle = (low + high) / 2,
              along = centres.high[0] - centres.low[0] >= centres.high[1] - centres.low[1] ? 0 : 1;
    std::nth_element(at(low), at(middle), at(high), [&](std::int32_t a, std::int32_t b) {
      return std::make_pair(centre(a, along), a) < std::make_pair(centre(b, along), b);
    });
    halve(boxes, order, low, middle);
    halve(boxes, order, middle, high);
  }

  BoxTree<Scalar> tree_;
};

}  // namespace detail

/// @tparam Model  a ForceModel that can be copied; copies of a trained model share what was trained
template <typename Model>
class BeamArray {
  static_assert(is_force_model<Model>,
                "BeamArray<Model>: Model must fulfil the contract of hapbeam/force_model.hpp");

 public:
  using Scalar = typename Model::Scalar;
  using Frame = detail::BeamFrame<Scalar>;

  /// One kind of beams, untouched.
  struct Kind {
    Model model;
    BoundingVolumes<Scalar> volumes;
    detail::Box<Scalar> box;  ///< [m] around the beam, widened by round-off
    int beams = 0;

    explicit Kind(const Model& given) : model(given), volumes((model.reset(), model.shape().segments())) {
      volumes.refit(model.shape());
      model.shape().visit_segments([&](int, const CubicSegment<Scalar>& segment) { box.include(segment); });
      box = box.grown(model.thickness() / 2 + slack(box));
    }
  };

  /// Beams that are alike.   @param most_touched  by a hand at once, 1 to 4096   @throws as below
  BeamArray(const Model& model, const std::vector<BeamPlace>& places, int most_touched = 64)
      : BeamArray(std::vector<Model>{model}, places, most_touched) {}

  /// @param kinds  one or more; their present shapes are those of the untouched beams
  /// @throws std::invalid_argument naming field, value, unit and what is allowed
  BeamArray(const std::vector<Model>& kinds, const std::vector<BeamPlace>& places, int most_touched = 64)
      : most_touched_(most_touched),
        kinds_(make_kinds(kinds, places, most_touched)),
        tree_(boxes(places), order_) {
    beams_.reserve(places.size());
    where_.resize(places.size());
    for (const std::int32_t i : order_) {
      const BeamPlace& place = places[static_cast<std::size_t>(i)];
      where_[static_cast<std::size_t>(i)] = static_cast<std::int32_t>(beams_.size());
      beams_.push_back({frame_of(place), i, static_cast<std::int32_t>(place.kind)});
    }
    order_ = {};
  }

  int size() const noexcept { return static_cast<int>(beams_.size()); }
  int most_touched() const noexcept { return most_touched_; }
  int kinds() const noexcept { return static_cast<int>(kinds_.size()); }
  const Kind& kind(int i) const noexcept { return kinds_[static_cast<std::size_t>(i)]; }
  /// @param beam  its index in the list that the array was made of
  int kind_of(int beam) const noexcept { return sorted(where(beam)).kind; }
  const Frame& frame(int beam) const noexcept { return sorted(where(beam)).frame; }
  /// Of an untouched beam, in its own axes.
  Centreline<Scalar> rest(int beam) const noexcept { return kind(kind_of(beam)).model.shape(); }

  /// Heap of all beams together, without that of the kinds' models.
  std::size_t bytes() const noexcept {
    return beams_.capacity() * sizeof(Beam) + where_.capacity() * sizeof(std::int32_t) + tree_.bytes();
  }

 private:
  template <typename, typename>
  friend class Touch;

  struct Beam {
    Frame frame;
    std::int32_t index, kind;
  };

  static std::vector<Kind> make_kinds(const std::vector<Model>& models, const std::vector<BeamPlace>& places,
                                      int most_touched) {
    const auto count = [](const char* field, std::size_t n, double most, const char* allowed) {
      if (n < 1 || static_cast<double>(n) > most) detail::reject(field, static_cast<double>(n), "", allowed);
    };
    count("most_touched", static_cast<std::size_t>(most_touched < 0 ? 0 : most_touched), 4096, "1 to 4096");
    count("kinds", models.size(), 1 << 20, "1 to a million");
    count("places", places.size(), 1 << 30, "1 to 2^30");
    std::vector<Kind> kinds(models.begin(), models.end());
    for (const BeamPlace& place : places) {
      if (place.kind < 0 || static_cast<std::size_t>(place.kind) >= models.size())
        detail::reject("place kind", place.kind, "", "the index of one of the kinds");
      detail::finite("place origin", place.origin.x() + place.origin.y(), "m");
      detail::finite("place angle", place.angle, "rad");
      ++kinds[static_cast<std::size_t>(place.kind)].beams;
    }
    return kinds;
  }

  static Frame frame_of(const BeamPlace& place) noexcept {
    return {place.origin.template cast<Scalar>(),
            {static_cast<Scalar>(std::cos(place.angle)), static_cast<Scalar>(std::sin(place.angle))}};
  }
  static Scalar slack(const detail::Box<Scalar>& box) noexcept {
    return 16 * std::numeric_limits<Scalar>::epsilon() *
           (std::max)((std::max)(-box.low[0], box.high[0]), (std::max)(-box.low[1], box.high[1]));
  }
  std::vector<detail::Box<Scalar>> boxes(const std::vector<BeamPlace>& places) const {
    std::vector<detail::Box<Scalar>> all(places.size());
    for (std::size_t i = 0; i < places.size(); ++i) {
      const detail::Box<Scalar>& own = kind(places[i].kind).box;
      const Frame frame = frame_of(places[i]);
      for (const Scalar x : {own.low[0], own.high[0]})
        for (const Scalar y : {own.low[1], own.high[1]}) all[i].include(frame.place({x, y}));
      all[i] = all[i].grown(slack(all[i]));
    }
    return all;
  }

  int where(int beam) const noexcept { return where_[static_cast<std::size_t>(beam)]; }
  const Beam& sorted(int i) const noexcept { return beams_[static_cast<std::size_t>(i)]; }

  int most_touched_;
  std::vector<Kind> kinds_;
  std::vector<std::int32_t> order_;  // while it is built
  detail::SortedBoxes<Scalar> tree_;
  std::vector<Beam> beams_;          // as the tree has sorted them
  std::vector<std::int32_t> where_;  // there, by index
};

}  // namespace hapbeam
