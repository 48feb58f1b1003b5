/* Structs of other releases: every options struct in every size that a release had, on the heap in
 * just that size, and larger than this library knows; and every struct that the library fills. */
#include "check.h"

#include <stddef.h>
#include <stdlib.h>

static morula_shape *shape;
static morula_solid *solid;
static morula_clump *clump;
static morula_body *body;
static morula_parent *parent;
static morula_cost *cost;

/* What takes each struct; what it makes is freed again. */
static int32_t take_import(void *o) {
  morula_shape *made = NULL;
  const int32_t status = morula_shape_from_primitive("box", NULL, NULL, 0, 0, 0, o, &made);
  morula_shape_free(made);
  return status;
}
static int32_t take_file(void *o) {
  static const char off[] = "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";
  morula_shape *made = NULL;
  const int32_t status =
      morula_shape_from_bytes((const uint8_t *)off, sizeof off - 1, NULL, NULL, o, &made);
  morula_shape_free(made);
  return status;
}
static int32_t take_solid(void *o) {
  morula_solid *made = NULL;
  const int32_t status = morula_solid_from_shape(shape, o, &made);
  morula_solid_free(made);
  return status;
}
static int32_t take_clump(void *o) {
  morula_clump *made = NULL;
  ((morula_clump_options *)o)->spheres = 3; /* in the first release already */
  const int32_t status = morula_clump_from_solid(solid, o, &made);
  morula_clump_free(made);
  return status;
}
static int32_t take_mass(void *o) {
  morula_body *made = NULL;
  const int32_t status = morula_body_from_clump(clump, o, &made);
  morula_body_free(made);
  return status;
}
static int32_t take_contact(void *o) {
  morula_timestep step = {0};
  step.struct_size = sizeof step;
  ((morula_contact_options *)o)->young = 5e7;
  return morula_body_timestep(body, o, &step);
}
static int32_t take_export(void *o) {
  morula_files *made = NULL;
  const int32_t status = morula_body_export(body, MORULA_EXPORT_CSV, o, &made);
  morula_files_free(made);
  return status;
}
static int32_t take_break(void *o) {
  morula_fragments *made = NULL;
  morula_held held = {0};
  held.struct_size = sizeof held;
  int32_t status = morula_parent_held(parent, 2, 1, NULL, NULL, NULL, NULL, &held);
  ((morula_break_options *)o)->cells = 2;
  if (!status) status = morula_parent_break(parent, NULL, 0, &held, o, &made);
  morula_fragments_free(made);
  return status;
}
static int32_t take_held(void *o) {
  morula_fragments *made = NULL;
  morula_held *held = o;
  held->mass = L_MASS;
  for (int i = 0; i < 3; i++) held->inertia[i] = 5;
  const int32_t status = morula_parent_break(parent, NULL, 0, held, NULL, &made);
  morula_fragments_free(made);
  return status;
}
static int32_t take_cost(void *o) {
  static const uint64_t counts[2] = {2, 4};
  morula_cost *made = NULL;
  ((morula_cost_options *)o)->counts = counts;
  ((morula_cost_options *)o)->count = 2;
  const int32_t status = morula_cost_curve(solid, NULL, o, &made);
  morula_cost_free(made);
  return status;
}
static int32_t take_bounds(void *o) {
  size_t index = 0, length = 0;
  return morula_cost_choose(cost, o, &index, 0, NULL, &length);
}
static int32_t take_sweep(void *o) {
  static const double resolutions[1] = {16};
  static const int32_t methods[1] = {MORULA_METHOD_EUCLIDEAN};
  static const uint64_t counts[1] = {2};
  static const double deadlines[1] = {0};
  morula_sweep *made = NULL;
  morula_cost_options few;
  OK(morula_cost_options_init(&few, sizeof few));
  few.counts = counts;
  few.count = 1;
  morula_sweep_options *what = o;
  what->resolutions = resolutions;
  what->methods = methods;
  what->deadlines = deadlines;
  what->resolution_count = what->method_count = what->deadline_count = 1;
  const int32_t status = morula_sweep_from_shape(shape, NULL, NULL, &few, what, &made);
  morula_sweep_free(made);
  return status;
}

