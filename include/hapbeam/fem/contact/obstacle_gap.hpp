// SPDX-License-Identifier: MIT
// How deep a beam or rod lies in a circle or capsule that does not touch it, and where.
//
// Of one that touches at another place already, a twin, the place is beyond one that is farther away; or it is beside the twin, where the beam
// bends more sharply than the body within an element.
// Real-time: noexcept, no allocation, O(elements).
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <hapbeam/body/inner_contact.hpp>
#include <hapbeam/force_model.hpp>

namespace hapbeam::detail {

/// @tparam Line  Centreline   @tparam RoundContact  RoundContact<Scalar> | RodRoundContact<Scalar>
template <class Line, class RoundContact>
class ObstacleGap {
  using Scalar = decltype(std::declval<const Line&>().length());

 public:
  /// Steps of the search.
  static constexpr int most_looks = 8;

  Scalar s = 0;                                             ///< [m] arc position, where it is near
  Scalar depth = -std::numeric_limits<Scalar>::infinity();  ///< [m] of the beam in it; infinite: far away

  /// @param line  as it lies
  ObstacleGap(const Line& line, const RoundContact& round) noexcept : line_(line), round_(round) {
    for (int k = 0; k < line.size(); ++k) take(k, round.clearance(line[k]));
    look();
  }
  /// The same for a twin.  @param node, touched  where it touches already   @param apart  [m] least distance from there
  ObstacleGap(const Line& line, const RoundContact& round, int node, Scalar touched, Scalar apart) noexcept
      : line_(line), round_(round) {
    look_beyond(node);
    look_beside(touched, apart);
    look();
  }

 private:
  /// A place: about at `at`, and between two others [m].
  void take(Scalar at, Scalar from, Scalar to, Scalar clearance) noexcept {
    if (known_ && !(clearance < clearance_)) return;
    known_ = true;
    s = at, left_ = from, right_ = to, clearance_ = clearance;
  }
  void take(int k, Scalar clearance) noexcept {
    take(line_[k].s, line_[(std::max)(k - 1, 0)].s, line_[(std::min)(k + 1, line_.segments())].s, clearance);
  }
  void look_beyond(int node) noexcept {
    for (const int step : {-1, 1}) {
      bool falls = false;
      Scalar before = round_.clearance(line_[node]);
      for (int k = node + step; k >= 0 && k < line_.size(); k += step) {
        const Scalar clearance = round_.clearance(line_[k]);
        falls = falls || clearance < before;
        if (falls) take(k, clearance);
        before = clearance;
      }
    }
  }
  void look_beside(Scalar touched, Scalar apart) noexcept {
    const Scalar reach = round_.request().reach, length = line_.length();
    for (const int side : {-1, 1})
      for (Scalar away = reach / 2; away > (std::max)(apart, reach / 20); away /= 2) {
        const Scalar at = touched + static_cast<Scalar>(side) * away;
        if (at < 0 || at > length) continue;
        const Scalar clearance = round_.clearance(line_.node_at(at));
        if (!(clearance < reach)) continue;
        if (side < 0) take(at, (std::max)(touched - 2 * away, Scalar(0)), touched - apart, clearance);
        else take(at, touched + apart, (std::min)(touched + 2 * away, length), clearance);
      }
  }
  void look() noexcept {
    if (!known_) return;
    const Scalar length = line_.length(), reach = round_.request().reach;
    const auto view_at = [&](const auto& node) {
      return round_.look(node, s <= 0 ? -1 : s >= length ? 1 : 0);
    };
    // What is far away does not touch, unless the beam has gone past it in this push.
    const auto start = line_.node_at(s);
    const auto beside = view_at(start);
    if (round_.clearance(start) - reach > right_ - left_ + length / 100 &&
        (beside.past_end || beside.distance > 0))
      return;
    for (int step = 0; step < most_looks; ++step) {
      const auto view = view_at(line_.node_at(s));
      depth = reach - view.distance;
      const Scalar next = std::clamp(s + view.ahead, left_, right_);
      if (std::abs(next - s) <= Scalar(1e-6) * length) break;
      s = next;
    }
  }

  const Line& line_;
  const RoundContact round_;
  bool known_ = false;
  Scalar left_ = 0, right_ = 0, clearance_ = 0;
};

template <typename Scalar, int D>
struct RoundBeside {
  using Vector = VectorOf<Scalar, D>;

  Vector facing;  ///< unit, to where it comes from: across the tangent at the foot, past an end from that
  Scalar height, aside;  ///< of the centre along that [m], and how far it is aside of that, squared [m²]
  Scalar gap;     ///< from the beam to the centre, negative behind it; past an end from its last point [m]
  Vector normal;  ///< unit, along that
  Vector place;   ///< of the beam [m]
  Scalar foot;    ///< [m]
};

/// @tparam RoundContact  RoundContact<Scalar> | RodRoundContact<Scalar>
/// @param foot  in and out: the place that is nearest [m], from where it was
template <class RoundContact, class System, class Round>
auto look_beside(const System& system, const Round& of, typename System::Scalar& foot) noexcept
    -> RoundBeside<typename System::Scalar, System::dimension> {
  using Scalar = typename System::Scalar;
  using Vector = VectorOf<Scalar, System::dimension>;
  constexpr int dimension = System::dimension;
  const auto line = system.centreline();
  const RoundContact round{of};
  auto node = line.node_at(foot);
  auto view = round.look(node, 0);
  for (int k = 0; k < 4 && std::abs(view.ahead) > Scalar(1e-7) * of.reach; ++k) {
    foot = std::clamp(foot + view.ahead, Scalar(0), system.length());
    node = line.node_at(foot);
    view = round.look(node, 0);
  }
  const Vector place = node.position(), off = round.centre(place) - place;
  // Where a beam that is bent far leads the search to and fro, no foot is found, and the place is not beside it.
  const bool beyond = (foot <= 0 && view.ahead < 0) || (foot >= system.length() && view.ahead > 0) ||
                      std::abs(view.ahead) > of.reach;
  const Scalar size = std::sqrt(off.squaredNorm());
  const Vector toward = off / size;
  Vector facing = view.normal;
  Scalar height = view.distance, aside = 0;
  // Behind the axis of a rod it has the side from which it came.
  if constexpr (dimension == 3) facing = round.facing(node.tangent), height = facing.dot(off);
  // Past an end it pushes the last point away from itself, until it is behind that.
  if (beyond && height > 0) return {toward, size, 0, size, toward, place, foot};
  if (beyond || dimension == 3) aside = (std::max)(size * size - height * height, Scalar(0));
  if (beyond || (dimension == 3 && height > 0)) return {facing, height, aside, size, toward, place, foot};
  return {facing, height, aside, height, facing, place, foot};
}

/// Whether it lies in a body beside where it touches that, too: bent nearly as sharply, it may have another place there.
/// @param s  where it touches [m]   @param wraps  as of its contact
template <class System, class Round, typename Scalar>
bool touches_again(System& system, const Round& round, Scalar s, Scalar wraps) noexcept {
  using RoundContact = typename System::RoundContact;
  constexpr Scalar sharpest = Scalar(0.25);  // from there the distance may have another minimum
  if (!(wraps > sharpest)) return false;
  system.draw();
  const auto line = system.drawn();
  const ObstacleGap<decltype(line), RoundContact> gap(line, RoundContact{round}, line.node_near(s), s,
                                                      shortest_element<Scalar>(system.length()));
  return gap.depth > Scalar(1e-6) * system.length();
}

}  // namespace hapbeam::detail
