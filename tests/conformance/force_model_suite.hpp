// What include/hapbeam/force_model.hpp promises, as one suite for any ForceModel.
//
//   TEST_CASE("...") { check_force_model([] { return MyModel(...); }); }
//
// Laws that only some models have (energy, symmetry, accuracy) belong to the tests of these models.
#pragma once

#include <functional>

#include "support/any_model.hpp"

namespace hapbeam::testing {

/// The suite, compiled once for each of AnyModel and AnyPushedModel in either scalar: force_model_suite.cpp.
template <class Model>
void check_contract(const std::function<Model()>& make);

template <class Make>
void check_force_model(Make make) {
  using Model = AnyOf<decltype(make())>;
  check_contract<Model>([&make] { return Model(make()); });
}

}  // namespace hapbeam::testing
