/* A particle as 30 spheres, in a few lines. */
#include <morula.h>
#include <stdio.h>

int main(void) {
  morula_shape *shape = NULL;
  morula_clump *clump = NULL;
  double xyzr[30][4];
  size_t n = 0;
  morula_clump_options options;
  if (morula_clump_options_init(&options, sizeof options)) return 1;
  options.spheres = 30;
  options.wants = MORULA_WANT_OVERLAP;
  morula_overlap overlap = {0};
  overlap.struct_size = sizeof overlap;
  if (morula_shape_from_primitive("tablet", NULL, NULL, 0, 0, 0, NULL, &shape) ||
      morula_clump_from_shape(shape, NULL, &options, &clump) ||
      morula_clump_sphere_count(clump, &n) || morula_clump_copy_spheres(clump, 30, xyzr[0]) ||
      morula_clump_overlap(clump, &overlap)) {
    fprintf(stderr, "%s\n", morula_last_error_message());
    return 1;
  }
  for (size_t i = 0; i < n; i++)
    printf("%g %g %g %g\n", xyzr[i][0], xyzr[i][1], xyzr[i][2], xyzr[i][3]);
  printf("%d spheres, D = %g\n", (int)n, overlap.mismatch);
  morula_clump_free(clump);
  morula_shape_free(shape);
  return n == 30 && overlap.mismatch < 0.04 ? 0 : 2; /* as a test it fails on a worse clump */
}
