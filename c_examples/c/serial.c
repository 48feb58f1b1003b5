/* Hands a shape and a clump on as bytes, as to another rank or a restart file. */
#include "check.h"
#include <stdlib.h>

static uint8_t *shape_bytes(const morula_shape *shape, size_t *size) {
  uint8_t *bytes = NULL;
  OK(morula_shape_serialize(shape, 0, NULL, size));
  bytes = malloc(*size);
  if (bytes == NULL) abort();
  OK(morula_shape_serialize(shape, *size, bytes, NULL));
  return bytes;
}

static uint8_t *clump_bytes(const morula_clump *clump, size_t *size) {
  uint8_t *bytes = NULL;
  OK(morula_clump_serialize(clump, 0, NULL, size));
  bytes = malloc(*size);
  if (bytes == NULL) abort();
  OK(morula_clump_serialize(clump, *size, bytes, size));
  return bytes;
}

int main(void) {
  morula_shape *shape = l_shape(), *there = NULL;
  morula_clump *clump = NULL, *again = NULL;
  size_t size = 0, same = 0, n = 0;
  double xyzr[2][9][4];
  morula_clump_options options;
  OK(morula_clump_options_init(&options, sizeof options));
  options.effort = MORULA_EFFORT_DRAFT;
  options.spheres = 9;
  options.frame = MORULA_FRAME_BODY;
  options.wants = MORULA_WANT_OVERLAP | MORULA_WANT_MOMENTS;

  /* A shape: what is made of it there is what is made of it here. */
  uint8_t *bytes = shape_bytes(shape, &size);
  OK(morula_shape_deserialize(bytes, size, &there));
  uint8_t *copy = shape_bytes(there, &same);
  CHECK(same == size && memcmp(bytes, copy, size) == 0);
  OK(morula_clump_from_shape(shape, NULL, &options, &clump));
  OK(morula_clump_from_shape(there, NULL, &options, &again));
  OK(morula_clump_copy_spheres(clump, 9, xyzr[0][0]));
  OK(morula_clump_copy_spheres(again, 9, xyzr[1][0]));
  CHECK(memcmp(xyzr[0], xyzr[1], sizeof xyzr[0]) == 0);
  morula_clump_free(again);
  free(copy);

  /* What has happened on the way is told. */
  morula_shape *none = NULL;
  STATUS(morula_shape_deserialize(bytes, size - 1, &none), MORULA_STATUS_FORMAT);
  STATUS(morula_shape_deserialize(bytes, 3, &none), MORULA_STATUS_FORMAT);
  STATUS(morula_shape_deserialize(NULL, size, &none), MORULA_STATUS_NULL_POINTER);
  STATUS(morula_shape_deserialize(NULL, 0, &none), MORULA_STATUS_FORMAT);
  STATUS(morula_shape_serialize(shape, 7, bytes, &n), MORULA_STATUS_BUFFER_TOO_SMALL);
  STATUS(morula_shape_serialize(shape, 0, NULL, NULL), MORULA_STATUS_BUFFER_TOO_SMALL);
  STATUS(morula_shape_serialize(NULL, 0, NULL, &n), MORULA_STATUS_NULL_POINTER);
  CHECK(n == 0);
  bytes[size / 2] ^= 1;
  STATUS(morula_shape_deserialize(bytes, size, &none), MORULA_STATUS_FORMAT);
  CHECK(strstr(morula_last_error_message(), "checksum") != NULL);
  bytes[8] = 77;
  STATUS(morula_shape_deserialize(bytes, size, &none), MORULA_STATUS_UNSUPPORTED);
  CHECK(none == NULL);
  free(bytes);

  /* A clump, with what was measured. */
  bytes = clump_bytes(clump, &size);
  STATUS(morula_shape_deserialize(bytes, size, &none), MORULA_STATUS_FORMAT);
  OK(morula_clump_deserialize(bytes, size, &again));
  OK(morula_clump_sphere_count(again, &n));
  CHECK(n == 9);
  OK(morula_clump_copy_spheres(again, 9, xyzr[1][0]));
  CHECK(memcmp(xyzr[0], xyzr[1], sizeof xyzr[0]) == 0);
  morula_overlap o[2];
  morula_moments m[2];
  const morula_clump *both[2] = {clump, again};
  for (int i = 0; i < 2; i++) {
    o[i].struct_size = sizeof o[i];
    m[i].struct_size = sizeof m[i];
    OK(morula_clump_overlap(both[i], &o[i]));
    OK(morula_clump_moments(both[i], 2.0, &m[i]));
  }
  CHECK(o[0].mismatch > 0 && memcmp(&o[0], &o[1], sizeof o[0]) == 0);
  CHECK(m[0].mass > 0 && memcmp(&m[0], &m[1], sizeof m[0]) == 0);
  morula_clump_free(clump);
  clump = NULL;
  bytes[size - 1] ^= 255;
  STATUS(morula_clump_deserialize(bytes, size, &clump), MORULA_STATUS_FORMAT);
  CHECK(clump == NULL);
  free(bytes);
  morula_clump_free(again);
  morula_shape_free(there);
  morula_shape_free(shape);
  return checks_done();
}
