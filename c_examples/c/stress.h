/* What the threads of stress.c make and read: every function that takes a const handle is called here or
 * there, but for those that write files and the one that empties a cache. */
#ifndef STRESS_H
#define STRESS_H

#include "check.h"

enum { SPHERES = 12, MOST = 64, BYTES = 1 << 16 };
#define WANTS (MORULA_WANT_OVERLAP | MORULA_WANT_SURFACE | MORULA_WANT_MOMENTS)

struct handles {
  morula_shape *shape;
  morula_solid *solid;
  morula_clump *clump;
  morula_body *body;
  morula_files *files;
  morula_cost *cost;
  morula_sweep *sweep;
  morula_parent *parent;
  morula_cache *cache;
  morula_fragments *fragments;
};

/* What a thread reads into, and the number that it makes of all that it reads. */
struct reader {
  uint64_t all;
  double numbers[8 * MOST];
  uint32_t indices[2 * MOST];
  uint8_t bytes[BYTES];
  char text[2048];
};

/* Leaves with the line of the call that failed. */
#define TRY(call)           \
  do {                      \
    if (call) return __LINE__; \
  } while (0)
#define ADD(value) add(r, &(value), sizeof(value))
/* A struct that the library fills. */
#define FILLED(type, name) \
  type name;               \
  memset(&name, 0, sizeof name); \
  name.struct_size = sizeof name

static void add(struct reader *r, const void *bytes, size_t size) {
  const unsigned char *b = bytes;
  for (size_t i = 0; i < size; i++) r->all = (r->all ^ b[i]) * 1099511628211u;
}

/* Options of all that is made here: small, since it is made often. */
struct asked {
  morula_solid_options grid;
  morula_clump_options clump;
  morula_cost_options cost;
  morula_break_options cut;
  morula_sweep_options sweep;
  morula_contact_options contact;
};

static const double TOLERANCES[1] = {0.05}, RESOLUTIONS[1] = {10}, NO_DEADLINE[1] = {0};
static const uint64_t COUNTS[2] = {3, 5};
static const int32_t METHODS[1] = {MORULA_METHOD_BEST}, EFFORTS[1] = {MORULA_EFFORT_DRAFT};

static int ask(uint64_t spheres, int32_t threads, struct asked *o) {
  TRY(morula_solid_options_init(&o->grid, sizeof o->grid));
  TRY(morula_clump_options_init(&o->clump, sizeof o->clump));
  TRY(morula_cost_options_init(&o->cost, sizeof o->cost));
  TRY(morula_break_options_init(&o->cut, sizeof o->cut));
  TRY(morula_sweep_options_init(&o->sweep, sizeof o->sweep));
  TRY(morula_contact_options_init(&o->contact, sizeof o->contact));
  o->grid.cells = 16;
  o->clump.spheres = spheres;
  o->clump.effort = MORULA_EFFORT_DRAFT;
  o->clump.threads = threads;
  o->clump.wants = WANTS;
  o->clump.quality_columns = 32;
  o->clump.plane_tolerances = TOLERANCES;
  o->clump.plane_tolerance_count = 1;
  o->cost.counts = COUNTS;
  o->cost.count = 2;
  o->cost.quality_columns = 32;
  o->cut.cells = 3;
  o->cut.spheres = 4;
  o->cut.masses = 1;
  o->cut.threads = threads;
  o->sweep.resolutions = RESOLUTIONS;
  o->sweep.resolution_count = 1;
  o->sweep.methods = METHODS;
  o->sweep.efforts = EFFORTS;
  o->sweep.method_count = 1;
  o->sweep.deadlines = NO_DEADLINE;
  o->sweep.deadline_count = 1;
  o->contact.stiffness = 100;
  return 0;
}

