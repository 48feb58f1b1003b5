/* Walks through every function of the header, as a solver would call it. */
#include "check.h"

#include <stdlib.h>

static int lines;

static void sink(int32_t level, const char *text, void *user) {
  CHECK(level == MORULA_LOG_INFO || level == MORULA_LOG_WARNING);
  CHECK(text[0] != '\0' && user == &lines);
  lines++;
}

static int32_t progress(double fraction, void *user) {
  double *last = user;
  CHECK(fraction >= *last && fraction <= 1);
  *last = fraction;
  return 0;
}

/* A file in memory, so that this program needs none: a tetrahedron. */
static const char OFF[] =
    "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";

/* A shape, a solid and a clump each tell what was done on the road to them; what was not
 * wanted stays 0. */
static void whole_road(const morula_shape *read_from_file) {
  morula_solid *solid = NULL;
  morula_clump *clump = NULL;
  morula_clump_options options;
  morula_counters shapes = {0}, solids = {0}, clumps = {0};
  shapes.struct_size = solids.struct_size = clumps.struct_size = sizeof shapes;
  OK(morula_shape_counters(read_from_file, &shapes));
  CHECK(shapes.seconds_read > 0 && shapes.seconds_check > 0);
  CHECK(shapes.seconds_solid == 0 && shapes.cells == 0);

  OK(morula_solid_from_shape(read_from_file, NULL, &solid));
  OK(morula_solid_counters(solid, &solids));
  CHECK(solids.seconds_read == shapes.seconds_read && solids.seconds_check == shapes.seconds_check);
  CHECK(solids.seconds_solid > 0 && solids.cells > 0 && solids.peak_bytes > 0);
  CHECK(solids.seconds_generate == 0 && solids.spheres_tried == 0);

  OK(morula_clump_options_init(&options, sizeof options));
  options.spheres = 3;
  options.method = MORULA_METHOD_MSS;
  options.wants = MORULA_WANT_NOTHING;
  OK(morula_clump_from_solid(solid, &options, &clump));
  OK(morula_clump_counters(clump, &clumps));
  CHECK(clumps.seconds_read == shapes.seconds_read && clumps.seconds_solid >= solids.seconds_solid);
  CHECK(clumps.seconds_generate > 0 && clumps.cells >= solids.cells);
  CHECK(clumps.seconds_measure == 0);
  morula_clump_free(clump);
  morula_solid_free(solid);

  OK(morula_clump_from_shape(read_from_file, NULL, &options, &clump));
  OK(morula_clump_counters(clump, &clumps));
  CHECK(clumps.seconds_read == shapes.seconds_read && clumps.seconds_check > 0);
  CHECK(clumps.seconds_solid > 0 && clumps.seconds_generate > 0 && clumps.peak_bytes > 0);
  CHECK(clumps.cells == solids.cells);
  morula_clump_free(clump);
}

