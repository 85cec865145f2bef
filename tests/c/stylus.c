/* A stylus on a rod, from C: the wrench that C++ gives, messages, and what happens to nonsense. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "hapbeam.h"

static int faults = 0;
#define CHECK(what) ((what) ? (void)0 : (void)(++faults, printf("line %d: %s\n", __LINE__, #what)))

/* The host's x, y, z are the scene's z, x, y. */
static const hapbeam_placement placement = {{0, 1, 0, 0, 0, 1, 1, 0, 0}, {0.15, 0, 0}, 1};
/* Across the rod, and turned by 0.1 rad about the host's z. */
static void pose(int tick, double position[3], double orientation[9]) {
  const double c = cos(0.1), s = sin(0.1);
  const double turned[9] = {0, -s, c, 0, c, s, -1, 0, 0};
  memcpy(orientation, turned, sizeof turned);
  position[0] = 0.03, position[1] = 1e-5 * tick, position[2] = 0.005 - 1e-5 * tick;
}

static void felt(int kinematics) {
  char why[HAPBEAM_MESSAGE] = "?";
  hapbeam_rod wire = hapbeam_wire(0.2, 0.002, 200e9, 77e9, HAPBEAM_CLAMPED, HAPBEAM_FREE);
  hapbeam_stylus* stylus = hapbeam_stylus_create(&wire, kinematics, 8, 0.003, 0.2, 0.12, 0, &placement, why);
  hapbeam_wrench w = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, 0, 0, 0, 0, 0};
  double position[3], orientation[9], line[3 * 21];
  int i;
  CHECK(stylus && why[0] == '\0');
  for (i = 0; i < 400; ++i) {
    pose(i, position, orientation);
    w = hapbeam_stylus_tick(stylus, position, orientation);
  }
  CHECK(w.pressing == 1 && w.status == HAPBEAM_OK && w.force[2] > 0.1);
  /* The force acts 30 mm from the hand, along the host's x. */
  CHECK(fabs(w.torque[1] - 0.03 * w.force[2]) < 0.1 * fabs(w.torque[1]));
  printf("%.17g %.17g %.17g %.17g %.17g %.17g\n", w.force[0], w.force[1], w.force[2], w.torque[0], w.torque[1],
         w.torque[2]);
  /* From the clamp at the host's y = -0.15 on; the tip is bent down. */
  CHECK(hapbeam_stylus_shape(stylus, line, 21) == 21);
  CHECK(fabs(line[1] + 0.15) < 1e-15 && line[2] == 0 && line[3 * 20 + 2] < -1e-4);
  hapbeam_stylus_reset(stylus);
  CHECK(hapbeam_stylus_shape(stylus, line, 21) == 21 && fabs(line[3 * 20 + 2]) < 1e-12);
  orientation[4] = NAN;
  position[1] = INFINITY;
  w = hapbeam_stylus_tick(stylus, position, orientation);
  CHECK(w.force[0] == 0 && w.force[2] == 0 && w.torque[1] == 0 && w.status == HAPBEAM_INVALID_REQUEST);
  hapbeam_stylus_destroy(stylus);
}

/* The shaft is drawn along the rod, the host's y: Coulomb's law, and the work that it takes. */
static void rubbed(int kinematics) {
  hapbeam_rod wire = hapbeam_wire(0.2, 0.002, 200e9, 77e9, HAPBEAM_CLAMPED, HAPBEAM_PINNED);
  const hapbeam_friction friction = {0.4, 0.3};
  hapbeam_stylus* stylus = hapbeam_stylus_create(&wire, kinematics, 8, 0.003, 0.2, 0.12, &friction, &placement, 0);
  hapbeam_wrench w = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, 0, 0, 0, 0, 0};
  double position[3], orientation[9], before = 0;
  int i;
  for (i = 0; i < 200; ++i) {
    double normal = 0, tangential = 0;
    int k;
    pose(0, position, orientation);
    position[1] = i < 100 ? -0.03 : -0.03 + 1e-4 * (i - 100), position[2] = 0.0045 - 1e-5 * (i < 100 ? i : 100);
    w = hapbeam_stylus_tick(stylus, position, orientation);
    for (k = 0; k < 3; ++k) normal += pow(w.force[k] - w.friction[k], 2), tangential += pow(w.friction[k], 2);
    CHECK(sqrt(tangential) <= 0.4 * sqrt(normal) * (1 + 1e-5) && w.dissipated >= before);
    before = w.dissipated;
    if (i == 199) CHECK(fabs(sqrt(tangential / normal) / 0.3 - 1) < 1e-5);
  }
  CHECK(w.pressing == 1 && w.status == HAPBEAM_OK && w.sliding == 1 && w.friction[1] < 0);
  CHECK(w.dissipated > 0.5 * -w.friction[1] * 0.01);
  hapbeam_stylus_destroy(stylus);
}

