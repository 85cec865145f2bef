#include "instructions/strokes.hpp"

int main() {
  using namespace hapbeam::testing;
  straight();
  bent();
  trained();
  many();
  in_space();
  friction();
}
