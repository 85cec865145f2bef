// What each tick was, from the servo's thread to whoever writes or draws it.
#pragma once

#include <hapbeam/haptics/device/hand_path.hpp>
#include <hapbeam/haptics/servo/exchange.hpp>
#include <hapbeam/haptics/servo/servo_record.hpp>

namespace phantom {

struct Tick {
  hapbeam::ServoRecord record;
  hapbeam::HandTarget hand;  ///< where the hand wanted to be
  double duration;           ///< [s] that the servo took
  int changes;               ///< of the body, before it
  double moved;              ///< [m] how far from its rest what has mass is
};

struct Tape : hapbeam::Ring<Tick> {
  Tape() : Ring(8192) {}  // eight seconds
};

}  // namespace phantom
