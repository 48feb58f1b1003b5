/* Breaks a stone: what is conserved, what keeps apart, and what is refused. */
#include "check.h"

#include <stdlib.h>

/* Mass, momentum and angular momentum of all pieces about the held centre, against the body's. */
static void conserves(const morula_fragments *all, const morula_held *held) {
  size_t count[2] = {0, 0};
  double mass = 0, p[3] = {0, 0, 0}, l[3] = {0, 0, 0}, energy = 0, size = 0, speed = 0;
  OK(morula_fragments_count(all, &count[0]));
  OK(morula_fragments_dust_count(all, &count[1]));
  CHECK(count[0] > 0);
  for (int kind = 0; kind < 2; kind++)
    for (size_t i = 0; i < count[kind]; i++) {
      morula_fragment f = {.struct_size = sizeof f};
      if (kind == 0)
        OK(morula_fragments_get(all, i, &f));
      else
        OK(morula_fragments_dust(all, i, &f));
      mass += f.mass;
      double at[3], v[3], own[3], w = f.quaternion[0], spin[3] = {0, 0, 0};
      for (int a = 0; a < 3; a++) {
        at[a] = f.position[a] - held->position[a];
        v[a] = f.velocity[a];
        p[a] += f.mass * v[a];
      }
      /* The spin along the body axes, times the principal moments, and back. */
      double x = f.quaternion[1], y = f.quaternion[2], z = f.quaternion[3];
      double turn[3][3] = {{1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)},
                           {2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)},
                           {2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)}};
      for (int b = 0; b < 3; b++) {
        own[b] = 0;
        for (int a = 0; a < 3; a++) own[b] += turn[a][b] * f.angular_velocity[a];
        energy += 0.5 * f.principal[b] * own[b] * own[b] + 0.5 * f.mass * v[b] * v[b];
        own[b] *= f.principal[b];
        for (int a = 0; a < 3; a++) spin[a] += turn[a][b] * own[b];
      }
      for (int a = 0; a < 3; a++) {
        int b = (a + 1) % 3, c = (a + 2) % 3;
        double d[3];
        for (int k = 0; k < 3; k++) d[k] = v[k] - held->velocity[k];
        l[a] += f.mass * (at[b] * d[c] - at[c] * d[b]) + spin[a];
      }
    }
  CHECK(fabs(mass / held->mass - 1) < 1e-12);
  for (int a = 0; a < 3; a++) speed = fmax(speed, fabs(held->velocity[a]));
  for (int a = 0; a < 3; a++) NEAR(p[a], held->mass * held->velocity[a], 1e-12 * held->mass * (speed + 1));
  /* The body's own, with its inertia along the axes of the shape. */
  double w = held->quaternion[0], x = held->quaternion[1], y = held->quaternion[2],
         z = held->quaternion[3], n = w * w + x * x + y * y + z * z, s = 2 / n;
  double turn[3][3] = {{1 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y)},
                       {s * (x * y + w * z), 1 - s * (x * x + z * z), s * (y * z - w * x)},
                       {s * (x * z - w * y), s * (y * z + w * x), 1 - s * (x * x + y * y)}};
  const double *i = held->inertia;
  double tensor[3][3] = {{i[0], i[3], i[4]}, {i[3], i[1], i[5]}, {i[4], i[5], i[2]}};
  double own[3] = {0, 0, 0}, moment[3] = {0, 0, 0}, whole[3] = {0, 0, 0}, kinetic = 0;
  for (int b = 0; b < 3; b++)
    for (int a = 0; a < 3; a++) own[b] += turn[a][b] * held->angular_velocity[a];
  for (int a = 0; a < 3; a++)
    for (int b = 0; b < 3; b++) moment[a] += tensor[a][b] * own[b];
  for (int a = 0; a < 3; a++) {
    for (int b = 0; b < 3; b++) whole[a] += turn[a][b] * moment[b];
    kinetic += 0.5 * own[a] * moment[a] + 0.5 * held->mass * held->velocity[a] * held->velocity[a];
    size = fmax(size, fabs(whole[a]));
  }
  for (int a = 0; a < 3; a++) NEAR(l[a], whole[a], 1e-12 * (size + 1));
  morula_break_totals totals = {.struct_size = sizeof totals};
  OK(morula_fragments_totals(all, &totals));
  NEAR(energy - kinetic, totals.energy, 1e-12 * (kinetic + 1));
}

/* The spheres of a fragment, in one frame. */
static double *spheres_of(const morula_fragments *all, size_t index, int32_t frame, size_t *n) {
  morula_fragment f = {.struct_size = sizeof f};
  OK(morula_fragments_get(all, index, &f));
  *n = (size_t)f.sphere_count;
  double *xyzr = malloc(4 * *n * sizeof *xyzr);
  OK(morula_fragments_copy_spheres(all, index, frame, *n, xyzr));
  STATUS(morula_fragments_copy_spheres(all, index, frame, *n - 1, xyzr),
         MORULA_STATUS_BUFFER_TOO_SMALL);
  return xyzr;
}

