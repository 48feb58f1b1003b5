/* NULL, wrong sizes, numbers that are none: each its status and a sentence, and
 * the output is untouched. */
#include "check.h"

static double vertices[36];
static uint32_t triangles[60];
static morula_shape *const UNTOUCHED = (morula_shape *)&checks_made;

static void mesh(size_t nv, size_t nt, int32_t expected, const char *word) {
  morula_shape *shape = UNTOUCHED;
  STATUS(morula_shape_from_mesh(vertices, nv, triangles, nt, NULL, &shape), expected);
  CHECK(shape == UNTOUCHED);
  CHECK(strstr(morula_last_error_message(), word) != NULL);
  l_mesh(vertices, triangles, 0);
}

static void meshes(void) {
  morula_shape *shape = UNTOUCHED;
  STATUS(morula_shape_from_mesh(NULL, 12, triangles, 20, NULL, &shape), MORULA_STATUS_NULL_POINTER);
  STATUS(morula_shape_from_mesh(vertices, 12, NULL, 20, NULL, &shape), MORULA_STATUS_NULL_POINTER);
  STATUS(morula_shape_from_mesh(vertices, 12, triangles, 20, NULL, NULL), MORULA_STATUS_NULL_POINTER);
  STATUS(morula_shape_from_mesh(NULL, 0, NULL, 0, NULL, &shape), MORULA_STATUS_EMPTY);
  mesh(SIZE_MAX / 24 + 1, 20, MORULA_STATUS_TOO_LARGE, "vertices");
  mesh(SIZE_MAX, 20, MORULA_STATUS_TOO_LARGE, "vertices");
  mesh(12, SIZE_MAX / 12 + 1, MORULA_STATUS_TOO_LARGE, "triangles");
  mesh(12, 0, MORULA_STATUS_EMPTY, "");
  vertices[3 * 5 + 1] = NAN;
  mesh(12, 20, MORULA_STATUS_NOT_FINITE, "vertex 5 has y");
  vertices[3 * 7 + 2] = -INFINITY;
  mesh(12, 20, MORULA_STATUS_NOT_FINITE, "vertex 7 has z");
  triangles[3 * 4 + 2] = 12;
  mesh(12, 20, MORULA_STATUS_INDEX_OUT_OF_RANGE, "12");
  for (int i = 0; i < 12; i++) vertices[3 * i + 2] = 0; /* flat */
  mesh(12, 20, MORULA_STATUS_ZERO_VOLUME, "");
  for (int i = 0; i < 36; i++) vertices[i] = 4; /* a point */
  mesh(12, 20, MORULA_STATUS_ZERO_VOLUME, "");
  mesh(12, 1, MORULA_STATUS_ZERO_VOLUME, ""); /* a single triangle */
  mesh(12, 4, MORULA_STATUS_OPEN_SURFACE, ""); /* two sheets */

  /* Counted from 1, the message counts from 1 as well. */
  morula_import_options import;
  OK(morula_import_options_init(&import, sizeof import));
  import.index_base = 1;
  STATUS(morula_shape_from_mesh(vertices, 12, triangles, 20, &import, &shape),
         MORULA_STATUS_INDEX_OUT_OF_RANGE);
  CHECK(strstr(morula_last_error_message(), "vertex 0") != NULL);
  CHECK(shape == UNTOUCHED);
}

static void import_options(void) {
  morula_shape *shape = UNTOUCHED;
  for (int i = 0; i < 9; i++) {
    morula_import_options o;
    OK(morula_import_options_init(&o, sizeof o));
    switch (i) {
      case 0: o.bodies = 3; break;
      case 1: o.index_base = 2; break;
      case 2: o.threads = -1; break;
      case 3: o.threads = 100000; break;
      case 4: o.reserved = 1; break;
      case 5: o.weld_tolerance = NAN; break;
      case 6: o.weld_tolerance = -1; break;
      case 7: o.length_unit = 0; break;
      case 8: o.length_unit = INFINITY; break;
    }
    STATUS(morula_shape_from_mesh(vertices, 12, triangles, 20, &o, &shape),
           MORULA_STATUS_INVALID_ARGUMENT);
  }
  CHECK(shape == UNTOUCHED);
}

