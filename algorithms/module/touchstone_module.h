/* A module: a shared object whose algorithms Touchstone checks and times beside all others, without a line in its tree.
 *
 * A module exports one C function, touchstone_module(), which returns tables of functions. Compile it to a shared object, and
 * name its file where algorithms are named:
 *
 *     cc -O2 -shared -fPIC -o libmine.so mine.c
 *     touchstone check --with ./libmine.so
 *     touchstone run --with ./libmine.so
 *
 * The header is C99 and C++, and needs nothing else. The folder template/ beside it has modules to begin with.
 *
 * UNITS AND FRAMES. Lengths are metres, angles radians. A pose maps a body's coordinates to the world: x -> rotation * x +
 * translation. Rotations are used as they stand, orthonormal or not. Arrays begin at 0.
 *
 * QUESTIONS. A batch is a call. The program hands its own arrays over, without a copy, and the module writes answers into
 * the program's array. Numbers are finite and sizes >= 0, unless it is said otherwise; zero sizes are valid.
 *
 * ANSWERS. An answer with TOUCHSTONE_MODULE_OK is the module's word: if it is wrong, `check` and `run` end with status 1.
 * A module that cannot answer says so by another status. What is not known is NaN, and an answer whose value is none of its
 * enumeration makes the call one that answered garbage.
 *
 * PROCESSES AND THREADS. The program forks a process for each algorithm that it asks or times. There, create() is called
 * once or several times, and one thread calls an instance. Only a broad phase may use more threads: settings say how many.
 * Do not start threads when the file is loaded. What is printed appears in messages about a failure alone.
 *
 * FAILURES. A crash, exit(), a hang, or an exception that leaves a function of a C++ module costs the question at hand, as a
 * row with the status `crashed` or `timed_out`. A file that cannot be loaded is refused with exit status 2.
 *
 * MEMORY. Tables and their texts live as long as the file is loaded. Arrays that a function gets live until it returns, but
 * for those of bind(), build() and update(), which live until the next such call, or destroy(). The module frees what it
 * allocates. It is loaded once, and stays until the program ends.
 *
 * TIME. create() and bind() are not timed, except that build() and update() of a broad phase are. solve(), cast(), query() and
 * find_pairs() are.
 *
 * VERSIONS. TOUCHSTONE_MODULE_ABI changes when what a module was compiled with is no longer understood; then it is refused.
 * Structs with `struct_size` grow at their end without that. A table's struct_size is the module's: functions that it does
 * not reach are absent. A struct that a function gets has the program's: read a field beyond your own header's size never,
 * and one of a newer header only if struct_size reaches it. Structs without struct_size never change within a version. */
#ifndef TOUCHSTONE_MODULE_H
#define TOUCHSTONE_MODULE_H

#include <math.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define TOUCHSTONE_MODULE_ABI 1u

#if defined(__GNUC__)
#define TOUCHSTONE_MODULE_EXPORT __attribute__((visibility("default")))
#else
#define TOUCHSTONE_MODULE_EXPORT
#endif

/* --- what several kinds share ------------------------------------------------------------------------------------- */

/* How an answer came about; a uint8_t in answers. */
enum {
  TOUCHSTONE_MODULE_OK = 0, /* the module stands by its answer */
  /* the iteration cap or the end of the scalar's precision came first */
  TOUCHSTONE_MODULE_NOT_CONVERGED = 1,
  TOUCHSTONE_MODULE_DEGENERATE = 2,  /* the input is beyond what the algorithm can decide */
  TOUCHSTONE_MODULE_CAPACITY = 3,    /* a fixed store was full */
  TOUCHSTONE_MODULE_UNSUPPORTED = 4, /* it does not take such a question */
  TOUCHSTONE_MODULE_NOT_REPORTED = 5 /* what it wraps cannot report whether it failed */
};

/* What is calculated in; bits of `scalars`, and a value in settings. */
enum { TOUCHSTONE_MODULE_FLOAT = 1, TOUCHSTONE_MODULE_DOUBLE = 2 };

/* A pose: the rotation column after column (rotation[3 * column + row]), then the translation (metres). */
typedef struct TouchstoneModulePose {
  double rotation[9];
  double translation[3];
} TouchstoneModulePose;

