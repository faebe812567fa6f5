/* Touchstone's C interface (C99): collision queries of convex bodies, and worlds of bodies.
 *
 * Units:     metres and radians. Times of motions and rays have no unit: they are parts of a motion, and lengths
 *            of a ray's direction.
 * Frames:    a shape has coordinates of its own; a pose takes them to the world. Answers are in the world.
 * Errors:    functions return TOUCHSTONE_OK, or what went wrong, and then touchstone_last_error() has the words. A
 *            call that returns TOUCHSTONE_INVALID changes nothing, and writes nothing but NULL where it makes an
 *            object. After another error a result that was to be written may have any numbers. Functions take no
 *            NULL but where they say so. What an algorithm cannot answer is no error: the result has a status and
 *            the answer TOUCHSTONE_UNKNOWN.
 * Threads:   shapes may be used by many threads at once. A solver or a world is used by one thread at a time.
 * Lifetime:  who makes an object destroys it. A shape may be destroyed while solvers and worlds use it.
 * Versions:  structures that may grow begin with their size, which the caller sets: TOUCHSTONE_RESULT_INIT and its
 *            like do. The library writes and reads no further. Functions never change, so a program that was built
 *            against an older header still runs.
 */
#ifndef TOUCHSTONE_TOUCHSTONE_H
#define TOUCHSTONE_TOUCHSTONE_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#ifndef TOUCHSTONE_API
#define TOUCHSTONE_API __attribute__((visibility("default")))
#endif

/* What functions return. */
enum {
  TOUCHSTONE_OK = 0,
  TOUCHSTONE_INVALID = 1, /* an argument is wrong */
  TOUCHSTONE_NO_MEMORY = 2,
  TOUCHSTONE_FAILED = 3 /* something else */
};

/* Answers. Of casts: separated is a miss, and touching a hit. */
enum {
  TOUCHSTONE_SEPARATED = 0,
  TOUCHSTONE_TOUCHING = 1,
  TOUCHSTONE_OVERLAPPING = 2,
  TOUCHSTONE_UNKNOWN = 3
};

/* Statuses of answers. */
enum {
  TOUCHSTONE_STATUS_OK = 0,            /* the algorithm stands by its answer */
  TOUCHSTONE_STATUS_NOT_CONVERGED = 1, /* it ended before it was sure */
  TOUCHSTONE_STATUS_DEGENERATE = 2,    /* the input is beyond what it can decide */
  TOUCHSTONE_STATUS_CAPACITY = 3,      /* a fixed store was full */
  TOUCHSTONE_STATUS_UNSUPPORTED = 4    /* it does not take these kinds, or this question */
};

/* Questions. */
enum {
  TOUCHSTONE_INTERSECT = 0,      /* the answer alone */
  TOUCHSTONE_DISTANCE = 1,       /* and the distance, if separated */
  TOUCHSTONE_PENETRATION = 2,    /* and the depth, if overlapping */
  TOUCHSTONE_SIGNED_DISTANCE = 3 /* and whichever of the two it is */
};

/* Maps p to rotation * p + translation (metres). The rotation is column by column: the body's x axis in the world,
 * then y and z. It is taken as it is given. */
typedef struct touchstone_pose {
  double rotation[9];
  double translation[3];
} touchstone_pose;

/* From time 0 to 1 a body moves by `displacement` (metres) and turns evenly about its origin, by `rotation_vector`
 * (radians), both in world axes. */
typedef struct touchstone_motion {
  double displacement[3];
  double rotation_vector[3];
} touchstone_motion;

/* Numbers that were not asked for, or are not known, are NaN. */
typedef struct touchstone_result {
  size_t struct_size; /* set by the caller */
  int32_t answer;
  int32_t status;
  double distance;     /* metres: > 0 the gap, < 0 minus the depth */
  double lower, upper; /* bounds on the signed distance, where the algorithm has them */
  double normal[3];    /* unit vector from a to b */
  double on_a[3];      /* the closest points; of overlapping bodies on_a - on_b = depth * normal */
  double on_b[3];
  int32_t iterations, support_calls; /* -1: not counted */
} touchstone_result;
#define TOUCHSTONE_RESULT_INIT \
  { sizeof(touchstone_result), 3, 4, 0, 0, 0, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}, -1, -1 }