static void shapes(void) {
  morula_shape *shape = l_shape();
  morula_report report = {0};
  report.struct_size = sizeof report;
  OK(morula_shape_report(shape, &report));
  CHECK(report.input_vertices == 12 && report.input_faces == 20);
  CHECK(report.vertices == 12 && report.faces == 20 && report.solid_cells == 0);
  CHECK(report.components == 1 && report.bodies == 1 && report.bodies_dropped == 0);
  CHECK(report.watertight == 1 && report.oriented == 1 && report.inverted == 0);
  CHECK(report.boundary_edges == 0 && report.nonmanifold_edges == 0);
  NEAR(report.volume, 4, 1e-12);
  NEAR(report.area, 18, 1e-12);
  for (int i = 0; i < 3; i++) NEAR(report.box_min[i], 10 * (i + 1), 1e-12);
  NEAR(report.box_max[0], 13, 1e-12);
  NEAR(report.box_max[1], 22, 1e-12);
  NEAR(report.box_max[2], 31, 1e-12);
  morula_shape_free(shape);
  shape = NULL;

  /* A file, from disk and from memory. */
  const char *path = "tetrahedron.off";
  FILE *file = fopen(path, "wb");
  CHECK(file && fputs(OFF, file) >= 0 && fclose(file) == 0);
  morula_import_options import;
  morula_file_options options;
  OK(morula_import_options_init(&import, sizeof import));
  OK(morula_file_options_init(&options, sizeof options));
  import.length_unit = 0.001;
  OK(morula_shape_from_file(path, &import, &options, &shape));
  OK(morula_shape_report(shape, &report));
  whole_road(shape);
  NEAR(report.volume, 1e-9 / 6, 1e-20);
  CHECK(report.length_unit == 0.001);
  morula_shape_free(shape);
  remove(path);
  OK(morula_shape_from_bytes((const uint8_t *)OFF, sizeof OFF - 1, NULL, NULL, NULL, &shape));
  OK(morula_shape_report(shape, &report));
  NEAR(report.volume, 1.0 / 6, 1e-12);
  morula_shape_free(shape);

  /* A raw volume, described by the options. */
  const uint8_t raw[2 + 12] = {9, 9, 0, 0, 0, 0, 200, 200, 0, 0, 0, 0, 0, 0};
  options.format = MORULA_FORMAT_RAW;
  options.raw_dims[0] = 3, options.raw_dims[1] = 2, options.raw_dims[2] = 2;
  options.raw_skip = 2;
  OK(morula_shape_from_bytes(raw, sizeof raw, NULL, NULL, &options, &shape));
  OK(morula_shape_report(shape, &report));
  CHECK(report.solid_cells == 2);
  morula_shape_free(shape);

  /* Notes: what a user should know. Here a triangle is missing. */
  double vertices[36];
  uint32_t triangles[60];
  l_mesh(vertices, triangles, 0);
  OK(morula_shape_from_mesh(vertices, 12, triangles, 19, NULL, &shape));
  size_t count = 0, length = 0;
  OK(morula_shape_note_count(shape, &count));
  CHECK(count > 0);
  for (size_t i = 0; i < count; i++) {
    OK(morula_shape_copy_note(shape, i, 0, NULL, &length));
    char *text = malloc(length + 1);
    STATUS(morula_shape_copy_note(shape, i, length, text, NULL), MORULA_STATUS_BUFFER_TOO_SMALL);
    OK(morula_shape_copy_note(shape, i, length + 1, text, NULL));
    CHECK(strlen(text) == length && length > 10);
    free(text);
  }
  OK(morula_shape_report(shape, &report));
  CHECK(report.boundary_edges == 3 && report.watertight == 0);
  morula_shape_free(shape);
}

/* The labels of 4 x 3 x 2 cells in a file: raw, after a byte to skip. */
static void labels_of_files(const uint32_t labels[24], const uint32_t ids[2],
                            const uint64_t cells[2], const uint64_t boxes[12],
                            const int32_t touches[2]) {
  float f32[24];
  uint8_t bytes[1 + sizeof f32] = {0};
  for (int i = 0; i < 24; i++) f32[i] = (float)labels[i];
  memcpy(bytes + 1, f32, sizeof f32);
  morula_file_options file;
  OK(morula_file_options_init(&file, sizeof file));
  file.format = MORULA_FORMAT_RAW;
  file.raw_type = MORULA_RAW_F32;
  file.raw_skip = 1;
  file.raw_dims[0] = 4;
  file.raw_dims[1] = 3;
  file.raw_dims[2] = 2;
  const char *path = "api_labels.raw";
  FILE *out = fopen(path, "wb");
  CHECK(out && fwrite(bytes, 1, sizeof bytes, out) == sizeof bytes);
  if (out) fclose(out);
  for (int from_file = 0; from_file < 2; from_file++) {
    uint32_t found_ids[3] = {0};
    uint64_t found_cells[2] = {0}, found_boxes[12] = {0};
    int32_t found_touches[2] = {0};
    size_t count = 0, again = 77;
    if (from_file) {
      OK(morula_labels_from_file(path, NULL, &file, 0, NULL, NULL, NULL, NULL, &count));
      OK(morula_labels_from_file(path, NULL, &file, 2, found_ids, found_cells, found_boxes,
                                 found_touches, &again));
    } else {
      OK(morula_labels_from_bytes(bytes, sizeof bytes, NULL, NULL, &file, 0, NULL, NULL, NULL,
                                  NULL, &count));
      OK(morula_labels_from_bytes(bytes, sizeof bytes, NULL, NULL, &file, 3, found_ids,
                                  found_cells, found_boxes, found_touches, &again));
    }
    CHECK(count == 2 && again == 2 && found_ids[2] == 0);
    CHECK(memcmp(found_ids, ids, 2 * sizeof *ids) == 0);
    CHECK(memcmp(found_cells, cells, 2 * sizeof *cells) == 0);
    CHECK(memcmp(found_boxes, boxes, 12 * sizeof *boxes) == 0);
    CHECK(memcmp(found_touches, touches, 2 * sizeof *touches) == 0);
  }
  remove(path);
}

