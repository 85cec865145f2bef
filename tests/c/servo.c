/* The whole loop, from C: what is sent to known devices and to one's own, and what each tick was. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "hapbeam.h"

static int faults = 0;
#define CHECK(what) ((what) ? (void)0 : (void)(++faults, printf("line %d: %s\n", __LINE__, #what)))

static const double still[3] = {0, 0, 0};

static hapbeam_touch* bar(void) {
  hapbeam_beam beam = hapbeam_rectangle(2.54, 0.0254, 0.0254, 206.84e9, HAPBEAM_PINNED, HAPBEAM_PINNED);
  return hapbeam_touch_create(&beam, HAPBEAM_VON_KARMAN, 16, 0.01, 0, 0);
}

static hapbeam_device omega(void) {
  hapbeam_device device;
  char why[HAPBEAM_MESSAGE] = "?";
  CHECK(hapbeam_known_device("omega.3", &device, why) == 1 && why[0] == '\0');
  return device;
}

static void known(void) {
  hapbeam_touch* touch = bar();
  const hapbeam_device device = omega();
  hapbeam_servo* servo = hapbeam_servo_create(touch, &device, 1.27, 0.0227, 1, 0);
  double line[2 * 101], force[3] = {1, 1, 1}, position[3] = {0, 0, 0};
  int i;
  CHECK(device.peak_force == 12 && device.max_stiffness == 5000 && device.period == 1e-3 && servo);
  for (i = 0; i < 1000; ++i) {
    position[1] = -1e-5 * i;
    CHECK(hapbeam_servo_tick(servo, position, still, 1e-3, force) >= 0);
  }
  CHECK(force[1] > 1 && force[1] <= 12 && force[2] == 0);
  CHECK(hapbeam_servo_shape(servo, line, 101) == 101 && line[2 * 50 + 1] < 0);
  hapbeam_servo_reset(servo);
  hapbeam_servo_tick(servo, position, still, NAN, force);
  CHECK(isfinite(force[1]));
  hapbeam_servo_destroy(servo);
  /* Three ticks after a start and after a pause: 3/200 of the device's 12 N at most. */
  servo = hapbeam_servo_create(touch, &device, 1.27, 0.0227, 1, 0);
  position[1] = -0.01;
  for (i = 0; i < 700; ++i) {
    hapbeam_servo_tick(servo, position, still, i % 350 == 0 ? 0.25 : 1e-3, force);
    if (i % 350 < 3) CHECK(force[1] > 0 && force[1] <= 12 * (i % 350 + 1) / 200.0 * (1 + 1e-9));
  }
  CHECK(force[1] > 1);
  hapbeam_servo_destroy(servo);
  hapbeam_touch_destroy(touch);
}

/* A device with a sixth of the force: the guard cuts what the other one sends, and each tick says what it was. */
static void own(void) {
  hapbeam_touch* touch = bar();
  hapbeam_device device = omega();
  hapbeam_servo *strong = hapbeam_servo_create(touch, &device, 1.27, 0.0227, 1, 0), *weak;
  double position[3] = {0, 0.01, 0}, force[3], cut[3], strain, place, line[2 * 3], s_d[2] = {1.27, 0};
  hapbeam_response response;
  int i;
  device.peak_force = 2, device.continuous_force = 2;
  weak = hapbeam_servo_create(touch, &device, 1.27, 0.0227, 1, 0);
  CHECK(strong && weak && hapbeam_servo_loop(weak) == HAPBEAM_LOOP_FREE);
  CHECK(hapbeam_servo_tick(weak, position, still, 1e-3, cut) == HAPBEAM_OK);
  CHECK(hapbeam_servo_loop(weak) == HAPBEAM_LOOP_DEVICE);
  hapbeam_servo_tick(weak, position, still, 1e-3, cut);
  CHECK(hapbeam_servo_loop(weak) == HAPBEAM_LOOP_FREE && cut[1] == 0);
  CHECK(fabs(hapbeam_servo_peak_strain(weak, 0)) < 1e-15);
  for (i = 0; i < 400; ++i) {
    position[1] = -0.0005;
    hapbeam_servo_tick(weak, position, still, 1e-3, cut);
    if (i < 150) CHECK(hapbeam_servo_loop(weak) == HAPBEAM_LOOP_ENGAGING);
  }
  CHECK(hapbeam_servo_loop(weak) == HAPBEAM_LOOP_TOUCHING && cut[1] > 0.1 && cut[1] < 2);
  for (i = 0; i < 1000; ++i) {
    position[1] = -1e-5 * i;
    hapbeam_servo_tick(strong, position, still, 1e-3, force);
    hapbeam_servo_tick(weak, position, still, 1e-3, cut);
  }
  CHECK(force[1] > 3 && hapbeam_servo_loop(strong) == HAPBEAM_LOOP_TOUCHING);
  CHECK(fabs(cut[1] - 2) < 1e-9 && hapbeam_servo_loop(weak) == HAPBEAM_LOOP_LIMITED);
  /* The strain is that of the beam as it lies: pressed so far, to the tolerance of the solver. */
  CHECK(hapbeam_servo_shape(strong, line, 3) == 3);
  s_d[1] = line[3];
  CHECK(hapbeam_touch_presses(touch, s_d, 1, &response) == 1);
  strain = hapbeam_servo_peak_strain(strong, &place);
  CHECK(fabs(strain / hapbeam_touch_peak_strain(touch, 0) - 1) < 1e-6 && fabs(place - 1.27) < 1e-6);
  position[1] = NAN;
  CHECK(hapbeam_servo_tick(strong, position, still, 1e-3, force) == HAPBEAM_INVALID_REQUEST);
  CHECK(hapbeam_servo_loop(strong) == HAPBEAM_LOOP_NO_ANSWER && force[1] == 0);
  hapbeam_servo_destroy(strong), hapbeam_servo_destroy(weak);
  hapbeam_touch_destroy(touch);
}