/* The kinds of shapes, in the order that a batch of pairs keeps: kind_a <= kind_b. */
enum {
  TOUCHSTONE_MODULE_SPHERE = 0,
  TOUCHSTONE_MODULE_CAPSULE = 1,
  TOUCHSTONE_MODULE_BOX = 2,
  TOUCHSTONE_MODULE_CYLINDER = 3,
  TOUCHSTONE_MODULE_CONE = 4,
  TOUCHSTONE_MODULE_ELLIPSOID = 5,
  TOUCHSTONE_MODULE_HULL = 6,
  TOUCHSTONE_MODULE_HALFSPACE = 7
};

/* A convex shape in body coordinates (metres). Only the fields of its kind have a meaning. Capsule, cylinder and cone lie
 * along z. They are handed over as an array of pointers, so the struct may grow. */
typedef struct TouchstoneModuleShape {
  uint32_t struct_size;
  uint32_t kind;
  double radius; /* sphere, capsule, cylinder, cone */
  /* capsule: half of the straight part; cylinder; cone: base at -half_length, tip at +half_length */
  double half_length;
  double half_extents[3]; /* box */
  double radii[3];        /* ellipsoid */
  double normal[3]; /* half-space: the points with normal . x <= offset; not zero, of any length */
  double offset;
  /* Hull: the convex hull of the vertices (x, y, z each), at least one. A point, a segment and a flat set are hulls too. */
  uint32_t vertex_count;
  uint32_t dimension; /* 0 point, 1 segment, 2 flat, 3 solid */
  const double* vertices;
  /* The neighbours of vertex i along edges are neighbours[neighbour_starts[i]] to neighbours[neighbour_starts[i + 1] - 1].
   * Some hulls have none. */
  const uint32_t* neighbour_starts;
  const uint32_t* neighbours;
  /* Of a solid hull: face i has the vertices face_vertices[face_starts[i]] to face_vertices[face_starts[i + 1] - 1],
   * anticlockwise seen from outside, and the outward unit normal face_normals[3 * i ...]. */
  uint32_t face_count;
  uint32_t reserved;
  const uint32_t* face_starts;
  const uint32_t* face_vertices;
  const double* face_normals;
} TouchstoneModuleShape;

/* Two indices: of boxes with a < b, or of parts of two bodies. */
typedef struct TouchstoneModulePair {
  uint32_t a, b;
} TouchstoneModulePair;

/* A growing array of pairs that the program owns. Write behind the last pair and count it; if there is no room for it, call
 * grow first, which makes room for `more` pairs and may move the array. touchstone_module_push() does all of this. */
typedef struct TouchstoneModuleSink {
  TouchstoneModulePair* pairs;
  size_t count, capacity;
  void (*grow)(struct TouchstoneModuleSink* sink, size_t more);
  void* host; /* the program's */
} TouchstoneModuleSink;

static inline void touchstone_module_push(TouchstoneModuleSink* sink, uint32_t a, uint32_t b) {
  if (sink->count == sink->capacity) sink->grow(sink, 1);
  sink->pairs[sink->count].a = a;
  sink->pairs[sink->count].b = b;
  ++sink->count;
}

/* --- box: a broad phase, which finds all pairs of boxes that overlap ------------------------------------------------ */

/* The closed box from min to max in the world (metres), 24 bytes. An empty box, with min > max, is a slot without a body: it
 * overlaps nothing. Boxes that touch overlap. */
typedef struct TouchstoneModuleBox {
  float min[3], max[3];
} TouchstoneModuleBox;

/* A frame. The index of a box is its body, from frame to frame. The three lists are disjoint and ascend; a box in none of
 * them is as it was. The array grows when bodies come, and never shrinks. */
typedef struct TouchstoneModuleFrame {
  uint32_t struct_size, reserved;
  const TouchstoneModuleBox* boxes;
  size_t box_count;
  const uint32_t *moved, *inserted, *removed; /* a removed body's box is empty */
  size_t moved_count, inserted_count, removed_count;
} TouchstoneModuleFrame;

typedef struct TouchstoneModuleBoxSettings {
  uint32_t struct_size;
  uint32_t threads; /* at most so many threads may work, the caller's among them; >= 1 */
  /* Calls body(data, task, worker) for each task below `tasks`, on the program's threads, and returns when all are done.
   * worker < threads. Such threads are pinned and awake, so use them rather than threads of your own. */
  void (*run)(void* host, size_t tasks, void (*body)(void* data, size_t task, uint32_t worker),
              void* data);
  void* host; /* the first argument of run */
} TouchstoneModuleBoxSettings;

