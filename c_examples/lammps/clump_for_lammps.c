/* A mesh as a molecule template of LAMMPS, and what LAMMPS made of it.
 *
 *   clump_for_lammps make MESH TEMPLATE BODY SPHERES
 *     writes the template; and mass, moments, the error of the inertia of the spheres' masses and the
 *     centres of the spheres in the body frame to BODY
 *   clump_for_lammps check BODY DUMP ATOMS THERMO [added]
 *     compares with what LAMMPS reports; with `added` it has added the moments up over the spheres
 *
 * DUMP holds the last lines of compute rigid/local: index, id, mass, three moments and centre of each body,
 * ATOMS id and place of each atom. THERMO holds the total mass and the trace of the inertia, added up over
 * all bodies. */
#include <math.h>
#include <morula.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define BODIES 8         /* that in.elbows pours */
#define DENSITY 1200.0  /* kg/m^3 */
#define MOST 64         /* spheres of a body */
#define TOLERANCE 1e-12 /* relative: LAMMPS reads the 17 digits of the template and adds up */
#define OF_CENTRE 1e-12 /* of the radius of gyration: LAMMPS places the spheres about its centre */

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

static void make(const char *mesh, const char *template_path, const char *body_path, int spheres) {
  morula_import_options units;
  morula_clump_options options;
  morula_mass_options masses;
  morula_export_options as;
  morula_shape *shape = NULL;
  morula_clump *clump = NULL;
  morula_body *body = NULL;
  morula_masses result = {0};
  morula_moments moments = {0};
  double xyzr[MOST][4];
  size_t n = 0;
  FILE *out;
  if (morula_import_options_init(&units, sizeof units) ||
      morula_clump_options_init(&options, sizeof options) ||
      morula_mass_options_init(&masses, sizeof masses) || morula_export_options_init(&as, sizeof as))
    stop("options");
  units.length_unit = 0.001; /* the mesh is in millimetres */
  options.spheres = (uint64_t)spheres;
  masses.density = DENSITY;
  as.name = "elbow";
  if (morula_shape_from_file(mesh, &units, NULL, &shape)) stop("the mesh");
  if (morula_clump_from_shape(shape, NULL, &options, &clump)) stop("the clump");
  if (morula_body_from_clump(clump, &masses, &body)) stop("the masses");
  if (morula_body_write(body, MORULA_EXPORT_LAMMPS, &as, template_path)) stop("the template");
  result.struct_size = sizeof result;
  moments.struct_size = sizeof moments;
  if (morula_body_masses(body, &result) || morula_body_moments(body, &moments) ||
      morula_body_sphere_count(body, &n) ||
      morula_body_copy_spheres(body, MORULA_FRAME_BODY, MOST, xyzr[0]))
    stop("the body");
  printf("%s: mass %.9g kg, moments %.9g %.9g %.9g kg m^2, masses %s\n", mesh, moments.mass,
         moments.principal[0], moments.principal[1], moments.principal[2],
         morula_masses_status_name(result.status));
  out = open_or_stop(body_path, "w");
  int wrong = fprintf(out, "%.17g %.17g %.17g %.17g %.17g %d\n", moments.mass, moments.principal[0],
                      moments.principal[1], moments.principal[2], result.inertia_residual, (int)n) < 0;
  for (size_t i = 0; i < n; i++)
    wrong |= fprintf(out, "%.17g %.17g %.17g\n", xyzr[i][0], xyzr[i][1], xyzr[i][2]) < 0;
  if (fclose(out) || wrong) {
    perror(body_path);
    exit(1);
  }
  morula_body_free(body);
  morula_clump_free(clump);
  morula_shape_free(shape);
}

static double near(const char *what, double is, double should_be, double tolerance) {
  const double error = fabs(is / should_be - 1);
  if (!(error <= tolerance)) {
    failed = 1;
    fprintf(stderr, "%s is %.17g, not %.17g\n", what, is, should_be);
  }
  return error;
}

