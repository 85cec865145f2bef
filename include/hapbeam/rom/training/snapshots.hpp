// SPDX-License-Identifier: MIT
// Presses of a full model, taken for training: on a grid of depths, or of tensions.
//
// Threads share the positions, each with its own copy of the model. A press that the full model does not answer with ok
// fails the training: none is left out or used with another status.
// Offline: allocates; throws std::invalid_argument for a plan that cannot be carried out and TrainingError for a press.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include <hapbeam/force_model.hpp>
#include <hapbeam/rom/trained/coordinates.hpp>
#include <hapbeam/rom/trained/lagrange.hpp>
#include <hapbeam/rom/training/training_plan.hpp>

namespace hapbeam {

/// One press of the full model.
struct Snapshot {
  double s;                                   ///< [m]
  double d;                                   ///< [m]
  double force;                               ///< [N]
  double stiffness;                           ///< [N/m] F/(d - w), w of the untouched beam
  std::vector<CentrelineNode<double>> nodes;  ///< the shape at the nodes of a ContactFrame
};

struct Snapshots {
  BeamData<double> beam;
  TrainingPlan plan;
  std::string nodes;  ///< name() of the policy that placed them
  int contact_node;
  double y_low = 0, y_high = 0;         ///< of DepthCoordinate; 0 where tensions were trained
  double tension = 0;                   ///< [N] largest trained; 0 where depths were, or none arises
  int columns = 0;                      ///< depths or tensions at each position
  std::vector<Snapshot> grid = {};      ///< position by position
  std::vector<double> rest = {};        ///< w of the untouched beam by position [m]
  std::vector<double> rest_shape = {};  ///< (u, w, θ) of the untouched beam at even nodes
};

namespace detail {

template <class Nodes, class Model>
class SnapshotTaker {
 public:
  SnapshotTaker(const Beam& beam, const Model& full, const TrainingPlan& plan, const TrainingOptions& options)
      : full_(full),
        options_(options),
        out_{BeamData<double>::of(beam), plan.check(beam), Nodes::name(), plan.contact_node(beam)},
        frame_(out_.beam, plan.segments, out_.contact_node),
        x_(plan.positions, position(plan.s_min), position(plan.s_max)) {
    static_assert(is_force_model<Model> && std::is_same_v<typename Model::Scalar, double>,
                  "a full model is a ForceModel of doubles: see hapbeam/force_model.hpp");
    check_same_beam(beam, full, plan);
    out_.columns = plan.depths;
    full_.reset();
    const auto shape = full_.shape();
    bool loaded = false;
    for (int i = 0; i <= plan.segments; ++i) {
      const auto at = shape.at(shape.length() * i / plan.segments);
      // Between the nodes of an element of finite rotation there is round-off.
      for (const double value : {at.u, at.w, at.theta * out_.beam.length})
        loaded = loaded || std::abs(value) > 1e-9 * plan.depth;
      for (const double value : {at.u, at.w, at.theta}) out_.rest_shape.push_back(value);
    }
    if (!loaded) std::fill(out_.rest_shape.begin(), out_.rest_shape.end(), 0.0);
    if (loaded && plan.symmetric) refuse("symmetric = true: must be false for a beam under dead loads");
    for (int i = 0; i < plan.positions; ++i) {
      const double rest = shape.at(s(i)).w;
      if (std::abs(rest) >= plan.depth)
        reject("depth", plan.depth, "m", "more than dead loads bend the beam");
      out_.rest.push_back(rest);
    }
    // The corners of the range, where a grid has no node: what cannot be answered there is told before the work is done.
    for (const double at : {edge(plan.s_min), edge(plan.s_max)})
      for (const double d : {plan.depth, -plan.depth}) {
        full_.reset();
        press_for_training(full_, at, d);
      }
  }

