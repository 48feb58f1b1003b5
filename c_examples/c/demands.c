/* What clumps of the method best must keep to. */
#include "check.h"
#include <stdlib.h>

enum { N = 20 };

int main(void) {
  morula_shape *shape = NULL;
  morula_solid *solid = NULL;
  morula_clump *clump = NULL;
  morula_clump_options options;
  double xyzr[4 * N];
  size_t n = 0;
  OK(morula_shape_from_primitive("stone", NULL, NULL, 0, 0, 0, NULL, &shape));
  OK(morula_solid_from_shape(shape, NULL, &solid));
  OK(morula_clump_options_init(&options, sizeof options));
  options.method = MORULA_METHOD_BEST;
  options.spheres = N;

  /* Half-spaces, normals of any length; a greatest radius beside them. */
  const double half_spaces[2][4] = {{0, 0, 2, 0.3}, {-3, 4, 0, 1.5}};
  options.half_spaces = &half_spaces[0][0];
  options.half_space_count = 2;
  options.max_radius = 0.25;
  OK(morula_clump_from_solid(solid, &options, &clump));
  OK(morula_clump_sphere_count(clump, &n));
  CHECK(n == N);
  OK(morula_clump_copy_spheres(clump, N, xyzr));
  morula_clump_free(clump);
  clump = NULL;
  double top = -1;
  for (int i = 0; i < N; i++) {
    const double *s = xyzr + 4 * i;
    CHECK(s[2] + s[3] <= 0.15 * (1 + 1e-12));
    CHECK((-3 * s[0] + 4 * s[1]) / 5 + s[3] <= 0.3 * (1 + 1e-12));
    CHECK(s[3] > 0 && s[3] <= 0.25);
    top = fmax(top, s[2] + s[3]);
  }
  /* The plane is reached, as the stone goes on beyond it. */
  CHECK(top > 0.14);

  /* None of the stone is left. */
  const double nothing[4] = {0, 0, 1, -9};
  options.half_spaces = nothing;
  options.half_space_count = 1;
  STATUS(morula_clump_from_solid(solid, &options, &clump), MORULA_STATUS_ZERO_VOLUME);
  CHECK(clump == NULL && strstr(morula_last_error_message(), "half-spaces") != NULL);
  options.half_spaces = NULL;
  STATUS(morula_clump_from_solid(solid, &options, &clump), MORULA_STATUS_NULL_POINTER);

  /* The volume of the stone; less reaches beyond it where that counts more. */
  options.half_space_count = 0;
  options.max_radius = 0;
  options.equal_volume = 1;
  options.wants = MORULA_WANT_OVERLAP;
  morula_overlap overlap = {0};
  morula_surface surface = {0};
  overlap.struct_size = sizeof overlap;
  surface.struct_size = sizeof surface;
  OK(morula_clump_from_solid(solid, &options, &clump));
  OK(morula_clump_overlap(clump, &overlap));
  NEAR(overlap.volume_error, 0, 2e-4);
  const double overshoot = overlap.overshoot;
  morula_clump_free(clump);
  options.equal_volume = 0;
  options.overshoot_weight = 5;
  OK(morula_clump_from_solid(solid, &options, &clump));
  OK(morula_clump_overlap(clump, &overlap));
  CHECK(overlap.overshoot < 0.5 * overshoot);
  morula_clump_free(clump);

  /* No sphere reaches farther out than allowed. */
  options.overshoot_weight = 1;
  options.max_protrusion = 0.01;
  options.wants = MORULA_WANT_OVERLAP | MORULA_WANT_SURFACE;
  OK(morula_clump_from_solid(solid, &options, &clump));
  OK(morula_clump_overlap(clump, &overlap));
  OK(morula_clump_surface(clump, &surface));
  CHECK(surface.protrusion <= 0.01 * (1 + 1e-9) && overlap.coverage > 0.7);
  morula_clump_free(clump);

  morula_solid_free(solid);
  morula_shape_free(shape);
  return checks_done();
}
