// Paths of equilibria, as ArcLength visits them, and where they turn back.
#pragma once

#include <utility>
#include <vector>

#include "support/arc_length.hpp"
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/fem/beam_system.hpp>

namespace hapbeam::testing {

struct Equilibrium {
  double load, way;     ///< λ, and whatever displacement is looked at
  double energy;        ///< strain energy
  int negative_pivots;  ///< of the tangent
};

struct Path {
  Status status;
  std::vector<Equilibrium> points;
};

/// The equations of a beam whose loads go where a test likes.
template <class Element = Corotational<>>
class System : public BeamSystem<Element, double, Eigen::Dynamic, Eigen::Dynamic> {
 public:
  using System::ChainSystem::ChainSystem;

  /// Lets go of the contact, places the ends and sets the factor λ on all dead loads.
  void set_load(double factor) noexcept {
    this->set_goal();
    this->set_target(1);
    this->load_ = factor;
  }
  double load() const noexcept { return this->load_; }
};

/// Lays the beam along the x axis, wherever its supports are placed: where a naive solve begins.  @param length  [m]
template <class Element>
void lay_straight(System<Element>& system, double length) {
  typename System<Element>::State straight(system.elements());
  for (int i = 0; i <= system.elements(); ++i) straight.nodes[i] = {length * i / system.elements(), 0, 0, 0};
  system.go_back(straight, 0);
  system.find_tensions();
}

/// Follows a beam's path from λ = 0.  @param way  system -> displacement   @param go_on  Equilibrium -> bool
template <class Element = Corotational<>, class Way, class GoOn>
Path follow(const Beam& beam, int elements, double step, Way&& way, GoOn&& go_on) {
  System<Element> system(beam, elements);
  ArcLength arc;
  arc.first_step = arc.largest_step = step;
  Path path;
  path.status = arc.solve(system, [&](const System<Element>& at, const PathPoint& point) {
    path.points.push_back({point.load, way(at), at.strain_energy(), point.negative_pivots});
    return path.points.size() < 5000 && go_on(path.points.back());
  });
  return path;
}

/// A place of a list where what rises begins to fall, or the other way round.
struct Turn {
  std::size_t index;  ///< the point nearest to it
  double extreme;     ///< of what turns
  double other;       ///< where
};

/// Where f turns as g goes on, each from the parabola through three points: off by the cube of their distance.
template <class List, class F, class G>
std::vector<Turn> turns(const List& points, F&& f, G&& g) {
  std::vector<Turn> found;
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    const double a = f(points[i - 1]) - f(points[i]), b = f(points[i + 1]) - f(points[i]);
    if (!(a * b > 0)) continue;
    const double p = g(points[i - 1]) - g(points[i]), q = g(points[i + 1]) - g(points[i]);
    const double second = (a / p - b / q) / (p - q), first = a / p - second * p, at = -first / (2 * second);
    found.push_back({i, f(points[i]) + first * at / 2, g(points[i]) + at});
  }
  return found;
}

inline std::vector<Turn> load_turns(const Path& path) {
  return turns(
      path.points, [](const Equilibrium& e) { return e.load; }, [](const Equilibrium& e) { return e.way; });
}

}  // namespace hapbeam::testing
