// What worker.js calls.
#include <emscripten.h>
#include <memory>

#include "page.hpp"

namespace {

std::unique_ptr<page::Page> opened;
page::Tick ticks[64];
double line[3 * 160];
float samples[64 * 48];

}  // namespace

extern "C" {

EMSCRIPTEN_KEEPALIVE void page_open(int scene) { opened = std::make_unique<page::Page>(page::scene(scene)); }
EMSCRIPTEN_KEEPALIVE void page_open_own(double length, double thickness, double young, double density,
                                        int ends) {
  opened = std::make_unique<page::Page>(
      page::own_scene(length, thickness, {young, density}, static_cast<page::Ends>(ends)));
}
EMSCRIPTEN_KEEPALIVE int page_has(int model) { return opened->has(model); }
EMSCRIPTEN_KEEPALIVE void page_choose(int model) { opened->choose(model); }
EMSCRIPTEN_KEEPALIVE double page_error(int model) { return opened->error(model); }
EMSCRIPTEN_KEEPALIVE double page_bound() { return opened->bound(); }
EMSCRIPTEN_KEEPALIVE double page_stroke(int model, int count) { return opened->stroke(model, count); }
EMSCRIPTEN_KEEPALIVE void page_place(double x, double w) { opened->place({x, w}); }
EMSCRIPTEN_KEEPALIVE void page_rewind() { opened->rewind(); }
/// So many ticks, 64 at most.   @return  the first of them
EMSCRIPTEN_KEEPALIVE const page::Tick* page_go(int count, double x, double w) {
  for (int k = 0; k < count; ++k) ticks[k] = opened->go({x, w});
  return ticks;
}
EMSCRIPTEN_KEEPALIVE const page::Tick* page_demonstrate(int count) {
  for (int k = 0; k < count; ++k) ticks[k] = opened->demonstrate();
  return ticks;
}
/// What was heard in the last ticks.
EMSCRIPTEN_KEEPALIVE int page_hear() { return opened->hear(samples, 64 * 48); }
EMSCRIPTEN_KEEPALIVE const float* page_samples() { return samples; }
EMSCRIPTEN_KEEPALIVE double page_length() {
  return opened->scene().beam.length() + opened->scene().beam.right_place().u;
}
EMSCRIPTEN_KEEPALIVE double page_stiffness() { return opened->scene().stiffness; }
EMSCRIPTEN_KEEPALIVE double page_reach() { return opened->scene().reach(); }
EMSCRIPTEN_KEEPALIVE double page_from() { return opened->scene().from; }
EMSCRIPTEN_KEEPALIVE double page_to() { return opened->scene().to; }
EMSCRIPTEN_KEEPALIVE double page_depth() { return opened->scene().depth; }
EMSCRIPTEN_KEEPALIVE int page_demonstration() { return opened->demonstration(); }
/// x, w [m] and bending strain, of so many points.
EMSCRIPTEN_KEEPALIVE int page_points() { return opened->line(line); }
EMSCRIPTEN_KEEPALIVE const double* page_line() { return line; }
}
