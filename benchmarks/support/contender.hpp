// A method under an avatar: what speed_accuracy asks of all of them.
//
// Each is compiled in a file of its own (contender.cpp.in), as it is in a program that uses one: beside others the compiler
// inlines less, and a tick takes up to a third longer.
#pragma once

#include <memory>

#include <hapbeam/contact/touch.hpp>
#include <hapbeam/fem/fem_model.hpp>

namespace hapbeam::benchmarks {

/// @tparam D  of the space in which it bends: 2 | 3
template <int D>
class Contender {
 public:
  virtual ~Contender() = default;
  virtual TouchResult<double, D> tick(const VectorOf<double, D>& position) noexcept = 0;
  virtual void reset() noexcept = 0;
};

/// @tparam Model  one of those that benchmarks/CMakeLists.txt lists   @param arguments  of its constructor, as listed there
template <class Model, class... Arguments>
std::unique_ptr<Contender<dimension_of<Model>>> contender(const Arguments&... arguments);

}  // namespace hapbeam::benchmarks