static void voxels(void) {
  morula_shape *shape = UNTOUCHED;
  uint8_t mask[8] = {0};
  const uint16_t u16[2] = {0, 9};
  const float f32[2] = {0, NAN};
  const uint32_t labels[2] = {0, 7};
  const size_t dims[3] = {2, 2, 2}, two[3] = {2, 1, 1}, none[3] = {2, 0, 2};
  const size_t huge[3] = {SIZE_MAX / 2, 3, 1}, wide[3] = {SIZE_MAX / 2, 1, 1};
  const double zero[3] = {1, 0, 1}, nan[3] = {0, 0, NAN};
  size_t count = 77;
  STATUS(morula_shape_from_mask(NULL, dims, NULL, NULL, NULL, &shape), MORULA_STATUS_NULL_POINTER);
  STATUS(morula_shape_from_mask(mask, NULL, NULL, NULL, NULL, &shape), MORULA_STATUS_NULL_POINTER);
  STATUS(morula_shape_from_mask(mask, dims, NULL, NULL, NULL, NULL), MORULA_STATUS_NULL_POINTER);
  STATUS(morula_shape_from_mask(mask, dims, NULL, NULL, NULL, &shape), MORULA_STATUS_EMPTY);
  STATUS(morula_shape_from_mask(mask, none, NULL, NULL, NULL, &shape), MORULA_STATUS_EMPTY);
  STATUS(morula_shape_from_mask(mask, huge, NULL, NULL, NULL, &shape), MORULA_STATUS_TOO_LARGE);
  STATUS(morula_shape_from_grey_u16(u16, wide, NULL, NULL, NULL, NULL, &shape), MORULA_STATUS_TOO_LARGE);
  STATUS(morula_shape_from_mask(mask, dims, zero, NULL, NULL, &shape), MORULA_STATUS_INVALID_ARGUMENT);
  STATUS(morula_shape_from_mask(mask, dims, NULL, nan, NULL, &shape), MORULA_STATUS_NOT_FINITE);
  {
    size_t two[2] = {2, 2}, wide[2] = {SIZE_MAX, 2};
    double cameras[24] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 1};
    uint8_t seen[8] = {1, 1, 1, 1, 1, 1, 1, 1};
    STATUS(morula_shape_from_silhouettes(2, NULL, two, two, cameras, 8, 0, NULL, &shape), MORULA_STATUS_NULL_POINTER);
    STATUS(morula_shape_from_silhouettes(2, seen, NULL, two, cameras, 8, 0, NULL, &shape), MORULA_STATUS_NULL_POINTER);
    STATUS(morula_shape_from_silhouettes(2, seen, two, NULL, cameras, 8, 0, NULL, &shape), MORULA_STATUS_NULL_POINTER);
    STATUS(morula_shape_from_silhouettes(2, seen, two, two, NULL, 8, 0, NULL, &shape), MORULA_STATUS_NULL_POINTER);
    STATUS(morula_shape_from_silhouettes(2, seen, two, two, cameras, 8, 0, NULL, NULL), MORULA_STATUS_NULL_POINTER);
    STATUS(morula_shape_from_silhouettes(2, seen, wide, two, cameras, 8, 0, NULL, &shape), MORULA_STATUS_TOO_LARGE);
    STATUS(morula_shape_from_silhouettes(2, seen, two, two, cameras, 8, 7, NULL, &shape), MORULA_STATUS_INVALID_ARGUMENT);
    STATUS(morula_shape_from_silhouettes(2, seen, two, two, cameras, 3, 0, NULL, &shape), MORULA_STATUS_INVALID_ARGUMENT);
    STATUS(morula_shape_from_silhouettes(0, NULL, NULL, NULL, NULL, 8, 0, NULL, &shape), MORULA_STATUS_INVALID_ARGUMENT);
    /* Both look along one axis. */
    STATUS(morula_shape_from_silhouettes(2, seen, two, two, cameras, 8, 0, NULL, &shape), MORULA_STATUS_INVALID_ARGUMENT);
    STATUS(morula_shape_from_silhouettes(2, mask, two, two, cameras, 8, 0, NULL, &shape), MORULA_STATUS_EMPTY);
    cameras[17] = NAN;
    STATUS(morula_shape_from_silhouettes(2, seen, two, two, cameras, 8, 0, NULL, &shape), MORULA_STATUS_NOT_FINITE);
  }
  STATUS(morula_shape_from_grey_u8(mask, dims, NULL, NULL, &nan[2], NULL, &shape), MORULA_STATUS_NOT_FINITE);
  STATUS(morula_shape_from_grey_f32(f32, two, NULL, NULL, NULL, NULL, &shape), MORULA_STATUS_NOT_FINITE);
  STATUS(morula_shape_from_grey_f32(NULL, two, NULL, NULL, NULL, NULL, &shape), MORULA_STATUS_NULL_POINTER);
  STATUS(morula_shape_from_label(labels, two, NULL, NULL, 8, NULL, &shape), MORULA_STATUS_INDEX_OUT_OF_RANGE);
  STATUS(morula_shape_from_label(labels, two, NULL, NULL, 0, NULL, &shape), MORULA_STATUS_INVALID_ARGUMENT);
  STATUS(morula_labels_count(labels, two, NULL), MORULA_STATUS_NULL_POINTER);
  STATUS(morula_labels_count(NULL, two, &count), MORULA_STATUS_NULL_POINTER);
  uint32_t ids[1] = {5};
  STATUS(morula_labels_copy(labels, two, 0, ids, NULL, NULL, NULL), MORULA_STATUS_BUFFER_TOO_SMALL);
  CHECK(shape == UNTOUCHED && count == 77 && ids[0] == 5);
  mask[0] = mask[7] = 1;
  STATUS(morula_shape_from_mask(mask, dims, NULL, NULL, NULL, &shape), MORULA_STATUS_SEVERAL_BODIES);
  CHECK(shape == UNTOUCHED);
}

