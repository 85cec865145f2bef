// A bistable beam under a hand that prescribes where its middle is: up to where it leans over, along the falling branch,
// through to its other shape, and back.
#include "stability/bistable.hpp"
#include "support/catch.hpp"
#include "support/error.hpp"
#include "support/random.hpp"
#include "support/status.hpp"
#include "support/thesis_beam.hpp"
#include <hapbeam/contact/touch.hpp>
#include <hapbeam/fem/fem_model.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

constexpr int elements = 16;

/// Largest move of any node between two shapes [m].
double distance(const std::vector<CentrelineNode<double>>& a, const Centreline<double>& b) {
  double worst = 0;
  for (int i = 0; i < b.size(); ++i) {
    const auto& old = a[static_cast<std::size_t>(i)];
    const Displacement<double> now = b.at(old.s);
    worst = std::max(worst, std::hypot(old.u - now.u, old.w - now.w));
  }
  return worst;
}

struct Press1 {
  double depth, force;  ///< from the shape at rest, toward the other; what the hand does that way
};

/// Presses the middle from where the beam rests toward the other side, until it would have to be held back.
/// @param side  +1: from above
template <class Model>
std::vector<Press1> press_through(Model& model, int side, double step) {
  const double s = model.shape().length() / 2, from = middle(model);
  std::vector<Press1> presses;
  std::vector<CentrelineNode<double>> before(model.shape().begin(), model.shape().end());
  int snaps = 0;
  double most = 0;
  for (int k = 1; k <= 40000; ++k) {
    const Response<double> response = model.press({s, from - side * step * k});
    REQUIRE(std::isfinite(response.force));
    const double moved = distance(before, model.shape());
    CAPTURE(k, response.force, moved, model.report().solves);
    CHECK(model.report().solves <= 48 + 2);
    // What keeps to its branch moves with the hand; a change of branch is never silent.
    if (response.status == Status::ok) CHECK(moved <= 30 * step + 0.02 * from * side);
    else REQUIRE((response.status == Status::snapped || response.status == Status::iteration_limit));
    snaps += response.status == Status::snapped;
    presses.push_back({step * k, -side * response.force});
    most = std::max(most, presses.back().force);
    if (presses.back().force < -0.01 * most) break;
    before.assign(model.shape().begin(), model.shape().end());
  }
  CHECK(snaps == 1);
  return presses;
}

/// Lets go until the beam rests.  @return calls
template <class Model>
int let_go(Model& model) {
  for (int calls = 1;; ++calls) {
    const Status status = model.release();
    REQUIRE(model.report().solves <= 48 + 2);
    if (status != Status::iteration_limit) {
      CHECK(status == Status::snapped);
      return calls;
    }
    REQUIRE(calls < 10);
  }
}

/// The press that takes most; behind it the force falls to the end.
double check_falling_branch(const std::vector<Press1>& presses) {
  REQUIRE(presses.size() > 100);
  std::size_t top = 0;
  for (std::size_t k = 0; k < presses.size(); ++k)
    if (presses[k].force > presses[top].force) top = k;
  int rises = 0;
  for (std::size_t k = top + 1; k < presses.size(); ++k) rises += presses[k].force > presses[k - 1].force;
  CHECK(rises <= 2);  // on its way down from the ridge a fall may take a few presses
  CHECK(presses.back().force < 0.05 * presses[top].force);
  return presses[top].force;
}

template <class Model, class MakeBeam>
void check_both_ways(MakeBeam&& make) {
  using Element = typename Model::ElementType;
  Model model(make(), elements);
  REQUIRE(model.rest().status == Status::ok);
  const std::vector<CentrelineNode<double>> rest(model.shape().begin(), model.shape().end());
  const double up = middle(model), step = up / 10000;
  REQUIRE(up > 0);
  CHECK(lean(model) <= 1e-9);

  const double down_limit = first_critical_load<Element>(make(), model, 1);
  const double down_most = check_falling_branch(press_through(model, 1, step));
  CHECK(lean(model) > 0.1 * up);  // it went through leaning over
  CAPTURE(down_most, down_limit);
  CHECK(relative_error(down_most, down_limit) <= 0.01);
  CHECK(let_go(model) <= 6);
  CHECK(middle(model) < -0.5 * up);
  CHECK(lean(model) <= 1e-6 * up);

  const double up_limit = first_critical_load<Element>(make(), model, -1);
  const double up_most = check_falling_branch(press_through(model, -1, step));
  CAPTURE(up_most, up_limit);
  CHECK(relative_error(up_most, up_limit) <= 0.01);
  CHECK(let_go(model) <= 6);
  CHECK(distance(rest, model.shape()) <= 1e-6 * up);

  // Half a cycle away, and half through the fall as well.
  for (const double part : {0.5, 1.2}) {
    model.press({model.shape().length() / 2, up * (1 - part)});
    model.press({model.shape().length() / 2, up * (1 - part)});
    model.reset();
    CHECK(distance(rest, model.shape()) <= 1e-15);
  }
}

}  // namespace

