/* Forked children while other threads are inside calls: each makes clumps of the parent's solid, and of
 * a shape and a solid of its own, with 1 to 4 threads, and gets the parent's bytes. */
#include "check.h"

#include <pthread.h>
#include <sys/wait.h>
#include <unistd.h>

enum { CHILDREN = 12, SPHERES = 16 };

static const morula_solid *shared;
static volatile int stop;

/* With its own pool, whose threads the child does not have. */
static int clump(const morula_solid *solid, int32_t threads, double xyzr[SPHERES][4]) {
  morula_clump_options options;
  morula_clump *clump = NULL;
  if (morula_clump_options_init(&options, sizeof options)) return 1;
  options.spheres = SPHERES;
  options.effort = MORULA_EFFORT_DRAFT;
  options.threads = threads;
  options.wants = MORULA_WANT_OVERLAP;
  const int failed = morula_clump_from_solid(solid, &options, &clump) ||
                     morula_clump_copy_spheres(clump, SPHERES, xyzr[0]);
  morula_clump_free(clump);
  return failed;
}

/* Of a shape and a solid that are made for it. */
static int own(int32_t threads, double xyzr[SPHERES][4]) {
  morula_shape *shape = NULL;
  morula_solid *solid = NULL;
  const int failed = morula_shape_from_primitive("torus", NULL, NULL, 0, 16, 0, NULL, &shape) ||
                     morula_solid_from_shape(shape, NULL, &solid) || clump(solid, threads, xyzr);
  morula_solid_free(solid);
  morula_shape_free(shape);
  return failed;
}

static void *busy(void *user) {
  double xyzr[SPHERES][4];
  int *rounds = user;
  while (!stop) *rounds += !clump(shared, 3, xyzr);
  return NULL;
}

static int child(double here[SPHERES][4], double torus[SPHERES][4]) {
  double there[SPHERES][4];
  morula_shape *shape = NULL;
  alarm(120); /* a hang ends the child, and the test */
  for (int32_t threads = 1; threads <= 4; threads++) {
    if (clump(shared, threads, there) || memcmp(here, there, sizeof there) != 0) return 2;
    if (own(threads, there) || memcmp(torus, there, sizeof there) != 0) return 3;
  }
  if (morula_shape_from_file("no/such.stl", NULL, NULL, &shape) != MORULA_STATUS_IO) return 4;
  return 0;
}

int main(void) {
  morula_shape *shape = l_shape();
  morula_solid *solid = NULL;
  morula_solid_options grid;
  double here[SPHERES][4], torus[SPHERES][4];
  pthread_t threads[2];
  int rounds[2] = {0, 0};
  OK(morula_solid_options_init(&grid, sizeof grid));
  grid.cells = 24;
  OK(morula_solid_from_shape(shape, &grid, &solid));
  shared = solid;
  CHECK(!clump(solid, 2, here));
  CHECK(!own(2, torus));
  for (int i = 0; i < 2; i++) CHECK(pthread_create(&threads[i], NULL, busy, &rounds[i]) == 0);
  for (int i = 0; i < CHILDREN; i++) {
    int status = -1;
    const pid_t id = fork();
    CHECK(id >= 0);
    if (id == 0) _exit(child(here, torus));
    CHECK(waitpid(id, &status, 0) == id);
    CHECK(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  }
  stop = 1;
  for (int i = 0; i < 2; i++) CHECK(pthread_join(threads[i], NULL) == 0);
  CHECK(rounds[0] > 0 && rounds[1] > 0);
  CHECK(!clump(solid, 2, here));
  printf("%d children, while two threads made %d clumps\n", CHILDREN, rounds[0] + rounds[1]);
  morula_solid_free(solid);
  morula_shape_free(shape);
  return checks_done();
}
