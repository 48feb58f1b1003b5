/* Before a number of spheres is chosen: what accuracy costs in time. */
#include "check.h"
#include <stdlib.h>

/* A point as a later header may have it. */
struct newer {
  morula_cost_point known;
  double later;
};

static int32_t stop_late(double fraction, void *user) {
  (void)user;
  return fraction > 0.5;
}

int main(void) {
  morula_shape *shape = NULL;
  morula_solid *solid = NULL;
  morula_cost *list = NULL;
  morula_clump_options how;
  morula_cost_options options;
  const uint64_t counts[5] = {1, 3, 8, 20, 50};
  OK(morula_shape_from_primitive("stone", NULL, NULL, 0, 0, 0, NULL, &shape));
  OK(morula_solid_from_shape(shape, NULL, &solid));
  OK(morula_clump_options_init(&how, sizeof how));
  how.effort = MORULA_EFFORT_DRAFT;
  OK(morula_cost_options_init(&options, sizeof options));
  CHECK(options.count == 0 && options.most == 100 && options.rebuild >= 1);
  options.counts = counts;
  options.count = 5;
  OK(morula_cost_curve(solid, &how, &options, &list));

  /* The lines, as this header has them and as a later one would. */
  size_t n = 0;
  int32_t cut = 1;
  morula_cost_point points[5];
  struct newer later[5];
  OK(morula_cost_count(list, &n));
  OK(morula_cost_cut(list, &cut));
  CHECK(n == 5 && cut == 0);
  memset(points, 0xff, sizeof points);
  points[0].struct_size = sizeof points[0];
  STATUS(morula_cost_copy(list, 4, points), MORULA_STATUS_BUFFER_TOO_SMALL);
  OK(morula_cost_copy(list, 5, points));
  memset(later, 0xff, sizeof later);
  later[0].known.struct_size = sizeof later[0];
  OK(morula_cost_copy(list, 5, &later[0].known));
  printf("spheres       D  surface   seconds  step cost\n");
  for (size_t i = 0; i < n; i++) {
    const morula_cost_point *p = points + i;
    printf("%7d %7.4f %8.4f %9.4f %10.1f\n", (int)p->spheres, p->mismatch, p->surface, p->seconds,
           p->step_cost);
    CHECK(p->struct_size == sizeof *p && p->asked == counts[i] && p->spheres == counts[i]);
    CHECK(later[i].known.struct_size == sizeof later[i] && later[i].later == 0);
    CHECK(later[i].known.mismatch == p->mismatch && later[i].known.stopped == p->stopped);
    CHECK(p->mismatch > 0 && p->surface > 0 && p->roughness > 0 && p->seconds > 0);
    CHECK(p->time_step > 0 && p->step_factor > 0 && p->step_cost >= 1);
    NEAR(p->time_cost * p->step_factor, p->step_cost, 1e-9 * p->step_cost);
    if (i > 0) CHECK(p->mismatch < p[-1].mismatch && p->step_cost > p[-1].step_cost);
  }
  CHECK(points[0].step_cost == 1 && points[0].masses == MORULA_MASSES_MASS_ONLY);
  CHECK(points[4].masses == MORULA_MASSES_EXACT && points[4].inertia < 1e-9);

  /* The fewest spheres that are good enough, with the reason, and their clump. */
  morula_cost_bounds bounds;
  size_t index = 99, length = 0;
  char why[400];
  OK(morula_cost_bounds_init(&bounds, sizeof bounds));
  bounds.goal = MORULA_GOAL_SPHERES;
  bounds.mismatch = points[2].mismatch;
  OK(morula_cost_choose(list, &bounds, &index, sizeof why, why, &length));
  CHECK(index == 2 && length == strlen(why) && strstr(why, "fewest spheres") != NULL);
  puts(why);
  OK(morula_cost_choose(list, NULL, &index, sizeof why, why, NULL));
  CHECK(index < 5);
  puts(why);
  bounds.mismatch = 1e-6;
  STATUS(morula_cost_choose(list, &bounds, &index, 0, NULL, NULL), MORULA_STATUS_NO_SPHERES);
  CHECK(strstr(morula_last_error_message(), "nearest") != NULL);
  bounds.goal = 77;
  STATUS(morula_cost_choose(list, &bounds, &index, 0, NULL, NULL), MORULA_STATUS_INVALID_ARGUMENT);
  morula_clump *clump = NULL;
  morula_overlap overlap = {0};
  overlap.struct_size = sizeof overlap;
  STATUS(morula_cost_clump(list, 5, &clump), MORULA_STATUS_INDEX_OUT_OF_RANGE);
  OK(morula_cost_clump(list, 3, &clump));
  morula_cost_free(list);
  list = NULL;
  OK(morula_clump_sphere_count(clump, &n));
  OK(morula_clump_overlap(clump, &overlap));
  CHECK(n == 20 && overlap.mismatch == points[3].mismatch);
  double single[20][4];
  OK(morula_clump_copy_spheres(clump, 20, single[0]));
  morula_clump_free(clump);
  clump = NULL;

  /* It is the one that a call of its own gives. */
  double alone[20][4];
  how.spheres = 20;
  OK(morula_clump_from_solid(solid, &how, &clump));
  OK(morula_clump_copy_spheres(clump, 20, alone[0]));
  CHECK(memcmp(single, alone, sizeof alone) == 0);
  morula_clump_free(clump);
  clump = NULL;

  /* Levels that nest: each holds the one before. */
  options.levels = MORULA_LEVELS_NESTED;
  OK(morula_cost_curve(solid, &how, &options, &list));
  double small[8][4], large[20][4];
  OK(morula_cost_clump(list, 2, &clump));
  OK(morula_clump_copy_spheres(clump, 8, small[0]));
  morula_clump_free(clump);
  clump = NULL;
  OK(morula_cost_clump(list, 3, &clump));
  OK(morula_clump_copy_spheres(clump, 20, large[0]));
  CHECK(memcmp(small, large, sizeof small) == 0);
  morula_clump_free(clump);
  morula_cost_free(list);
  list = NULL;

  /* A cancel leaves the lines that there are. */
  options.levels = MORULA_LEVELS_FREE;
  how.progress = stop_late;
  OK(morula_cost_curve(solid, &how, &options, &list));
  OK(morula_cost_count(list, &n));
  OK(morula_cost_cut(list, &cut));
  CHECK(n > 0 && n < 5 && cut == 1);
  morula_cost_free(list);
  list = NULL;
  how.progress = NULL;

  /* What is refused. */
  options.levels = 9;
  STATUS(morula_cost_curve(solid, &how, &options, &list), MORULA_STATUS_INVALID_ARGUMENT);
  options.levels = MORULA_LEVELS_FREE;
  options.rebuild = 0;
  STATUS(morula_cost_curve(solid, &how, &options, &list), MORULA_STATUS_INVALID_ARGUMENT);
  STATUS(morula_cost_curve(solid, &how, NULL, NULL), MORULA_STATUS_NULL_POINTER);
  STATUS(morula_cost_count(NULL, &n), MORULA_STATUS_NULL_POINTER);
  CHECK(list == NULL);
  morula_cost_free(NULL);
  morula_solid_free(solid);
  morula_shape_free(shape);
  return checks_done();
}
