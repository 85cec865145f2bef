/* The C interface, from C: forces that C++ gives, messages, and what happens to nonsense. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "hapbeam.h"

static int faults = 0;
#define CHECK(what) ((what) ? (void)0 : (void)(++faults, printf("line %d: %s\n", __LINE__, #what)))

static void touch_and_servo(void) {
  char why[HAPBEAM_MESSAGE] = "?";
  hapbeam_beam bar = hapbeam_rectangle(2.54, 0.0254, 0.0254, 206.84e9, HAPBEAM_PINNED, HAPBEAM_PINNED);
  hapbeam_touch* touch = hapbeam_touch_create(&bar, HAPBEAM_VON_KARMAN, 16, 0.01, why);
  hapbeam_contact felt = {{0, 0}, 0, 0, 0, 0};
  double bent, strain, line[2 * 101], force[3] = {1, 1, 1}, position[3] = {0, 0, 0}, velocity[3] = {0, 0, 0};
  hapbeam_servo* servo;
  int i;
  CHECK(touch && why[0] == '\0');
  for (i = 0; i < 1000; ++i) felt = hapbeam_touch_tick(touch, 1.27, 0.03 - 1.73e-5 * i);
  CHECK(felt.pressing == 1 && felt.status == HAPBEAM_OK);
  /* 48 EI/L^3 and more, for the bar is stretched. */
  CHECK(felt.force[1] > 48 * bar.bending_stiffness / pow(2.54, 3) * -felt.d && felt.d < -0.009);
  printf("%.17g\n", felt.force[1]);
  CHECK(hapbeam_touch_shape(touch, line, 101) == 101);
  /* 12 EI d/L^2 bends it, and the tension stretches it, too: (3d/L)^2/2 at most. */
  bent = 0.0127 * 12 * -felt.d / (2.54 * 2.54);
  strain = hapbeam_touch_peak_strain(touch, force);
  CHECK(strain > bent && strain < bent + 4.5 * felt.d * felt.d / (2.54 * 2.54));
  CHECK(fabs(force[0] - felt.s) < 1e-9 && hapbeam_touch_peak_strain(0, 0) == -1);
  CHECK(fabs(line[2 * 50 + 1] - felt.d) < 1e-12 && line[1] == 0 && fabs(line[2 * 100] - 2.54) < 1e-12);
  hapbeam_touch_reset(touch);
  felt = hapbeam_touch_tick(touch, NAN, 0);
  CHECK(felt.force[0] == 0 && felt.force[1] == 0 && felt.status == HAPBEAM_INVALID_REQUEST);

  servo = hapbeam_servo_create(touch, "omega.3", 1e-3, 1.27, 0.0227, 1, why);
  CHECK(servo && why[0] == '\0');
  for (i = 0; i < 1000; ++i) {
    position[1] = -1e-5 * i;
    CHECK(hapbeam_servo_tick(servo, position, velocity, 1e-3, force) >= 0);
  }
  CHECK(force[1] > 1 && force[1] <= 12 && force[2] == 0);
  CHECK(hapbeam_servo_shape(servo, line, 101) == 101 && line[2 * 50 + 1] < 0);
  hapbeam_servo_reset(servo);
  hapbeam_servo_tick(servo, position, velocity, NAN, force);
  CHECK(isfinite(force[1]));
  hapbeam_servo_destroy(servo);
  /* Three ticks after a start and after a pause: 3/200 of the device's 12 N at most. */
  servo = hapbeam_servo_create(touch, "omega.3", 1e-3, 1.27, 0.0227, 1, why);
  position[1] = -0.01;
  for (i = 0; i < 700; ++i) {
    hapbeam_servo_tick(servo, position, velocity, i % 350 == 0 ? 0.25 : 1e-3, force);
    if (i % 350 < 3) CHECK(force[1] > 0 && force[1] <= 12 * (i % 350 + 1) / 200.0 * (1 + 1e-9));
  }
  CHECK(force[1] > 1);
  hapbeam_servo_destroy(servo);
  hapbeam_touch_destroy(touch);
}