/* It is called as build, find_pairs, then (update, find_pairs) for each further frame. build may come again at any time. */
typedef struct TouchstoneModuleBoxes {
  uint32_t struct_size, reserved;
  /* small letters, digits and '-': unique among algorithms of the kind, of all modules too */
  const char* name;
  const char* citation; /* who, what, where, when; one line */
  void* (*create)(const TouchstoneModuleBoxSettings* settings); /* NULL: it cannot be made */
  void (*destroy)(void* instance);
  void (*build)(void* instance, const TouchstoneModuleBox* boxes, size_t count);
  /* Optional (NULL): the program then calls build. */
  void (*update)(void* instance, const TouchstoneModuleFrame* frame);
  /* Writes each pair of boxes that share a point once, a < b, in any order that is the same at every number of threads.
   * Returns TOUCHSTONE_MODULE_OK, or TOUCHSTONE_MODULE_CAPACITY if it had to drop a pair. */
  uint32_t (*find_pairs)(void* instance, TouchstoneModuleSink* sink);
  /* Optional: frees what was built. Only build may follow. It is not timed. */
  void (*discard)(void* instance);
} TouchstoneModuleBoxes;

/* --- pair: a narrow phase, which answers for pairs of convex bodies ------------------------------------------------- */

/* What is asked; bits of `tasks`, and a value in a batch. */
enum {
  TOUCHSTONE_MODULE_INTERSECT = 1, /* do the closed bodies share a point? the answer alone */
  /* the distance of bodies that are apart, with normal and witness points */
  TOUCHSTONE_MODULE_DISTANCE = 2,
  /* the depth of bodies that overlap, with normal and witness points */
  TOUCHSTONE_MODULE_PENETRATION = 4,
  TOUCHSTONE_MODULE_SIGNED = 8 /* both */
};

enum {
  TOUCHSTONE_MODULE_SEPARATED = 0,
  TOUCHSTONE_MODULE_TOUCHING = 1, /* common points, and no common interior */
  TOUCHSTONE_MODULE_OVERLAPPING = 2,
  TOUCHSTONE_MODULE_UNKNOWN = 3
};

/* The answer for a pair, 112 bytes. Write all fields, or call touchstone_module_clear() first. Numbers are needed where the
 * task asks for them: distance, normal and both witness points. */
typedef struct TouchstoneModuleOutcome {
  uint8_t answer, status;
  double distance;     /* metres: > 0 the gap, < 0 minus the depth */
  double lower, upper; /* certified bounds on the signed distance, if there are some; else NaN */
  /* The unit vector from a to b in the world. Separated: along the shortest connection. Overlapping: moving b by depth *
   * normal leaves no common interior, and no shorter motion does. */
  double normal[3];
  /* Points of a and b in the world. Separated: the closest points. Overlapping: witness_a - witness_b = depth * normal. */
  double witness_a[3], witness_b[3];
  int32_t iterations, support_calls; /* -1: not counted */
} TouchstoneModuleOutcome;

static inline void touchstone_module_clear(TouchstoneModuleOutcome* outcome) {
  int i;
  outcome->answer = TOUCHSTONE_MODULE_UNKNOWN;
  outcome->status = TOUCHSTONE_MODULE_UNSUPPORTED;
  outcome->distance = outcome->lower = outcome->upper = NAN;
  for (i = 0; i < 3; ++i) outcome->normal[i] = outcome->witness_a[i] = outcome->witness_b[i] = NAN;
  outcome->iterations = outcome->support_calls = -1;
}

typedef struct TouchstoneModulePairSettings {
  uint32_t struct_size;
  uint32_t scalar;  /* TOUCHSTONE_MODULE_FLOAT or _DOUBLE, one that the table offers */
  double tolerance; /* error at which it may stop, as a part of the pair's size; NaN: its own */
  /* of each loop; 0: its own. A query that needs more is TOUCHSTONE_MODULE_NOT_CONVERGED */
  int32_t max_iterations;
  int32_t reserved;
} TouchstoneModulePairSettings;

/* Pairs of one combination of kinds, kind_a <= kind_b. Pair i is of bodies first[i] and second[i]; body k has the bound shape
 * shape_of[k] and the pose poses[k]. */
