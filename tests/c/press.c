/* A beam that is touched or pressed, from C: forces that C++ gives, messages, and what happens to nonsense. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "hapbeam.h"

static int faults = 0;
#define CHECK(what) ((what) ? (void)0 : (void)(++faults, printf("line %d: %s\n", __LINE__, #what)))

static void touched(void) {
  char why[HAPBEAM_MESSAGE] = "?";
  hapbeam_beam bar = hapbeam_rectangle(2.54, 0.0254, 0.0254, 206.84e9, HAPBEAM_PINNED, HAPBEAM_PINNED);
  hapbeam_touch* touch = hapbeam_touch_create(&bar, HAPBEAM_VON_KARMAN, 16, 0.01, 0, why);
  hapbeam_contact felt = {{0, 0}, {0, 0}, 0, 0, 0, 0, 0, 0};
  double bent, strain, place, line[2 * 101];
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
  strain = hapbeam_touch_peak_strain(touch, &place);
  CHECK(strain > bent && strain < bent + 4.5 * felt.d * felt.d / (2.54 * 2.54));
  CHECK(fabs(place - felt.s) < 1e-9 && hapbeam_touch_peak_strain(0, 0) == -1);
  CHECK(fabs(line[2 * 50 + 1] - felt.d) < 1e-12 && line[1] == 0 && fabs(line[2 * 100] - 2.54) < 1e-12);
  hapbeam_touch_reset(touch);
  felt = hapbeam_touch_tick(touch, NAN, 0);
  CHECK(felt.force[0] == 0 && felt.force[1] == 0 && felt.status == HAPBEAM_INVALID_REQUEST);
  hapbeam_touch_destroy(touch);
}

/* Without an avatar: 48 EI/L^3 of a bar between two hinges, and then a touch that knows nothing of it. */
static void pressed(void) {
  hapbeam_beam bar = hapbeam_circle(1, 0.01, 210e9, HAPBEAM_PINNED, HAPBEAM_PINNED);
  const double stiffness = 48 * bar.bending_stiffness;
  int kinematics, i;
  for (kinematics = HAPBEAM_LINEAR; kinematics <= HAPBEAM_COROTATIONAL; ++kinematics) {
    hapbeam_touch* touch = hapbeam_touch_create(&bar, kinematics, 8, 0.01, 0, 0);
    hapbeam_touch* other = hapbeam_touch_create(&bar, kinematics, 8, 0.01, 0, 0);
    const double s_d[8] = {0.5, -1e-6, 0.5, 2e-6, 0.5, NAN, 0.3, -1e-3};
    double path[2 * 50], line[2 * 11];
    hapbeam_response responses[4];
    hapbeam_contact felt[50];
    CHECK(hapbeam_touch_tick(touch, 0.5, 0.01).pressing == 1);
    CHECK(hapbeam_touch_presses(touch, s_d, 4, responses) == 4);
    for (i = 0; i < 2; ++i) {
      /* The stretch adds 3/2 (d/r)^2 with r = 2.5 mm: 1e-6. */
      CHECK(responses[i].status == HAPBEAM_OK);
      CHECK(fabs(responses[i].force / (stiffness * s_d[2 * i + 1]) - 1) < 3e-6);
    }
    CHECK(responses[2].status == HAPBEAM_INVALID_REQUEST && responses[2].force == 0);
    CHECK(hapbeam_touch_shape(touch, line, 11) == 11 && fabs(line[2 * 3 + 1] + 1e-3) < 1e-6);
    /* One by one, and all at once. */
    for (i = 0; i < 50; ++i) path[2 * i] = 0.4, path[2 * i + 1] = 0.02 - 3e-4 * i;
    CHECK(hapbeam_touch_ticks(touch, path, 50, felt) == 50 && felt[0].pressing == 0 && felt[49].pressing == 1);
    for (i = 0; i < 50; ++i) {
      const hapbeam_contact one = hapbeam_touch_tick(other, path[2 * i], path[2 * i + 1]);
      CHECK(felt[i].force[0] == one.force[0] && felt[i].force[1] == one.force[1] && felt[i].s == one.s);
      CHECK(felt[i].d == one.d && felt[i].status == one.status);
    }
    hapbeam_touch_destroy(touch), hapbeam_touch_destroy(other);
  }
}

