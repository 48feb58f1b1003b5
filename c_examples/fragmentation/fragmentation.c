/* A stone that breaks in the middle of a simulation, in C. The solver is a few lines (gravity and a
   floor); after each time step a handler looks whether something breaks, and replaces it at once.
   What is conserved and how long it took is printed. */
#include <math.h>
#include <morula.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

enum { MOST = 64, SPHERES = 64 };

/* A rigid body of spheres, in its body frame. */
typedef struct {
  double mass, principal[3], position[3], quaternion[4], velocity[3], angular_velocity[3];
  double xyzr[SPHERES][4], force;
  size_t spheres;
} particle;

/* Gravity, a floor at z = 0 with a linear spring and a dashpot, explicit steps. */
typedef struct {
  particle particles[MOST];
  size_t count;
  double step, time;
  const morula_parent *parent;
  double density, scale, strength;
  int breaks, sound;
} solver;

/* mass, momentum, angular momentum about the origin, kinetic energy */
typedef struct {
  double mass, momentum[3], angular[3], energy;
} totals;

/* Every call that fails says why and ends the program. */
static void ok(int32_t status) {
  if (status == MORULA_STATUS_OK) return;
  fprintf(stderr, "%s: %s\n", morula_status_name(status), morula_last_error_message());
  exit(1);
}

static double dot(const double a[3], const double b[3]) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
static void cross(const double a[3], const double b[3], double c[3]) {
  for (int i = 0; i < 3; i++) {
    int j = (i + 1) % 3, k = (i + 2) % 3;
    c[i] = a[j] * b[k] - a[k] * b[j];
  }
}
/* q v q*; backwards with sign = -1 */
static void turned(const double q[4], double sign, const double v[3], double to[3]) {
  double u[3] = {sign * q[1], sign * q[2], sign * q[3]}, t[3], s[3];
  cross(u, v, t);
  for (int i = 0; i < 3; i++) t[i] *= 2;
  cross(u, t, s);
  for (int i = 0; i < 3; i++) to[i] = v[i] + q[0] * t[i] + s[i];
}
static void spin(const particle *p, double to[3]) {
  double l[3];
  turned(p->quaternion, -1, p->angular_velocity, l);
  for (int i = 0; i < 3; i++) l[i] *= p->principal[i];
  turned(p->quaternion, 1, l, to);
}

static void add(totals *t, const particle *p) {
  double own[3], arm[3];
  spin(p, own);
  cross(p->position, p->velocity, arm);
  t->mass += p->mass;
  for (int i = 0; i < 3; i++) {
    t->momentum[i] += p->mass * p->velocity[i];
    t->angular[i] += own[i] + p->mass * arm[i];
  }
  t->energy += 0.5 * p->mass * dot(p->velocity, p->velocity) + 0.5 * dot(own, p->angular_velocity);
}

static void move(const solver *s, particle *p) {
  double force[3] = {0, 0, -9.81 * p->mass}, torque[3] = {0, 0, 0}, w[3], t[3], l[3], gyro[3];
  p->force = 0;
  for (size_t i = 0; i < p->spheres; i++) {
    double arm[3], lever[3], surface[3], more[3];
    turned(p->quaternion, 1, p->xyzr[i], arm);
    double deep = p->xyzr[i][3] - (p->position[2] + arm[2]);
    if (deep <= 0) continue;
    for (int a = 0; a < 3; a++) lever[a] = arm[a] - (a == 2 ? p->xyzr[i][3] : 0);
    cross(p->angular_velocity, lever, surface);
    double push = fmax(0, 1e5 * deep - 20 * (p->velocity[2] + surface[2]));
    double up[3] = {0, 0, push};
    cross(lever, up, more);
    force[2] += push;
    for (int a = 0; a < 3; a++) torque[a] += more[a];
    p->force += push;
  }
  /* Euler's equations in the body frame. */
  turned(p->quaternion, -1, p->angular_velocity, w);
  turned(p->quaternion, -1, torque, t);
  for (int a = 0; a < 3; a++) l[a] = p->principal[a] * w[a];
  cross(w, l, gyro);
  for (int a = 0; a < 3; a++) w[a] += s->step * (t[a] - gyro[a]) / p->principal[a];
  turned(p->quaternion, 1, w, p->angular_velocity);
  for (int a = 0; a < 3; a++) {
    p->velocity[a] += s->step / p->mass * force[a];
    p->position[a] += s->step * p->velocity[a];
  }
  double *q = p->quaternion, u[3] = {q[1], q[2], q[3]}, half[3], turn[3], norm = 0;
  for (int a = 0; a < 3; a++) half[a] = 0.5 * s->step * p->angular_velocity[a];
  cross(half, u, turn);
  double next[4] = {q[0] - dot(half, u), 0, 0, 0};
  for (int a = 0; a < 3; a++) next[a + 1] = q[a + 1] + q[0] * half[a] + turn[a];
  for (int a = 0; a < 4; a++) norm += next[a] * next[a];
  for (int a = 0; a < 4; a++) q[a] = next[a] / sqrt(norm);
}

