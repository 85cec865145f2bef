/* SPDX-License-Identifier: MIT */
/* hapbeam for programs in C and for what calls C: Python, Unity, Unreal, MATLAB.

     hapbeam_beam ruler = hapbeam_rectangle(0.3, 0.025, 0.001, 210e9, HAPBEAM_CLAMPED, HAPBEAM_FREE);
     char why[HAPBEAM_MESSAGE];
     hapbeam_touch* touch = hapbeam_touch_create(&ruler, HAPBEAM_COROTATIONAL, 8, 0.005, 0, why);
     if (!touch) puts(why);
     hapbeam_contact felt = hapbeam_touch_tick(touch, 0.25, 0.004);      each millisecond
     hapbeam_touch_destroy(touch);

   SI throughout: m, N, rad, s, Pa.  x runs along the beam from its left end, w across it, up.
   Creating and destroying allocate; no exception leaves the library, and a null pointer with a message says what was wrong.
   A tick allocates nothing, waits for nobody and ends after a bounded amount of work.  Its force is finite whatever came in.
   An object belongs to one thread at a time.  A null object is accepted and gives zeros and HAPBEAM_INVALID_REQUEST. */
#ifndef HAPBEAM_H
#define HAPBEAM_H

#if defined(_WIN32) && defined(HAPBEAM_BUILDS_C)
#define HAPBEAM_API __declspec(dllexport)
#elif defined(_WIN32)
#define HAPBEAM_API __declspec(dllimport)
#else
#define HAPBEAM_API __attribute__((visibility("default")))
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* Room for a message, its final zero included. */
#define HAPBEAM_MESSAGE 512

enum { HAPBEAM_FREE, HAPBEAM_CLAMPED, HAPBEAM_PINNED, HAPBEAM_ROLLER, HAPBEAM_GUIDED }; /* how an end is held */
enum { HAPBEAM_LINEAR, HAPBEAM_VON_KARMAN, HAPBEAM_COROTATIONAL };                      /* kinematics */
enum { HAPBEAM_ROUND_ROD, HAPBEAM_TWISTED_ROD }; /* of rods: straight and round; any that bends and twists */

/* Negative: the answer is not the requested one.  Positive: it belongs to the nearest request in range. */
enum {
  HAPBEAM_OK = 0,
  HAPBEAM_OUT_OF_RANGE = 1,
  HAPBEAM_SNAPPED = 2,
  HAPBEAM_INVALID_REQUEST = -1,
  HAPBEAM_ITERATION_LIMIT = -2,
  HAPBEAM_SINGULAR = -3,
  HAPBEAM_NON_FINITE = -4
};
/* Short lower-case name of a status. */
HAPBEAM_API const char* hapbeam_status_name(int status);

/* 100 is 0.1.0. */
HAPBEAM_API int hapbeam_version(void);

typedef struct hapbeam_beam {
  double length;            /* [m] */
  double axial_stiffness;   /* EA [N] */
  double bending_stiffness; /* EI [N m^2] */
  double thickness;         /* [m] across the beam, in the plane of bending */
  double transverse_load;   /* [N/m] dead, along w */
  double axial_load;        /* [N/m] dead, along x */
  int left, right;          /* how the ends are held */
} hapbeam_beam;

/* Without dead loads.  What makes no sense is said when something is created with it.
   width: out of the plane of bending, height: in it [m]; young [Pa] */
HAPBEAM_API hapbeam_beam hapbeam_rectangle(double length, double width, double height, double young, int left,
                                           int right);
HAPBEAM_API hapbeam_beam hapbeam_circle(double length, double diameter, double young, int left, int right);

/* Coulomb's coefficients of what touches. */
typedef struct hapbeam_friction {
  double sticking; /* 0 to 2: the contact begins to slide beyond it */
  double sliding;  /* while it slides, 0 to that of sticking */
} hapbeam_friction;

/* ---- A round avatar that touches a beam ---- */

typedef struct hapbeam_touch hapbeam_touch;

typedef struct hapbeam_contact {
  double force[2];    /* [N] on the hand, x and w */
  double friction[2]; /* [N] the tangential part of it */
  double s;           /* [m] arc position of the press; 0 where nothing is touched */
  double d;           /* [m] w of the centreline there */
  double dissipated;  /* [J] by friction, since the touch began */
  int pressing;       /* 1 where the beam is touched */
  int sliding;        /* 1 where a contact with friction slides */
  int status;
} hapbeam_contact;

/* kinematics: one of the three; elements: 2 to 4096; avatar_radius [m]; friction: of HAPBEAM_COROTATIONAL, or null;
   message: HAPBEAM_MESSAGE characters, or null */
HAPBEAM_API hapbeam_touch* hapbeam_touch_create(const hapbeam_beam* beam, int kinematics, int elements,
                                                double avatar_radius, const hapbeam_friction* friction,
                                                char* message);
