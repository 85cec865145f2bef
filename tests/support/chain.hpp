// Adds elements to the system of a chain as models do: a few side by side.
#pragma once

#include <hapbeam/fem/solver/block_tridiagonal.hpp>
#include <hapbeam/fem/solver/per_node.hpp>

namespace hapbeam::testing {

/// Starts a new system.   @param tangent, residual  (e) -> of element e
template <typename Scalar, int Elements, int MaxElements, int Block, class Tangent, class Residual>
void add_elements(BlockTridiagonal<Scalar, Elements, MaxElements, Block>& chain, int elements,
                  Tangent&& tangent, Residual&& residual) {
  using Wide = detail::Pack<Scalar>;
  const detail::PairOrder order{elements};
  for (int first = 0; first < 2 * order.pairs(); first += Wide::size) {
    Eigen::Matrix<Wide, 2 * Block, 2 * Block> K;
    Eigen::Matrix<Wide, 2 * Block, 1> r;
    K.fill(Wide(0)), r.fill(Wide(0));
    for (int lane = 0; lane < Wide::size && first + lane < 2 * order.pairs(); ++lane) {
      const int e = order.element(first + lane);
      if (e < 0) continue;
      const auto& its = residual(e);
      const auto& stiff = tangent(e);
      for (int j = 0; j < 2 * Block; ++j) {
        r[j].set(lane, its[j]);
        for (int i = 0; i < 2 * Block; ++i) K(i, j).set(lane, stiff(i, j));
      }
    }
    chain.add_pairs(first, K, r);
  }
}

}  // namespace hapbeam::testing
