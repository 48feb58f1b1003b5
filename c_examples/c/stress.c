/* Many threads at once: one handle of each kind that all of them read, and handles of their own. Each
 * thread's checksum of all results is that of one thread alone. */
#include "check.h"

#include <pthread.h>
#include <stdlib.h>

enum { THREADS = 8, ROUNDS = 3, SPHERES = 12 };

struct handles {
  morula_shape *shape;
  morula_solid *solid;
  morula_clump *clump;
  morula_body *body;
  morula_parent *parent;
  morula_cache *cache;
};

static uint64_t sum(uint64_t seed, const void *bytes, size_t size) {
  const unsigned char *b = bytes;
  for (size_t i = 0; i < size; i++) seed = (seed ^ b[i]) * 1099511628211u;
  return seed;
}

static int make(uint64_t seed, int32_t threads, struct handles *h) {
  morula_solid_options grid;
  morula_clump_options options;
  memset(h, 0, sizeof *h);
  morula_solid_options_init(&grid, sizeof grid);
  grid.cells = 20;
  morula_clump_options_init(&options, sizeof options);
  options.spheres = SPHERES;
  options.effort = MORULA_EFFORT_DRAFT;
  options.threads = threads;
  options.wants = MORULA_WANT_OVERLAP | MORULA_WANT_MOMENTS;
  return morula_shape_from_primitive("stone", NULL, NULL, 0, 16, seed, NULL, &h->shape) ||
         morula_solid_from_shape(h->shape, &grid, &h->solid) ||
         morula_clump_from_solid(h->solid, &options, &h->clump) ||
         morula_body_from_clump(h->clump, NULL, &h->body) ||
         morula_parent_from_clump(h->solid, h->clump, threads, &h->parent) ||
         morula_cache_new(1 << 20, &h->cache);
}

static void unmake(struct handles *h) {
  morula_cache_free(h->cache);
  morula_parent_free(h->parent);
  morula_body_free(h->body);
  morula_clump_free(h->clump);
  morula_solid_free(h->solid);
  morula_shape_free(h->shape);
}

