/* A module to begin with: a broad phase that compares all boxes with all, and a narrow phase of two spheres. */
#include <math.h>
#include <stdlib.h>

#include <touchstone_module.h>

/* --- boxes --- */

typedef struct {
  const TouchstoneModuleBox* boxes; /* the program's, which live until the next build or update */
  size_t count;
} Boxes;

static void* create_boxes(const TouchstoneModuleBoxSettings* settings) {
  (void)settings; /* one thread is enough for this one */
  return calloc(1, sizeof(Boxes));
}

static void build(void* instance, const TouchstoneModuleBox* boxes, size_t count) {
  Boxes* const mine = instance;
  mine->boxes = boxes;
  mine->count = count;
}

/* Closed boxes that touch overlap. An empty box has infinite bounds the wrong way round, so it overlaps nothing. */
static int overlap(const TouchstoneModuleBox* a, const TouchstoneModuleBox* b) {
  return a->min[0] <= b->max[0] && b->min[0] <= a->max[0] && a->min[1] <= b->max[1] &&
         b->min[1] <= a->max[1] && a->min[2] <= b->max[2] && b->min[2] <= a->max[2];
}

static uint32_t find_pairs(void* instance, TouchstoneModuleSink* sink) {
  const Boxes* const mine = instance;
  size_t a, b;
  for (a = 0; a < mine->count; ++a) {
    for (b = a + 1; b < mine->count; ++b) {
      if (overlap(&mine->boxes[a], &mine->boxes[b]))
        touchstone_module_push(sink, (uint32_t)a, (uint32_t)b);
    }
  }
  return TOUCHSTONE_MODULE_OK;
}

static const TouchstoneModuleBoxes all_with_all = {
    .struct_size = sizeof(TouchstoneModuleBoxes),
    .name = "mine-boxes",
    .citation = "The template of modules: all pairs.",
    .create = create_boxes,
    .destroy = free,
    .build = build,
    .find_pairs = find_pairs};

/* --- pairs --- */

typedef struct {
  const TouchstoneModuleShape* const* shapes;
} Spheres;

static void* create_spheres(const TouchstoneModulePairSettings* settings) {
  (void)settings; /* there is no loop that could stop early */
  return calloc(1, sizeof(Spheres));
}

static int are_spheres(uint32_t kind_a, uint32_t kind_b, uint32_t task) {
  (void)task;
  return kind_a == TOUCHSTONE_MODULE_SPHERE && kind_b == TOUCHSTONE_MODULE_SPHERE;
}

static void bind(void* instance, const TouchstoneModuleShape* const* shapes, size_t count) {
  Spheres* const mine = instance;
  (void)count;
  mine->shapes = shapes;
}

static void solve(void* instance, const TouchstoneModulePairBatch* batch,
                  TouchstoneModuleOutcome* outcomes) {
  const Spheres* const mine = instance;
  size_t pair;
  int i;
  for (pair = 0; pair < batch->count; ++pair) {
    const uint32_t a = batch->first[pair], b = batch->second[pair];
    const double* const at_a = batch->poses[a].translation;
    const double* const at_b = batch->poses[b].translation;
    const double radius_a = mine->shapes[batch->shape_of[a]]->radius;
    const double radius_b = mine->shapes[batch->shape_of[b]]->radius;
    const double between = hypot(hypot(at_b[0] - at_a[0], at_b[1] - at_a[1]), at_b[2] - at_a[2]);
    TouchstoneModuleOutcome* const out = &outcomes[pair];
    touchstone_module_clear(out);
    out->status = TOUCHSTONE_MODULE_OK;
    out->distance = between - radius_a - radius_b;
    out->answer = out->distance > 0 ? TOUCHSTONE_MODULE_SEPARATED : TOUCHSTONE_MODULE_OVERLAPPING;
    for (i = 0; i < 3; ++i) {
      out->normal[i] = between > 0 ? (at_b[i] - at_a[i]) / between : i == 0;
      out->witness_a[i] = at_a[i] + radius_a * out->normal[i];
      out->witness_b[i] = at_b[i] - radius_b * out->normal[i];
    }
  }
}

static const TouchstoneModulePairs two_spheres = {
    .struct_size = sizeof(TouchstoneModulePairs),
    .tasks = TOUCHSTONE_MODULE_INTERSECT | TOUCHSTONE_MODULE_DISTANCE |
             TOUCHSTONE_MODULE_PENETRATION | TOUCHSTONE_MODULE_SIGNED,
    .scalars = TOUCHSTONE_MODULE_DOUBLE,
    .name = "mine-spheres",
    .citation = "The template of modules: the distance of the centres less the radii.",
    .create = create_spheres,
    .destroy = free,
    .supports = are_spheres,
    .bind = bind,
    .solve = solve};

/* --- what the program loads --- */

static const TouchstoneModuleBoxes* const boxes[] = {&all_with_all, NULL};
static const TouchstoneModulePairs* const pairs[] = {&two_spheres, NULL};
static const TouchstoneModule module = {.struct_size = sizeof(TouchstoneModule),
                                        .abi = TOUCHSTONE_MODULE_ABI,
                                        .boxes = boxes,
                                        .pairs = pairs};

const TouchstoneModule* touchstone_module(uint32_t abi) {
  return abi == TOUCHSTONE_MODULE_ABI ? &module : NULL;
}
