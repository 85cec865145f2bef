/* Rods as C describes them: what their weight, sections and natural shapes do to them while nobody touches them. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "hapbeam.h"

static int faults = 0;
#define CHECK(what) ((what) ? (void)0 : (void)(++faults, printf("line %d: %s\n", __LINE__, #what)))

static const double length = 0.2, young = 200e9, shear = 77e9;

static hapbeam_rod wire(void) { return hapbeam_wire(length, 0.002, young, shear, HAPBEAM_CLAMPED, HAPBEAM_FREE); }

static void tip_of(const hapbeam_rod* rod, int kinematics, double tip[3]) {
  char why[HAPBEAM_MESSAGE];
  double line[3 * 2] = {NAN, NAN, NAN, NAN, NAN, NAN};
  hapbeam_stylus* stylus = hapbeam_stylus_create(rod, kinematics, 32, 0.003, 0, 0, 0, 0, why);
  CHECK(stylus || !puts(why));
  CHECK(hapbeam_stylus_shape(stylus, line, 2) == 2);
  memcpy(tip, line + 3, 3 * sizeof(double));
  hapbeam_stylus_destroy(stylus);
}

/* Deflection of the free end: M(L - s)/EI, summed by Simpson's rule; q: load per length. */
static double sag(double stiffness, double (*size)(double), double (*load)(double)) {
  enum { n = 400 };
  const double h = length / n;
  double shear_force = 0, moment = 0, sum = 0;
  int i;
  /* From the tip inward; the loads here are at most quadratic, which Simpson's rule takes exactly. */
  for (i = n; i > 0; --i) {
    const double end = i * h, a = size(end - 1e-12), m = size(end - h / 2), b = size(end - h + 1e-12);
    const double q0 = load(end - 1e-12), q1 = load(end - h / 2), q2 = load(end - h + 1e-12);
    const double v1 = shear_force + h * (5 * q0 + 8 * q1 - q2) / 24, v2 = shear_force + h * (q0 + 4 * q1 + q2) / 6;
    const double m1 = moment + h * (5 * shear_force + 8 * v1 - v2) / 24, m2 = moment + h * (shear_force + 4 * v1 + v2) / 6;
    sum += h / 6 *
           (moment * (length - end) / pow(a, 4) + 4 * m1 * (length - end + h / 2) / pow(m, 4) +
            m2 * (length - end + h) / pow(b, 4));
    shear_force = v2, moment = m2;
  }
  return sum / stiffness;
}
static double same(double s) { return (void)s, 1; }
static double taper(double s) { return 1 - 0.5 * s / 0.2; }
static double taper_squared(double s) { return taper(s) * taper(s); }
static double step(double s) { return s < 0.1 ? 1 : 0.6; }

static void heavy(void) {
  int kinematics;
  for (kinematics = HAPBEAM_ROUND_ROD; kinematics <= HAPBEAM_TWISTED_ROD; ++kinematics) {
    const hapbeam_part tapers[1] = {{0.2, 1, 0.5}}, steps[2] = {{0.1, 1, 1}, {0.2, 0.6, 0.6}};
    hapbeam_rod rod = wire();
    double tip[3], q;
    rod.density = 7850, rod.gravity[2] = -9.81;
    q = 7850 * 9.81 * 3.141592653589793 * 0.001 * 0.001;
    /* The sag is 0.3 mm: what is left out is (0.3/200)^2. */
    tip_of(&rod, kinematics, tip);
    CHECK(fabs(tip[2] / (-q * pow(length, 4) / (8 * rod.bending_stiffness1)) - 1) < 1e-5 && fabs(tip[1]) < 1e-15);
    CHECK(fabs(q * sag(rod.bending_stiffness1, same, same) * 8 * rod.bending_stiffness1 / (q * pow(length, 4)) - 1) < 1e-9);
    rod.parts = tapers, rod.part_count = 1;
    tip_of(&rod, kinematics, tip);
    CHECK(fabs(tip[2] / (-q * sag(rod.bending_stiffness1, taper, taper_squared)) - 1) < 1e-5);
    /* A dead load is not of the section. */
    rod.density = 0, rod.load[2] = -q;
    tip_of(&rod, kinematics, tip);
    CHECK(fabs(tip[2] / (-q * sag(rod.bending_stiffness1, taper, same)) - 1) < 1e-5);
    rod.parts = steps, rod.part_count = 2;
    tip_of(&rod, kinematics, tip);
    CHECK(fabs(tip[2] / (-q * sag(rod.bending_stiffness1, step, same)) - 1) < 1e-5);
  }
}

/* A bar bends about both axes by its second moments, a tube by what its hole leaves. */
static void sections(void) {
  hapbeam_rod bar = hapbeam_bar(length, 0.004, 0.002, young, shear, HAPBEAM_CLAMPED, HAPBEAM_FREE);
  hapbeam_rod square = hapbeam_bar(length, 0.002, 0.002, young, shear, HAPBEAM_CLAMPED, HAPBEAM_FREE);
  hapbeam_rod tube = hapbeam_tube(length, 0.002, 0.001, young, shear, HAPBEAM_CLAMPED, HAPBEAM_FREE);
  const double q = 0.2, whole = wire().bending_stiffness1;
  double tip[3];
  bar.load[1] = bar.load[2] = q;
  tip_of(&bar, HAPBEAM_TWISTED_ROD, tip);
  /* Deflections of 1e-4: (1e-4/0.2)^2 is left out, and that the bent bar twists. */
  CHECK(fabs(tip[2] / (q * pow(length, 4) / (8 * young * 0.004 * pow(0.002, 3) / 12)) - 1) < 1e-4);
  CHECK(fabs(tip[1] / (q * pow(length, 4) / (8 * young * 0.002 * pow(0.004, 3) / 12)) - 1) < 1e-4);
  CHECK(bar.thickness == 0.002 && fabs(bar.area / 8e-6 - 1) < 1e-12);
  /* Saint-Venant's J of a square: 0.1406 a^4. */
  CHECK(fabs(square.torsional_stiffness / (shear * 0.14058 * pow(0.002, 4)) - 1) < 1e-4);
  CHECK(fabs(tube.bending_stiffness1 / (whole * 15 / 16) - 1) < 1e-12 && tube.bending_stiffness2 == tube.bending_stiffness1);
  CHECK(fabs(tube.torsional_stiffness / (2 * shear / young * tube.bending_stiffness1) - 1) < 1e-12);
  CHECK(fabs(tube.axial_stiffness / (young * tube.area) - 1) < 1e-12 && tube.thickness == 0.002);
  CHECK(hapbeam_tube(length, 0.002, 0, young, shear, 1, 0).bending_stiffness1 == whole);
}

