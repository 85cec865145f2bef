// What nodes that follow contacts do to the balance of friction, and how it is undone.
//
// A contact that goes on along the beam takes nodes of the mesh with it.  The energy of the beam changes by the configurational force of the mesh,
//
//   C = ∂V/∂s        s: arc position of the contact's node, and with it of those that share its parts of the beam;  all places are held
//
// and in a beam without a mesh it is C = -F·dr/ds, with F the force on the beam: what friction takes of the slip.  In a discrete beam a rest remains,
//
//   c = C/|dr/ds| + F·t        t: unit, along dr/ds
//
// of fourth order in the length of elements, as errors of the force are.  Hands that go round a closed path gain ∮ c |dr/ds| ds, whatever the step.
//
// So the surface that is touched is tilted against the beam's tangent, by c/N: then C is what friction takes.  That angle is mostly 10⁻⁶ to
// 10⁻³, changes slowly, and is learned from a push before.  The force on the hand stays across the avatar's surface.
// Only contacts beside others are tilted: the force of one that is alone stays what it was.
// Allocates at construction.  Real-time: all else is noexcept and allocation-free, O(elements) once in `every` pushes for each contact.
// Source: Eshelby, The elastic energy-momentum tensor, J. Elasticity 5 (1975); nodes as unknowns of an energy, Thoutireddy and Ortiz 2004.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace hapbeam::detail {

/// @tparam System  BeamSystem | RodSystem   @tparam Most  contacts
template <class System, int Most>
class ContactTilt {
  using Scalar = typename System::Scalar;
  using State = typename System::State;

 public:
  explicit ContactTilt(const System& system) : here_(system.elements()), moved_(system.elements()) {}
  /// To be called where something else moves the beam.
  void forget() noexcept { pushes_ = 0; }
  /// To be called in each push with friction, before learn().
  void begin() noexcept { pushes_ = (pushes_ + 1) % every; }

  /// To be called in an equilibrium.   @param i  of the obstacle   @param contact  its number in the system
  /// @param along  force on the beam [N]   @param normal_force  [N]   @param tilt  in: of this push;  out: for the next one [rad]
  void learn(int i, System& system, int contact, Scalar along, Scalar normal_force, Scalar& tilt) noexcept {
    const int node = system.round_node(contact);
    // In fewer digits round-off is more than that.
    if (std::numeric_limits<Scalar>::digits < 50 || node < 0 || system.mesh().count() == 1) {
      tilt = 0;
      return;
    }
    if ((pushes_ + i * every / Most) % every != 0) return;
    int k = 0;
    while (system.mesh().node(k) != node) ++k;
    const Scalar stretch = system.centreline().extrapolated_stretch(node),
                 rest = configurational_force(system, k) / stretch + along,
                 angle = tilt + rest / normal_force;
    if (std::isfinite(angle)) tilt = std::clamp(angle, -steepest, steepest);
  }

 private:
  static constexpr int every = 32;                    // pushes: a hand has gone little then
  static constexpr Scalar steepest = Scalar(5e-3);    // [rad]
  static constexpr Scalar difference = Scalar(3e-8);  // of the length

  /// C of what follows contact k of the mesh [N].
  Scalar configurational_force(System& system, int k) noexcept {
    const auto mesh = system.mesh();
    const Scalar h = difference * system.length(), force = system.linear_reaction();
    system.keep(here_), system.keep(moved_);
    const auto potential = [&](Scalar along) {
      const auto there = mesh.moved(k, along);
      System::label(there, moved_);
      system.go_back(there, moved_, force);
      return system.total_potential();
    };
    const Scalar ahead = potential(h), behind = potential(-h);
    system.go_back(mesh, here_, force);
    return (ahead - behind) / (2 * h);
  }

  State here_, moved_;
  int pushes_ = 0;
};

}  // namespace hapbeam::detail
