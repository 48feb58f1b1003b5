/* Levels of detail, and clumps of many shapes and labels in one call. */
#include "check.h"
#include <stdlib.h>

/* The spheres of a clump, which the caller frees. */
static double *spheres_of(const morula_clump *clump, size_t *n) {
  OK(morula_clump_sphere_count(clump, n));
  double *xyzr = malloc((*n + 1) * 4 * sizeof *xyzr);
  OK(morula_clump_copy_spheres(clump, *n, xyzr));
  return xyzr;
}

static void same(const morula_clump *a, const morula_clump *b) {
  size_t n = 0, m = 0;
  double *x = spheres_of(a, &n), *y = spheres_of(b, &m);
  CHECK(n == m && n > 0 && memcmp(x, y, 4 * n * sizeof *x) == 0);
  free(x);
  free(y);
}

static void free_all(morula_clump **clumps, size_t n) {
  for (size_t i = 0; i < n; i++) morula_clump_free(clumps[i]);
}

int main(void) {
  static const char *names[4] = {"torus", "box", "stone", "sphere"};
  morula_shape *shapes[4];
  morula_clump_options options;
  OK(morula_clump_options_init(&options, sizeof options));
  options.method = MORULA_METHOD_BEST;
  options.effort = MORULA_EFFORT_DRAFT;
  options.spheres = 9;
  for (int i = 0; i < 4; i++)
    OK(morula_shape_from_primitive(names[i], NULL, NULL, 0, 0, 0, NULL, &shapes[i]));

  /* Levels. */
  morula_solid *solid = NULL;
  OK(morula_solid_from_shape(shapes[0], NULL, &solid));
  const uint64_t counts[3] = {20, 9, 2};
  morula_clump *levels[3] = {NULL, NULL, NULL};
  OK(morula_clumps_from_solid(solid, &options, counts, 3, levels));
  for (int i = 0; i < 3; i++) {
    size_t n = 0;
    OK(morula_clump_sphere_count(levels[i], &n));
    CHECK(n == counts[i]);
  }
  morula_clump *one = NULL;
  OK(morula_clump_from_solid(solid, &options, &one));
  same(one, levels[1]);
  morula_clump_free(one);
  free_all(levels, 3);
  const uint64_t bad[2] = {5, 99999999};
  levels[0] = NULL;
  STATUS(morula_clumps_from_solid(solid, &options, bad, 2, levels),
         MORULA_STATUS_INVALID_ARGUMENT);
  CHECK(levels[0] == NULL && strncmp(morula_last_error_message(), "level 1: ", 9) == 0);
  /* More than memory can hold: refused before any is read. */
  STATUS(morula_clumps_from_solid(solid, &options, counts, SIZE_MAX, levels),
         MORULA_STATUS_TOO_LARGE);
  STATUS(morula_clumps_from_solid(solid, &options, NULL, 2, levels), MORULA_STATUS_NULL_POINTER);
  STATUS(morula_clumps_from_solid(solid, &options, bad, 2, NULL), MORULA_STATUS_NULL_POINTER);
  STATUS(morula_clumps_from_solid(NULL, &options, bad, 2, levels), MORULA_STATUS_NULL_POINTER);
  OK(morula_clumps_from_solid(solid, NULL, NULL, 0, NULL));
  morula_solid_free(solid);

  /* Shapes, on one and on more threads. */
  const morula_shape *many[12];
  for (int i = 0; i < 12; i++) many[i] = shapes[i % 4];
  morula_clump *serial[12], *threaded[12];
  int32_t statuses[12];
  OK(morula_clumps_from_shapes(many, 12, NULL, &options, serial, NULL));
  options.threads = 3;
  OK(morula_clumps_from_shapes(many, 12, NULL, &options, threaded, statuses));
  for (int i = 0; i < 12; i++) {
    CHECK(statuses[i] == MORULA_STATUS_OK);
    same(serial[i], threaded[i]);
  }
  free_all(serial, 12);
  free_all(threaded, 12);
  many[5] = NULL;
  STATUS(morula_clumps_from_shapes(many, 12, NULL, &options, serial, statuses),
         MORULA_STATUS_NULL_POINTER);
  CHECK(strstr(morula_last_error_message(), "shape 5") != NULL);
  STATUS(morula_clumps_from_shapes(many, SIZE_MAX, NULL, &options, serial, NULL),
         MORULA_STATUS_TOO_LARGE);

  /* Labels: 3 is not there, the others are made all the same. */
  uint32_t labels[7 * 3 * 3];
  const size_t dims[3] = {7, 3, 3};
  for (size_t i = 0; i < sizeof labels / sizeof *labels; i++) labels[i] = i % 7 < 4 ? 8 : 2;
  const uint32_t wanted[3] = {2, 3, 8};
  morula_clump *parts[3];
  STATUS(morula_clumps_from_labels(labels, dims, NULL, NULL, wanted, 3, NULL, NULL, &options,
                                   parts, statuses),
         MORULA_STATUS_INDEX_OUT_OF_RANGE);
  CHECK(statuses[0] == MORULA_STATUS_OK && statuses[1] == MORULA_STATUS_INDEX_OUT_OF_RANGE &&
        statuses[2] == MORULA_STATUS_OK && parts[1] == NULL);
  const double volumes[3] = {27, 0, 36};
  for (int i = 0; i < 3; i += 2) {
    morula_moments m = {0};
    m.struct_size = sizeof m;
    OK(morula_clump_moments(parts[i], 1.0, &m));
    NEAR(m.volume, volumes[i], 1e-12);
  }
  free_all(parts, 3);
  STATUS(morula_clumps_from_labels(labels, dims, NULL, NULL, wanted, SIZE_MAX, NULL, NULL,
                                   &options, parts, NULL),
         MORULA_STATUS_TOO_LARGE);
  for (int i = 0; i < 4; i++) morula_shape_free(shapes[i]);
  return checks_done();
}