/* A trained model from its file, if the library was built with model files. */
HAPBEAM_API hapbeam_touch* hapbeam_touch_load(const char* path, double avatar_radius, char* message);
HAPBEAM_API void hapbeam_touch_destroy(hapbeam_touch* touch);
/* x, w [m]: the avatar's centre */
HAPBEAM_API hapbeam_contact hapbeam_touch_tick(hapbeam_touch* touch, double x, double w);
/* A tick at each of `count` places, x_w: 2 count numbers [m], into as many contacts.  Returns how many there were. */
HAPBEAM_API int hapbeam_touch_ticks(hapbeam_touch* touch, const double* x_w, int count, hapbeam_contact* felt);

typedef struct hapbeam_response {
  double force; /* [N] on the beam along w; the hand feels -force */
  int status;
} hapbeam_response;

/* Presses the beam without an avatar: `count` times one after another, s_d has arc position s and w of the centreline there,
   2 count numbers [m].  The hand is elsewhere; the next tick begins a new touch.  Returns how many there were. */
HAPBEAM_API int hapbeam_touch_presses(hapbeam_touch* touch, const double* s_d, int count, hapbeam_response* responses);
/* The hand is elsewhere: nothing is touched. */
HAPBEAM_API void hapbeam_touch_reset(hapbeam_touch* touch);
/* The centreline at `count` places from end to end, x_w: 2 count numbers [m].  Returns how many were written. */
HAPBEAM_API int hapbeam_touch_shape(const hapbeam_touch* touch, double* x_w, int count);
/* Largest strain at the surface of the beam as it is now; s: arc position where it is [m], or null.  Times Young's modulus it is
   the stress [Pa].  -1 of a trained model, which does not tell. */
HAPBEAM_API double hapbeam_touch_peak_strain(const hapbeam_touch* touch, double* s);

/* ---- The whole loop: coupling, energy monitor and force guard for a device ---- */

typedef struct hapbeam_device {
  double peak_force;          /* [N] short-term */
  double continuous_force;    /* [N] without limit of time */
  double max_stiffness;       /* [N/m] the largest that the maker states for a wall */
  double position_resolution; /* [m] */
  double friction;            /* [N] to drive the arm back by hand */
  double damping;             /* [N s/m] viscous, of the arm itself; 0 where unknown */
  double apparent_mass;       /* [kg] of the arm at its tip; 0 where unknown */
  double period;              /* [s] of the loop, on average */
} hapbeam_device;

/* The figures in hapbeam's table (docs/haptics.md) under a name, for a loop at 1 kHz.  Returns 1, or 0 and a message with the names
   that there are. */
HAPBEAM_API int hapbeam_known_device(const char* name, hapbeam_device* device, char* message);

/* What a tick of the loop was: the last that applies. */
enum {
  HAPBEAM_LOOP_FREE,         /* nothing is touched; the force is zero */
  HAPBEAM_LOOP_TOUCHING,     /* the force is that of the beam, through the coupling */
  HAPBEAM_LOOP_OUT_OF_RANGE, /* the same, of the nearest press that the model knows */
  HAPBEAM_LOOP_ENGAGING,     /* the force is coming in, after a start, a failure or a pause */
  HAPBEAM_LOOP_LIMITED,      /* the guard cut the force: what is felt is less than the beam */
  HAPBEAM_LOOP_CONTINUED,    /* the model had no answer: the last force goes on along its tangent */
  HAPBEAM_LOOP_NO_ANSWER,    /* the model failed: the force is zero and engages anew */
  HAPBEAM_LOOP_DEVICE        /* the loop begins: the first tick after a start or a reset */
};
/* Short lower-case name of what a tick was. */
HAPBEAM_API const char* hapbeam_loop_name(int loop);

typedef struct hapbeam_servo hapbeam_servo;

/* The device's origin lies at (x, w) in the scene, its x along the beam and its y along w; `scale` metres of the scene are one of the
   device's.  The servo has a beam of its own, like that of the touch, which stays yours, and the touch's friction. */
HAPBEAM_API hapbeam_servo* hapbeam_servo_create(const hapbeam_touch* touch, const hapbeam_device* device, double x,
                                                double w, double scale, char* message);
HAPBEAM_API void hapbeam_servo_destroy(hapbeam_servo* servo);
/* position [m], velocity [m/s] of the device; dt [s] since the tick before; force [N] for the device.  Returns the model's
   status.  The force comes in over 0.2 s after the first tick, a reset, a failure, or a dt of more than 0.1 s. */
HAPBEAM_API int hapbeam_servo_tick(hapbeam_servo* servo, const double position[3], const double velocity[3], double dt,
                                   double force[3]);
/* What the last tick was; HAPBEAM_LOOP_FREE before the first. */
HAPBEAM_API int hapbeam_servo_loop(const hapbeam_servo* servo);
/* As hapbeam_touch_peak_strain(), of the last tick. */
HAPBEAM_API double hapbeam_servo_peak_strain(const hapbeam_servo* servo, double* s);
HAPBEAM_API void hapbeam_servo_reset(hapbeam_servo* servo);
/* As hapbeam_touch_shape(), of a recent tick; from any one thread, while another ticks. */
HAPBEAM_API int hapbeam_servo_shape(hapbeam_servo* servo, double* x_w, int count);