static void files(void) {
  morula_shape *shape = UNTOUCHED;
  morula_file_options o;
  STATUS(morula_shape_from_file(NULL, NULL, NULL, &shape), MORULA_STATUS_NULL_POINTER);
  STATUS(morula_shape_from_file("x.stl", NULL, NULL, NULL), MORULA_STATUS_NULL_POINTER);
  STATUS(morula_shape_from_file("there/is/no/such.stl", NULL, NULL, &shape), MORULA_STATUS_IO);
  STATUS(morula_shape_from_file("\xff.stl", NULL, NULL, &shape), MORULA_STATUS_INVALID_ARGUMENT);
  STATUS(morula_shape_from_bytes(NULL, 10, "a.stl", NULL, NULL, &shape), MORULA_STATUS_NULL_POINTER);
  STATUS(morula_shape_from_bytes((const uint8_t *)"OFF\n9 9 9\n", 10, NULL, NULL, NULL, &shape),
         MORULA_STATUS_FORMAT);
  OK(morula_file_options_init(&o, sizeof o));
  o.format = 99;
  STATUS(morula_shape_from_bytes((const uint8_t *)"OFF", 3, NULL, NULL, &o, &shape),
         MORULA_STATUS_INVALID_ARGUMENT);
  CHECK(shape == UNTOUCHED);

  /* Labels: 0, 7 and 9 in three raw bytes. */
  const uint8_t *off = (const uint8_t *)"OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
  const uint8_t raw[3] = {0, 7, 9};
  uint32_t ids[2] = {5, 5};
  size_t n = 77;
  STATUS(morula_labels_from_bytes(raw, 3, NULL, NULL, &o, 2, ids, NULL, NULL, NULL, &n),
         MORULA_STATUS_INVALID_ARGUMENT);
  o.format = MORULA_FORMAT_RAW;
  o.raw_dims[0] = 3;
  o.raw_dims[1] = o.raw_dims[2] = 1;
  STATUS(morula_labels_from_bytes(raw, 3, NULL, NULL, &o, 1, ids, NULL, NULL, NULL, &n),
         MORULA_STATUS_BUFFER_TOO_SMALL);
  STATUS(morula_labels_from_bytes(raw, 3, NULL, NULL, &o, 2, ids, NULL, NULL, NULL, NULL),
         MORULA_STATUS_NULL_POINTER);
  STATUS(morula_labels_from_bytes(NULL, 3, NULL, NULL, &o, 2, ids, NULL, NULL, NULL, &n),
         MORULA_STATUS_NULL_POINTER);
  STATUS(morula_labels_from_bytes(off, strlen((const char *)off), NULL, NULL, NULL, 2, ids, NULL,
                                  NULL, NULL, &n),
         MORULA_STATUS_INVALID_ARGUMENT);
  STATUS(morula_labels_from_file("there/is/no/such.npy", NULL, NULL, 2, ids, NULL, NULL, NULL, &n),
         MORULA_STATUS_IO);
  STATUS(morula_labels_from_file(NULL, NULL, NULL, 2, ids, NULL, NULL, NULL, &n),
         MORULA_STATUS_NULL_POINTER);
  CHECK(n == 77 && ids[0] == 5 && ids[1] == 5);
}

