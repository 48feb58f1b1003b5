/* Sends a fragment to another rank, where a cache has its parent ready, and breaks it there. */
#include "check.h"

#include <stdlib.h>

static morula_cache_counts counts(const morula_cache *cache) {
  morula_cache_counts c = {.struct_size = sizeof c};
  OK(morula_cache_counters(cache, &c));
  return c;
}

/* The spheres of a fragment in the world. */
static size_t spheres(const morula_fragments *all, size_t index, double xyzr[20][4]) {
  morula_fragment f = {.struct_size = sizeof f};
  OK(morula_fragments_get(all, index, &f));
  OK(morula_fragments_copy_spheres(all, index, MORULA_FRAME_WORLD, 20, xyzr[0]));
  return (size_t)f.sphere_count;
}

/* A block in three labels, one of them in two pieces, as a fracture model gives them. */
static void labelled(void) {
  enum { NX = 12, NY = 8, NZ = 8 };
  static uint32_t labels[NZ][NY][NX];
  for (int k = 0; k < NZ; k++)
    for (int j = 0; j < NY; j++)
      for (int i = 0; i < NX; i++)
        labels[k][j][i] = i < 4 ? 9 : i < 8 ? 4 : k < 3 ? 7 : k < 5 ? 4 : 7;
  const size_t dims[3] = {NX, NY, NZ};
  const double spacing[3] = {0.25, 0.25, 0.25}, origin[3] = {1, 2, 3};
  /* The block as a body of its own, for what a solver holds of it. */
  static uint8_t mask[NZ][NY][NX];
  memset(mask, 1, sizeof mask);
  morula_shape *shape = NULL;
  morula_moments m = {.struct_size = sizeof m};
  OK(morula_shape_from_mask(mask[0][0], dims, spacing, origin, NULL, &shape));
  OK(morula_shape_moments(shape, 2, &m));
  morula_shape_free(shape);
  morula_held held;
  OK(morula_held_init(&held, sizeof held));
  held.mass = m.mass;
  memcpy(held.centre, m.centre, sizeof m.centre);
  memcpy(held.inertia, m.inertia, sizeof m.inertia);
  held.velocity[1] = 3;
  held.angular_velocity[2] = 5;
  morula_break_options options;
  OK(morula_break_options_init(&options, sizeof options));
  options.kind = 77; /* not read */
  options.spheres = 12;
  const double body[1][4] = {{2.5, 3, 4, 1.6}};
  morula_fragments *all = NULL, *again = NULL;
  OK(morula_fragments_from_labels(labels[0][0], dims, spacing, origin, NULL, body[0], 1, &held,
                                  &options, &all));
  size_t count = 0;
  OK(morula_fragments_count(all, &count));
  CHECK(count == 4);
  const uint64_t cells[4] = {4, 7, 7, 9};
  double mass = 0, momentum = 0, volume = 0;
  for (size_t i = 0; i < count; i++) {
    morula_fragment f = {.struct_size = sizeof f};
    double xyzr[20][4];
    OK(morula_fragments_get(all, i, &f));
    CHECK(f.cell == cells[i] && f.coverage > 0.3 && f.step_factor > 0 && f.half_space_count == 0);
    CHECK(f.map_count == f.sphere_count && f.volume_share < f.coverage);
    OK(morula_fragments_copy_spheres(all, i, MORULA_FRAME_INPUT, 20, xyzr[0]));
    for (size_t s = 0; s < f.sphere_count; s++) {
      const double *c = xyzr[s], x = c[0] - body[0][0], y = c[1] - body[0][1], z = c[2] - body[0][2];
      CHECK(sqrt(x * x + y * y + z * z) + c[3] <= body[0][3]); /* within the body's own sphere */
      if (i == 3) CHECK(c[0] + c[3] <= 2 && c[0] - c[3] >= 1);
    }
    mass += f.mass;
    momentum += f.mass * f.velocity[1];
    volume += f.volume;
  }
  NEAR(mass, m.mass, 1e-13 * m.mass);
  NEAR(momentum, 3 * m.mass, 1e-12 * m.mass);
  NEAR(volume, 12, 1e-12);
  morula_break_totals totals = {.struct_size = sizeof totals};
  OK(morula_fragments_totals(all, &totals));
  CHECK(totals.inertia_error < 1e-13 && fabs(totals.energy) < 1e-11 * m.mass);
  /* A piece breaks again by itself. */
  options.kind = MORULA_CUT_SEEDED;
  morula_held own = {.struct_size = sizeof own};
  OK(morula_fragments_held(all, 3, NULL, NULL, NULL, NULL, &own));
  OK(morula_parent_break(NULL, all, 3, &own, &options, &again));
  OK(morula_fragments_count(again, &count));
  CHECK(count == 4);
  morula_fragments_free(again);
  morula_fragments_free(all);
  all = NULL;
  /* Nothing is there. */
  memset(labels, 0, sizeof labels);
  STATUS(morula_fragments_from_labels(labels[0][0], dims, spacing, origin, NULL, NULL, 0, &held,
                                      &options, &all), MORULA_STATUS_EMPTY);
  STATUS(morula_fragments_from_labels(NULL, dims, spacing, origin, NULL, NULL, 0, &held, &options,
                                      &all), MORULA_STATUS_NULL_POINTER);
  held.mass = NAN;
  labels[0][0][0] = 1;
  STATUS(morula_fragments_from_labels(labels[0][0], dims, spacing, origin, NULL, NULL, 0, &held,
                                      &options, &all), MORULA_STATUS_NOT_FINITE);
  CHECK(all == NULL);
}

