// SPDX-License-Identifier: MIT
// One avatar on an array of beams: a Touch for each beam that it meets, and the sum of their forces.
//
// A beam that is met takes a model and a Touch from a pool, and returns them when it is released and clear of the avatar. All other beams
// are undeformed. A hierarchy over them finds those near the avatar's last step: a tick costs O(log n + beams near by).
// If more beams are met than the pool holds, the deepest are taken. A beam that was left out is ignored until the avatar has left it.
// Only the constructor allocates and throws.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <hapbeam/contact/touch.hpp>
#include <hapbeam/many/beam_array.hpp>

namespace hapbeam {

/// The sum of all forces, the worst status, and contact and press of the beam that pushes hardest.  The contact is in the array's axes.
template <typename Scalar>
struct ArrayTouchResult : TouchResult<Scalar> {
  int beam = -1;         ///< the one that pushes hardest; -1: none
  bool complete = true;  ///< false: more beams were met than taken or examined; out_of_range or worse
};

template <typename Scalar>
struct BeamTouch {
  int beam;
  Vector2<Scalar> force;     ///< [N] on the hand, in the array's axes
  TouchResult<Scalar> felt;  ///< of this beam, in its own axes
};

template <typename Model>
class Touch<BeamArray<Model>> {
 public:
  using Array = BeamArray<Model>;
  using Scalar = typename Model::Scalar;
  using Result = ArrayTouchResult<Scalar>;

  /// @param array  kept by reference   @param avatar_radius  [m]
  /// Allocates array.most_touched() models, or as many as there are beams of a kind.   @throws as Touch<Model>
  Touch(const Array& array, Scalar avatar_radius)
      : array_(array), avatar_radius_(avatar_radius), slot_of_(static_cast<std::size_t>(array.size()), none) {
    const std::size_t most = static_cast<std::size_t>(array.most_touched());
    free_.resize(static_cast<std::size_t>(array.kinds()));
    for (int k = 0; k < array.kinds(); ++k) {
      const int slots = (std::min)((std::max)(array.kind(k).beams, 1), array.most_touched());
      for (int i = 0; i < slots; ++i) {
        free_[static_cast<std::size_t>(k)].push_back(static_cast<std::int32_t>(slots_.size()));
        slots_.push_back(std::make_unique<Slot>(array.kind(k).model, avatar_radius));
      }
    }
    held_.reserve(most);
    touches_.reserve(most);
    met_.reserve(static_cast<std::size_t>(most_looks()));
  }

  /// Releases all beams, and discards the place of the hand.   Real-time: noexcept, no allocation.
  void reset() noexcept {
    while (!held_.empty()) give_back(held_.size() - 1);
    touches_.clear();
    last_.reset();
    pressing_ = false;
  }

  /// One tick.   @param position  [m] centre of the avatar, in the array's axes
  /// Real-time: noexcept, no allocation. Work with n = most_touched(): at most n ticks of Touch (two for a beam newly
  /// met), 2n + 8 searches for contact, 64 n comparisons of boxes, and the path through the tree to them.
  [[nodiscard]] Result tick(const Vector2<Scalar>& position) noexcept {
    Result result;
    touches_.clear();
    if (!std::isfinite(array_.tree_.root().distance_squared(position))) {
      result.status = Status::invalid_request;
      result.pressing = pressing_;
      return result;
    }
    for (std::size_t k = held_.size(); k-- > 0;) {
      Slot& slot = this->slot(held_[k]);
      const bool held = !slot.touch.resting();
      const TouchResult<Scalar> felt = slot.touch.tick(beam(slot).frame.local(position));
      add(slot, felt, result);
      if (!held && slot.touch.resting() && !felt.contact.touching) give_back(k);
    }
    result.complete = meet(position);
    for (const Met& met : met_) {
      Slot& slot = take(met);
      add(slot, slot.touch.tick(beam(slot).frame.local(position)), result);
    }
    pressing_ = result.pressing;
    last_ = position;
    if (!result.complete && worse(Status::out_of_range, result.status)) result.status = Status::out_of_range;
    return result;
  }

  [[nodiscard]] bool pressing() const noexcept { return pressing_; }

  const Array& array() const noexcept { return array_; }
  /// The beams that were pressed in the last tick, in no order.  They stay until the next call.
  const std::vector<BeamTouch<Scalar>>& touches() const noexcept { return touches_; }

  /// Shape of a beam in its own axes, pressed or untouched.   @param beam  its index in the array
  Centreline<Scalar> shape(int beam) const noexcept {
    const std::int32_t slot = slot_of_[static_cast<std::size_t>(array_.where(beam))];
    return slot == none ? array_.rest(beam) : slots_[static_cast<std::size_t>(slot)]->model.shape();
  }

  /// The deepest contact of the beams in their present shape, with the avatar moved straight from its last place to this one.
  /// @param position [m]   Real-time: noexcept, no allocation, bounded; no press.
  [[nodiscard]] Contact<Scalar> contact_at(const Vector2<Scalar>& position) noexcept {
    Contact<Scalar> deepest;
    const auto take = [&](const Contact<Scalar>& contact, const typename Array::Beam& beam) {
      if (contact.touching && !(deepest.depth > contact.depth)) deepest = in_scene(contact, beam);
    };
    for (const std::int32_t held : held_) {
      Slot& slot = this->slot(held);
      take(slot.touch.contact_at(beam(slot).frame.local(position)), beam(slot));
    }
    meet(position);
    for (const Met& met : met_) take(met.contact, array_.sorted(met.beam));
    return deepest;
  }

