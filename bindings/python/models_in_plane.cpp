// SPDX-License-Identifier: MIT
// Planar models.
#include "factories.hpp"
#include "fem_of.hpp"
#include <hapbeam/element/corotational.hpp>
#include <hapbeam/element/linear.hpp>
#include <hapbeam/element/tapered.hpp>
#include <hapbeam/element/von_karman.hpp>
#include <hapbeam/fem/fem_model.hpp>

namespace hapbeam::python {
namespace {

template <class Element, Also also = Also::nothing>
FemPointer made(const Beam& beam, int elements, const char* kind) {
  return std::make_unique<FemOf<FemModel<Element>, also>>(kind, beam, elements);
}

}  // namespace

FemPointer model_in_plane(Element element, const Beam& beam, int elements) {
  const char* const kind = name(element);
  switch (element) {
    case Element::Linear: return made<Linear>(beam, elements, kind);
    case Element::VonKarman: return made<VonKarman<>, Also::arrays>(beam, elements, kind);
    case Element::AssumedStrain: return made<VonKarman<AssumedStrain>>(beam, elements, kind);
    case Element::Corotational:
      if (beam.uniform()) return made<Corotational<>, Also::arrays>(beam, elements, kind);
      return made<Corotational<Tapered<>>>(beam, elements, kind);
    default: throw NotOffered("Element.RoundRod and TwistedRod: of a Rod, not of a Beam");
  }
}

int elements_in_plane(Element element, const Beam& beam, double depth, double error) {
  switch (element) {
    case Element::Linear: return elements_for<Linear>(beam, depth, error);
    case Element::VonKarman: return elements_for<VonKarman<>>(beam, depth, error);
    case Element::AssumedStrain: return elements_for<VonKarman<AssumedStrain>>(beam, depth, error);
    case Element::Corotational:
      if (beam.uniform()) return elements_for<Corotational<>>(beam, depth, error);
      return elements_for<Corotational<Tapered<>>>(beam, depth, error);
    default: throw NotOffered("Element.RoundRod and TwistedRod: of a Rod, not of a Beam");
  }
}

FemPointer several_in_plane(const Beam& beam, int elements) {
  return made<Several<Corotational<>, most_in_plane>>(beam, elements, name(Element::Corotational));
}

}  // namespace hapbeam::python
