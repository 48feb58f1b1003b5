/* A particle as 30 spheres, in ten lines. */
#include <morula.h>
#include <stdio.h>

int main(void) {
  morula_shape *shape = NULL;
  morula_clump *clump = NULL;
  double xyzr[30][4];
  size_t n = 0;
  morula_clump_options options;
  morula_clump_options_init(&options, sizeof options);
  options.spheres = 30;
  if (morula_shape_from_primitive("tablet", NULL, NULL, 0, 0, 0, NULL, &shape) ||
      morula_clump_from_shape(shape, NULL, &options, &clump) ||
      morula_clump_sphere_count(clump, &n) || morula_clump_copy_spheres(clump, 30, xyzr[0])) {
    fprintf(stderr, "%s\n", morula_last_error_message());
    return 1;
  }
  for (size_t i = 0; i < n; i++)
    printf("%g %g %g %g\n", xyzr[i][0], xyzr[i][1], xyzr[i][2], xyzr[i][3]);
  morula_clump_free(clump);
  morula_shape_free(shape);
  return 0;
}