static int make(uint64_t seed, int32_t threads, struct handles *h) {
  struct asked o;
  FILLED(morula_held, held);
  memset(h, 0, sizeof *h);
  TRY(ask(SPHERES, threads, &o));
  TRY(morula_shape_from_primitive("stone", NULL, NULL, 0, 16, seed, NULL, &h->shape));
  TRY(morula_solid_from_shape(h->shape, &o.grid, &h->solid));
  TRY(morula_clump_from_solid(h->solid, &o.clump, &h->clump));
  TRY(morula_body_from_clump(h->clump, NULL, &h->body));
  TRY(morula_body_export(h->body, MORULA_EXPORT_LAMMPS, NULL, &h->files));
  TRY(morula_cost_curve(h->solid, &o.clump, &o.cost, &h->cost));
  TRY(morula_sweep_from_shape(h->shape, NULL, &o.clump, &o.cost, &o.sweep, &h->sweep));
  TRY(morula_parent_from_clump(h->solid, h->clump, threads, &h->parent));
  TRY(morula_cache_new(1 << 20, &h->cache));
  TRY(morula_parent_held(h->parent, 1, 1, NULL, NULL, NULL, NULL, &held));
  TRY(morula_parent_break(h->parent, NULL, 0, &held, &o.cut, &h->fragments));
  /* The clump that lists and breaks used is read by all; the solid is made anew, so that nobody has. */
  morula_solid_free(h->solid);
  h->solid = NULL;
  TRY(morula_solid_from_shape(h->shape, &o.grid, &h->solid));
  return 0;
}

static void unmake(struct handles *h) {
  morula_fragments_free(h->fragments);
  morula_cache_free(h->cache);
  morula_parent_free(h->parent);
  morula_sweep_free(h->sweep);
  morula_cost_free(h->cost);
  morula_files_free(h->files);
  morula_body_free(h->body);
  morula_clump_free(h->clump);
  morula_solid_free(h->solid);
  morula_shape_free(h->shape);
}

static int of_clump(const morula_clump *clump, struct reader *r) {
  size_t n = 0, warnings = 0, size = 0;
  int32_t stopped = 0;
  FILLED(morula_moments, m);
  FILLED(morula_overlap, o);
  FILLED(morula_surface, s);
  FILLED(morula_counters, c);
  TRY(morula_clump_sphere_count(clump, &n));
  TRY(morula_clump_copy_spheres(clump, 2 * MOST, r->numbers));
  add(r, r->numbers, 4 * n * sizeof(double));
  TRY(morula_clump_stopped(clump, &stopped));
  ADD(stopped);
  TRY(morula_clump_moments(clump, 2, &m));
  ADD(m);
  TRY(morula_clump_overlap(clump, &o));
  ADD(o);
  TRY(morula_clump_surface(clump, &s));
  ADD(s);
  TRY(morula_clump_copy_note(clump, sizeof r->text, r->text, &size));
  add(r, r->text, size);
  TRY(morula_clump_counters(clump, &c));
  ADD(c.columns);
  TRY(morula_clump_copy_exposed_areas(clump, MOST, r->numbers));
  add(r, r->numbers, n * sizeof(double));
  TRY(morula_clump_warning_count(clump, &warnings));
  TRY(morula_clump_copy_warnings(clump, MOST, (int32_t *)r->indices, r->numbers, r->numbers + MOST));
  add(r, r->numbers, warnings * sizeof(double));
  for (size_t i = 0; i < warnings; i++) {
    TRY(morula_clump_copy_warning(clump, i, sizeof r->text, r->text, &size));
    add(r, r->text, size);
  }
  TRY(morula_clump_serialize(clump, BYTES, r->bytes, &size));
  add(r, r->bytes, size);
  return 0;
}

static int of_moments(const struct handles *h, const struct asked *o, struct reader *r) {
  size_t size = 0;
  morula_body *placed = NULL;
  FILLED(morula_timestep, t);
  TRY(morula_clump_copy_plane_contacts(h->clump, 2 * MOST, r->indices));
  add(r, r->indices, 3 * sizeof r->indices[0]);
  TRY(morula_clump_timestep(h->clump, NULL, &o->contact, &t));
  ADD(t);
  TRY(morula_clump_transform(h->clump, NULL, 2, NULL, NULL, &placed));
  TRY(morula_body_copy_spheres(placed, MORULA_FRAME_BODY, 2 * MOST, r->numbers));
  add(r, r->numbers, 4 * SPHERES * sizeof(double));
  morula_body_free(placed);
  placed = NULL;
  TRY(morula_body_from_clump(h->clump, NULL, &placed));
  TRY(morula_body_copy_masses(placed, MOST, r->numbers));
  add(r, r->numbers, SPHERES * sizeof(double));
  morula_body_free(placed);
  TRY(morula_clump_serialize(h->clump, 0, NULL, &size));
  ADD(size);
  return of_clump(h->clump, r);
}