static void trained(const char* model_file) {
  char why[HAPBEAM_MESSAGE];
  hapbeam_touch* touch = hapbeam_touch_load(model_file, 0.005, why);
  if (touch) {
    CHECK(hapbeam_touch_tick(touch, 0.5, 0.1).pressing == 0);
    hapbeam_touch_destroy(touch);
  } else {
    CHECK(strstr(why, "built without model files"));
  }
}

static void nonsense(void) {
  char why[HAPBEAM_MESSAGE];
  hapbeam_beam bad = hapbeam_circle(1, -0.01, 210e9, HAPBEAM_CLAMPED, HAPBEAM_FREE);
  hapbeam_beam good = hapbeam_circle(1, 0.01, 210e9, HAPBEAM_CLAMPED, HAPBEAM_FREE);
  hapbeam_beam mechanism = hapbeam_circle(1, 0.01, 210e9, HAPBEAM_FREE, HAPBEAM_FREE);
  hapbeam_beam end = hapbeam_circle(1, 0.01, 210e9, HAPBEAM_CLAMPED, 17);
  hapbeam_touch* touch;
  double force[3] = {1, 1, 1};
  const double zero[3] = {0, 0, 0};
#define REFUSED(create, words) (CHECK(!(create)), CHECK(strstr(why, words) || !puts(why)))
  REFUSED(hapbeam_touch_create(&bad, HAPBEAM_VON_KARMAN, 8, 0.01, why), "thickness = -0.01 m");
  REFUSED(hapbeam_touch_create(&mechanism, HAPBEAM_VON_KARMAN, 8, 0.01, why), "mechanism");
  REFUSED(hapbeam_touch_create(&end, HAPBEAM_VON_KARMAN, 8, 0.01, why), "right = 17");
  REFUSED(hapbeam_touch_create(&good, 9, 8, 0.01, why), "kinematics = 9");
  REFUSED(hapbeam_touch_create(&good, HAPBEAM_LINEAR, 1, 0.01, why), "elements = 1");
  REFUSED(hapbeam_touch_create(&good, HAPBEAM_LINEAR, 8, NAN, why), "avatar_radius");
  REFUSED(hapbeam_touch_create(0, HAPBEAM_LINEAR, 8, 0.01, why), "beam = null");
  REFUSED(hapbeam_touch_load("/nonexistent", 0.01, why), "/nonexistent");
  REFUSED(hapbeam_touch_load(0, 0.01, why), "path = null");
  touch = hapbeam_touch_create(&good, HAPBEAM_COROTATIONAL, 8, 0.01, 0);
  CHECK(touch);
  REFUSED(hapbeam_servo_create(touch, "teapot", 1e-3, 0, 0, 1, why), "device 'teapot'");
  REFUSED(hapbeam_servo_create(touch, "Touch", -1, 0, 0, 1, why), "period = -1 s");
  REFUSED(hapbeam_servo_create(touch, "Touch", 1e-3, 0, 0, 0, why), "scale = 0");
  REFUSED(hapbeam_servo_create(0, "Touch", 1e-3, 0, 0, 1, why), "touch = null");
  hapbeam_touch_destroy(touch);
  CHECK(hapbeam_touch_tick(0, 0, 0).status == HAPBEAM_INVALID_REQUEST);
  CHECK(hapbeam_servo_tick(0, zero, zero, 1e-3, force) == HAPBEAM_INVALID_REQUEST && force[0] == 0);
  CHECK(hapbeam_touch_shape(0, force, 3) == 0 && hapbeam_servo_shape(0, force, 3) == 0);
  hapbeam_touch_reset(0), hapbeam_servo_reset(0), hapbeam_touch_destroy(0), hapbeam_servo_destroy(0);
  CHECK(strcmp(hapbeam_status_name(HAPBEAM_SNAPPED), "snapped") == 0 && strcmp(hapbeam_status_name(99), "unknown") == 0);
  CHECK(hapbeam_version() >= 100);
}

int main(int argc, char** argv) {
  touch_and_servo();
  if (argc > 1) trained(argv[1]);
  nonsense();
  return faults ? 1 : 0;
}
