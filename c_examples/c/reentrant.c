/* Callbacks that call the library: on the handles of the running call, on others, with failures. */
#include "check.h"

#include <stdlib.h>

typedef struct {
  const morula_shape *shape;
  const morula_solid *solid;
  int depth, calls;
} host;

static int lines;

static int32_t progress(double fraction, void *user) {
  host *h = user;
  CHECK(fraction >= 0 && fraction <= 1);
  if (h->depth) return 0; /* the inner call's own */
  h->depth++;
  h->calls++;
  morula_moments moments = {0};
  moments.struct_size = sizeof moments;
  OK(morula_shape_moments(h->shape, 2, &moments));
  NEAR(moments.mass, L_MASS, 1e-12);
  const double point[3] = {12.5, 20.5, 30.5};
  double distance = 0;
  OK(morula_solid_distance(h->solid, 1, point, &distance));
  NEAR(distance, -0.5, 1e-12);
  /* A failure of the inner call is its own. */
  STATUS(morula_shape_moments(h->shape, 2, NULL), MORULA_STATUS_NULL_POINTER);
  if (h->calls == 2) {
    /* A whole clump inside a clump, with this callback and threads of its own. */
    morula_clump_options options;
    OK(morula_clump_options_init(&options, sizeof options));
    options.spheres = 3;
    options.threads = 2;
    options.effort = MORULA_EFFORT_DRAFT;
    options.progress = progress;
    options.user = h;
    morula_clump *clump = NULL;
    OK(morula_clump_from_solid(h->solid, &options, &clump));
    morula_clump_free(clump);
  }
  h->depth--;
  return 0;
}

static void sink(int32_t level, const char *text, void *user) {
  const host *h = user;
  size_t n = 0;
  CHECK(level >= MORULA_LOG_INFO && text[0] != '\0');
  OK(morula_shape_note_count(h->shape, &n));
  lines++;
}

static morula_clump *clump_of(const morula_solid *solid, host *h) {
  morula_clump_options options;
  OK(morula_clump_options_init(&options, sizeof options));
  options.spheres = 10;
  if (h) {
    options.progress = progress;
    options.user = h;
  }
  morula_clump *clump = NULL;
  OK(morula_clump_from_solid(solid, &options, &clump));
  return clump;
}

int main(void) {
  morula_shape *shape = l_shape();
  morula_solid *solid = NULL;
  OK(morula_solid_from_shape(shape, NULL, &solid));
  host h = {shape, solid, 0, 0};
  morula_clump *plain = clump_of(solid, NULL);
  OK(morula_set_log(sink, &h));
  morula_clump *disturbed = clump_of(solid, &h);
  CHECK(h.calls > 2 && h.depth == 0 && lines > 0);

  /* A failure after the callback was heard has the outer call's sentence. */
  h.calls = 0;
  morula_clump_options options;
  OK(morula_clump_options_init(&options, sizeof options));
  options.progress = progress;
  options.user = &h;
  options.min_radius = -1;
  morula_clump *none = NULL;
  STATUS(morula_clump_from_solid(solid, &options, &none), MORULA_STATUS_INVALID_ARGUMENT);
  CHECK(none == NULL && strstr(morula_last_error_message(), "radius") != NULL);
  OK(morula_set_log(NULL, NULL));

  /* What the callback did has changed nothing. */
  size_t n = 0, k = 0;
  double a[10][4] = {{0}}, b[10][4] = {{0}};
  OK(morula_clump_sphere_count(plain, &n));
  OK(morula_clump_sphere_count(disturbed, &k));
  CHECK(n == k && n > 0 && n <= 10);
  OK(morula_clump_copy_spheres(plain, 10, a[0]));
  OK(morula_clump_copy_spheres(disturbed, 10, b[0]));
  CHECK(memcmp(a, b, sizeof a) == 0);
  morula_clump_free(plain);
  morula_clump_free(disturbed);
  morula_solid_free(solid);
  morula_shape_free(shape);
  return checks_done();
}
