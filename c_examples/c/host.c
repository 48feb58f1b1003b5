/* The host lives: its floating-point traps stay as they are and are not sprung,
 * a forked child can make clumps on threads, nothing is printed. */
#include "check.h"

#include <stdlib.h>
#include <sys/wait.h>
#include <unistd.h>
#ifdef __SSE2__
#include <xmmintrin.h>
#endif

/* The host's own code runs in the host's environment. */
static int32_t in_the_hosts_environment(double fraction, void *user) {
  const int *rounding = user;
  (void)fraction;
  CHECK(fegetround() == *rounding);
  return 0;
}

static void one_clump(morula_shape *shape, int32_t threads, uint32_t wants, double xyzr[30][4]) {
  morula_clump_options options;
  morula_clump *clump = NULL;
  const double planes[1] = {0.05};
  OK(morula_clump_options_init(&options, sizeof options));
  options.spheres = 30;
  options.threads = threads;
  options.wants = wants;
  options.plane_tolerances = planes;
  options.plane_tolerance_count = 1;
  int rounding = fegetround();
  options.progress = in_the_hosts_environment;
  options.user = &rounding;
  OK(morula_clump_from_shape(shape, NULL, &options, &clump));
  OK(morula_clump_copy_spheres(clump, 30, xyzr[0]));
  morula_clump_free(clump);
}

/* Every method on a stone and on a needle; some refuse it, none springs a trap. */
static void every_method(void) {
  static const int32_t methods[10] = {
      MORULA_METHOD_MSS,          MORULA_METHOD_BEST,      MORULA_METHOD_SURFACE_FIT,
      MORULA_METHOD_INSCRIBED,    MORULA_METHOD_COVER,     MORULA_METHOD_PACKED,
      MORULA_METHOD_EUCLIDEAN,    MORULA_METHOD_FERELLEC_MCDOWELL,
      MORULA_METHOD_FAVIER,       MORULA_METHOD_UNIFORM_GRID};
  const double needle[2] = {0.01, 1};
  const char *const keys[2] = {"radius", "height"};
  int made = 0;
  for (int body = 0; body < 2; body++) {
    morula_shape *shape = NULL;
    OK(morula_shape_from_primitive(body ? "cylinder" : "stone", keys, needle, body ? 2 : 0, 24, 3,
                                   NULL, &shape));
    for (int i = 0; i < 10; i++) {
      morula_clump_options options;
      morula_clump *clump = NULL;
      OK(morula_clump_options_init(&options, sizeof options));
      options.spheres = 12;
      options.method = methods[i];
      options.wants = MORULA_WANT_OVERLAP | MORULA_WANT_SURFACE | MORULA_WANT_MOMENTS;
      const int32_t status = morula_clump_from_shape(shape, NULL, &options, &clump);
      CHECK(status != MORULA_STATUS_INTERNAL);
      made += status == MORULA_STATUS_OK;
      morula_clump_free(clump);
    }
    morula_shape_free(shape);
  }
  CHECK(made >= 17);
}

static void traps(void) {
#ifdef __GLIBC__
  fedisableexcept(FE_ALL_EXCEPT);
  const uint32_t all = MORULA_WANT_OVERLAP | MORULA_WANT_SURFACE | MORULA_WANT_MOMENTS;
  static double xyzr[30][4], same[30][4];
  morula_shape *shape = l_shape();
  one_clump(shape, 1, all, same);
  feclearexcept(FE_ALL_EXCEPT);
  feraiseexcept(FE_UNDERFLOW);
  feenableexcept(FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW);
  fesetround(FE_UPWARD);
  const int before = fegetexcept();
  for (size_t i = 0; morula_primitive_name(i); i++) {
    morula_shape *particle = NULL;
    morula_moments moments = {0};
    moments.struct_size = sizeof moments;
    OK(morula_shape_from_primitive(morula_primitive_name(i), NULL, NULL, 0, 32, 3, NULL, &particle));
    OK(morula_shape_moments(particle, 1, &moments));
    one_clump(particle, 1, all, xyzr);
    morula_shape_free(particle);
  }
  one_clump(shape, 2, all, xyzr);
  every_method();
  /* Traps, rounding and flags are as they were, and the spheres do not depend on them. */
  CHECK(fegetexcept() == before && fegetround() == FE_UPWARD);
  CHECK(fetestexcept(FE_UNDERFLOW | FE_OVERFLOW | FE_DIVBYZERO | FE_INVALID) == FE_UNDERFLOW);
  CHECK(memcmp(xyzr, same, sizeof same) == 0);
  morula_shape_free(shape);
  fedisableexcept(FE_ALL_EXCEPT);
  feclearexcept(FE_ALL_EXCEPT);
  fesetround(FE_TONEAREST);
#else
  puts("skipped: the C library has no feenableexcept");
#endif
}

