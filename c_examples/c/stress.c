/* Many threads at once: one handle of each kind that all of them read, none of which was read before, so
 * that they race for what a handle makes at its first use; and handles of their own. Each thread's
 * checksum of all results is that of one thread alone, with handles made alike. */
#include "stress.h"

#include <pthread.h>

enum { THREADS = 8, ROUNDS = 3 };

static int of_break(const morula_fragments *all, struct reader *r) {
  size_t count = 0, dust = 0, notes = 0, size = 0;
  FILLED(morula_break_totals, totals);
  TRY(morula_fragments_totals(all, &totals));
  ADD(totals);
  TRY(morula_fragments_count(all, &count));
  TRY(morula_fragments_dust_count(all, &dust));
  for (size_t i = 0; i < count + dust; i++) {
    FILLED(morula_fragment, f);
    if (i < count) TRY(morula_fragments_get(all, i, &f));
    else TRY(morula_fragments_dust(all, i - count, &f));
    ADD(f);
  }
  TRY(morula_fragments_note_count(all, &notes));
  for (size_t i = 0; i < notes; i++) {
    TRY(morula_fragments_copy_note(all, i, sizeof r->text, r->text, &size));
    add(r, r->text, size);
  }
  return 0;
}

/* The radii that spheres grow to are made when they are first asked for. */
static int of_fragments(const struct handles *h, const struct asked *o, struct reader *r) {
  size_t count = 0, size = 0;
  morula_fragments *again = NULL;
  morula_shape *shape = NULL;
  FILLED(morula_held, held);
  TRY(morula_fragments_count(h->fragments, &count));
  for (size_t i = 0; i < count; i++) {
    FILLED(morula_fragment, f);
    TRY(morula_fragments_grow(h->fragments, i, 0.5, NULL, 0, 0, MORULA_FRAME_WORLD, 2 * MOST, r->numbers));
    TRY(morula_fragments_get(h->fragments, i, &f));
    const size_t n = (size_t)f.sphere_count;
    add(r, r->numbers, 4 * n * sizeof(double));
    TRY(morula_fragments_copy_spheres(h->fragments, i, MORULA_FRAME_BODY, 2 * MOST, r->numbers));
    add(r, r->numbers, 4 * n * sizeof(double));
    const int32_t weighed = morula_fragments_copy_masses(h->fragments, i, MOST, r->numbers);
    if (weighed != MORULA_STATUS_NO_MASSES) TRY(weighed);
    if (!weighed) add(r, r->numbers, n * sizeof(double));
    TRY(morula_fragments_copy_map(h->fragments, i, r->indices, MOST, r->indices + MOST, r->numbers));
    add(r, r->numbers, (size_t)f.map_count * sizeof(double));
    TRY(morula_fragments_copy_half_spaces(h->fragments, i, MOST, r->numbers));
    add(r, r->numbers, 4 * (size_t)f.half_space_count * sizeof(double));
    TRY(morula_fragments_shape(h->fragments, i, &shape));
    TRY(morula_shape_serialize(shape, BYTES, r->bytes, &size));
    add(r, r->bytes, size);
    morula_shape_free(shape);
  }
  TRY(morula_fragments_held(h->fragments, 0, NULL, NULL, NULL, NULL, &held));
  ADD(held);
  TRY(morula_parent_break(h->parent, h->fragments, 0, &held, &o->cut, &again));
  TRY(of_break(again, r));
  morula_fragments_free(again);
  TRY(morula_fragments_serialize(h->fragments, 0, BYTES, r->bytes, &size));
  add(r, r->bytes, size);
  TRY(morula_fragments_deserialize(h->parent, r->bytes, size, &held, &again));
  TRY(of_break(again, r));
  morula_fragments_free(again);
  return of_break(h->fragments, r);
}

