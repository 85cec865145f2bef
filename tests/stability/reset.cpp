// Whatever was pressed before a reset, as long as it may have been.
#include "support/as_new.hpp"
#include "support/catch.hpp"

using namespace hapbeam::testing::resets;

TEST_CASE("after any history a reset of both hands makes the scene a new one, to the last bit",
          "[two_hands][reset]") {
  check_two_hands_as_new();
}

TEST_CASE("after any history TouchSeveral is a new one, to the last bit", "[several][reset]") {
  check_several_as_new(20);
}