/* `sizes`: those that releases had, the first one first, the last today's. */
#define OPTIONS(type, take, ...)                                                           \
  do {                                                                                     \
    const size_t sizes[] = {__VA_ARGS__};                                                  \
    const size_t count = sizeof sizes / sizeof *sizes;                                     \
    CHECK(sizes[count - 1] == sizeof(type));                                               \
    for (size_t i = 0; i < count; i++) options(#type, init_##type, take, sizes[i], sizes[0], \
                                               sizeof(type));                              \
    /* Between two releases: whole fields count. */                                        \
    if (count > 1) options(#type, init_##type, take, sizes[0] + 1, sizes[0], sizeof(type)); \
    for (size_t more = 1; more < 1000; more = 3 * more + 5)                                \
      options(#type, init_##type, take, sizeof(type) + more, sizes[0], sizeof(type));      \
  } while (0)

static void options(const char *name, int32_t (*init)(void *, size_t), int32_t (*take)(void *),
                    size_t size, size_t first, size_t known) {
  unsigned char *o = malloc(size);
  CHECK(o != NULL);
  if (!o) return;
  memset(o, 0xff, size);
  OK(init(o, size));
  size_t said = 0;
  memcpy(&said, o, sizeof said);
  CHECK(said == size);
  for (size_t i = known; i < size; i++) CHECK(o[i] == 0);
  const int32_t status = take(o);
  if (status != MORULA_STATUS_OK) fprintf(stderr, "%s of %zu bytes\n", name, size);
  STATUS(status, MORULA_STATUS_OK);
  if (size > known) {
    /* A field that a later release has and this host sets: not silently left out. */
    o[size - 1] = 1;
    STATUS(take(o), MORULA_STATUS_STRUCT_SIZE);
    CHECK(strstr(morula_last_error_message(), name) != NULL);
  }
  /* Shorter than the first release: a forgotten or wrong struct_size. */
  said = first - 1;
  memcpy(o, &said, sizeof said);
  STATUS(take(o), MORULA_STATUS_STRUCT_SIZE);
  STATUS(init(o, first - 1), MORULA_STATUS_STRUCT_SIZE);
  free(o);
}

#define INIT(type) \
  static int32_t init_##type(void *o, size_t size) { return type##_init((type *)o, size); }
INIT(morula_import_options)
INIT(morula_file_options)
INIT(morula_solid_options)
INIT(morula_clump_options)
INIT(morula_mass_options)
INIT(morula_contact_options)
INIT(morula_export_options)
INIT(morula_break_options)
INIT(morula_held)
INIT(morula_cost_options)
INIT(morula_cost_bounds)
INIT(morula_sweep_options)

/* What the library fills: no byte beyond what the caller knows, zeros where only the caller knows. */
static morula_fragments *fragments;
static morula_cache *cache;
static int32_t fill_report(void *p) { return morula_shape_report(shape, p); }
static int32_t fill_moments(void *p) { return morula_shape_moments(shape, 2, p); }
static int32_t fill_overlap(void *p) { return morula_clump_overlap(clump, p); }
static int32_t fill_surface(void *p) { return morula_clump_surface(clump, p); }
static int32_t fill_counters(void *p) { return morula_clump_counters(clump, p); }
static int32_t fill_masses(void *p) { return morula_body_masses(body, p); }
static int32_t fill_timestep(void *p) {
  morula_contact_options contact;
  OK(morula_contact_options_init(&contact, sizeof contact));
  contact.young = 5e7;
  return morula_body_timestep(body, &contact, p);
}
static int32_t fill_fragment(void *p) { return morula_fragments_get(fragments, 0, p); }
static int32_t fill_totals(void *p) { return morula_fragments_totals(fragments, p); }
static int32_t fill_counts(void *p) { return morula_cache_counters(cache, p); }
static int32_t fill_held(void *p) {
  return morula_parent_held(parent, 2, 1, NULL, NULL, NULL, NULL, p);
}

static morula_sweep *sweep;
static int32_t fill_points(void *p) { return morula_cost_copy(cost, 3, p); }
static int32_t fill_swept(void *p) { return morula_sweep_copy(sweep, 2, p); }

/* Arrays go by the size that the first struct says. */
static void filled_each(int32_t (*fill)(void *), size_t count, size_t first, size_t known) {
  const size_t sizes[] = {first, known, known + 8, known + 200};
  for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
    const size_t size = sizes[i];
    unsigned char *p = malloc(count * size);
    CHECK(p != NULL);
    if (!p) return;
    memset(p, 0xff, count * size);
    memcpy(p, &size, sizeof size);
    OK(fill(p));
    for (size_t k = 0; k < count; k++) {
      const unsigned char *one = p + k * size;
      size_t said = 0;
      memcpy(&said, one, sizeof said);
      CHECK(said == size);
      for (size_t b = known; b < size; b++) CHECK(one[b] == 0);
    }
    const size_t wrong = first - 1;
    memcpy(p, &wrong, sizeof wrong);
    STATUS(fill(p), MORULA_STATUS_STRUCT_SIZE);
    free(p);
  }
}

static void filled(int32_t (*fill)(void *), size_t first, size_t known) {
  const size_t sizes[] = {first, known, known + 1, known + 8, known + 200};
  for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
    const size_t size = sizes[i];
    unsigned char *p = malloc(size);
    CHECK(p != NULL);
    if (!p) return;
    memset(p, 0xff, size);
    memcpy(p, &size, sizeof size);
    OK(fill(p));
    size_t said = 0;
    memcpy(&said, p, sizeof said);
    CHECK(said == size);
    for (size_t k = known; k < size; k++) CHECK(p[k] == 0);
    said = first - 1;
    memcpy(p, &said, sizeof said);
    STATUS(fill(p), MORULA_STATUS_STRUCT_SIZE);
    free(p);
  }
}

