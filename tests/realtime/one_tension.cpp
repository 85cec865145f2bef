// What a beam costs whose one unknown is its tension, beside the equations of all displacements.
#include "support/catch.hpp"
#include "support/instructions.hpp"
#include "support/thesis_beam.hpp"
#include <hapbeam/fem/fem_model.hpp>

using namespace hapbeam;
using namespace hapbeam::testing;

namespace {

/// The same element by another name, of which the model does not know that one tension serves all.
struct NodeByNode : VonKarman<> {
  using Abreast = NodeByNode;
};

}  // namespace

#if defined(NDEBUG)  // of a program that is optimised
TEST_CASE("a press under one tension takes a third of the instructions", "[taut]") {
  const auto count = [](auto&& model) {
    double d = 0.02;
    model.press({1.0, d});
    return instructions([&] { model.press({1.0, d += 1e-4}); });
  };
  const long taut = count(FemModel<>(pinned(), 8)), nodes = count(FemModel<NodeByNode>(pinned(), 8));
  CAPTURE(taut, nodes);
  CHECK((taut < 0 || 3 * taut <= nodes));  // -1: this system does not let them be counted
}
#endif
