// Rules by which people step a beam with mass, on the elements and the mass of DynamicModel, which has TrBdf2.
//
//   M q" + V'(q) = 0        each step is one static solve with an inertia, V(x) + ½ c |q - q~|²_M, by Newton's method
//
// A rule says where q~ and c are, and how a node moves where the step has been solved.  Undamped, without a hand.
#pragma once

#include <utility>
#include <vector>

#include <hapbeam/fem/dynamic_model.hpp>

namespace hapbeam::testing {

using Placed = detail::Placed<double>;

/// A node at the end of a step: place and tangent, their rate, and their acceleration.
struct Moving {
  Placed q = Placed::Zero(), v = Placed::Zero(), a = Placed::Zero();
  Placed true_a = Placed::Zero();  ///< in equilibrium with the forces; a is what the rule goes on with
};

/// The first backward difference.
struct BackwardEuler {
  static double rate(double h) noexcept { return 1 / (h * h); }
  static Placed ghost(const Moving& now, const Moving&, double h) noexcept { return now.q + h * now.v; }
  static Moving next(const Moving& now, const Moving&, const Placed& q, const Placed& a, double h) noexcept {
    return {q, (q - now.q) / h, a, a};
  }
};
/// The second.
struct Bdf2 {
  static double rate(double h) noexcept { return 9 / (4 * h * h); }
  static Placed ghost(const Moving& now, const Moving& before, double h) noexcept {
    return (4 * now.q - before.q) / 3 + 2 * h / 9 * (4 * now.v - before.v);
  }
  static Moving next(const Moving& now, const Moving& before, const Placed& q, const Placed& a,
                     double h) noexcept {
    return {q, (3 * q - 4 * now.q + before.q) / (2 * h), a, a};
  }
};
/// Chung and Hulbert, J. Appl. Mech. 60, 1993, with a spectral radius at infinity of ρ, as Arnold and Brüls, Multibody Syst. Dyn. 18, 2007.
struct GeneralizedAlpha {
  double am, af, gamma, beta;
  GeneralizedAlpha(double rho = 0.9)
      : am((2 * rho - 1) / (rho + 1)),
        af(rho / (rho + 1)),
        gamma(0.5 - am + af),
        beta((gamma + 0.5) * (gamma + 0.5) / 4) {}
  double rate(double h) const noexcept { return (1 - am) / (h * h * beta * (1 - af)); }
  Placed ghost(const Moving& now, const Moving&, double h) const noexcept {
    return now.q + h * now.v +
           h * h * ((0.5 - beta) * now.a + beta * (af * now.true_a - am * now.a) / (1 - am));
  }
  Moving next(const Moving& now, const Moving&, const Placed& q, const Placed& a, double h) const noexcept {
    const Placed next = ((1 - af) * a + af * now.true_a - am * now.a) / (1 - am);
    return {q, now.v + h * ((1 - gamma) * now.a + gamma * next), next, a};
  }
};
/// Newmark's of constant average acceleration: the trapezoidal rule.
struct AverageAcceleration {
  static double rate(double h) noexcept { return 4 / (h * h); }
  static Placed ghost(const Moving& now, const Moving&, double h) noexcept {
    return now.q + h * now.v + h * h / 4 * now.a;
  }
  static Moving next(const Moving& now, const Moving&, const Placed& q, const Placed& a, double h) noexcept {
    return {q, now.v + h / 2 * (now.a + a), a, a};
  }
};

/// A beam that was let go from another shape, by such a rule.
template <class Rule>
class Swing {
 public:
  /// @param shape  of the same mesh
  Swing(const Beam& beam, int elements, const Centreline<double>& shape, Rule rule = Rule())
      : rule_(rule),
        system_(beam, elements),
        inertia_(beam, elements, [this](int i) { return system_.node(i).s; }),
        now_(static_cast<std::size_t>(elements) + 1),
        before_(now_) {
    inertia_.draw(system_.parts().nodes());
    system_.chain().lay(shape);
    system_.set_goal();
    system_.set_target(1);
    const auto& at = inertia_.find(system_.parts().nodes());
    for (std::size_t i = 0; i < now_.size(); ++i) now_[i].q = at[static_cast<int>(i)];
    before_ = now_;
    system_.chain().move_with(&inertia_, nullptr);
  }

