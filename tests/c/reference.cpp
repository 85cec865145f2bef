// The force that press.c and press.py must feel, from the headers.
#include <cstdio>

#include <hapbeam/hapbeam.hpp>

int main() {
  using namespace hapbeam;
  const Beam bar(2.54, Section::rectangle(0.0254, 0.0254), Material{206.84e9}, Support::pinned,
                 Support::pinned);
  FemModel<> model(bar, 16);
  Touch<FemModel<>> touch(model, 0.01);
  TouchResult<double> felt;
  for (int i = 0; i < 1000; ++i) felt = touch.tick({1.27, 0.03 - 1.73e-5 * i});
  std::printf("%.17g\n", felt.force.y());
}
