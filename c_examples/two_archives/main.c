/* Two Rust archives in one program: neither stands in the other's way. */
#include <morula.h>

#include <stdint.h>
#include <stdio.h>

uint64_t other_sum_of_squares(uint32_t n);

int main(void) {
  if (other_sum_of_squares(1000) != 332833500) return 1;
  morula_shape *shape = NULL;
  morula_clump *clump = NULL;
  size_t n = 0;
  morula_clump_options options;
  if (morula_clump_options_init(&options, sizeof options)) return 1;
  options.threads = 2;
  if (morula_shape_from_primitive("tablet", NULL, NULL, 0, 24, 0, NULL, &shape) ||
      morula_clump_from_shape(shape, NULL, &options, &clump) ||
      morula_clump_sphere_count(clump, &n)) {
    fprintf(stderr, "%s\n", morula_last_error_message());
    return 1;
  }
  morula_clump_free(clump);
  morula_shape_free(shape);
  printf("%zu spheres\n", n);
  return n != 50 || other_sum_of_squares(3) != 5;
}