static int of_shape(const struct handles *h, const struct asked *o, struct reader *r) {
  size_t size = 0, notes = 0;
  const morula_shape *two[2] = {h->shape, h->shape};
  morula_clump *clumps[2] = {NULL, NULL};
  morula_solid *solid = NULL;
  morula_sweep *sweep = NULL;
  FILLED(morula_moments, m);
  FILLED(morula_report, report);
  FILLED(morula_counters, c);
  TRY(morula_shape_report(h->shape, &report));
  ADD(report);
  TRY(morula_shape_moments(h->shape, 2, &m));
  ADD(m);
  TRY(morula_shape_counters(h->shape, &c));
  TRY(morula_shape_note_count(h->shape, &notes));
  for (size_t i = 0; i < notes; i++) {
    TRY(morula_shape_copy_note(h->shape, i, sizeof r->text, r->text, &size));
    add(r, r->text, size);
  }
  TRY(morula_shape_serialize(h->shape, BYTES, r->bytes, &size));
  add(r, r->bytes, size);
  TRY(morula_clump_from_shape(h->shape, &o->grid, &o->clump, clumps));
  TRY(of_clump(clumps[0], r));
  morula_clump_free(clumps[0]);
  TRY(morula_clumps_from_shapes(two, 2, &o->grid, &o->clump, clumps, NULL));
  for (int i = 0; i < 2; i++) {
    TRY(of_clump(clumps[i], r));
    morula_clump_free(clumps[i]);
  }
  TRY(morula_solid_from_shape(h->shape, &o->grid, &solid));
  TRY(morula_solid_moments(solid, 1, &m));
  ADD(m);
  morula_solid_free(solid);
  TRY(morula_sweep_from_shape(h->shape, NULL, &o->clump, &o->cost, &o->sweep, &sweep));
  morula_sweep_free(sweep);
  return 0;
}

static int of_cost(const morula_cost *cost, struct reader *r) {
  morula_cost_point lines[8];
  size_t n = 0, index = 0, length = 0;
  int32_t cut = 0;
  morula_clump *clump = NULL;
  morula_cost_bounds bounds;
  memset(lines, 0, sizeof lines);
  lines[0].struct_size = sizeof lines[0];
  TRY(morula_cost_count(cost, &n));
  ADD(n);
  TRY(morula_cost_cut(cost, &cut));
  ADD(cut);
  TRY(morula_cost_copy(cost, 8, lines));
  for (size_t i = 0; i < n; i++) {
    lines[i].seconds = lines[i].seconds_so_far = 0;
    ADD(lines[i]);
    TRY(morula_cost_clump(cost, i, &clump));
    TRY(morula_clump_copy_spheres(clump, 2 * MOST, r->numbers));
    add(r, r->numbers, 4 * (size_t)lines[i].spheres * sizeof(double));
    morula_clump_free(clump);
  }
  TRY(morula_cost_bounds_init(&bounds, sizeof bounds));
  bounds.goal = MORULA_GOAL_MISMATCH;
  TRY(morula_cost_choose(cost, &bounds, &index, sizeof r->text, r->text, &length));
  ADD(index);
  return 0;
}