typedef struct TouchstoneModulePairBatch {
  uint32_t struct_size;
  uint32_t task, kind_a, kind_b;
  size_t count;
  const uint32_t *first, *second;
  const uint32_t* shape_of;
  const TouchstoneModulePose* poses;
} TouchstoneModulePairBatch;

typedef struct TouchstoneModulePairs {
  uint32_t struct_size;
  uint32_t tasks;   /* bits: what it answers */
  uint32_t scalars; /* bits: what it calculates in. Poses and shapes are doubles in either case */
  /* 1: it answers for more than the bodies by design, so "overlapping" is no promise */
  uint32_t approximate;
  uint32_t depth_is_bound; /* 1: its depth is that of some translation that separates, by design */
  uint32_t reserved;
  const char* name; /* as of boxes */
  const char* citation;
  void* (*create)(const TouchstoneModulePairSettings* settings);
  void (*destroy)(void* instance);
  /* Returns 1 for kinds of pairs that it takes, kind_a <= kind_b. NULL: all. Others are never asked. */
  int (*supports)(uint32_t kind_a, uint32_t kind_b, uint32_t task);
  /* Prepares the shapes. May come again, with others in their place. */
  void (*bind)(void* instance, const TouchstoneModuleShape* const* shapes, size_t count);
  /* Writes outcomes[i] for each pair. */
  void (*solve)(void* instance, const TouchstoneModulePairBatch* batch,
                TouchstoneModuleOutcome* outcomes);
} TouchstoneModulePairs;

/* --- ray and point: queries of a mesh of triangles ------------------------------------------------------------------ */

/* The union of closed triangles. Triangles may be degenerate, and there may be none. */
typedef struct TouchstoneModuleMesh {
  uint32_t struct_size;
  /* 1: the points around which the closed surface winds belong to the body too (kind mesh) */
  uint32_t solid;
  const double* vertices;    /* x, y, z each; metres */
  const uint32_t* triangles; /* three vertices each */
  size_t vertex_count, triangle_count;
} TouchstoneModuleMesh;

enum { TOUCHSTONE_MODULE_CLOSEST_HIT = 1, TOUCHSTONE_MODULE_ANY_HIT = 2 };
#define TOUCHSTONE_MODULE_NO_TRIANGLE UINT32_MAX

/* The points origin + t * direction with 0 <= t <= t_max, both ends included; 56 bytes. The direction is of any length. A ray
 * with NaN, with infinity (but for t_max) or without a direction is no hit, TOUCHSTONE_MODULE_DEGENERATE. */
typedef struct TouchstoneModuleRay {
  double origin[3], direction[3], t_max;
} TouchstoneModuleRay;

/* What a ray meets, 32 bytes. Closest: the least t, and of several triangles there the one with the lowest number. Any: some
 * triangle. Without a hit, triangle is TOUCHSTONE_MODULE_NO_TRIANGLE and the numbers are NaN. */
typedef struct TouchstoneModuleHit {
  uint8_t hit, status; /* hit: 0 or 1 */
  uint32_t triangle;
  double t, u,
      v; /* the point is vertex 0 + u * (vertex 1 - vertex 0) + v * (vertex 2 - vertex 0) */
} TouchstoneModuleHit;

typedef struct TouchstoneModuleRaySettings {
  uint32_t struct_size;
  uint32_t scalar; /* with _FLOAT the answer is that for numbers rounded to floats */
} TouchstoneModuleRaySettings;

typedef struct TouchstoneModuleRays {
  uint32_t struct_size;
  uint32_t tasks, scalars; /* bits */
  uint32_t reserved;
  const char* name;
  const char* citation;
  void* (*create)(const TouchstoneModuleRaySettings* settings);
  void (*destroy)(void* instance);
  void (*bind)(void* instance, const TouchstoneModuleMesh* mesh); /* may come again */
  void (*cast)(void* instance, uint32_t task, const TouchstoneModuleRay* rays, size_t count,
               TouchstoneModuleHit* hits);
} TouchstoneModuleRays;

enum { TOUCHSTONE_MODULE_CLOSEST_POINT = 1, TOUCHSTONE_MODULE_SIDE = 2 };
enum {
  TOUCHSTONE_MODULE_OUTSIDE = 0,
  TOUCHSTONE_MODULE_ON_SURFACE = 1,
  TOUCHSTONE_MODULE_INSIDE = 2,
  TOUCHSTONE_MODULE_SIDE_UNKNOWN = 3
};

