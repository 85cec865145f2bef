// An element that counts how often it is asked: work, where a clock would only measure the machine.
#pragma once

#include <type_traits>

#include <hapbeam/element/element.hpp>

namespace hapbeam::testing {

template <class Element>
struct CountingElement {
  static inline long tangents = 0, residuals = 0;
  static constexpr bool any_rotation = hapbeam::any_rotation<Element>;
  static constexpr const char* name() noexcept { return Element::name(); }
  using Abreast = std::conditional_t<hapbeam::has_own_tension<Element>, CountingElement, void>;

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
  /// Of an element whose tension is an unknown, from what it has responded.
  template <typename S>
  static S tangent(const hapbeam::ElementProperties<S>& p, const hapbeam::CoreResponse<S>& core,
                   hapbeam::Vector6<S>& r, hapbeam::Matrix6<S>& K) noexcept {
    ++tangents;
    return Element::tangent(p, core, r, K);
  }
  template <typename S>
  static auto core(const hapbeam::ElementProperties<S>& p, const hapbeam::Vector6<S>& d,
                   hapbeam::OwnTension<S>& tension) noexcept {
    return Element::core(p, d, tension);
  }
  template <typename S, class E = Element, std::enable_if_t<hapbeam::has_own_tension<E>, int> = 0>
  static auto respond(const hapbeam::ElementProperties<S>& p, const hapbeam::Vector6<S>& d,
                      hapbeam::OwnTension<S>& tension) noexcept {
    return E::core(p, d, tension);
  }
  template <typename S, class E = Element>
  static auto chord_change(const hapbeam::ElementProperties<S>& p, const hapbeam::Vector6<S>& d,
                           const hapbeam::Vector6<S>& x) noexcept -> decltype(E::chord_change(p, d, x)) {
    return E::chord_change(p, d, x);
  }
  template <typename S, class E = Element>
  static auto chord_change(const hapbeam::ElementProperties<S>& p, const hapbeam::Vector6<S>& d,
                           const hapbeam::Vector6<S>& x, const S& normal) noexcept
      -> decltype(E::chord_change(p, d, x, normal)) {
    return E::chord_change(p, d, x, normal);
  }
};

}  // namespace hapbeam::testing