/* The deepest overlap of spheres of two fragments. */
static double overlap(const morula_fragments *all, int32_t frame) {
  size_t count = 0, n, m;
  double most = -1e300;
  OK(morula_fragments_count(all, &count));
  for (size_t i = 0; i < count; i++)
    for (size_t j = 0; j < i; j++) {
      double *a = spheres_of(all, i, frame, &n), *b = spheres_of(all, j, frame, &m);
      for (size_t s = 0; s < n; s++)
        for (size_t t = 0; t < m; t++) {
          double x = a[4 * s] - b[4 * t], y = a[4 * s + 1] - b[4 * t + 1],
                 z = a[4 * s + 2] - b[4 * t + 2];
          most = fmax(most, a[4 * s + 3] + b[4 * t + 3] - sqrt(x * x + y * y + z * z));
        }
      free(a);
      free(b);
    }
  return most;
}

/* What can be asked of one fragment. */
static void look_at(const morula_fragments *all, size_t index, size_t parent_spheres, double scale) {
  size_t n = 0;
  double *input = spheres_of(all, index, MORULA_FRAME_INPUT, &n), volume = 0;
  double *grown = malloc(4 * n * sizeof *grown);
  morula_fragment f = {.struct_size = sizeof f};
  OK(morula_fragments_get(all, index, &f));
  CHECK(f.volume > 0 && f.coverage > 0.3 && f.coverage < 1 && f.volume_share < f.coverage);
  CHECK(f.step_factor > 0 && f.step_factor <= 1.5);
  CHECK(f.stopped == MORULA_STOPPED_SPHERES || f.stopped == MORULA_STOPPED_EXHAUSTED);
  uint32_t *starts = malloc((n + 1) * sizeof *starts);
  uint32_t *parents = malloc((size_t)f.map_count * sizeof *parents);
  double *shares = malloc((size_t)f.map_count * sizeof *shares);
  OK(morula_fragments_copy_map(all, index, starts, (size_t)f.map_count, parents, shares));
  CHECK(starts[0] == 0 && starts[n] == f.map_count && f.map_count >= n);
  for (size_t i = 0; i < f.map_count; i++) CHECK(parents[i] < parent_spheres && shares[i] > 0);
  double *planes = malloc(4 * (size_t)f.half_space_count * sizeof *planes);
  OK(morula_fragments_copy_half_spaces(all, index, (size_t)f.half_space_count, planes));
  for (size_t i = 0; i < f.half_space_count; i++)
    for (size_t s = 0; s < n; s++) {
      const double *p = planes + 4 * i, *c = input + 4 * s;
      CHECK(p[0] * c[0] + p[1] * c[1] + p[2] * c[2] + c[3] <= p[3]);
    }
  OK(morula_fragments_grow(all, index, 0.5, NULL, 0, 0, MORULA_FRAME_INPUT, n, grown));
  for (size_t s = 0; s < n; s++) {
    CHECK(grown[4 * s + 3] >= input[4 * s + 3]);
    volume += grown[4 * s + 3] - input[4 * s + 3];
  }
  CHECK(volume > 0);
  STATUS(morula_fragments_grow(all, index, 2, NULL, 0, 0, MORULA_FRAME_INPUT, n, grown),
         MORULA_STATUS_INVALID_ARGUMENT);
  STATUS(morula_fragments_copy_masses(all, index, n, grown), MORULA_STATUS_NOT_WANTED);
  morula_shape *surface = NULL;
  morula_moments m = {.struct_size = sizeof m};
  OK(morula_fragments_shape(all, index, &surface));
  OK(morula_shape_moments(surface, f.mass / f.volume, &m));
  NEAR(m.mass / f.mass, 1, 1e-10);
  for (int a = 0; a < 3; a++) NEAR(scale * scale * m.principal[a] / f.principal[a], 1, 1e-9);
  morula_shape_free(surface);
  free(input), free(grown), free(starts), free(parents), free(shares), free(planes);
}