/* Closest: the triangle, the distance (metres) and the point; NaN and TOUCHSTONE_MODULE_NO_TRIANGLE if there is no triangle.
 * Side: which side of the closed surface the point is on. A point with NaN is TOUCHSTONE_MODULE_DEGENERATE. 40 bytes. */
typedef struct TouchstoneModulePointAnswer {
  uint8_t status, side;
  uint32_t triangle;
  double distance, closest[3];
} TouchstoneModulePointAnswer;

typedef struct TouchstoneModulePointSettings {
  uint32_t struct_size, reserved;
} TouchstoneModulePointSettings;

typedef struct TouchstoneModulePoints {
  uint32_t struct_size;
  uint32_t tasks;  /* bits */
  uint32_t scalar; /* one of them: what it calculates in */
  uint32_t reserved;
  const char* name;
  const char* citation;
  void* (*create)(const TouchstoneModulePointSettings* settings);
  void (*destroy)(void* instance);
  void (*bind)(void* instance, const TouchstoneModuleMesh* mesh); /* may come again */
  void (*query)(void* instance, uint32_t task, const double* points /* x, y, z each */,
                size_t count, TouchstoneModulePointAnswer* answers);
} TouchstoneModulePoints;

/* --- mesh: collision of two meshes ------------------------------------------------------------------------------------ */

enum {
  TOUCHSTONE_MODULE_MESH_INTERSECT = 1,
  /* with witness points; only the answer if they share a point */
  TOUCHSTONE_MODULE_MESH_DISTANCE = 2,
  TOUCHSTONE_MODULE_MESH_CONTACTS = 4 /* all pairs of triangles that share a point */
};

typedef struct TouchstoneModuleMeshSettings {
  uint32_t struct_size;
  uint32_t scalar;
} TouchstoneModuleMeshSettings;

typedef struct TouchstoneModuleMeshes {
  uint32_t struct_size;
  uint32_t tasks, scalars; /* bits */
  uint32_t takes_solid;    /* 1: it takes bodies with `solid` too; others are then never asked */
  const char* name;
  const char* citation;
  void* (*create)(const TouchstoneModuleMeshSettings* settings);
  void (*destroy)(void* instance);
  /* Bodies as an array of pointers. May come again. */
  void (*bind)(void* instance, const TouchstoneModuleMesh* const* bodies, size_t count);
  /* Writes the outcome of bodies a and b, at these poses: separated, or overlapping if they share a point, a touch included.
   * With _MESH_CONTACTS the sink gets each pair of triangles (of a, of b) that share a point once, in any order. */
  void (*solve)(void* instance, uint32_t task, uint32_t a, const TouchstoneModulePose* pose_a,
                uint32_t b, const TouchstoneModulePose* pose_b, TouchstoneModuleOutcome* outcome,
                TouchstoneModuleSink* pairs);
} TouchstoneModuleMeshes;

/* --- cast: the first time at which two moving convex bodies touch ----------------------------------------------------- */

enum { TOUCHSTONE_MODULE_HIT = 0, TOUCHSTONE_MODULE_MISS = 1, TOUCHSTONE_MODULE_CAST_UNKNOWN = 2 };

/* During times 0 to 1 the body's origin is at translation + t * displacement, and its rotation is
 * exp(t * rotation_vector) * rotation. */
typedef struct TouchstoneModuleMotion {
  double displacement[3];    /* metres, world axes */
  double rotation_vector[3]; /* radians, world axes */
} TouchstoneModuleMotion;

/* 88 bytes. A miss with TOUCHSTONE_MODULE_OK says that the bodies share no point at any time, a hit that at `toi` they are no
 * further apart than the tolerance. Bodies in contact at time 0 are a hit there. */
typedef struct TouchstoneModuleCastOutcome {
  uint8_t answer, status;
  double toi;          /* the first time of contact */
  double lower, upper; /* certified bounds on it, or NaN */
  double normal[3]; /* the unit vector from a to b at that time, world axes; may be NaN at time 0 */
  double point[3];  /* where they touch, in the world; may be NaN at time 0 */
  int32_t iterations; /* -1: not counted */
} TouchstoneModuleCastOutcome;

typedef struct TouchstoneModuleCastSettings {
  uint32_t struct_size;
  uint32_t scalar;
  double tolerance;       /* metres; NaN: its own */
  int32_t max_iterations; /* 0: its own */
  int32_t reserved;
} TouchstoneModuleCastSettings;