static void primitives(void) {
  morula_shape *shape = UNTOUCHED;
  const char *keys[1] = {"radius"};
  double value = 1;
  size_t n = 77;
  STATUS(morula_shape_from_primitive(NULL, NULL, NULL, 0, 0, 0, NULL, &shape), MORULA_STATUS_NULL_POINTER);
  STATUS(morula_shape_from_primitive("cheese", NULL, NULL, 0, 0, 0, NULL, &shape), MORULA_STATUS_UNSUPPORTED);
  STATUS(morula_shape_from_primitive("sphere", NULL, &value, 1, 0, 0, NULL, &shape), MORULA_STATUS_NULL_POINTER);
  STATUS(morula_shape_from_primitive("sphere", keys, NULL, 1, 0, 0, NULL, &shape), MORULA_STATUS_NULL_POINTER);
  STATUS(morula_shape_from_primitive("box", keys, &value, 1, 0, 0, NULL, &shape), MORULA_STATUS_INVALID_ARGUMENT);
  value = -1;
  STATUS(morula_shape_from_primitive("sphere", keys, &value, 1, 0, 0, NULL, &shape), MORULA_STATUS_INVALID_ARGUMENT);
  value = NAN;
  STATUS(morula_shape_from_primitive("sphere", keys, &value, 1, 0, 0, NULL, &shape), MORULA_STATUS_NOT_FINITE);
  keys[0] = NULL;
  STATUS(morula_shape_from_primitive("sphere", keys, &value, 1, 0, 0, NULL, &shape), MORULA_STATUS_NULL_POINTER);
  CHECK(shape == UNTOUCHED);
  CHECK(morula_primitive_name(1000) == NULL);
  STATUS(morula_primitive_parameter_count("cheese", &n), MORULA_STATUS_UNSUPPORTED);
  STATUS(morula_primitive_copy_parameter("sphere", 99, 0, NULL, &n, NULL), MORULA_STATUS_INDEX_OUT_OF_RANGE);
  CHECK(n == 77);
}