/* An avatar that is drawn along a ruler: Coulomb's law, and the work that it takes. */
static void rubbed(void) {
  hapbeam_beam ruler = hapbeam_rectangle(0.3, 0.025, 0.001, 200e9, HAPBEAM_CLAMPED, HAPBEAM_PINNED);
  const hapbeam_friction friction = {0.4, 0.3};
  hapbeam_touch* touch = hapbeam_touch_create(&ruler, HAPBEAM_COROTATIONAL, 8, 0.005, &friction, 0);
  hapbeam_contact felt, before = {{0, 0}, {0, 0}, 0, 0, 0, 0, 0, 0};
  int i;
  for (i = 0; i < 100; ++i) before = hapbeam_touch_tick(touch, 0.12, 0.0055 - 2e-5 * i);
  for (i = 0; i < 100; ++i) {
    double tangential, normal;
    felt = hapbeam_touch_tick(touch, 0.12 + 1e-4 * i, 0.0035);
    tangential = hypot(felt.friction[0], felt.friction[1]);
    normal = hypot(felt.force[0] - felt.friction[0], felt.force[1] - felt.friction[1]);
    CHECK(felt.pressing == 1 && felt.dissipated >= before.dissipated);
    CHECK(tangential <= 0.4 * normal * (1 + 1e-5));
    before = felt;
    if (i == 99) {
      CHECK(felt.sliding == 1 && felt.friction[0] < 0 && fabs(tangential / (0.3 * normal) - 1) < 1e-5);
      CHECK(felt.dissipated > 0.5 * tangential * 0.01);
    }
  }
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
  const hapbeam_friction rough = {0.3, 0.2}, sticky = {3, 0.2}, faster = {0.2, 0.3};
  hapbeam_touch* touch;
  hapbeam_contact felt;
  hapbeam_response response;
  double numbers[2] = {0.5, 0.1};
#define REFUSED(create, words) (CHECK(!(create)), CHECK(strstr(why, words) || !puts(why)))
  REFUSED(hapbeam_touch_create(&bad, HAPBEAM_VON_KARMAN, 8, 0.01, 0, why), "thickness = -0.01 m");
  REFUSED(hapbeam_touch_create(&mechanism, HAPBEAM_VON_KARMAN, 8, 0.01, 0, why), "mechanism");
  REFUSED(hapbeam_touch_create(&end, HAPBEAM_VON_KARMAN, 8, 0.01, 0, why), "right = 17");
  REFUSED(hapbeam_touch_create(&good, 9, 8, 0.01, 0, why), "kinematics = 9");
  REFUSED(hapbeam_touch_create(&good, HAPBEAM_LINEAR, 1, 0.01, 0, why), "elements = 1");
  REFUSED(hapbeam_touch_create(&good, HAPBEAM_LINEAR, 8, NAN, 0, why), "avatar_radius");
  REFUSED(hapbeam_touch_create(0, HAPBEAM_LINEAR, 8, 0.01, 0, why), "beam = null");
  REFUSED(hapbeam_touch_create(&good, HAPBEAM_VON_KARMAN, 8, 0.01, &rough, why), "friction = 0.3");
  REFUSED(hapbeam_touch_create(&good, HAPBEAM_COROTATIONAL, 8, 0.01, &sticky, why), "friction sticking = 3");
  REFUSED(hapbeam_touch_create(&good, HAPBEAM_COROTATIONAL, 8, 0.01, &faster, why), "friction sliding = 0.3");
  REFUSED(hapbeam_touch_load("/nonexistent", 0.01, why), "/nonexistent");
  REFUSED(hapbeam_touch_load(0, 0.01, why), "path = null");
  touch = hapbeam_touch_create(&good, HAPBEAM_COROTATIONAL, 8, 0.01, 0, 0);
  CHECK(touch && hapbeam_touch_ticks(touch, numbers, -1, &felt) == 0 && hapbeam_touch_ticks(touch, 0, 1, &felt) == 0);
  CHECK(hapbeam_touch_presses(touch, numbers, 1, 0) == 0 && hapbeam_touch_presses(touch, 0, 1, &response) == 0);
  hapbeam_touch_destroy(touch);
  CHECK(hapbeam_touch_tick(0, 0, 0).status == HAPBEAM_INVALID_REQUEST);
  CHECK(hapbeam_touch_shape(0, numbers, 2) == 0 && hapbeam_touch_ticks(0, numbers, 1, &felt) == 0);
  CHECK(hapbeam_touch_presses(0, numbers, 1, &response) == 0);
  hapbeam_touch_reset(0), hapbeam_touch_destroy(0);
  CHECK(strcmp(hapbeam_status_name(HAPBEAM_SNAPPED), "snapped") == 0 && strcmp(hapbeam_status_name(99), "unknown") == 0);
  CHECK(hapbeam_version() >= 100);
}

int main(int argc, char** argv) {
  touched();
  pressed();
  rubbed();
  if (argc > 1) trained(argv[1]);
  nonsense();
  return faults ? 1 : 0;
}
