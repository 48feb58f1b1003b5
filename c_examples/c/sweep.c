/* Price lists over resolutions, methods and deadlines. */
#include "check.h"

/* What a list is of, as a later header may have it. */
struct newer {
  morula_swept known;
  double later;
};

static double stop_at;
static double last;

static int32_t stop(double fraction, void *user) {
  (void)user;
  CHECK(fraction >= last);
  last = fraction;
  return fraction > stop_at;
}

int main(void) {
  morula_shape *shape = NULL;
  morula_sweep *sweep = NULL;
  morula_cost *list = NULL;
  morula_clump_options how;
  morula_cost_options cost;
  morula_sweep_options over;
  const uint64_t counts[2] = {3, 8};
  const double cells[2] = {16, 24};
  const int32_t methods[2] = {MORULA_METHOD_BEST, MORULA_METHOD_MSS};
  const int32_t efforts[2] = {MORULA_EFFORT_DRAFT, MORULA_EFFORT_NORMAL};
  const double deadlines[2] = {0, 60};
  OK(morula_shape_from_primitive("stone", NULL, NULL, 0, 24, 0, NULL, &shape));
  OK(morula_clump_options_init(&how, sizeof how));
  OK(morula_cost_options_init(&cost, sizeof cost));
  cost.counts = counts;
  cost.count = 2;
  cost.surface = 0;
  OK(morula_sweep_options_init(&over, sizeof over));
  CHECK(over.resolution_count == 0 && over.method_count == 0 && over.deadline_count == 0);
  over.resolutions = cells;
  over.resolution_count = 2;
  over.methods = methods;
  over.efforts = efforts;
  over.method_count = 2;
  over.deadlines = deadlines;
  over.deadline_count = 2;
  stop_at = 2;
  how.progress = stop;
  OK(morula_sweep_from_shape(shape, NULL, &how, &cost, &over, &sweep));
  CHECK(last > 0.9);

  /* What each list is of, as this header has it and as a later one would. */
  size_t n = 0;
  morula_swept all[8];
  struct newer later[8];
  OK(morula_sweep_count(sweep, &n));
  CHECK(n == 8);
  memset(all, 0xff, sizeof all);
  all[0].struct_size = sizeof all[0];
  STATUS(morula_sweep_copy(sweep, 7, all), MORULA_STATUS_BUFFER_TOO_SMALL);
  OK(morula_sweep_copy(sweep, 8, all));
  memset(later, 0xff, sizeof later);
  later[0].known.struct_size = sizeof later[0];
  OK(morula_sweep_copy(sweep, 8, &later[0].known));
  for (size_t i = 0; i < n; i++) {
    const morula_swept *one = all + i;
    CHECK(one->struct_size == sizeof *one && one->status == MORULA_STATUS_OK && !one->cut);
    CHECK(one->resolution == cells[i / 4] && one->cells[0] > one->resolution);
    CHECK(one->method == methods[i / 2 % 2] && one->effort == efforts[i / 2 % 2]);
    CHECK(one->deadline == deadlines[i % 2] && one->solid_seconds > 0 && one->lines == 2);
    CHECK(later[i].known.struct_size == sizeof later[i] && later[i].later == 0);
    CHECK(later[i].known.lines == 2 && later[i].known.method == one->method);
  }

  /* A list is the one that a call of its own gives, and outlives the sweep. */
  morula_solid_options grid;
  morula_solid *solid = NULL;
  morula_cost *alone = NULL;
  morula_cost_point points[2][2];
  OK(morula_sweep_curve(sweep, 4, &list));
  STATUS(morula_sweep_curve(sweep, 8, &list), MORULA_STATUS_INDEX_OUT_OF_RANGE);
  STATUS(morula_sweep_curve(sweep, 0, NULL), MORULA_STATUS_NULL_POINTER);
  morula_sweep_free(sweep);
  sweep = NULL;
  OK(morula_solid_options_init(&grid, sizeof grid));
  grid.cells = 24;
  OK(morula_solid_from_shape(shape, &grid, &solid));
  how.progress = NULL;
  how.effort = MORULA_EFFORT_DRAFT;
  OK(morula_cost_curve(solid, &how, &cost, &alone));
  points[0][0].struct_size = points[1][0].struct_size = sizeof points[0][0];
  OK(morula_cost_copy(list, 2, points[0]));
  OK(morula_cost_copy(alone, 2, points[1]));
  for (size_t i = 0; i < 2; i++) {
    morula_clump *clumps[2] = {NULL, NULL};
    double spheres[2][8][4];
    CHECK(points[0][i].mismatch == points[1][i].mismatch);
    CHECK(points[0][i].inertia == points[1][i].inertia && points[0][i].spheres == counts[i]);
    OK(morula_cost_clump(list, i, &clumps[0]));
    OK(morula_cost_clump(alone, i, &clumps[1]));
    for (size_t k = 0; k < 2; k++) {
      OK(morula_clump_copy_spheres(clumps[k], 8, spheres[k][0]));
      morula_clump_free(clumps[k]);
    }
    CHECK(memcmp(spheres[0], spheres[1], counts[i] * sizeof spheres[0][0]) == 0);
  }
  morula_cost_free(list);
  morula_cost_free(alone);
  morula_solid_free(solid);
  list = NULL;

  /* Cells by their edge; one effort for all. */
  const double edge = 0.125;
  over.resolutions = &edge;
  over.resolution_count = 1;
  over.efforts = NULL;
  over.deadline_count = 1;
  how.effort = MORULA_EFFORT_NORMAL;
  grid.resolution = MORULA_RESOLUTION_CELL_SIZE;
  OK(morula_sweep_from_shape(shape, &grid, &how, &cost, &over, &sweep));
  OK(morula_sweep_copy(sweep, 2, all));
  CHECK(all[0].resolution == edge && all[1].effort == MORULA_EFFORT_NORMAL);
  CHECK(all[0].lines == 2 && all[1].lines == 2);
  morula_sweep_free(sweep);
  sweep = NULL;

  /* A list that cannot be made leaves the others; its status and its sentence stay. */
  how.spheres = 0;
  how.max_protrusion = 0.1;
  over.resolutions = cells;
  OK(morula_sweep_from_shape(shape, NULL, &how, &cost, &over, &sweep));
  OK(morula_sweep_copy(sweep, 2, all));
  CHECK(all[0].status == MORULA_STATUS_OK && all[1].status != MORULA_STATUS_OK);
  CHECK(all[1].lines == 0);
  STATUS(morula_sweep_curve(sweep, 1, &list), all[1].status);
  CHECK(list == NULL);
  morula_sweep_free(sweep);
  sweep = NULL;

  /* Where there is no list at all, the first reason. */
  over.methods = methods + 1;
  over.method_count = 1;
  STATUS(morula_sweep_from_shape(shape, NULL, &how, &cost, &over, &sweep), all[1].status);
  how.max_protrusion = 0;
  over.methods = methods;
  over.method_count = 2;

  /* A cancel leaves the lists that were begun. */
  stop_at = 0.6;
  last = 0;
  how.progress = stop;
  over.resolution_count = 2;
  OK(morula_sweep_from_shape(shape, NULL, &how, &cost, &over, &sweep));
  OK(morula_sweep_copy(sweep, 4, all));
  CHECK(all[0].status == MORULA_STATUS_OK && all[1].status == MORULA_STATUS_OK);
  CHECK(all[3].status == MORULA_STATUS_CANCELLED && all[3].lines == 0);
  STATUS(morula_sweep_curve(sweep, 3, &list), MORULA_STATUS_CANCELLED);
  morula_sweep_free(sweep);
  sweep = NULL;
  stop_at = -1;
  last = 0;
  STATUS(morula_sweep_from_shape(shape, NULL, &how, &cost, &over, &sweep),
         MORULA_STATUS_CANCELLED);
  how.progress = NULL;

  /* What is refused, before any work. */
#define REFUSED(change, restore, status)                                                     \
  do {                                                                                       \
    change;                                                                                  \
    STATUS(morula_sweep_from_shape(shape, NULL, &how, &cost, &over, &sweep), status);        \
    CHECK(sweep == NULL);                                                                    \
    restore;                                                                                 \
  } while (0)
  const double wrong_cells[2] = {16, 16.5}, no_cells[1] = {0}, nan_cells[1] = {NAN};
  const double nan_deadline[2] = {0, NAN}, early[1] = {-1}, endless[1] = {INFINITY};
  const int32_t no_method[2] = {MORULA_METHOD_BEST, 99}, no_effort[2] = {MORULA_EFFORT_DRAFT, 7};
  REFUSED(over.resolution_count = 0, over.resolution_count = 2, MORULA_STATUS_EMPTY);
  REFUSED(over.method_count = 0, over.method_count = 2, MORULA_STATUS_EMPTY);
  REFUSED(over.deadline_count = 0, over.deadline_count = 1, MORULA_STATUS_EMPTY);
  REFUSED(over.resolutions = wrong_cells, over.resolutions = cells, MORULA_STATUS_INVALID_ARGUMENT);
  over.resolution_count = 1;
  REFUSED(over.resolutions = no_cells, over.resolutions = cells, MORULA_STATUS_INVALID_ARGUMENT);
  REFUSED(over.resolutions = nan_cells, over.resolutions = cells, MORULA_STATUS_INVALID_ARGUMENT);
  REFUSED(over.methods = no_method, over.methods = methods, MORULA_STATUS_INVALID_ARGUMENT);
  REFUSED(over.efforts = no_effort, over.efforts = NULL, MORULA_STATUS_INVALID_ARGUMENT);
  over.deadline_count = 2;
  REFUSED(over.deadlines = nan_deadline, over.deadlines = deadlines, MORULA_STATUS_INVALID_ARGUMENT);
  over.deadline_count = 1;
  REFUSED(over.deadlines = early, over.deadlines = deadlines, MORULA_STATUS_INVALID_ARGUMENT);
  REFUSED(over.deadlines = endless, over.deadlines = deadlines, MORULA_STATUS_INVALID_ARGUMENT);
  REFUSED(over.methods = NULL, over.methods = methods, MORULA_STATUS_NULL_POINTER);
  REFUSED(over.struct_size = 8, over.struct_size = sizeof over, MORULA_STATUS_STRUCT_SIZE);
  REFUSED(over.resolution_count = SIZE_MAX, over.resolution_count = 2, MORULA_STATUS_TOO_LARGE);
  STATUS(morula_sweep_from_shape(shape, NULL, &how, &cost, NULL, &sweep),
         MORULA_STATUS_NULL_POINTER);
  STATUS(morula_sweep_from_shape(shape, NULL, &how, &cost, &over, NULL),
         MORULA_STATUS_NULL_POINTER);
  STATUS(morula_sweep_from_shape(NULL, NULL, &how, &cost, &over, &sweep),
         MORULA_STATUS_NULL_POINTER);
  STATUS(morula_sweep_count(NULL, &n), MORULA_STATUS_NULL_POINTER);
  STATUS(morula_sweep_copy(NULL, 1, all), MORULA_STATUS_NULL_POINTER);
  CHECK(sweep == NULL && list == NULL);
  morula_sweep_free(NULL);
  morula_shape_free(shape);
  return checks_done();
}