static void voxels(void) {
  /* 4 x 3 x 2 cells, x fastest, spacing 1, 2, 3. */
  uint8_t u8[24];
  uint16_t u16[24];
  float f32[24];
  uint32_t labels[24];
  const size_t dims[3] = {4, 3, 2};
  const double spacing[3] = {1, 2, 3}, origin[3] = {-1, -2, -3}, threshold = 150;
  for (int i = 0; i < 24; i++) {
    int x = i % 4, y = i / 4 % 3;
    int in = (x == 1 || x == 2) && y == 1;
    u8[i] = (uint8_t)(in ? 200 : 100 + i % 3);
    u16[i] = (uint16_t)(in ? 2000 : 100 + i % 3);
    f32[i] = in ? 0.75f : 0.25f;
    labels[i] = in ? 7 : x == 3 ? 4000000000u : 0;
  }
  morula_shape *shapes[5] = {NULL};
  uint8_t mask[24];
  for (int i = 0; i < 24; i++) mask[i] = labels[i] == 7;
  OK(morula_shape_from_mask(mask, dims, spacing, origin, NULL, &shapes[0]));
  OK(morula_shape_from_grey_u8(u8, dims, spacing, origin, &threshold, NULL, &shapes[1]));
  OK(morula_shape_from_grey_u16(u16, dims, spacing, origin, NULL, NULL, &shapes[2]));
  OK(morula_shape_from_grey_f32(f32, dims, spacing, origin, NULL, NULL, &shapes[3]));
  OK(morula_shape_from_label(labels, dims, spacing, origin, 7, NULL, &shapes[4]));
  for (int i = 0; i < 5; i++) {
    morula_report report = {0};
    report.struct_size = sizeof report;
    OK(morula_shape_report(shapes[i], &report));
    CHECK(report.solid_cells == 4 && report.touches_border == 1);
    NEAR(report.volume, 24, 1e-12);
    NEAR(report.box_min[0], 0, 1e-12);
    NEAR(report.box_min[1], 0, 1e-12);
    NEAR(report.box_min[2], -3, 1e-12);
    NEAR(report.box_max[0], 2, 1e-12);
    if (i == 1) CHECK(report.threshold == 150);
    if (i == 2) CHECK(report.threshold >= 102 && report.threshold < 2000);
    morula_shape_free(shapes[i]);
  }

  size_t count = 0;
  OK(morula_labels_count(labels, dims, &count));
  CHECK(count == 2);
  uint32_t ids[2];
  uint64_t cells[2], boxes[12];
  int32_t touches[2];
  OK(morula_labels_copy(labels, dims, 2, ids, cells, boxes, touches));
  CHECK(ids[0] == 7 && ids[1] == 4000000000u && cells[0] == 4 && cells[1] == 6);
  const uint64_t box[6] = {1, 1, 0, 2, 1, 1};
  CHECK(memcmp(boxes, box, sizeof box) == 0);
  CHECK(touches[0] == 1 && touches[1] == 1);
  OK(morula_labels_copy(labels, dims, 2, NULL, NULL, NULL, NULL));
  labels_of_files(labels, ids, cells, boxes, touches);
}