/* As TouchstoneModulePairBatch; body k moves by motions[k]. */
typedef struct TouchstoneModuleCastBatch {
  uint32_t struct_size;
  uint32_t kind_a, kind_b, reserved;
  size_t count;
  const uint32_t *first, *second;
  const uint32_t* shape_of;
  const TouchstoneModulePose* poses;
  const TouchstoneModuleMotion* motions;
} TouchstoneModuleCastBatch;

typedef struct TouchstoneModuleCasts {
  uint32_t struct_size;
  uint32_t scalars;  /* bits */
  uint32_t rotation; /* 1: it takes bodies that turn; others are never asked */
  uint32_t reserved;
  const char* name;
  const char* citation;
  void* (*create)(const TouchstoneModuleCastSettings* settings);
  void (*destroy)(void* instance);
  int (*supports)(uint32_t kind_a, uint32_t kind_b, int turns); /* NULL: all */
  void (*bind)(void* instance, const TouchstoneModuleShape* const* shapes, size_t count);
  void (*solve)(void* instance, const TouchstoneModuleCastBatch* batch,
                TouchstoneModuleCastOutcome* outcomes);
} TouchstoneModuleCasts;

/* --- feature: the first time at which a moving vertex meets a triangle, or an edge an edge ---------------------------- */

enum { TOUCHSTONE_MODULE_VERTEX_FACE = 0, TOUCHSTONE_MODULE_EDGE_EDGE = 1 };

/* The four vertices at time 0 and at time 1, between which they move along lines; 192 bytes. Vertex-face: the vertex, then
 * the triangle's three. Edge-edge: two of the first edge, then two of the second. Features are closed, may be degenerate. */
typedef struct TouchstoneModuleFeatures {
  double start[4][3], end[4][3];
} TouchstoneModuleFeatures;

/* 40 bytes. `answer` is TOUCHSTONE_MODULE_HIT, _MISS or _CAST_UNKNOWN. */
typedef struct TouchstoneModuleFeatureOutcome {
  uint8_t answer, status;
  double toi;         /* of a hit */
  double free_before; /* proven: no contact before this time; NaN if it proves nothing */
  double contact_by;  /* proven: within separation + tolerance by this time; or NaN */
  int32_t iterations; /* -1: not counted */
} TouchstoneModuleFeatureOutcome;

typedef struct TouchstoneModuleFeatureSettings {
  uint32_t struct_size, reserved;
  /* metres: features that come within separation + tolerance may be called a hit */
  double tolerance;
  /* metres: features this near to each other are in contact; 0 unless `separations` */
  double separation;
  int32_t max_iterations; /* 0: its own */
  int32_t reserved_2;
} TouchstoneModuleFeatureSettings;

typedef struct TouchstoneModuleFeaturePairs {
  uint32_t struct_size;
  uint32_t separations; /* 1: it takes a separation > 0 */
  const char* name;
  const char* citation;
  void* (*create)(const TouchstoneModuleFeatureSettings* settings);
  void (*destroy)(void* instance);
  void (*solve)(void* instance, uint32_t pair, const TouchstoneModuleFeatures* queries,
                size_t count, TouchstoneModuleFeatureOutcome* outcomes);
} TouchstoneModuleFeaturePairs;

/* --- the module ----------------------------------------------------------------------------------------------------- */

/* What a module offers. Each list of tables ends with NULL; a list that is NULL offers nothing of its kind. */
typedef struct TouchstoneModule {
  uint32_t struct_size; /* sizeof(TouchstoneModule) */
  uint32_t abi;         /* TOUCHSTONE_MODULE_ABI */
  const TouchstoneModuleBoxes* const* boxes;
  const TouchstoneModulePairs* const* pairs;
  const TouchstoneModuleRays* const* rays;
  const TouchstoneModulePoints* const* points;
  const TouchstoneModuleMeshes* const* meshes;
  const TouchstoneModuleCasts* const* casts;
  const TouchstoneModuleFeaturePairs* const* features;
} TouchstoneModule;

/* The one symbol of a module. `abi` is that of the program that loads it, so that a module can offer tables of several
 * versions. Returns NULL if it has none for this one. */
TOUCHSTONE_MODULE_EXPORT const TouchstoneModule* touchstone_module(uint32_t abi);

#ifdef __cplusplus
} /* extern "C" */
#endif

#endif /* TOUCHSTONE_MODULE_H */
