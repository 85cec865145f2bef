// What a tick may cost: counted, never timed.
#include <algorithm>
#include <cmath>
#include <realtime/heap_watch.hpp>
#include <vector>

#include "realtime/counting_element.hpp"
#include "realtime/requests.hpp"
#include "support/catch.hpp"
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/fem/fem_model.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

/// Beams that are hard to solve for: soft, stiffened a hundredfold by a press, buckled by their own loads.
std::vector<Beam> beams() {
  Beam buckled(1.0, 1e5, 0.1, 1e-3, Support::pinned, Support::roller);
  buckled.add({1.0, -2.0, 0, 0}).transverse(0.01);
  return {thesis_beam(Support::pinned, Support::pinned), loaded_beam(Support::clamped, Support::clamped),
          thesis_beam(Support::clamped, Support::free),
          Beam(1.0, 1e7, 1e-3, 1e-3, Support::pinned, Support::pinned), buckled};
}

template <class Element>
inline constexpr bool counts = false;
template <class Element>
inline constexpr bool counts<CountingElement<Element>> = true;

template <typename Model>
struct Work {
  using Element = typename Model::ElementType;
  int most_solves = 0;
  long most_tangents = 0, most_residuals = 0;

  template <typename Call>
  void count(Model& model, Call&& call) {
    if constexpr (counts<Element>) Element::tangents = Element::residuals = 0;
    call();
    most_solves = std::max(most_solves, model.report().solves);
    if constexpr (counts<Element>) {
      most_tangents = std::max(most_tangents, Element::tangents);
      most_residuals = std::max(most_residuals, Element::residuals);
    }
  }
};

}  // namespace

// How often a solve asks an element does not depend on the scalar; how many it takes does.
TEMPLATE_TEST_CASE(
    "FemModel: no request takes more linear solves than the solver's limit, and two looks where the beam may "
    "fall to another shape",
    "", (FemModel<CountingElement<VonKarman<>>, double>), (FemModel<CountingElement<VonKarman<>>, float>),
    (FemModel<CountingElement<Corotational<>>, double>), (FemModel<CountingElement<Corotational<>>, float>)) {
  using Model = TestType;
  using Element = typename Model::ElementType;
  using Scalar = typename Model::Scalar;
  constexpr int elements = 6;
  unsigned seed = 0;
  for (const int limit : {1, 2, 5, 16, 48}) {
    NewtonRaphson solver;
    solver.max_solves = limit;
    int hardest = 0;
    const std::vector<Beam> all = beams();
    for (const Beam& beam : all) {
      CAPTURE(limit, ++seed);
      Model model(beam, elements, solver);
      Work<Model> work;
      for (const auto& request : requests(model.range(), model.shape().length(), seed))
        work.count(model, [&] { model.press(request); });
      if constexpr (takes_push<Model>) {
        Scalar angle = 0;  // from press to press another direction, all around
        for (const auto& request : requests(model.range(), model.shape().length(), seed)) {
          angle += Scalar(0.1);
          work.count(model, [&] {
            model.push(Push<Scalar>{request.s, request.d, {std::sin(angle), std::cos(angle)}});
          });
        }
      }
      // With next to no budget even rest is found by falling, and then the beam counts as one that may.
      const bool may_fall = any_rotation<Element> || &beam == &all.back() || limit < 5;
      const int bound = may_fall ? limit + 2 : limit;
      CHECK(work.most_solves <= bound);
      // All that a solve costs: each element once.  And once more for the two at the contact: the reaction.
      CHECK(work.most_tangents <= long(bound) * elements);
      CHECK(work.most_residuals <= 2);
      hardest = std::max(hardest, work.most_solves);
    }
    // The requests are mean enough to meet it; some elements answer them all in less than the default.
    if (limit < 48) CHECK(hardest >= limit);
  }
}

TEST_CASE("FemModel: an invalid request costs nothing") {
  using Element = CountingElement<VonKarman<>>;
  FemModel<Element> model(thesis_beam(Support::pinned, Support::pinned), 8);
  Element::tangents = Element::residuals = 0;
  CHECK(model.press({std::nan(""), 0.01}).status == Status::invalid_request);
  CHECK(model.press({1.27, INFINITY}).status == Status::invalid_request);
  CHECK(model.press({-1, 0.01}).status == Status::invalid_request);
  CHECK(Element::tangents + Element::residuals == 0);
}
