// SPDX-License-Identifier: MIT
// What a ChainSystem in motion has beside its equations: its inertia, what is viscous, the rule of its steps, and ends that hands lead.
//
// A step goes on in parts, each of the two stages of TrBdf2.  Where a part has no answer it is taken back and halved.
// Allocates and throws at construction; all else is noexcept and allocation-free, O(n).
#pragma once

#include <array>

#include <hapbeam/element/hermite.hpp>
#include <hapbeam/fem/motion/tr_bdf2.hpp>
#include <hapbeam/fem/system.hpp>

namespace hapbeam {

/// Of a beam, or of all rods of a World.
template <typename S>
struct EnergyInMotion {
  S kinetic, strain, loads;  ///< [J], the last of the dead loads
  S sum() const noexcept { return kinetic + strain + loads; }
};

/// No step is longer: what a late tick has missed is left out [s].
inline constexpr double longest_step = 2e-3;

namespace detail {

template <class System, int Elements, int MaxElements>
class ChainMotion {
  using Chain = typename System::Chain;
  using S = typename System::Scalar;
  using Inertia = typename Chain::Inertia;
  using Viscosity = typename Chain::Viscosity;
  using Placed = typename Inertia::Placed;
  static constexpr int dimension = System::dimension;

 public:
  using Step = TrBdf2<S, Elements, MaxElements, Placed::RowsAtCompileTime>;

  /// @param system  here and below the chain that moves
  ChainMotion(const typename Chain::Body& body, int elements, const System& system)
      : step(elements),
        inertia_(body, elements, [&system](int i) { return system.node(i).s; }),
        viscosity_(body, elements, system.parts()),
        before_(elements),
        last_(elements),
        drag_(static_cast<S>(body.damping().drag)),
        massless_(!(body.mass_per_length(body.length() / 2) > 0)) {}

  bool massless() const noexcept { return massless_; }
  /// Null: none, as the equations take it.
  Inertia* inertia() noexcept { return massless_ ? nullptr : &inertia_; }
  const Inertia* inertia() const noexcept { return massless_ ? nullptr : &inertia_; }
  const Viscosity* viscosity() const noexcept { return viscosity_.none() ? nullptr : &viscosity_; }

  /// At rest as it lies.
  void begin(System& system) noexcept {
    system.keep(last_);
    inertia_.begin_stage(last_.nodes, [](int) { return Placed(Placed::Zero()); });
    stop(system);
    viscosity_.relax(system.chain().parts());
  }
  /// Planar ones once, as they lie at rest: Inertia::draw().
  void draw(const System& system) noexcept { inertia_.draw(system.parts().nodes()); }
  /// All velocity is gone.
  void stop(const System& system) noexcept {
    const auto& at = inertia_.find(system.parts().nodes());
    step.stop([&at](int i) { return at[i]; });
    viscosity_.stop();
  }
  void begin_part(const System& system, S dt) noexcept {
    system.keep(before_);
    step.begin(dt, drag_);
    viscosity_.begin();
    inertia_.set_scale(kinetic());
  }
  void take_back(System& system) noexcept {
    system.set_state(before_);
    step.take_back();
    viscosity_.take_back();
  }
  /// Back to where the last part began, with the accelerations and rates behind it.
  void start_again(System& system) noexcept {
    step.start_again();
    viscosity_.start_again();
    system.set_state(before_);
  }
  /// To be called before a stage is solved.   @param foresees  whether nodes begin where their accelerations lead, else where they are:
  /// beyond a sudden change those lead far off
  void aim(System& system, int stage, bool foresees) noexcept {
    step.aim(stage, inertia_);
    viscosity_.aim(stage, step, system.chain().parts());
    // Tensions go on as they went, and nodes as their accelerations say.
    system.go_on(last_, foresees ? step.onward(stage) : S(0));
    inertia_.begin_stage(last_.nodes, [&](int i) { return step.start(stage, i).q; });
    if (foresees)
      system.place([&](int i) {
        return Chain::moved(last_.nodes[i], step.start(stage, i).q, step.foreseen(stage, i));
      });
  }
  /// To be called where the stage has been solved.
  void know(const System& system, int stage) noexcept {
    const auto& at = inertia_.find(system.parts().nodes());
    for (int i = 0; i <= system.elements(); ++i) step.know(stage, i, at[i]);
    viscosity_.know(stage, system.parts());
  }

  S kinetic() const noexcept {
    return inertia_.energy([this](int i) -> const auto& { return step[i].v; });
  }
  /// What viscous material holds beside the elements [J].
  S stored() const noexcept { return viscosity_.energy(); }
  /// [m/s] at arc position s.
  VectorOf<S, dimension> velocity(const System& system, S s) const noexcept {
    const auto line = system.centreline();
    const int e = line.segment_at(s);
    const S l = line[e + 1].s - line[e].s;
    const auto h = ShapeFunctions<S>((s - line[e].s) / l, l).w;  // of θ, which is -w'
    const auto &a = step[e].v, &b = step[e + 1].v;
    return h[0] * a.template head<dimension>() - h[1] * a.template segment<dimension>(dimension) +
           h[2] * b.template head<dimension>() - h[3] * b.template segment<dimension>(dimension);
  }

  Step step;
  typename Chain::LedEnds ends;
  std::array<Curvature<S>, 2> curvature{};  // of both stages

 private:
  Inertia inertia_;
  Viscosity viscosity_;
  typename System::State before_, last_;  // before a part, and before the last stage
  S drag_;
  bool massless_;
};

inline constexpr int most_halvings = 3;

/// A part of a step.   @param moving  of which it calls begin_part(), solve(), end_part() and take_back()   @param begin, end  of the way of the hands in it
/// @return whether it has an answer
template <class Moving, typename S>
bool go_on(Moving& moving, S dt, S begin, S end, int halvings) noexcept {
  const auto kept = moving.begin_part(dt, begin);
  bool found = true;
  S from = begin;
  for (int stage = 0; stage < Moving::Step::stages && found; ++stage) {
    const S to = begin + Moving::Step::end(stage) * (end - begin);
    found = moving.solve(stage, from, to, halvings == 0), from = to;
  }
  if (found) return moving.end_part(end), true;
  moving.take_back(kept);
  const S middle = (begin + end) / 2;
  return halvings < most_halvings && go_on(moving, dt / 2, begin, middle, halvings + 1) &&
         go_on(moving, dt / 2, middle, end, halvings + 1);
}
/// From rest it has the accelerations and rates that a hundredth of the first part has.   @param end  of the way of the hands
template <class Moving, typename S>
bool start(Moving& moving, S part, S end, int halvings) noexcept {
  return go_on(moving, part / 100, S(0), end, halvings) && (moving.start_again(), true);
}

}  // namespace detail

}  // namespace hapbeam
