/* Structs of older and newer headers, versions, sizes, names. */
#include "check.h"

#include <stddef.h>

/* A struct as a later header may have it. */
struct newer {
  morula_clump_options known;
  double later;
};

/* No padding at the end: the last field ends where the struct does. */
#define ENDS_WITH(type, last) \
  CHECK(offsetof(type, last) + sizeof ((type *)0)->last == sizeof(type))

int main(void) {
  CHECK(morula_version() == MORULA_VERSION);
  CHECK(strcmp(morula_version_string(), MORULA_VERSION_STRING) == 0);

  CHECK(morula_sizeof(MORULA_STRUCT_IMPORT_OPTIONS) == sizeof(morula_import_options));
  CHECK(morula_sizeof(MORULA_STRUCT_FILE_OPTIONS) == sizeof(morula_file_options));
  CHECK(morula_sizeof(MORULA_STRUCT_SOLID_OPTIONS) == sizeof(morula_solid_options));
  CHECK(morula_sizeof(MORULA_STRUCT_CLUMP_OPTIONS) == sizeof(morula_clump_options));
  CHECK(morula_sizeof(MORULA_STRUCT_REPORT) == sizeof(morula_report));
  CHECK(morula_sizeof(MORULA_STRUCT_MOMENTS) == sizeof(morula_moments));
  CHECK(morula_sizeof(MORULA_STRUCT_OVERLAP) == sizeof(morula_overlap));
  CHECK(morula_sizeof(MORULA_STRUCT_SURFACE) == sizeof(morula_surface));
  CHECK(morula_sizeof(MORULA_STRUCT_COUNTERS) == sizeof(morula_counters));
  CHECK(morula_sizeof(MORULA_STRUCT_MASS_OPTIONS) == sizeof(morula_mass_options));
  CHECK(morula_sizeof(MORULA_STRUCT_MASSES) == sizeof(morula_masses));
  CHECK(morula_sizeof(MORULA_STRUCT_CONTACT_OPTIONS) == sizeof(morula_contact_options));
  CHECK(morula_sizeof(MORULA_STRUCT_TIMESTEP) == sizeof(morula_timestep));
  CHECK(morula_sizeof(MORULA_STRUCT_EXPORT_OPTIONS) == sizeof(morula_export_options));
  CHECK(morula_sizeof(MORULA_STRUCT_COST_OPTIONS) == sizeof(morula_cost_options));
  CHECK(morula_sizeof(MORULA_STRUCT_COST_POINT) == sizeof(morula_cost_point));
  CHECK(morula_sizeof(MORULA_STRUCT_COST_BOUNDS) == sizeof(morula_cost_bounds));
  CHECK(morula_sizeof(MORULA_STRUCT_SWEEP_OPTIONS) == sizeof(morula_sweep_options));
  CHECK(morula_sizeof(MORULA_STRUCT_SWEPT) == sizeof(morula_swept));
  CHECK(morula_sizeof(0) == 0 && morula_sizeof(-1) == 0 && morula_sizeof(1000) == 0);
  ENDS_WITH(morula_import_options, user);
  ENDS_WITH(morula_file_options, reserved);
  ENDS_WITH(morula_solid_options, user);
  ENDS_WITH(morula_clump_options, symmetry_planes);
  ENDS_WITH(morula_report, threshold);
  ENDS_WITH(morula_moments, relative_error);
  ENDS_WITH(morula_overlap, moment_errors);
  ENDS_WITH(morula_surface, symmetry_planes);
  ENDS_WITH(morula_counters, columns);

  morula_shape *shape = l_shape();
  morula_clump *clump = NULL;

  /* A newer, longer struct is taken while what is unknown is zero. */
  struct newer options;
  memset(&options, 0xff, sizeof options);
  OK(morula_clump_options_init(&options.known, sizeof options));
  CHECK(options.known.struct_size == sizeof options && options.later == 0);
  options.known.spheres = 3;
  OK(morula_clump_from_shape(shape, NULL, &options.known, &clump));
  size_t n = 0;
  OK(morula_clump_sphere_count(clump, &n));
  CHECK(n == 3);
  morula_clump *none = NULL;
  options.later = 1;
  STATUS(morula_clump_from_shape(shape, NULL, &options.known, &none), MORULA_STATUS_STRUCT_SIZE);
  CHECK(none == NULL);

  /* Sizes that no release had. */
  const size_t first = offsetof(morula_clump_options, effort);
  const size_t wrong[] = {0, 1, 8, first - 1, (size_t)-1};
  for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
    morula_clump_options o;
    STATUS(morula_clump_options_init(&o, wrong[i]), MORULA_STATUS_STRUCT_SIZE);
    OK(morula_clump_options_init(&o, sizeof o));
    o.struct_size = wrong[i];
    STATUS(morula_clump_from_shape(shape, NULL, &o, &none), MORULA_STATUS_STRUCT_SIZE);
    CHECK(none == NULL);
  }

  /* What the library fills follows the same rule, and is untouched by a failure. */
  struct {
    morula_moments known;
    double later;
  } moments;
  memset(&moments, 0xff, sizeof moments);
  moments.known.struct_size = sizeof moments;
  OK(morula_shape_moments(shape, 2, &moments.known));
  CHECK(moments.known.struct_size == sizeof moments && moments.later == 0);
  NEAR(moments.known.mass, L_MASS, 1e-12);
  moments.known.struct_size = 8;
  STATUS(morula_shape_moments(shape, 3, &moments.known), MORULA_STATUS_STRUCT_SIZE);
  NEAR(moments.known.mass, L_MASS, 1e-12);

  CHECK(strcmp(morula_status_name(MORULA_STATUS_OK), "OK") == 0);
  CHECK(strcmp(morula_status_name(MORULA_STATUS_INTERNAL), "INTERNAL") == 0);
  CHECK(strcmp(morula_status_name(12345), "UNKNOWN") == 0);
  CHECK(strcmp(morula_stopped_name(MORULA_STOPPED_DEADLINE), "deadline") == 0);
  CHECK(strcmp(morula_stopped_name(-3), "unknown") == 0);

  morula_clump_free(clump);
  morula_shape_free(shape);
  return checks_done();
}