  /// @param h  always the same [s]   @return false where Newton's method has found no equilibrium
  bool step(double h) noexcept {
    if (!started_) {
      started_ = true;
      // The accelerations with which it begins: those of a hundredth of a step.
      const std::vector<Moving> start = now_;
      if (!go(BackwardEuler{}, h / 100)) return false;
      for (std::size_t i = 0; i < now_.size(); ++i)
        now_[i] = {start[i].q, start[i].v, now_[i].a, now_[i].a}, before_[i] = now_[i];
      if (std::is_same_v<Rule, Bdf2>) return go(BackwardEuler{}, h);
    }
    return go(rule_, h);
  }
  Vector2<double> tip() const { return system_.centreline().position(system_.length()); }
  double energy() const {
    return system_.strain_energy() +
           inertia_.energy([this](int i) -> const Placed& { return now_[static_cast<std::size_t>(i)].v; });
  }

 private:
  template <class AnyRule>
  bool go(const AnyRule& rule, double h) noexcept {
    inertia_.set_rate(rule.rate(h));
    inertia_.set_scale(energy());
    for (std::size_t i = 0; i < now_.size(); ++i)
      inertia_.ghost()[static_cast<int>(i)] = rule.ghost(now_[i], before_[i], h);
    NewtonRaphson solver;
    solver.relative_tolerance = 1e-9;
    if (solver.solve(system_).status != Status::ok) return false;
    const auto& q = inertia_.find(system_.parts().nodes());
    for (std::size_t i = 0; i < now_.size(); ++i) {
      const Placed &at = q[static_cast<int>(i)], a = rule.rate(h) * (at - rule.ghost(now_[i], before_[i], h));
      before_[i] = std::exchange(now_[i], rule.next(now_[i], before_[i], at, a, h));
    }
    return true;
  }

  Rule rule_;
  BeamSystem<Corotational<VonKarman<AssumedStrain>>, double, Eigen::Dynamic, Eigen::Dynamic> system_;
  detail::Inertia<double, Eigen::Dynamic, Eigen::Dynamic> inertia_;
  std::vector<Moving> now_, before_;
  bool started_ = false;
};

/// DynamicModel, called as a Swing.
class LibrarySwing {
 public:
  LibrarySwing(const Beam& beam, int elements, const Centreline<double>& shape) : model_(beam, elements, 1) {
    model_.let_go_from(shape);
  }
  bool step(double h) noexcept { return model_.step(h) == Status::ok; }
  Vector2<double> tip() const { return model_.shape().position(model_.shape().length()); }
  double energy() const { return model_.energy().sum(); }

 private:
  DynamicModel<> model_;
};

/// A steel ruler of 300 x 25 x 1 mm, clamped at one end, which is let go by a hand that has held its other end with 12 N, 170 mm aside.
class LetGo {
 public:
  LetGo()
      : ruler_(0.3, Section::rectangle(0.025, 0.001), Material{200e9, 7850}, Support::clamped, Support::free),
        held_(held(), elements) {}

  template <class Rule>
  Swing<Rule> by(const Rule& rule) const {
    return {ruler_, elements, held_.shape(), rule};
  }
  LibrarySwing by_library() const { return {ruler_, elements, held_.shape()}; }

 private:
  static constexpr int elements = 8;
  Beam held() const {
    Beam beam = ruler_;
    beam.add(PointLoad{beam.length(), 0, -12, 0});
    return beam;
  }

  Beam ruler_;
  FemModel<Corotational<VonKarman<AssumedStrain>>> held_;
};

}  // namespace hapbeam::testing
