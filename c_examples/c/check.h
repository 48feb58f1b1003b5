/* What the test programs share: counting checks, floating-point traps, and a body without symmetry. */
#ifndef CHECK_H
#define CHECK_H

#ifndef _GNU_SOURCE
#define _GNU_SOURCE /* feenableexcept */
#endif

#include <fenv.h>
#include <math.h>
#include <morula.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

static int checks_made, checks_failed;

#ifdef __GLIBC__
/* As many solvers run: an invalid operation, a division by zero or an overflow ends the program. */
__attribute__((constructor)) static void set_traps(void) {
  feenableexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW);
}
#endif

#define CHECK(condition)                                                      \
  do {                                                                        \
    checks_made++;                                                            \
    if (!(condition)) {                                                       \
      checks_failed++;                                                        \
      fprintf(stderr, "%s:%d: not so: %s (last message: \"%s\")\n", __FILE__, \
              __LINE__, #condition, morula_last_error_message());             \
    }                                                                         \
  } while (0)

/* The status, and a sentence exactly when it is not OK. */
#define STATUS(call, expected)                                                              \
  do {                                                                                      \
    int32_t status_ = (call);                                                               \
    checks_made++;                                                                          \
    if (status_ != (expected) ||                                                            \
        (status_ == MORULA_STATUS_OK) != (morula_last_error_message()[0] == '\0')) {        \
      checks_failed++;                                                                      \
      fprintf(stderr, "%s:%d: %s gave %s, not %s (\"%s\")\n", __FILE__, __LINE__, #call,    \
              morula_status_name(status_), #expected, morula_last_error_message());         \
    }                                                                                       \
  } while (0)
#define OK(call) STATUS(call, MORULA_STATUS_OK)

#define NEAR(a, b, tolerance) CHECK(fabs((a) - (b)) <= (tolerance))

static inline int checks_done(void) {
  printf("%d checks, %d failed\n", checks_made, checks_failed);
  return checks_failed != 0;
}

/* An L of three unit cubes in a row along x and one on the first, along y,
 * one layer thick, moved by (10, 20, 30): nothing about it is symmetric but z. */
static const double L_CORNERS[6][2] = {{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 2}, {0, 2}};

static void l_mesh(double vertices[36], uint32_t triangles[60], uint32_t base) {
  /* The polygon cut into triangles, counter-clockwise seen from above. */
  static const uint32_t cap[4][3] = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}};
  int t = 0;
  for (int i = 0; i < 6; i++)
    for (int layer = 0; layer < 2; layer++) {
      double *v = vertices + 3 * (6 * layer + i);
      v[0] = 10 + L_CORNERS[i][0];
      v[1] = 20 + L_CORNERS[i][1];
      v[2] = 30 + layer;
    }
  for (int i = 0; i < 4; i++, t += 2) {
    uint32_t *bottom = triangles + 3 * t, *top = bottom + 3;
    for (int k = 0; k < 3; k++) {
      bottom[k] = base + cap[i][2 - k];
      top[k] = base + 6 + cap[i][k];
    }
  }
  for (uint32_t i = 0; i < 6; i++, t += 2) {
    uint32_t j = (i + 1) % 6, *f = triangles + 3 * t;
    f[0] = base + i, f[1] = base + j, f[2] = base + 6 + j;
    f[3] = base + i, f[4] = base + 6 + j, f[5] = base + 6 + i;
  }
}

static inline morula_shape *l_shape(void) {
  double vertices[36];
  uint32_t triangles[60];
  morula_shape *shape = NULL;
  l_mesh(vertices, triangles, 0);
  OK(morula_shape_from_mesh(vertices, 12, triangles, 20, NULL, &shape));
  return shape;
}

/* Its moments by hand at density 2: three cubes and one. */
#define L_MASS 8.0
static const double L_CENTRE[3] = {10 + (0.5 + 1.5 + 2.5 + 0.5) / 4,
                                   20 + (0.5 + 0.5 + 0.5 + 1.5) / 4, 30.5};

static inline void l_inertia(double inertia[6]) {
  static const double cubes[4][2] = {{0.5, 0.5}, {1.5, 0.5}, {2.5, 0.5}, {0.5, 1.5}};
  memset(inertia, 0, 6 * sizeof *inertia);
  for (int i = 0; i < 4; i++) {
    double x = 10 + cubes[i][0] - L_CENTRE[0], y = 20 + cubes[i][1] - L_CENTRE[1], m = 2;
    inertia[0] += m * (1.0 / 6 + y * y);
    inertia[1] += m * (1.0 / 6 + x * x);
    inertia[2] += m * (1.0 / 6 + x * x + y * y);
    inertia[3] -= m * x * y;
  }
}

#endif
