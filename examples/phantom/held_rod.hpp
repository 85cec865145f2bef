// A rod in the hand and what it meets, in the words of a model that is touched: its shape is that of the first rod.
//
// The held end goes where the hand goes, and does not turn; a spring and a damper that the device can render lead it.  What is felt is the
// force there.  Allocates and throws at construction.   Real-time: as hapbeam::World.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <vector>

#include "body.hpp"
#include "coupling.hpp"
#include <hapbeam/element/rod.hpp>
#include <hapbeam/haptics/held/grip.hpp>
#include <hapbeam/haptics/servo/servo.hpp>
#include <hapbeam/world/world_tool.hpp>

namespace phantom {

class HeldRod {
 public:
  using Scalar = double;
  static constexpr int dimension = 3;
  using World = hapbeam::World<hapbeam::RoundRod>;
  using Tool = hapbeam::WorldTool<hapbeam::RoundRod>;

  /// @param rods  the left end of the last is held, on coupling.support()   @throws std::invalid_argument as World
  HeldRod(const std::vector<hapbeam::WorldRod>& rods, const std::vector<hapbeam::RigidBody>& bodies,
          const hapbeam::GripCoupling& coupling)
      : coupling_(coupling), world_(std::make_unique<World>(rods, bodies)) {}

  hapbeam::Centreline<double, 3> shape() const noexcept { return world_->shape(0); }
  const hapbeam::GripCoupling& coupling() const noexcept { return coupling_; }
  World& world() noexcept { return *world_; }
  const World& world() const noexcept { return *world_; }

 private:
  hapbeam::GripCoupling coupling_;
  std::unique_ptr<World> world_;
};

/// A tick's record, all rods and where they touch.
class WorldPicture {
 public:
  explicit WorldPicture(const HeldRod::World& world) {
    for (int i = 0; i < world.rods(); ++i) rods_.emplace_back(world.shape(i));
    take(world);
  }

  hapbeam::ServoRecord record;
  std::size_t rods() const noexcept { return rods_.size(); }
  hapbeam::Centreline<double, 3> shape(std::size_t rod) const noexcept { return rods_[rod].shape(); }
  std::size_t contacts() const noexcept { return contacts_; }
  /// Between both centrelines, or centreline and surface [m].
  const Eigen::Vector3d& contact(std::size_t k) const noexcept { return places_[k]; }

  void take(const HeldRod::World& world) noexcept {
    for (std::size_t i = 0; i < rods(); ++i) rods_[i].take(world.shape(static_cast<int>(i)));
    contacts_ = static_cast<std::size_t>(world.contacts());
    for (std::size_t k = 0; k < contacts_; ++k) {
      const hapbeam::RodContact contact = world.contact(static_cast<int>(k));
      places_[k] = (contact.at[0] + contact.at[1]) / 2;
    }
  }

 private:
  std::vector<hapbeam::ServoPicture<double, 3>> rods_;
  std::array<Eigen::Vector3d, std::size_t(HeldRod::World::most_contacts)> places_;
  std::size_t contacts_ = 0;
};

inline void show(const WorldPicture& picture, DrawnBody& body) {
  body.beams.resize(picture.rods(), body.beams[0]);
  for (std::size_t i = 0; i < picture.rods(); ++i) body.beams[i].shape = picture.shape(i);
  body.contacts.clear();
  for (std::size_t k = 0; k < picture.contacts(); ++k) body.contacts.push_back(picture.contact(k));
}

}  // namespace phantom

namespace hapbeam {

template <>
class Touch<phantom::HeldRod> {
 public:
  using Scalar = double;
  static constexpr int dimension = 3;

  Touch(phantom::HeldRod& rod, double) noexcept
      : world_(rod.world()),
        tool_(world_, world_.rods() - 1),
        grip_(tool_, RodSide::left),
        held_(grip_),
        coupling_(rod.coupling()) {
    reset();
  }

  /// The hand has the end where it is at rest.
  void reset() noexcept {
    held_.reset(), coupling_.reset();
    HandPose hand;
    hand.place = held_.end().place;
    (void)held_.follow(hand);
  }

  /// Once a period.   @param hand  [m]   @param dt  [s]   @return with the place of the first rod that is pressed most
  [[nodiscard]] CoupledForce<double, 3> lead(const phantom::Coupling&, const Eigen::Vector3d& hand,
                                             double dt) noexcept {
    HandPose pose;
    pose.place = hand;
    CoupledForce<double, 3> felt = coupling_.tick(held_, pose, dt);
    felt.touch.pressing = world_.contacts() > 0;
    double largest = 0;
    for (int k = 0; k < world_.contacts(); ++k) {
      const RodContact contact = world_.contact(k);
      const double force = contact.force.norm();
      if (!(force > largest)) continue;
      largest = force;
      const std::size_t first = contact.rod[0] == 0 ? 0 : 1;
      const Eigen::Vector3d normal = (first == 0 ? -1 : 1) * contact.force / force;
      felt.touch.press = {contact.s[first], normal.dot(contact.at[first])};
    }
    return felt;
  }

 private:
  using Tool = phantom::HeldRod::Tool;
  phantom::HeldRod::World& world_;
  Tool tool_;
  Grip<Tool> grip_;
  Touch<Grip<Tool>> held_;
  GripCoupling coupling_;
};

template <>
struct Drawn<phantom::HeldRod> {
  using Picture = phantom::WorldPicture;
  static constexpr bool for_who_looks = false;
  static const auto& of(const phantom::HeldRod& rod, const Touch<phantom::HeldRod>&) noexcept {
    return rod.world();
  }
};

}  // namespace hapbeam