/* A cache locks itself: it, too, is shared by threads. */
static int of_parents(const struct handles *h, const struct asked *o, struct reader *r) {
  uint64_t bytes = 0;
  morula_fragments *all[1] = {NULL};
  const morula_parent *parents[1] = {h->parent};
  morula_parent *parent = NULL;
  FILLED(morula_held, held);
  FILLED(morula_cache_counts, counts);
  TRY(morula_parent_held(h->parent, 1, 1, NULL, NULL, NULL, NULL, &held));
  ADD(held);
  TRY(morula_parent_break(h->parent, NULL, 0, &held, &o->cut, all));
  TRY(of_break(all[0], r));
  morula_fragments_free(all[0]);
  TRY(morula_parents_break(parents, NULL, NULL, &held, &o->cut, 1, all, NULL));
  TRY(of_break(all[0], r));
  morula_fragments_free(all[0]);
  TRY(morula_parent_bytes(h->parent, &bytes));
  TRY(morula_clump_copy_spheres(h->clump, 2 * MOST, r->numbers));
  TRY(morula_cache_parent(h->cache, h->shape, &o->grid, r->numbers, SPHERES, &parent));
  TRY(morula_parent_held(parent, 1, 1, NULL, NULL, NULL, NULL, &held));
  ADD(held);
  morula_parent_free(parent);
  return morula_cache_counters(h->cache, &counts);
}

/* All that the handles give, in one number; 0: a call failed. */
static uint64_t read_all(const struct handles *h) {
  struct reader r;
  struct asked o;
  r.all = 14695981039346656037u;
  int line = ask(5, 1, &o);
  if (!line) line = of_solid(h, &o, &r);
  if (!line) line = of_fragments(h, &o, &r);
  if (!line) line = of_moments(h, &o, &r);
  if (!line) line = of_shape(h, &o, &r);
  if (!line) line = of_body(h, &o, &r);
  if (!line) line = of_sweep(h, &r);
  if (!line) line = of_parents(h, &o, &r);
  if (!line) return r.all;
  fprintf(stderr, "line %d: %s\n", line, morula_last_error_message());
  return 0;
}

struct job {
  const struct handles *shared;
  pthread_barrier_t *start;
  uint64_t seed, of_shared, of_own;
};

static uint64_t own(uint64_t seed, int32_t threads) {
  struct handles h;
  const int line = make(seed, threads, &h);
  if (line) fprintf(stderr, "line %d: %s\n", line, morula_last_error_message());
  const uint64_t all = line ? 0 : read_all(&h);
  unmake(&h);
  return all;
}

static void *work(void *user) {
  struct job *job = user;
  pthread_barrier_wait(job->start);
  job->of_shared = read_all(job->shared);
  for (int i = 1; i < ROUNDS; i++)
    if (read_all(job->shared) != job->of_shared) job->of_shared = 0;
  job->of_own = own(job->seed, 1 + (int32_t)(job->seed % 3));
  return NULL;
}

int main(void) {
  struct handles shared;
  pthread_t threads[THREADS];
  pthread_barrier_t start;
  struct job jobs[THREADS];
  CHECK(!make(100, 1, &shared));
  const uint64_t alone = own(100, 1);
  CHECK(alone != 0);
  CHECK(pthread_barrier_init(&start, NULL, THREADS) == 0);
  for (int i = 0; i < THREADS; i++) {
    jobs[i].shared = &shared;
    jobs[i].start = &start;
    jobs[i].seed = (uint64_t)(i / 2); /* two threads make each stone */
    const int failed = pthread_create(&threads[i], NULL, work, &jobs[i]);
    CHECK(!failed);
    if (failed) return checks_done(); /* the others would wait for it */
  }
  for (int i = 0; i < THREADS; i++) CHECK(pthread_join(threads[i], NULL) == 0);
  for (int i = 0; i < THREADS; i++) {
    CHECK(jobs[i].of_shared == alone);
    CHECK(jobs[i].of_own != 0 && (i % 2 == 0 || jobs[i].of_own == jobs[i - 1].of_own));
    if (i % 2 == 0) CHECK(jobs[i].of_own == own(jobs[i].seed, 1));
    printf("thread %d: shared %016llx, own %016llx\n", i, (unsigned long long)jobs[i].of_shared,
           (unsigned long long)jobs[i].of_own);
  }
  CHECK(read_all(&shared) == alone);
  CHECK(pthread_barrier_destroy(&start) == 0);
  unmake(&shared);
  return checks_done();
}