  Snapshots by_depth() {
    const TrainingPlan& plan = out_.plan;
    const DepthCoordinate<double> coordinate(out_.beam, plan.symmetric);
    const auto [low, high] = std::minmax_element(out_.rest.begin(), out_.rest.end());
    out_.y_low = plan.symmetric ? 0 : coordinate(-plan.depth - *high);
    out_.y_high = coordinate(plan.depth - *low);
    const Lagrange<Nodes> y(plan.depths, out_.y_low, out_.y_high);
    out_.grid.resize(static_cast<std::size_t>(plan.positions * out_.columns));
    for_each_position(full_, plan.positions, options_.threads, [&](Model& model, int i) {
      const double rest = out_.rest[static_cast<std::size_t>(i)];
      // From rest outward to either side, as a hand would.
      int first = 0;
      while (first < plan.depths - 1 && y.node(first) < 0) ++first;
      model.reset();
      for (int j = first; j < plan.depths; ++j) take(model, i, j, rest, coordinate.inverse(y.node(j)));
      model.reset();
      for (int j = first - 1; j >= 0; --j) take(model, i, j, rest, coordinate.inverse(y.node(j)));
    });
    return std::move(out_);
  }

  Snapshots by_tension() {
    const TrainingPlan& plan = out_.plan;
    if (!plan.symmetric) refuse("symmetric = false: must be true, a GalerkinModel takes no dead loads");
    // The tensions of the plan and some way beyond, as far as the full model goes everywhere.
    const double headroom = 1.6;
    double needed = 0, reach = std::numeric_limits<double>::infinity(), nearest_limit = 0;
    const TensionCoordinate<double> coordinate(out_.beam);
    for (int i = -2; i < plan.positions; ++i) {
      const double at = i < 0 ? edge(i == -1 ? plan.s_min : plan.s_max) : s(i);
      const double most = 0.999 * full_.range().depth_at(at);
      full_.reset();
      const double reached = tension_at(full_, at, most);
      if (reached < reach) reach = reached, nearest_limit = at;
      if (i >= 0) continue;
      needed = (std::max)(needed, tension_at(full_, at, (std::min)(plan.depth, most)));
      out_.tension = (std::max)(out_.tension, tension_at(full_, at, (std::min)(headroom * plan.depth, most)));
    }
    if (needed > reach)
      refuse<TrainingError>(
          "depth = %g m: its tension, %g N, must be one that the full model reaches everywhere within its "
          "range, at s = %g m too: %g m would be",
          plan.depth, needed, nearest_limit, 0.99 * plan.depth * std::sqrt(reach / needed));
    // A plan so shallow that it stretches nothing gets the tensions where bending still outweighs them.
    out_.tension = reach > 0 ? (std::min)((std::max)(out_.tension, coordinate.unit()), reach) : 0;
    if (out_.tension == 0) out_.columns = 1;
    const Lagrange<Nodes> z(out_.columns, 0, coordinate(out_.tension));
    out_.grid.resize(static_cast<std::size_t>(plan.positions * out_.columns));
    for_each_position(full_, plan.positions, options_.threads, [&](Model& model, int i) {
      model.reset();
      // Where bending and stretching are alike.
      double d = std::sqrt(out_.beam.bending_stiffness / out_.beam.axial_stiffness);
      if (out_.columns == 1) d = plan.depth;
      for (int j = 0; j < out_.columns; ++j) {
        const double tension = coordinate.inverse(z.node(j));
        if (tension > 0) d = depth_at_tension(model, s(i), tension, d);
        take(model, i, j, 0, tension == 0 && out_.columns > 1 ? nothing() : d);
      }
    });
    return std::move(out_);
  }

 private:
  double position(double s) const {
    return out_.plan.positions > 1 ? PositionCoordinate<double>(out_.beam)(s) : s;
  }
  double s(int i) const {
    return out_.plan.positions > 1 ? PositionCoordinate<double>(out_.beam).inverse(x_.node(i))
                                   : out_.plan.s_min;
  }
  /// An end of the plan's range; the full model's, if they differ by round-off.
  double edge(double s) const {
    const Range<double> range = full_.range();
    const double inside = std::clamp(s, range.s_min, range.s_max);
    return std::abs(inside - s) <= 1e-9 * out_.beam.length ? inside : s;
  }

  /// The tension of a press [N], from F d = 2V + N² L/EA with V the model's strain energy.  An end that slides takes none.
  double tension_at(Model& model, double s, double d) const {
    const double work = press_for_training(model, s, d) * d;
    if (!fixes_u(out_.beam.left) || !fixes_u(out_.beam.right)) return 0;
    const double membrane = work - 2 * model.strain_energy();
    // Round-off and the solver's tolerance leave a linear element this much.
    if (!(membrane > 1e-8 * std::abs(work))) return 0;
    return std::sqrt(membrane * out_.beam.axial_stiffness / out_.beam.length);
  }

