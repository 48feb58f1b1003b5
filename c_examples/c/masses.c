/* Weighs a clump, places it, asks for a time step, and writes it for LAMMPS. */
#include "check.h"

#include <stddef.h>
#include <stdlib.h>

#define DENSITY 2.0
#define SPHERES 24

/* What solid spheres of these masses add up to: mass, centre, inertia about the centre. */
static void add_up(const double *xyzr, const double *masses, size_t n, double centre[3],
                   double inertia[6], double *mass) {
  *mass = 0;
  memset(centre, 0, 3 * sizeof *centre);
  memset(inertia, 0, 6 * sizeof *inertia);
  for (size_t i = 0; i < n; i++) {
    *mass += masses[i];
    for (int k = 0; k < 3; k++) centre[k] += masses[i] * xyzr[4 * i + k];
  }
  for (int k = 0; k < 3; k++) centre[k] /= *mass;
  for (size_t i = 0; i < n; i++) {
    const double *s = xyzr + 4 * i;
    const double d[3] = {s[0] - centre[0], s[1] - centre[1], s[2] - centre[2]};
    const double own = 0.4 * s[3] * s[3] + d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    for (int k = 0; k < 3; k++) inertia[k] += masses[i] * (own - d[k] * d[k]);
    inertia[3] -= masses[i] * d[0] * d[1];
    inertia[4] -= masses[i] * d[0] * d[2];
    inertia[5] -= masses[i] * d[1] * d[2];
  }
}

/* The spheres and masses of a body, held against its moments. */
static void holds(const morula_body *body) {
  size_t n = 0;
  double xyzr[4 * SPHERES], masses[SPHERES], centre[3], inertia[6], mass;
  morula_moments m;
  m.struct_size = sizeof m;
  OK(morula_body_sphere_count(body, &n));
  CHECK(n == SPHERES);
  OK(morula_body_copy_spheres(body, MORULA_FRAME_INPUT, SPHERES, xyzr));
  OK(morula_body_copy_masses(body, SPHERES, masses));
  OK(morula_body_moments(body, &m));
  add_up(xyzr, masses, n, centre, inertia, &mass);
  const double size = cbrt(m.volume), least = m.mass / 1000 * (1 - 1e-12);
  NEAR(mass, m.mass, 1e-10 * m.mass);
  for (int k = 0; k < 3; k++) NEAR(centre[k], m.centre[k], 1e-10 * size);
  for (int k = 0; k < 6; k++) NEAR(inertia[k], m.inertia[k], 1e-9 * m.principal[2]);
  for (size_t i = 0; i < n; i++) CHECK(masses[i] >= least);
  /* In the body frame the products vanish and the moments ascend. */
  OK(morula_body_copy_spheres(body, MORULA_FRAME_BODY, SPHERES, xyzr));
  add_up(xyzr, masses, n, centre, inertia, &mass);
  for (int k = 0; k < 3; k++) {
    NEAR(centre[k], 0, 1e-10 * size);
    NEAR(inertia[k], m.principal[k], 1e-9 * m.principal[2]);
    NEAR(inertia[3 + k], 0, 1e-9 * m.principal[2]);
  }
}