TEMPLATE_TEST_CASE(
    "a buckled strip: pressed through its straight shape and back, forces as along the path of the load",
    "[snap]", FemModel<Corotational<>>, FemModel<>) {
  check_both_ways<TestType>(buckled_strip);
}

TEST_CASE("a hinged arch: through to its other shape and back, with another force from below", "[snap]") {
  check_both_ways<FemModel<Corotational<>>>(hinged_arch);
}

// Two mirror images: what it takes from above it takes from below.
TEMPLATE_TEST_CASE("a buckled strip takes the same force both ways", "[snap]", FemModel<Corotational<>>,
                   FemModel<>) {
  TestType model(buckled_strip(), elements);
  const double step = middle(model) / 1000;
  const std::vector<Press1> down = press_through(model, 1, step);
  let_go(model);
  const std::vector<Press1> up = press_through(model, -1, step);
  REQUIRE(up.size() == down.size());
  for (std::size_t k = 0; k < up.size(); ++k)
    CHECK(std::abs(up[k].force - down[k].force) <= 1e-4 * down[20].force);
}

// The force of a branch is the slope of its energy; what the fall loses is the hand's work less what is stored.
TEST_CASE("on either side of a snap the work of the press is what the strip stores", "[snap]") {
  FemModel<Corotational<>> model(buckled_strip(), elements);
  const double s = 0.1, up = middle(model), step = up / 4000;
  double energy = model.strain_energy(), force = 0, lost = 0, worst = 0;
  const double most = [&] {
    double top = 0;
    for (int k = 1; k <= 4000; ++k) {
      const Response<double> response = model.press({s, up - step * k});
      const double stored = model.strain_energy() - energy, work = -(force + response.force) / 2 * step;
      energy += stored, force = response.force, top = std::max(top, energy);
      if (response.status == Status::ok) worst = std::max(worst, std::abs(work - stored));
      else lost += work - stored;
    }
    return top;
  }();
  CAPTURE(worst, lost, most);
  CHECK(worst <= 1e-6 * most);
  CHECK(lost >= -1e-6 * most);
}

// The hand's way, with the avatar's size: the fall through the middle, and a click back from below.
TEST_CASE("an avatar pushes a bistable beam through, and from below back", "[snap]") {
  for (const bool strip : {true, false})
    for (const double off : {0.0, 0.004, -0.013}) {
      const Beam beam = strip ? buckled_strip() : hinged_arch();
      FemModel<Corotational<>> model(beam, elements);
      Touch<FemModel<Corotational<>>> touch(model, 0.005);
      const double s = beam.length() / 2 + off, x = s + model.shape().at(s).u, up = middle(model);
      const std::vector<CentrelineNode<double>> rest(model.shape().begin(), model.shape().end());
      double work = 0, peak = 0;
      for (const int side : {1, -1}) {
        int snaps = 0, pressing = 0;
        bool let_go = false;
        double before = 0;
        for (int k = 0; k <= 4000; ++k) {
          const double y = side * (2.2 * up * (1 - k / 2000.0) + 0.006);
          // The way home, on the side from which it came, as soon as the beam is gone.
          const TouchResult<double> r = touch.tick({x, y});
          CAPTURE(strip, off, side, k, r.force.x(), r.force.y());
          REQUIRE(r.force.allFinite());
          REQUIRE(r.force.y() * side >= 0);
          REQUIRE((is_answer(r.status) || r.status == Status::iteration_limit));
          snaps += r.status == Status::snapped;
          pressing += r.pressing;
          work += side * (before + r.force.y()) / 2 * (2.2 * up / 2000);
          before = r.force.y();
          peak = std::max(peak, model.strain_energy());
          let_go = let_go || (pressing > 0 && !r.pressing);
          if (let_go && r.status == Status::snapped) break;
        }
        CAPTURE(strip, off, side, snaps, pressing);
        CHECK(pressing > 500);
        CHECK(snaps >= 1);
        CHECK(snaps <= 3);
        CHECK(side * middle(model) < -0.5 * up);
        for (const double to : {x, -1.0, 0.0})
          (void)touch.tick({to, side * (to == 0 ? -1.0 : 1.0)});  // round its end
        (void)touch.tick({x, -side * 0.5});
      }
      CHECK(distance(rest, model.shape()) <=
            1e-3 * up);  // the nodes are elsewhere: fourth order between them
      // A whole cycle of snaps takes from the hand.
      CHECK(work > 0.1 * peak);
      touch.reset();
      CHECK(distance(rest, model.shape()) <= 1e-15);
    }
}

