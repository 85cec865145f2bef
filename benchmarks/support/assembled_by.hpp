// FemModel over another assembler than its own: an element by another name, for which detail::Assembling names it.
#pragma once

#include <type_traits>

#include <hapbeam/element/element.hpp>
#include <hapbeam/fem/fem_model.hpp>
#include <hapbeam/fem/solver/block_tridiagonal.hpp>

namespace hapbeam {
namespace benchmarks {

template <class Element, template <typename> class Assembler>
struct AssembledBy : Element {
  using Abreast = std::conditional_t<goes_abreast<Element>, AssembledBy, void>;
};

/// Of all displacements, as a beam with dead loads needs.
template <class Element, template <typename> class Assembler>
using Solved = FemModel<AssembledBy<Element, Assembler>>;

}  // namespace benchmarks

namespace detail {

template <class Element, template <typename> class Assembler, typename Scalar, int Elements, int MaxElements>
struct Assembling<benchmarks::AssembledBy<Element, Assembler>, Scalar, Elements, MaxElements> {
  using Type = Assembler<Scalar>;
};

}  // namespace detail
}  // namespace hapbeam