int main(void) {
  morula_shape *shape = l_shape();
  morula_solid *solid = NULL;
  morula_clump *clump = NULL;
  morula_clump_options clump_options;
  OK(morula_solid_from_shape(shape, NULL, &solid));
  OK(morula_clump_options_init(&clump_options, sizeof clump_options));
  clump_options.spheres = SPHERES;
  clump_options.effort = MORULA_EFFORT_DRAFT;
  OK(morula_clump_from_solid(solid, &clump_options, &clump));

  morula_mass_options options;
  morula_body *body = NULL;
  OK(morula_mass_options_init(&options, sizeof options));
  options.density = DENSITY;
  OK(morula_body_from_clump(clump, &options, &body));
  holds(body);

  /* The body is the L, whose moments are known by hand. */
  morula_moments m;
  m.struct_size = sizeof m;
  OK(morula_body_moments(body, &m));
  double expected[6];
  l_inertia(expected);
  NEAR(m.mass, L_MASS, 1e-12 * L_MASS);
  for (int k = 0; k < 3; k++) NEAR(m.centre[k], L_CENTRE[k], 1e-12 * 40);
  for (int k = 0; k < 6; k++) NEAR(m.inertia[k], expected[k], 1e-9 * m.principal[2]);
  morula_masses result;
  result.struct_size = sizeof result;
  OK(morula_body_masses(body, &result));
  CHECK(result.status == MORULA_MASSES_EXACT && result.mass == m.mass);
  CHECK(strcmp(morula_masses_status_name(result.status), "exact") == 0);
  CHECK(strcmp(morula_masses_status_name(77), "unknown") == 0);
  CHECK(result.mass_residual < 1e-10 && result.inertia_residual < 1e-10);
  CHECK(result.union_inertia_error != 0 && fabs(result.union_inertia_error) < 0.3);
  uint32_t binding[SPHERES];
  OK(morula_body_copy_binding(body, SPHERES, binding));

  /* Other wishes; the union as the target; spheres made elsewhere. */
  double masses[SPHERES], others[SPHERES], xyzr[4 * SPHERES];
  OK(morula_body_copy_masses(body, SPHERES, masses));
  const int32_t wishes[2] = {MORULA_OBJECTIVE_MAX_MIN, MORULA_OBJECTIVE_MAX_LAST};
  for (int i = 0; i < 2; i++) {
    morula_body *other = NULL;
    options.objective = wishes[i];
    OK(morula_body_from_clump(clump, &options, &other));
    holds(other);
    OK(morula_body_copy_masses(other, SPHERES, others));
    CHECK(memcmp(masses, others, sizeof masses) != 0);
    if (i == 1) CHECK(others[SPHERES - 1] >= masses[SPHERES - 1]);
    morula_body_free(other);
  }
  options.objective = MORULA_OBJECTIVE_EVEN;
  OK(morula_clump_copy_spheres(clump, SPHERES, xyzr));
  morula_body *again = NULL;
  OK(morula_body_from_spheres(xyzr, SPHERES, solid, &options, &again));
  OK(morula_body_copy_masses(again, SPHERES, others));
  for (int i = 0; i < SPHERES; i++) NEAR(others[i], masses[i], 1e-9 * m.mass);
  morula_body_free(again);
  OK(morula_body_from_spheres(xyzr, SPHERES, NULL, &options, &again));
  holds(again);
  OK(morula_body_masses(again, &result));
  CHECK(result.union_inertia_error == 0 && fabs(result.mass - L_MASS) > 1e-6);
  morula_body_free(again);

  /* Twice as large, turned, elsewhere, of another density. */
  const double place[3] = {-5, 7, 11};
  double turns[8];
  OK(morula_random_orientations(3, 2, turns));
  CHECK(turns[0] >= 0 && memcmp(turns, turns + 4, 4 * sizeof *turns) != 0);
  morula_body *placed = NULL;
  OK(morula_body_transform(body, 2, place, turns, 3 * DENSITY, &placed));
  holds(placed);
  morula_moments p;
  p.struct_size = sizeof p;
  OK(morula_body_moments(placed, &p));
  NEAR(p.mass, 24 * m.mass, 1e-12 * p.mass);
  for (int k = 0; k < 3; k++)
    NEAR(p.principal[k], 96 * m.principal[k], 1e-12 * p.principal[2]);
  morula_body_free(placed);
  OK(morula_body_transform(body, 1, NULL, NULL, 0, &placed));
  OK(morula_body_copy_masses(placed, SPHERES, others));
  CHECK(memcmp(masses, others, sizeof masses) == 0);
  morula_body_free(placed);
  /* Weighed and placed in one call: the same bytes. */
  morula_moments q;
  q.struct_size = sizeof q;
  OK(morula_body_transform(body, 0.5, place, turns, 0, &placed));
  OK(morula_body_moments(placed, &p));
  morula_body_free(placed);
  OK(morula_clump_transform(clump, &options, 0.5, place, turns, &placed));
  OK(morula_body_moments(placed, &q));
  CHECK(memcmp(&p, &q, sizeof p) == 0);
  morula_body_free(placed);

  /* Single precision: inside stays inside. */
  float single[4 * SPHERES];
  OK(morula_body_copy_spheres(body, MORULA_FRAME_BODY, SPHERES, xyzr));
  OK(morula_body_copy_spheres_f32(body, MORULA_FRAME_BODY, SPHERES, single));
  for (int i = 0; i < SPHERES; i++) {
    double apart = 0;
    for (int k = 0; k < 3; k++) apart += pow(xyzr[4 * i + k] - (double)single[4 * i + k], 2);
    CHECK(sqrt(apart) + (double)single[4 * i + 3] <= xyzr[4 * i + 3]);
    CHECK((double)single[4 * i + 3] > xyzr[4 * i + 3] * (1 - 1e-5));
  }

  /* Time steps: a stiffer spring allows a shorter one, by the square root. */
  morula_contact_options contact;
  morula_timestep soft, stiff;
  soft.struct_size = stiff.struct_size = sizeof soft;
  OK(morula_contact_options_init(&contact, sizeof contact));
  contact.stiffness = 1e4;
  OK(morula_body_timestep(body, &contact, &soft));
  contact.stiffness = 1e6;
  OK(morula_body_timestep(body, &contact, &stiff));
  NEAR(soft.clump / stiff.clump, 10, 1e-9);
  CHECK(soft.together == soft.clump);
  contact.contacts = 4;
  OK(morula_body_timestep(body, &contact, &stiff));
  CHECK(stiff.together >= stiff.clump && stiff.together <= 4 * stiff.clump);
  NEAR(stiff.clump, soft.clump / 20, 1e-9 * soft.clump);
  /* A caller that was built when the struct ended before `together`. */
  morula_timestep old = {0};
  old.struct_size = offsetof(morula_timestep, together);
  OK(morula_body_timestep(body, &contact, &old));
  CHECK(old.clump == stiff.clump && old.together == 0);
  contact.contacts = 1;
  OK(morula_body_timestep(body, &contact, &stiff));
  CHECK(soft.rayleigh == 0 && soft.effective_mass <= m.mass && soft.sphere < SPHERES);
  contact.stiffness = 0;
  contact.young = 1e9;
  OK(morula_body_timestep(body, &contact, &stiff));
  CHECK(stiff.rayleigh > 0 && stiff.clump > 0 && stiff.overlap > 0);
  OK(morula_clump_timestep(clump, &options, &contact, &soft));
  CHECK(memcmp(&soft, &stiff, sizeof soft) == 0);

  /* For LAMMPS: in memory and in a file, the same bytes. */
  morula_export_options export_options;
  OK(morula_export_options_init(&export_options, sizeof export_options));
  export_options.name = "L";
  morula_files *files = NULL;
  OK(morula_body_export(body, MORULA_EXPORT_LAMMPS, &export_options, &files));
  size_t count = 0, size = 0, length = 9;
  OK(morula_files_count(files, &count));
  OK(morula_files_size(files, 0, &size));
  OK(morula_files_copy_name(files, 0, 0, NULL, &length));
  CHECK(count == 1 && size > 100 && length == 0);
  uint8_t *bytes = malloc(size), *read = malloc(size + 1);
  OK(morula_files_copy_bytes(files, 0, size, bytes));
  STATUS(morula_files_copy_bytes(files, 0, size - 1, bytes), MORULA_STATUS_BUFFER_TOO_SMALL);
  STATUS(morula_files_size(files, 1, &size), MORULA_STATUS_INDEX_OUT_OF_RANGE);
  OK(morula_body_write(body, MORULA_EXPORT_LAMMPS, &export_options, "masses.mol"));
  FILE *file = fopen("masses.mol", "rb");
  CHECK(file && fread(read, 1, size + 1, file) == size && memcmp(read, bytes, size) == 0);
  if (file) fclose(file);
  CHECK(strncmp((char *)bytes, "# L: clump of 24 spheres", 24) == 0);
  remove("masses.mol");
  OK(morula_clump_write(clump, &options, MORULA_EXPORT_LAMMPS, &export_options, "masses.mol"));
  file = fopen("masses.mol", "rb");
  CHECK(file && fread(read, 1, size + 1, file) == size && memcmp(read, bytes, size) == 0);
  if (file) fclose(file);
  remove("masses.mol");
  free(read);
  free(bytes);
  morula_files_free(files);
  OK(morula_body_export(body, MORULA_EXPORT_MERCURY, NULL, &files));
  char name[32];
  OK(morula_files_count(files, &count));
  OK(morula_files_copy_name(files, 1, sizeof name, name, NULL));
  CHECK(count == 4 && strcmp(name, "Inertia/Mass.txt") == 0);
  morula_files_free(files);

  /* A table in single precision holds the spheres that a copy does. */
  export_options.precision = MORULA_PRECISION_F32;
  OK(morula_body_export(body, MORULA_EXPORT_CSV, &export_options, &files));
  OK(morula_files_size(files, 0, &size));
  char *table = calloc(size + 1, 1);
  OK(morula_files_copy_bytes(files, 0, size, (uint8_t *)table));
  morula_files_free(files);
  char *at = strchr(table, '\n');
  for (int i = 0; at && i < SPHERES; i++, at = strchr(at + 1, '\n'))
    for (int k = 0; k < 4; k++) {
      const double value = strtod(at + 1, &at);
      CHECK(value == (double)single[4 * i + k]);
    }
  CHECK(at != NULL);
  free(table);
  files = NULL;
  export_options.precision = 2;
  STATUS(morula_body_export(body, MORULA_EXPORT_CSV, &export_options, &files),
         MORULA_STATUS_INVALID_ARGUMENT);
  /* Who knows no such field has all digits. */
  export_options.struct_size = offsetof(morula_export_options, precision);
  OK(morula_body_export(body, MORULA_EXPORT_CSV, &export_options, &files));
  morula_files_free(files);

  /* What cannot be is refused, and nothing is written. */
  morula_body *none = NULL;
  const double bad[5] = {0, -1, NAN, INFINITY, 1e308};
  for (int i = 0; i < 5; i++) {
    morula_mass_options o = options;
    o.density = bad[i];
    CHECK(morula_body_from_clump(clump, &o, &none) != MORULA_STATUS_OK && none == NULL);
    CHECK(morula_last_error_message()[0] != '\0');
  }
  morula_mass_options o = options;
  o.m_min = m.mass / SPHERES * 1.01;
  STATUS(morula_body_from_clump(clump, &o, &none), MORULA_STATUS_INVALID_ARGUMENT);
  o = options;
  o.m_max = NAN;
  CHECK(morula_body_from_clump(clump, &o, &none) != MORULA_STATUS_OK);
  o = options;
  o.target = 7;
  STATUS(morula_body_from_clump(clump, &o, &none), MORULA_STATUS_INVALID_ARGUMENT);
  const double two[8] = {10.5, 20.5, 30.5, 0.5, 10.5, 20.5, 30.5, 0.5};
  STATUS(morula_body_from_spheres(two, 2, solid, &options, &none), MORULA_STATUS_NO_MASSES);
  o = options;
  o.infeasible = MORULA_INFEASIBLE_LEAST_ERROR;
  OK(morula_body_from_spheres(two, 2, solid, &o, &none));
  OK(morula_body_masses(none, &result));
  CHECK(result.status == MORULA_MASSES_MASS_ONLY && result.mass_residual < 1e-10);
  morula_body_free(none);
  none = NULL;
  STATUS(morula_body_from_spheres(two, 0, solid, &options, &none), MORULA_STATUS_EMPTY);
  STATUS(morula_body_from_spheres(NULL, 2, solid, &options, &none), MORULA_STATUS_NULL_POINTER);
  STATUS(morula_body_from_spheres(two, SIZE_MAX, NULL, &options, &none), MORULA_STATUS_TOO_LARGE);
  STATUS(morula_body_from_clump(NULL, &options, &none), MORULA_STATUS_NULL_POINTER);
  STATUS(morula_body_from_clump(clump, &options, NULL), MORULA_STATUS_NULL_POINTER);
  STATUS(morula_body_transform(body, 0, NULL, NULL, 0, &none), MORULA_STATUS_INVALID_ARGUMENT);
  STATUS(morula_body_transform(body, NAN, NULL, NULL, 0, &none), MORULA_STATUS_NOT_FINITE);
  STATUS(morula_body_copy_masses(body, SPHERES - 1, others), MORULA_STATUS_BUFFER_TOO_SMALL);
  STATUS(morula_body_copy_spheres(body, 5, SPHERES, xyzr), MORULA_STATUS_INVALID_ARGUMENT);
  STATUS(morula_body_write(body, 99, NULL, "none"), MORULA_STATUS_INVALID_ARGUMENT);
  STATUS(morula_body_write(body, MORULA_EXPORT_CSV, NULL, NULL), MORULA_STATUS_NULL_POINTER);
  STATUS(morula_body_write(body, MORULA_EXPORT_CSV, NULL, "no_such_folder/a.csv"),
         MORULA_STATUS_IO);
  contact.young = -1;
  STATUS(morula_body_timestep(body, &contact, &soft), MORULA_STATUS_INVALID_ARGUMENT);
  STATUS(morula_body_timestep(body, NULL, &soft), MORULA_STATUS_NULL_POINTER);
  STATUS(morula_clump_timestep(clump, NULL, NULL, &soft), MORULA_STATUS_NULL_POINTER);
  STATUS(morula_clump_timestep(NULL, NULL, &contact, &soft), MORULA_STATUS_NULL_POINTER);
  STATUS(morula_clump_transform(clump, NULL, -1, NULL, NULL, &none),
         MORULA_STATUS_INVALID_ARGUMENT);
  STATUS(morula_clump_transform(clump, NULL, 1, NULL, NULL, NULL), MORULA_STATUS_NULL_POINTER);
  CHECK(none == NULL);
  /* Made without moments: its union can be weighed, its target not. */
  morula_clump *bare = NULL;
  clump_options.wants = MORULA_WANT_NOTHING;
  OK(morula_clump_from_solid(solid, &clump_options, &bare));
  STATUS(morula_body_from_clump(bare, &options, &none), MORULA_STATUS_NOT_WANTED);
  o = options;
  o.target = MORULA_TARGET_UNION;
  OK(morula_body_from_clump(bare, &o, &none));
  holds(none);
  morula_body_free(none);
  morula_clump_free(bare);
  morula_body_free(NULL);
  morula_files_free(NULL);

  morula_body_free(body);
  morula_clump_free(clump);
  morula_solid_free(solid);
  morula_shape_free(shape);
  return checks_done();
}