  /// The depth whose tension is N, by secants of ln N over ln d.
  double depth_at_tension(Model& model, double s, double N, double d) const {
    const double most = 0.9999 * model.range().depth_at(s);
    const double unit = TensionCoordinate<double>(out_.beam).unit();
    const auto miss = [&](double depth) { return std::log(tension_at(model, s, depth) / N); };
    double before = (std::min)(d, most), miss_before = miss(before);
    double next = before * std::exp(-miss_before / 2);
    for (int k = 0; k < 40; ++k) {
      next = (std::min)(next, most);
      const double now = miss(next);
      // Below N0 a tension changes little, and round-off of the energies leaves it few digits.
      if (std::abs(now) * N / (N + unit) < 1e-7) return next;
      if (now == miss_before || !std::isfinite(now)) break;
      const double power = std::log(next / before) / (now - miss_before);
      before = next, miss_before = now;
      next *= std::exp(-now * power);
    }
    refuse<TrainingError>(
        "no press at s = %g m has a tension of %g N; the full model's solver may be too loose, or its "
        "range too small",
        s, N);
  }

  /// A depth that stands for zero [m]: the error of F/e is (e/ρ)².
  double nothing() const {
    return (std::min)(3e-3 * std::sqrt(out_.beam.bending_stiffness / out_.beam.axial_stiffness),
                      1e-3 * out_.plan.depth);
  }

  void take(Model& model, int i, int j, double rest, double e) {
    // At rest itself a symmetric shape has no size to be freed of.
    const double shallow = nothing();
    if (out_.plan.symmetric) e = (std::max)(e, shallow);
    const double s = this->s(i), d = e + rest;
    const double force = press_for_training(model, s, d);
    Snapshot& snapshot = out_.grid[static_cast<std::size_t>(i * out_.columns + j)];
    snapshot = {s, d, force, force / e, {}};
    for (int k = 0; k <= out_.plan.segments; ++k)
      snapshot.nodes.push_back(model.shape().node_at(frame_.position(k, s)));
    // Nor has force over depth a value: it is the derivative there.
    if (std::abs(e) < shallow)
      snapshot.stiffness =
          (press_for_training(model, s, rest + shallow) - press_for_training(model, s, rest - shallow)) /
          (2 * shallow);
    if (!options_.progress) return;
    const std::lock_guard<std::mutex> lock(progress_mutex_);
    options_.progress(++done_, static_cast<int>(out_.grid.size()));
  }

  Model full_;
  const TrainingOptions& options_;
  Snapshots out_;
  ContactFrame<double> frame_;
  Lagrange<Nodes> x_;
  std::mutex progress_mutex_;
  int done_ = 0;
};

}  // namespace detail

/// Snapshots for a PodModel.
/// @param full  a ForceModel of that beam that can be copied; its own state is not used   @tparam Nodes  what train_pod() is given
template <class Nodes = ChebyshevNodes, class Model>
Snapshots take_snapshots(const Beam& beam, const Model& full, const TrainingPlan& plan,
                         const TrainingOptions& options = {}) {
  return detail::SnapshotTaker<Nodes, Model>(beam, full, plan, options).by_depth();
}

/// Snapshots for a GalerkinModel: at each position the depths whose tensions are the grid's.
/// @param full  as above, with strain_energy() [J] and a solver tight enough for F d - 2V, 1e-12 or so
/// @throws std::invalid_argument where the section of the beam changes or it shears: a GalerkinModel has one EA and one EI
template <class Nodes = ChebyshevNodes, class Model>
Snapshots take_snapshots_at_tensions(const Beam& beam, const Model& full, const TrainingPlan& plan,
                                     const TrainingOptions& options = {}) {
  constexpr const char* allowed = "none for a GalerkinModel; a PodModel takes it";
  if (!beam.parts().empty())
    detail::reject("beam sections", static_cast<double>(beam.parts().size()), "", allowed);
  if (!beam.uniform()) detail::reject("beam shear stiffness", beam.shear_stiffness(), "N", allowed);
  return detail::SnapshotTaker<Nodes, Model>(beam, full, plan, options).by_tension();
}

}  // namespace hapbeam