int main(void) {
  morula_shape *shape = NULL;
  morula_solid *solid = NULL, *other = NULL;
  morula_clump *clump = NULL;
  morula_parent *parent = NULL, *bare = NULL;
  morula_fragments *broken = NULL, *again = NULL;
  OK(morula_shape_from_primitive("stone", NULL, NULL, 0, 30, 0, NULL, &shape));
  OK(morula_solid_from_shape(shape, NULL, &solid));
  morula_clump_options spheres;
  OK(morula_clump_options_init(&spheres, sizeof spheres));
  spheres.spheres = 40;
  spheres.method = MORULA_METHOD_INSCRIBED;
  spheres.effort = MORULA_EFFORT_DRAFT;
  OK(morula_clump_from_solid(solid, &spheres, &clump));
  OK(morula_parent_from_clump(solid, clump, 1, &parent));
  morula_shape *l = l_shape();
  OK(morula_solid_from_shape(l, NULL, &other));
  STATUS(morula_parent_from_clump(other, clump, 1, &bare), MORULA_STATUS_INVALID_ARGUMENT);
  OK(morula_parent_from_solid(other, NULL, 0, 1, &bare));
  uint64_t bytes = 0;
  OK(morula_parent_bytes(parent, &bytes));
  CHECK(bytes > 1000);

  /* A body in the world, smaller than its shape, as a solver holds it in its body frame. */
  const double position[3] = {3, -2, 1}, turn[4] = {0.9, 0.1, -0.3, 0.2};
  const double velocity[3] = {1, 2, -4}, spin[3] = {5, -3, 8};
  morula_held held = {.struct_size = sizeof held};
  OK(morula_parent_held(parent, 2600, 0.25, position, turn, velocity, spin, &held));
  morula_break_options options;
  OK(morula_break_options_init(&options, sizeof options));
  options.cells = 6;
  options.seed = 4;
  OK(morula_parent_break(parent, NULL, 0, &held, &options, &broken));
  morula_clump_free(clump), morula_solid_free(solid), morula_shape_free(shape);
  conserves(broken, &held);
  CHECK(overlap(broken, MORULA_FRAME_INPUT) <= 0);
  CHECK(overlap(broken, MORULA_FRAME_WORLD) <= 1e-15);
  morula_break_totals totals = {.struct_size = sizeof totals};
  OK(morula_fragments_totals(broken, &totals));
  CHECK(totals.inertia_error < 1e-10);
  size_t count = 0;
  OK(morula_fragments_count(broken, &count));
  CHECK(count >= 5);
  for (size_t i = 0; i < count; i++) look_at(broken, i, 40, 0.25);

  /* A fragment breaks again, hit where it is, with masses for its spheres. */
  options.kind = MORULA_CUT_IMPACT;
  options.masses = 1;
  options.objective = MORULA_OBJECTIVE_MAX_MIN;
  options.cells = 3;
  morula_fragment first = {.struct_size = sizeof first};
  OK(morula_fragments_get(broken, 0, &first));
  memcpy(options.point, first.centre, sizeof options.point);
  OK(morula_fragments_held(broken, 0, NULL, NULL, NULL, NULL, &held));
  morula_held same = {.struct_size = sizeof same};
  OK(morula_fragments_held(broken, 0, NULL, first.quaternion, NULL, NULL, &same));
  double cosine = 0;
  for (int a = 0; a < 4; a++) cosine += held.quaternion[a] * same.quaternion[a];
  NEAR(fabs(cosine), 1, 1e-12);
  OK(morula_parent_break(parent, broken, 0, &held, &options, &again));
  conserves(again, &held);
  CHECK(overlap(again, MORULA_FRAME_INPUT) <= 0);
  double some[20];
  int32_t status = morula_fragments_copy_masses(again, 0, 20, some);
  CHECK(status == MORULA_STATUS_OK || status == MORULA_STATUS_NO_MASSES);
  morula_fragments_free(again);

  /* Many in one step: as one by one, on any threads; what fails does not stop the rest. */
  const morula_parent *parents[3] = {parent, NULL, parent};
  const morula_fragments *from[3] = {NULL, NULL, broken};
  const size_t indices[3] = {0, 0, 1};
  morula_held bodies[3];
  morula_break_options how[3];
  for (int i = 0; i < 3; i++) {
    bodies[i].struct_size = sizeof bodies[i];
    OK(morula_parent_held(parent, 2, 1, NULL, NULL, velocity, NULL, &bodies[i]));
    OK(morula_break_options_init(&how[i], sizeof how[i]));
    how[i].seed = (uint64_t)i;
  }
  OK(morula_fragments_held(broken, 1, NULL, NULL, NULL, NULL, &bodies[2]));
  morula_fragments *one[3] = {NULL, NULL, NULL}, *three[3] = {NULL, NULL, NULL};
  int32_t statuses[3];
  STATUS(morula_parents_break(parents, from, indices, bodies, how, 3, one, NULL),
         MORULA_STATUS_NULL_POINTER);
  CHECK(one[0] == NULL);
  STATUS(morula_parents_break(parents, from, indices, bodies, how, 3, one, statuses),
         MORULA_STATUS_NULL_POINTER);
  CHECK(one[0] && !one[1] && one[2] && statuses[1] == MORULA_STATUS_NULL_POINTER);
  how[0].threads = 3;
  STATUS(morula_parents_break(parents, from, indices, bodies, how, 3, three, statuses),
         MORULA_STATUS_NULL_POINTER);
  for (int i = 0; i < 3; i += 2) {
    size_t n = 0, m = 0;
    double *a = spheres_of(one[i], 0, MORULA_FRAME_BODY, &n);
    double *b = spheres_of(three[i], 0, MORULA_FRAME_BODY, &m);
    CHECK(n == m && memcmp(a, b, 4 * n * sizeof *a) == 0);
    conserves(three[i], &bodies[i]);
    free(a), free(b);
    morula_fragments_free(one[i]);
    morula_fragments_free(three[i]);
  }

  /* Deadlines that have passed give coarse clumps; planes that miss are told. */
  OK(morula_parent_held(bare, 2, 1, NULL, NULL, NULL, NULL, &held));
  OK(morula_break_options_init(&options, sizeof options));
  double planes[8] = {1, 0, 0, L_CENTRE[0], 0, 1, 0, 1000};
  options.kind = MORULA_CUT_PLANES;
  options.half_spaces = planes;
  options.half_space_count = 2;
  options.deadline_seconds = 1e-9;
  OK(morula_parent_break(bare, NULL, 0, &held, &options, &again));
  conserves(again, &held);
  morula_fragment f = {.struct_size = sizeof f};
  OK(morula_fragments_get(again, 0, &f));
  CHECK(f.sphere_count > 0 && f.stopped == MORULA_STOPPED_DEADLINE && f.step_factor == 0);
  OK(morula_fragments_note_count(again, &count));
  CHECK(count == 1);
  char text[200];
  OK(morula_fragments_copy_note(again, 0, sizeof text, text, NULL));
  CHECK(strstr(text, "half-space 1") != NULL);
  STATUS(morula_fragments_get(again, 99, &f), MORULA_STATUS_INDEX_OUT_OF_RANGE);
  STATUS(morula_fragments_dust(again, 0, &f), MORULA_STATUS_INDEX_OUT_OF_RANGE);
  STATUS(morula_parent_break(parent, again, 0, &held, NULL, &again),
         MORULA_STATUS_INVALID_ARGUMENT);
  morula_fragments_free(again);

  /* A flat pressed into the L: new spheres, the old mass and motion. */
  options.deadline_seconds = 0;
  planes[3] = 12.5;
  double old[8] = {10.5, 20.5, 30.5, 0.5, 11.5, 20.5, 30.5, 0.5};
  OK(morula_reclump_shape(other, old, 2, &held, &options, &again));
  conserves(again, &held);
  morula_fragments_free(again);

  /* Refused, with nothing written. */
  again = NULL;
  morula_held bad = held;
  bad.mass = -1;
  STATUS(morula_parent_break(bare, NULL, 0, &bad, &options, &again),
         MORULA_STATUS_INVALID_ARGUMENT);
  bad = held, bad.velocity[1] = NAN;
  STATUS(morula_parent_break(bare, NULL, 0, &bad, &options, &again), MORULA_STATUS_NOT_FINITE);
  bad = held, bad.struct_size = 3;
  STATUS(morula_parent_break(bare, NULL, 0, &bad, &options, &again), MORULA_STATUS_STRUCT_SIZE);
  STATUS(morula_parent_break(bare, NULL, 0, NULL, &options, &again), MORULA_STATUS_NULL_POINTER);
  STATUS(morula_parent_break(NULL, NULL, 0, &held, &options, &again), MORULA_STATUS_NULL_POINTER);
  planes[4] = planes[5] = 0;
  STATUS(morula_parent_break(bare, NULL, 0, &held, &options, &again),
         MORULA_STATUS_INVALID_ARGUMENT);
  planes[5] = NAN;
  STATUS(morula_parent_break(bare, NULL, 0, &held, &options, &again),
         MORULA_STATUS_INVALID_ARGUMENT);
  planes[5] = 1, options.spheres = 0;
  STATUS(morula_parent_break(bare, NULL, 0, &held, &options, &again),
         MORULA_STATUS_INVALID_ARGUMENT);
  options.spheres = 5, options.min_radius = 10;
  STATUS(morula_parent_break(bare, NULL, 0, &held, &options, &again), MORULA_STATUS_NO_SPHERES);
  options.min_radius = 0, options.kind = 17;
  STATUS(morula_parent_break(bare, NULL, 0, &held, &options, &again),
         MORULA_STATUS_INVALID_ARGUMENT);
  old[3] = 0;
  STATUS(morula_parent_from_solid(other, old, 2, 1, &bare), MORULA_STATUS_INVALID_ARGUMENT);
  CHECK(again == NULL);
  morula_fragments_free(broken);
  morula_parent_free(parent);
  morula_parent_free(bare);
  morula_fragments_free(NULL);
  morula_parent_free(NULL);
  morula_solid_free(other);
  morula_shape_free(l);
  return checks_done();
}
