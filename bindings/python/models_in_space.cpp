// SPDX-License-Identifier: MIT
// Models of rods.
#include "factories.hpp"
#include "fem_of.hpp"
#include <hapbeam/element/rod.hpp>
#include <hapbeam/element/twisted_rod.hpp>
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/fem/rod_system.hpp>

namespace hapbeam::python {
namespace {

template <class Element, Also also = Also::nothing>
FemPointer made(const Rod& rod, int elements, const char* kind) {
  return std::make_unique<FemOf<FemModel<Element>, also>>(kind, rod, elements);
}

}  // namespace

FemPointer model_in_space(Element element, const Rod& rod, int elements) {
  if (element == Element::RoundRod) return made<RoundRod, Also::grips>(rod, elements, name(element));
  return made<TwistedRod, Also::grips>(rod, elements, name(element));
}

int elements_in_space(Element element, const Rod& rod, double depth, double error) {
  return element == Element::RoundRod ? elements_for<RoundRod>(rod, depth, error)
                                      : elements_for<TwistedRod>(rod, depth, error);
}

FemPointer several_in_space(Element element, const Rod& rod, int elements) {
  if (element == Element::RoundRod)
    return made<Several<RoundRod, most_in_space>>(rod, elements, name(element));
  return made<Several<TwistedRod, most_in_space>>(rod, elements, name(element));
}

}  // namespace hapbeam::python
