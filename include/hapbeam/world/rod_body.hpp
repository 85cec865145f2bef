// SPDX-License-Identifier: MIT
// One rod of a World: its chain of elements, its factor, what touches it, and what holds its ends.
//
// What holds an end comes from the linear equations of the last increment,  r + K Δx + B u  of its node, less its springs: anew from rounded places it
// would have EA ε/l of round-off.
// Allocates and throws at construction; every other member is noexcept and allocation-free, O(n).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include <hapbeam/check.hpp>
#include <hapbeam/contact/box.hpp>
#include <hapbeam/fem/motion/chain_motion.hpp>
#include <hapbeam/fem/rod_system.hpp>
#include <hapbeam/fem/solver/load_path.hpp>
#include <hapbeam/fem/solver/newton_raphson.hpp>
#include <hapbeam/world/pair_sides.hpp>

namespace hapbeam::detail {

/// @tparam Element  RoundRod | TwistedRod
template <class Element>
class RodBody {
 public:
  using System = RodSystem<Element, double, Eigen::Dynamic, Eigen::Dynamic>;
  using Chain = typename System::Chain;
  using State = typename System::State;
  using Sides = PairSides<Chain>;
  using Motion = ChainMotion<System, Eigen::Dynamic, Eigen::Dynamic>;
  using Vector = VectorOf<double, 3>;
  using Hand = VectorOf<double, 18>;  // both ends: at, along and director times the length [m]

  /// In its shape at rest, or where its ends do not hold it in its natural shape, or through given points.
  /// @throws std::invalid_argument as ChainSystem, and where the rod has no shape at rest
  RodBody(const Rod& rod, int elements, PairEquations& equations, const std::vector<Vector>& through = {})
      : sides(elements, equations),
        saved(elements),
        before(elements),
        system_(rod, elements),
        assembler_(elements),
        rest_(elements),
        swept_(BoxTree<double, 3>::leaves_for(elements)),
        radius_(rod.thickness() / 2) {
    if (rod.mass_per_length(rod.length() / 2) > 0) {
      chain().parts().swing();
      motion.emplace(rod, elements, system_);
    }
    if (!through.empty()) lay(through);
    else if (rod.held()) find_rest();
    keep_rest();
    reset();
  }
  /// It rests as it lies.
  void keep_rest() noexcept { system_.keep(rest_); }

  System& system() noexcept { return system_; }
  const System& system() const noexcept { return system_; }
  Chain& chain() noexcept { return system_.chain(); }
  double radius() const noexcept { return radius_; }
  const typename Chain::Parts& parts() const noexcept { return system_.chain().parts(); }
  auto line() const noexcept { return system_.centreline(); }
  /// Of the true curve at s, where a force acts on it.
  typename Sides::Side::Point point(double s, const Vector& force, bool rough) const noexcept {
    return Sides::Side::point(parts(), line().segment_at(s), s, force, rough);
  }
  /// What a force at another place adds to that, where it is in the same element.
  void bend(typename Sides::Side::Point& at, double s, double other, const Vector& force,
            const std::array<bool, 2>& rough) const noexcept {
    const int e = line().segment_at(s);
    if (line().segment_at(other) == e) Sides::Side::bend(at, parts(), e, s, other, force, rough);
  }
  int elements() const noexcept { return system_.elements(); }
  double length() const noexcept { return system_.length(); }

  void reset() noexcept {
    restart();
    for (std::size_t k = 0; k < 2; ++k) chain().ends()[k].place_home();
    if (motion) motion->ends.stay(chain());
    for (auto& force : held_) force.setZero();
    hand_.setZero(), hand_next_.setZero(), step_.setZero();
  }
  /// Back to rest, from where its ends go to where they are held.
  void restart() noexcept {
    system_.set_state(rest_);
    chain().go_home();
    save();
    system_.keep(before);
    moves = true;
  }
  void save() noexcept { system_.keep(saved); }
  void restore() noexcept { system_.set_state(saved); }

  // The path of its ends.

