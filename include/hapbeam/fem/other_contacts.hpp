// The contacts of a beam beyond the first: what a system knows of each.
//
// A beam that is touched at one place has none, and they cost nothing.
// Real-time: noexcept, no allocation.
#pragma once

#include <array>
#include <cstddef>

namespace hapbeam::detail {

/// @tparam Point  RodContact   @tparam Friction  of a contact   @tparam Row  of the assembler, to ask for the reaction
template <class Point, typename Scalar, class Friction, class Row>
struct OtherContact {
  Point point;
  Scalar force = 0;                   ///< along n, of the last tangent [N]
  Scalar d = 0, start = 0, goal = 0;  ///< [m] now, and at both ends of the path
  Scalar reaction = 0, saved = 0;     ///< as the system's linear_reaction() [N]
  Scalar moves = 0;                   ///< [m] prescribed increment
  Friction* friction = nullptr;       ///< null: none
  Row row{};
};

template <class Contact, int Most>
class OtherContacts {
 public:
  Contact* begin() noexcept { return all_.data(); }
  Contact* end() noexcept { return all_.data() + size_; }
  const Contact* begin() const noexcept { return all_.data(); }
  const Contact* end() const noexcept { return all_.data() + size_; }
  Contact& operator[](int k) noexcept { return all_[static_cast<std::size_t>(k)]; }
  const Contact& operator[](int k) const noexcept { return all_[static_cast<std::size_t>(k)]; }
  template <class F>
  void each(F&& f) noexcept {
    for (Contact& contact : *this) f(contact);
  }
  void clear() noexcept { size_ = 0; }
  Contact& add() noexcept { return all_[static_cast<std::size_t>(size_++)] = {}; }
  /// That of a node, null: none.
  const Contact* at(int node) const noexcept {
    for (const Contact& contact : *this)
      if (contact.point.holds(node)) return &contact;
    return nullptr;
  }

 private:
  std::array<Contact, Most> all_{};
  int size_ = 0;
};
template <class Contact>
class OtherContacts<Contact, 0> {
 public:
  Contact* begin() const noexcept { return nullptr; }
  Contact* end() const noexcept { return nullptr; }
  /// f is not even compiled.
  template <class F>
  void each(F&&) noexcept {}
  void clear() noexcept {}
  const Contact* at(int) const noexcept { return nullptr; }
};

}  // namespace hapbeam::detail