/* The friction of the touch is the servo's: a hand that is drawn along a ruler is held back. */
static void rubbed(void) {
  hapbeam_beam ruler = hapbeam_rectangle(0.3, 0.025, 0.001, 200e9, HAPBEAM_CLAMPED, HAPBEAM_PINNED);
  const hapbeam_friction friction = {0.3, 0.3};
  const hapbeam_device device = omega();
  double along[2] = {0, 0};
  int rough;
  for (rough = 0; rough < 2; ++rough) {
    hapbeam_touch* touch = hapbeam_touch_create(&ruler, HAPBEAM_COROTATIONAL, 8, 0.005, rough ? &friction : 0, 0);
    hapbeam_servo* servo = hapbeam_servo_create(touch, &device, 0.12, 0.0055, 1, 0);
    double position[3] = {0, 0, 0}, force[3] = {0, 0, 0};
    int i;
    for (i = 0; i < 800; ++i) {
      position[0] = i < 400 ? 0 : 5e-5 * (i - 400), position[1] = -5e-6 * (i < 400 ? i : 400);
      CHECK(hapbeam_servo_tick(servo, position, still, 1e-3, force) == HAPBEAM_OK);
    }
    along[rough] = force[0] / force[1];
    hapbeam_servo_destroy(servo), hapbeam_touch_destroy(touch);
  }
  /* Normal and friction turn with the ruler, by some hundredths. */
  CHECK(fabs(along[1] - along[0] + 0.3) < 0.02);
}

static void nonsense(void) {
  char why[HAPBEAM_MESSAGE];
  hapbeam_touch* touch = bar();
  const hapbeam_device good = omega();
  hapbeam_device bad = good;
  double force[3] = {1, 1, 1};
#define REFUSED(create, words) (CHECK(!(create)), CHECK(strstr(why, words) || !puts(why)))
  REFUSED(hapbeam_known_device("teapot", &bad, why), "device 'teapot'");
  REFUSED(hapbeam_known_device(0, &bad, why), "name = null");
  CHECK(bad.peak_force == good.peak_force);
  bad.period = -1;
  REFUSED(hapbeam_servo_create(touch, &bad, 0, 0, 1, why), "period = -1 s");
  bad = good, bad.peak_force = 0;
  REFUSED(hapbeam_servo_create(touch, &bad, 0, 0, 1, why), "peak_force = 0 N");
  REFUSED(hapbeam_servo_create(touch, 0, 0, 0, 1, why), "device = null");
  REFUSED(hapbeam_servo_create(touch, &good, 0, 0, 0, why), "scale = 0");
  REFUSED(hapbeam_servo_create(0, &good, 0, 0, 1, why), "touch = null");
  hapbeam_touch_destroy(touch);
  CHECK(hapbeam_servo_tick(0, still, still, 1e-3, force) == HAPBEAM_INVALID_REQUEST && force[0] == 0);
  CHECK(hapbeam_servo_shape(0, force, 1) == 0 && hapbeam_servo_peak_strain(0, 0) == -1);
  CHECK(hapbeam_servo_loop(0) == HAPBEAM_LOOP_NO_ANSWER);
  hapbeam_servo_reset(0), hapbeam_servo_destroy(0);
  CHECK(strcmp(hapbeam_loop_name(HAPBEAM_LOOP_ENGAGING), "engaging") == 0);
  CHECK(strcmp(hapbeam_loop_name(HAPBEAM_LOOP_DEVICE), "device") == 0 && strcmp(hapbeam_loop_name(8), "unknown") == 0);
}

int main(void) {
  known();
  own();
  rubbed();
  nonsense();
  return faults ? 1 : 0;
}