/* The const calls on each kind of handle, and what they give, in one number; 0: one failed. */
static uint64_t read_all(const struct handles *h) {
  double xyzr[SPHERES][4], masses[SPHERES], points[3][3] = {{0, 0, 0}, {0.3, 0.2, 0.1}, {1, 1, 1}};
  double distances[3];
  uint8_t *bytes = NULL;
  size_t size = 0, count = 0;
  morula_moments m;
  morula_overlap o;
  morula_timestep t;
  morula_held held;
  morula_contact_options contact;
  morula_break_options cut;
  morula_solid_options grid;
  morula_fragments *fragments = NULL;
  morula_files *files = NULL;
  morula_parent *parent = NULL;
  morula_clump *clump = NULL;
  morula_clump_options options;
  uint64_t all = 14695981039346656037u;
  memset(&m, 0, sizeof m);
  memset(&o, 0, sizeof o);
  memset(&t, 0, sizeof t);
  m.struct_size = sizeof m;
  o.struct_size = sizeof o;
  t.struct_size = sizeof t;
  held.struct_size = sizeof held;
  morula_contact_options_init(&contact, sizeof contact);
  contact.stiffness = 100;
  morula_break_options_init(&cut, sizeof cut);
  cut.cells = 2;
  cut.spheres = 4;
  morula_solid_options_init(&grid, sizeof grid);
  grid.cells = 12;
  morula_clump_options_init(&options, sizeof options);
  options.spheres = 5;
  options.effort = MORULA_EFFORT_DRAFT;
  if (morula_shape_moments(h->shape, 2, &m)) return 0;
  all = sum(all, &m, sizeof m);
  if (morula_shape_serialize(h->shape, 0, NULL, &size)) return 0;
  bytes = malloc(size);
  if (morula_shape_serialize(h->shape, size, bytes, &size)) return 0;
  all = sum(all, bytes, size);
  free(bytes);
  if (morula_solid_distance(h->solid, 3, points[0], distances)) return 0;
  all = sum(all, distances, sizeof distances);
  if (morula_clump_copy_spheres(h->clump, SPHERES, xyzr[0])) return 0;
  all = sum(all, xyzr, sizeof xyzr);
  if (morula_clump_overlap(h->clump, &o)) return 0;
  all = sum(all, &o, sizeof o);
  if (morula_clump_from_solid(h->solid, &options, &clump)) return 0;
  if (morula_clump_copy_spheres(clump, SPHERES, xyzr[0])) return 0;
  all = sum(all, xyzr, 5 * sizeof xyzr[0]);
  morula_clump_free(clump);
  if (morula_body_copy_masses(h->body, SPHERES, masses)) return 0;
  all = sum(all, masses, sizeof masses);
  if (morula_body_timestep(h->body, &contact, &t)) return 0;
  all = sum(all, &t, sizeof t);
  if (morula_body_export(h->body, MORULA_EXPORT_LAMMPS, NULL, &files)) return 0;
  if (morula_files_size(files, 0, &size)) return 0;
  bytes = malloc(size);
  if (morula_files_copy_bytes(files, 0, size, bytes)) return 0;
  all = sum(all, bytes, size);
  free(bytes);
  morula_files_free(files);
  if (morula_parent_held(h->parent, 1, 1, NULL, NULL, NULL, NULL, &held)) return 0;
  if (morula_parent_break(h->parent, NULL, 0, &held, &cut, &fragments)) return 0;
  if (morula_fragments_count(fragments, &count)) return 0;
  for (size_t i = 0; i < count; i++) {
    morula_fragment f;
    memset(&f, 0, sizeof f);
    f.struct_size = sizeof f;
    if (morula_fragments_get(fragments, i, &f)) return 0;
    all = sum(all, &f, sizeof f);
  }
  morula_fragments_free(fragments);
  /* A cache locks itself: it, too, is shared by threads. */
  if (morula_cache_parent(h->cache, h->shape, &grid, xyzr[0], 5, &parent)) return 0;
  if (morula_parent_held(parent, 1, 1, NULL, NULL, NULL, NULL, &held)) return 0;
  all = sum(all, &held, sizeof held);
  morula_parent_free(parent);
  return all;
}

struct job {
  const struct handles *shared;
  uint64_t seed, of_shared, of_own;
};

static uint64_t own(uint64_t seed, int32_t threads) {
  struct handles h;
  const uint64_t all = make(seed, threads, &h) ? 0 : read_all(&h);
  unmake(&h);
  return all;
}

static void *work(void *user) {
  struct job *job = user;
  job->of_shared = read_all(job->shared);
  for (int i = 1; i < ROUNDS; i++)
    if (read_all(job->shared) != job->of_shared) job->of_shared = 0;
  job->of_own = own(job->seed, 1 + (int32_t)(job->seed % 3));
  return NULL;
}

int main(void) {
  struct handles shared;
  pthread_t threads[THREADS];
  struct job jobs[THREADS];
  CHECK(!make(100, 1, &shared));
  const uint64_t alone = read_all(&shared);
  CHECK(alone != 0);
  for (int i = 0; i < THREADS; i++) {
    jobs[i].shared = &shared;
    jobs[i].seed = (uint64_t)(i / 2); /* two threads make each stone */
    CHECK(pthread_create(&threads[i], NULL, work, &jobs[i]) == 0);
  }
  for (int i = 0; i < THREADS; i++) pthread_join(threads[i], NULL);
  for (int i = 0; i < THREADS; i++) {
    CHECK(jobs[i].of_shared == alone);
    CHECK(jobs[i].of_own != 0 && jobs[i].of_own == own(jobs[i].seed, 1));
    printf("thread %d: shared %016llx, own %016llx\n", i, (unsigned long long)jobs[i].of_shared,
           (unsigned long long)jobs[i].of_own);
  }
  CHECK(read_all(&shared) == alone);
  unmake(&shared);
  return checks_done();
}