/* The tree behind the distances is made at their first call. */
static int of_solid(const struct handles *h, const struct asked *o, struct reader *r) {
  static const double points[3][3] = {{0, 0, 0}, {0.3, 0.2, 0.1}, {1, 1, 1}};
  size_t dims[3], notes = 0, size = 0;
  double spacing[3], origin[3];
  morula_clump *clumps[2] = {NULL, NULL};
  morula_cost *cost = NULL;
  morula_body *body = NULL;
  morula_parent *parent = NULL;
  morula_fragments *fragments = NULL;
  FILLED(morula_moments, m);
  FILLED(morula_counters, c);
  FILLED(morula_held, held);
  TRY(morula_solid_distance(h->solid, 3, points[0], r->numbers));
  add(r, r->numbers, 3 * sizeof(double));
  TRY(morula_solid_grid(h->solid, dims, spacing, origin));
  ADD(dims);
  ADD(origin);
  TRY(morula_solid_note_count(h->solid, &notes));
  for (size_t i = 0; i < notes; i++) {
    TRY(morula_solid_copy_note(h->solid, i, sizeof r->text, r->text, &size));
    add(r, r->text, size);
  }
  TRY(morula_solid_moments(h->solid, 2, &m));
  ADD(m);
  TRY(morula_solid_counters(h->solid, &c));
  ADD(c.cells);
  TRY(morula_clump_from_solid(h->solid, &o->clump, clumps));
  TRY(of_clump(clumps[0], r));
  TRY(morula_parent_from_clump(h->solid, clumps[0], 1, &parent));
  morula_parent_free(parent);
  morula_clump_free(clumps[0]);
  TRY(morula_clumps_from_solid(h->solid, &o->clump, COUNTS, 2, clumps));
  for (int i = 0; i < 2; i++) {
    TRY(of_clump(clumps[i], r));
    morula_clump_free(clumps[i]);
  }
  TRY(morula_cost_curve(h->solid, &o->clump, &o->cost, &cost));
  TRY(of_cost(cost, r));
  morula_cost_free(cost);
  TRY(morula_clump_copy_spheres(h->clump, 2 * MOST, r->numbers));
  TRY(morula_body_from_spheres(r->numbers, SPHERES, h->solid, NULL, &body));
  morula_body_free(body);
  TRY(morula_parent_from_solid(h->solid, r->numbers, SPHERES, 1, &parent));
  TRY(morula_parent_held(parent, 1, 1, NULL, NULL, NULL, NULL, &held));
  morula_parent_free(parent);
  TRY(morula_reclump_shape(h->solid, r->numbers, SPHERES, &held, &o->cut, &fragments));
  morula_fragments_free(fragments);
  return 0;
}

static int of_body(const struct handles *h, const struct asked *o, struct reader *r) {
  size_t n = 0, size = 0;
  float single[4 * SPHERES];
  morula_body *placed = NULL;
  morula_files *files = NULL;
  FILLED(morula_moments, m);
  FILLED(morula_masses, masses);
  FILLED(morula_timestep, t);
  TRY(morula_body_sphere_count(h->body, &n));
  TRY(morula_body_copy_spheres(h->body, MORULA_FRAME_INPUT, 2 * MOST, r->numbers));
  add(r, r->numbers, 4 * n * sizeof(double));
  TRY(morula_body_copy_spheres_f32(h->body, MORULA_FRAME_BODY, SPHERES, single));
  ADD(single);
  TRY(morula_body_copy_masses(h->body, MOST, r->numbers));
  add(r, r->numbers, n * sizeof(double));
  TRY(morula_body_masses(h->body, &masses));
  ADD(masses);
  TRY(morula_body_copy_binding(h->body, 2 * MOST, r->indices));
  TRY(morula_body_moments(h->body, &m));
  ADD(m);
  TRY(morula_body_timestep(h->body, &o->contact, &t));
  ADD(t);
  TRY(morula_body_transform(h->body, 2, NULL, NULL, 3, &placed));
  TRY(morula_body_moments(placed, &m));
  ADD(m);
  morula_body_free(placed);
  TRY(morula_body_export(h->body, MORULA_EXPORT_LAMMPS, NULL, &files));
  morula_files_free(files);
  TRY(morula_files_count(h->files, &n));
  for (size_t i = 0; i < n; i++) {
    TRY(morula_files_copy_name(h->files, i, sizeof r->text, r->text, &size));
    TRY(morula_files_size(h->files, i, &size));
    TRY(morula_files_copy_bytes(h->files, i, BYTES, r->bytes));
    add(r, r->bytes, size);
  }
  return 0;
}

static int of_sweep(const struct handles *h, struct reader *r) {
  size_t n = 0;
  morula_cost *cost = NULL;
  FILLED(morula_swept, list);
  TRY(morula_sweep_count(h->sweep, &n));
  TRY(morula_sweep_copy(h->sweep, 1, &list));
  ADD(list.lines);
  TRY(morula_sweep_curve(h->sweep, 0, &cost));
  TRY(of_cost(cost, r));
  morula_cost_free(cost);
  return of_cost(h->cost, r);
}

#endif
