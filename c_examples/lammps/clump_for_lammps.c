/* A mesh as a molecule template of LAMMPS, and what LAMMPS made of it.
 *
 *   clump_for_lammps make MESH TEMPLATE BODY    writes the template, and mass and moments to BODY
 *   clump_for_lammps check BODY DUMP THERMO     compares with what LAMMPS reports
 *
 * DUMP holds the last lines of compute rigid/local: index, id, mass and three moments of each body.
 * THERMO holds the total mass and the trace of the inertia, added up over all bodies. */
#include <math.h>
#include <morula.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define BODIES 8         /* that in.elbows pours */
#define DENSITY 1200.0  /* kg/m^3 */
#define TOLERANCE 1e-12 /* relative: LAMMPS reads the 17 digits of the template and adds up */

static int failed;

static void stop(const char *what) {
  fprintf(stderr, "%s: %s\n", what, morula_last_error_message());
  exit(1);
}

static FILE *open_or_stop(const char *path, const char *mode) {
  FILE *file = fopen(path, mode);
  if (!file) {
    perror(path);
    exit(1);
  }
  return file;
}

static void make(const char *mesh, const char *template_path, const char *body_path) {
  morula_import_options units;
  morula_clump_options options;
  morula_mass_options masses;
  morula_export_options as;
  morula_shape *shape = NULL;
  morula_clump *clump = NULL;
  morula_body *body = NULL;
  morula_masses result = {0};
  morula_moments moments = {0};
  FILE *out;
  morula_import_options_init(&units, sizeof units);
  units.length_unit = 0.001; /* the mesh is in millimetres */
  morula_clump_options_init(&options, sizeof options);
  options.spheres = 24;
  morula_mass_options_init(&masses, sizeof masses);
  masses.density = DENSITY;
  morula_export_options_init(&as, sizeof as);
  as.name = "elbow";
  if (morula_shape_from_file(mesh, &units, NULL, &shape)) stop("the mesh");
  if (morula_clump_from_shape(shape, NULL, &options, &clump)) stop("the clump");
  if (morula_body_from_clump(clump, &masses, &body)) stop("the masses");
  if (morula_body_write(body, MORULA_EXPORT_LAMMPS, &as, template_path)) stop("the template");
  result.struct_size = sizeof result;
  moments.struct_size = sizeof moments;
  if (morula_body_masses(body, &result) || morula_body_moments(body, &moments)) stop("the body");
  printf("%s: mass %.9g kg, moments %.9g %.9g %.9g kg m^2, masses %s\n", mesh, moments.mass,
         moments.principal[0], moments.principal[1], moments.principal[2],
         morula_masses_status_name(result.status));
  out = open_or_stop(body_path, "w");
  fprintf(out, "%.17g %.17g %.17g %.17g\n", moments.mass, moments.principal[0],
          moments.principal[1], moments.principal[2]);
  fclose(out);
  morula_body_free(body);
  morula_clump_free(clump);
  morula_shape_free(shape);
}

static double near(const char *what, double is, double should_be) {
  const double error = fabs(is / should_be - 1);
  if (!(error <= TOLERANCE)) {
    failed = 1;
    fprintf(stderr, "%s is %.17g, not %.17g\n", what, is, should_be);
  }
  return error;
}

static int ascending(const void *a, const void *b) {
  const double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

static void check(const char *body_path, const char *dump_path, const char *thermo_path) {
  double body[4], got[4], mass = 0, trace = 0, total_mass, total_trace, worst = 0, e;
  int bodies = 0;
  char line[512];
  FILE *file = open_or_stop(body_path, "r");
  if (fscanf(file, "%lf %lf %lf %lf", body, body + 1, body + 2, body + 3) != 4) exit(1);
  fclose(file);
  file = open_or_stop(dump_path, "r");
  while (fgets(line, sizeof line, file)) {
    double id;
    int index;
    if (strncmp(line, "ITEM: TIMESTEP", 14) == 0) bodies = 0; /* the last step counts */
    if (bodies == 0) mass = trace = 0;
    if (sscanf(line, "%d %lf %lf %lf %lf %lf", &index, &id, got, got + 1, got + 2, got + 3) != 6)
      continue;
    bodies++;
    qsort(got + 1, 3, sizeof *got, ascending);
    for (int k = 0; k < 4; k++)
      if ((e = near(k ? "a moment of a body" : "the mass of a body", got[k], body[k])) > worst)
        worst = e;
    mass += got[0];
    trace += got[1] + got[2] + got[3];
  }
  fclose(file);
  if (bodies != BODIES) {
    fprintf(stderr, "%s holds %d bodies, not %d\n", dump_path, bodies, BODIES);
    exit(1);
  }
  file = open_or_stop(thermo_path, "r");
  if (fscanf(file, "%lf %lf", &total_mass, &total_trace) != 2) {
    fprintf(stderr, "%s holds no totals\n", thermo_path);
    exit(1);
  }
  fclose(file);
  near("the sum of the dumped masses", mass, bodies * body[0]);
  near("the total mass", total_mass, bodies * body[0]);
  near("the total trace of the inertia", total_trace, bodies * (body[1] + body[2] + body[3]));
  near("the sum of the dumped moments", trace, bodies * (body[1] + body[2] + body[3]));
  printf("%d bodies in LAMMPS: total mass %.12g kg (ours %.12g), total trace of inertia %.12g kg m^2 "
         "(ours %.12g); greatest relative error of a body's mass or moment %.1e\n",
         bodies, total_mass, bodies * body[0], total_trace,
         bodies * (body[1] + body[2] + body[3]), worst);
}

int main(int argc, char **argv) {
  if (argc == 5 && strcmp(argv[1], "make") == 0) {
    make(argv[2], argv[3], argv[4]);
  } else if (argc == 5 && strcmp(argv[1], "check") == 0) {
    check(argv[2], argv[3], argv[4]);
  } else {
    fprintf(stderr, "usage: %s make MESH TEMPLATE BODY | check BODY DUMP THERMO\n", argv[0]);
    return 2;
  }
  return failed;
}
