// HAPI 1.x as far as hapbeam and its page use it: names, types and what a call does, stated anew from its reference.
#pragma once

#include <memory>
#include <vector>

#include "haptics/hosts/pressing_hand.hpp"

namespace HAPI {

struct Vec3 {
  double x = 0, y = 0, z = 0;
  Vec3() = default;
  Vec3(double x_, double y_, double z_) : x(x_), y(y_), z(z_) {}
};

class HAPIHapticsDevice;

class HAPIForceEffect {
 public:
  struct EffectInput {
    HAPIHapticsDevice* hd;
    double deltaT;
  };
  struct EffectOutput {
    explicit EffectOutput(const Vec3& f = {}) : force(f) {}
    Vec3 force;
  };
  virtual ~HAPIForceEffect() = default;
  virtual EffectOutput calculateForces(const EffectInput& input) = 0;
};

/// Adds up the effects of each thousandth of a second, when it is told to transfer what was added.
class HAPIHapticsDevice {
 public:
  enum ErrorCode { SUCCESS = 0, NOT_INITIALIZED = 1 };
  ErrorCode initDevice(int = 1000) { return SUCCESS; }
  void enableDevice() {}
  ErrorCode releaseDevice() { return SUCCESS; }
  void addEffect(HAPIForceEffect* effect) { effects_.emplace_back(effect); }
  Vec3 getPosition() const { return position; }
  void transferObjects() {
    auto& hand = hapbeam::testing::pressing_hand;
    for (int tick = 0; tick < 2000; ++tick) {
      hand.time += 1e-3;
      position = {0, hand.height(), 0};
      double up = 0;
      for (const auto& effect : effects_) up += effect->calculateForces({this, 1e-3}).force.y;
      hand.feel(up);
    }
  }
  Vec3 position;

 private:
  std::vector<std::unique_ptr<HAPIForceEffect>> effects_;
};
class AnyHapticsDevice : public HAPIHapticsDevice {};

}  // namespace HAPI