static int ascending(const void *a, const void *b) {
  const double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

struct body {
  double mass, moments[3], error, spheres[MOST][3];
  int count;
};

static void read_body(const char *path, struct body *b) {
  FILE *file = open_or_stop(path, "r");
  double *m = b->moments;
  int good = fscanf(file, "%lf %lf %lf %lf %lf %d", &b->mass, m, m + 1, m + 2, &b->error, &b->count) == 6 &&
             b->count > 0 && b->count <= MOST;
  for (int i = 0; good && i < b->count; i++) {
    double *s = b->spheres[i];
    good = fscanf(file, "%lf %lf %lf", s, s + 1, s + 2) == 3;
  }
  fclose(file);
  if (!good) {
    fprintf(stderr, "%s is no body\n", path);
    exit(1);
  }
}

/* Places by the number of the atom; a template's are one after another. */
static void read_atoms(const char *path, int count, double (*places)[3]) {
  char line[512];
  int found = 0;
  FILE *file = open_or_stop(path, "r");
  while (fgets(line, sizeof line, file)) {
    double x, y, z;
    int id;
    if (strncmp(line, "ITEM: TIMESTEP", 14) == 0) found = 0; /* the last step counts */
    if (sscanf(line, "%d %lf %lf %lf", &id, &x, &y, &z) != 4 || id < 1 || id > count) continue;
    places[id - 1][0] = x, places[id - 1][1] = y, places[id - 1][2] = z;
    found++;
  }
  fclose(file);
  if (found != count) {
    fprintf(stderr, "%s holds %d atoms, not %d\n", path, found, count);
    exit(1);
  }
}

static double length(const double a[3], const double b[3]) {
  double sum = 0;
  for (int k = 0; k < 3; k++) sum += (a[k] - b[k]) * (a[k] - b[k]);
  return sqrt(sum);
}

static void check(const char *body_path, const char *dump_path, const char *atoms_path,
                  const char *thermo_path, int added) {
  static struct body body;
  static double places[BODIES * MOST][3];
  static const double origin[3] = {0, 0, 0};
  double mass = 0, trace = 0, total_mass, total_trace, worst = 0, off = 0, e;
  int bodies = 0;
  char line[512];
  read_body(body_path, &body);
  read_atoms(atoms_path, BODIES * body.count, places);
  /* Of D (1 + E) D, D^2 the moments and no entry of E above the error, each moment is within three times
   * the error. */
  const double of_moments = added ? TOLERANCE + 3 * body.error : TOLERANCE;
  const double gyration = sqrt(body.moments[2] / body.mass);
  FILE *file = open_or_stop(dump_path, "r");
  while (fgets(line, sizeof line, file)) {
    double id, got[7];
    int index;
    if (strncmp(line, "ITEM: TIMESTEP", 14) == 0) bodies = 0; /* the last step counts */
    if (bodies == 0) mass = trace = 0;
    if (sscanf(line, "%d %lf %lf %lf %lf %lf %lf %lf %lf", &index, &id, got, got + 1, got + 2, got + 3,
               got + 4, got + 5, got + 6) != 9)
      continue;
    bodies++;
    qsort(got + 1, 3, sizeof *got, ascending);
    near("the mass of a body", got[0], body.mass, TOLERANCE);
    for (int k = 0; k < 3; k++)
      if ((e = near("a moment of a body", got[1 + k], body.moments[k], of_moments)) > worst) worst = e;
    mass += got[0];
    trace += got[1] + got[2] + got[3];
    /* Its centre: each sphere is as far from it as from ours. */
    const int first = ((int)id - 1) / body.count * body.count;
    for (int i = 0; i < body.count; i++) {
      e = fabs(length(places[first + i], got + 4) - length(body.spheres[i], origin)) / gyration;
      if (e > off) off = e;
    }
  }
  fclose(file);
  if (bodies != BODIES) {
    fprintf(stderr, "%s holds %d bodies, not %d\n", dump_path, bodies, BODIES);
    exit(1);
  }
  if (!(off <= OF_CENTRE)) {
    failed = 1;
    fprintf(stderr, "the centre of a body is %.1e radii of gyration off\n", off);
  }
  file = open_or_stop(thermo_path, "r");
  if (fscanf(file, "%lf %lf", &total_mass, &total_trace) != 2) {
    fprintf(stderr, "%s holds no totals\n", thermo_path);
    exit(1);
  }
  fclose(file);
  const double all = body.moments[0] + body.moments[1] + body.moments[2];
  near("the sum of the dumped masses", mass, bodies * body.mass, TOLERANCE);
  near("the total mass", total_mass, bodies * body.mass, TOLERANCE);
  near("the total trace of the inertia", total_trace, bodies * all, of_moments);
  near("the sum of the dumped moments", trace, bodies * all, of_moments);
  printf("%d bodies of %d spheres in LAMMPS, %s: total mass %.12g kg (ours %.12g), total trace of inertia "
         "%.12g kg m^2 (ours %.12g); greatest relative error of a moment %.1e (%.1e allowed), of the centre "
         "%.1e radii of gyration\n",
         bodies, body.count, added ? "added up over spheres" : "from the head of the template", total_mass,
         bodies * body.mass, total_trace, bodies * all, worst, of_moments, off);
}

int main(int argc, char **argv) {
  if (argc == 6 && strcmp(argv[1], "make") == 0) {
    make(argv[2], argv[3], argv[4], atoi(argv[5]));
  } else if ((argc == 6 || (argc == 7 && strcmp(argv[6], "added") == 0)) && strcmp(argv[1], "check") == 0) {
    check(argv[2], argv[3], argv[4], argv[5], argc == 7);
  } else {
    fprintf(stderr, "usage: %s make MESH TEMPLATE BODY SPHERES | check BODY DUMP ATOMS THERMO [added]\n",
            argv[0]);
    return 2;
  }
  return failed;
}