TEMPLATE_TEST_CASE("a press that ends no branch does not say snapped", "[snap]", FemModel<Corotational<>>,
                   FemModel<>) {
  Random random(5);
  for (const auto& [left, right] :
       {std::pair{Support::pinned, Support::pinned}, std::pair{Support::clamped, Support::free},
        std::pair{Support::clamped, Support::clamped}}) {
    TestType model(thesis_beam(left, right), 8);
    int snaps = 0;
    for (int k = 0; k < 2000; ++k)
      snaps += model.press({thesis_length * random(0.1, 0.9), 0.02 * thesis_length * random(1)}).status ==
               Status::snapped;
    CHECK(snaps == 0);
  }
  // Short of what makes it lean over, a strip keeps to its side.
  TestType strip(buckled_strip(), elements);
  const double up = middle(strip);
  for (int k = 0; k < 500; ++k) {
    const Response<double> response = strip.press({0.1, up * random(0.985, 1.02)});
    CHECK(response.status == Status::ok);
    if (k % 10 == 0) CHECK(strip.release() == Status::ok);
  }
}

// As far as no strip of its length reaches, from one tick to the next: it may refuse, and then it must come back.
TEST_CASE("from a request beyond all reach a bistable beam comes to rest again", "[snap]") {
  Random random(17);
  for (const bool strip : {true, false}) {
    FemModel<Corotational<>> model(strip ? buckled_strip() : hinged_arch(), elements);
    const double up = middle(model);
    const std::vector<CentrelineNode<double>> rest(model.shape().begin(), model.shape().end());
    std::vector<CentrelineNode<double>> other;
    press_through(model, 1, up / 1000);
    let_go(model);
    other.assign(model.shape().begin(), model.shape().end());
    for (int trial = 0; trial < 600; ++trial) {
      const int pushes = random.integer(1, 4);
      for (int k = 0; k < pushes; ++k) {
        const double angle = random(3.2);
        const Response<double> response =
            model.push({0.2 * random(0.05, 0.95), 0.2 * random(0.5), {std::sin(angle), std::cos(angle)}});
        REQUIRE(std::isfinite(response.force));
        REQUIRE(model.report().solves <= 48 + 2);
      }
      int calls = 1;
      while (model.release() == Status::iteration_limit && calls < 100) ++calls;
      CAPTURE(strip, trial, calls, middle(model));
      CHECK(calls <= 30);
      // A hinge may have been turned right round, and then the arch rests in a loop.
      if (strip) CHECK(std::min(distance(rest, model.shape()), distance(other, model.shape())) <= 1e-2 * up);
      const std::vector<CentrelineNode<double>> found(model.shape().begin(), model.shape().end());
      CHECK(model.release() == Status::ok);
      CHECK(distance(found, model.shape()) <= 1e-6 * up);
    }
  }
}

// Without stress a beam has no potential to compare: what round-off makes of it is no way down and none up.
TEST_CASE("what is at rest already is let go in one call, and has not snapped", "[snap]") {
  for (const bool strip : {true, false}) {
    FemModel<Corotational<>> model(strip ? buckled_strip() : hinged_arch(), elements);
    const double up = middle(model);
    for (const double s : {0.1, 0.05, 0.037, 0.16}) {
      model.press({s, model.shape().at(s).w - 0.001 * up});
      for (int k = 0; k < 3; ++k) {
        CAPTURE(strip, s, k, model.report().solves);
        CHECK(model.release() == Status::ok);
        CHECK(std::abs(middle(model) - up) <= 1e-3 * up);
      }
    }
  }
}
