// A beam is laid on a circle: a push whose place and direction are found with the equilibrium.
//
// The mesh has its node where the two were thought to touch, and follows where they do if that is not beside it.  A hand that goes on as it went finds
// the beam where it was foreseen.  Where the beam bends as sharply as the circle, or may, beside a support, a plane stands for the circle and turns
// from push to push.
// Allocates at construction.  Real-time: all else is noexcept and allocation-free; a push takes at most the linear solves of AllDisplacements.
#pragma once

#include <algorithm>
#include <cmath>

#include <hapbeam/centreline.hpp>
#include <hapbeam/fem/circle_on_curve.hpp>
#include <hapbeam/fem/contact_mesh.hpp>
#include <hapbeam/fem/contact_search.hpp>
#include <hapbeam/fem/foresight.hpp>
#include <hapbeam/force_model.hpp>

namespace hapbeam::detail {

template <class System>
class CirclePush {
  using Scalar = typename System::Scalar;
  using Node = typename System::Node;
  using Round = CircleOnCurve<Scalar>;

 public:
  /// Of the beam's length: so far from its node a contact is as exact as at it, to a few 1e-6 of the force.
  static constexpr Scalar beside = Scalar(1.5e-4);
  /// And so is the force, in units of the solver's tolerance.
  static constexpr int slack = 100;
  /// So often the node follows the contact in a push.
  static constexpr int most_meshes = 4;

  explicit CirclePush(const System& system) : foresight_(system) {}

  /// To be called where something else moves the beam.
  void forget() noexcept {
    foresight_.forget();
    sharp_ = false;
  }

  /// @param way  AllDisplacements, which settles the system   @param range  says where a node can be
  template <class Way, class Extent>
  Pushed<Scalar> push(Way& way, const Circle<Scalar>& request, const Extent& range) noexcept {
    const System& system = way.system_;
    // On a curve that is too sharp for it the law holds at the node alone.
    const Scalar near = beside * system.length(), exactly = Scalar(1e-5) * request.reach;
    ContactSearch<Scalar> search;
    Vector2<Scalar> normal = Vector2<Scalar>::Zero();
    Scalar s = request.s;
    bool snapped = false;
    for (int meshes = 1;; ++meshes) {
      Trial trial{s, normal, meshes == 1};
      Pushed<Scalar> pushed = push_at(way, request, range, trial);
      snapped = snapped || pushed.status == Status::snapped;
      const Scalar off = std::max(std::abs(trial.ahead), trial.miss);
      const bool there = off <= (trial.by_plane ? exactly : near);
      if (there || meshes == most_meshes || !is_answer(pushed.status) || pushed.force >= 0) {
        pushed.miss = there ? Scalar(0) : off;
        if (snapped && pushed.status == Status::ok) pushed.status = Status::snapped;
        foresight_.know(pushed.status == Status::ok);
        return pushed;
      }
      typename ContactSearch<Scalar>::Aim next{s + trial.ahead, normal};
      if (trial.by_plane)
        next = search.after({next.s, pushed.normal},
                            {trial.ahead, request.reach * (trial.normal.x() * pushed.normal.y() -
                                                           trial.normal.y() * pushed.normal.x())});
      s = std::clamp(next.s, Scalar(0), system.length());
      normal = next.normal;
    }
  }

 private:
  struct Trial {
    Scalar s;  ///< [m] where the node goes
    Vector2<Scalar>
        normal;  ///< in: of the plane that stands for the circle, zero: of the node;  out: the one that was taken
    bool first;             ///< of its push
    bool by_plane = false;  ///< whether a plane stood for the circle
    Scalar ahead = 0;       ///< [m] from there to the contact
    Scalar miss = 0;        ///< [m] from the circle's centre to where it should be
  };

