// A function of an Api that may throw would throw through a tick; so would one of other types convert in silence.
// expect: an Api is what hapbeam/haptics/hdapi/contract.hpp lists
#include "../haptics/hdapi/emulated_hd.hpp"

#ifdef HAPBEAM_REPAIRED
#define PROMISE noexcept
#else
#define PROMISE
#endif

struct Api : hapbeam::testing::EmulatedHd {
  static void begin_frame(unsigned device) PROMISE { hapbeam::testing::EmulatedHd::begin_frame(device); }
};

void check() { hapbeam::Hdapi<Api> device; }