static void primitives(void) {
  size_t names = 0;
  for (; morula_primitive_name(names); names++) {
    const char *name = morula_primitive_name(names);
    size_t parameters = 0;
    OK(morula_primitive_parameter_count(name, &parameters));
    CHECK(parameters > 0);
    for (size_t i = 0; i < parameters; i++) {
      char key[64];
      size_t length = 0;
      double value = NAN;
      OK(morula_primitive_copy_parameter(name, i, sizeof key, key, &length, &value));
      CHECK(strlen(key) == length && isfinite(value));
      double alone = NAN;
      OK(morula_primitive_copy_parameter(name, i, 0, NULL, NULL, &alone));
      CHECK(alone == value);
    }
  }
  CHECK(names >= 11);

  morula_shape *shape = NULL;
  morula_moments moments = {0};
  const char *keys[1] = {"radius"};
  const double values[1] = {2};
  moments.struct_size = sizeof moments;
  OK(morula_shape_from_primitive("sphere", keys, values, 1, 200, 0, NULL, &shape));
  OK(morula_shape_moments(shape, 1, &moments));
  NEAR(moments.volume, 4.0 / 3 * 3.14159265358979 * 8, 0.05);
  morula_shape_free(shape);

  /* Seeds tell stones apart, and the same seed gives the same stone. */
  double volumes[3];
  const uint64_t seeds[3] = {1, 2, 1};
  for (int i = 0; i < 3; i++) {
    morula_report report = {0};
    report.struct_size = sizeof report;
    OK(morula_shape_from_primitive("stone", NULL, NULL, 0, 0, seeds[i], NULL, &shape));
    OK(morula_shape_report(shape, &report));
    CHECK(report.watertight == 1);
    volumes[i] = report.area;
    morula_shape_free(shape);
  }
  CHECK(volumes[0] != volumes[1] && volumes[0] == volumes[2]);
}

