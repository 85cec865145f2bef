// Training: the plan is carried out as it stands, on as many threads as there are, or fails with a reason.
#include <set>

#include "once_training.hpp"
#include "support/catch.hpp"
#include "support/error.hpp"
#include "support/solver.hpp"
#include "support/thesis_beam.hpp"
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/element/linear.hpp>
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/rom/training/snapshots.hpp>
#include <hapbeam/shapes.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

constexpr double L = thesis_length;

/// A full model that has trouble: past a depth its press ends without converging.
class Stubborn : public FemModel<> {
 public:
  using FemModel<>::FemModel;
  Response<double> press(const Press<double>& request) noexcept {
    const Response<double> response = FemModel<>::press(request);
    if (std::abs(request.d) > 0.03) return {response.force, Status::iteration_limit};
    return response;
  }
};

}  // namespace

TEST_CASE("snapshots are the full model's answers at the plan's nodes", "[snapshots]") {
  FemModel<> full(pinned(), 32, tight_solver());
  const TrainingPlan plan = TrainingPlan::anywhere(pinned(), 0.05, 5, 4);
  const Snapshots snapshots = take_snapshots(pinned(), full, plan);
  REQUIRE(snapshots.grid.size() == 20);
  std::set<double> positions;
  for (const Snapshot& snapshot : snapshots.grid) {
    positions.insert(snapshot.s);
    CHECK((0.05 * L < snapshot.s && snapshot.s < 0.95 * L && 0 < snapshot.d && snapshot.d < 0.05));
    full.reset();
    CHECK(relative_error(full.press({snapshot.s, snapshot.d}).force, snapshot.force) <= 1e-10);
    REQUIRE(snapshot.nodes.size() == 33);
    CHECK(snapshot.nodes[16].s == snapshot.s);
    CHECK(snapshot.nodes[16].w == Approx(snapshot.d).epsilon(1e-14));
    for (const auto& node : snapshot.nodes) CHECK(std::abs(node.w - full.shape().at(node.s).w) <= 1e-10);
  }
  CHECK(positions.size() == 5);
}

TEST_CASE("any number of threads takes the same snapshots, and tells how far it is", "[snapshots]") {
  const FemModel<> full(pinned(), 16);
  const TrainingPlan plan = TrainingPlan::anywhere(pinned(), 0.05, 7, 3);
  const auto forces = [&](int threads) {
    TrainingOptions options;
    options.threads = threads;
    int calls = 0, last = 0;
    options.progress = [&](int done, int total) {
      CHECK(done == ++calls);
      CHECK(total == 21);
      last = done;
    };
    std::vector<double> taken;
    for (const Snapshot& snapshot : take_snapshots(pinned(), full, plan, options).grid)
      taken.push_back(snapshot.force);
    CHECK(last == 21);
    return taken;
  };
  const std::vector<double> one = forces(1);
  CHECK(forces(2) == one);
  CHECK(forces(16) == one);
  CHECK(forces(0) == one);
}

TEST_CASE("a press that does not converge fails the training and says where", "[snapshots]") {
  const Stubborn full(pinned(), 16);
  for (const int threads : {1, 4}) {
    TrainingOptions options;
    options.threads = threads;
    CHECK_NOTHROW(take_snapshots(pinned(), full, TrainingPlan::anywhere(pinned(), 0.03), options));
    CHECK_THROWS_AS(take_snapshots(pinned(), full, TrainingPlan::anywhere(pinned(), 0.04), options),
                    TrainingError);
    CHECK_THROWS_WITH(take_snapshots(pinned(), full, TrainingPlan::at(1.0, 0.04), options),
                      Catch::Matchers::ContainsSubstring("the press at s = 1 m, d = 0.04") &&
                          Catch::Matchers::ContainsSubstring("iteration_limit"));
  }
}

TEST_CASE("a plan beyond the full model's range fails the training and says how far it goes", "[snapshots]") {
  const FemModel<> full(pinned(), 16);
  CHECK_THROWS_WITH(take_snapshots(pinned(), full, TrainingPlan::anywhere(pinned(), 0.1)),
                    Catch::Matchers::ContainsSubstring("out_of_range, the full model answers up to 0.06"));
}

TEST_CASE("a progress callback that throws ends the training with its exception", "[snapshots]") {
  TrainingOptions options;
  options.progress = [](int, int) { throw std::logic_error("stop"); };
  CHECK_THROWS_WITH(
      take_snapshots(pinned(), FemModel<>(pinned(), 8), TrainingPlan::anywhere(pinned(), 0.01), options),
      "stop");
}