/* A host built with -ffast-math flushes subnormal numbers: the spheres do not depend on it. */
static void flushed(void) {
#ifdef __SSE2__
  static double xyzr[30][4], same[30][4];
  const uint32_t all = MORULA_WANT_OVERLAP | MORULA_WANT_SURFACE | MORULA_WANT_MOMENTS;
  const unsigned flush = 0x8040; /* to zero, what comes out and what goes in */
  /* The smallest that is taken: parts of its moments of inertia are subnormal in the caller's unit. */
  const char *const key = "diameter";
  const double tiny = 1e-60;
  morula_shape *shape = NULL;
  OK(morula_shape_from_primitive("stone", &key, &tiny, 1, 24, 3, NULL, &shape));
  one_clump(shape, 2, all, same);
  morula_shape_free(shape);
  shape = NULL;
  const unsigned before = _mm_getcsr();
  _mm_setcsr(before | flush);
  volatile double least = 2.2250738585072014e-308;
  CHECK(least / 4 == 0);
  OK(morula_shape_from_primitive("stone", &key, &tiny, 1, 24, 3, NULL, &shape));
  one_clump(shape, 2, all, xyzr);
  morula_shape_free(shape);
  CHECK((_mm_getcsr() & flush) == flush);
  CHECK(least / 4 == 0);
  _mm_setcsr(before);
  CHECK(memcmp(xyzr, same, sizeof same) == 0);
#else
  puts("skipped: no SSE2");
#endif
}

static void forks(void) {
  morula_shape *shape = l_shape();
  static double here[30][4], there[30][4];
  one_clump(shape, 2, MORULA_WANT_NOTHING, here);
  const pid_t child = fork();
  CHECK(child >= 0);
  if (child == 0) {
    alarm(60); /* a hang ends the child, and the test */
    one_clump(shape, 2, MORULA_WANT_NOTHING, there);
    _exit(checks_failed != 0 || memcmp(here, there, sizeof here) != 0);
  }
  int status = -1;
  CHECK(waitpid(child, &status, 0) == child);
  CHECK(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  morula_shape_free(shape);
}

/* What a failing and a succeeding call print: nothing. */
static void silence(void) {
  char name[] = "morula_silence_XXXXXX";
  const int file = mkstemp(name), out = dup(1), err = dup(2);
  static double xyzr[30][4];
  morula_shape *shape = l_shape(), *none = NULL;
  CHECK(file >= 0);
  fflush(stdout);
  dup2(file, 1);
  dup2(file, 2);
  one_clump(shape, 2, MORULA_WANT_OVERLAP, xyzr);
  const int32_t status = morula_shape_from_file("no/such.stl", NULL, NULL, &none);
  dup2(out, 1);
  dup2(err, 2);
  CHECK(status == MORULA_STATUS_IO);
  CHECK(lseek(file, 0, SEEK_END) == 0);
  close(file);
  unlink(name);
  morula_shape_free(shape);
}

int main(void) {
  traps();
  flushed();
  forks();
  silence();
  return checks_done();
}