  /// @param damper  in motion   @return whether the end can be placed, and the pose is one
  bool place_end(std::size_t k, RodPose pose, const HoldDamper& damper) noexcept {
    if ((motion && !motion->ends.lead(chain(), k, pose, damper)) || !chain().place_end(k, pose)) return false;
    (void)pose.make_valid();
    hand_next_.segment<9>(9 * static_cast<int>(k)) << pose.at, length() * pose.along,
        length() * pose.director;
    moves = moves || hand_next_ != hand_;
    return true;
  }
  void begin_path() noexcept { chain().ends().begin_path(chain().parts().nodes()); }
  /// In a step of time its ends are led by that.
  void set_target(double t) noexcept {
    if (!chain().in_motion()) chain().ends().set_target(t);
  }
  /// Of the hands since the last one: its product with the one before, and the squares of both.
  std::array<double, 3> take_step() noexcept {
    const Hand step = hand_next_ - hand_;
    const std::array<double, 3> products{step.dot(step_), step.squaredNorm(), step_.squaredNorm()};
    hand_ = hand_next_, step_ = step;
    return products;
  }
  /// From the last equilibrium so many times as far as from the one before to that.
  void go_on(double ratio) noexcept {
    if (ratio > 0) system_.go_on(before, ratio);
    else system_.keep(before);
  }

  // Its equations.

  struct Energies {
    double measured, inner;  ///< as of ChainEnergies [J]
    Status status;
  };
  Energies assemble(double shift) noexcept {
    auto& nodes = chain().parts().nodes();
    if (!chain().ends().follow(nodes)) return {0, 0, Status::iteration_limit};
    const ChainEnergies<double> energies = chain().assemble(1, sides, assembler_);
    if (shift != 0) system_.add_shift(shift, assembler_);
    for (std::size_t k = 0; k < 2; ++k) {
      if (chain().ends()[k].is_free()) continue;
      const int i = chain().ends().node(k);
      End& end = ends_[k];
      assembler_.row_of(i, beside(i), end.own, end.coupled);
      for (int c = 0; c < unknowns; ++c) end.residual[c] = assembler_.residual(i, c);
    }
    chain().ends().hold(nodes, sides, assembler_);
    return {energies.measured, energies.inner, assembler_.factor()};
  }
  int negative_pivots() const noexcept { return assembler_.negative_pivots(); }
  void eliminate() noexcept { sides.eliminate(assembler_); }
  /// @return ΔᵀKΔ [J]
  double substitute() noexcept {
    const double energy = assembler_.energy() + sides.substitute(assembler_);
    assembler_.substitute();
    return energy;
  }
  /// Of a node in the last increment [m].
  Vector moved(int node) const noexcept { return increment(node).template head<3>(); }
  /// Rotation of a node in it [rad].
  Vector turned(int node) const noexcept {
    const Increment by = increment(node);
    const Vector& t = system_.node(node).tangent;
    Vector turn = cross3<double>(t, by.template segment<3>(3)) / t.squaredNorm();
    if constexpr (unknowns == 7) turn += by[6] * unit(t);
    return turn;
  }
  /// As of ChainSystem.
  bool folded() const noexcept { return system_.folded(rest_); }
  /// Largest rotation of a node in the last increment [rad].
  double turn() const noexcept {
    double largest = 0;
    for (int i = 0; i <= elements(); ++i)
      largest = (std::max)(largest, Chain::turn(system_.node(i), increment(i)));
    return largest;
  }
  void advance() noexcept {
    for (std::size_t k = 0; k < 2; ++k) {
      if (chain().ends()[k].is_free()) continue;
      const int i = chain().ends().node(k);
      const End& end = ends_[k];
      const auto pushed = sides.pushed(i == 0 ? 0 : i - 1);
      held_[k] = end.residual + end.own * increment(i) + end.coupled * increment(beside(i)) +
                 pushed.template segment<unknowns>(i == 0 ? 0 : unknowns);
    }
    (void)chain().advance(assembler_, sides, [](double, int e) { return e; });
  }
  /// What holds an end: force [N] and moment about it [N·m].
  std::array<Vector, 2> held(std::size_t k) noexcept {
    Increment at = held_[k];
    const auto& nodes = chain().parts().nodes();
    (void)chain().ends().visit_springs(nodes, [&](int i, const Block&, const Increment& r) {
      if (i == chain().ends().node(k)) at -= r;
    });
    return {at.template segment<3>(0), Chain::Parts::moment(at, nodes[chain().ends().node(k)].tangent)};
  }