typedef struct touchstone_cast_result {
  size_t struct_size; /* set by the caller */
  int32_t answer;
  int32_t status;
  double time;         /* the first at which the bodies share a point, in [0, 1] */
  double lower, upper; /* bounds on that time, where the algorithm has them */
  double normal[3];    /* unit vector from a to b at that time */
  double point[3];     /* where they touch at that time */
} touchstone_cast_result;
#define TOUCHSTONE_CAST_RESULT_INIT                                       \
  {                                                                       \
    sizeof(touchstone_cast_result), 3, 4, 0, 0, 0, {0, 0, 0}, { 0, 0, 0 } \
  }

typedef struct touchstone_solver_options {
  size_t struct_size;    /* set by the caller */
  const char* algorithm; /* NULL: what Touchstone's tables of times recommend for each two kinds */
  const char* cast_algorithm; /* the same for casts */
  double tolerance;           /* part of the size of a pair; below 0: the algorithm's own */
  double margin;              /* metres: bodies further apart have no number; below 0: none */
} touchstone_solver_options;
#define TOUCHSTONE_SOLVER_OPTIONS_INIT \
  { sizeof(touchstone_solver_options), NULL, NULL, -1, -1 }

typedef struct touchstone_world_options {
  size_t struct_size;      /* set by the caller */
  const char* broad_phase; /* NULL: "auto" */
  int32_t threads;         /* at least 1 */
  int32_t reserved;        /* 0 */
} touchstone_world_options;
#define TOUCHSTONE_WORLD_OPTIONS_INIT \
  { sizeof(touchstone_world_options), NULL, 1, 0 }

/* A body of a world. A handle of a removed body is never that of another. */
typedef struct touchstone_handle {
  uint32_t slot;
  uint32_t generation;
} touchstone_handle;

typedef struct touchstone_ray_hit {
  size_t struct_size; /* set by the caller */
  int32_t hit;        /* 0 or 1 */
  int32_t status;
  touchstone_handle body;
  double t;         /* in lengths of the direction; 0 if the ray begins in the body */
  double normal[3]; /* unit vector towards the origin's side; NaN if t is 0 */
} touchstone_ray_hit;
#define TOUCHSTONE_RAY_HIT_INIT                              \
  {                                                          \
    sizeof(touchstone_ray_hit), 0, 4, {0, 0}, 0, { 0, 0, 0 } \
  }

typedef struct touchstone_shape touchstone_shape;
typedef struct touchstone_solver touchstone_solver;
typedef struct touchstone_world touchstone_world;

/* "0.1.0" or alike: that of the library that runs. */
TOUCHSTONE_API const char* touchstone_version(void);
/* The words of the last error of the calling thread, until its next call that fails; "" if there was none. */
TOUCHSTONE_API const char* touchstone_last_error(void);

/* Poses. `rows` is the rotation matrix row by row. The quaternion is normalised. */
TOUCHSTONE_API int touchstone_pose_from_rows(const double rows[9], const double translation[3],
                                             touchstone_pose* pose);
TOUCHSTONE_API int touchstone_pose_from_quaternion(double w, double x, double y, double z,
                                                   const double translation[3],
                                                   touchstone_pose* pose);

/* Shapes. Capsule, cylinder and cone lie along z, from -half_length to half_length; a capsule has a half ball beyond
 * both ends, and a cone its tip at half_length. A hull is that of `count` >= 1 points, three numbers each. A
 * half-space has the points p with normal . p <= offset. Sizes are finite and at least 0. */
TOUCHSTONE_API int touchstone_sphere(double radius, touchstone_shape** shape);
TOUCHSTONE_API int touchstone_capsule(double radius, double half_length, touchstone_shape** shape);
TOUCHSTONE_API int touchstone_box(double x, double y, double z,
                                  touchstone_shape** shape); /* half extents */
TOUCHSTONE_API int touchstone_cylinder(double radius, double half_length, touchstone_shape** shape);
TOUCHSTONE_API int touchstone_cone(double radius, double half_length, touchstone_shape** shape);
TOUCHSTONE_API int touchstone_ellipsoid(double x, double y, double z,
                                        touchstone_shape** shape); /* radii */
