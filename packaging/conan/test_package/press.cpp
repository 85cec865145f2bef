#include <hapbeam/hapbeam.hpp>

int main() {
  using namespace hapbeam;
  FemModel<> model(Beam(1, Section::circle(0.01), Material{210e9}, Support::pinned, Support::pinned), 8);
  return model.press({0.5, 0.01}).status == Status::ok ? 0 : 1;
}