int main(void) {
  labelled();
  morula_shape *shape = l_shape(), *other = NULL;
  double coarse[2][4] = {{10.5, 20.5, 30.5, 0.4}, {11.5, 20.5, 30.5, 0.4}};
  morula_cache *cache = NULL;
  OK(morula_cache_new(1u << 30, &cache));
  OK(morula_shape_from_primitive("stone", NULL, NULL, 0, 12, 0, NULL, &other));

  /* One parent a shape, grid and spheres. */
  morula_parent *parent = NULL, *same = NULL, *finer = NULL, *stone = NULL;
  morula_solid_options grid;
  OK(morula_solid_options_init(&grid, sizeof grid));
  OK(morula_cache_parent(cache, shape, &grid, coarse[0], 2, &parent));
  OK(morula_cache_parent(cache, shape, NULL, coarse[0], 2, &same));
  grid.cells /= 2;
  OK(morula_cache_parent(cache, shape, &grid, coarse[0], 2, &finer));
  OK(morula_cache_parent(cache, other, NULL, NULL, 0, &stone));
  morula_cache_counts c = counts(cache);
  CHECK(c.hits == 1 && c.misses == 3 && c.evicted == 0 && c.parents == 3 && c.bytes > 0);
  OK(morula_cache_clear(cache));
  CHECK(counts(cache).parents == 0 && counts(cache).bytes == 0 && counts(cache).misses == 3);
  STATUS(morula_cache_parent(cache, NULL, NULL, NULL, 0, &stone), MORULA_STATUS_NULL_POINTER);
  coarse[1][3] = -1;
  STATUS(morula_cache_parent(cache, shape, NULL, coarse[0], 2, &stone),
         MORULA_STATUS_INVALID_ARGUMENT);
  morula_cache_free(cache);
  /* None fits. */
  OK(morula_cache_new(1000, &cache));
  morula_parent *kept = NULL;
  OK(morula_cache_parent(cache, other, NULL, NULL, 0, &kept));
  c = counts(cache);
  CHECK(c.parents == 0 && c.evicted == 1);
  morula_parent_free(kept);
  morula_cache_free(cache);

  /* The parents outlive the cache. */
  morula_held held = {.struct_size = sizeof held};
  double at[3] = {3, -2, 1}, turn[4] = {0.5, 0.5, -0.5, 0.5}, v[3] = {1, 2, 3}, w[3] = {-4, 1, 2};
  OK(morula_parent_held(parent, 2500, 1e-3, at, turn, v, w, &held));
  morula_break_options options;
  OK(morula_break_options_init(&options, sizeof options));
  options.within_union = 0;
  options.cells = 3;
  morula_fragments *broken = NULL;
  OK(morula_parent_break(parent, NULL, 0, &held, &options, &broken));
  size_t count = 0;
  OK(morula_fragments_count(broken, &count));
  for (size_t i = 0; i < count; i++) {
    size_t size = 0;
    OK(morula_fragments_serialize(broken, i, 0, NULL, &size));
    CHECK(size < 4096);
    uint8_t *bytes = malloc(size);
    if (bytes == NULL) abort();
    STATUS(morula_fragments_serialize(broken, i, size - 1, bytes, NULL),
           MORULA_STATUS_BUFFER_TOO_SMALL);
    OK(morula_fragments_serialize(broken, i, size, bytes, &size));
    morula_held own = {.struct_size = sizeof own};
    OK(morula_fragments_held(broken, i, NULL, NULL, NULL, NULL, &own));

    /* There. */
    morula_fragments *arrived = NULL;
    OK(morula_fragments_deserialize(same, bytes, size, &own, &arrived));
    size_t one = 0;
    OK(morula_fragments_count(arrived, &one));
    CHECK(one == 1);
    double here[20][4], there[20][4];
    size_t n = spheres(broken, i, here);
    CHECK(n > 0 && n == spheres(arrived, 0, there));
    for (size_t s = 0; s < n; s++) {
      for (int a = 0; a < 3; a++) NEAR(here[s][a], there[s][a], 1e-15 * 8);
      CHECK(here[s][3] == there[s][3]);
    }
    morula_fragment f = {.struct_size = sizeof f}, g = {.struct_size = sizeof g};
    OK(morula_fragments_get(broken, i, &f));
    OK(morula_fragments_get(arrived, 0, &g));
    CHECK(f.volume == g.volume && fabs(f.mass / g.mass - 1) < 1e-15 && f.cell == g.cell);
    for (int a = 0; a < 3; a++) {
      NEAR(f.angular_velocity[a], g.angular_velocity[a], 1e-11);
      NEAR(f.velocity[a], g.velocity[a], 1e-14);
    }
    STATUS(morula_fragments_copy_masses(arrived, 0, 20, here[0]), MORULA_STATUS_NOT_WANTED);
    /* It breaks there as it would here. */
    morula_fragments *pieces[2] = {NULL, NULL};
    size_t many[2] = {0, 0};
    OK(morula_parent_break(NULL, broken, i, &own, &options, &pieces[0]));
    OK(morula_parent_break(same, arrived, 0, &own, &options, &pieces[1]));
    for (int k = 0; k < 2; k++) OK(morula_fragments_count(pieces[k], &many[k]));
    CHECK(many[0] == many[1] && many[0] > 1);
    n = spheres(pieces[0], 0, here);
    CHECK(n == spheres(pieces[1], 0, there) && memcmp(here, there, n * sizeof here[0]) == 0);
    for (int k = 0; k < 2; k++) morula_fragments_free(pieces[k]);
    morula_fragments_free(arrived);

    /* What is refused: another parent, another grid, a body without mass, changed bytes. */
    morula_fragments *none = NULL;
    STATUS(morula_fragments_deserialize(stone, bytes, size, &own, &none),
           MORULA_STATUS_INVALID_ARGUMENT);
    morula_held empty = own;
    empty.mass = 0;
    STATUS(morula_fragments_deserialize(same, bytes, size, &empty, &none),
           MORULA_STATUS_INVALID_ARGUMENT);
    STATUS(morula_fragments_deserialize(same, bytes, size, NULL, &none),
           MORULA_STATUS_NULL_POINTER);
    STATUS(morula_fragments_deserialize(same, bytes, size - 1, &own, &none), MORULA_STATUS_FORMAT);
    bytes[size - 9] ^= 4;
    STATUS(morula_fragments_deserialize(same, bytes, size, &own, &none), MORULA_STATUS_FORMAT);
    CHECK(none == NULL);
    free(bytes);
  }
  STATUS(morula_fragments_serialize(broken, count, 0, NULL, &count),
         MORULA_STATUS_INDEX_OUT_OF_RANGE);
  morula_fragments_free(broken);
  morula_cache_free(NULL);
  morula_parent_free(parent);
  morula_parent_free(same);
  morula_parent_free(finer);
  morula_parent_free(stone);
  morula_shape_free(other);
  morula_shape_free(shape);
  return checks_done();
}