/* ---- A stylus whose shaft touches a rod in space ---- */

/* A part with a section of its own, in shape that of the rod: a step or a taper. */
typedef struct hapbeam_part {
  double end;      /* [m] arc position where it ends; it begins where the one before it does */
  double from, to; /* sizes of its section at both ends for those of the rod's, positive; linear between them */
} hapbeam_part;

/* A part with a natural curvature and twist: an arc, a ring or a helix. */
typedef struct hapbeam_arc {
  double end;        /* [m] arc position where it ends */
  double curvature1; /* [1/m] about the first axis: positive turns the tangent toward minus the second */
  double curvature2; /* [1/m] about the second axis: positive turns it toward the first */
  double twist;      /* [1/m] of both axes about the tangent */
} hapbeam_arc;

/* It leaves its left end at the scene's origin along x, with its first axis of bending along y and its second along z. */
typedef struct hapbeam_rod {
  double length;                                 /* [m] */
  double axial_stiffness;                        /* EA [N] */
  double bending_stiffness1, bending_stiffness2; /* EI about y and about z [N m^2] */
  double torsional_stiffness;                    /* GJ [N m^2] */
  double thickness;                              /* [m] diameter of the surface that is touched */
  double area;                                   /* [m^2] of the section, for the weight alone */
  double density;                                /* [kg/m^3]; 0: it weighs nothing */
  double gravity[3];                             /* [m/s^2] direction and size */
  double load[3];                                /* [N/m] dead, beside the weight */
  int left, right;                               /* HAPBEAM_FREE, CLAMPED or PINNED */
  int part_count, arc_count;
  const hapbeam_part* parts; /* read at creation, to the end of the rod; null: of one section */
  const hapbeam_arc* arcs;   /* of HAPBEAM_TWISTED_ROD, read at creation; null, and beyond the last: straight */
} hapbeam_rod;

/* Straight, of one section, without weight and load.  young, shear: moduli E and G [Pa] */
HAPBEAM_API hapbeam_rod hapbeam_wire(double length, double diameter, double young, double shear, int left, int right);
/* width: along y, height: along z [m] */
HAPBEAM_API hapbeam_rod hapbeam_bar(double length, double width, double height, double young, double shear, int left,
                                    int right);
/* outer, inner: diameters [m] */
HAPBEAM_API hapbeam_rod hapbeam_tube(double length, double outer, double inner, double young, double shear, int left,
                                     int right);

/* Where the host's world lies in the scene: scene = origin + scale * rotation * host. */
typedef struct hapbeam_placement {
  double rotation[9]; /* of the host's axes in the scene's, by rows */
  double origin[3];   /* [m] of the host in the scene */
  double scale;       /* metres of the scene for one unit of the host */
} hapbeam_placement;

/* The host's axes are the scene's, and its origin lies at (x, y, z) of the scene. */
HAPBEAM_API hapbeam_placement hapbeam_placement_at(double x, double y, double z, double scale);

typedef struct hapbeam_wrench {
  double force[3];    /* [N] on the hand, the host's axes */
  double torque[3];   /* about the hand: N times the host's unit of length */
  double friction[3]; /* [N] the tangential part of the force */
  double s;           /* [m] arc position of the contact; 0 where nothing is touched */
  double dissipated;  /* [J] by friction, since the touch began */
  int pressing;       /* 1 where the rod is touched */
  int sliding;        /* 1 where a contact with friction slides */
  int status;
} hapbeam_wrench;

typedef struct hapbeam_stylus hapbeam_stylus;

/* kinematics: HAPBEAM_ROUND_ROD or HAPBEAM_TWISTED_ROD; elements: 2 to 4096.  The stylus is a capsule: radius, and length of its axis,
   whose tip lies `ahead` of the hand's place [m of the scene].  friction: or null; placement: null where the host's world is the scene. */
HAPBEAM_API hapbeam_stylus* hapbeam_stylus_create(const hapbeam_rod* rod, int kinematics, int elements, double radius,
                                                  double length, double ahead, const hapbeam_friction* friction,
                                                  const hapbeam_placement* placement, char* message);
HAPBEAM_API void hapbeam_stylus_destroy(hapbeam_stylus* stylus);
/* position of the hand in the host's world; orientation: rotation of the stylus' axes in the host's, by rows.  The stylus points along
   its z, from the tip to the hand. */
HAPBEAM_API hapbeam_wrench hapbeam_stylus_tick(hapbeam_stylus* stylus, const double position[3],
                                               const double orientation[9]);
HAPBEAM_API void hapbeam_stylus_reset(hapbeam_stylus* stylus);
/* The centreline at `count` places from end to end in the host's world, x_y_z: 3 count numbers.  Returns how many were written. */
HAPBEAM_API int hapbeam_stylus_shape(hapbeam_stylus* stylus, double* x_y_z, int count);

#ifdef __cplusplus
}
#endif

#endif