static void nonsense(void) {
  char why[HAPBEAM_MESSAGE];
  hapbeam_rod good = hapbeam_wire(0.2, 0.002, 200e9, 77e9, HAPBEAM_CLAMPED, HAPBEAM_FREE), bad;
  hapbeam_placement skew = hapbeam_placement_at(0, 0, 0, 1), flat = hapbeam_placement_at(0, 0, 0, 0);
  hapbeam_stylus* stylus;
  const hapbeam_friction sticky = {3, 0};
  double numbers[9] = {0};
  skew.rotation[1] = 0.5;
#define REFUSED(create, words) (CHECK(!(create)), CHECK(strstr(why, words) || !puts(why)))
#define CREATE(rod, kinematics, elements, radius, length, ahead, place) \
  hapbeam_stylus_create(rod, kinematics, elements, radius, length, ahead, 0, place, why)
  REFUSED(CREATE(0, HAPBEAM_ROUND_ROD, 8, 0.003, 0, 0, 0), "rod = null");
  REFUSED(CREATE(&good, 7, 8, 0.003, 0, 0, 0), "kinematics = 7");
  REFUSED(CREATE(&good, HAPBEAM_ROUND_ROD, 1, 0.003, 0, 0, 0), "elements = 1");
  REFUSED(CREATE(&good, HAPBEAM_ROUND_ROD, 8, NAN, 0, 0, 0), "avatar_radius");
  REFUSED(CREATE(&good, HAPBEAM_ROUND_ROD, 8, 0.003, -1, 0, 0), "stylus length = -1 m");
  REFUSED(CREATE(&good, HAPBEAM_ROUND_ROD, 8, 0.003, 1, NAN, 0), "stylus ahead");
  REFUSED(CREATE(&good, HAPBEAM_ROUND_ROD, 8, 0.003, 0, 0, &skew), "placement rotation");
  REFUSED(CREATE(&good, HAPBEAM_ROUND_ROD, 8, 0.003, 0, 0, &flat), "placement scale = 0");
  bad = good, bad.right = HAPBEAM_ROLLER;
  REFUSED(CREATE(&bad, HAPBEAM_ROUND_ROD, 8, 0.003, 0, 0, 0), "right = 3");
  bad = good, bad.left = HAPBEAM_FREE;
  REFUSED(CREATE(&bad, HAPBEAM_ROUND_ROD, 8, 0.003, 0, 0, 0), "mechanism");
  bad = good, bad.torsional_stiffness = 0;
  REFUSED(CREATE(&bad, HAPBEAM_TWISTED_ROD, 8, 0.003, 0, 0, 0), "torsion stiffness = 0");
  bad = good, bad.load[1] = NAN;
  REFUSED(CREATE(&bad, HAPBEAM_ROUND_ROD, 8, 0.003, 0, 0, 0), "load = nan");
  CHECK(!hapbeam_stylus_create(&good, HAPBEAM_ROUND_ROD, 8, 0.003, 0, 0, &sticky, 0, why) && strstr(why, "sticking = 3"));
  stylus = hapbeam_stylus_create(&good, HAPBEAM_ROUND_ROD, 8, 0.003, 0.1, 0, 0, 0, 0);
  CHECK(stylus && hapbeam_stylus_shape(stylus, numbers, 1) == 0 && hapbeam_stylus_shape(stylus, 0, 9) == 0);
  CHECK(hapbeam_stylus_tick(stylus, 0, numbers).status == HAPBEAM_INVALID_REQUEST);
  CHECK(hapbeam_stylus_tick(stylus, numbers, 0).status == HAPBEAM_INVALID_REQUEST);
  hapbeam_stylus_destroy(stylus);
  CHECK(hapbeam_stylus_tick(0, numbers, numbers).status == HAPBEAM_INVALID_REQUEST);
  CHECK(hapbeam_stylus_shape(0, numbers, 3) == 0);
  hapbeam_stylus_reset(0), hapbeam_stylus_destroy(0);
}

int main(void) {
  felt(HAPBEAM_ROUND_ROD);
  felt(HAPBEAM_TWISTED_ROD);
  rubbed(HAPBEAM_ROUND_ROD);
  rubbed(HAPBEAM_TWISTED_ROD);
  nonsense();
  return faults ? 1 : 0;
}