/* Three quarters of a circle, and straight on from there. */
static void curved(void) {
  const double r = 0.02, pi = 3.141592653589793;
  hapbeam_arc arcs[1] = {{0, 0, 0, 0}};
  hapbeam_rod rod = wire();
  double tip[3];
  arcs[0].end = 1.5 * pi * r, arcs[0].curvature2 = 1 / r;
  rod.arcs = arcs, rod.arc_count = 1;
  tip_of(&rod, HAPBEAM_TWISTED_ROD, tip);
  CHECK(fabs(tip[0] + r) < 1e-12 && fabs(tip[1] - (r - (length - arcs[0].end))) < 1e-12 && fabs(tip[2]) < 1e-12);
  arcs[0].curvature1 = 1 / r, arcs[0].curvature2 = 0;
  tip_of(&rod, HAPBEAM_TWISTED_ROD, tip);
  CHECK(fabs(tip[0] + r) < 1e-12 && fabs(tip[2] + (r - (length - arcs[0].end))) < 1e-12 && fabs(tip[1]) < 1e-12);
  /* A helix: with curvature k and twist t it advances by t/sqrt(k^2 + t^2) of its length along its axis. */
  arcs[0].end = 2 * pi / hypot(40, 30), arcs[0].curvature1 = 0, arcs[0].curvature2 = 40, arcs[0].twist = 30;
  rod = hapbeam_wire(arcs[0].end, 0.002, young, shear, HAPBEAM_CLAMPED, HAPBEAM_FREE);
  rod.arcs = arcs, rod.arc_count = 1;
  tip_of(&rod, HAPBEAM_TWISTED_ROD, tip);
  CHECK(fabs(sqrt(tip[0] * tip[0] + tip[1] * tip[1] + tip[2] * tip[2]) - 0.6 * arcs[0].end) < 1e-12);
}

static void nonsense(void) {
  char why[HAPBEAM_MESSAGE];
  const hapbeam_part no_size[1] = {{0.2, 1, 0}}, too_short[1] = {{0.1, 1, 1}};
  const hapbeam_arc arcs[2] = {{0.1, 0, 5, 0}, {0.05, 0, 0, 0}};
  hapbeam_rod rod = wire();
#define REFUSED(kinematics, words)                                                      \
  (CHECK(!hapbeam_stylus_create(&rod, kinematics, 8, 0.003, 0, 0, 0, 0, why)), \
   CHECK(strstr(why, words) || !puts(why)))
  rod.parts = no_size, rod.part_count = 1;
  REFUSED(HAPBEAM_ROUND_ROD, "part to = 0");
  rod.parts = too_short;
  REFUSED(HAPBEAM_ROUND_ROD, "part end = 0.1 m");
  rod.parts = 0;
  REFUSED(HAPBEAM_ROUND_ROD, "parts = null");
  rod.parts = no_size, rod.part_count = -1;
  REFUSED(HAPBEAM_ROUND_ROD, "parts = null, or a negative count");
  rod = wire(), rod.arcs = arcs, rod.arc_count = 1;
  REFUSED(HAPBEAM_ROUND_ROD, "RoundRod");
  rod.arc_count = 2;
  REFUSED(HAPBEAM_TWISTED_ROD, "arc end = 0.05 m");
  rod = wire(), rod.density = -1;
  REFUSED(HAPBEAM_ROUND_ROD, "density = -1 kg/m");
  rod.density = 7850, rod.gravity[0] = NAN;
  REFUSED(HAPBEAM_ROUND_ROD, "gravity = nan");
  rod.gravity[0] = 0, rod.area = 0;
  REFUSED(HAPBEAM_ROUND_ROD, "area = 0 m");
  rod = hapbeam_bar(length, 0.002, -0.001, young, shear, HAPBEAM_CLAMPED, HAPBEAM_FREE);
  REFUSED(HAPBEAM_TWISTED_ROD, "thickness = -0.001 m");
  rod = hapbeam_bar(length, NAN, 0.001, young, shear, HAPBEAM_CLAMPED, HAPBEAM_FREE);
  REFUSED(HAPBEAM_TWISTED_ROD, "thickness = nan");
  rod = hapbeam_tube(length, 0.002, 0.003, young, shear, HAPBEAM_CLAMPED, HAPBEAM_FREE);
  REFUSED(HAPBEAM_ROUND_ROD, "axial stiffness = -");
  rod = hapbeam_tube(length, 0.002, -0.001, young, shear, HAPBEAM_CLAMPED, HAPBEAM_FREE);
  REFUSED(HAPBEAM_ROUND_ROD, "axial stiffness = nan");
}

int main(void) {
  heavy();
  sections();
  curved();
  nonsense();
  return faults ? 1 : 0;
}
