// The page's demonstrations on this machine: what the browser has to feel too.  One line of JSON for each scene and model.
#include <chrono>
#include <cmath>
#include <cstdio>

#include "page.hpp"

int main() {
  for (int scene = 0; scene < page::scenes; ++scene) {
    page::Page page(page::scene(scene));
    for (int model = 0; model < page::models; ++model) {
      if (!page.has(model)) continue;
      const double error = page.error(model);
      const auto begin = std::chrono::steady_clock::now();
      const int ticks = model == page::with_mass ? 100 : 5000;
      page.stroke(model, ticks);
      const std::chrono::duration<double, std::micro> time = std::chrono::steady_clock::now() - begin;
      std::printf("{\"scene\": %d, \"model\": %d, \"error\": %.9g, \"us\": %.3g, \"forces\": [", scene, model,
                  std::isnan(error) ? -1 : error, time.count() / (ticks + 60));
      page.choose(model);
      page.rewind();
      for (int k = 0; k < page.demonstration(); ++k) {
        const page::Tick& tick = page.demonstrate();
        if (k % 20 == 19) std::printf("%s%.9g, %.9g", k == 19 ? "" : ", ", tick.force_x, tick.force_w);
      }
      std::puts("]}");
    }
  }
}
