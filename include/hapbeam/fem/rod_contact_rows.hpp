// What a contact of a rod does to the rows of its node: the force's share of the tangent, friction, and the displacement that is held.
//
// Real-time: noexcept, no allocation, O(1).
#pragma once

#include <hapbeam/fem/rod_contact.hpp>

namespace hapbeam::detail {

/// What the force along n makes of a capsule.
template <int Unknowns, typename Scalar, class Assembler>
void add_bend(const RodContact<Scalar>& contact, Assembler& assembler) noexcept {
  if (!contact.bends()) return;
  Eigen::Matrix<Scalar, Unknowns, Unknowns> K = Eigen::Matrix<Scalar, Unknowns, Unknowns>::Zero();
  K.template block<6, 6>(0, 0) = contact.bend();
  assembler.add_at(contact.node(), K, VectorOf<Scalar, Unknowns>::Zero());
}

/// Friction, at the place that is touched.
template <int Unknowns, typename Scalar, class Friction, class Assembler>
void add_friction(const RodContact<Scalar>& contact, const RodNode<Scalar>& node, const Friction& friction,
                  Assembler& assembler) noexcept {
  using Matrix36 = Eigen::Matrix<Scalar, 3, 6>;
  Matrix36 moves;  // that place, by r and r'
  moves.template leftCols<3>().setIdentity();
  moves.template rightCols<3>().setZero();
  if (contact.round()) {
    const auto view = contact.view(node);
    moves.template rightCols<3>() =
        (view.u.dot(view.f) * Eigen::Matrix<Scalar, 3, 3>::Identity() - view.u * view.f.transpose()) /
        view.length;
  }
  VectorOf<Scalar, Unknowns> r = VectorOf<Scalar, Unknowns>::Zero();
  Eigen::Matrix<Scalar, Unknowns, Unknowns> K = Eigen::Matrix<Scalar, Unknowns, Unknowns>::Zero();
  r.template head<6>() = -moves.transpose().lazyProduct(friction.force());
  const Matrix36 stiff = friction.tangent().lazyProduct(moves);
  K.template block<6, 6>(0, 0) = moves.transpose().lazyProduct(stiff);
  assembler.add_at(contact.node(), K, r);
}

/// Prescribes that d grows by so much.  @param row  for the assembler's reaction()
template <typename Scalar, class Assembler, class Row>
void hold(const RodContact<Scalar>& contact, Scalar moves, Assembler& assembler, Row& row) noexcept {
  assembler.hold_along(contact.node(), contact.leading(), contact.way(moves), row);
}
/// The same of one of several.  @param others  those that were held before it and, behind them, itself
template <typename Scalar, class Assembler, class Other, class Others>
void hold_other(Other& other, Assembler& assembler, Others& others) noexcept {
  other.moves = other.d - other.point.displacement();
  hold<Scalar>(other.point, other.moves, assembler, other.row);
  const auto by = other.point.way(other.moves);
  const auto tell = [&](auto& row) {
    for (int k = 0; k < 3; ++k) assembler.know(other.point.node(), k, by[k], row);
  };
  tell(assembler.held());
  for (auto& before : others) {
    if (&before == &other) break;
    tell(before.row);
  }
}

}  // namespace hapbeam::detail