int main(void) {
  shape = l_shape();
  OK(morula_solid_from_shape(shape, NULL, &solid));
  morula_clump_options some;
  OK(morula_clump_options_init(&some, sizeof some));
  some.spheres = 12;
  some.effort = MORULA_EFFORT_DRAFT;
  some.wants = MORULA_WANT_OVERLAP | MORULA_WANT_SURFACE | MORULA_WANT_MOMENTS;
  OK(morula_clump_from_solid(solid, &some, &clump));
  OK(morula_body_from_clump(clump, NULL, &body));
  OK(morula_parent_from_clump(solid, clump, 1, &parent));
  OK(morula_cache_new(1u << 20, &cache));
  const uint64_t counts[3] = {2, 4, 8};
  morula_cost_options few;
  OK(morula_cost_options_init(&few, sizeof few));
  few.counts = counts;
  few.count = 3;
  OK(morula_cost_curve(solid, NULL, &few, &cost));
  const double cells[2] = {12, 16};
  const int32_t method = MORULA_METHOD_EUCLIDEAN;
  const double deadline = 0;
  morula_sweep_options over;
  OK(morula_sweep_options_init(&over, sizeof over));
  over.resolutions = cells;
  over.resolution_count = 2;
  over.methods = &method;
  over.deadlines = &deadline;
  over.method_count = over.deadline_count = 1;
  OK(morula_sweep_from_shape(shape, NULL, NULL, &few, &over, &sweep));
  morula_held held = {0};
  held.struct_size = sizeof held;
  OK(fill_held(&held));
  OK(morula_parent_break(parent, NULL, 0, &held, NULL, &fragments));

  OPTIONS(morula_import_options, take_import, 64);
  OPTIONS(morula_file_options, take_file, 120);
  OPTIONS(morula_solid_options, take_solid, 56);
  OPTIONS(morula_clump_options, take_clump, 120, 128, 152, 168, 240);
  OPTIONS(morula_mass_options, take_mass, 64);
  OPTIONS(morula_contact_options, take_contact, 48);
  OPTIONS(morula_export_options, take_export, 40, 48);
  OPTIONS(morula_break_options, take_break, 224);
  OPTIONS(morula_held, take_held, 200);
  OPTIONS(morula_cost_options, take_cost, 120);
  OPTIONS(morula_cost_bounds, take_bounds, 72);
  OPTIONS(morula_sweep_options, take_sweep, 64);

  filled(fill_report, 216, sizeof(morula_report));
  filled(fill_moments, 232, sizeof(morula_moments));
  filled(fill_overlap, 112, sizeof(morula_overlap));
  filled(fill_surface, 64, sizeof(morula_surface));
  filled(fill_counters, 112, sizeof(morula_counters));
  filled(fill_masses, 80, sizeof(morula_masses));
  filled(fill_timestep, 56, sizeof(morula_timestep));
  filled(fill_fragment, 368, sizeof(morula_fragment));
  filled(fill_totals, 48, sizeof(morula_break_totals));
  filled(fill_counts, 48, sizeof(morula_cache_counts));
  filled(fill_held, 200, sizeof(morula_held));
  filled_each(fill_points, 3, 168, sizeof(morula_cost_point));
  filled_each(fill_swept, 2, 80, sizeof(morula_swept));

  morula_fragments_free(fragments);
  morula_sweep_free(sweep);
  morula_cost_free(cost);
  morula_cache_free(cache);
  morula_parent_free(parent);
  morula_body_free(body);
  morula_clump_free(clump);
  morula_solid_free(solid);
  morula_shape_free(shape);
  return checks_done();
}