static void say(solver *s, const char *what, double error, double most) {
  printf("  %-26s %.1e\n", what, error);
  if (!(error <= most)) s->sound = 0;
}
static double off(const double a[3], const double b[3]) {
  double d[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
  return sqrt(dot(d, d) / dot(a, a));
}

static particle taken(const morula_fragment *f) {
  particle p = {.mass = f->mass};
  for (int a = 0; a < 3; a++) {
    p.principal[a] = f->principal[a];
    p.position[a] = f->position[a];
    p.velocity[a] = f->velocity[a];
    p.angular_velocity[a] = f->angular_velocity[a];
  }
  for (int a = 0; a < 4; a++) p.quaternion[a] = f->quaternion[a];
  return p;
}

/* Breaks a particle when the floor pushes it too hard. */
static void actions_after_time_step(solver *s) {
  if (s->breaks > 0 || s->count == 0 || s->particles[0].force < s->strength) return;
  const particle old = s->particles[0];
  morula_break_options options;
  ok(morula_break_options_init(&options, sizeof options));
  options.cells = 6;
  options.seed = 7;
  options.spheres = 20;
  morula_held held = {.struct_size = sizeof held};
  morula_fragments *fragments = NULL;
  struct timespec start, end;
  timespec_get(&start, TIME_UTC);
  ok(morula_parent_held(s->parent, s->density, s->scale, old.position, old.quaternion, old.velocity,
                        old.angular_velocity, &held));
  ok(morula_parent_break(s->parent, NULL, 0, &held, &options, &fragments));
  timespec_get(&end, TIME_UTC);
  size_t count = 0, dust = 0;
  ok(morula_fragments_count(fragments, &count));
  ok(morula_fragments_dust_count(fragments, &dust));
  double took = 1e3 * (double)(end.tv_sec - start.tv_sec) + 1e-6 * (double)(end.tv_nsec - start.tv_nsec);
  printf("t = %.4f s: %zu fragments and %zu pieces of dust in %.2f ms\n", s->time, count, dust, took);
  s->breaks++;
  s->count--;
  for (size_t i = 0; i < s->count; i++) s->particles[i] = s->particles[i + 1];
  totals before = {0}, after = {0};
  add(&before, &old);
  static double world[MOST][SPHERES][4];
  size_t first = s->count;
  for (size_t i = 0; i < count && s->count < MOST; i++) {
    morula_fragment f = {.struct_size = sizeof f};
    ok(morula_fragments_get(fragments, i, &f));
    particle p = taken(&f);
    p.spheres = (size_t)f.sphere_count;
    ok(morula_fragments_copy_spheres(fragments, i, MORULA_FRAME_BODY, SPHERES, p.xyzr[0]));
    ok(morula_fragments_copy_spheres(fragments, i, MORULA_FRAME_WORLD, SPHERES, world[i][0]));
    add(&after, &p);
    printf("  mass %.4f, %2zu spheres, coverage %.3f, time step x %.2f\n", p.mass, p.spheres,
           f.coverage, f.step_factor);
    s->particles[s->count++] = p;
  }
  /* A solver may keep the dust; here it is only counted. */
  for (size_t i = 0; i < dust; i++) {
    morula_fragment f = {.struct_size = sizeof f};
    ok(morula_fragments_dust(fragments, i, &f));
    particle p = taken(&f);
    add(&after, &p);
  }
  morula_fragments_free(fragments);
  say(s, "relative error of mass", fabs(after.mass / before.mass - 1), 1e-12);
  say(s, "of momentum", off(before.momentum, after.momentum), 1e-12);
  say(s, "of angular momentum", off(before.angular, after.angular), 1e-11);
  say(s, "of kinetic energy", fabs(after.energy / before.energy - 1), 1e-11);
  double deepest = -1e300;
  for (size_t i = 0; i < count; i++)
    for (size_t j = 0; j < i; j++)
      for (size_t a = 0; a < s->particles[first + i].spheres; a++)
        for (size_t b = 0; b < s->particles[first + j].spheres; b++) {
          const double *x = world[i][a], *y = world[j][b];
          double d[3] = {x[0] - y[0], x[1] - y[1], x[2] - y[2]};
          deepest = fmax(deepest, x[3] + y[3] - sqrt(dot(d, d)));
        }
  say(s, "deepest overlap of siblings", deepest, 1e-15);
}

int main(void) {
  static solver s = {.step = 1e-5, .sound = 1, .density = 2600, .scale = 0.05};
  morula_shape *shape = NULL;
  morula_solid *solid = NULL;
  morula_clump *clump = NULL;
  morula_parent *parent = NULL;
  morula_clump_options options;
  ok(morula_shape_from_primitive("stone", NULL, NULL, 0, 64, 0, NULL, &shape));
  ok(morula_solid_from_shape(shape, NULL, &solid));
  ok(morula_clump_options_init(&options, sizeof options));
  options.spheres = 40;
  options.method = MORULA_METHOD_INSCRIBED;
  options.frame = MORULA_FRAME_BODY;
  ok(morula_clump_from_solid(solid, &options, &clump));
  ok(morula_parent_from_clump(solid, clump, 1, &parent));

  /* The stone as this solver holds it: its spheres in the body frame, five centimetres in size. */
  particle *stone = &s.particles[s.count++];
  morula_held held = {.struct_size = sizeof held};
  morula_moments m = {.struct_size = sizeof m};
  ok(morula_parent_held(parent, s.density, s.scale, NULL, NULL, NULL, NULL, &held));
  ok(morula_solid_moments(solid, s.density, &m));
  stone->mass = held.mass;
  for (int a = 0; a < 3; a++) stone->principal[a] = m.principal[a] * pow(s.scale, 5);
  ok(morula_clump_sphere_count(clump, &stone->spheres));
  ok(morula_clump_copy_spheres(clump, SPHERES, stone->xyzr[0]));
  for (size_t i = 0; i < stone->spheres; i++)
    for (int a = 0; a < 4; a++) stone->xyzr[i][a] *= s.scale;
  const double position[3] = {0, 0, 0.3}, velocity[3] = {0.5, 0, -3}, turn[3] = {4, -7, 2};
  for (int a = 0; a < 3; a++) {
    stone->position[a] = position[a];
    stone->velocity[a] = velocity[a];
    stone->angular_velocity[a] = turn[a];
  }
  stone->quaternion[0] = 1;

  s.parent = parent;
  s.strength = 60 * stone->mass * 9.81;
  for (int i = 0; i < 20000; i++, s.time += s.step) {
    for (size_t k = 0; k < s.count; k++) move(&s, &s.particles[k]);
    actions_after_time_step(&s);
  }
  printf("t = %.4f s: %zu particles\n", s.time, s.count);
  int fine = s.breaks == 1 && s.sound && s.count >= 4;
  for (size_t k = 0; k < s.count; k++) fine = fine && fabs(s.particles[k].position[2]) < 1;
  puts(fine ? "all is well" : "NOT as it should be");
  morula_parent_free(parent);
  morula_clump_free(clump);
  morula_solid_free(solid);
  morula_shape_free(shape);
  return fine ? 0 : 1;
}