  /// A push with the node at trial.s, or at the end beside it.  At an end that slides along a wall the wall takes what does not
  /// act along it.
  template <class Way, class Extent>
  Pushed<Scalar> push_at(Way& way, const Circle<Scalar>& request, const Extent& range,
                         Trial& trial) noexcept {
    using std::abs;
    System& system = way.system_;
    const Scalar s = range.range().nearest({trial.s, 0}).s, length = system.length();
    const ContactMesh<Scalar> mesh = way.uniform_.at(range.node(s));
    const int c = mesh.node(), end = c == 0 ? -1 : c == system.elements() ? 1 : 0;
    const bool wall = range.on_wall(mesh.s()), outside = s != trial.s;
    // There a hand soon bends the beam more sharply than the mesh can show.
    const Scalar clear = 2 * request.reach;
    const bool beside_support =
        outside || s - range.range().left_support < clear || range.range().right_support - s < clear;
    const Scalar last = system.linear_reaction();
    // The contact's node; beside a support, where there is none, the place that takes its displacement.
    const auto at = [](const Centreline<Scalar>& line, Scalar position) {
      const Displacement<Scalar> moved = line.at(position);
      return Node{position, moved.u, moved.w, moved.theta};
    };
    const auto node = [&] { return outside ? at(system.centreline(), trial.s) : system.node(c); };
    const auto look = [&](const Node& seen) { return Round(request.centre, request.side, 0, end).at(seen); };
    const auto circle_here = [&] {
      const Scalar curvature = system.centreline().curvature(system.mesh().node());
      return Round(request.centre, request.side, curvature, end);
    };
    const Round last_circle = circle_here();
    bool foreseen = trial.first && foresight_.go_on(system, mesh, request.centre);
    Scalar across = 1;  // component of the force that the beam takes
    const auto aim = [&] {
      const Round circle =
          foreseen ? last_circle : circle_here();  // what is foreseen has no second derivative
      trial.by_plane = wall || beside_support || sharp_ || circle.sharp(request.reach);
      if (!trial.by_plane) return system.set_goal(c, -request.reach, circle);
      if (trial.normal.isZero(0) || wall) trial.normal = look(node()).normal;
      const Vector2<Scalar>& normal = trial.normal;
      const Scalar d =
          normal.x() * (request.centre.x() - trial.s) + normal.y() * request.centre.y() - request.reach;
      if (!wall) return system.set_goal(c, d, 0, normal);
      across = std::copysign(std::max(Scalar(0.5), abs(normal.y())), normal.y());
      system.set_goal(c, (d - normal.x() * system.node(c).u) / across);
    };

    Response<Scalar> response{0, Status::iteration_limit};
    bool past_end = false;
    if (foreseen) {
      response = way.settle_at_once(slack, aim);
      foreseen = response.status == Status::ok;
      if (!foreseen) {
        foresight_.go_back(system, last);
        trial.normal.setZero();
      }
    }
    if (!foreseen) {
      system.remesh(mesh);
      const auto start = look(node());
      past_end = start.past_end;
      const Scalar jump = abs(start.distance - request.reach);
      if (way.single_valued_ && jump > length / 1000 &&
          abs(look(at(system.view(way.rest_state_), mesh.s())).distance - request.reach) < jump) {
        way.to_rest();
        system.remesh(mesh);
      }
      response = way.settle(last, slack, aim);
    }

    const bool answer = is_answer(response.status);
    sharp_ = answer && circle_here().sharp(request.reach);
    // What is no answer may have left that mesh.
    const Node now = answer ? node() : at(system.centreline(), trial.s);
    const auto view = answer && !trial.by_plane ? system.contact() : look(now);
    Pushed<Scalar> pushed{response.force / across, response.status};
    pushed.past_end = answer ? view.past_end : past_end;
    pushed.point = request.centre - view.distance * view.normal;
    pushed.normal = view.normal;
    const Scalar touched = std::clamp(now.s + request.side * view.lever, Scalar(0), length);
    trial.ahead = touched - trial.s;
    pushed.s = trial.by_plane || !answer ? trial.s : touched;
    if (trial.by_plane) {
      const Scalar x = (request.centre.x() - now.s) - now.u, y = request.centre.y() - now.w;
      trial.miss = abs(trial.normal.x() * y - trial.normal.y() * x);
    }
    return pushed;
  }

  Foresight<System> foresight_;
  bool sharp_ = false;  // where the last circle touched
};

/// Of a beam that is not laid on circles.
struct NoCircle {
  template <class System>
  explicit NoCircle(const System&) noexcept {}
  void forget() noexcept {}
};

}  // namespace hapbeam::detail