TEST_CASE("snapshots at tensions have the same tensions at every position", "[snapshots][tension]") {
  FemModel<> full(pinned(), 64, tight_solver());
  const TrainingPlan plan = TrainingPlan::anywhere(pinned(), 0.02, 4, 3);
  const Snapshots snapshots = take_snapshots_at_tensions(pinned(), full, plan);
  REQUIRE(snapshots.grid.size() == 12);
  const TensionCoordinate<double> z(snapshots.beam);
  const Lagrange<> axis(3, 0, z(snapshots.tension));
  for (std::size_t k = 0; k < 12; ++k) {
    full.reset();
    full.press({snapshots.grid[k].s, snapshots.grid[k].d});
    const double tension = full.internal_forces(L / 3).normal;  // no energy is involved
    CHECK(relative_error(tension, z.inverse(axis.node(static_cast<int>(k % 3)))) <= 1e-6);
  }
}

TEST_CASE("a beam that is bent or moved by nature is not trained: a model does not know how", "[snapshots]") {
  Beam bent = pinned(), stretched = pinned();
  bent.naturally({{L, 0.1}});
  stretched.place({}, {1e-3, 0, 0});
  for (const Beam& beam : {bent, stretched}) {
    const FemModel<> full(beam, 16);
    CHECK_THROWS_WITH(
        take_snapshots(beam, full, TrainingPlan::anywhere(beam, 0.05)),
        "beam: must be straight, with its ends where they are in the straight beam, to train a model of it");
  }
}

TEST_CASE("a full model of another beam is refused, whatever differs", "[snapshots]") {
  const TrainingPlan plan = TrainingPlan::anywhere(pinned(), 0.02, 3, 3);
  const auto refused = [&plan](const Beam& another, const char* message) {
    CHECK_THROWS_WITH(take_snapshots(pinned(), FemModel<>(another, 16), plan),
                      Catch::Matchers::ContainsSubstring(message));
    CHECK_THROWS_WITH(take_snapshots_at_tensions(pinned(), FemModel<>(another, 16), plan),
                      Catch::Matchers::ContainsSubstring(message));
  };
  const Section section = Section::rectangle(0.0254, 0.0254);
  const char* const force = "full model: must be of the beam that is trained; pressed at s = 1.27 m";
  refused(Beam(1.2, section, Material{206.84e9}, Support::pinned, Support::pinned),
          "length of the full model = 1.2 m: must be that of the beam that is trained");
  refused(Beam(L, thesis_EA, thesis_EI, 0.02, Support::pinned, Support::pinned),
          "thickness of the full model = 0.02 m");
  refused(Beam(L, section, Material{70e9}, Support::pinned, Support::pinned), force);
  refused(Beam(L, 1.01 * thesis_EA, thesis_EI, 0.0254, Support::pinned, Support::pinned), force);
  refused(thesis_beam(Support::clamped, Support::pinned), force);
  refused(thesis_beam(Support::pinned, Support::roller), force);
  refused(stretched(pinned(), 1e-3), force);
  Beam loaded = pinned();
  loaded.add({1.0, 0, -100, 0});
  refused(loaded, force);
  CHECK_NOTHROW(take_snapshots(pinned(), FemModel<Linear>(pinned(), 16), plan));
  CHECK_NOTHROW(take_snapshots(pinned(), FemModel<Corotational<>>(pinned(), 8), plan));
}

TEST_CASE("a plan that is none is refused by name", "[snapshots]") {
  const FemModel<> full(pinned(), 8);
  const auto refused = [&full](auto spoil, const char* message) {
    TrainingPlan plan = TrainingPlan::anywhere(pinned(), 0.01);
    spoil(plan);
    CHECK_THROWS_WITH(take_snapshots(pinned(), full, plan), Catch::Matchers::ContainsSubstring(message));
  };
  refused([](TrainingPlan& p) { p.positions = 0; }, "positions = 0: must be 1 to 64");
  refused([](TrainingPlan& p) { p.positions = 1; }, "positions = 1: must be 1 where s_min = s_max");
  refused([](TrainingPlan& p) { p.depths = 65; }, "depths = 65: must be 2 to 64");
  refused([](TrainingPlan& p) { p.depth = std::nan(""); }, "depth = nan m: must be positive and finite");
  refused([](TrainingPlan& p) { p.depth = thesis_length; }, "must be less than the beam's length");
  refused([](TrainingPlan& p) { p.depth = 1e6; }, "depth = 1e+06 m: must be less than the beam's length");
  refused([](TrainingPlan& p) { p.s_min = 0; }, "s_min = 0 m: must be on the beam");
  refused([](TrainingPlan& p) { p.s_max = 9; }, "s_max = 9 m: must be");
  refused([](TrainingPlan& p) { p.segments = 1; }, "segments = 1: must be 2 to 16384");
  refused([](TrainingPlan& p) { p.segments = 7; }, "segments = 7: must be even");
}
