// An element that counts how often it is asked: work, where a clock would only measure the machine.
#pragma once

#include <hapbeam/element/element.hpp>

namespace hapbeam::testing {

template <class Element>
struct CountingElement {
  static inline long tangents = 0, residuals = 0;
  static constexpr bool any_rotation = hapbeam::any_rotation<Element>;
  static constexpr const char* name() noexcept { return Element::name(); }

  template <typename S>
  static S energy(const hapbeam::ElementProperties<S>& p, const hapbeam::Vector6<S>& d) noexcept {
    return Element::energy(p, d);
  }
  template <typename S>
  static decltype(auto) residual(const hapbeam::ElementProperties<S>& p, const hapbeam::Vector6<S>& d,
                                 hapbeam::Vector6<S>& r) noexcept {
    ++residuals;
    return Element::residual(p, d, r);
  }
  template <typename S>
  static decltype(auto) tangent(const hapbeam::ElementProperties<S>& p, const hapbeam::Vector6<S>& d,
                                hapbeam::Vector6<S>& r, hapbeam::Matrix6<S>& K) noexcept {
    ++tangents;
    return Element::tangent(p, d, r, K);
  }
  /// Where the element has it, an element of any rotation.
  template <typename S, class E = Element>
  static auto chord_change(const hapbeam::ElementProperties<S>& p, const hapbeam::Vector6<S>& d,
                           const hapbeam::Vector6<S>& x) noexcept -> decltype(E::chord_change(p, d, x)) {
    return E::chord_change(p, d, x);
  }
};

}  // namespace hapbeam::testing