static void clumps(void) {
  morula_shape *shape = l_shape();
  morula_solid *solid = NULL;
  morula_clump *clump = NULL;
  morula_solid_options solid_options;
  morula_clump_options options;
  double last = 0;
  OK(morula_solid_options_init(&solid_options, sizeof solid_options));
  CHECK(solid_options.cells == 64 && solid_options.threads == 1 && solid_options.padding == 4);
  solid_options.resolution = MORULA_RESOLUTION_CELL_SIZE;
  solid_options.cell_size = 0.1;
  solid_options.progress = progress;
  solid_options.user = &last;
  OK(morula_solid_from_shape(shape, &solid_options, &solid));
  double spacing[3];
  OK(morula_solid_grid(solid, NULL, spacing, NULL));
  for (int i = 0; i < 3; i++) CHECK(spacing[i] > 0.05 && spacing[i] <= 0.1 + 1e-12);
  size_t notes = 99, length = 0;
  OK(morula_solid_note_count(solid, &notes));
  CHECK(notes < 9);
  for (size_t i = 0; i < notes; i++) OK(morula_solid_copy_note(solid, i, 0, NULL, &length));

  const double planes[2] = {0.01, 0.2};
  OK(morula_clump_options_init(&options, sizeof options));
  CHECK(options.spheres == 50 && options.threads == 1 && options.wants == MORULA_WANT_MOMENTS);
  options.spheres = 20;
  options.threads = 2;
  options.wants = MORULA_WANT_OVERLAP | MORULA_WANT_SURFACE | MORULA_WANT_MOMENTS;
  options.plane_tolerances = planes;
  options.plane_tolerance_count = 2;
  options.progress = progress;
  options.user = &last;
  last = 0;
  OK(morula_clump_from_solid(solid, &options, &clump));
  morula_solid_free(solid);
  CHECK(last > 0);

  size_t n = 0;
  int32_t stopped = -1;
  OK(morula_clump_sphere_count(clump, &n));
  OK(morula_clump_stopped(clump, &stopped));
  CHECK(n > 0 && n <= 20);
  CHECK(stopped == MORULA_STOPPED_SPHERES || stopped == MORULA_STOPPED_EXHAUSTED);
  CHECK((stopped == MORULA_STOPPED_SPHERES) == (n == 20));
  OK(morula_clump_copy_note(clump, 0, NULL, &length));
  CHECK((length > 0) == (n < 20));
  char note[1000];
  OK(morula_clump_copy_note(clump, sizeof note, note, NULL));
  CHECK(strlen(note) == length);

  morula_overlap overlap = {0};
  morula_surface surface = {0};
  morula_moments moments = {0};
  morula_counters counters = {0};
  overlap.struct_size = sizeof overlap;
  surface.struct_size = sizeof surface;
  moments.struct_size = sizeof moments;
  counters.struct_size = sizeof counters;
  OK(morula_clump_overlap(clump, &overlap));
  CHECK(overlap.mismatch > 0 && overlap.mismatch < 0.3);
  CHECK(overlap.coverage > 0.6 && overlap.coverage < 1 && overlap.overshoot < 0.2);
  CHECK(overlap.iou > 0.5 && overlap.iou < 1 && overlap.eta > 0 && overlap.eta < 0.6);
  NEAR(overlap.mismatch, 1 - 2 * overlap.iou / (1 + overlap.iou), 1e-9);
  NEAR(overlap.target_volume, 4, 0.02);
  NEAR(overlap.volume_error, overlap.union_volume / overlap.target_volume - 1, 0.01);
  OK(morula_clump_surface(clump, &surface));
  CHECK(surface.protrusion >= 0 && surface.protrusion < 0.3);
  CHECK(surface.hausdorff >= surface.rms_distance && surface.rms_distance > 0);
  CHECK(surface.distance_bound >= 0 && surface.distance_bound < 0.1);
  CHECK(surface.roughness > 0 && surface.roughness < 1.6 && surface.samples > 0);
  double areas[20], sum = 0;
  uint32_t contacts[2];
  OK(morula_clump_copy_exposed_areas(clump, 20, areas));
  for (size_t i = 0; i < n; i++) sum += areas[i];
  CHECK(sum > 9 && sum < 36);
  OK(morula_clump_copy_plane_contacts(clump, 2, contacts));
  CHECK(contacts[0] >= 1 && contacts[0] <= contacts[1] && contacts[1] <= n);
  OK(morula_clump_moments(clump, 2, &moments));
  NEAR(moments.mass, L_MASS, 1e-12);
  OK(morula_clump_counters(clump, &counters));
  CHECK(counters.seconds_generate > 0 && counters.seconds_measure > 0);
  /* Also what the calls before did, whose handles are gone; nothing was read from a file. */
  CHECK(counters.seconds_check > 0 && counters.seconds_solid > 0 && counters.cells > 0);
  CHECK(counters.seconds_read == 0 && counters.seconds_moments > 0 && counters.columns > 0);
  morula_clump_free(clump);
  clump = NULL;

  /* A deadline that has passed at once leaves a clump all the same. */
  options.deadline_seconds = 1e-9;
  last = 0;
  options.wants = MORULA_WANT_NOTHING;
  options.plane_tolerance_count = 0;
  OK(morula_clump_from_shape(shape, NULL, &options, &clump));
  OK(morula_clump_sphere_count(clump, &n));
  OK(morula_clump_stopped(clump, &stopped));
  CHECK(n >= 1 && (stopped == MORULA_STOPPED_DEADLINE || n == 20));
  morula_clump_free(clump);

  /* Confined: nothing reaches beyond the surface. */
  double xyzr[20][4], distance;
  options.deadline_seconds = 0;
  options.method = MORULA_METHOD_MSS;
  options.confine = 1;
  last = 0;
  OK(morula_clump_from_shape(shape, NULL, &options, &clump));
  OK(morula_solid_from_shape(shape, NULL, &solid));
  OK(morula_clump_sphere_count(clump, &n));
  OK(morula_clump_copy_spheres(clump, 20, xyzr[0]));
  for (size_t i = 0; i < n; i++) {
    OK(morula_solid_distance(solid, 1, xyzr[i], &distance));
    CHECK(distance + xyzr[i][3] <= 1e-9);
  }
  morula_clump_free(clump);

  /* Packed: of nearly one size, and no two overlap. */
  options.confine = 0;
  options.method = MORULA_METHOD_PACKED;
  last = 0;
  OK(morula_clump_from_solid(solid, &options, &clump));
  OK(morula_clump_copy_spheres(clump, 20, xyzr[0]));
  for (int i = 0; i < 20; i++) {
    CHECK(xyzr[i][3] <= 1.05 * xyzr[19][3]);
    for (int j = 0; j < i; j++) {
      double apart2 = 0, radii = xyzr[i][3] + xyzr[j][3];
      for (int k = 0; k < 3; k++) apart2 += (xyzr[i][k] - xyzr[j][k]) * (xyzr[i][k] - xyzr[j][k]);
      CHECK(apart2 >= radii * radii * (1 - 1e-12));
    }
  }
  morula_clump_free(clump);
  morula_solid_free(solid);
  morula_shape_free(shape);
}

int main(void) {
  OK(morula_set_log(sink, &lines));
  shapes();
  voxels();
  primitives();
  clumps();
  CHECK(lines > 0);
  OK(morula_set_log(NULL, NULL));
  lines = 0;
  morula_shape_free(l_shape());
  CHECK(lines == 0);
  return checks_done();
}