 private:
  static constexpr std::int32_t none = -1;

  struct Slot {
    Model model;
    Touch<Model> touch;
    int beam = 0;  // as the array has sorted them

    Slot(const Model& kind, Scalar avatar_radius) : model(kind), touch(model, avatar_radius) {}
    Slot(const Slot&) = delete;
    Slot& operator=(const Slot&) = delete;
  };
  /// An untouched beam that the avatar's last step has met.
  struct Met {
    Contact<Scalar> contact;  // in its axes
    int beam;
  };

  int most_looks() const noexcept { return 2 * array_.most_touched() + 8; }
  Slot& slot(std::int32_t i) noexcept { return *slots_[static_cast<std::size_t>(i)]; }
  const typename Array::Beam& beam(const Slot& slot) const noexcept { return array_.sorted(slot.beam); }

  /// Fills met_ with those beams that may be taken, the deepest.   @return false where there are more
  bool meet(const Vector2<Scalar>& position) noexcept {
    met_.clear();
    const detail::Step<Scalar> step{last_.value_or(position), position, avatar_radius_};
    int looks = most_looks(), boxes = 64 * array_.most_touched();
    bool complete = true;
    array_.tree_.visit(step, [&](int i) {
      if (slot_of_[static_cast<std::size_t>(i)] != none) return true;
      if (boxes-- == 0) return complete = false;
      const typename Array::Beam& beam = array_.sorted(i);
      const typename Array::Kind& kind = array_.kind(beam.kind);
      const Vector2<Scalar> here = beam.frame.local(step.to), before = beam.frame.local(step.from);
      if (!detail::Step<Scalar>{before, here, avatar_radius_}.meets(kind.box)) return true;
      if (looks-- == 0) return complete = false;
      ContactMemory<Scalar> memory;
      memory.place = before;
      memory.known = last_.has_value();
      const Contact<Scalar> contact = look(kind, here, memory);
      if (!contact.touching) return true;
      ContactMemory<Scalar> nothing;
      if (last_ && look(kind, before, nothing).touching) complete = false;  // left out before
      else met_.push_back({contact, i});
      return true;
    });
    const std::ptrdiff_t room = array_.most_touched() - static_cast<std::ptrdiff_t>(held_.size());
    if (static_cast<std::ptrdiff_t>(met_.size()) <= room) return complete;
    const auto left_out = met_.begin() + room;
    std::nth_element(met_.begin(), left_out, met_.end(),
                     [](const Met& a, const Met& b) { return a.contact.depth > b.contact.depth; });
    met_.erase(left_out, met_.end());
    return false;
  }
  Contact<Scalar> look(const typename Array::Kind& kind, const Vector2<Scalar>& local,
                       ContactMemory<Scalar>& memory) const noexcept {
    return find_contact({local, avatar_radius_}, kind.model.shape(), kind.volumes, kind.model.thickness(),
                        memory);
  }

  /// A model and a touch for a beam, with the avatar's place before.
  Slot& take(const Met& met) noexcept {
    std::vector<std::int32_t>& free = free_[static_cast<std::size_t>(array_.sorted(met.beam).kind)];
    const std::int32_t taken = free.back();
    free.pop_back();
    held_.push_back(taken);
    slot_of_[static_cast<std::size_t>(met.beam)] = taken;
    Slot& slot = this->slot(taken);
    slot.beam = met.beam;
    slot.touch.reset();
    if (last_) (void)slot.touch.tick(beam(slot).frame.local(*last_));
    return slot;
  }
  void give_back(std::size_t k) noexcept {
    const std::int32_t given = held_[k];
    const Slot& slot = this->slot(given);
    slot_of_[static_cast<std::size_t>(slot.beam)] = none;
    free_[static_cast<std::size_t>(beam(slot).kind)].push_back(given);
    held_[k] = held_.back();
    held_.pop_back();
  }

  void add(const Slot& slot, const TouchResult<Scalar>& felt, Result& result) noexcept {
    if (worse(felt.status, result.status)) result.status = felt.status;
    if (!felt.pressing) return;
    const typename Array::Beam& beam = this->beam(slot);
    const Vector2<Scalar> force = beam.frame.turned(felt.force);
    touches_.push_back({beam.index, force, felt});
    result.force += force;
    const Scalar size = force.squaredNorm();
    if (result.pressing && !(size > hardest_)) return;
    hardest_ = size;
    result.pressing = true;
    result.beam = beam.index;
    result.press = felt.press;
    result.contact = in_scene(felt.contact, beam);
  }
  static Contact<Scalar> in_scene(Contact<Scalar> contact, const typename Array::Beam& beam) noexcept {
    contact.foot = beam.frame.place(contact.foot);
    contact.point = beam.frame.place(contact.point);
    contact.normal = beam.frame.turned(contact.normal);
    return contact;
  }

  const Array& array_;
  Scalar avatar_radius_;
  std::vector<std::unique_ptr<Slot>> slots_;
  std::vector<std::vector<std::int32_t>> free_;  // slots, by kind
  std::vector<std::int32_t> held_;               // slots
  std::vector<std::int32_t> slot_of_;            // by beam as the array has sorted them, or none
  std::vector<Met> met_;
  std::vector<BeamTouch<Scalar>> touches_;
  std::optional<Vector2<Scalar>> last_;  // where the avatar was
  bool pressing_ = false;
  Scalar hardest_ = 0;  // [N²] in this tick
};

template <typename Model>
Touch(const BeamArray<Model>&, typename Model::Scalar) -> Touch<BeamArray<Model>>;

}  // namespace hapbeam
