/* Two threads on one const handle, the same bytes for any number of threads,
 * messages that belong to their thread, and no thread that outlives a call. */
#define _POSIX_C_SOURCE 200809L
#include "check.h"

#include <dirent.h>
#include <pthread.h>
#include <stdlib.h>

enum { SPHERES = 25, THREADS = 3 };

struct job {
  const morula_shape *shape;
  const morula_solid *solid;
  int32_t threads;
  size_t n;
  double xyzr[SPHERES][4], distance;
  morula_moments moments;
  char message[200];
  pthread_t self;
  int ok;
};

static int32_t on_the_callers_thread(double fraction, void *user) {
  struct job *job = user;
  (void)fraction;
  if (!pthread_equal(pthread_self(), job->self)) job->ok = 0;
  return 0;
}

static void *work(void *user) {
  struct job *job = user;
  morula_clump_options options;
  morula_clump *clump = NULL;
  const double point[3] = {11.1, 20.3, 30.4};
  job->self = pthread_self();
  job->ok = 1;
  job->moments.struct_size = sizeof job->moments;
  if (morula_clump_options_init(&options, sizeof options)) job->ok = 0;
  options.spheres = SPHERES;
  options.threads = job->threads;
  options.progress = on_the_callers_thread;
  options.user = job;
  if (morula_clump_from_solid(job->solid, &options, &clump) ||
      morula_clump_sphere_count(clump, &job->n) ||
      morula_clump_copy_spheres(clump, SPHERES, job->xyzr[0]) ||
      morula_shape_moments(job->shape, job->threads, &job->moments) ||
      morula_solid_distance(job->solid, 1, point, &job->distance))
    job->ok = 0;
  morula_clump_free(clump);
  if (morula_shape_moments(job->shape, -job->threads, &job->moments) == MORULA_STATUS_OK)
    job->ok = 0;
  strncpy(job->message, morula_last_error_message(), sizeof job->message - 1);
  return NULL;
}

/* Threads of this process; 0 where the system does not tell. */
static int tasks(void) {
  int n = 0;
  DIR *dir = opendir("/proc/self/task");
  if (!dir) return 0;
  for (struct dirent *e; (e = readdir(dir));) n += e->d_name[0] != '.';
  closedir(dir);
  return n;
}

int main(void) {
  static struct job jobs[THREADS];
  morula_shape *shape = l_shape();
  morula_solid *solid = NULL;
  OK(morula_solid_from_shape(shape, NULL, &solid));
  const int before = tasks();
  pthread_t threads[THREADS];
  for (int i = 0; i < THREADS; i++) {
    jobs[i].shape = shape;
    jobs[i].solid = solid;
    jobs[i].threads = i + 1;
    CHECK(pthread_create(&threads[i], NULL, work, &jobs[i]) == 0);
  }
  for (int i = 0; i < THREADS; i++) pthread_join(threads[i], NULL);
  for (int i = 0; i < THREADS; i++) {
    char density[20];
    snprintf(density, sizeof density, "-%d", i + 1);
    CHECK(jobs[i].ok && jobs[i].n == jobs[0].n);
    CHECK(memcmp(jobs[i].xyzr, jobs[0].xyzr, sizeof jobs[0].xyzr) == 0);
    NEAR(jobs[i].moments.mass, 4 * (i + 1), 1e-12);
    NEAR(jobs[i].distance, -0.3, 1e-12);
    CHECK(strstr(jobs[i].message, density) != NULL);
  }
  CHECK(morula_last_error_message()[0] == '\0');

  /* Right after a call on several threads, no more of them are there. */
  for (int i = 0; i < 20; i++) {
    jobs[0].threads = 4;
    work(&jobs[0]);
    CHECK(tasks() == before);
  }
  morula_solid_free(solid);
  morula_shape_free(shape);
  return checks_done();
}
