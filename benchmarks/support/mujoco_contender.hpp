// What contender() makes of MuJoCo's chain, for the file that compiles it.
#pragma once

#include "contender_of.hpp"
#include "mujoco_chain.hpp"

namespace hapbeam::benchmarks {

template <>
class Touched<MujocoChain> final : public TouchedChain<MujocoChain> {
  using TouchedChain::TouchedChain;
};

}  // namespace hapbeam::benchmarks