TOUCHSTONE_API int touchstone_hull(const double* points, size_t count, touchstone_shape** shape);
TOUCHSTONE_API int touchstone_halfspace(const double normal[3], double offset,
                                        touchstone_shape** shape);
TOUCHSTONE_API void touchstone_shape_destroy(touchstone_shape* shape); /* may be NULL */

/* Solvers ask algorithms about pairs. A shape is prepared at the first call that meets it, or ahead by `prepare`,
 * which replaces those that it was given before. `options` may be NULL. */
TOUCHSTONE_API int touchstone_solver_create(const touchstone_solver_options* options,
                                            touchstone_solver** solver);
TOUCHSTONE_API void touchstone_solver_destroy(touchstone_solver* solver); /* may be NULL */
TOUCHSTONE_API int touchstone_solver_prepare(touchstone_solver* solver,
                                             const touchstone_shape* const* shapes, size_t count);
TOUCHSTONE_API int touchstone_solver_ask(touchstone_solver* solver, int question,
                                         const touchstone_shape* shape_a,
                                         const touchstone_pose* pose_a,
                                         const touchstone_shape* shape_b,
                                         const touchstone_pose* pose_b, touchstone_result* result);
TOUCHSTONE_API int touchstone_solver_cast(
    touchstone_solver* solver, const touchstone_shape* shape_a, const touchstone_pose* pose_a,
    const touchstone_motion* motion_a, const touchstone_shape* shape_b,
    const touchstone_pose* pose_b, const touchstone_motion* motion_b,
    touchstone_cast_result* result);

/* The exact answer about a pair and its proof, which whoever multiplies fractions can verify: one line of JSON in the
 * format of results/certificates.md, without a line break. The caller destroys it. */
TOUCHSTONE_API int touchstone_certificate(const touchstone_shape* shape_a,
                                          const touchstone_pose* pose_a,
                                          const touchstone_shape* shape_b,
                                          const touchstone_pose* pose_b, char** text);
TOUCHSTONE_API void touchstone_text_destroy(char* text); /* may be NULL */

/* Worlds: bodies, and which of their boxes overlap. Pairs are those of the last update; rays meet the bodies where
 * they are now. A body with a shape has the least box around it; one without is its box (minimum, then maximum), and
 * no ray meets it. A half-space has no box, and is refused. `options` may be NULL. */
TOUCHSTONE_API int touchstone_world_create(const touchstone_world_options* options,
                                           touchstone_world** world);
TOUCHSTONE_API void touchstone_world_destroy(touchstone_world* world); /* may be NULL */
TOUCHSTONE_API int touchstone_world_insert(touchstone_world* world, const touchstone_shape* shape,
                                           const touchstone_pose* pose, touchstone_handle* handle);
TOUCHSTONE_API int touchstone_world_insert_box(touchstone_world* world, const double box[6],
                                               touchstone_handle* handle);
TOUCHSTONE_API int touchstone_world_move(touchstone_world* world, touchstone_handle body,
                                         const touchstone_pose* pose);
TOUCHSTONE_API int touchstone_world_move_box(touchstone_world* world, touchstone_handle body,
                                             const double box[6]);
TOUCHSTONE_API int touchstone_world_remove(touchstone_world* world, touchstone_handle body);
TOUCHSTONE_API int touchstone_world_update(touchstone_world* world);
/* Calls `visit` once for each pair. A `visit` that returns another number than 0 ends it. It must not use the world. */
TOUCHSTONE_API int touchstone_world_for_each_pair(touchstone_world* world,
                                                  int (*visit)(void* context, touchstone_handle a,
                                                               touchstone_handle b),
                                                  void* context);
/* The same for the pairs that began since the last call of this function (began is 1), and then for those that ended
 * (began is 0). */
TOUCHSTONE_API int touchstone_world_for_each_change(touchstone_world* world,
                                                    int (*visit)(void* context, int began,
                                                                 touchstone_handle a,
                                                                 touchstone_handle b),
                                                    void* context);
/* The first body that origin + t * direction meets, 0 <= t <= t_max, which may be infinite. */
TOUCHSTONE_API int touchstone_world_ray(touchstone_world* world, const double origin[3],
                                        const double direction[3], double t_max,
                                        touchstone_ray_hit* hit);

#ifdef __cplusplus
}
#endif
#endif
