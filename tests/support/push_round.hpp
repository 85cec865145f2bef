// One circle on a beam, or one capsule on a rod, as a Touch asks for it: from push to push it goes on.
#pragma once

#include <hapbeam/force_model.hpp>
#include <hapbeam/friction.hpp>

namespace hapbeam::testing {

template <class Model>
class PushRound {
  using Scalar = typename Model::Scalar;
  using Obstacle = hapbeam::Obstacle<Scalar, dimension_of<Model>>;

 public:
  explicit PushRound(Model& model) : model_(model) {}

  Pushed<Scalar, dimension_of<Model>> operator()(const decltype(Obstacle::round)& round) {
    obstacle_.valid = obstacle_.touching = true;
    obstacle_.round = round;
    const Status status = model_.push(&obstacle_, 1);
    auto pushed = obstacle_.pushed;
    if (status != Status::ok) pushed.status = status;
    return pushed;
  }

 private:
  Model& model_;
  Obstacle obstacle_;
};

}  // namespace hapbeam::testing
