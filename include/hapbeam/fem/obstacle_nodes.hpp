// Obstacles of a push, and the nodes of the mesh that follow them: what touches, or nearly does, has one.
//
// Two that are too near each other for a node each have one together, that of the larger force.
// Real-time: noexcept, no allocation, O(contacts²).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <hapbeam/body/shortest_element.hpp>
#include <hapbeam/centreline.hpp>
#include <hapbeam/fem/beam_system.hpp>
#include <hapbeam/fem/contact_search.hpp>
#include <hapbeam/force_model.hpp>

namespace hapbeam::detail {

/// Base class of ActiveSet.
template <class Element, class System>
class ObstacleNodes {
 protected:
  using Scalar = typename System::Scalar;
  using Node = typename System::Node;
  using Mesh = typename System::Mesh;
  using RoundContact = typename SystemOf<Element>::template RoundContact<Scalar>;
  static constexpr int dimension = dimension_of<Element>;
  static constexpr int most = contacts_of<Element>;
  using Vector = VectorOf<Scalar, dimension>;
  using Obstacle = hapbeam::Obstacle<Scalar, dimension>;
  using Search = ContactSearch<Scalar, dimension>;

  /// What is known of an obstacle during a push.
  struct Slot {
    Scalar s = 0;   ///< [m] where its node is or would be
    int node = -1;  ///< of the mesh, -1: none
    int goal = -1;  ///< number of its contact in the system, -1: none
    bool by_plane = false, sharp = false;
    bool short_of_it = false;  ///< the range ends before where its node would be
    bool let_go = false;       ///< in this push
    bool crowded = false;      ///< too near another contact to have a node
    bool close =
        false;  ///< the gap is small: it has a node, so that the mesh stays as it touches and lets go
    Scalar ahead = 0, miss = 0, depth = 0;
    Vector normal = Vector::Zero();
    Search search;
  };
  Slot& slot(int i) noexcept { return slots_[static_cast<std::size_t>(i)]; }

  /// To be called where a push begins.  @param all  in: where they are and whether they touched   @param range  says where a node can be
  template <class Extent>
  void begin(Obstacle* all, int count, const Extent& range) noexcept {
    all_ = all, count_ = count;
    for (int i = 0; i < count; ++i) begin(i, range);
  }

  /// Sorts those that have a node along the beam, and moves the mesh.   @param keeps  whether parts of the beam keep their elements, unless
  /// it bends so sharply that it takes the shortest
  template <class Extent>
  void choose_nodes(System& system, const Extent& range, bool keeps) noexcept {
    const Scalar apart = shortest_element(system.length());
    ordered_ = 0;
    for (int i = 0; i < count_; ++i) {
      Slot& now = slot(i);
      now.node = now.goal = -1;
      if (!all_[i].touching && !now.close) continue;
      const Scalar s = range.range().nearest({now.s, 0}).s;
      now.short_of_it = s != now.s;
      now.s = range.node(s);
      int k = ordered_++;
      for (; k > 0 && slot(order_[of(k - 1)]).s > now.s; --k) order_[of(k)] = order_[of(k - 1)];
      order_[of(k)] = i;
    }
    std::array<Scalar, most> s{};
    int nodes = 0;
    for (int k = 0; k < ordered_; ++k) {
      const int i = order_[of(k)];
      if (nodes > 0 && slot(i).s - s[of(nodes - 1)] < apart) {
        const int before = order_[of(nodes - 1)];
        const bool stays =
            all_[before].touching && (!all_[i].touching || all_[before].pushed.force <= all_[i].pushed.force);
        const int away = stays ? i : before;
        slot(away).crowded = all_[away].touching;
        all_[away].touching = slot(away).close = false;
        if (stays) continue;
        --nodes;
      }
      order_[of(nodes)] = i;
      s[of(nodes++)] = slot(i).s;
      keeps = keeps && !slot(i).sharp;
    }
    ordered_ = nodes;
    if (nodes == 0) return;
    mesh_ = keeps ? system.mesh().kept_at(s, nodes) : system.mesh().at(s, nodes);
    for (int k = 0; k < nodes; ++k) slot(order_[of(k)]).node = mesh_.node(k);
  }

  int end_at(const System& system, int node) const noexcept {
    return node == 0 ? -1 : node == system.elements() ? 1 : 0;
  }
  /// Whether two bodies lie on the beam side by side.
  bool beside(int i, int k) noexcept {
    const auto &a = all_[i], &b = all_[k];
    return a.body != b.body && a.kind == ObstacleKind::round && b.kind == ObstacleKind::round &&
           std::abs(slot(i).s - slot(k).s) < (std::max)(a.round.reach, b.round.reach);
  }
  /// Whether the beam is pressed by another body beside this one.
  bool beside_a_touch(int i) noexcept {
    for (int k = 0; k < count_; ++k)
      if (all_[k].touching && all_[k].pushed.force < 0 && beside(i, k)) return true;
    return false;
  }

  /// Another obstacle of the same body that touches, -1: none.
  int twin(int i) const noexcept {
    for (int k = 0; k < count_; ++k)
      if (k != i && all_[k].body == all_[i].body && all_[k].touching) return k;
    return -1;
  }
  static std::size_t of(int i) noexcept { return static_cast<std::size_t>(i); }

  Obstacle* all_ = nullptr;
  int count_ = 0, ordered_ = 0;
  std::array<int, most> order_{};  // of those that have a node, along the beam
  Mesh mesh_{2, Scalar(1)};

 private:
  template <class Extent>
  void begin(int i, const Extent& range) noexcept {
    const bool sharp = slot(i).sharp && all_[i].touching;
    slot(i) = {};
    slot(i).sharp = sharp;
    const bool round = all_[i].kind == ObstacleKind::round;
    all_[i].touching = all_[i].valid && (all_[i].touching || all_[i].kind == ObstacleKind::support);
    slot(i).s = std::clamp(round ? all_[i].round.s : all_[i].place.s, Scalar(0), range.length());
    slot(i).close = all_[i].touching || (all_[i].valid && !round);
  }

  std::array<Slot, most> slots_{};
};

}  // namespace hapbeam::detail
