/* Limits that a clump meets are told with their figures, and how far it is from being its own image. */
#include "check.h"

static morula_clump *made(const double vertices[36], const uint32_t triangles[60], uint64_t spheres) {
  morula_shape *shape = NULL;
  morula_clump *clump = NULL;
  morula_clump_options options;
  OK(morula_shape_from_mesh(vertices, 12, triangles, 20, NULL, &shape));
  OK(morula_clump_options_init(&options, sizeof options));
  options.spheres = spheres;
  options.wants = MORULA_WANT_SURFACE;
  options.effort = MORULA_EFFORT_DRAFT;
  OK(morula_clump_from_shape(shape, NULL, &options, &clump));
  morula_shape_free(shape);
  return clump;
}

int main(void) {
  double vertices[36], figures[8], bounds[8];
  uint32_t triangles[60];
  int32_t codes[8];
  size_t n = 77, length = 0;
  char text[400];
  l_mesh(vertices, triangles, 0);

  /* Nothing to say; the L is its own image in one plane. */
  morula_clump *clump = made(vertices, triangles, 12);
  OK(morula_clump_warning_count(clump, &n));
  CHECK(n == 0);
  OK(morula_clump_copy_warnings(clump, 0, NULL, NULL, NULL));
  STATUS(morula_clump_copy_warning(clump, 0, sizeof text, text, NULL),
         MORULA_STATUS_INDEX_OUT_OF_RANGE);
  morula_surface surface = {0};
  surface.struct_size = sizeof surface;
  OK(morula_clump_surface(clump, &surface));
  CHECK(surface.symmetry_planes == 1 && surface.asymmetry >= 0 && surface.asymmetry < 1);
  morula_clump_free(clump);

  /* A thousand million sizes away places are rounded. */
  for (int i = 0; i < 12; i++) vertices[3 * i] += 4e9;
  clump = made(vertices, triangles, 12);
  OK(morula_clump_warning_count(clump, &n));
  CHECK(n == 1);
  STATUS(morula_clump_copy_warnings(clump, 0, codes, figures, bounds), MORULA_STATUS_BUFFER_TOO_SMALL);
  STATUS(morula_clump_copy_warnings(clump, 8, codes, NULL, bounds), MORULA_STATUS_NULL_POINTER);
  OK(morula_clump_copy_warnings(clump, 8, codes, figures, bounds));
  CHECK(codes[0] == MORULA_WARNING_FAR_AWAY && figures[0] > bounds[0] && figures[0] < 1e-6);
  OK(morula_clump_copy_warning(clump, 0, 0, NULL, &length));
  OK(morula_clump_copy_warning(clump, 0, sizeof text, text, NULL));
  CHECK(strlen(text) == length && length > 20);
  CHECK(strcmp(morula_warning_name(codes[0]), "far away") == 0);
  CHECK(strcmp(morula_warning_name(0), "unknown") == 0);

  /* They go with the clump. */
  static uint8_t bytes[1 << 16];
  size_t size = 0;
  morula_clump *again = NULL;
  OK(morula_clump_serialize(clump, sizeof bytes, bytes, &size));
  OK(morula_clump_deserialize(bytes, size, &again));
  double same[8];
  OK(morula_clump_copy_warnings(again, 8, codes, same, bounds));
  CHECK(same[0] == figures[0]);
  morula_clump_free(again);
  morula_clump_free(clump);
  STATUS(morula_clump_warning_count(NULL, &n), MORULA_STATUS_NULL_POINTER);
  return checks_done();
}