  // How it has moved since save().

  const BoxTree<double, 3>& swept() const noexcept { return swept_; }
  auto saved_line() const noexcept { return system_.view(saved); }
  CubicSegment<double, 3> saved_segment(int e) const noexcept { return saved_line().segment(e); }
  void sweep() noexcept {
    if (swept_at_rest_ && !moves) return;
    swept_at_rest_ = !moves;
    const auto now = line(), then = system_.view(saved);
    swept_.resize(elements());
    int leaf = -1, end = 0;
    for (int e = 0; e < elements(); ++e) {
      if (e == end) swept_.leaf(++leaf) = {}, end = swept_.first(leaf + 1);
      swept_.leaf(leaf).include(now.segment(e));
      if (moves) swept_.leaf(leaf).include(then.segment(e));
    }
    swept_.join();
  }

  bool moves = true;  // it is solved for
  Sides sides;
  std::optional<Motion> motion;  // of a rod with mass
  State saved, before;           // of the last equilibrium, and of that of the tick before

 private:
  static constexpr int unknowns = Element::unknowns;
  /// Through points, with the tangents of circles through three of them, and its ends where they hold it.
  /// @throws std::invalid_argument where there are fewer, or two that follow each other are one
  void lay(const std::vector<Vector>& points) {
    if (points.size() < 3) reject("rod through", double(points.size()), "points", "three or more");
    std::vector<Vector> chords;
    std::vector<double> lengths;
    for (std::size_t i = 1; i < points.size(); ++i) {
      chords.push_back(points[i] - points[i - 1]);
      lengths.push_back(positive("distance of two points", std::sqrt(chords.back().squaredNorm()), "m"));
    }
    std::vector<RodNode<double>> nodes;
    double s = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const std::size_t in = i > 0 ? i - 1 : i, out = i < chords.size() ? i : in;
      const Vector t =
          unit(Vector(lengths[out] / lengths[in] * chords[in] + lengths[in] / lengths[out] * chords[out]));
      const Vector d1 = i == 0 ? detail::beside(t)
                               : across<double>(carry(nodes.back().director, nodes.back().tangent, t), t);
      nodes.push_back({s, points[i], t, d1});
      if (i < lengths.size()) s += lengths[i];
    }
    for (RodNode<double>& node : nodes) node.s *= length() / s, node.tangent *= s / length();
    chain().lay({nodes.data(), static_cast<int>(nodes.size())});
    chain().go_home();
    chain().ends().correct(chain().parts().nodes());
  }
  void find_rest() {
    system_.set_goal();
    SolveReport<double> report = LoadPath{}.solve(system_).report;
    if (is_answer(report.status)) {
      system_.set_goal();
      report = NewtonRaphson{}.solve(system_);
    }
    if (!is_answer(report.status)) detail::refuse("rod: no shape at rest was found, %s", name(report.status));
  }
  using Increment = VectorOf<double, unknowns>;
  using Block = Eigen::Matrix<double, unknowns, unknowns>;
  struct End {
    Block own, coupled;
    Increment residual;
  };
  int beside(int i) const noexcept { return i == 0 ? 1 : i - 1; }
  Increment increment(int i) const noexcept { return system_.chain().increment(assembler_, i); }

  System system_;
  typename Chain::Assembler assembler_;
  State rest_;
  BoxTree<double, 3> swept_;
  bool swept_at_rest_ = false;
  double radius_;
  std::array<End, 2> ends_;
  std::array<Increment, 2> held_;
  Hand hand_, hand_next_, step_;  // of the last tick, of the next, and between the last two
};

}  // namespace hapbeam::detail