static void handles(void) {
  morula_shape *shape = l_shape();
  morula_solid *solid = NULL;
  morula_clump *clump = NULL, *other = NULL;
  morula_report report = {0};
  morula_moments moments = {0};
  morula_overlap overlap = {0};
  morula_surface surface = {0};
  morula_counters counters = {0};
  size_t n = 77;
  int32_t stopped = 77;
  char text[4];
  double numbers[4] = {5, 5, 5, 5};
  uint32_t contacts[1];
  report.struct_size = sizeof report;
  moments.struct_size = sizeof moments;
  overlap.struct_size = sizeof overlap;
  surface.struct_size = sizeof surface;
  counters.struct_size = sizeof counters;

  STATUS(morula_import_options_init(NULL, 64), MORULA_STATUS_NULL_POINTER);
  STATUS(morula_file_options_init(NULL, 64), MORULA_STATUS_NULL_POINTER);
  STATUS(morula_solid_options_init(NULL, 64), MORULA_STATUS_NULL_POINTER);
  STATUS(morula_clump_options_init(NULL, 64), MORULA_STATUS_NULL_POINTER);

  STATUS(morula_shape_report(NULL, &report), MORULA_STATUS_NULL_POINTER);
  STATUS(morula_shape_report(shape, NULL), MORULA_STATUS_NULL_POINTER);
  STATUS(morula_shape_note_count(NULL, &n), MORULA_STATUS_NULL_POINTER);
  STATUS(morula_shape_note_count(shape, NULL), MORULA_STATUS_NULL_POINTER);
  STATUS(morula_shape_copy_note(NULL, 0, 4, text, &n), MORULA_STATUS_NULL_POINTER);
  STATUS(morula_shape_copy_note(shape, 99, 4, text, &n), MORULA_STATUS_INDEX_OUT_OF_RANGE);
  STATUS(morula_shape_moments(NULL, 1, &moments), MORULA_STATUS_NULL_POINTER);
  STATUS(morula_shape_moments(shape, 1, NULL), MORULA_STATUS_NULL_POINTER);
  STATUS(morula_shape_moments(shape, 0, &moments), MORULA_STATUS_INVALID_ARGUMENT);
  STATUS(morula_shape_moments(shape, NAN, &moments), MORULA_STATUS_INVALID_ARGUMENT);
  CHECK(moments.mass == 0);

  STATUS(morula_solid_from_shape(NULL, NULL, &solid), MORULA_STATUS_NULL_POINTER);
  STATUS(morula_solid_from_shape(shape, NULL, NULL), MORULA_STATUS_NULL_POINTER);
  for (int i = 0; i < 6; i++) {
    morula_solid_options o;
    OK(morula_solid_options_init(&o, sizeof o));
    switch (i) {
      case 0: o.resolution = 9; break;
      case 1: o.cells = 0; break;
      case 2: o.resolution = MORULA_RESOLUTION_CELL_SIZE; break;
      case 3: o.resolution = MORULA_RESOLUTION_CELL_SIZE; o.cell_size = NAN; break;
      case 4: o.padding = 1; break;
      case 5: o.threads = -2; break;
    }
    STATUS(morula_solid_from_shape(shape, &o, &solid), MORULA_STATUS_INVALID_ARGUMENT);
  }
  morula_solid_options limited;
  OK(morula_solid_options_init(&limited, sizeof limited));
  limited.memory_limit = 1000;
  STATUS(morula_solid_from_shape(shape, &limited, &solid), MORULA_STATUS_MEMORY_LIMIT);
  limited.memory_limit = 1 << 20;
  limited.cells = UINT32_MAX;
  CHECK(morula_solid_from_shape(shape, &limited, &solid) != MORULA_STATUS_OK);
  CHECK(solid == NULL);

  OK(morula_solid_from_shape(shape, NULL, &solid));
  STATUS(morula_solid_grid(NULL, NULL, NULL, NULL), MORULA_STATUS_NULL_POINTER);
  STATUS(morula_solid_distance(NULL, 1, numbers, numbers), MORULA_STATUS_NULL_POINTER);
  STATUS(morula_solid_distance(solid, 1, NULL, numbers), MORULA_STATUS_NULL_POINTER);
  STATUS(morula_solid_distance(solid, 1, numbers, NULL), MORULA_STATUS_NULL_POINTER);
  STATUS(morula_solid_distance(solid, SIZE_MAX / 20, numbers, numbers), MORULA_STATUS_TOO_LARGE);
  OK(morula_solid_distance(solid, 0, NULL, NULL));
  const double nan[3] = {0, NAN, 0}, far_away[3] = {0, 0, 1e300};
  STATUS(morula_solid_distance(solid, 1, nan, numbers), MORULA_STATUS_NOT_FINITE);
  STATUS(morula_solid_distance(solid, 1, far_away, numbers), MORULA_STATUS_INVALID_ARGUMENT);
  CHECK(numbers[0] == 5);
  STATUS(morula_solid_note_count(NULL, &n), MORULA_STATUS_NULL_POINTER);
  STATUS(morula_solid_copy_note(NULL, 0, 4, text, &n), MORULA_STATUS_NULL_POINTER);
  STATUS(morula_solid_moments(NULL, 1, &moments), MORULA_STATUS_NULL_POINTER);
  STATUS(morula_solid_moments(solid, -1, &moments), MORULA_STATUS_INVALID_ARGUMENT);

  STATUS(morula_clump_from_shape(NULL, NULL, NULL, &clump), MORULA_STATUS_NULL_POINTER);
  STATUS(morula_clump_from_shape(shape, NULL, NULL, NULL), MORULA_STATUS_NULL_POINTER);
  STATUS(morula_clump_from_solid(NULL, NULL, &clump), MORULA_STATUS_NULL_POINTER);
  STATUS(morula_clump_from_solid(solid, NULL, NULL), MORULA_STATUS_NULL_POINTER);
  const double tolerance[1] = {-1};
  for (int i = 0; i < 14; i++) {
    morula_clump_options o;
    int32_t expected = MORULA_STATUS_INVALID_ARGUMENT;
    OK(morula_clump_options_init(&o, sizeof o));
    switch (i) {
      case 0: o.method = 99; break;
      case 1: o.confine = 2; break;
      case 2: o.frame = 2; break;
      case 3: o.wants = 1u << 31; break;
      case 4: o.deadline_seconds = -1; break;
      case 5: o.deadline_seconds = NAN; break;
      case 6: o.threads = -1; break;
      case 7: o.mismatch = NAN; break;
      case 8: o.min_radius = -1; break;
      case 9: o.method = MORULA_METHOD_MSS; o.min_distance = INFINITY; break;
      case 10: o.method = MORULA_METHOD_MSS; o.radius_offset = NAN; break;
      case 11: o.spheres = 0; break;
      case 12: o.plane_tolerances = tolerance; o.plane_tolerance_count = 1; break;
      case 13: o.plane_tolerance_count = 1; expected = MORULA_STATUS_NULL_POINTER; break;
    }
    STATUS(morula_clump_from_solid(solid, &o, &clump), expected);
  }
  CHECK(clump == NULL);

  /* What clumps of best must keep to. */
  for (int i = 0; i < 12; i++) {
    double planes[8] = {0, 0, 1, 999, 1, 0, 0, 99};
    morula_clump_options o;
    OK(morula_clump_options_init(&o, sizeof o));
    int32_t expected = MORULA_STATUS_INVALID_ARGUMENT;
    o.spheres = 2;
    o.half_spaces = planes;
    o.half_space_count = 2;
    switch (i) {
      case 0: planes[5] = NAN; break;
      case 1: planes[4] = planes[5] = planes[6] = 0; break;
      case 2: planes[7] = INFINITY; break;
      case 3: o.half_spaces = NULL; expected = MORULA_STATUS_NULL_POINTER; break;
      case 4: o.max_radius = NAN; break;
      case 5: o.max_radius = 1e-300; expected = MORULA_STATUS_NO_SPHERES; break;
      case 6: o.overshoot_weight = 0; break;
      case 7: o.overshoot_weight = 1e39; break;
      case 8: o.max_protrusion = -1; break;
      case 9: o.connected = 2; break;
      case 10: o.symmetry = 7; break;
      case 11: o.symmetry_plane_count = 1; break;
    }
    STATUS(morula_clump_from_solid(solid, &o, &clump), expected);
  }
  CHECK(clump == NULL);

  /* Spheres far larger than the shape: whatever cannot be measured of them, it is their fault. */
  const double offsets[4] = {1e3, 1e9, 1e100, 1e300};
  const uint32_t wants[3] = {MORULA_WANT_NOTHING, MORULA_WANT_OVERLAP, MORULA_WANT_SURFACE};
  for (int i = 0; i < 12; i++) {
    morula_clump_options huge;
    OK(morula_clump_options_init(&huge, sizeof huge));
    huge.spheres = 2;
    huge.method = MORULA_METHOD_MSS;
    huge.radius_offset = offsets[i / 3];
    huge.wants = wants[i % 3];
    /* The volume is refused where no column meets both, the surface where numbers end. */
    const int bad = i % 3 == 1 ? i / 3 >= 1 : i % 3 == 2 && i / 3 == 3;
    STATUS(morula_clump_from_solid(solid, &huge, &clump),
           bad ? MORULA_STATUS_INVALID_ARGUMENT : MORULA_STATUS_OK);
    CHECK(!bad || strncmp(morula_last_error_message(), "sphere 0 has radius ", 20) == 0);
    CHECK(!bad == (clump != NULL));
    morula_clump_free(clump);
    clump = NULL;
  }

  morula_clump_options o;
  OK(morula_clump_options_init(&o, sizeof o));
  o.spheres = 2;
  o.wants = MORULA_WANT_NOTHING;
  OK(morula_clump_from_solid(solid, &o, &clump));
  STATUS(morula_clump_sphere_count(NULL, &n), MORULA_STATUS_NULL_POINTER);
  STATUS(morula_clump_sphere_count(clump, NULL), MORULA_STATUS_NULL_POINTER);
  STATUS(morula_clump_copy_spheres(NULL, 1, numbers), MORULA_STATUS_NULL_POINTER);
  STATUS(morula_clump_copy_spheres(clump, 1, numbers), MORULA_STATUS_BUFFER_TOO_SMALL);
  STATUS(morula_clump_copy_spheres(clump, 2, NULL), MORULA_STATUS_NULL_POINTER);
  CHECK(numbers[0] == 5);
  STATUS(morula_clump_stopped(NULL, &stopped), MORULA_STATUS_NULL_POINTER);
  STATUS(morula_clump_stopped(clump, NULL), MORULA_STATUS_NULL_POINTER);
  STATUS(morula_clump_copy_note(NULL, 4, text, NULL), MORULA_STATUS_NULL_POINTER);
  STATUS(morula_clump_copy_note(clump, 4, NULL, NULL), MORULA_STATUS_NULL_POINTER);
  STATUS(morula_clump_copy_note(clump, 0, text, NULL), MORULA_STATUS_BUFFER_TOO_SMALL);
  STATUS(morula_clump_moments(NULL, 1, &moments), MORULA_STATUS_NULL_POINTER);
  STATUS(morula_clump_overlap(NULL, &overlap), MORULA_STATUS_NULL_POINTER);
  STATUS(morula_clump_surface(NULL, &surface), MORULA_STATUS_NULL_POINTER);
  STATUS(morula_clump_copy_exposed_areas(NULL, 4, numbers), MORULA_STATUS_NULL_POINTER);
  STATUS(morula_clump_copy_plane_contacts(NULL, 1, contacts), MORULA_STATUS_NULL_POINTER);
  STATUS(morula_shape_counters(NULL, &counters), MORULA_STATUS_NULL_POINTER);
  STATUS(morula_shape_counters(shape, NULL), MORULA_STATUS_NULL_POINTER);
  STATUS(morula_solid_counters(NULL, &counters), MORULA_STATUS_NULL_POINTER);
  STATUS(morula_solid_counters(solid, NULL), MORULA_STATUS_NULL_POINTER);
  STATUS(morula_clump_counters(NULL, &counters), MORULA_STATUS_NULL_POINTER);
  STATUS(morula_clump_counters(clump, NULL), MORULA_STATUS_NULL_POINTER);

  /* What was not wanted was not computed. */
  STATUS(morula_clump_moments(clump, 1, &moments), MORULA_STATUS_NOT_WANTED);
  STATUS(morula_clump_overlap(clump, &overlap), MORULA_STATUS_NOT_WANTED);
  STATUS(morula_clump_surface(clump, &surface), MORULA_STATUS_NOT_WANTED);
  STATUS(morula_clump_copy_exposed_areas(clump, 4, numbers), MORULA_STATUS_NOT_WANTED);
  STATUS(morula_clump_copy_plane_contacts(clump, 1, contacts), MORULA_STATUS_NOT_WANTED);
  OK(morula_clump_counters(clump, &counters));
  CHECK(counters.seconds_measure == 0);
  o.wants = MORULA_WANT_OVERLAP;
  OK(morula_clump_from_solid(solid, &o, &other));
  OK(morula_clump_overlap(other, &overlap));
  STATUS(morula_clump_surface(other, &surface), MORULA_STATUS_NOT_WANTED);
  CHECK(n == 77 && stopped == 77);

  morula_shape_free(NULL);
  morula_solid_free(NULL);
  morula_clump_free(NULL);
  morula_clump_free(clump);
  morula_clump_free(other);
  morula_solid_free(solid);
  morula_shape_free(shape);
}

int main(void) {
  l_mesh(vertices, triangles, 0);
  meshes();
  import_options();
  voxels();
  files();
  primitives();
  handles();
  return checks_done();
}
